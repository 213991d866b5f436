"""The longest steps along a loop that a sampling condition allows."""

from __future__ import annotations

import math
from array import array
from bisect import bisect_right
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.errors import InputError
from crustline.shapes.curve import SmoothCurve, as_curve
from crustline.shapes.ratio import Allowance

# Random steps are at least this share of the longest step.
SHORTEST_STEP = 0.5
# Samples at the most: they need a few minutes and two gigabytes.
MOST_SAMPLES, MOST_HALVINGS = 1_000_000, 30
# The columns of a table: the parameter, the point, the velocity by the parameter, the allowance.
T, X, Y, VX, VY, A = range(6)


def tables(curve: SmoothCurve, allowance: Allowance) -> list[FloatArray]:
    """Return for each loop rows (k, 6) so close that they can be interpolated; it closes."""
    axis, c = as_curve(curve).medial_axis(), len(curve.loops)

    def rows(i: int, u: FloatArray) -> FloatArray:
        p, velocity, _ = curve.derivatives((i + u % 1.0) / c)
        return np.column_stack([u, p, velocity, allowance(axis.distance(p))])

    tables = []
    for i, loop in enumerate(curve.loops):
        table = rows(i, np.linspace(0.0, 1.0, 128 * loop.pieces + 1))
        left = np.arange(len(table) - 1)
        for _ in range(MOST_HALVINGS):
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


class Walk:
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
