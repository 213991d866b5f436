"""Smooth reconstruction: C2 cubic splines through rings and polylines, and few Bézier pieces.

The paper ends with it: "it should be possible to reconstruct F with spline rather than line
segments in such a way as to improve Theorem 13". Splines parametrized by arc length do: their
distance to a smooth curve is of the fourth order in the spacing of the samples, that of the polygon
of the second. Cubics with two pieces between neighboring samples, see `crustline.smooth.cubics`,
are nearer still than those with one [1]_.

References
----------
.. [1] M. S. Floater, "Chordal cubic spline interpolation is fourth order accurate", IMA Journal of
   Numerical Analysis 26 (2006), 25–33.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, get_args

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curve, Curves
from crustline.errors import InputError, require, shown
from crustline.scalars import as_choice, as_degrees
from crustline.smooth.cubics import Run
from crustline.smooth.spline import Spline
from crustline.smooth.splines import Splines

Ends = Literal["not-a-knot", "natural"]
#: By Lemma 10 no sample of a smooth curve turns by more than 4 arcsin(r/2): 57.9° at r = 0.5.
CORNER_ANGLE = 60.0
#: Samples nearer to the one before, as a share of the length, count once: t could not tell them.
_LEAST_STEP = 2.0**-49


def smooth(
    curves: Curves,
    *,
    corner_angle: float = CORNER_ANGLE,
    ends: Ends = "not-a-knot",
) -> Splines:
    """Return C2 cubic splines through the samples of each ring and polyline.

    Parameters
    ----------
    curves : Curves
        What `trace` or `reconstruct` returns.
    corner_angle : float, default 60
        Degrees in (0, 180]: a sample whose two edges turn by this or more is a corner, where the
        spline is broken. No sample of a smooth curve sampled with r ≤ 0.5 turns that much (Lemma
        10). At 180 only samples where the curve reverses are corners.
    ends : {"not-a-knot", "natural"}
        What holds at the ends of polylines and at corners: that the first two cubics are one, or
        that the curvature is zero, which costs accuracy unless it is.

    Returns
    -------
    splines : Splines
        One `Spline` for each curve, in their order and direction.

    Raises
    ------
    InputError
        If `curves` are none, or an option does not fit.
    MissingExtraError
        If scipy is not installed (extra `smooth`).

    Notes
    -----
    The middle between two samples is estimated by the quintic spline by arc length; the cubic
    spline through samples and middles is returned. Where the curvature jumps from one constant to
    another, as from a line to an arc, the middle is on the circle through the three samples before
    or behind; four samples of the constant curvature on each side show that.

    On samples of a curve that is four times differentiable, the distance of spline and curve is of
    the fourth order in r, where the polygon's is of the second (Theorem 13: (r²/2) LFS). Measured
    on sparsest r-samples at r = 0.25, at the worst of five starts, the polygon's is 1400 times the
    spline's on a circle, 500 to 40 times on ellipses from 1.1:1 to 6:1, 15 to 30 times on a trefoil
    and superformulas, 16 times on stadiums whose sides have four samples, 2 to 22 times on random
    blobs: LFS bounds the curvature, not how fast it changes, and other curves with the same samples
    are as near. At r = 0.125 it is 12 times or more on all of them. At r = 0.5 it is 1.4 to 5 times
    on most; the samples are too few for any spline. A spline through noise follows the noise.

    Two samples between corners give a straight line, three a parabola. Samples that repeat the one
    before count once; a ring of two places has corners at both; a curve with one place stands still
    there.

    O(n) time: 10⁵ samples take about 0.3 s in one ring; about 3·10⁻⁴ s are added for each curve,
    and as much for each stretch of three samples or more between corners or ends.

    Examples
    --------
    >>> from crustline import reconstruct, shapes
    >>> ring = smooth(reconstruct(shapes.regular_polygon(24)))[0]
    >>> middle = ring.point([0.5 / 24])
    >>> bool(abs(np.hypot(*middle[0]) - 1) < 2e-5), round(ring.length / (2 * np.pi), 4)
    (True, 1.0)
    """
    require("smooth", "scipy")
    angle = math.radians(as_degrees("corner_angle", corner_angle))
    as_choice("ends", ends, get_args(Ends))
    if not isinstance(curves, Curves):
        raise InputError(f"curves is {shown(curves)}: pass what trace or reconstruct returns")
    splines = (_spline(_line(curve, angle), ends == "natural") for curve in curves)
    return Splines(curves, tuple(splines))


@dataclass(frozen=True, eq=False)
class _Line:
    """The different places of one curve, about of unit size, and its smooth runs."""

    curve: Curve
    exponent: int
    first: IntArray  # the first sample of each place
    place: IntArray  # the place of each sample
    places: FloatArray
    corners: IntArray
    runs: IntArray  # where runs of intervals start, and the last ends; beyond count on a ring

    def smooth_runs(self) -> list[Run]:
        """Return the runs between corners, or ends; a ring without corners is one."""
        ring = self.curve.closed and len(self.corners) == 0
        around = np.concatenate([self.places, self.places])
        return [Run(around[first : last + 1], ring) for first, last in pairwise(self.runs)]


def _line(curve: Curve, corner: float) -> _Line:
    # Powers of two are exact, and keep squares and cubes within the range of float64.
    exponent = int(np.frexp(np.abs(curve.points).max())[1])
    points = np.ldexp(curve.points, -exponent)
    first, place = _different(points, curve.closed)
    places = points[first]
    corners = first[:0] if len(first) == 1 else _corners(places, curve.closed, corner)
    runs = _runs(len(places), curve.closed, corners)
    return _Line(curve, exponent, first, place, places, corners, runs)


def _different(points: FloatArray, closed: bool) -> tuple[IntArray, IntArray]:
    """Return the samples that do not repeat the one before, and for each sample which of them."""
    around = np.concatenate([points, points[:1]]) if closed else points
    steps = np.diff(around, axis=0)
    t = np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])
    if t[-1] > 0:
        t /= t[-1]
    new = np.diff(t[: len(points)], prepend=-1.0) > _LEAST_STEP
    if closed:
        new[1:] &= 1 - t[1 : len(points)] > _LEAST_STEP
    place = np.cumsum(new) - 1
    if closed:
        place[1 - t[: len(points)] <= _LEAST_STEP] = 0
    return np.flatnonzero(new), place


def _spline(line: _Line, natural: bool) -> Spline:
    from scipy.interpolate import PPoly

    if len(line.places) == 1:
        knots, coefficients, runs = *_standing(line.places), np.array([0, 1])
    else:
        knots, coefficients, runs = *_fitted(line, natural), line.runs
    curve = line.curve
    return Spline(
        curve.indices,
        curve.closed,
        curve.points,
        parameters=knots[::2][line.place],
        corners=curve.indices[line.first[line.corners]],
        _cubic=PPoly(np.ascontiguousarray(coefficients), knots),
        _runs=2 * runs,
        _exponent=line.exponent,
    )


def _fitted(line: _Line, natural: bool) -> tuple[FloatArray, FloatArray]:
    """Return knots and coefficients of the cubics of a line, two for each interval."""
    runs = line.smooth_runs()
    start = line.runs[0]  # a ring's first run starts at its first corner
    knots = _knots(np.roll(np.concatenate([run.arcs for run in runs]), start))
    around = np.append(knots, 1 + knots[1:])  # its last run goes on beyond t = 1
    stretches = [around[2 * a : 2 * b + 1] for a, b in pairwise(line.runs)]
    fitted = [run.cubics(t, natural) for run, t in zip(runs, stretches, strict=True)]
    return knots, np.roll(np.concatenate(fitted, axis=1), 2 * start, axis=1)


def _knots(lengths: FloatArray) -> FloatArray:
    """Return t at places and middles, given the arc lengths from each place to the next."""
    ends = np.append(0.0, np.cumsum(lengths))
    ends /= ends[-1]
    knots = np.repeat(ends, 2)[:-1]
    knots[1::2] = (ends[1:] + ends[:-1]) / 2
    return knots


def _standing(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return knots and coefficients of a curve that is a single place."""
    still = np.zeros((4, 2, 2))
    still[3] = places
    return np.array([0.0, 0.5, 1.0]), still


def _corners(places: FloatArray, closed: bool, corner: float) -> IntArray:
    """Return the places where the polygon turns by the angle `corner` (radians) or more."""
    steps = np.roll(places, -1, axis=0) - places
    steps /= np.hypot(steps[:, :1], steps[:, 1:]) if closed else _nonzero(steps)
    before = np.roll(steps, 1, axis=0)
    cross = before[:, 0] * steps[:, 1] - before[:, 1] * steps[:, 0]
    turns = np.abs(np.arctan2(cross, (before * steps).sum(axis=1)))
    if not closed:
        turns[[0, -1]] = -1.0  # below any angle, 0 included
    return np.flatnonzero(turns >= corner)


def _nonzero(steps: FloatArray) -> FloatArray:
    """Return lengths (k, 1); the last one of a polyline leads back, maybe nowhere: 1 then."""
    lengths = np.hypot(steps[:, :1], steps[:, 1:])
    lengths[lengths == 0] = 1.0
    return lengths


def _runs(count: int, closed: bool, corners: IntArray) -> IntArray:
    """Return where smooth runs of intervals start, and the last ends; beyond count on a ring."""
    if not closed:
        return np.concatenate([[0], corners, [count - 1]])
    return np.append(corners, corners[0] + count) if len(corners) else np.array([0, count])
