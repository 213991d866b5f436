"""Edges, and the curves that they are traced into."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from crustline.path import Path
from crustline.plot.axes import (
    BLUE,
    GRAY,
    VERMILLION,
    axes,
    draw_segments,
    mark,
    stroke,
)
from crustline.plot.points import plot_indices, plot_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.curves import Curves


def plot_edges(
    points: ArrayLike,
    edges: ArrayLike,
    ax: Axes | None = None,
    *,
    color: str = BLUE,
    width: float = 1.8,
    label: str | None = None,
) -> Axes:
    """Draw edges as segments. A million of them take seconds.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    edges : array_like of int, shape (m, 2)
        Rows of `points`.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    width : float, default 1.8
        In typographic points.
    label : str, optional
        Name in the legend.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> ax = plot_edges([(0, 0), (1, 0), (1, 1)], [(0, 1), (1, 2)])
    """
    ax, xy = axes(ax, points)
    segments = xy[np.asarray(edges, np.int64).reshape(-1, 2)]
    return draw_segments(ax, segments, color, width, label=label, zorder=3)


def plot_curves(
    curves: Curves, ax: Axes | None = None, *, points: bool = True, indices: bool = False
) -> Axes:
    """Draw curves: rings blue, polylines vermillion, points that no edge touches as open circles.

    Parameters
    ----------
    curves : Curves
        What `trace` or `reconstruct` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    points : bool, default True
        Whether to draw the points, too.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import reconstruct
    >>> ax = plot_curves(reconstruct([(0, 0), (1, 0), (1, 1), (0, 1)]))
    """
    ax, xy = axes(ax, curves.points)
    for closed, color, label in ((True, BLUE, "ring"), (False, VERMILLION, "polyline")):
        lines = (each for each in curves.features() if each.kind == "line")
        path = Path.joined(Path.of_feature(each, xy) for each in lines if each.closed == closed)
        # A name is worth its place in the legend where there are both kinds.
        named = (
            label if closed not in curves.closed or not np.all(curves.closed == closed) else None
        )
        stroke(ax, path, color, 1.8, label=named, zorder=3)
    if points:
        plot_points(xy, ax)
    mark(ax, xy[curves.isolated], "o", GRAY, "isolated point")
    return plot_indices(xy, ax) if indices else ax
