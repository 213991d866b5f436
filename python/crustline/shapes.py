"""Known smooth curves and point sets, as functions with their sources.

A `SmoothCurve` is what the paper (§2) calls a smooth curve: one or more closed loops that neither
cross nor touch. `t` in [0, 1) runs over all of them; with c loops the first has [0, 1/c), the
second [1/c, 2/c), and so on. `crustline.local_feature_size` measures such a curve and
`crustline.r_sample` samples it.
"""

from __future__ import annotations

import io
import math
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import as_points
from crustline.errors import FormatError, InputError, missing_extra
from crustline.scalars import LARGEST, as_positive, as_real, as_size, as_whole

if TYPE_CHECKING:
    from crustline.feature_size import CurveMedialAxis

__all__ = [
    "Loop",
    "SmoothCurve",
    "bezier_path",
    "blob",
    "circle",
    "ellipse",
    "fourier",
    "lattice",
    "regular_polygon",
    "spline",
    "stadium",
    "superformula",
    "trefoil",
    "two_octagons",
    "two_octagons_joined",
    "two_octagons_separate",
    "union",
]

FloatArray = npt.NDArray[np.float64]
Derivatives = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
TAU = 2 * math.pi
#: Extents of smooth curves: some more than their parameters may say.
NARROWEST, WIDEST = 1e-65, 1e65
#: Extents as shares of the coordinates, at the least: rounding is a millionth of them.
FINEST = 1e-10
#: Waves round a shape, at the most; and the deviation of a blob's logarithm, beyond which its
#: narrowest part is less than a millionth of its extent.
MOST_WAVES, ROUGHEST = 1000, 3.0


@dataclass(frozen=True, eq=False)
class Loop:
    """One closed loop: position, velocity and acceleration as functions of u in [0, 1).

    Parameters
    ----------
    derivatives : callable
        Takes u of shape (k,), gives three arrays of shape (k, 2): the point, its first and its
        second derivative by u.
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

        def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            p, d1, d2 = self.derivatives(u)
            return p @ turn + offset, d1 @ turn, d2 @ turn

        axis = None if self.axis is None else self.axis @ turn + offset
        return Loop(derivatives, self.pieces, axis)


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
        t = np.asarray(t, dtype=np.float64)
        if not np.isfinite(t).all():
            raise InputError(f"t must be finite, not {t[~np.isfinite(t)].flat[0]}")
        place = (t.ravel() % 1.0) * len(self.loops)
        which = np.minimum(place.astype(np.int64), len(self.loops) - 1)
        out = np.empty((3, t.size, 2))
        for i, loop in enumerate(self.loops):
            here = which == i
            out[:, here] = loop.derivatives(place[here] - i)
        shaped = out.reshape((3, *t.shape, 2))
        return shaped[0], shaped[1], shaped[2]

    def point(self, t: npt.ArrayLike) -> FloatArray:
        """Return the points at t, shape (..., 2)."""
        return self.derivatives(t)[0]

    def tangent(self, t: npt.ArrayLike) -> FloatArray:
        """Return the unit tangents at t, in the direction of growing t, shape (..., 2)."""
        return _unit(self.derivatives(t)[1])

    def normal(self, t: npt.ArrayLike) -> FloatArray:
        """Return the unit normals at t, to the left of the tangents, shape (..., 2)."""
        return _turned(self.tangent(t))

    def curvature(self, t: npt.ArrayLike) -> FloatArray:
        """Return the curvature at t, positive where the curve turns to the left, shape (...)."""
        _, d1, d2 = self.derivatives(t)
        cross = d1[..., 0] * d2[..., 1] - d1[..., 1] * d2[..., 0]
        return np.asarray(cross / np.hypot(d1[..., 0], d1[..., 1]) ** 3)

    def moved(
        self, *, scale: float = 1.0, angle: float = 0.0, offset: npt.ArrayLike = (0.0, 0.0)
    ) -> SmoothCurve:
        """Return the curve scaled about the origin, turned by angle (radians), then shifted."""
        size, turn, shift = as_size("scale", scale), as_real("angle", angle), _as_offset(offset)
        return SmoothCurve(tuple(loop.moved(size, turn, shift) for loop in self.loops))

    def medial_axis(self, *, rtol: float = 1e-4) -> CurveMedialAxis:
        """Return the medial axis: see `crustline.feature_size.medial_axis_of_curve`."""
        from crustline.feature_size import medial_axis_of_curve

        return medial_axis_of_curve(self, rtol=rtol)


def union(*curves: SmoothCurve) -> SmoothCurve:
    """Return the curve that has the loops of all the given curves, nested or side by side.

    Examples
    --------
    >>> union(circle(3), circle(1), circle(1).moved(offset=(5, 0)))
    SmoothCurve(3 loops)
    """
    for i, curve in enumerate(curves):
        if not isinstance(curve, SmoothCurve):
            raise InputError(f"curve {i} is {curve!r:.60}, not a SmoothCurve")
    return SmoothCurve(tuple(loop for curve in curves for loop in curve.loops))


def circle(r: float = 1.0) -> SmoothCurve:
    """Return the circle of radius r about the origin. Its medial axis is its center."""
    r = as_size("r", r)
    return SmoothCurve((Loop(_elliptic(r, r), axis=np.zeros((1, 2))),))


def ellipse(a: float, b: float) -> SmoothCurve:
    """Return the ellipse with semi-axes a along x and b along y, counter-clockwise.

    Notes
    -----
    With a ≥ b its medial axis is the segment |x| ≤ (a² − b²)/a, y = 0: its ends are the
    centers of the osculating circles at the ends of the longer axis. Outside of a convex curve
    there is no medial axis.

    Examples
    --------
    >>> ellipse(2, 1).medial_axis().vertices.tolist()
    [[-1.5, 0.0], [1.5, 0.0]]
    """
    a, b = as_size("a", a), as_size("b", b)
    if a == b:
        return circle(a)
    end = [(a * a - b * b) / a, 0.0] if a > b else [0.0, (b * b - a * a) / b]
    return SmoothCurve((Loop(_elliptic(a, b), axis=np.array([[-end[0], -end[1]], end]) + 0.0),))


def _elliptic(a: float, b: float) -> Derivatives:
    def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        c, s = np.cos(TAU * u), np.sin(TAU * u)
        point = np.stack([a * c, b * s], -1)
        return point, TAU * np.stack([-a * s, b * c], -1), -(TAU**2) * point

    return derivatives


def stadium(length: float, radius: float) -> SmoothCurve:
    """Return the stadium: two straight sides of `length`, closed by half circles of `radius`.

    Notes
    -----
    Only once differentiable: the curvature jumps from 0 to 1/radius at the four joints.
    Its medial axis is the segment |x| ≤ length/2, y = 0, and its local feature size is at most, and
    along the sides exactly, the radius. It is parametrized by arc length.

    Examples
    --------
    >>> stadium(4, 1).medial_axis().vertices.tolist()
    [[-2.0, 0.0], [2.0, 0.0]]
    """
    length, radius = as_size("length", length), as_size("radius", radius)
    half, turn = length / 2, math.pi * radius
    total = 2 * (length + turn)

    def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        second = u >= 0.5
        s = (u - 0.5 * second) * total  # from the lower left joint, or its mirror image, on
        round_ = s >= length
        angle = np.where(round_, (s - length) / radius, 0.0) - math.pi / 2
        out = np.stack([np.cos(angle), np.sin(angle)], -1)
        point = radius * out + np.stack([np.minimum(s, length) - half, 0 * s], -1)
        bend = -(total**2) / radius * out * round_[:, None]
        sign = np.where(second, -1.0, 1.0)[:, None]
        return sign * point, sign * total * _turned(out), sign * bend

    return SmoothCurve((Loop(derivatives, 4, np.array([[-half, 0.0], [half, 0.0]])),))


def trefoil(lobes: int = 3, depth: float = 0.3, radius: float = 1.0) -> SmoothCurve:
    """Return the trefoil-like blob r(φ) = radius · (1 + depth · cos(lobes · φ)).

    Parameters
    ----------
    lobes : int
        Three gives a trefoil. From 1 to 1000.
    depth : float
        In [0, 1): how far the lobes stand out.
    radius : float
        The mean radius.

    Examples
    --------
    >>> trefoil(3, 0.5).point(0).tolist()
    [1.5, 0.0]
    """
    lobes, radius = as_whole("lobes", lobes, 1, MOST_WAVES), as_size("radius", radius)
    if not 0 <= (depth := as_real("depth", depth, "in [0, 1)")) < 1:
        raise InputError(f"depth must be in [0, 1), not {depth}")

    def polar(phi: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        wave = depth * radius * np.cos(lobes * phi)
        slope = -depth * radius * lobes * np.sin(lobes * phi)
        return radius + wave, slope, -(lobes**2) * wave

    return SmoothCurve((Loop(_polar(polar), pieces=lobes),))


def blob(
    seed: int, *, harmonics: int = 5, roughness: float = 0.4, radius: float = 1.0
) -> SmoothCurve:
    """Return a random star-shaped blob, the same for the same seed.

    Parameters
    ----------
    seed : int
        Seeds `numpy.random.default_rng`. At least 0.
    harmonics : int
        How many waves go round the blob at the most. From 1 to 1000.
    roughness : float
        Standard deviation of the logarithm of the polar radius. From 0, which gives a circle, to 3.
    radius : float
        The geometric mean of the polar radius.

    Notes
    -----
    The logarithm of the polar radius is a random trigonometric polynomial without
    constant term, whose k-th harmonic is weighted by 1/k; so the blob never crosses itself.

    Examples
    --------
    >>> bool(np.all(blob(7).point([0, 0.3]) == blob(7).point([0, 0.3])))
    True
    """
    seed, harmonics = as_whole("seed", seed, 0), as_whole("harmonics", harmonics, 1, MOST_WAVES)
    span = f"from 0 to {ROUGHEST:g}"
    if not 0 <= (roughness := as_real("roughness", roughness, span)) <= ROUGHEST:
        raise InputError(f"roughness must be {span}, not {roughness}")
    radius = as_size("radius", radius)
    k = np.arange(1, harmonics + 1)
    draw = np.random.default_rng(seed).standard_normal((2, harmonics)) / k
    wave = draw * (roughness / math.sqrt(np.sum(1.0 / k**2)))

    def polar(phi: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        c, s = np.cos(np.outer(phi, k)), np.sin(np.outer(phi, k))
        log1 = (k * s) @ -wave[0] + (k * c) @ wave[1]
        log2 = (k * k * c) @ -wave[0] - (k * k * s) @ wave[1]
        r = radius * np.exp(c @ wave[0] + s @ wave[1])
        return r, r * log1, r * (log2 + log1**2)

    return SmoothCurve((Loop(_polar(polar), pieces=harmonics),))


def superformula(
    m: int, n1: float, n2: float, n3: float, *, a: float = 1.0, b: float = 1.0
) -> SmoothCurve:
    """Return Gielis' superformula, r(φ) = (|cos(mφ/4)/a|^n2 + |sin(mφ/4)/b|^n3)^(−1/n1).

    Parameters
    ----------
    m : int
        The rotational symmetry. Even, or the curve would not close in one turn; from 0 to 1000.
    n1, n2, n3 : float
        The exponents. n1 > 0; n2 and n3 at least 2, or the curve would have corners or unbounded
        curvature.
    a, b : float
        The two axes.

    Raises
    ------
    InputError
        If a parameter is out of its range, or the radius would leave that from 1e-65 to 1e+65.

    References
    ----------
    .. [1] J. Gielis, "A generic geometric transformation that unifies a wide range of natural
       and abstract shapes", American Journal of Botany 90 (2003), 333–338.

    Examples
    --------
    >>> superformula(4, 2, 2, 2).point([0, 0.25]).round(12).tolist()
    [[1.0, 0.0], [0.0, 1.0]]
    """
    m, n1 = as_whole("m", m, 0, MOST_WAVES), as_positive("n1", n1)
    if m % 2:
        raise InputError(f"m must be an even whole number, not {m}: other curves do not close")
    n2, n3 = _as_exponent("n2", n2), _as_exponent("n3", n3)
    a, b = as_size("a", a), as_size("b", b)
    k, p = m / 4, -1 / n1

    def polar(phi: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        c, s = np.cos(k * phi), np.sin(k * phi)
        f, f1, f2 = _power(c, -k * s, -k * k * c, n2, a) + _power(s, k * c, -k * k * s, n3, b)
        bend = p * (p - 1) * f ** (p - 2) * f1**2 + p * f ** (p - 1) * f2
        return f**p, p * f ** (p - 1) * f1, bend

    _refuse_radii(polar, max(m, 1))
    return SmoothCurve((Loop(_polar(polar), pieces=max(m, 1)),))


def _as_exponent(name: str, value: float) -> float:
    return as_real(name, value, "at least 2 for a smooth curve", lambda x: x >= 2)


def _refuse_radii(polar: Derivatives, waves: int) -> None:
    """Refuse a superformula whose powers leave the range of sizes, or of float64."""
    with np.errstate(all="ignore"):
        r, slope, bend = polar(TAU * np.arange(64 * waves) / (64 * waves))
        fine = (r >= NARROWEST) & (r <= WIDEST) & np.isfinite(slope) & np.isfinite(bend)
    if not fine.all():
        raise InputError(
            f"the radius of this superformula is {r[np.argmin(fine)]:g} somewhere, not between "
            f"{NARROWEST:g} and {WIDEST:g}: choose less extreme n1, n2, n3, a and b"
        )


def _power(x: FloatArray, x1: FloatArray, x2: FloatArray, n: float, a: float) -> FloatArray:
    """Return |x/a|^n and its two derivatives, given those of x, shape (3, k)."""
    y, low = np.abs(x) / a, np.abs(x / a) ** (n - 2)
    sign = np.sign(x) / a
    first = n * low * y * sign * x1
    second = n * (n - 1) * low * (x1 / a) ** 2 + n * low * y * sign * x2
    return np.stack([low * y * y, first, second])


def _polar(polar: Derivatives) -> Derivatives:
    def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        phi = TAU * u
        r, r1, r2 = (x[:, None] for x in polar(phi))
        out = np.stack([np.cos(phi), np.sin(phi)], -1)
        side = _turned(out)
        return r * out, TAU * (r1 * out + r * side), TAU**2 * ((r2 - r) * out + 2 * r1 * side)

    return derivatives


def fourier(coefficients: npt.ArrayLike) -> SmoothCurve:
    """Return the curve with the given Fourier descriptors: x + iy = Σ c_k exp(2πi k t).

    Parameters
    ----------
    coefficients : array_like of complex, shape (n,)
        In the order of `numpy.fft`: k = 0, 1, …, then the negative ones. For n points z = x + iy of
        a contour these are `numpy.fft.fft(z) / n`.

    Raises
    ------
    InputError
        If a coefficient is not finite, all but the first are zero, or the largest is not between
        1e-60 and 1e+60. That the curve crosses itself is found when its medial axis is computed.

    References
    ----------
    .. [1] G. H. Granlund, "Fourier preprocessing for hand print character recognition", IEEE
       Transactions on Computers C-21 (1972), 195–201.

    Examples
    --------
    >>> fourier([1j, 2]).point([0, 0.25]).round(12).tolist()
    [[2.0, 1.0], [0.0, 3.0]]
    """
    try:
        c = np.asarray(coefficients, dtype=np.complex128)
    except (ValueError, TypeError, OverflowError):
        c = np.empty((), dtype=np.complex128)
    if c.ndim != 1 or not np.isfinite(c).all():
        raise InputError("coefficients must be a row of finite complex numbers")
    if not np.any(c[1:]):
        raise InputError("coefficients must hold one besides the first that is not zero")
    as_size("the largest coefficient", float(np.abs(c).max()))
    as_size("the largest coefficient besides the first", float(np.abs(c[1:]).max()))
    # fftfreq calls the highest frequency of an even row negative; one coefficient of two is the
    # positive one.
    k = np.fft.fftfreq(len(c), 1 / len(c)) if len(c) != 2 else np.array([0.0, 1.0])

    def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        wave = np.exp(1j * TAU * np.outer(u, k))
        p, d1, d2 = (_plane(wave @ (c * (1j * TAU * k) ** order)) for order in range(3))
        return p, d1, d2

    return SmoothCurve((Loop(derivatives, pieces=len(c)),))


def spline(points: npt.ArrayLike) -> SmoothCurve:
    """Return the periodic cubic spline through points, in their order.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        At least three; the first is not repeated at the end.

    Raises
    ------
    InputError
        If there are fewer than three points, one is not finite, two neighbors are equal, or the
        extent is not between 1e-65 and 1e+65.
    MissingExtraError
        If scipy is not installed (extra `smooth`).

    Notes
    -----
    Twice differentiable, parametrized by chord length. Whether it crosses itself is
    found when its medial axis is computed.
    """
    rows = as_points(points)
    if len(rows) < 3:
        raise InputError(f"a spline needs at least 3 points, not {len(rows)}")
    refuse_extent(rows)
    closed = np.vstack([rows, rows[:1]])
    chords = np.hypot(*np.diff(closed, axis=0).T)
    if not np.all(chords > 0):
        raise InputError(f"point {int(np.argmin(chords > 0))} equals the one that follows it")
    try:
        from scipy.interpolate import CubicSpline
    except ImportError:
        raise missing_extra("smooth", "scipy") from None
    knots = np.concatenate([[0.0], np.cumsum(chords)])
    cubic = CubicSpline(knots / knots[-1], closed, bc_type="periodic")
    return SmoothCurve((Loop(lambda u: (cubic(u), cubic(u, 1), cubic(u, 2)), pieces=len(rows)),))


def bezier_path(source: str | os.PathLike[str], *, smooth_joins: float = 1.0) -> SmoothCurve:
    """Return the closed cubic Bézier paths of an SVG file, or of one path string.

    Parameters
    ----------
    source : str or path
        A file whose name ends in .svg, or the `d` of a path such as "M 1 0 C …". Lines, quadratic
        curves and arcs are raised to cubics; transforms are applied; the coordinates stay those
        of the file's d attributes, whatever size in pixels its viewBox has, so y grows downwards.
    smooth_joins : float
        Degrees. Joints that turn by less (files round their handles) are made smooth: both handles
        turn to the mean direction. A joint that turns by more is a corner, which no smooth curve
        has.

    Raises
    ------
    InputError
        If a subpath is open or has a corner (the message names it), or there is none; if the
        string is no path.
    FormatError
        If the file cannot be read, or is no SVG.
    MissingExtraError
        If svgelements is not installed (extra `svg`).

    Notes
    -----
    Once differentiable: the curvature may jump where two pieces meet. Arcs become
    cubics with an error of about 3 · 10⁻⁴ of their radius or less.

    Examples
    --------
    >>> loop = bezier_path("M 0 0 C 0 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z")
    >>> loop.point([0, 0.25, 0.5]).tolist()
    [[0.0, 0.0], [1.0, 1.125], [2.0, 0.0]]
    """
    tolerance = as_real("smooth_joins", smooth_joins, "in [0, 180)", lambda x: 0 <= x < 180)
    loops = []
    for i, pieces in enumerate(_svg_subpaths(source)):
        control = _smoothed(pieces, math.radians(tolerance), f"subpath {i}")
        loops.append(Loop(_bezier(control), pieces=len(control)))
    if not loops:
        raise InputError(f"{os.fspath(source)[:60] or 'an empty text'} holds no path")
    return SmoothCurve(tuple(loops))


def _svg_subpaths(source: str | os.PathLike[str]) -> Iterable[FloatArray]:
    """Yield each subpath's cubic pieces, as control points of shape (s, 4, 2)."""
    try:
        import svgelements  # type: ignore[import-untyped]
    except ImportError:
        raise missing_extra("svg", "svgelements") from None
    if not isinstance(source, str | os.PathLike):
        raise InputError(f"source is {source!r:.60}: give the name of a .svg file, or a path's d")
    name = os.fspath(source)
    if name.lower().endswith(".svg"):
        paths = _paths_of_file(svgelements, name)
    else:
        paths = [_path_of_text(svgelements, name)]
    for path in paths:
        for subpath in path.as_subpaths():
            cubics = [c for segment in subpath for c in _cubics(svgelements, segment)]
            if cubics:
                yield np.array(cubics)


def _path_of_text(svg: Any, text: str) -> Any:
    try:
        return svg.Path(text)
    except (ValueError, TypeError, AttributeError, IndexError):  # as it comes upon a wrong letter
        raise InputError(
            f"{text[:60]!r} is neither the d of a path, such as 'M 1 0 C …', nor a .svg file"
        ) from None


def _paths_of_file(svg: Any, name: str) -> list[Any]:
    """Return the paths of an SVG file, in the coordinates within its viewBox."""
    from xml.etree import ElementTree

    from crustline.formats.file import read_bytes

    try:
        root = ElementTree.fromstring(read_bytes(name))
    except ElementTree.ParseError as error:
        raise FormatError(f"{name} is no SVG: {error}") from None
    if root.tag.rpartition("}")[2] != "svg":
        raise FormatError(f"{name} is no SVG: its outermost element is {root.tag!r:.60}")
    box = root.attrib.pop("viewBox", "").replace(",", " ").split()
    if len(box) == 4:
        # A drawing as large as its viewBox is neither scaled nor, from 0 on, shifted.
        root.attrib.update(width=box[2], height=box[3], viewBox=f"0 0 {box[2]} {box[3]}")
    text = io.BytesIO(ElementTree.tostring(root))
    shapes = svg.SVG.parse(text, reify=True).elements()
    return [svg.Path(each) for each in shapes if isinstance(each, svg.Shape)]


def _cubics(svg: Any, segment: Any) -> list[list[list[float]]]:
    """Return a path segment as control points of cubics; none for a move or an empty line."""
    if isinstance(segment, svg.Move) or segment.start is None or segment.start == segment.end:
        return []
    if isinstance(segment, svg.Arc):
        return [row for cubic in segment.as_cubic_curves() for row in _cubics(svg, cubic)]
    if isinstance(segment, svg.CubicBezier):
        corners = [segment.start, segment.control1, segment.control2, segment.end]
        return [[[float(p.x), float(p.y)] for p in corners]]
    a, z = (np.array([float(p.x), float(p.y)]) for p in (segment.start, segment.end))
    if isinstance(segment, svg.QuadraticBezier):
        middle = np.array([float(segment.control.x), float(segment.control.y)])
        return [
            [
                a.tolist(),
                ((a + 2 * middle) / 3).tolist(),
                ((z + 2 * middle) / 3).tolist(),
                z.tolist(),
            ]
        ]
    return [[a.tolist(), ((2 * a + z) / 3).tolist(), ((a + 2 * z) / 3).tolist(), z.tolist()]]


def _smoothed(control: FloatArray, tolerance: float, name: str) -> FloatArray:
    """Return control points with handles exactly opposite at each joint; refuse corners."""
    refuse_extent(control.reshape(-1, 2))
    size = float(np.ptp(control.reshape(-1, 2), axis=0).max())
    gap = np.abs(np.roll(control[:, 0], -1, axis=0) - control[:, 3]).max(axis=1)
    if np.any(gap > 1e-9 * size):
        x, y = control[int(np.argmax(gap)), 3]
        raise InputError(f"{name} is open at ({x:g}, {y:g}): close it with Z, or leave it out")
    out = control.copy()
    out[:, 3] = np.roll(control[:, 0], -1, axis=0)
    ahead, behind = out[:, 1] - out[:, 0], np.roll(out[:, 3] - out[:, 2], 1, axis=0)
    length = np.stack([np.hypot(*ahead.T), np.hypot(*behind.T)])
    if not np.all(length > 0):
        x, y = out[int(np.argmin(length.min(axis=0))), 0]
        raise InputError(
            f"{name} has a handle of length zero at ({x:g}, {y:g}): give it a direction"
        )
    turn = np.abs(np.arctan2(_cross(behind, ahead), np.sum(behind * ahead, axis=1)))
    if np.any(turn > tolerance):
        row = int(np.argmax(turn))
        x, y = out[row, 0]
        raise InputError(
            f"{name} has a corner of {math.degrees(turn[row]):.3g}° at ({x:g}, {y:g}): round it"
        )
    mean = _unit(_unit(ahead) + _unit(behind))
    out[:, 1] = out[:, 0] + length[0][:, None] * mean
    out[:, 2] = out[:, 3] - np.roll(length[1][:, None] * mean, -1, axis=0)
    return out


def _bezier(control: FloatArray) -> Derivatives:
    s = len(control)
    first = 3 * s * np.diff(control, axis=1)
    second = 2 * s * np.diff(first, axis=1)

    def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        row = np.minimum((u * s).astype(np.int64), s - 1)
        v = (u * s - row)[:, None]
        w = 1 - v
        c, d, e = control[row], first[row], second[row]
        p = w**3 * c[:, 0] + 3 * v * w * (w * c[:, 1] + v * c[:, 2]) + v**3 * c[:, 3]
        return p, w * w * d[:, 0] + 2 * v * w * d[:, 1] + v * v * d[:, 2], w * e[:, 0] + v * e[:, 1]

    return derivatives


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


def regular_polygon(n: int, radius: float = 1.0) -> FloatArray:
    """Return the vertices of a regular polygon, counter-clockwise from (radius, 0), (n, 2)."""
    n, radius = as_whole("n", n, 0), as_positive("radius", radius)
    angle = TAU * np.arange(n) / n
    return radius * np.stack([np.cos(angle), np.sin(angle)], -1)


def lattice(n: int, m: int | None = None) -> FloatArray:
    """Return the n × m integer lattice (default n × n), row by row from (0, 0), (n · m, 2).

    Examples
    --------
    >>> lattice(2, 3).tolist()
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.0, 2.0], [1.0, 2.0]]
    """
    n = as_whole("n", n, 0)
    m = n if m is None else as_whole("m", m, 0)
    y, x = np.divmod(np.arange(n * m), max(n, 1))
    return np.stack([x, y], -1).astype(np.float64)


def two_octagons() -> FloatArray:
    """Return the points of the paper's Figure 6: two regular octagons side by side, (16, 2).

    Each has the circumradius 1; the two sides that face each other are opposite sides of a square.
    Rows 0 to 7 are the left octagon, counter-clockwise from the upper end of that side, rows 8 to
    15 the right one, from the lower.

    Notes
    -----
    The points 1-sample `two_octagons_separate()` and `two_octagons_joined()`, which
    join them differently: for r ≥ 1 a polygonal reconstruction need not be unique (Observation 6).

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125–135. Section 5, Figure
       6.

    Examples
    --------
    >>> p = two_octagons()
    >>> (p[[0, 15]] - p[[7, 8]]).round(6).tolist()
    [[0.0, 0.765367], [0.0, 0.765367]]
    """
    angle = (np.arange(8) + 0.5) * math.pi / 4
    center = math.cos(math.pi / 8) + math.sin(math.pi / 8)
    left = np.stack([np.cos(angle) - center, np.sin(angle)], -1)
    return np.concatenate([left, -left])


def two_octagons_separate() -> SmoothCurve:
    """Return the curve of Figure 6 with two loops, one for each octagon of `two_octagons`.

    Once differentiable. The 16 points are a 0.982-sample of it: a little better than Figure 6 says.
    """
    return _through_octagons(joined=False)


def two_octagons_joined() -> SmoothCurve:
    """Return the curve of Figure 6 with one loop, through both octagons of `two_octagons`.

    Once differentiable. The 16 points are a 0.983-sample of it: a little better than Figure 6 says.
    """
    return _through_octagons(joined=True)


def _through_octagons(joined: bool) -> SmoothCurve:
    """Return Bézier loops through the octagons: their circles, but beside the square."""
    quarter = _octagon_quarter(two_octagons(), joined)
    half = np.concatenate([quarter, (quarter[::-1, ::-1]) * [1, -1]])
    controls = [np.concatenate([half, -half])] if joined else [half, -half]
    return SmoothCurve(tuple(Loop(_bezier(control), len(control)) for control in controls))


def _octagon_quarter(corners: FloatArray, joined: bool) -> FloatArray:
    """Return the pieces above the x axis around the left octagon, from the middle of the square on.

    The directions (degrees) and handles were found by a search for a small sampling ratio.
    """
    if joined:
        start, direction = (0.0, 0.3895), [180.0, 162.3, 134.7, 223.3, 247.5, 270.0]
        ahead, back = [0.2, 0.32, 0.294, 0.265, 0.132], [0.12, 0.242, 0.246, 0.265, 0.132]
    else:
        start, direction = (-0.39, 0.0), [90.0, 83.7, 172.7, 202.5, 247.5, 270.0]
        ahead, back = [0.125, 0.22, 0.265, 0.265, 0.132], [0.125, 0.43, 0.265, 0.265, 0.132]
    west = (corners[3] + corners[4]) / 2
    west[0] -= 1 - math.cos(math.pi / 8)
    points = np.array([start, *corners[:4], west])
    angle = np.radians(direction)
    handle = np.stack([np.cos(angle), np.sin(angle)], -1)
    leave = points[:-1] + np.array(ahead)[:, None] * handle[:-1]
    arrive = points[1:] - np.array(back)[:, None] * handle[1:]
    return np.stack([points[:-1], leave, arrive, points[1:]], axis=1)


def _as_offset(offset: npt.ArrayLike) -> FloatArray:
    try:
        shift = np.asarray(offset, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        shift = np.array(np.nan)
    if shift.shape != (2,) or not (np.abs(shift) <= LARGEST).all():
        raise InputError(
            f"offset must be a pair of numbers no larger than {LARGEST:g}, not {offset!r:.60}"
        )
    return shift


def _turned(v: FloatArray) -> FloatArray:
    """Return vectors turned by a quarter counter-clockwise."""
    return np.stack([-v[..., 1], v[..., 0]], -1)


def _unit(v: FloatArray) -> FloatArray:
    return np.asarray(v / np.hypot(v[..., 0], v[..., 1])[..., None])


def _cross(v: FloatArray, w: FloatArray) -> FloatArray:
    return np.asarray(v[:, 0] * w[:, 1] - v[:, 1] * w[:, 0])


def _plane(z: npt.NDArray[np.complex128]) -> FloatArray:
    return np.stack([z.real, z.imag], -1)
