"""The methods: functions from points, or a `Delaunay` of them, to edges; and the table of them all.

Those that have a definition are decided by it in exact arithmetic: no edge depends on rounding, on
the order of rows, on the number of threads, or on which diagonals a triangulation has where points
are cocircular. `connect` weighs estimates; it, too, depends on neither rows nor threads.
"""

from collections.abc import Callable

from crustline.arrays import IntArray
from crustline.methods.alpha_shapes import a_shape, alpha_shape
from crustline.methods.columns import in_columns
from crustline.methods.connect import connect
from crustline.methods.crusts import as_selected, crust, nn_crust, one_step_crust, rcgh
from crustline.methods.gaps import close_gaps
from crustline.methods.greedy import crawl, peel
from crustline.methods.groups import by_group
from crustline.methods.nearest import compatible_crust, hnn_crust, sig_delaunay
from crustline.methods.neighborhoods import (
    beta_skeleton,
    crossing_angle_graph,
    gabriel,
    gamma_graph,
    relative_neighborhood,
)
from crustline.methods.parameters import as_method, check_parameters, name_of, parameters_of
from crustline.methods.spanning_tree import minimum_spanning_tree
from crustline.methods.voronoi_cells import conservative_crust, gathan

Method = Callable[..., IntArray]

METHODS: dict[str, Method] = {
    each.__name__.replace("_", "-"): each
    for each in (
        crust,
        connect,
        beta_skeleton,
        one_step_crust,
        nn_crust,
        hnn_crust,
        compatible_crust,
        conservative_crust,
        gathan,
        crawl,
        peel,
        sig_delaunay,
        gabriel,
        relative_neighborhood,
        gamma_graph,
        crossing_angle_graph,
        alpha_shape,
        a_shape,
        rcgh,
        minimum_spanning_tree,
    )
}
"""All methods by the names that they have on the command line and in the core."""

__all__ = [
    "METHODS",
    "Method",
    "a_shape",
    "alpha_shape",
    "as_method",
    "as_selected",
    "beta_skeleton",
    "by_group",
    "check_parameters",
    "close_gaps",
    "compatible_crust",
    "connect",
    "conservative_crust",
    "crawl",
    "crossing_angle_graph",
    "crust",
    "gabriel",
    "gamma_graph",
    "gathan",
    "hnn_crust",
    "in_columns",
    "minimum_spanning_tree",
    "name_of",
    "nn_crust",
    "one_step_crust",
    "parameters_of",
    "peel",
    "rcgh",
    "relative_neighborhood",
    "sig_delaunay",
]
