"""The Delaunay triangulation, and the Voronoi diagram."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.medial_axis import medial_axis
from crustline.plot.axes import (
    GRAY,
    ORANGE,
    axes,
    box_around,
    draw_segments,
)
from crustline.plot.points import plot_indices, plot_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.delaunay import Delaunay


def plot_delaunay(
    delaunay: Delaunay,
    ax: Axes | None = None,
    *,
    color: str = GRAY,
    points: bool = True,
    indices: bool = False,
) -> Axes:
    """Draw the edges of a Delaunay triangulation.

    Parameters
    ----------
    delaunay : Delaunay
        The triangulation.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    points : bool, default True
        Whether to draw the points, too.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import Delaunay
    >>> ax = plot_delaunay(Delaunay([(0, 0), (1, 0), (1, 1)]))
    """
    ax, xy = axes(ax, delaunay.points)
    draw_segments(ax, xy[delaunay.edges], color, 0.5, label="Delaunay", zorder=1)
    if points:
        plot_points(xy, ax)
    return plot_indices(xy, ax) if indices else ax


def plot_voronoi(
    delaunay: Delaunay, ax: Axes | None = None, *, color: str = ORANGE, points: bool = True
) -> Axes:
    """Draw the Voronoi diagram that is dual to a Delaunay triangulation.

    Parameters
    ----------
    delaunay : Delaunay
        The triangulation.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    points : bool, default True
        Whether to draw the points, too.

    Returns
    -------
    ax : Axes

    Notes
    -----
    Cut at three times the extent of the points; the unbounded edges reach that far.

    Examples
    --------
    >>> from crustline import Delaunay
    >>> ax = plot_voronoi(Delaunay([(0, 0), (1, 0), (1, 1)]))
    """
    ax, xy = axes(ax, delaunay.points)
    diagram = medial_axis(delaunay, np.empty((0, 2), np.int64))
    draw_segments(ax, diagram.clipped(box_around(xy)), color, 0.7, label="Voronoi")
    return plot_points(xy, ax) if points else ax
