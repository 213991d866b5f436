"""Curves of points that have no noise to speak of, and so stay as they are."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import PART, BoolArray, FloatArray, IntArray, in_parts
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay
from crustline.denoise.strand import Strand

#: Noise over the spacing up to which points count as clean.
CLEAN = 0.06
#: Points that a ring, and a line, has at least to be judged.
FEWEST = {True: 8, False: 12}
#: Points of a ring, and of a line, from which on that counts; of fewer, which can be on a smooth
#: curve by chance, less does.
SURE = {True: 12, False: 40}
#: The share of all points that are on clean curves where small ones count, too.
SHARE = 0.25
#: How many neighbors on either side predict a point.
NEIGHBORS = (2, 3, 4)
#: The median of the absolute value of a standard normal number.
MEDIAN = 0.6745


def clean_strands(delaunay: Delaunay, method: Callable[..., ArrayLike]) -> list[Strand]:
    """Return the curves, as a method connects the points, whose points are on smooth curves."""
    curves = trace(delaunay, method(delaunay))
    sizes = np.diff(curves.offsets)
    fewest = np.where(curves.closed, FEWEST[True], FEWEST[False])
    most = CLEAN * np.minimum(sizes / np.where(curves.closed, SURE[True], SURE[False]), 1.0)
    is_clean = (sizes >= fewest) & (_noise(delaunay.points.xy, curves) < most)
    # Of many pieces of noisy curves a small one is smooth by chance: not of clean curves.
    if sizes[is_clean].sum() < SHARE * sizes.sum():
        is_clean &= sizes >= SURE[False]
    return [
        _strand(delaunay, curves.indices[slice(*curves.offsets[k : k + 2])], bool(curves.closed[k]))
        for k in np.flatnonzero(is_clean)
    ]


def _noise(points: FloatArray, curves: Curves) -> FloatArray:
    """Return for each curve the deviation of points across it, in steps, from what neighbors say.

    Bends are predicted the better the more neighbors are asked, noise is not: the least counts.
    """
    path = points.take(curves.indices, axis=0)
    asked = [_deviation(path, curves, each) for each in NEIGHBORS]
    least: FloatArray = np.min(asked, axis=0)
    return least


def _deviation(path: FloatArray, curves: Curves, asked: int) -> FloatArray:
    """Return it for so many neighbors on either side, as if at equal steps on a polynomial."""
    differences = np.array([(-1) ** k * math.comb(2 * asked, k) for k in range(2 * asked + 1)])
    stencil = differences / differences[asked]
    sizes = np.diff(curves.offsets)
    curve = np.repeat(np.arange(len(sizes)), sizes)
    place = np.arange(len(path)) - curves.offsets[curve]
    has_all = curves.closed[curve] | (place >= asked) & (place < sizes[curve] - asked)
    center = np.flatnonzero(has_all & (sizes[curve] > 2 * asked + 1))
    curve, start = curve[center], curves.offsets[curve[center]]
    steps = np.arange(-asked, asked + 1)
    normal = MEDIAN * float(np.sqrt((stencil**2).sum()))
    deviation = np.empty(len(center))
    for part in in_parts(len(center)):
        near = (place[center[part], None] + steps) % sizes[curve[part], None]
        deviation[part] = _across(path[start[part, None] + near], stencil) / normal
    return _medians(deviation, curve, len(sizes))


def _across(around: FloatArray, stencil: FloatArray) -> FloatArray:
    """Return how far points are from what their neighbors predict, across the curve, in steps."""
    middle = len(stencil) // 2
    error = np.einsum("k,ikj->ij", stencil, around)
    chord = around[:, middle + 1] - around[:, middle - 1]
    length = np.hypot(*chord.T)
    across = np.abs(error[:, 0] * chord[:, 1] - error[:, 1] * chord[:, 0]) / length
    return np.asarray(across / (length / 2))


def _medians(values: FloatArray, group: IntArray, groups: int) -> FloatArray:
    """Return the median of each of successive groups of values, infinity for none."""
    counts = np.bincount(group, minlength=groups)
    first = np.cumsum(counts) - counts
    is_large = counts > PART
    begins = is_large | np.append(False, is_large[:-1]) | (np.diff(first // PART, prepend=-1) > 0)
    ordered = values.copy()
    for a, b in pairwise([*first[begins], len(values)]):
        ordered[a:b] = _in_order(values[a:b], group[a:b])
    has_some = np.flatnonzero(counts)
    low, high = first + (counts - 1) // 2, first + counts // 2
    medians = np.full(groups, np.inf)
    medians[has_some] = (ordered[low[has_some]] + ordered[high[has_some]]) / 2
    return medians


def _in_order(values: FloatArray, group: IntArray) -> FloatArray:
    """Return values ordered within each of some groups; of one alone, only those in the middle."""
    count = len(values)
    if count and group[0] == group[-1]:
        return np.partition(values, ((count - 1) // 2, count // 2))
    return values[np.lexsort((values, group))]


def _strand(delaunay: Delaunay, rows: IntArray, closed: bool) -> Strand:
    owners = np.full(len(delaunay), -1)
    owners[rows] = np.arange(len(rows))
    repeated, first = delaunay.duplicates.T
    owners[repeated] = owners[first]
    own = np.flatnonzero(owners >= 0)
    zero = np.zeros(len(rows))
    vertices = delaunay.points.xy[rows]
    return Strand(vertices, closed, zero, own, owners[own], np.zeros(len(own)), True)


def rest(delaunay: Delaunay, parts: list[Strand]) -> BoolArray:
    """Return which rows belong to none of the parts."""
    is_left = np.ones(len(delaunay), bool)
    for part in parts:
        is_left[part.rows] = False
    return is_left
