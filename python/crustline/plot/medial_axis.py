"""The medial axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.arrays import FloatArray
from crustline.plot.axes import (
    GREEN,
    PURPLE,
    axes,
    draw_segments,
)
from crustline.plot.clip import box_around, clipped, long_rays

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.medial_axis import MedialAxis


def plot_medial_axis(
    medial_axis: MedialAxis, ax: Axes | None = None, *, outer: bool = True, width: float = 1.2
) -> Axes:
    """Draw a medial axis: inner edges green, outer edges and rays purple and thinner.

    Parameters
    ----------
    medial_axis : MedialAxis
        What `medial_axis` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    outer : bool, default True
        Whether to draw the part outside of the rings.
    width : float, default 1.2
        Of the inner edges, in typographic points.

    Returns
    -------
    ax : Axes

    Notes
    -----
    New Axes show the vertices between the 2nd and the 98th percentile; Axes given keep their view.

    Examples
    --------
    >>> from crustline import medial_axis
    >>> ax = plot_medial_axis(medial_axis([(0, 0), (2, 0), (2, 1), (0, 1)]))
    """
    vertices = np.asarray(medial_axis.vertices, np.float64)
    edges, inner = np.asarray(medial_axis.edges), np.asarray(medial_axis.inner, bool)
    core = _core(vertices)
    ax = axes(ax, core if ax is None else vertices[:0])
    seen = ax.dataLim.get_points()
    box = box_around(seen if np.isfinite(seen).all() else core)
    draw_segments(ax, clipped(vertices[edges[inner]], box), GREEN, width, label="medial axis")
    if outer:
        origins = vertices[medial_axis.ray_origins]
        rays = long_rays(origins, np.asarray(medial_axis.ray_directions), box)
        outside = np.concatenate([vertices[edges[~inner]], rays])
        draw_segments(ax, clipped(outside, box), PURPLE, 0.7 * width, label="outer medial axis")
    return ax


def _core(vertices: FloatArray) -> FloatArray:
    """Return two corners that most vertices lie between: a few can be very far away."""
    finite = vertices[np.isfinite(vertices).all(axis=1)]
    return np.percentile(finite, [2, 98], axis=0) if len(finite) else finite
