"""The longest steps along a loop that a sampling condition allows."""

from __future__ import annotations

import math
from array import array
from bisect import bisect_right
from collections.abc import Callable

import numpy as np

from crustline.arrays import BoolArray, FloatArray
from crustline.errors import InputError
from crustline.shapes.curve import SmoothCurve, as_curve
from crustline.shapes.progress import tell
from crustline.shapes.ratio import Allowance

# Random steps are at least this share of the longest step.
SHORTEST_STEP = 0.5
# Samples at the most: they need a few minutes and two gigabytes.
MOST_SAMPLES, MOST_HALVINGS = 1_000_000, 30
# The columns of a table: loop, parameter, point, velocity by the parameter, allowance.
LOOP, U, X, Y, VX, VY, A = range(7)
#: Samples after which progress is told.
PACE = 256
#: Rows of a loop for each of its pieces, to begin with.
ROWS_PER_PIECE = 128


def tables(curve: SmoothCurve, allowance: Allowance) -> list[FloatArray]:
    """Return for each loop rows (k, 7) so close that they can be interpolated; it closes."""
    axis = as_curve(curve).medial_axis()

    def rows(loop: FloatArray, u: FloatArray) -> FloatArray:
        p, velocity, _ = curve._on_loops(loop.astype(np.int64), u)
        return np.column_stack([loop, u, p, velocity, allowance(axis.distance(p))])

    counts = np.array([ROWS_PER_PIECE * loop.pieces + 1 for loop in curve.loops])
    loop = np.repeat(np.arange(len(counts), dtype=float), counts)
    first = rows(loop, np.concatenate([np.linspace(0, 1, count) for count in counts]))
    ends = np.cumsum(counts) - 1
    left, right = np.delete(first, ends, axis=0), np.delete(first, ends - counts + 1, axis=0)
    done, certain = [first[ends]], 0.0
    for _ in range(MOST_HALVINGS):
        _refuse_too_many(certain + _least_samples(left, right))
        middle = rows(left[:, LOOP], (left[:, U] + right[:, U]) / 2)
        bad = _badly_interpolated(left, right, middle)
        done.append(left[~bad])
        certain += _least_samples(left[~bad], right[~bad])
        left, middle, right = left[bad], middle[bad], right[bad]
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
    every = np.concatenate([*done, left])
    every = every[np.lexsort((every[:, U], every[:, LOOP]))]
    return np.split(every, np.flatnonzero(np.diff(every[:, LOOP])) + 1)


def _least_samples(left: FloatArray, right: FloatArray) -> float:
    """Return how many samples intervals need at least: ∫ ds / 2A, A being Lipschitz."""
    chord = np.hypot(*(right - left)[:, X : Y + 1].T)
    most = np.maximum(left[:, A], right[:, A]) + chord / 2
    return float((chord / (2 * most)).sum())


def _refuse_too_many(least: float) -> None:
    if least > MOST_SAMPLES:
        raise InputError(
            f"the curve needs more than {MOST_SAMPLES:,} samples, the most that are made: "
            "choose a larger r or error, or a curve whose features are larger beside its length"
        )


def _badly_interpolated(p: FloatArray, q: FloatArray, middle: FloatArray) -> BoolArray:
    """Return whether the rows in the middle of intervals differ from what their ends say."""
    h = (q[:, U] - p[:, U])[:, None]
    bow = h * (p[:, VX : VY + 1] - q[:, VX : VY + 1]) / 8
    hermite = (p[:, X : Y + 1] + q[:, X : Y + 1]) / 2 + bow
    off = np.hypot(*(hermite - middle[:, X : Y + 1]).T)
    bad = off > 1e-6 * middle[:, A]
    bad |= np.abs((p[:, A] + q[:, A]) / 2 - middle[:, A]) > 3e-5 * middle[:, A]
    # A step must see several rows, or it might jump over a part of the curve.
    return np.asarray(bad | (np.hypot(*(q - p)[:, X : Y + 1].T) > middle[:, A] / 4))


class Walk:
    """Steps along one loop, from its table, rolled out twice so that a walk never wraps round."""

    def __init__(self, table: FloatArray) -> None:
        again = table[1:].copy()
        again[:, U] += 1.0
        # Arrays of numbers take a fifth of the memory of lists, and no more time.
        columns = np.vstack([table, again])[:, U:].T
        self.columns: list[array[float]] = [array("d", column) for column in columns]

    def samples(self, start: float, share: float, random: np.random.Generator | None) -> FloatArray:
        """Return u in [0, 1) of samples from start on, in order along the loop."""
        here, samples = start, [start]
        while (ahead := self._reach(self._served(here, share), share)) < start + 1:
            if random is not None:
                ahead = here + (ahead - here) * random.uniform(SHORTEST_STEP, 1.0)
            samples.append(ahead)
            here = ahead
            if len(samples) % PACE == 0:
                tell("walk", here - start)
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
        t = self.columns[0]
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
