"""Segments and rays cut off at a box."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from crustline.arrays import FloatArray

if TYPE_CHECKING:
    pass


def box_around(xy: FloatArray) -> FloatArray:
    """Return the lower left and the upper right corner of three times the extent of the points."""
    if not len(xy):
        return np.array([[-1.0, -1.0], [1.0, 1.0]])
    low, high = xy.min(axis=0), xy.max(axis=0)
    margin = math.hypot(*(high - low)) or 1.0
    return np.stack([low - margin, high + margin])


def long_rays(origins: FloatArray, directions: FloatArray, box: FloatArray) -> FloatArray:
    """Return rays as segments that are long enough to leave the box."""
    lengths = np.hypot(*directions.T)
    reach = np.hypot(*(origins - box.mean(axis=0)).T) + math.dist(*box)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.stack([origins, origins + directions * (reach / lengths)[:, None]], 1)


def clipped(segments: FloatArray, box: FloatArray) -> FloatArray:
    """Return the parts of segments (m, 2, 2) that lie in a box: Liang and Barsky's clipping."""
    segments = segments[np.isfinite(segments).all(axis=(1, 2))]
    start, step = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        crossings = (box[:, None] - start) / step
    # Parallel to a side: inside of it all along, or nowhere.
    inside = (start >= box[0]) & (start <= box[1])
    enter = np.where(step == 0, np.where(inside, -np.inf, np.inf), crossings.min(axis=0))
    leave = np.where(step == 0, np.where(inside, np.inf, -np.inf), crossings.max(axis=0))
    t = np.stack([enter.max(axis=1).clip(min=0), leave.min(axis=1).clip(max=1)], 1)
    seen = t[:, 0] <= t[:, 1]
    return start[seen, None] + t[seen, :, None] * step[seen, None]
