"""Two curves where one was fitted: strands so near each other that no window parts them.

Across two strands of the same noise, 3 deviations apart, points are a mixture of two normal
distributions, whose dip in the middle no window of a few points shows. All points along the curve
together do: so their distances from the curve in the middle are explained in three ways: as one
normal distribution; as two; and as one spread evenly over a width and blurred, which is what thick
slices and pixels look like, as flat as two strands are but without the dip. If two are likeliest,
both curves are fitted at once, each point belonging to either by the odds (expectation and
maximization), so they need not be parallel.

A. P. Dempster, N. M. Laird, D. B. Rubin, "Maximum Likelihood from Incomplete Data via the EM
Algorithm", Journal of the Royal Statistical Society B 39 (1977), 1-38.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from crustline.arrays import BoolArray, FloatArray
from crustline.denoise.polygon import Polygon
from crustline.denoise.smoother import Fit, fit

#: How much likelier two strands are than one of a flat profile, and of a normal one, natural
#: logarithms; how likely beside the latter they are at first; and how far apart, in deviations.
FLAT, NORMAL, FIRST, APART = 1.0, 9.0, 4.0, 2.5
#: The kurtosis above which distances are not those of two strands: 3 are those of one, 2.04 those
#: of two that are 3 deviations apart.
PEAKED = 2.6
#: Rounds of the mixture, and of curves.
ROUNDS, TURNS = 80, 3
#: Distances at the least and at the most that are judged: few means of cells, as thinning leaves
#: them, are in two columns.
FEWEST, MANY = 160, 4000
#: The share of the points that each strand has at least.
LEAST = 0.2
#: Usual steps of a strand without a point of it on which it is not seen to go on.
GAP = 12.0
#: Where points are before they are blurred, and their shares: in two places, or evenly spread.
PLACES, HALVES = np.array([-1.0, 1.0]), np.array([0.5, 0.5])
SPREAD, EVEN = np.polynomial.legendre.leggauss(24)


@dataclass(frozen=True, eq=False)
class Offsets:
    """Distances of points from a curve, positive to the left, and how wide their noise is."""

    values: FloatArray
    noise: FloatArray

    @property
    def square(self) -> float:
        """The mean square beside the noise."""
        return float(((self.values / self.noise) ** 2).mean())

    @property
    def kurtosis(self) -> float:
        """The mean fourth power over the square of the mean square, beside the noise."""
        return float(((self.values / self.noise) ** 4).mean()) / self.square**2

    @property
    def normal(self) -> float:
        """The log-likelihood of one normal distribution."""
        return -len(self.values) / 2 * float(np.log(2 * np.pi * self.square) + 1)


@dataclass(frozen=True, eq=False)
class Mixture:
    """A law of places, moved by `middle` and scaled by `half`, and blurred by a normal noise."""

    places: FloatArray
    shares: FloatArray
    middle: float
    half: float
    deviation: float

    @property
    def shift(self) -> FloatArray:
        """How far each place is from the curve."""
        return self.middle + self.half * self.places

    def odds(self, offsets: Offsets) -> tuple[FloatArray, FloatArray]:
        """Return how probably each offset is from each place, and its log-likelihood."""
        away = (offsets.values[:, None] - self.shift) / offsets.noise[:, None] / self.deviation
        logarithms = np.log(self.shares / (self.deviation * np.sqrt(2 * np.pi))) - away**2 / 2
        top = logarithms.max(axis=1)
        terms = np.exp(logarithms - top[:, None])
        total = terms.sum(axis=1)
        return terms / total[:, None], np.log(total) + top

    def likelihood(self, offsets: Offsets) -> float:
        """Return the log-likelihood of offsets."""
        return float(self.odds(offsets)[1].sum())

    def better(self, offsets: Offsets) -> Mixture:
        """Return it after a round of expectation and maximization; of two, shares are free, too."""
        odds, weights = self.odds(offsets)[0], offsets.noise**-2.0
        mean, square = odds @ self.places, odds @ self.places**2
        middle = float(np.average(offsets.values - self.half * mean, weights=weights))
        off = offsets.values - middle
        half = float((weights * off * mean).sum() / (weights * square).sum())
        variance = (weights * (off**2 - 2 * half * off * mean + half**2 * square)).mean()
        deviation = np.sqrt(max(float(variance), half**2 * weights.mean() / 100))
        is_two = len(self.places) == 2
        shares = odds.mean(axis=0).clip(LEAST, 1 - LEAST) if is_two else self.shares
        return Mixture(self.places, shares, middle, half, float(deviation))


def mixture(offsets: Offsets, places: FloatArray, shares: FloatArray) -> Mixture:
    """Return the mixture with a law of places that makes offsets most likely."""
    scale = float(np.sqrt((offsets.values**2).mean() / (shares * places**2).sum()))
    width = float(np.sqrt(offsets.square))
    found = Mixture(places, shares, 0.0, 0.85 * scale, 0.5 * width)
    for _ in range(ROUNDS):
        found = found.better(offsets)
    return found


def pair(points: FloatArray, noise: FloatArray, middle: Polygon) -> list[tuple[BoolArray, Fit]]:
    """Return two curves and their points, of those in order, if two explain them better than one.

    `noise` tells how wide the noise is at each of the points beside the others.
    """
    found = _two(points, noise, middle)
    if found is None:
        return []
    two, middle = found
    shares = two.odds(Offsets(middle.feet(points).offset, noise))[0].T
    curves = [Polygon(middle.nodes + by * middle.normals, middle.closed) for by in two.shift]
    for _ in range(TURNS):
        made = [
            fit(points, noise, curve, shares=own) for curve, own in zip(curves, shares, strict=True)
        ]
        curves = [each.polygon for each in made]
        shares = _shares(points, noise, curves, shares)
    own = [shares[0] > 0.5, shares[0] <= 0.5]
    if _cross(curves) or not all(_goes_on(middle, points[each]) for each in own):
        return []
    return list(zip(own, made, strict=True))


def _two(points: FloatArray, noise: FloatArray, middle: Polygon) -> tuple[Mixture, Polygon] | None:
    """Return the mixture of two normal distributions, and the curve between, if that is likeliest.

    The curve is fitted anew to points moved by what the mixture says: two strands blur the first.
    """
    some = _judged(points, noise, middle)
    if len(some.values) < FEWEST or not some.kurtosis < PEAKED:
        return None
    normal, two = some.normal, mixture(some, PLACES, HALVES)
    if two.likelihood(some) < normal + FIRST:
        return None
    for _ in range(TURNS):
        middle = _between(points, noise, middle, two)
        some = _judged(points, noise, middle)
        two = mixture(some, PLACES, HALVES)
    flat = mixture(some, SPREAD, EVEN / 2).likelihood(some)
    if two.likelihood(some) < max(flat + FLAT, normal + NORMAL):
        return None
    apart = 2 * two.half / (two.deviation * float(np.median(noise)))
    return (two, middle) if apart > APART else None


def _judged(points: FloatArray, noise: FloatArray, middle: Polygon) -> Offsets:
    """Return those of points beside a curve; of very many, of some."""
    feet = middle.feet(points)
    on = np.flatnonzero(~feet.beyond)
    some = on[:: max(1, -(-len(on) // MANY))]
    return Offsets(feet.offset[some], noise[some])


def _between(points: FloatArray, noise: FloatArray, middle: Polygon, two: Mixture) -> Polygon:
    """Return the curve between two strands: each point is moved there from either, by the odds."""
    feet = middle.feet(points)
    normals = middle.normals
    share = feet.share[:, None]
    across = (1 - share) * normals[feet.edge] + share * normals[(feet.edge + 1) % len(middle)]
    across /= np.maximum(np.hypot(*across.T), np.finfo(float).tiny)[:, None]
    moved = np.vstack([points - by * across for by in two.shift])
    odds = two.odds(Offsets(feet.offset, noise))[0]
    return fit(moved, np.tile(noise, 2), middle, shares=odds.T.ravel()).polygon


def _shares(
    points: FloatArray, noise: FloatArray, curves: list[Polygon], before: FloatArray
) -> FloatArray:
    """Return by how much points belong to each of two curves."""
    square = np.array([(curve.feet(points).offset / noise) ** 2 for curve in curves])
    variance = (before * square).sum() / before.sum()
    logarithm = np.log(before.mean(axis=1))[:, None] - square / (2 * variance)
    left = 1 / (1 + np.exp(np.clip(logarithm[1] - logarithm[0], -700, 700)))
    return np.array([left, 1 - left])


def _cross(curves: list[Polygon]) -> bool:
    """Whether one of two curves is not all on one side of the other."""
    feet = curves[0].feet(curves[1].nodes)
    offset = feet.offset[~feet.beyond]
    return bool(offset.min(initial=0.0) < 0 < offset.max(initial=0.0))


def _goes_on(middle: Polygon, points: FloatArray) -> bool:
    """Whether points are all along a curve: that is what tells strands from bends not followed."""
    if len(points) < GAP:
        return False
    along = np.sort(middle.feet(points).along)
    steps = len(middle.path) - 1
    ends = [along[:1] + steps] if middle.closed else [[steps]]
    gaps = np.diff(np.concatenate(([along[0] if middle.closed else 0], along, *ends)))
    return bool(gaps.max() < GAP * steps / len(points))
