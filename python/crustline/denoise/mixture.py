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
#: logarithms, and how far apart at least, in deviations.
FLAT, NORMAL, APART = 2.5, 8.0, 2.5
#: The kurtosis above which distances are not those of two strands: 3 are those of one, 2.04 those
#: of two that are 3 deviations apart.
PEAKED = 2.6
#: Rounds of the mixture, and of both curves.
ROUNDS, TURNS = 80, 3
#: Distances at the most that are judged.
MANY = 4000
#: The share of the points that each strand has at least.
LEAST = 0.2
#: Usual steps of a strand without a point of it on which it is not seen to go on.
GAP = 12.0
#: Where points are before they are blurred, and their shares: in two places, or evenly spread.
PLACES, HALVES = np.array([-1.0, 1.0]), np.array([0.5, 0.5])
SPREAD, EVEN = np.polynomial.legendre.leggauss(24)


@dataclass(frozen=True, eq=False)
class Mixture:
    """A law of places, moved by `middle` and scaled by `half`, and blurred by a normal noise."""

    places: FloatArray
    shares: FloatArray
    middle: float
    half: float
    deviation: float

    def odds(self, offsets: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return how probably each offset is from each place, and its log-likelihood."""
        away = (offsets[:, None] - self.middle - self.half * self.places) / self.deviation
        logarithms = np.log(self.shares / (self.deviation * np.sqrt(2 * np.pi))) - away**2 / 2
        top = logarithms.max(axis=1)
        terms = np.exp(logarithms - top[:, None])
        total = terms.sum(axis=1)
        return terms / total[:, None], np.log(total) + top

    def better(self, offsets: FloatArray) -> Mixture:
        """Return it after a round of expectation and maximization; of two, shares are free, too."""
        odds = self.odds(offsets)[0]
        mean, square = odds @ self.places, odds @ self.places**2
        middle = float((offsets - self.half * mean).mean())
        off = offsets - middle
        half = float((off * mean).sum() / square.sum())
        variance = float((off**2 - 2 * half * off * mean + half**2 * square).mean())
        deviation = max(np.sqrt(max(variance, 0.0)), half / 10, np.finfo(float).tiny)
        is_two = len(self.places) == 2
        shares = odds.mean(axis=0).clip(LEAST, 1 - LEAST) if is_two else self.shares
        return Mixture(self.places, shares, middle, half, float(deviation))


def mixture(offsets: FloatArray, places: FloatArray, shares: FloatArray) -> Mixture:
    """Return the mixture with a law of places that makes offsets most likely."""
    scale = float(np.sqrt((offsets**2).mean() / (shares * places**2).sum()))
    found = Mixture(places, shares, 0.0, 0.85 * scale, 0.5 * scale)
    for _ in range(ROUNDS):
        found = found.better(offsets)
    return found


def pair(points: FloatArray, noise: FloatArray, middle: Polygon) -> list[tuple[BoolArray, Fit]]:
    """Return two curves and their points, of those in order, if two explain them better than one.

    `noise` tells how wide the noise is at each of the points beside the others.
    """
    feet = middle.feet(points)
    offsets = feet.offset / noise
    two = _two(offsets[~feet.beyond])
    if two is None:
        return []
    shares = two.odds(offsets)[0].T
    shift = (two.middle + two.half * two.places) * float(np.median(noise))
    curves = [Polygon(middle.nodes + by * middle.normals, middle.closed) for by in shift]
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


def _two(offsets: FloatArray) -> Mixture | None:
    """Return the mixture of two normal distributions, if nothing else explains offsets as well."""
    offsets = offsets[:: -(-len(offsets) // MANY)]
    square = float((offsets**2).mean())
    if len(offsets) < 2 * GAP or not (offsets**4).mean() < PEAKED * square**2:
        return None
    two, flat = mixture(offsets, PLACES, HALVES), mixture(offsets, SPREAD, EVEN / 2)
    likelihood = [float(each.odds(offsets)[1].sum()) for each in (two, flat)]
    normal = -len(offsets) / 2 * (np.log(2 * np.pi * square) + 1)
    is_two = likelihood[0] > max(likelihood[1] + FLAT, normal + NORMAL)
    return two if is_two and 2 * two.half > APART * two.deviation else None


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
    along = np.sort(middle.feet(points).along)
    steps = len(middle.path) - 1
    ends = [along[:1] + steps] if middle.closed else [[steps]]
    gaps = np.diff(np.concatenate(([along[0] if middle.closed else 0], along, *ends)))
    return bool(gaps.max() < GAP * steps / len(points))
