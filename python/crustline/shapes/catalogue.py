"""Known smooth curves, as functions with their sources."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, as_points, not_too_deep
from crustline.errors import InputError, require
from crustline.scalars import as_positive, as_real, as_size, as_whole
from crustline.shapes.curve import (
    NARROWEST,
    WIDEST,
    Derivatives,
    Loop,
    SmoothCurve,
    Three,
    refuse_extent,
    turned,
)

TAU = 2 * math.pi
#: Waves round a shape, at the most; and the deviation of a blob's logarithm, beyond which its
#: narrowest part is less than a millionth of its extent.
MOST_WAVES, ROUGHEST = 1000, 3.0


def circle(r: float = 1.0) -> SmoothCurve:
    """Return the circle of radius r about the origin. Its medial axis is its center."""
    r = as_size("r", r)
    return SmoothCurve((Loop(partial(_elliptic, r, r), axis=np.zeros((1, 2))),))


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
    return SmoothCurve(
        (Loop(partial(_elliptic, a, b), axis=np.array([[-end[0], -end[1]], end]) + 0.0),)
    )


def _elliptic(a: float, b: float, u: FloatArray) -> Three:
    c, s = np.cos(TAU * u), np.sin(TAU * u)
    point = np.stack([a * c, b * s], -1)
    return point, TAU * np.stack([-a * s, b * c], -1), -(TAU**2) * point


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
    axis = np.array([[-length / 2, 0.0], [length / 2, 0.0]])
    return SmoothCurve((Loop(partial(_stadium, length, radius), 4, axis),))


def _stadium(length: float, radius: float, u: FloatArray) -> Three:
    total = 2 * (length + math.pi * radius)
    second = u >= 0.5
    s = (u - 0.5 * second) * total  # from the lower left joint, or its mirror image, on
    round_ = s >= length
    angle = np.where(round_, (s - length) / radius, 0.0) - math.pi / 2
    out = np.stack([np.cos(angle), np.sin(angle)], -1)
    point = radius * out + np.stack([np.minimum(s, length) - length / 2, 0 * s], -1)
    bend = -(total**2) / radius * out * round_[:, None]
    sign = np.where(second, -1.0, 1.0)[:, None]
    return sign * point, sign * total * turned(out), sign * bend


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

    polar = partial(_lobes, lobes, depth * radius, radius)
    return SmoothCurve((Loop(partial(_polar, polar), pieces=lobes),))


def _lobes(lobes: int, depth: float, radius: float, phi: FloatArray) -> Three:
    wave = depth * np.cos(lobes * phi)
    slope = -depth * lobes * np.sin(lobes * phi)
    return radius + wave, slope, -(lobes**2) * wave


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

    return SmoothCurve((Loop(partial(_polar, partial(_waves, wave, radius)), pieces=harmonics),))


def _waves(wave: FloatArray, radius: float, phi: FloatArray) -> Three:
    k = np.arange(1, wave.shape[1] + 1)
    c, s = np.cos(np.outer(phi, k)), np.sin(np.outer(phi, k))
    log1 = (k * s) @ -wave[0] + (k * c) @ wave[1]
    log2 = (k * k * c) @ -wave[0] - (k * k * s) @ wave[1]
    r = radius * np.exp(c @ wave[0] + s @ wave[1])
    return r, r * log1, r * (log2 + log1**2)


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
    polar = partial(_superformula, m / 4, -1 / n1, (n2, n3), (a, b))
    _refuse_radii(polar, max(m, 1))
    return SmoothCurve((Loop(partial(_polar, polar), pieces=max(m, 1)),))


def _superformula(
    k: float, p: float, n: tuple[float, float], axes: tuple[float, float], phi: FloatArray
) -> Three:
    c, s = np.cos(k * phi), np.sin(k * phi)
    one = _power(c, -k * s, -k * k * c, n[0], axes[0])
    f, f1, f2 = one + _power(s, k * c, -k * k * s, n[1], axes[1])
    bend = p * (p - 1) * f ** (p - 2) * f1**2 + p * f ** (p - 1) * f2
    return f**p, p * f ** (p - 1) * f1, bend


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


def _polar(polar: Derivatives, u: FloatArray) -> Three:
    phi = TAU * u
    r, r1, r2 = (x[:, None] for x in polar(phi))
    out = np.stack([np.cos(phi), np.sin(phi)], -1)
    side = turned(out)
    return r * out, TAU * (r1 * out + r * side), TAU**2 * ((r2 - r) * out + 2 * r1 * side)


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
        c = np.asarray(not_too_deep(coefficients, most=2), dtype=np.complex128)
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
    k = [0.0, 1.0] if len(c) == 2 else np.fft.fftfreq(len(c), 1 / len(c))

    return SmoothCurve((Loop(partial(_fourier, c, np.array(k, np.float64)), pieces=len(c)),))


def _fourier(c: npt.NDArray[np.complex128], k: FloatArray, u: FloatArray) -> Three:
    wave = np.exp(1j * TAU * np.outer(u, k))
    p, d1, d2 = (_plane(wave @ (c * (1j * TAU * k) ** order)) for order in range(3))
    return p, d1, d2


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
    require("smooth", "scipy")
    from scipy.interpolate import CubicSpline

    knots = np.concatenate([[0.0], np.cumsum(chords)])
    cubic = CubicSpline(knots / knots[-1], closed, bc_type="periodic")
    return SmoothCurve((Loop(partial(_cubic, cubic), pieces=len(rows)),))


def _cubic(cubic: Any, u: FloatArray) -> Three:
    return cubic(u), cubic(u, 1), cubic(u, 2)


def _plane(z: npt.NDArray[np.complex128]) -> FloatArray:
    return np.stack([z.real, z.imag], -1)
