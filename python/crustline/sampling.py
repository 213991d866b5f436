"""The paper's sampling condition (§5): each point p of a curve within r · LFS(p) of a sample.

`r_sample` makes such samples, `sampling_ratio` finds the smallest r of given ones, `thin` drops the
samples that a reconstruction does not need, `sample_for_error` follows the note after Theorem 13.
"""

from __future__ import annotations

import math
from array import array
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from crustline.arrays import as_edges, as_points
from crustline.errors import InputError
from crustline.feature_size import local_feature_size, medial_axis_of_curve, nearest_site
from crustline.scalars import as_positive, as_rtol, as_share, as_whole
from crustline.shapes import SmoothCurve

__all__ = ["Sample", "is_r_sample", "r_sample", "sample_for_error", "sampling_ratio", "thin"]

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
Allowance = Callable[[FloatArray], FloatArray]
Mode = Literal["sparsest", "random"]

# The paper's r for the crust (Theorem 15).
GUARANTEED = 0.252
# Steps are made shorter by this share, so that the proof by `sampling_ratio`, whose own error is
# 1e-4, goes through.
MARGIN = 3e-4
# Random steps are at least this share of the longest step.
SHORTEST_STEP = 0.5
MOST_ROUNDS = 60
# Samples and arcs at the most: they need a few minutes and two gigabytes.
MOST_SAMPLES = 1_000_000
MOST_ARCS = 1 << 23
# Beyond this many edges a step, thinning strides instead of looking at every sample as a start.
MOST_SERVED = 150
# What sums of the lengths of edges may be wrong by, as a share, and more.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Sample:
    """Samples of a smooth curve, in order along each of its loops.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 2)
        The samples. The object itself serves as an array of points in every function of crustline.
    t : ndarray of float64, shape (n,)
        Where on the curve they are.
    edges : ndarray of int64, shape (n, 2)
        The polygonal reconstruction (paper, §2): the pairs adjacent along the curve, i < j, rows
        sorted.

    Examples
    --------
    >>> from crustline.shapes import circle
    >>> sample = r_sample(circle(), 0.25)
    >>> len(sample), sample.edges[0].tolist(), np.asarray(sample).shape
    (13, [0, 1], (13, 2))
    """

    points: FloatArray
    t: FloatArray
    edges: IntArray

    def __len__(self) -> int:
        return len(self.points)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """Return the points."""
        return np.array(self.points, dtype=dtype, copy=copy)


def r_sample(
    curve: SmoothCurve, r: float, seed: int | None = None, mode: Mode = "sparsest"
) -> Sample:
    """Return samples of a smooth curve such that each of its points p has one within r · LFS(p).

    Parameters
    ----------
    curve : SmoothCurve
        What to sample; each of its loops gets samples.
    r : float
        In (0, 1], the paper's range. Below 0.252 the crust of the samples is sure to reconstruct
        the curve.
    seed : int, optional
        Seeds `numpy.random.default_rng`, which draws where each loop's first sample lies, and the
        random steps. With None each loop starts at its t = 0, and random steps differ from call to
        call.
    mode : {"sparsest", "random"}
        "sparsest": each step along the curve is as long as the condition allows, and the last one
        of a loop what is left. "random": each step is between half and the whole of that,
        uniformly.

    Returns
    -------
    sample : Sample
        Points, their t, and the true edges.

    Raises
    ------
    InputError
        If r is not in (0, 1], the mode has another name, the seed is no whole number from 0 on, the
        curve crosses itself, or it needs more than 1,000,000 samples.

    Notes
    -----
    The result is proven against the definition over the whole curve, not only at the
    samples: `sampling_ratio(curve, sample) <= r` holds. Steps are up to 0.03 % shorter than the
    longest possible for that. The sparsest sample of a loop has at most one point more than any in
    which each point of the loop is served by one of its two neighbors along the loop. An ellipse
    whose axes have the ratio a ≫ 1 needs about πa/r samples. A sample takes about 0.2 ms.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125–135. Section 5.

    Examples
    --------
    >>> from crustline.shapes import ellipse
    >>> [len(r_sample(ellipse(2, 1), r)) for r in (0.2, 0.5, 1.0)]
    [34, 14, 7]
    """
    r = as_share("r", r)
    return _sample(curve, lambda lfs: r * lfs, r, seed, mode)


def sample_for_error(
    curve: SmoothCurve,
    d: float,
    *,
    r: float = GUARANTEED,
    seed: int | None = None,
    mode: Mode = "sparsest",
) -> Sample:
    """Return samples whose polygonal reconstruction stays within the distance d of the curve.

    Parameters
    ----------
    curve : SmoothCurve
        What to sample.
    d : float
        The largest distance allowed from a point of the curve to the reconstruction, in the units
        of the curve.
    r : float
        In (0, 1]. The samples are also an r-sample. The default is the r for which the paper proves
        that the crust finds the reconstruction (Theorem 15); a larger one gives fewer samples where
        d is large.
    seed, mode
        As for `r_sample`.

    Returns
    -------
    sample : Sample
        Points, their t, and the true edges.

    Raises
    ------
    InputError
        If d is not positive and finite, or as for `r_sample`.

    Notes
    -----
    The note after Theorem 13: a sample within √(2 d LFS(p)) of every point p keeps the
    reconstruction within d. Where that is more than r · LFS(p), the latter holds. Proven over the
    whole curve, as for `r_sample`.

    Examples
    --------
    >>> from crustline.shapes import circle
    >>> [len(sample_for_error(circle(), d)) for d in (1e-1, 1e-3, 1e-5)]
    [13, 71, 703]
    """
    r = as_share("r", r)
    d = as_positive("d", d)
    return _sample(curve, lambda lfs: np.minimum(np.sqrt(2 * d * lfs), r * lfs), r, seed, mode)


def sampling_ratio(curve: SmoothCurve, points: npt.ArrayLike, *, rtol: float = 1e-4) -> float:
    """Return the smallest r for which points r-sample the curve: sup dist(p, S) / LFS(p).

    Parameters
    ----------
    curve : SmoothCurve
        All its components must be sampled.
    points : array_like of float, shape (n, 2)
        The samples, in any order. Samples off the curve count with their true distance.
    rtol : float
        In [1e-6, 0.1]. How much too large, relatively, the result may be.

    Returns
    -------
    r : float
        At least the supremum, and at most 1 + rtol times it, but for the error of the local feature
        size, which is computed with the same rtol (in closed form for one circle, ellipse or
        stadium).

    Raises
    ------
    InputError
        If there are no points, or they are not (n, 2) and finite, or the curve crosses itself.

    Notes
    -----
    Branch and bound: between two points of the curve an arc of length a apart the
    distance to the samples grows by at most a, and the local feature size shrinks by at most a,
    since both are 1-Lipschitz. Arcs that could still hold a larger ratio are halved.

    Examples
    --------
    >>> from crustline.shapes import circle, regular_polygon
    >>> round(sampling_ratio(circle(), regular_polygon(6)), 3), round(2 * math.sin(math.pi / 12), 3)
    (0.518, 0.518)
    """
    rtol = as_rtol(rtol)
    sites = as_points(points)
    if not len(sites):
        raise InputError("points is empty: no points sample no curve")
    return _supremum(curve, sites, lambda lfs: lfs, 1.0, rtol)


def is_r_sample(curve: SmoothCurve, points: npt.ArrayLike, r: float) -> bool:
    """Return whether each point p of the curve has one of points within r · LFS(p).

    Notes
    -----
    True is sure, up to the error of the local feature size; False may be wrong if r is less than
    0.01 % above the true ratio. See `sampling_ratio`.

    Examples
    --------
    >>> from crustline.shapes import circle, regular_polygon
    >>> hexagon = regular_polygon(6)
    >>> is_r_sample(circle(), hexagon, 0.52), is_r_sample(circle(), hexagon, 0.51)
    (True, False)
    """
    return sampling_ratio(curve, points) <= as_positive("r", r)


def thin(points: npt.ArrayLike, edges: npt.ArrayLike, r: float) -> IntArray:
    """Return the samples to keep: the fewest that still r-sample the reconstruction.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Samples, dense ones.
    edges : array_like of int, shape (m, 2)
        Their reconstruction, for instance their crust.
    r : float
        In (0, 1]. For r = 0.2 the crust of what is kept is in general the same curve, drawn with
        fewer points.

    Returns
    -------
    kept : ndarray of int64, shape (k,)
        Rows of `points`, sorted. Isolated points, endpoints and branches are always kept, and at
        least three points of each ring.

    Raises
    ------
    InputError
        If r is not in (0, 1], or the edges do not fit the points.

    Notes
    -----
    Every point p of the edges has a kept point within r · LFS(p), one of the two next to p along
    its curve; between the samples LFS is taken as low as a 1-Lipschitz function can be, and the
    distance to a kept point as large as a convex one. Where the samples themselves are not dense
    enough for that, all of them are kept. Of all choices with that property, one of the fewest,
    except on rings that r would leave with less than three points, and on curves from which more
    than a hundred samples are dropped for each one kept: those may keep one more. LFS is that of
    the reconstruction, estimated from the samples (`local_feature_size(points, edges)`), not that
    of the unknown curve. The time is proportional to the number of samples and, up to that
    hundred, to the number of them in a step.

    Examples
    --------
    A circle of a hundred points needs fifteen of them for r = 0.25:

    >>> from crustline import crust
    >>> from crustline.shapes import regular_polygon
    >>> points = regular_polygon(100)
    >>> len(thin(points, crust(points), 0.25))
    15
    """
    from crustline.curves import trace

    r = as_share("r", r)
    rows = as_points(points)
    pairs = as_edges(edges, len(rows))
    if not len(pairs):
        return np.arange(len(rows))
    extent = float(np.ptp(rows, axis=0).max())
    lfs = np.minimum(local_feature_size(rows, pairs), 8 * extent / r)
    curves = trace(rows, pairs)
    kept = [np.asarray(curves.isolated, dtype=np.int64)]
    for curve in curves:
        i = np.asarray(curve.indices, dtype=np.int64)
        kept.append(i[_thinned(rows[i], lfs[i], r, bool(curve.closed))])
    return np.unique(np.concatenate(kept))


# Sampling: the longest steps, from tables.


def _sample(
    curve: SmoothCurve, allowance: Allowance, r: float, seed: int | None, mode: Mode
) -> Sample:
    """Return a sample with a point within allowance(LFS(p)), r-Lipschitz, of each p."""
    if mode not in ("sparsest", "random"):
        raise InputError(f'mode must be "sparsest" or "random", not {mode!r}')
    seed = None if seed is None else as_whole("seed", seed, 0)
    walks = [_Walk(table) for table in _tables(curve, allowance)]
    share = 1 - MARGIN
    for _ in range(MOST_ROUNDS):
        rng = np.random.default_rng(seed)
        starts = np.zeros(len(walks)) if seed is None else rng.random(len(walks))
        steps = None if mode == "sparsest" else rng
        loops = [walk.samples(u, share, steps) for walk, u in zip(walks, starts, strict=True)]
        sample = _assembled(curve, loops)
        excess = _supremum(curve, sample.points, allowance, r, 1e-4)
        if excess <= 1:
            return sample
        # For r near 1 the curve may come back towards a sample, which the walk does not foresee.
        share *= 0.999 / max(excess, 1.0)
    raise InputError(f"no sample was found for r = {r}: try a smaller r")


def _assembled(curve: SmoothCurve, loops: list[FloatArray]) -> Sample:
    t = np.concatenate([(i + u) / len(loops) for i, u in enumerate(loops)])
    edges, start = [], 0
    for loop in loops:
        i = start + np.arange(len(loop))
        edges.append(np.sort(np.stack([i, np.roll(i, -1)], -1), axis=1))
        start += len(loop)
    pairs = np.unique(np.concatenate(edges), axis=0)
    return Sample(curve.point(t), t, pairs[pairs[:, 0] < pairs[:, 1]])


# The columns of a table: the parameter, the point, the velocity by the parameter, the allowance.
T, X, Y, VX, VY, A = range(6)


def _tables(curve: SmoothCurve, allowance: Allowance) -> list[FloatArray]:
    """Return for each loop rows (k, 6) so close that they can be interpolated; it closes."""
    axis, c = medial_axis_of_curve(curve), len(curve.loops)

    def rows(i: int, u: FloatArray) -> FloatArray:
        p, velocity, _ = curve.derivatives((i + u % 1.0) / c)
        return np.column_stack([u, p, velocity, allowance(axis.distance(p))])

    tables = []
    for i, loop in enumerate(curve.loops):
        table = rows(i, np.linspace(0.0, 1.0, 128 * loop.pieces + 1))
        left = np.arange(len(table) - 1)
        for _ in range(MOST_ROUNDS // 2):
            _refuse_too_many(table)
            middle = rows(i, (table[left, T] + table[left + 1, T]) / 2)
            bad = _badly_interpolated(table, left, middle)
            if not bad.any():
                break
            table = np.insert(table, left[bad] + 1, middle[bad], axis=0)
            first = left[bad] + np.arange(int(bad.sum()))
            left = np.sort(np.concatenate([first, first + 1]))
        tables.append(table)
    return tables


def _refuse_too_many(table: FloatArray) -> None:
    """Refuse a loop that surely needs too many samples: at least ∫ ds / 2A, A being Lipschitz."""
    chord = np.hypot(*np.diff(table[:, X : Y + 1], axis=0).T)
    most = np.maximum(table[1:, A], table[:-1, A]) + chord / 2
    least = float((chord / (2 * most)).sum())
    if least > MOST_SAMPLES:
        raise InputError(
            f"the curve needs more than {MOST_SAMPLES:,} samples, the most that are made: "
            "choose a larger r or error, or a curve whose features are larger beside its length"
        )


def _badly_interpolated(
    table: FloatArray, left: IntArray, middle: FloatArray
) -> npt.NDArray[np.bool_]:
    """Return whether the rows in the middle of intervals differ from what their ends say."""
    p, q = table[left], table[left + 1]
    h = (q[:, T] - p[:, T])[:, None]
    hermite = (p[:, X : Y + 1] + q[:, X : Y + 1]) / 2 + h * (
        p[:, VX : VY + 1] - q[:, VX : VY + 1]
    ) / 8
    off = np.hypot(*(hermite - middle[:, X : Y + 1]).T)
    bad = off > 1e-6 * middle[:, A]
    bad |= np.abs((p[:, A] + q[:, A]) / 2 - middle[:, A]) > 3e-5 * middle[:, A]
    # A step must see several rows, or it might jump over a part of the curve.
    return np.asarray(bad | (np.hypot(*(q - p)[:, X : Y + 1].T) > middle[:, A] / 4))


class _Walk:
    """Steps along one loop, from its table, rolled out twice so that a walk never wraps round."""

    def __init__(self, table: FloatArray) -> None:
        again = table[1:].copy()
        again[:, T] += 1.0
        # Arrays of numbers take a fifth of the memory of lists, and no more time.
        columns = np.vstack([table, again]).T
        self.columns: list[array[float]] = [array("d", column) for column in columns]

    def samples(self, start: float, share: float, random: np.random.Generator | None) -> FloatArray:
        """Return u in [0, 1) of samples from start on, in order along the loop."""
        here, samples = start, [start]
        while (ahead := self._reach(self._served(here, share), share)) < start + 1:
            if random is not None:
                ahead = here + (ahead - here) * random.uniform(SHORTEST_STEP, 1.0)
            samples.append(ahead)
            here = ahead
        return np.array(samples) % 1.0

    def _served(self, u: float, share: float) -> float:
        """Return the first point after the sample at u that is too far from it."""
        x, y, _ = self._at(u)

        def excess(v: float) -> float:
            px, py, allowance = self._at(v)
            return math.hypot(px - x, py - y) - share * allowance

        _, xs, ys, _, _, allowances = self.columns
        return self._first(
            u, excess, lambda k: math.hypot(xs[k] - x, ys[k] - y) - share * allowances[k]
        )

    def _reach(self, u: float, share: float) -> float:
        """Return the first point after u whose sample would not serve u."""
        x, y, allowance = self._at(u)
        limit = share * allowance

        def excess(v: float) -> float:
            px, py, _ = self._at(v)
            return math.hypot(px - x, py - y) - limit

        _, xs, ys, *_ = self.columns
        return self._first(u, excess, lambda k: math.hypot(xs[k] - x, ys[k] - y) - limit)

    def _first(
        self, u: float, excess: Callable[[float], float], at_row: Callable[[int], float]
    ) -> float:
        """Return the first v after u where excess turns positive: at the rows, then between."""
        t = self.columns[T]
        k = bisect_right(t, u)
        while k < len(t) and at_row(k) <= 0:
            k += 1
        if k == len(t):
            return math.inf
        low, high = max(u, t[k - 1]), t[k]
        for _ in range(18):
            middle = (low + high) / 2
            low, high = (middle, high) if excess(middle) <= 0 else (low, middle)
        return low

    def _at(self, u: float) -> tuple[float, float, float]:
        """Return the point and the allowance at u."""
        t, x, y, vx, vy, a = self.columns
        if u >= t[-1]:
            return x[-1], y[-1], a[-1]
        i = bisect_right(t, u) - 1
        h = t[i + 1] - t[i]
        v = (u - t[i]) / h
        w = 1 - v
        # Cubic Hermite interpolation.
        p, q = w * w * (1 + 2 * v), v * v * (1 + 2 * w)
        m, n = h * v * w * w, -h * v * v * w
        return (
            p * x[i] + q * x[i + 1] + m * vx[i] + n * vx[i + 1],
            p * y[i] + q * y[i + 1] + m * vy[i] + n * vy[i + 1],
            w * a[i] + v * a[i + 1],
        )


# The sampling ratio: branch and bound.


def _supremum(
    curve: SmoothCurve, sites: FloatArray, allowance: Allowance, lipschitz: float, rtol: float
) -> float:
    """Return the supremum of dist(p, sites) / allowance(LFS(p)), or 1 + rtol times it."""
    axis = medial_axis_of_curve(curve, rtol=min(rtol, 1e-4))

    def measured(t: FloatArray) -> FloatArray:
        p = curve.point(t)
        lfs = axis.distance(p)
        return np.column_stack([t, p, nearest_site(p, sites)[0], allowance(lfs), lfs])

    left, right = _arcs(curve, measured)
    best, result = float((left[:, 3] / left[:, 4]).max()), 0.0
    for _ in range(MOST_ROUNDS):
        bound = _arc_bound(left, right, lipschitz)
        alive = bound > best * (1 + rtol)
        result = max(result, float(bound[~alive].max(initial=0.0)))
        if not alive.any():
            break
        left, right = left[alive], right[alive]
        middle = measured((left[:, 0] + right[:, 0]) / 2)
        best = max(best, float((middle[:, 3] / middle[:, 4]).max()))
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
    else:
        result = max(result, float(bound.max()))
    return max(best, result)


def _arcs(
    curve: SmoothCurve, measured: Callable[[FloatArray], FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Return the ends of arcs that cover the curve, each shorter than a quarter of LFS."""
    c = len(curve.loops)
    lefts, rights = [], []
    for i, loop in enumerate(curve.loops):
        k = 64 * loop.pieces
        # The loop's end is not t = (i + 1)/c, which begins the next loop; it is just below.
        t = np.append((i + np.arange(k) / k) / c, np.nextafter((i + 1) / c, 0))
        ends = measured(t)
        left, right = ends[:-1], ends[1:]
        for _ in range(MOST_ROUNDS):
            chord = np.hypot(*(left - right)[:, 1:3].T)
            _refuse_too_long(chord, np.maximum(left[:, 5], right[:, 5]))
            wide = chord > np.minimum(left[:, 5], right[:, 5]) / 4
            if not wide.any():
                break
            middle = measured((left[wide, 0] + right[wide, 0]) / 2)
            left = np.concatenate([left[~wide], left[wide], middle])
            right = np.concatenate([right[~wide], middle, right[wide]])
        lefts.append(left)
        rights.append(right)
    return np.concatenate(lefts), np.concatenate(rights)


def _refuse_too_long(chord: FloatArray, lfs: FloatArray) -> None:
    """Refuse a curve that needs too many arcs, from the chords of some and LFS at their ends."""
    least = float((4 * chord / (lfs + chord / 2)).sum())
    if least > MOST_ARCS:
        raise InputError(
            f"the curve is more than {MOST_ARCS // 4:,} times as long as its local feature size, "
            "the most that is measured: give a curve whose features are larger beside its length"
        )


def _arc_bound(left: FloatArray, right: FloatArray, lipschitz: float) -> FloatArray:
    """Bound the ratio on arcs from their ends (t, x, y, distance, allowance, LFS)."""
    chord = np.hypot(*(left - right)[:, 1:3].T)
    lfs = np.minimum(left[:, 5], right[:, 5])
    # The radius of curvature is at least LFS, which on the arc is at least 2/3 of that at its ends:
    # so the arc is no longer than that of a circle of that radius on the same chord, 2 R asin(chord
    # / 2R) ≤ chord (1 + chord² / 20 R²).
    arc = chord * (1 + 0.12 * (chord / lfs) ** 2)
    distance = (left[:, 3] + right[:, 3] + arc) / 2
    least = (left[:, 4] + right[:, 4] - lipschitz * arc) / 2
    return np.where(least > 0, distance / np.where(least > 0, least, 1.0), np.inf)


# Thinning: the longest steps over samples.


def _thinned(points: FloatArray, lfs: FloatArray, r: float, closed: bool) -> IntArray:
    """Return the positions to keep of one traced curve."""
    k = len(points)
    if k <= 3:
        return np.arange(k)
    ahead = _served_edges(points, lfs, r, closed)
    if ahead is None:
        return _Strides(points, lfs, r, closed).kept()
    behind = _served_edges(points[::-1], lfs[::-1], r, closed)
    if behind is None:
        return _Strides(points, lfs, r, closed).kept()
    behind = behind[::-1]
    own = np.arange(k)
    if not closed:
        return _chain(_farthest(own + ahead, own - behind).tolist(), 0, k - 1)
    twice = np.arange(2 * k)
    steps = _farthest(twice + np.tile(ahead, 2), twice - np.tile(behind, 2))[:k] - own
    # No step longer than a third of the ring, or fewer than three points might be left of it.
    steps = np.clip(steps, 1, k // 3)
    following = np.concatenate([own + steps, own + steps + k]).tolist()
    # The fewest points of all have one within the first step.
    rings = (_chain(following, start, start + k)[:-1] for start in range(int(steps[0])))
    return np.sort(min(rings, key=len) % k)


def _chain(following: list[int], start: int, end: int) -> IntArray:
    """Return start, what follows it, and so on, and in the end the end."""
    chain = [start]
    while (ahead := following[chain[-1]]) < end:
        chain.append(ahead)
    return np.array([*chain, end], dtype=np.int64)


def _farthest(reach: npt.NDArray[Any], need: npt.NDArray[Any]) -> IntArray:
    """Return for each i the largest j > i with need[j] ≤ reach[i]: they serve all between."""
    lowest = np.minimum.accumulate(need[::-1])[::-1]
    farthest = np.searchsorted(lowest, reach, side="right") - 1
    return np.maximum(farthest, np.arange(len(reach)) + 1).astype(np.int64)


def _served_edges(points: FloatArray, lfs: FloatArray, r: float, closed: bool) -> FloatArray | None:
    """Return how many edges ahead of each position are within its reach, the last in part.

    None if that would be more than MOST_SERVED for the average position.
    """
    k = len(points)
    edges = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    last = k if closed else k - 1
    served = _surely_served(edges, lfs, r, closed)
    part = np.zeros(k)
    active = np.arange(last)
    while len(active := active[served[active] < (last if closed else last - active)]):
        if served.sum() > MOST_SERVED * k:
            return None
        near = (active + served[active]) % k
        part[active] = _served_part(points, lfs, edges, r, active, near)
        active = active[part[active] >= 1]
        served[active] += 1
        part[active] = 0.0
    return None if served.sum() > MOST_SERVED * k else served + part


def _surely_served(edges: FloatArray, lfs: FloatArray, r: float, closed: bool) -> IntArray:
    """Return how many edges ahead of each position are surely within its reach: way ≤ room.

    More than MOST_SERVED may be left out.
    """
    k, room = len(edges), _room(edges, lfs, r)
    if not closed:
        room[-1] = -1.0  # the edge from the end to the start is none
    # Row b: the least room of the 2^b edges ahead of each position, and their length.
    rooms, lengths = [room], [edges]
    while 2 ** len(rooms) <= min(4 * MOST_SERVED, k - 1):
        half = 2 ** (len(rooms) - 1)
        rooms.append(np.minimum(rooms[-1], np.roll(rooms[-1], -half)))
        lengths.append(lengths[-1] + np.roll(lengths[-1], -half))
    served, way, least = np.zeros(k, dtype=np.int64), np.zeros(k), np.full(k, np.inf)
    own = np.arange(k)
    for b in range(len(rooms) - 1, -1, -1):
        at = (own + served) % k
        farther, less = way + lengths[b][at], np.minimum(least, rooms[b][at])
        near = (farther <= less) & (served + 2**b < k)
        served += near * 2**b
        way, least = np.where(near, farther, way), np.where(near, less, least)
    return served


def _room(edges: FloatArray, lfs: FloatArray, r: float) -> FloatArray:
    """Return a bound for r · LFS along each edge: LFS falls by half the edge from an end, at most.

    A sample is at most as far as the way to it along the edges.
    """
    room: FloatArray = r * (np.minimum(lfs, np.roll(lfs, -1)) - edges / 2) * (1 - ROUNDING)
    return room


class _Strides:
    """Longest steps along one curve so dense that most samples need not be looked at."""

    def __init__(self, points: FloatArray, lfs: FloatArray, r: float, closed: bool) -> None:
        self.r, self.closed, self.k = r, closed, len(points)
        self.ahead = _Direction(points, lfs, r)
        self.behind = _Direction(points[::-1], lfs[::-1], r)

    def kept(self) -> IntArray:
        """Return the positions to keep, from position 0 on."""
        end = self.k if self.closed else self.k - 1
        longest = self.k // 3 if self.closed else self.k
        chain = [0]
        while (ahead := min(self._step(chain[-1]), chain[-1] + longest)) < end:
            chain.append(ahead)
        return np.array(chain if self.closed else [*chain, end], dtype=np.int64)

    def _step(self, i: int) -> int:
        """Return the largest j found that serves, with i, all between them."""
        reach = i + self._served(self.ahead, i)
        good, width = max(i + 1, math.floor(reach)), 1
        while self._serves(bad := good + width, reach) and bad - i < self.k:
            good, width = bad, 2 * width
        while bad - good > 1:
            middle = (good + bad) // 2
            good, bad = (middle, bad) if self._serves(middle, reach) else (good, middle)
        return good

    def _serves(self, j: int, reach: float) -> bool:
        """Return whether the sample at j serves all from reach on to itself."""
        if not self.closed and j >= self.k:
            return False
        return j - self._served(self.behind, self.k - 1 - j % self.k) <= reach

    def _served(self, way: _Direction, i: int) -> float:
        """Return how many edges on from position i are within its reach."""
        i %= self.k
        count = self.k if self.closed else self.k - 1 - i
        done, width = way.surely_served(i, count), 256
        while done < count:
            near = (i + np.arange(done, min(done + width, count))) % self.k
            part = _served_part(way.points, way.lfs, way.edges, self.r, np.full(len(near), i), near)
            short = np.flatnonzero(part < 1)
            if len(short):
                return done + int(short[0]) + float(part[short[0]])
            done, width = done + len(near), 2 * width
        return float(count)


class _Direction:
    """The samples of a curve in one of its two directions."""

    def __init__(self, points: FloatArray, lfs: FloatArray, r: float) -> None:
        self.points, self.lfs = points, lfs
        self.edges = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
        self.room = _room(self.edges, lfs, r)

    def surely_served(self, i: int, count: int) -> int:
        """Return how many of `count` edges on from position i are surely within its reach."""
        done, width, way, least = 0, 1024, 0.0, np.inf
        while done < count:
            near = (i + np.arange(done, min(done + width, count))) % len(self.edges)
            ways = way + np.cumsum(self.edges[near])
            rooms = np.minimum(least, np.minimum.accumulate(self.room[near]))
            short = np.flatnonzero(ways > rooms)
            if len(short):
                return done + int(short[0])
            way, least = float(ways[-1]), float(rooms[-1])
            done, width = done + len(near), 2 * width
        return count


def _served_part(
    points: FloatArray, lfs: FloatArray, edges: FloatArray, r: float, i: IntArray, near: IntArray
) -> FloatArray:
    """Return the share of the edge after `near` that is within r · LFS of the samples i.

    Along the edge the distance to a sample is convex, so at most linear between its ends; LFS falls
    from either end with slope at most 1, so it is least where the two slopes meet.
    """
    far = (near + 1) % len(points)
    length = edges[near]
    start, end = (np.hypot(*(points[at] - points[i]).T) for at in (near, far))
    slope = (end - start) / np.where(length > 0, length, 1.0)
    trough = np.clip((length + lfs[near] - lfs[far]) / 2, 0.0, length)
    falling = _first_excess(r * lfs[near] - start, -r - slope, trough)
    at_trough = r * np.maximum(lfs[near] - trough, lfs[far] - (length - trough))
    rising = _first_excess(at_trough - (start + slope * trough), r - slope, length - trough)
    reached = np.where(falling < trough, falling, trough + rising)
    return np.where(length > 0, reached / np.where(length > 0, length, 1.0), 1.0)


def _first_excess(room: FloatArray, growth: FloatArray, length: FloatArray) -> FloatArray:
    """Return how far along `length` the room, which grows linearly, stays at least 0."""
    shrinks = growth < 0
    last = np.where(shrinks, room / np.where(shrinks, -growth, 1.0), np.inf)
    return np.where(room < 0, 0.0, np.minimum(last, length))
