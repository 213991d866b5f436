"""The Delaunay triangulation, and the Voronoi diagram."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.arrays import FloatArray, as_points
from crustline.plot.axes import (
    GRAY,
    ORANGE,
    axes,
    draw_segments,
)
from crustline.plot.clip import box_around, clipped, long_rays
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
    xy = as_points(delaunay.points)
    ax = axes(ax, xy)
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
    xy = as_points(delaunay.points)
    ax = axes(ax, xy)
    box = box_around(xy)
    draw_segments(ax, clipped(_voronoi(delaunay, xy, box), box), color, 0.7, label="Voronoi")
    return plot_points(xy, ax) if points else ax


def _voronoi(delaunay: Delaunay, xy: FloatArray, box: FloatArray) -> FloatArray:
    """Return the Voronoi edges as segments, the unbounded ones long enough to leave the box."""
    if not len(delaunay.triangles):
        p, q = xy[delaunay.edges].transpose(1, 0, 2)
        middle, across = (p + q) / 2, np.stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0]], 1)
        return np.concatenate([long_rays(middle, across, box), long_rays(middle, -across, box)])
    twins = np.asarray(delaunay.halfedges)
    centers = np.asarray(delaunay.circumcenters)
    e = np.arange(len(twins))
    inner = np.flatnonzero(e < twins)
    finite = centers[np.stack([inner // 3, twins[inner] // 3], 1)]
    outer = np.flatnonzero(twins < 0)
    p = xy[delaunay.triangles.ravel()[outer]]
    q = xy[delaunay.triangles[outer // 3, (outer + 1) % 3]]
    outward = np.stack([q[:, 1] - p[:, 1], p[:, 0] - q[:, 0]], 1)
    return np.concatenate([finite, long_rays(centers[outer // 3], outward, box)])
