"""Curves of points that have no noise to speak of, and so stay as they are."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.curves import trace
from crustline.delaunay import Delaunay
from crustline.denoise.strand import Strand

#: Noise over the spacing up to which points count as clean.
CLEAN = 0.06
#: Points that a ring, and a line, has at least to be judged.
FEWEST = {True: 8, False: 12}
#: How many neighbors on either side predict a point.
NEIGHBORS = (2, 3, 4)
#: The median of the absolute value of a standard normal number.
MEDIAN = 0.6745


def clean_strands(delaunay: Delaunay, method: Callable[..., ArrayLike]) -> list[Strand]:
    """Return the curves, as a method connects the points, whose points are on smooth curves."""
    points = delaunay.points.xy
    found = []
    for curve in trace(delaunay, method(delaunay)):
        if len(curve.indices) < FEWEST[curve.closed]:
            continue
        noise = _noise(points[curve.indices], curve.closed)
        if noise < CLEAN:
            found.append(_strand(delaunay, curve.indices, curve.closed))
    return found


def _noise(path: FloatArray, closed: bool) -> float:
    """Return the deviation of points across their path, in steps, from what neighbors predict.

    Bends are predicted the better the more neighbors are asked, noise is not: the least counts.
    """
    asked = [each for each in NEIGHBORS if len(path) > 2 * each + 1]
    return min(_deviation(path, closed, each) for each in asked)


def _deviation(path: FloatArray, closed: bool, asked: int) -> float:
    """Return it for so many neighbors on either side, as if at equal steps on a polynomial."""
    differences = np.array([(-1) ** k * math.comb(2 * asked, k) for k in range(2 * asked + 1)])
    stencil = differences / differences[asked]
    count = len(path)
    center = np.arange(count) if closed else np.arange(asked, count - asked)
    around = (center[:, None] + np.arange(-asked, asked + 1)) % count
    error = np.einsum("k,ikj->ij", stencil, path[around])
    chord = path[around[:, asked + 1]] - path[around[:, asked - 1]]
    length = np.hypot(*chord.T)
    across = np.abs(error[:, 0] * chord[:, 1] - error[:, 1] * chord[:, 0]) / length
    return float(np.median(across / (length / 2)) / (MEDIAN * np.sqrt((stencil**2).sum())))


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
