"""The sampling ratio (paper, §5): the smallest r for which points r-sample a smooth curve."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.arrays import FloatArray, as_points
from crustline.errors import InputError
from crustline.scalars import as_positive, as_rtol
from crustline.shapes.curve import SmoothCurve, as_curve
from crustline.shapes.progress import tell

Allowance = Callable[[FloatArray], FloatArray]
# Arcs and rounds of halving them at the most.
MOST_ARCS, MOST_ROUNDS = 1 << 23, 60
ARCS_PER_PIECE = 64
# What is measured at a place: loop, parameter, point, distance to the samples, allowance, LFS.
LOOP, U, X, Y, D, A, LFS = range(7)


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
    >>> round(sampling_ratio(circle(), regular_polygon(6)), 3)  # 2 sin 15°
    0.518
    """
    rtol = as_rtol(rtol)
    sites = as_points(points)
    if not len(sites):
        raise InputError("points is empty: no points sample no curve")
    return supremum(curve, sites, lambda lfs: lfs, 1.0, rtol)


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


def supremum(
    curve: SmoothCurve, sites: FloatArray, allowance: Allowance, lipschitz: float, rtol: float
) -> float:
    """Return the supremum of dist(p, sites) / allowance(LFS(p)), or 1 + rtol times it."""
    axis, near = as_curve(curve).medial_axis(rtol=min(rtol, 1e-4)), _core.Tree(sites, sites)

    def measured(loop: FloatArray, u: FloatArray) -> FloatArray:
        p = curve._on_loops(loop.astype(np.int64), u)[0]
        lfs = axis.distance(p)
        return np.column_stack([loop, u, p, near.distances(p), allowance(lfs), lfs])

    left, right = _arcs(curve, measured)
    best, result = float((left[:, D] / left[:, A]).max()), 0.0
    for _ in range(MOST_ROUNDS):
        bound = _arc_bound(left, right, lipschitz)
        alive = bound > best * (1 + rtol)
        tell("measure", 1 - float(alive.mean()))
        result = max(result, float(bound[~alive].max(initial=0.0)))
        if not alive.any():
            break
        left, right = left[alive], right[alive]
        middle = measured(left[:, LOOP], (left[:, U] + right[:, U]) / 2)
        best = max(best, float((middle[:, D] / middle[:, A]).max()))
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
    else:
        result = max(result, float(bound.max()))
    return max(best, result)


def _arcs(
    curve: SmoothCurve, measured: Callable[[FloatArray, FloatArray], FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Return the ends of arcs that cover the curve, each shorter than a quarter of LFS."""
    counts = np.array([ARCS_PER_PIECE * loop.pieces + 1 for loop in curve.loops])
    loop = np.repeat(np.arange(len(counts), dtype=float), counts)
    ends = measured(loop, np.concatenate([np.linspace(0, 1, count) for count in counts]))
    last = np.cumsum(counts) - 1
    left, right = np.delete(ends, last, axis=0), np.delete(ends, last - counts + 1, axis=0)
    for _ in range(MOST_ROUNDS):
        chord = np.hypot(*(left - right)[:, X : Y + 1].T)
        _refuse_too_long(chord, np.maximum(left[:, LFS], right[:, LFS]))
        wide = chord > np.minimum(left[:, LFS], right[:, LFS]) / 4
        if not wide.any():
            break
        middle = measured(left[wide, LOOP], (left[wide, U] + right[wide, U]) / 2)
        left = np.concatenate([left[~wide], left[wide], middle])
        right = np.concatenate([right[~wide], middle, right[wide]])
    return left, right


def _refuse_too_long(chord: FloatArray, lfs: FloatArray) -> None:
    """Refuse a curve that needs too many arcs, from the chords of some and LFS at their ends."""
    least = float((4 * chord / (lfs + chord / 2)).sum())
    if least > MOST_ARCS:
        raise InputError(
            f"the curve is more than {MOST_ARCS // 4:,} times as long as its local feature size, "
            "the most that is measured: give a curve whose features are larger beside its length"
        )


def _arc_bound(left: FloatArray, right: FloatArray, lipschitz: float) -> FloatArray:
    """Bound the ratio on arcs from their ends."""
    chord = np.hypot(*(left - right)[:, X : Y + 1].T)
    lfs = np.minimum(left[:, LFS], right[:, LFS])
    # The radius of curvature is at least LFS, which on the arc is at least 2/3 of that at its ends:
    # so the arc is no longer than that of a circle of that radius on the same chord, 2 R asin(chord
    # / 2R) ≤ chord (1 + chord² / 20 R²).
    arc = chord * (1 + 0.12 * (chord / lfs) ** 2)
    distance = (left[:, D] + right[:, D] + arc) / 2
    least = (left[:, A] + right[:, A] - lipschitz * arc) / 2
    return np.where(least > 0, distance / np.where(least > 0, least, 1.0), np.inf)
