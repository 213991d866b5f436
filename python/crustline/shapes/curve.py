"""A smooth curve, as the paper (§2) has it: closed loops that neither cross nor touch."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray, as_floats
from crustline.errors import InputError, shown
from crustline.scalars import LARGEST, as_real, as_rtol, as_size

if TYPE_CHECKING:
    from crustline.shapes.medial_axis import CurveMedialAxis

Three = tuple[FloatArray, FloatArray, FloatArray]
Derivatives = Callable[[FloatArray], Three]
#: Extents of smooth curves: some more than their parameters may say.
NARROWEST, WIDEST = 1e-65, 1e65
#: Extents as shares of the coordinates, at the least: rounding is a millionth of them.
FINEST = 1e-10


@dataclass(frozen=True, eq=False)
class Loop:
    """One closed loop: position, velocity and acceleration as functions of u in [0, 1).

    Parameters
    ----------
    derivatives : callable
        Takes u of shape (k,), gives three arrays of shape (k, 2): the point, its first and its
        second derivative by u. Curves can be pickled if it can.
    pieces : int
        How many pieces of equal length in u it is made of; a dozen points of each must show the
        loop's features.
    axis : ndarray of float64, shape (v, 2), optional
        Its medial axis if that is known: one point, or the two ends of a segment.
    """

    derivatives: Derivatives
    pieces: int = 1
    axis: FloatArray | None = None

    def moved(self, scale: float, angle: float, offset: FloatArray) -> Loop:
        """Return the loop scaled, then turned by angle (radians), then shifted."""
        c, s = scale * math.cos(angle), scale * math.sin(angle)
        turn = np.array([[c, s], [-s, c]])

        axis = None if self.axis is None else self.axis @ turn + offset
        return Loop(partial(_moved, self.derivatives, turn, offset), self.pieces, axis)


def _moved(of: Derivatives, turn: FloatArray, offset: FloatArray, u: FloatArray) -> Three:
    p, d1, d2 = of(u)
    return p @ turn + offset, d1 @ turn, d2 @ turn


@dataclass(frozen=True, eq=False)
class SmoothCurve:
    """A smooth curve: one or more closed loops that neither cross nor touch.

    Parameters
    ----------
    loops : tuple of Loop
        Its components. `curve + other` has the components of both.

    Notes
    -----
    Twice differentiable, as the paper asks, but where a shape's own docstring says that
    the curvature jumps; the medial axis and the local feature size are defined, and positive, there
    too. That the loops do not cross is checked when the medial axis is computed.

    Examples
    --------
    >>> from crustline.shapes import circle
    >>> ring = circle(2) + circle(1)
    >>> ring.point([0, 0.5]).tolist()
    [[2.0, 0.0], [1.0, 0.0]]
    >>> ring.curvature([0, 0.5]).tolist()
    [0.5, 1.0]
    """

    loops: tuple[Loop, ...] = field(repr=False)

    def __post_init__(self) -> None:
        if not self.loops:
            raise InputError("a smooth curve needs at least one loop")

    def __repr__(self) -> str:
        return f"SmoothCurve({len(self.loops)} {'loop' if len(self.loops) == 1 else 'loops'})"

    def __add__(self, other: SmoothCurve) -> SmoothCurve:
        return union(self, other)

    @property
    def components(self) -> tuple[SmoothCurve, ...]:
        """The loops, each as a curve of its own."""
        return tuple(SmoothCurve((loop,)) for loop in self.loops)

    def derivatives(self, t: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the point, the velocity and the acceleration at t, by the loop's own parameter.

        Parameters
        ----------
        t : array_like of float, any shape
            Finite; taken modulo 1.

        Returns
        -------
        point, velocity, acceleration : ndarray of float64, shape (..., 2)
        """
        t = as_floats("t", t)
        if not np.isfinite(t).all():
            raise InputError(f"t must be finite, not {t[~np.isfinite(t)].flat[0]}")
        loop, u = self._place(t.ravel())
        p, d1, d2 = (part.reshape((*t.shape, 2)) for part in self._on_loops(loop, u))
        return p, d1, d2

    def _place(self, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the loop of each t and the place on it; what rounding leaves of i/c is i/c."""
        c = len(self.loops)
        place = t % 1.0 * c
        whole = np.rint(place)
        place = np.where(np.abs(place - whole) <= c * np.finfo(float).eps, whole, place)
        loop = np.floor(place).astype(np.int64)
        return loop % c, place - loop

    def _on_loops(self, loop: IntArray, u: FloatArray) -> Three:
        """Return the same at places u, modulo 1, of loops by their number; all of shape (k,)."""
        u, loop = np.atleast_1d(u) % 1.0, np.atleast_1d(loop)
        out = np.empty((3, len(u), 2))
        order = np.argsort(loop, kind="stable")
        ends = np.searchsorted(loop[order], np.arange(len(self.loops) + 1))
        for i in np.flatnonzero(np.diff(ends)):
            rows = order[ends[i] : ends[i + 1]]
            out[:, rows] = self.loops[i].derivatives(u[rows])
        return out[0], out[1], out[2]

    def point(self, t: npt.ArrayLike) -> FloatArray:
        """Return the points at t, shape (..., 2)."""
        return self.derivatives(t)[0]

    def tangent(self, t: npt.ArrayLike) -> FloatArray:
        """Return the unit tangents at t, in the direction of growing t, shape (..., 2)."""
        return unit(self.derivatives(t)[1])

    def normal(self, t: npt.ArrayLike) -> FloatArray:
        """Return the unit normals at t, to the left of the tangents, shape (..., 2)."""
        return turned(self.tangent(t))

    def curvature(self, t: npt.ArrayLike) -> FloatArray:
        """Return the curvature at t, positive where the curve turns to the left, shape (...)."""
        _, d1, d2 = self.derivatives(t)
        return bend(d1, d2)

    def moved(
        self, *, scale: float = 1.0, angle: float = 0.0, offset: npt.ArrayLike = (0.0, 0.0)
    ) -> SmoothCurve:
        """Return the curve scaled about the origin, turned by angle (radians), then shifted."""
        size, turn, shift = as_size("scale", scale), as_real("angle", angle), _as_offset(offset)
        return SmoothCurve(tuple(loop.moved(size, turn, shift) for loop in self.loops))

    def medial_axis(self, *, rtol: float = 1e-4) -> CurveMedialAxis:
        """Return the medial axis, for a local feature size within rtol.

        Parameters
        ----------
        rtol : float
            In [1e-6, 0.1]. Bound for the relative error of the distance from the curve to the axis.

        Returns
        -------
        medial_axis : CurveMedialAxis
            All components count: the axis runs between them, too. It is kept for the next call.

        Raises
        ------
        InputError
            If the curve crosses or touches itself, so that its medial axis meets it; if it is not
            finite, or its extent is not between 1e-65 and 1e+65.

        Notes
        -----
        A single circle, ellipse or stadium has its axis in closed form. Otherwise the axis
        is traced by vertices no farther apart than √(8 rtol) times the radii of their disks. The
        nearest point of the axis to a point of the curve is at least that radius away and the line
        to it is perpendicular to the axis (or it is an end of the axis, where vertices crowd), so
        the nearest vertex is within a factor 1 + rtol as long as the axis between two vertices
        stays within the disk on the segment between them; the segments make the error smaller
        still, in general by more than ten times. Features narrower than about 10⁻⁵ of the length of
        their loop may be missed.
        """
        from crustline.shapes.medial_axis import medial_axis

        return medial_axis(self, as_rtol(rtol))

    def local_feature_size(self, t: npt.ArrayLike, *, rtol: float = 1e-4) -> FloatArray:
        """Return the local feature size at t: the distance from the points to the medial axis.

        Parameters
        ----------
        t : array_like of float, any shape
            Finite; taken modulo 1.
        rtol : float
            In [1e-6, 0.1]. The relative error asked for.

        Returns
        -------
        sizes : ndarray of float64, shape of t
            In the unit of the curve.

        Raises
        ------
        InputError
            If the curve crosses or touches itself, or t is not finite.

        Notes
        -----
        Exact up to rounding for one circle, ellipse or stadium, whose medial axes are known;
        otherwise within `rtol`, see `medial_axis`. It is 1-Lipschitz in the distance (but not
        differentiable), never larger than the radius of curvature, and scales with the curve.

        References
        ----------
        .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
           Reconstruction", Graphical Models and Image Processing 60 (1998), 125–135. Sections 4
           and 5.

        Examples
        --------
        >>> from crustline.shapes import ellipse
        >>> ellipse(2, 1).local_feature_size([0, 0.25]).tolist()
        [0.5, 1.0]
        """
        points = self.point(t)
        return (
            self.medial_axis(rtol=rtol).distance(points.reshape(-1, 2)).reshape(points.shape[:-1])
        )


def union(*curves: SmoothCurve) -> SmoothCurve:
    """Return the curve that has the loops of all the given curves, nested or side by side.

    Examples
    --------
    >>> from crustline.shapes import circle
    >>> union(circle(3), circle(1), circle(1).moved(offset=(5, 0)))
    SmoothCurve(3 loops)
    """
    smooth = (as_curve(curve) for curve in curves)
    return SmoothCurve(tuple(loop for curve in smooth for loop in curve.loops))


def as_curve(curve: object) -> SmoothCurve:
    """Return a known smooth curve as it is, or an `InputError` for anything else."""
    if isinstance(curve, SmoothCurve):
        return curve
    raise InputError(f"curve is {shown(curve)}, not a SmoothCurve: pass one of crustline.shapes")


def refuse_extent(points: FloatArray) -> None:
    """Refuse points of a smooth curve that are too far from one another, too near, or too far."""
    with np.errstate(over="ignore"):
        extent = float(np.ptp(points, axis=0).max())
    if not NARROWEST <= extent <= WIDEST:
        raise InputError(
            f"the curve is {extent:g} across, not between {NARROWEST:g} and {WIDEST:g}: scale it"
        )
    farthest = float(np.abs(points).max())
    if farthest * FINEST > extent:
        raise InputError(
            f"the curve is {extent:g} across, with the coordinate {farthest:g}, which float64 "
            "cannot tell apart well enough: shift it to the origin"
        )


def _as_offset(offset: npt.ArrayLike) -> FloatArray:
    shift = as_floats("offset", offset)
    if shift.shape != (2,) or not (np.abs(shift) <= LARGEST).all():
        raise InputError(
            f"offset must be a pair of numbers no larger than {LARGEST:g}, not {shown(offset)}"
        )
    return shift


def bend(d1: FloatArray, d2: FloatArray) -> FloatArray:
    """Return the curvature, given the first and the second derivative by any parameter."""
    cross = d1[..., 0] * d2[..., 1] - d1[..., 1] * d2[..., 0]
    return np.asarray(cross / np.hypot(d1[..., 0], d1[..., 1]) ** 3)


def turned(v: FloatArray) -> FloatArray:
    """Return vectors turned by a quarter counter-clockwise."""
    return np.stack([-v[..., 1], v[..., 0]], -1)


def unit(v: FloatArray) -> FloatArray:
    return np.asarray(v / np.hypot(v[..., 0], v[..., 1])[..., None])
