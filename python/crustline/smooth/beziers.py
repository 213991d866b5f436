"""Paths of cubic Bézier pieces, rewritten with few pieces within a proven distance.

A run of pieces is replaced by one cubic with the same ends and the same directions there, so that
two handle lengths remain to be chosen; they are fitted to the run by least squares on the distances
along the normals, the parameters of the foot points being improved in turn [1]_. What is accepted
is decided by a bound, not by samples: between two neighboring foot points both the run and the
cubic are cubics, and so is their difference, which lies in the convex hull of its own control
points.

References
----------
.. [1] J. Hoschek, "Intrinsic parametrization for approximation", Computer Aided Geometric Design 5
   (1988), 27–31.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray

__all__ = ["BezierPath", "fewest_pieces"]

#: Foot points of a stretch at the least, each piece of it having one or more. Where so many prove
#: nothing although each of them is near, so many more are tried; they matter for tight tolerances.
_FOOT_POINTS = (32, 256)
#: Foot points that handles are fitted to at the most; the bound regards all.
_MOST_FITTED = 64
#: Projections of all foot points before the bound is taken.
_PROJECTIONS = 2
#: Rounds of fitting the handles and projecting anew. More gain less than one piece in a hundred.
_ROUNDS = 5
#: Weight of distances along the tangent: keeps handles determined where the path is straight.
_TANGENTIAL = 1e-6
#: Handles, as shares of the length of the run.
_SHORTEST, _LONGEST = 0.01, 1.5
#: Pieces that one greedy walk starts with, and the pieces it has to give to be long enough.
_CHUNK, _ENOUGH = 512, 16


@dataclass(frozen=True, eq=False)
class BezierPath:
    """Cubic Bézier pieces end to end, in runs that are smooth within.

    Attributes
    ----------
    control : ndarray of float64, shape (m, 4, 2)
        The control points of every piece, run after run.
    widths : ndarray of float64, shape (m,)
        The interval of the parameter that a piece stands for; by this parameter a run is C1.
    runs : ndarray of int64, shape (r + 1,)
        Run number i is ``control[runs[i]:runs[i + 1]]``. No run is empty.
    """

    control: FloatArray
    widths: FloatArray
    runs: IntArray

    @cached_property
    def knots(self) -> FloatArray:
        """The parameter at the start of every piece, and at the end of the last."""
        return np.concatenate([[0.0], np.cumsum(self.widths)])


@dataclass(frozen=True, eq=False)
class _Feet:
    """Foot points along several stretches of a path, stretch after stretch."""

    owner: IntArray  # the stretch of each
    starts: IntArray  # the first of each stretch
    t: FloatArray
    dt: FloatArray  # to the next one of the same stretch; 0 at the last
    point: FloatArray
    velocity: FloatArray

    @property
    def ends(self) -> IntArray:
        return np.append(self.starts[1:], len(self.t)) - 1

    @cached_property
    def share(self) -> FloatArray:
        """The part of the stretch's parameter interval that lies before each, in [0, 1]."""
        begin, end = self.t[self.starts], self.t[self.ends]
        share: FloatArray = (self.t - begin[self.owner]) / (end - begin)[self.owner]
        return share

    def largest(self, values: FloatArray) -> FloatArray:
        """Return the largest value of each stretch."""
        largest: FloatArray = np.maximum.reduceat(values, self.starts)
        return largest

    def total(self, values: FloatArray) -> FloatArray:
        """Return the sum over each stretch."""
        total: FloatArray = np.add.reduceat(values, self.starts, axis=0)
        return total


def fewest_pieces(path: BezierPath, tolerances: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return a path with few pieces that is nowhere farther than the tolerance from a given one.

    Parameters
    ----------
    path : BezierPath
        What to rewrite.
    tolerances : ndarray of float64, shape (r,)
        The largest distance for each run, in the unit of the path. At least 0.

    Returns
    -------
    control : ndarray of float64, shape (p, 4, 2)
        The pieces, run after run, p ≤ m; each starts and ends where a piece of `path` does.
        Neighbors in a run have the same direction where they meet.
    runs : ndarray of int64, shape (r + 1,)
        Run number i is ``control[runs[i]:runs[i + 1]]``.

    Notes
    -----
    The Hausdorff distance of each new piece to the pieces it replaces is at most the tolerance,
    proven by the convex hull property up to the rounding of float64. Greedy: each piece is as long
    as doubling and halving find, which gives the fewest for pieces of this form if a part of what
    fits, fits. A run of more than 512 pieces is walked from several places at once, which costs at
    most one piece in 16. A piece that fits no other is kept as it is.
    """
    size = _CHUNK
    while True:
        chunks = _split(path.runs, size)
        whole = len(chunks) == len(path.runs)
        limits = tolerances[np.searchsorted(path.runs, chunks[:-1], side="right") - 1]
        first, control = _walk(path, chunks, limits)
        if whole or len(first) >= _ENOUGH * (len(chunks) - 1):
            return control, np.searchsorted(first, path.runs)
        size *= _ENOUGH


def _split(runs: IntArray, size: int) -> IntArray:
    """Return the runs cut into chunks of about equally many pieces, at most `size`."""
    counts = np.diff(runs)
    parts = -(-counts // size)
    number = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    inner = np.repeat(runs[:-1], parts) + number * np.repeat(counts, parts) // np.repeat(
        parts, parts
    )
    return np.append(inner, runs[-1])


def _walk(path: BezierPath, chunks: IntArray, limits: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return for each new piece the first piece it replaces, sorted, and its control points."""
    at, ends = chunks[:-1], chunks[1:]
    stride = np.full(len(at), 2)
    firsts, controls = [at[:0]], [path.control[:0]]
    while len(at):
        stops, control = _longest(path, at, ends, limits, stride)
        firsts.append(at)
        controls.append(control)
        left = stops < ends
        stride = np.maximum(stops - at, 2)[left]
        at, ends, limits = stops[left], ends[left], limits[left]
    first = np.concatenate(firsts)
    order = np.argsort(first)
    return first[order], np.concatenate(controls)[order]


def _longest(
    path: BezierPath, at: IntArray, ends: IntArray, limits: FloatArray, stride: IntArray
) -> tuple[IntArray, FloatArray]:
    """Return how far one cubic from each of the places `at` can reach, and the cubic."""
    good, bad = at + 1, ends + 1  # one piece always fits itself
    best = path.control[at]
    trial = np.minimum(at + stride, ends)
    open_ = np.flatnonzero(bad - good > 1)
    while len(open_):
        control, fits = _fit(path, at[open_], trial[open_], limits[open_])
        longer, shorter = open_[fits], open_[~fits]
        good[longer], bad[shorter] = trial[longer], trial[shorter]
        best[longer] = control[fits]
        doubled = np.minimum(2 * good - at, ends)
        trial = np.where(bad > ends, doubled, (good + bad) // 2)
        open_ = np.flatnonzero(bad - good > 1)
    return good, best


def _fit(
    path: BezierPath, first: IntArray, last: IntArray, limits: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Return a cubic for each stretch of pieces first to last - 1, and whether it is near."""
    with np.errstate(all="ignore"):  # a stretch without a direction gives NaN, which fits nothing
        feet = _feet(path, first, last, _FOOT_POINTS[0], _MOST_FITTED)
        cubic, u = _fitted(path, first, last, feet)
        point, _ = _evaluate(cubic[feet.owner], u)
        fits = feet.largest(_size(point - feet.point)) <= limits
        proven = np.zeros(len(first), bool)
        for least in _FOOT_POINTS:
            some = np.flatnonzero(fits & ~proven)
            if len(some):
                dense = _feet(path, first[some], last[some], least)
                # A new foot point begins between those that the handles were fitted to.
                start = np.interp(some[dense.owner] + dense.share, feet.owner + feet.share, u)
                proven[some] = _bound(dense, cubic[some], start) <= limits[some]
        return cubic, proven


def _fitted(
    path: BezierPath, first: IntArray, last: IntArray, feet: _Feet
) -> tuple[FloatArray, FloatArray]:
    """Return the cubics of least squares, and the parameters nearest to the foot points."""
    begin, end = path.control[first], path.control[last - 1]
    directions = np.stack([_unit(begin[:, 1] - begin[:, 0]), _unit(end[:, 3] - end[:, 2])])
    length = _lengths(feet)
    speed = np.stack([_size(feet.velocity[feet.starts]), _size(feet.velocity[feet.ends])])
    handles = speed * (feet.t[feet.ends] - feet.t[feet.starts]) / 3
    u = feet.share
    for _ in range(_ROUNDS):
        cubic = _cubic(begin[:, 0], end[:, 3], directions, handles)
        u = _projected(feet, cubic, u)
        handles = handles + _correction(feet, cubic, directions, u)
        handles = np.clip(handles, _SHORTEST * length, _LONGEST * length)
    cubic = _cubic(begin[:, 0], end[:, 3], directions, handles)
    return cubic, _projected(feet, cubic, u)


def _feet(
    path: BezierPath, first: IntArray, last: IntArray, least: int, most: int | None = None
) -> _Feet:
    """Return foot points: the ends of every piece, and others between them if those are few.

    With `most`, a stretch of more foot points gets that many of them, and one at its end.
    """
    parts = -(-least // (last - first))
    steps = (last - first) * parts
    kept = steps if most is None else np.minimum(steps, most)
    starts = np.cumsum(kept + 1) - (kept + 1)
    owner = np.repeat(np.arange(len(first)), kept + 1)
    number = (np.arange(len(owner)) - starts[owner]) * steps[owner] // kept[owner]
    piece = np.minimum(first[owner] + number // parts[owner], last[owner] - 1)
    s = (number - (piece - first[owner]) * parts[owner]) / parts[owner]
    width = path.widths[piece]
    point, velocity = _evaluate(path.control[piece], s)
    dt = width / parts[owner]
    dt[starts + kept] = 0.0
    t = path.knots[piece] + s * width
    return _Feet(owner, starts, t, dt, point, velocity / width[:, None])


def _evaluate(control: FloatArray, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the points and the derivatives of cubics (k, 4, 2), each at its own s (k,)."""
    s, z = s[:, None], 1 - s[:, None]
    a, b, c, d = np.moveaxis(control, 1, 0)
    point = z * z * (z * a + 3 * s * b) + s * s * (3 * z * c + s * d)
    return point, 3 * (z * z * (b - a) + 2 * s * z * (c - b) + s * s * (d - c))


def _cubic(
    begin: FloatArray, end: FloatArray, directions: FloatArray, handles: FloatArray
) -> FloatArray:
    arms = directions * handles[..., None]
    return np.stack([begin, begin + arms[0], end - arms[1], end], axis=1)


def _lengths(feet: _Feet) -> FloatArray:
    steps = np.diff(feet.point, axis=0, append=feet.point[-1:])
    steps[feet.ends] = 0
    return feet.total(_size(steps))


def _projected(feet: _Feet, cubic: FloatArray, u: FloatArray) -> FloatArray:
    """Return the parameters on the cubics after one Gauss–Newton step to the nearest points."""
    point, slope = _evaluate(cubic[feet.owner], u)
    moved = u - _dot(point - feet.point, slope) / _dot(slope, slope)
    moved = np.clip(moved, 0.0, 1.0)
    moved[feet.starts], moved[feet.ends] = 0.0, 1.0
    return moved


def _correction(
    feet: _Feet, cubic: FloatArray, directions: FloatArray, u: FloatArray
) -> FloatArray:
    """Return what to add to the two handles of each cubic: the least-squares step, shape (2, q)."""
    point, slope = _evaluate(cubic[feet.owner], u)
    tangent = _unit(slope)
    ahead = (3 * u * (1 - u) ** 2)[:, None] * directions[0][feet.owner]
    behind = (-3 * u * u * (1 - u))[:, None] * directions[1][feet.owner]
    a, b, r = (
        np.stack([_cross(tangent, each), _TANGENTIAL**0.5 * _dot(tangent, each)])
        for each in (ahead, behind, point - feet.point)
    )
    products = [a * a, a * b, b * b, a * r, b * r]
    aa, ab, bb, ar, br = feet.total(np.stack([each.sum(axis=0) for each in products], axis=1)).T
    determinant = aa * bb - ab * ab
    step: FloatArray = np.stack([ab * br - bb * ar, ab * ar - aa * br]) / determinant
    return step


def _bound(feet: _Feet, cubic: FloatArray, u: FloatArray) -> FloatArray:
    """Return for each stretch the largest control point of the difference of path and cubic."""
    for _ in range(_PROJECTIONS):
        u = _projected(feet, cubic, u)
    point, slope = _evaluate(cubic[feet.owner], u)
    gap = point - feet.point
    dt = feet.dt[:-1, None]
    du = np.where(dt > 0, np.diff(u)[:, None], 0.0)
    ahead = gap[:-1] + (slope[:-1] * du - feet.velocity[:-1] * dt) / 3
    behind = gap[1:] - (slope[1:] * du - feet.velocity[1:] * dt) / 3
    sizes = _size(gap)
    sizes[:-1] = np.maximum(sizes[:-1], _size(ahead))
    sizes[1:] = np.maximum(sizes[1:], _size(behind))
    return feet.largest(sizes)


def _size(vectors: FloatArray) -> FloatArray:
    size: FloatArray = np.hypot(vectors[..., 0], vectors[..., 1])
    return size


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    product: FloatArray = a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]
    return product


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    product: FloatArray = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product


def _unit(vectors: FloatArray) -> FloatArray:
    unit: FloatArray = vectors / np.hypot(vectors[:, :1], vectors[:, 1:])
    return unit
