"""C2 cubics through a smooth run of places, with a middle between each two places.

A cubic through the places alone cannot show a curvature that rises and falls within two intervals.
So first the middle of every interval is estimated: on the quintic spline by arc length, whose error
is of the sixth order; where the curvature jumps, as from a line to an arc, on the circle through
three places of one side. A cubic spline through places and middles then has half the step.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from crustline.arrays import FloatArray, IntArray

__all__ = ["Run"]

_Ends = Literal["periodic", "natural", "not-a-knot"]

_DEGREE = 5
#: What happens so many places off matters less to a quintic spline than rounding does.
_FAR = 48
#: How nearly curvatures must agree with a jump between two constants, as a share of the jump.
_JUMP_TOLERANCE = 0.05
#: Arcs longer by a sixth than their chords are no longer believed: those of half circles.
_MOST_BEND = 4.0
#: Intervals as shares of the longest near by: shorter ones would make the equations singular.
_SHORTEST = 2.0**-16


@dataclass(frozen=True, eq=False)
class Run:
    """A smooth run of m intervals between places.

    Attributes
    ----------
    places : ndarray of float64, shape (m + 1, 2)
        None equals the one before it. A ring repeats its first as the last.
    ring : bool
        Whether the run goes on smoothly from its last place.
    """

    places: FloatArray
    ring: bool

    @property
    def straight(self) -> bool:
        return len(self.places) == 2

    @cached_property
    def chords(self) -> FloatArray:
        return _size(np.diff(self.places, axis=0))

    @cached_property
    def curvatures(self) -> FloatArray:
        """That of the circle through each place and its neighbors; ends have their neighbor's."""
        places = self.places
        if self.ring:
            places = np.concatenate([places[-2:-1], places, places[1:2]])
        inner = _circles(places[:-2], places[1:-1], places[2:])
        return inner if self.ring else np.pad(inner, 1, mode="edge")

    @cached_property
    def arcs(self) -> FloatArray:
        """An estimate of the arc length of each interval.

        As if the curvature changed linearly from place to place; of the sixth order in the chord.
        """
        if self.straight:
            return self.chords
        here, there = self.curvatures[:-1], self.curvatures[1:]
        bend = (here * here + here * there + there * there) * (self.chords * self.chords / 3)
        arcs: FloatArray = self.chords * (1 + np.minimum(bend, _MOST_BEND) / 24)
        return arcs

    @cached_property
    def middles(self) -> FloatArray:
        """A place half-way along each interval, shape (m, 2).

        On the quintic spline by arc length ("not a knot" at ends), of the sixth order in the arcs;
        runs of fewer than six places have one polynomial. Where the curvature jumps, see `_jumps`,
        the spline is cut. No middle is farther from the chord's than twice that of circles near by.
        """
        if self.straight:
            return self._centers
        jumps = self._jumps()
        widths = np.maximum(self.arcs, _SHORTEST * self._largest(self.arcs, 3))
        if not len(jumps):
            on_spline = self._unrolled(widths) if self.ring else _on_spline(self.places, widths)
            return self._limited(on_spline)
        middles = np.empty_like(self._centers)
        middles[jumps] = self._one_sided(jumps)
        for piece in self._between(jumps):
            places = self.places[np.append(piece, piece[-1] + 1)]
            middles[piece] = _on_spline(places, widths[piece])
        return self._limited(middles)

    def cubics(self, knots: FloatArray, natural: bool) -> FloatArray:
        """Return C2 cubics through places and middles, as coefficients, shape (4, 2 m, 2).

        Parameters
        ----------
        knots : ndarray of float64, shape (2 m + 1,)
            The parameters of places and middles, in turn.
        natural : bool
            Whether the curvature is zero at the ends of the run; else the first two and the last
            two cubics are one ("not a knot").

        Returns
        -------
        coefficients : ndarray of float64, shape (4, 2 m, 2)
            Of powers, highest first.
        """
        from scipy.interpolate import CubicSpline

        values = np.repeat(self.places, 2, axis=0)[:-1]
        values[1::2] = self.middles
        if self.straight:
            slopes = np.diff(values, axis=0) / np.diff(knots)[:, None]
            return np.stack([0 * slopes, 0 * slopes, slopes, values[:-1]])
        open_ends: _Ends = "natural" if natural else "not-a-knot"
        ends: _Ends = "periodic" if self.ring else open_ends
        return np.asarray(CubicSpline(knots, values, bc_type=ends).c)

    def _unrolled(self, widths: FloatArray) -> FloatArray:
        """Return the middles of a ring on the periodic quintic spline, but for rounding.

        What scipy calls periodic warns of singular equations where the spacing is very uneven, and
        takes milliseconds for ten places.
        """
        count = len(widths)
        around = np.arange(-_FAR, count + _FAR + 1) % count
        return _on_spline(self.places[around], widths[around[:-1]])[_FAR:-_FAR]

    @property
    def _centers(self) -> FloatArray:
        centers: FloatArray = (self.places[:-1] + self.places[1:]) / 2
        return centers

    def _largest(self, values: FloatArray, reach: int) -> FloatArray:
        """Return the largest of the values of each interval and so many to each side of it."""
        from scipy.ndimage import maximum_filter1d

        size = 2 * reach + 1
        return np.asarray(maximum_filter1d(values, size, mode="wrap" if self.ring else "nearest"))

    # --- Jumps of the curvature -----------------------------------------------------------------

    def _jumps(self) -> IntArray:
        """Return the intervals within which the curvature jumps from one constant to another.

        The circle through three places has the curvature's mean, weighted by a hat over them. Of a
        jump of height d, a share of the square of how far it lies inside of the hat is seen by the
        circles about both ends of its interval: both tell where in the interval it is. Four more
        circles, two on each side, tell if the curvature is constant there.
        """
        count = len(self.chords)
        if count < 7 + self.ring:
            return np.arange(0)
        intervals = np.arange(count) if self.ring else np.arange(3, count - 3)
        far, left, first, last, right, beyond = self.curvatures[self._six(intervals)]
        before, width, after = (self.arcs[(intervals + k) % count] for k in (-1, 0, 1))
        jump = right - left
        with np.errstate(all="ignore"):
            ahead = np.sqrt((first - left) / jump * width * (before + width))
            behind = np.sqrt((right - last) / jump * width * (width + after))
            fits = np.abs(ahead + behind - width) < _JUMP_TOLERANCE * width
        change = np.maximum(np.abs(far - left), np.abs(right - beyond))
        jumps: IntArray = intervals[fits & (change < _JUMP_TOLERANCE * np.abs(jump))]
        return jumps

    def _six(self, intervals: IntArray) -> IntArray:
        """Return the numbers of the three places before and behind each interval, shape (6, k)."""
        return (intervals + np.arange(-2, 4)[:, None]) % len(self.chords)

    def _between(self, jumps: IntArray) -> list[IntArray]:
        """Return the stretches of intervals without jumps; a ring is opened at the first."""
        order = np.roll(np.arange(len(self.chords)), -jumps[0] if self.ring else 0)
        first, *rest = np.split(order, np.flatnonzero(np.isin(order, jumps)))
        return [each for each in (first, *(part[1:] for part in rest)) if len(each)]

    def _one_sided(self, jumps: IntArray) -> FloatArray:
        """Return the middles of intervals on the circle through three places on one side of each.

        The circle of the other side misses the near end by more: the joint is nearer to that end.
        """
        places = self.places[self._six(jumps)]
        arcs = self.arcs[jumps]
        before, behind = places[:3], places[:2:-1]
        miss = _size(_along(before, arcs) - behind[2]) - _size(_along(behind, arcs) - before[2])
        return np.where(miss[:, None] < 0, _along(before, arcs / 2), _along(behind, arcs / 2))

    def _limited(self, middles: FloatArray) -> FloatArray:
        """Return the middles drawn towards their chord's if they are farther than any circle tells.

        On samples of smooth curves none are. On very uneven ones polynomials overshoot.
        """
        size = np.abs(self.curvatures)
        most = self._largest(np.maximum(size[:-1], size[1:]), 1)
        limit = self.chords * np.minimum(self.chords * most / 4, 0.5)
        offset = np.nan_to_num(middles - self._centers, posinf=0.0, neginf=0.0)
        share = np.minimum(1, limit / np.maximum(_size(offset), 1e-300))
        limited: FloatArray = self._centers + share[:, None] * offset
        return limited


def _on_spline(places: FloatArray, widths: FloatArray) -> FloatArray:
    """Return the middles of intervals of these widths on the quintic spline through the places."""
    from scipy.interpolate import krogh_interpolate, make_interp_spline

    t = np.append(0.0, np.cumsum(widths))
    middle = (t[:-1] + t[1:]) / 2
    if len(widths) < _DEGREE:
        return np.asarray(krogh_interpolate(t, places, middle))
    return np.asarray(make_interp_spline(t, places, _DEGREE)(middle))


# --- Circles ------------------------------------------------------------------------------------


def _circles(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Return the signed curvature of the circles through three points each."""
    one, other, whole = b - a, c - b, c - a
    product = _size(one) * _size(other) * _size(whole)
    twice = 2 * (one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
    with np.errstate(all="ignore"):
        curvature: FloatArray = np.where(product > 0, twice / product, 0.0)
    return curvature


def _along(three: FloatArray, length: FloatArray) -> FloatArray:
    """Return the points on circles through three points each, so far beyond the last of them."""
    _, before, last = three
    step = last - before
    chord = _size(step)
    curvature = _circles(*three)
    angle = np.arcsin(np.clip(chord * curvature / 2, -1, 1)) + curvature * length / 2
    reach = length * np.sinc(curvature * length / (2 * np.pi)) / chord
    ahead, aside = reach * np.cos(angle), reach * np.sin(angle)
    turned = np.column_stack([-step[:, 1], step[:, 0]])
    places: FloatArray = last + ahead[:, None] * step + aside[:, None] * turned
    return places


def _size(vectors: FloatArray) -> FloatArray:
    size: FloatArray = np.hypot(vectors[:, 0], vectors[:, 1])
    return size
