"""How sure the edges are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.plot.axes import BLUE, GRAY, ORANGE, VERMILLION, axes, draw_segments, mark
from crustline.plot.points import plot_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.connection import Connection

#: From which confidence on an edge is drawn how: color, width and name.
STEPS = (
    (0.99, BLUE, 1.5, "0.99 or more sure"),
    (0.9, "#56B4E9", 2.0, "0.9 or more"),
    (0.5, ORANGE, 2.5, "0.5 or more"),
    (0.0, VERMILLION, 3.0, "less"),
)


def plot_connection(connection: Connection, ax: Axes | None = None, *, points: bool = True) -> Axes:
    """Draw edges in colors that tell how sure they are, and those of the crust left out in gray.

    Parameters
    ----------
    connection : Connection
        What `crustline.connection` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    points : bool, default True
        Whether to draw the points, too.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import connection
    >>> ax = plot_connection(connection([(0, 0), (1, 0), (1, 1), (0, 1)]))
    """
    ax, xy = axes(ax, connection.points)
    draw_segments(ax, xy[connection.left_out], GRAY, 0.8, label="of the crust, left out")
    above = np.inf
    for least, color, width, label in STEPS:
        chosen = (connection.confidence >= least) & (connection.confidence < above)
        draw_segments(ax, xy[connection.edges[chosen]], color, width, label=label, zorder=3)
        above = least
    if points:
        plot_points(xy, ax)
    mark(ax, xy[connection.outliers], "o", VERMILLION, "outlier")
    ax.set_title(f"{connection.whole:.0%} sure as a whole", size=9, loc="left")
    return ax
