"""Point sets on which definitions are hard to keep: ties on purpose, near-ties on purpose,
curves, and all of them moved.

Every function takes a seeded generator and gives rows of float64, (n, 2). What is called exact
lies on the circle, line or lattice exactly, in doubles.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from crustline import shapes

Rows = NDArray[np.float64]
Random = np.random.Generator
Generator = Callable[[Random], Rows]

#: Smooth curves: one whose curvature jumps, some with lobes, and some of two components.
SMOOTH_CURVES = {
    "stadium": shapes.stadium(3, 0.5),
    "trefoil": shapes.trefoil(3, 0.4),
    "blob": shapes.blob(4),
    "nested": shapes.ellipse(3, 2) + shapes.blob(5).moved(scale=0.7),
    "side by side": shapes.circle() + shapes.circle().moved(offset=(2.3, 0)),
}


def grid(rng: Random) -> Rows:
    """3 to 12 rows of a grid of 3 x 3 to 8 x 8: every degeneracy, duplicates too."""
    side, n = rng.integers(3, 9), rng.integers(3, 13)
    return rng.integers(0, side, (n, 2)).astype(np.float64)


def general_position(rng: Random) -> Rows:
    """Uniform random points, with no tie to expect."""
    return rng.random((rng.integers(2, 16), 2))


def regular_polygon(rng: Random) -> Rows:
    """The vertices of a regular polygon, rounded: cocircular to a few ulps."""
    n = int(rng.integers(3, 17))
    center = [(0.0, 0.0), (0.5, 0.25), (100.0, -37.0)][rng.integers(3)]
    return circle(n, 1.0 + rng.random(), rng.random()) + center


def circle(n: int, radius: float = 1.0, start: float = 0.0) -> Rows:
    """n points at equal steps on a circle about the origin, the first at the angle `start`."""
    angle = start + 2 * np.pi * np.arange(n) / n
    return radius * np.column_stack((np.cos(angle), np.sin(angle)))


def integer_circle(square: int) -> Rows:
    """All integer points with x^2 + y^2 = square: exactly cocircular."""
    reach = np.arange(-int(square**0.5) - 1, int(square**0.5) + 2)
    x, y = np.meshgrid(reach, reach)
    on = x * x + y * y == square
    return np.column_stack((x[on], y[on])).astype(np.float64)


def exactly_cocircular(rng: Random) -> Rows:
    """4 to 12 of the 12 to 36 integer points of a circle, sometimes with its center."""
    points = integer_circle(int(rng.choice([25, 65, 325, 1105])))
    chosen = points[rng.permutation(len(points))[: rng.integers(4, 13)]]
    return np.vstack((chosen, np.zeros((rng.integers(0, 2), 2))))


def exactly_concentric(rng: Random) -> Rows:
    """Integer points of two or three concentric circles."""
    squares = rng.permutation([25, 50, 65, 85, 100])[: rng.integers(2, 4)]
    points = np.vstack([integer_circle(int(square)) for square in squares])
    return points[rng.permutation(len(points))[: rng.integers(6, 21)]]


def concentric_polygons(rng: Random) -> Rows:
    """Two regular polygons about one center, ties to a few ulps."""
    n = int(rng.integers(3, 10))
    turn = np.pi / n * rng.integers(0, 2)
    return np.vstack((circle(n), circle(n, 1.0 + rng.integers(1, 5) / 4, turn)))


def lattice(rng: Random) -> Rows:
    """2 x 2 to 5 x 5 points of a square, oblong, diamond or nearly hexagonal lattice."""
    rows, columns = rng.integers(2, 6, 2)
    basis = [((1, 0), (0, 1)), ((2, 0), (0, 1)), ((2, 1), (-1, 2)), ((1, 0), (0.5, 0.75**0.5))]
    j, i = np.meshgrid(np.arange(columns), np.arange(rows))
    return np.column_stack((i.ravel(), j.ravel())) @ np.array(basis[rng.integers(4)], np.float64)


def collinear(rng: Random) -> Rows:
    """2 to 10 integer points of one line, some repeated, sometimes with one beside it."""
    direction = rng.integers(-3, 4, 2)
    steps = rng.integers(-6, 7, (rng.integers(2, 11), 1))
    beside = rng.integers(-5, 6, (rng.integers(0, 2), 2))
    return np.vstack((rng.integers(-5, 6, 2) + steps * direction, beside)).astype(np.float64)


def duplicated(rng: Random) -> Rows:
    """Few distinct points, each row repeated up to four times, shuffled."""
    points = rng.integers(0, 4, (rng.integers(1, 7), 2)).astype(np.float64)
    return rng.permutation(np.repeat(points, rng.integers(1, 5, len(points)), axis=0))


def noisy_curve(rng: Random) -> Rows:
    """20 to 45 points of a wavy closed curve, with noise of some per cent."""
    n, waves = int(rng.integers(20, 46)), int(rng.integers(2, 6))
    angle = 2 * np.pi * (np.arange(n) + rng.uniform(-0.2, 0.2, n)) / n
    radius = 1 + 0.3 * np.sin(waves * angle)
    points = radius[:, None] * np.column_stack((np.cos(angle), np.sin(angle)))
    return rng.permutation(points + rng.normal(0, rng.choice([0.0, 0.02, 0.05]), (n, 2)))


DEGENERATE: dict[str, Generator] = {
    f.__name__: f
    for f in (
        regular_polygon,
        exactly_cocircular,
        exactly_concentric,
        concentric_polygons,
        lattice,
        collinear,
        duplicated,
    )
}


def degenerate(rng: Random) -> Rows:
    """A set of any of the degenerate families, or of a grid."""
    families = [grid, *DEGENERATE.values()]
    return families[rng.integers(len(families))](rng)


def few_ulps_off(rng: Random, points: Rows) -> Rows:
    """`points` with some coordinates moved by one to three ulps; zeros, whose ulp is tiny, stay."""
    moved = points.copy()
    chosen = (rng.random(points.shape) < 0.4) & (points != 0)
    direction = rng.choice([-np.inf, np.inf], points.shape)
    for _ in range(rng.integers(1, 4)):
        moved = np.where(chosen, np.nextafter(moved, direction), moved)
    return moved
