"""One picture of points and of what is computed from them, in a file."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from crustline.errors import InputError, require
from crustline.plot.axes import (
    axes,
)
from crustline.plot.background import plot_background
from crustline.plot.certificate import plot_certificate
from crustline.plot.connection import plot_connection
from crustline.plot.curves import plot_curves
from crustline.plot.delaunay import plot_delaunay, plot_voronoi
from crustline.plot.denoised import plot_denoised
from crustline.plot.medial_axis import plot_medial_axis
from crustline.plot.points import plot_indices, plot_local_feature_size, plot_points
from crustline.reconstruction import Reconstruction, as_reconstruction

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.curves import Curves
    from crustline.delaunay import Delaunay

#: What `picture` can show, drawn in this order.
LAYERS: dict[str, Callable[[Reconstruction, Axes], Axes]] = {
    "delaunay": lambda made, ax: plot_delaunay(made.delaunay, ax, points=False),
    "voronoi": lambda made, ax: plot_voronoi(made.delaunay, ax, points=False),
    "medial-axis": lambda made, ax: plot_medial_axis(made.medial_axis, ax),
    "curves": lambda made, ax: (
        plot_curves(made.curves, ax, points=False)
        if made.denoised is None
        else plot_denoised(made.denoised, ax, points=False)
    ),
    "confidence": lambda made, ax: plot_connection(made.connection, ax, points=False),
    "certificate": lambda made, ax: plot_certificate(made.certificate, ax, points=False),
    "lfs": lambda made, ax: plot_local_feature_size(made.vertices, made.local_feature_size, ax),
    "points": lambda made, ax: plot_points(made.points, ax),
    "indices": lambda made, ax: plot_indices(made.points, ax),
}
SUFFIXES = (".png", ".svg", ".pdf")


def picture(
    points: ArrayLike | Delaunay | Reconstruction,
    path: str | os.PathLike[str],
    *,
    show: Sequence[str] = ("points", "curves"),
    background: str | os.PathLike[str] | Curves | None = None,
) -> None:
    """Write a picture of points and of what is computed from them to a file.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points, Delaunay or Reconstruction
        Coordinates; a `Reconstruction` says by which method they are connected.
    path : str or path-like
        Where to write; the suffix .png, .svg or .pdf decides the format.
    show : sequence of str
        What to draw, any of "points", "delaunay", "voronoi", "curves" (those that the method
        finds), "confidence" (how sure `connect` is of each edge), "medial-axis", "lfs",
        "certificate", "indices", in any order.
    background : "world", path-like or Curves, optional
        Outlines of a map below, as for `plot_background`.

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
    require("plot", "matplotlib")
    from matplotlib import rc_context, rcdefaults

    made = as_reconstruction(points)
    with rc_context():
        rcdefaults()
        ax, _ = axes(None, made.points)
        if background is not None:
            plot_background(made.points, ax, outlines=background)
        for name, draw in LAYERS.items():
            if name in show:
                draw(made, ax)
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
