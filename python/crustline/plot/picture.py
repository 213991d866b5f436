"""One picture of points and of what is computed from them, in a file."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, IntArray, as_points
from crustline.errors import InputError
from crustline.plot.axes import (
    axes,
    require_matplotlib,
)
from crustline.plot.certificate import plot_certificate
from crustline.plot.curves import plot_curves
from crustline.plot.delaunay import plot_delaunay, plot_voronoi
from crustline.plot.medial_axis import plot_medial_axis
from crustline.plot.points import plot_indices, plot_local_feature_size, plot_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.certify import Certificate
    from crustline.curves import Curves
    from crustline.delaunay import Delaunay
    from crustline.medial_axis import MedialAxis


@dataclass(frozen=True)
class _Scene:
    """What there is to draw of some points, each part computed when it is first drawn."""

    points: FloatArray
    method: Callable[..., Any]

    @cached_property
    def delaunay(self) -> Delaunay:
        from crustline.delaunay import Delaunay

        return Delaunay(self.points)

    @cached_property
    def edges(self) -> IntArray:
        edges: IntArray = self.method(self.delaunay)
        return edges

    @cached_property
    def curves(self) -> Curves:
        from crustline.curves import trace

        return trace(self.points, self.edges)

    @cached_property
    def medial_axis(self) -> MedialAxis:
        from crustline.medial_axis import medial_axis

        return medial_axis(self.points, self.edges)

    @cached_property
    def feature_sizes(self) -> FloatArray:
        from crustline.interpolant import local_feature_size

        return np.asarray(local_feature_size(self.points, self.edges))

    @cached_property
    def certificate(self) -> Certificate:
        from crustline.certify import certify

        return certify(self.points, self.edges)


#: What `picture` can show, drawn in this order.
LAYERS: dict[str, Callable[[_Scene, Axes], Axes]] = {
    "delaunay": lambda scene, ax: plot_delaunay(scene.delaunay, ax, points=False),
    "voronoi": lambda scene, ax: plot_voronoi(scene.delaunay, ax, points=False),
    "medial-axis": lambda scene, ax: plot_medial_axis(scene.medial_axis, ax),
    "crust": lambda scene, ax: plot_curves(scene.curves, ax, points=False),
    "certificate": lambda scene, ax: plot_certificate(scene.certificate, ax, points=False),
    "lfs": lambda scene, ax: plot_local_feature_size(scene.points, scene.feature_sizes, ax),
    "points": lambda scene, ax: plot_points(scene.points, ax),
    "indices": lambda scene, ax: plot_indices(scene.points, ax),
}
SUFFIXES = (".png", ".svg", ".pdf")


def picture(
    points: ArrayLike,
    path: str | os.PathLike[str],
    *,
    show: Sequence[str] = ("points", "crust"),
    method: Callable[..., Any] | None = None,
) -> None:
    """Write a picture of points and of what is computed from them to a file.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    path : str or path-like
        Where to write; the suffix .png, .svg or .pdf decides the format.
    show : sequence of str
        What to draw, any of "points", "delaunay", "voronoi", "crust" (the curves that the method
        finds), "medial-axis", "lfs", "certificate", "indices", in any order.
    method : callable, optional
        From points to edges; `crustline.crust` if not given.

    Raises
    ------
    InputError
        If the suffix or a word of `show` is none of these, or the points are not finite (n, 2).
    MissingExtraError
        If matplotlib is not installed.

    Notes
    -----
    The same call writes the same bytes again: no date, no random identifier, and none of the user's
    settings of matplotlib.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     picture([(0, 0), (1, 0), (1, 1), (0, 1)], folder + "/square.svg")
    """
    path = Path(path)
    _check_choice("suffix", path.suffix.lower(), SUFFIXES)
    for layer in show:
        _check_choice("layer", layer, tuple(LAYERS))
    require_matplotlib()
    from matplotlib import rc_context, rcdefaults

    from crustline.methods import crust

    scene = _Scene(as_points(points), crust if method is None else method)
    with rc_context():
        rcdefaults()
        ax = axes(None, scene.points)
        for name, draw in LAYERS.items():
            if name in show:
                draw(scene, ax)
        _save(ax, path)


def _save(ax: Axes, path: Path) -> None:
    """Write the figure of the Axes without the date and the random names that tell runs apart."""
    from matplotlib import rc_context

    kind = path.suffix.lower()[1:]
    dates: dict[str, dict[str, Any]] = {
        "svg": {"Date": None},
        "pdf": {"CreationDate": None, "ModDate": None},
        "png": {},
    }
    with rc_context({"svg.hashsalt": "crustline", "svg.fonttype": "none", "pdf.fonttype": 42}):
        figure: Any = ax.get_figure(root=True)
        figure.savefig(path, format=kind, dpi=200, metadata=dates[kind])


def _check_choice(what: str, given: str, choices: tuple[str, ...]) -> None:
    if given not in choices:
        raise InputError(f"unknown {what} of a picture {given!r}: use one of {', '.join(choices)}")
