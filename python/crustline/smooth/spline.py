"""A smooth curve through the samples of one ring or polyline, and its Bézier pieces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray, as_floats
from crustline.errors import InputError
from crustline.scalars import MOST_POINTS, as_positive, as_whole
from crustline.smooth.beziers import BezierPath, fewest_pieces

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

#: Nodes of the Gauss–Legendre rule for the arc length of one cubic.
_GAUSS = 16


@dataclass(frozen=True, eq=False)
class Spline:
    """A smooth curve through the samples of one ring or polyline.

    `t` runs from 0 at the first sample to 1 at the last, or back at the first one of a ring, in
    proportion to an estimate of arc length. Two cubics run between neighboring samples; the spline
    is twice continuously differentiable in t, but at `corners`.

    Attributes
    ----------
    indices : ndarray of int64, shape (k,)
        Rows of the points, in order along the curve. A ring does not repeat its first index.
    closed : bool
        Whether it is a ring.
    points : ndarray of float64, shape (k, 2)
        The samples, which the curve passes through.
    parameters : ndarray of float64, shape (k,)
        t at each sample, never decreasing but where the last samples of a ring are equal to the
        first.
    corners : ndarray of int64, shape (s,)
        Rows of the points at which the direction jumps, in order along the curve; no ends of
        polylines.
    """

    indices: IntArray
    closed: bool
    points: FloatArray
    parameters: FloatArray
    corners: IntArray
    _cubic: PPoly = field(repr=False)
    _runs: IntArray = field(repr=False)
    _exponent: int = field(repr=False)

    def point(self, t: npt.ArrayLike) -> FloatArray:
        """Return the points at t, shape (..., 2).

        Parameters
        ----------
        t : array_like of float, any shape
            In [0, 1]; for a ring any number, taken modulo 1.

        Raises
        ------
        InputError
            If t is not finite, or outside [0, 1] on a polyline.
        """
        places: FloatArray = np.ldexp(self._evaluate(t, 0), self._exponent)
        if not self.closed:  # the last cubic ends there but for rounding
            places[np.asarray(t) == 1] = self.points[-1]
        return places

    def tangent(self, t: npt.ArrayLike) -> FloatArray:
        """Return the unit tangents at t, in the direction of growing t, shape (..., 2).

        At a corner the direction after it; NaN where the curve stands still, as on a single place.
        """
        velocity = self._evaluate(t, 1)
        with np.errstate(invalid="ignore"):
            unit: FloatArray = velocity / np.hypot(velocity[..., :1], velocity[..., 1:])
        return unit

    def curvature(self, t: npt.ArrayLike) -> FloatArray:
        """Return the signed curvature at t, positive where it turns counter-clockwise, shape (...).

        At a corner that after it; NaN where the curve stands still. On samples of a smooth curve it
        is of the second order in their spacing; 1/LFS bounds the true one, so that a larger value
        shows samples too sparse.
        """
        first, second = self._evaluate(t, 1), self._evaluate(t, 2)
        speed = np.hypot(first[..., 0], first[..., 1])
        with np.errstate(invalid="ignore", divide="ignore"):
            first, second = first / speed[..., None], second / speed[..., None] ** 2
            cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
        curvature: FloatArray = np.ldexp(cross, -self._exponent)
        return curvature

    @cached_property
    def length(self) -> float:
        """The arc length, in the unit of the points; by Gauss's rule of 16 nodes for each cubic."""
        nodes, weights = np.polynomial.legendre.leggauss(_GAUSS)
        widths = np.diff(self._cubic.x)
        t = self._cubic.x[:-1, None] + widths[:, None] * (nodes + 1) / 2
        velocity = self._evaluate(np.minimum(t, 1.0), 1)
        speed = np.hypot(velocity[..., 0], velocity[..., 1])
        return float(np.ldexp(np.sum(speed @ weights * widths) / 2, self._exponent))

    def sample(self, count: int | None = None, *, tolerance: float | None = None) -> FloatArray:
        """Return points along the curve, shape (count, 2); a ring does not repeat the first.

        Parameters
        ----------
        count : int, optional
            How many, evenly spaced in t, which is nearly arc length. At least 2 for a polyline.
        tolerance : float, optional
            In place of a count: the largest distance of the curve to the polygon through the
            points, in their unit. All samples are among the points then.

        Raises
        ------
        InputError
            If not exactly one of the two is given, or it is out of range.

        Notes
        -----
        The tolerance is a proven bound: a cubic is nowhere farther from its chord than an eighth of
        the largest acceleration times the step squared, and the acceleration is largest at an end.
        """
        if (count is None) == (tolerance is None):
            raise InputError("sample takes either a count or a tolerance: give one of them")
        if tolerance is not None:
            return self.point(self._flat(as_positive("tolerance", tolerance)))
        least = 1 if self.closed else 2
        number = as_whole("count", count, least, MOST_POINTS)
        return self.point(np.linspace(0, 1, number, endpoint=not self.closed))

    def beziers(self, tolerance: float | None = None) -> FloatArray:
        """Return the curve as cubic Bézier pieces, shape (p, 4, 2): see `Splines.beziers`."""
        return bezier_pieces([self], tolerance)[0]

    def _evaluate(self, t: npt.ArrayLike, order: int) -> FloatArray:
        place = as_floats("t", t)
        fine = np.isfinite(place) if self.closed else (place >= 0) & (place <= 1)
        if not np.all(fine):
            domain = "a finite number" if self.closed else "in [0, 1]"
            raise InputError(f"t is {place[~fine].flat[0]}: it must be {domain}")
        if self.closed:
            place = place % 1.0
        return np.asarray(self._cubic(place, order))

    def _flat(self, tolerance: float) -> FloatArray:
        """Return parameters whose points make a polygon within the tolerance."""
        widths = np.diff(self._cubic.x)
        bends = np.stack(
            [self._cubic.c[1], self._cubic.c[1] + 3 * self._cubic.c[0] * widths[:, None]]
        )
        bend = 2 * np.hypot(bends[..., 0], bends[..., 1]).max(axis=0)
        limit = np.ldexp(tolerance, -self._exponent)
        with np.errstate(over="ignore", divide="ignore"):
            steps = np.maximum(1, np.ceil(widths * np.sqrt(bend / limit / 8)))
        if steps.sum() > MOST_POINTS:
            raise InputError(
                f"tolerance asks for more than {MOST_POINTS:,} points: choose a larger one"
            )
        parts = steps.astype(np.int64)
        number = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        step = np.repeat(widths / parts, parts)
        t = np.repeat(self._cubic.x[:-1], parts) + number * step
        return t if self.closed else np.append(t, 1.0)

    @cached_property
    def _path(self) -> BezierPath:
        """The exact pieces, scaled to about unit size, starting at a corner if there is one."""
        c, x = self._cubic.c, self._cubic.x
        widths = np.diff(x)
        h = widths[:, None]
        ends = np.roll(c[3], -1, axis=0)
        if not self.closed:
            ends[-1] = np.ldexp(self.points[-1], -self._exponent)
        slope = c[2] + h * (2 * c[1] + 3 * h * c[0])
        control = np.stack([c[3], c[3] + h / 3 * c[2], ends - h / 3 * slope, ends], axis=1)
        shift = -int(self._runs[0])
        control, widths = np.roll(control, shift, axis=0), np.roll(widths, shift)
        return BezierPath(control, widths, self._runs - self._runs[0])

    def __len__(self) -> int:
        return len(self.indices)

    def __repr__(self) -> str:
        kind = "ring" if self.closed else "polyline"
        corners = f", {len(self.corners)} corners" if len(self.corners) else ""
        return f"<Spline: {kind} of {len(self)} points{corners}>"


def bezier_pieces(splines: Sequence[Spline], tolerance: float | None) -> list[FloatArray]:
    """Return the control points of each spline, all of them fitted side by side."""
    paths = [spline._path for spline in splines]
    controls = [path.control for path in paths]
    if tolerance is not None and paths:
        controls = _few(paths, splines, as_positive("tolerance", tolerance))
    return [
        np.ldexp(control, spline._exponent)
        for control, spline in zip(controls, splines, strict=True)
    ]


def _few(paths: list[BezierPath], splines: Sequence[Spline], tolerance: float) -> list[FloatArray]:
    sizes = np.cumsum([0] + [len(path.control) for path in paths])
    counts = np.cumsum([0] + [len(path.runs) - 1 for path in paths])
    runs = [path.runs[:-1] + size for path, size in zip(paths, sizes[:-1], strict=True)]
    joined = BezierPath(
        np.concatenate([path.control for path in paths]),
        np.concatenate([path.widths for path in paths]),
        np.append(np.concatenate(runs), sizes[-1]),
    )
    exponents = np.array([spline._exponent for spline in splines])
    limits = np.repeat(np.ldexp(tolerance, -exponents), np.diff(counts))
    control, starts = fewest_pieces(joined, limits)
    return np.split(control, starts[counts[1:-1]])
