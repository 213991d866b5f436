"""Known point sets, and the curves of the paper's Figure 6 through one of them."""

from __future__ import annotations

import math

import numpy as np

from crustline.arrays import FloatArray
from crustline.scalars import MOST_POINTS, as_positive, as_whole
from crustline.shapes.bezier import bezier_loop
from crustline.shapes.curve import SmoothCurve


def regular_polygon(n: int, radius: float = 1.0) -> FloatArray:
    """Return the vertices of a regular polygon, counter-clockwise from (radius, 0), (n, 2)."""
    n, radius = as_whole("n", n, 0, MOST_POINTS), as_positive("radius", radius)
    angle = 2 * math.pi * np.arange(n) / n
    return radius * np.stack([np.cos(angle), np.sin(angle)], -1)


def lattice(n: int, m: int | None = None) -> FloatArray:
    """Return the n × m integer lattice (default n × n), row by row from (0, 0), (n · m, 2).

    Examples
    --------
    >>> lattice(2, 3).tolist()
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.0, 2.0], [1.0, 2.0]]
    """
    n = as_whole("n", n, 0, MOST_POINTS)
    m = n if m is None else as_whole("m", m, 0, MOST_POINTS)
    as_whole("n · m", n * m, 0, MOST_POINTS)
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
    return SmoothCurve(tuple(bezier_loop(control) for control in controls))


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
