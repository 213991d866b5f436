"""One curve through noisy points: penalized least squares whose smoothness the points decide.

The nodes of a polygon move along its normals. What is weighed against the distances to the points
is the change of curvature, its third differences across the normal, so that circles and lines cost
nothing and are not flattened. How much it weighs is what makes the points most likely, all curves
of that smoothness taken together (restricted maximum likelihood). Everything is banded, so the time
is linear.

G. Wahba, "A Comparison of GCV and GML for Choosing the Smoothing Parameter in the Generalized
Spline Smoothing Problem", Annals of Statistics 13 (1985), 1378-1402.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.denoise.polygon import Feet, Polygon

#: What the third differences are blind to: lines, circles, and where and how large they are.
FREE = 3
#: Third differences.
STENCIL = np.array([-1.0, 3.0, -3.0, 1.0])
#: How far apart unit loads are, in lengths over which the fit smooths, so that none feels another.
APART = 14.0
#: Loads in such a length: in between, uncertainty is linear.
LOADS = 3.0
#: The exponents tried at first, both times from scratch, and those about the best one.
WIDE, NARROW = np.linspace(-6, 12, 10), np.array([-1.0, -0.5, 0.0, 0.5, 1.0])


@dataclass(frozen=True, eq=False)
class Fit:
    """A fitted curve."""

    polygon: Polygon
    deviation: float
    """The deviation of the points from it, as a multiple of what the weights say."""
    uncertainty: FloatArray
    """The standard deviation of each node across the curve."""


def fit(
    points: FloatArray,
    noise: FloatArray,
    start: Polygon,
    rounds: int = 6,
    shares: FloatArray | None = None,
) -> Fit:
    """Return the smooth curve near `start` that explains the points, each with its own noise.

    Where `shares` are given, points belong to it by so much each, from 0 to 1.
    """
    polygon, weights = start, noise**-2.0
    shares = np.ones(len(points)) if shares is None else shares
    for k in range(rounds):
        step = _Step(polygon, polygon.feet(points), weights, shares)
        if k < 2:
            exponent = step.likeliest(WIDE)
        if k > 0:
            exponent = step.likeliest(exponent + NARROW)
        moved = Polygon(
            polygon.nodes + step.move(exponent)[:, None] * polygon.normals, start.closed
        )
        polygon = moved.resampled(len(moved)) if k < rounds - 1 else moved
    deviation = step.deviation(exponent)
    return Fit(polygon, deviation, deviation * step.uncertainty(exponent))


class _Step:
    """The linear problem about a polygon: how far each node moves along its normal."""

    def __init__(
        self, polygon: Polygon, feet: Feet, weights: FloatArray, shares: FloatArray
    ) -> None:
        self.count, self.closed = len(polygon), polygon.closed
        closed = polygon.closed
        self.band = 7 if closed else 3
        # Folding a ring in the middle brings its two ends together, so it is banded, too.
        k = np.arange(self.count)
        half = (self.count + 1) // 2
        self.place = np.where(k < half, 2 * k, 2 * (self.count - 1 - k) + 1) if closed else k
        # Points beyond an end say nothing about it, but where there are hardly others.
        on = ~feet.beyond if (~feet.beyond).sum() > FREE else np.ones(len(weights), bool)
        self.weights, self.offset = (shares * weights)[on], feet.offset[on]
        self.free = max(float(shares[on].sum()) - FREE, 1.0)
        edge, share = feet.edge[on], feet.share[on]
        self.ends = np.column_stack((edge, (edge + 1) % self.count))
        self.shares = np.column_stack((1 - share, share))
        self._penalize(polygon)
        self.data = self._matrix(self.ends, self.shares, self.weights)
        self.roughness = self._matrix(self.around, self.change, np.ones(len(self.around)))
        self.scale = self.data[0].sum() / max(self.roughness[0].sum(), np.finfo(float).tiny)

    def _penalize(self, polygon: Polygon) -> None:
        nodes, normals = polygon.nodes, polygon.normals
        first = np.arange(self.count if polygon.closed else self.count - 3)
        self.around = (first[:, None] + np.arange(4)) % self.count
        across = normals[self.around[:, 1]] + normals[self.around[:, 2]]
        across /= np.hypot(*across.T)[:, None]
        self.change = STENCIL * np.einsum("ij,ikj->ik", across, normals[self.around])
        thirds = np.einsum("k,ikj->ij", STENCIL, nodes[self.around])
        self.now = (across * thirds).sum(axis=1)

    def _matrix(self, columns: IntArray, values: FloatArray, weights: FloatArray) -> FloatArray:
        """Return the weighted sum of squares of rows as a lower banded matrix."""
        size = (self.band + 1) * self.count
        total = np.zeros(size)
        for where, value in self._products(columns, values):
            total += np.bincount(where, value * weights, size)
        return total.reshape(self.band + 1, self.count)

    def _products(
        self, columns: IntArray, values: FloatArray
    ) -> Iterator[tuple[IntArray, FloatArray]]:
        places = self.place[columns]
        for a in range(columns.shape[1]):
            for b in range(columns.shape[1]):
                low = places[:, a] - places[:, b]
                counts = low >= 0
                where = np.where(counts, low, 0) * self.count + places[:, b]
                yield where, np.where(counts, values[:, a] * values[:, b], 0.0)

    def _factor(self, exponent: float) -> FloatArray:
        from scipy.linalg import cholesky_banded

        matrix = self.data + self.scale * 10.0**exponent * self.roughness
        matrix[0] += 1e-10 * matrix[0].max()
        return np.asarray(cholesky_banded(matrix, lower=True))

    def _solve(self, factor: FloatArray, right: FloatArray) -> FloatArray:
        from scipy.linalg import cho_solve_banded

        return np.asarray(cho_solve_banded((factor, True), right))[self.place]

    def _loads(self, columns: IntArray, values: FloatArray) -> FloatArray:
        places = self.place[columns]
        return np.asarray(np.bincount(places.ravel(), values.ravel(), self.count), float)

    def move(self, exponent: float, factor: FloatArray | None = None) -> FloatArray:
        """Return how far each node moves."""
        weight = self.scale * 10.0**exponent
        pull = self._loads(self.ends, self.shares * (self.weights * self.offset)[:, None])
        hold = self._loads(self.around, self.change * self.now[:, None])
        return self._solve(
            self._factor(exponent) if factor is None else factor, pull - weight * hold
        )

    def _squares(self, exponent: float, move: FloatArray) -> float:
        left = self.offset - (self.shares * move[self.ends]).sum(axis=1)
        rough = self.now + (self.change * move[self.around]).sum(axis=1)
        return float(
            (self.weights * left**2).sum() + self.scale * 10.0**exponent * (rough**2).sum()
        )

    def likeliest(self, exponents: FloatArray) -> float:
        """Return that of some exponents which makes the points most likely."""
        return float(exponents[int(np.argmin([self.evidence(each) for each in exponents]))])

    def evidence(self, exponent: float) -> float:
        """Return minus twice the restricted log-likelihood, but for a constant."""
        try:
            factor = self._factor(exponent)
        except np.linalg.LinAlgError:
            return float("inf")
        squares = self._squares(exponent, self.move(exponent, factor))
        determinant = 2 * np.log(factor[0]).sum() - (self.count - FREE) * np.log(10.0) * exponent
        return float(self.free * np.log(max(squares, np.finfo(float).tiny)) + determinant)

    def deviation(self, exponent: float) -> float:
        """Return the deviation of the points, as a multiple of their noise."""
        squares = self._squares(exponent, self.move(exponent))
        return float(np.sqrt(squares / self.free))

    def uncertainty(self, exponent: float) -> FloatArray:
        """Return the standard deviations of the nodes for points whose noise is as they say.

        Those of a node feel the points within a length that the roughness sets against the data, in
        nodes the sixth root of what they weigh beside each other.
        """
        balance = self.scale * 10.0**exponent * self.count / self.data[0].sum()
        length = max(1.0, float(balance ** (1 / 6)))
        stride = max(1, int(length / LOADS))
        nodes = np.arange(0, self.count, stride)
        if not self.closed:
            nodes = np.unique(np.append(nodes, self.count - 1))
        sets = max(1, int(len(nodes) * stride / (APART * length)))
        variance = self._variances(self._factor(exponent), nodes, -(-len(nodes) // sets))
        period = self.count if self.closed else None
        return np.sqrt(np.interp(np.arange(self.count), nodes, variance, period=period))

    def _variances(self, factor: FloatArray, nodes: IntArray, apart: int) -> FloatArray:
        """Return the variances at nodes; of those so many apart none feels the other."""
        variance = np.empty(len(nodes))
        for first in range(0, apart, 16):
            own = [np.arange(k, len(nodes), apart) for k in range(first, min(first + 16, apart))]
            loads = np.zeros((self.count, len(own)))
            for column, chosen in enumerate(own):
                loads[self.place[nodes[chosen]], column] = 1.0
            solved = self._solve(factor, loads)
            for column, chosen in enumerate(own):
                variance[chosen] = solved[nodes[chosen], column]
        return np.maximum(variance, 0.0)
