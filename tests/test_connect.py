"""Connecting imperfect points: the answers asked for, and laws."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl

Array = np.ndarray


def shape(points: object) -> list[tuple[str, int]]:
    """The curves that `connect` makes of points: ring or line, and of how many points."""
    curves = cl.trace(points, cl.connect(points))  # type: ignore[arg-type]
    return [("ring" if curve.closed else "line", len(curve)) for curve in curves]


def path(count: int) -> list[list[int]]:
    return [[i, i + 1] for i in range(count - 1)]


def arc(degrees: float, count: int = 100) -> Array:
    angle = np.radians(np.linspace(0, degrees, count))
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


LINE_OF_16 = [
    *[(0, 5), (0, 4), (0, 3), (0, 2), (0, 1), (0.3, 0.3), (1, 0), (2, 0)],
    *[(3, 0), (4, 0), (4.7, 0.3), (5, 1), (5, 2), (5, 3), (5, 4), (5, 5)],
]


def test_open_rectangle_is_one_line_of_16() -> None:
    assert cl.connect(LINE_OF_16).tolist() == path(16)


@pytest.mark.parametrize("degrees", [200, 240, 270, 300, 330])
def test_arc_is_one_line(degrees: float) -> None:
    assert cl.connect(arc(degrees)).tolist() == path(100)


def test_arc_of_335_degrees_is_a_ring_for_the_theorem_holds() -> None:
    points = arc(335)
    assert cl.certify(points).guaranteed
    assert shape(points) == [("ring", 100)]


def test_sharp_v_is_one_line_of_7() -> None:
    v = [(-1.5, 3), (-1, 2), (-0.5, 1), (0, 0), (0.5, 1), (1, 2), (1.5, 3)]
    assert cl.connect(v).tolist() == path(7)


def test_profile_with_one_sharp_edge_is_one_ring_of_16() -> None:
    upper = [(0.9, 0.02), (0.8, 0.04), (0.6, 0.07), (0.4, 0.09), (0.2, 0.08)]
    upper += [(0.08, 0.055), (0.02, 0.03)]
    lower = [(x, -y) for x, y in reversed(upper)]
    profile = [(1, 0), *upper, (0, 0), *lower]
    assert shape(profile) == [("ring", 16)]
    assert cl.connect(profile).tolist() == sorted([*path(16), [0, 15]])


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        ([], []),
        ([(1, 1)], []),
        ([(1, 1)] * 5, []),
        ([(0, 0), (1, 0)], [("line", 2)]),
        ([(0, 0), (1, 0), (3, 0)], [("line", 3)]),
        ([(0, 0), (1, 0), (0.3, 1)], [("ring", 3)]),
        ([(0, 0), (1, 0), (1, 1), (0, 1)], [("ring", 4)]),
        ([(0, 0), (2, 0), (2, 1), (0, 1)], [("ring", 4)]),
    ],
    ids=["none", "one", "equal", "two", "three in line", "triangle", "square", "rectangle"],
)
def test_degenerate_points_give_the_crust(
    points: list[tuple[float, float]], expected: list[tuple[str, int]]
) -> None:
    rows = np.array(points, float).reshape(-1, 2)
    assert shape(rows) == expected
    assert cl.connect(rows).tolist() == cl.crust(rows).tolist()


def test_lattice_gives_the_same_on_all_sides() -> None:
    """Its edges are equally good: the answer has all the symmetries of the points."""
    rows = np.stack(np.meshgrid(range(6), range(6)), axis=-1).reshape(-1, 2)
    edges = located(rows, cl.connect(rows))
    assert edges == located(5 - rows[:, ::-1], cl.connect(rows))


def located(points: Array, edges: Array) -> set[frozenset[tuple[float, float]]]:
    """Edges as pairs of places."""
    return {frozenset(map(tuple, points[edge].tolist())) for edge in edges}


def test_points_of_degree_at_most_two() -> None:
    points = np.random.default_rng(3).random((2000, 2))
    assert np.bincount(cl.connect(points).ravel()).max() <= 2


LAWS: dict[str, Callable[[Array], Array]] = {
    "scale": lambda points: points * 2.0**-40,
    "large": lambda points: points * 2.0**300,
    "translation": lambda points: points - np.array([4096, 65536]),
    "quarter turn": lambda points: points[:, ::-1] * [-1, 1],
    "half turn": lambda points: -points,
    "mirror": lambda points: points * [1, -1],
    "diagonal mirror": lambda points: points[:, ::-1],
}


def samples(seed: int, grid: bool) -> Array:
    """Random points, or a noisy curve with outliers; on a grid, where ties live, or in between."""
    rng = np.random.default_rng(seed)
    points = rng.random((rng.integers(3, 60), 2))
    if seed % 2:
        angle = rng.random(rng.integers(5, 80)) * 2 * math.pi
        curve = np.stack([np.cos(angle), np.sin(2 * angle)], axis=1)
        points = np.concatenate([curve, rng.uniform(-1, 1, (rng.integers(0, 9), 2))])
    step = 2.0**-3 if grid else 2.0**-20
    return np.unique(np.round(points / step) * step, axis=0)


@pytest.mark.parametrize("law", LAWS)
@given(seed=st.integers(0, 2**32 - 1), grid=st.booleans())
def test_law(law: str, seed: int, grid: bool) -> None:
    points = samples(seed, grid)
    assert cl.connect(LAWS[law](points)).tolist() == cl.connect(points).tolist()


@given(seed=st.integers(0, 2**32 - 1), grid=st.booleans())
def test_order_of_rows_does_not_matter(seed: int, grid: bool) -> None:
    points = samples(seed, grid)
    shuffled = np.random.default_rng(seed).permutation(points)
    assert located(shuffled, cl.connect(shuffled)) == located(points, cl.connect(points))


def test_threads_do_not_matter() -> None:
    rng = np.random.default_rng(5)
    angle = rng.random(30_000) * 2 * math.pi
    curve = np.stack([np.cos(angle), np.sin(3 * angle)], axis=1)
    points = np.concatenate([curve, rng.uniform(-1, 1, (5000, 2))])
    one, three = (cl.connect(cl.Delaunay(points, threads=threads)) for threads in (1, 3))
    assert np.array_equal(one, three)


@given(seed=st.integers(0, 2**32 - 1))
def test_dense_samples_give_the_crust(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = cl.shapes.trefoil(int(rng.integers(2, 6)), rng.uniform(0.05, 0.4))
    points = cl.r_sample(curve, rng.uniform(0.1, 0.25), seed=seed).points
    assert cl.connect(points).tolist() == cl.crust(points).tolist()


def test_samples_that_thin_out_gradually_are_no_outliers() -> None:
    steps = np.concatenate([np.full(40, 0.02), 0.02 * 1.55 ** np.arange(1, 9)])
    x = np.concatenate([[0], np.cumsum(np.concatenate([steps, steps[::-1]]))])
    x -= x[-1] / 2
    assert shape(np.stack([x, x**2 / x[-1] / 4], axis=1)) == [("line", len(x))]


@pytest.mark.parametrize("count", [40, 60])
def test_an_open_curve_that_thins_out_keeps_its_last_sample(count: int) -> None:
    places = np.tan(np.linspace(0, np.pi / 2 - 0.1, count))
    angle = 0.9 * places / places[-1]
    arc = np.stack([np.sin(angle), 1 - np.cos(angle)], axis=1)
    assert shape(arc) == [("line", count)]


@pytest.mark.parametrize("seed", range(8))
def test_samples_left_out_at_random_leave_no_gap(seed: int) -> None:
    angle = 2 * np.pi * np.arange(300) / 300
    angle = angle[np.random.default_rng(seed).random(300) > 0.5]
    ellipse = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    assert shape(ellipse) == [("ring", len(ellipse))]
