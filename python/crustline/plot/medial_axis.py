"""The medial axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.arrays import FloatArray
from crustline.plot.axes import (
    GREEN,
    PURPLE,
    axes,
    box_around,
    draw_segments,
)

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
    core = _core(medial_axis.vertices)
    ax, _ = axes(ax, core if ax is None else core[:0])
    seen = ax.dataLim.get_points()
    box = box_around(seen if np.isfinite(seen).all() else core)
    inner = medial_axis.clipped(box, inner=True)
    draw_segments(ax, inner, GREEN, width, label="medial axis")
    if outer:
        outside = medial_axis.clipped(box, inner=False)
        draw_segments(ax, outside, PURPLE, 0.7 * width, label="outer medial axis")
    return ax


def _core(vertices: FloatArray) -> FloatArray:
    """Return two corners that most vertices lie between: a few can be very far away."""
    finite = vertices[np.isfinite(vertices).all(axis=1)]
    return np.percentile(finite, [2, 98], axis=0) if len(finite) else finite
