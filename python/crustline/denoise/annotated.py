"""Fitted curves with what is known of each vertex beside it: what is written to files."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves, trace
from crustline.points import Points


def annotated(
    points: Points,
    curves: Curves,
    vertices: IntArray,
    uncertainty: FloatArray,
    noise: FloatArray,
) -> Curves:
    """Return curves whose vertices, and the outliers after them, carry their rows as columns."""
    outliers = np.flatnonzero(vertices < 0)
    count = len(curves.points)
    owners = np.where(vertices < 0, count, vertices)
    owners[outliers] += np.arange(len(outliers))
    columns = {
        "input_rows": _rows(owners, count + len(outliers)),
        "uncertainty": np.concatenate((uncertainty, np.full(len(outliers), np.nan))),
        "noise": _means(owners, noise, curves, count + len(outliers)),
    }
    xy = np.vstack((curves.points.xy, points.xy[outliers]))
    z = None if points.z is None else _means(owners, points.z, curves, len(xy))
    return trace(Points(xy, z=z, columns=columns, crs=points.crs, names=points.names), curves.edges)


def _rows(owners: IntArray, count: int) -> NDArray[Any]:
    """Return the rows of each owner, as text."""
    order = np.argsort(owners, kind="stable")
    ends = np.searchsorted(owners[order], np.arange(count + 1))
    texts = list(map(str, order.tolist()))
    return np.array([" ".join(texts[a:b]) for a, b in pairwise(ends)], dtype=np.object_)


def _means(owners: IntArray, values: FloatArray, curves: Curves, count: int) -> FloatArray:
    """Return the mean of the values of each vertex, linear along a curve between those with some.

    Not a number where no value is.
    """
    is_known = np.isfinite(values)
    sizes = np.bincount(owners[is_known], minlength=count)
    sums = np.bincount(owners[is_known], values[is_known], minlength=count)
    means = np.full(count, np.nan)
    means[sizes > 0] = sums[sizes > 0] / sizes[sizes > 0]
    for curve in curves:
        own = means[curve.indices]
        known = np.flatnonzero(np.isfinite(own))
        if len(known):
            at, period = np.arange(len(own)), len(own) if curve.closed else None
            means[curve.indices] = np.interp(at, known, own[known], period=period)
    return means
