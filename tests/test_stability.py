"""How far a parameter can be moved: the definition, at every edge."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl


def pairs(edges: np.ndarray) -> set[tuple[int, int]]:
    return {(i, j) for i, j in edges.tolist()}


@given(seed=st.integers(0, 2**32 - 1), beta=st.floats(0.2, 4))
def test_an_edge_is_in_the_skeleton_up_to_its_beta(seed: int, beta: float) -> None:
    points = np.random.default_rng(seed).random((18, 2))
    edges = np.array(list(combinations(range(18), 2)))
    betas = cl.beta_of(points, edges)
    assert pairs(edges[betas >= beta]) == pairs(cl.beta_skeleton(points, beta))


def test_beta_of_neighbors_on_one_line_is_infinite_and_needs_no_search() -> None:
    along = np.random.default_rng(0).permutation(50_000) / 7
    level = cl.Delaunay(np.c_[along, np.full(len(along), 0.1)])
    assert len(level.edges) == len(along) - 1
    assert np.isinf(cl.beta_of(level, level.edges)).all()
    assert cl.beta_interval(level, 1.7) == (1.0, np.inf)


def test_beta_of_edges_that_no_point_sees_or_one_is_on() -> None:
    line = [(0, 0), (1, 0), (3, 0)]
    assert cl.beta_of(line, [(0, 1), (0, 2), (1, 2)]).tolist() == [np.inf, 0.0, np.inf]
    assert cl.beta_of([(0, 0), (1, 0)], [(0, 1)]).tolist() == [np.inf]
    assert cl.beta_of([(0, 0), (1, 0)], []).tolist() == []


@given(seed=st.integers(0, 2**32 - 1), beta=st.floats(1, 4))
def test_the_skeleton_changes_at_the_ends_of_the_interval_and_not_before(
    seed: int, beta: float
) -> None:
    points = np.random.default_rng(seed).random((25, 2))
    low, high = cl.beta_interval(points, beta)
    same = pairs(cl.beta_skeleton(points, beta))
    little = 1e-9
    assert low <= beta <= high
    assert pairs(cl.beta_skeleton(points, max(1, low * (1 + little)))) == same
    if np.isfinite(high):
        assert pairs(cl.beta_skeleton(points, high * (1 - little))) == same
        assert pairs(cl.beta_skeleton(points, high * (1 + little))) != same
    if low > 1 + 2 * little:
        assert pairs(cl.beta_skeleton(points, low * (1 - little))) != same


@pytest.mark.parametrize("seed", range(8))
def test_the_answer_is_the_same_at_the_longest_edge_and_above(seed: int) -> None:
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.random(60)) * 2 * np.pi
    points = np.concatenate([np.stack([np.cos(angle), np.sin(2 * angle)], 1), rng.random((4, 2))])
    edges = cl.connect(points)
    low, high = cl.max_edge_interval(points)
    assert high == np.inf
    assert np.array_equal(cl.connect(points, max_edge=low), edges)
    longest = np.hypot(*(points[edges[:, 0]] - points[edges[:, 1]]).T).max()
    assert low >= longest * (1 - 1e-12)
    assert not np.array_equal(cl.connect(points, max_edge=longest * (1 - 1e-9)), edges)


def test_without_edges_every_length_will_do() -> None:
    assert cl.max_edge_interval([(0, 0)]) == (0.0, np.inf)


@pytest.mark.parametrize("beta", [0.9, 0, -1, float("nan"), "2"])
def test_bad_beta_is_named(beta: object) -> None:
    with pytest.raises(cl.InputError, match="beta must be a number of at least 1"):
        cl.beta_interval([(0, 0), (1, 0)], beta)  # type: ignore[arg-type]


# --- Normals, and sizes anywhere -----------------------------------------------------------------


def circle(count: int, radius: float = 1.0) -> np.ndarray:
    angle = np.sort(np.random.default_rng(count).random(count)) * 2 * np.pi
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def ring(first: int, count: int) -> list[tuple[int, int]]:
    return [(first + k, first + (k + 1) % count) for k in range(count)]


def test_normals_of_a_circle_point_outward_and_of_a_hole_inward() -> None:
    outer, inner = circle(40, 2.0), circle(30)
    curves = cl.trace(np.concatenate([outer, inner]), ring(0, 40) + ring(40, 30))
    normals = curves.normals()
    assert np.allclose(normals[:40], outer / 2, atol=1e-12)
    assert np.allclose(normals[40:], -inner, atol=1e-12)


def test_normals_of_an_arc_are_exact_to_its_ends_and_on_its_right() -> None:
    arc = circle(40)[:20]
    normals = cl.trace(arc, [(k, k + 1) for k in range(19)]).normals()
    assert np.allclose(normals, arc, atol=1e-12)  # counter-clockwise: the right is outside


def test_normals_where_there_are_none() -> None:
    points = [(0, 0), (1, 0), (-1, 0), (0, 1), (5, 5)]
    normals = cl.trace(points, [(0, 1), (0, 2), (0, 3)]).normals()
    assert np.isnan(normals[[0, 4]]).all()
    assert np.allclose(np.abs(normals[1]), [0, 1])
    assert cl.trace([], []).normals().shape == (0, 2)


@given(seed=st.integers(0, 2**32 - 1), slope=st.floats(0.1, 3))
def test_sizes_anywhere_are_the_least_over_all_samples(seed: int, slope: float) -> None:
    rng = np.random.default_rng(seed)
    samples = circle(30) * [2, 1]
    smooth = cl.Interpolant(samples, ring(0, 30))
    places = rng.uniform(-4, 4, (rng.integers(0, 600), 2))
    away = np.hypot(*(places[:, None] - samples).transpose(2, 0, 1))
    expected = (smooth.local_feature_size + slope * away).min(axis=1, initial=np.inf)
    assert np.array_equal(smooth.size_at(places, gradation=slope), expected)
    assert smooth.size_at([(1e308, -1e308)], gradation=2).tolist() == [np.inf]  # beyond numbers


def test_sizes_of_what_has_no_axis_are_infinite() -> None:
    assert cl.Interpolant([(0, 0), (1, 0)], [(0, 1)]).size_at([(0, 0)]).tolist() == [np.inf]
    with pytest.raises(cl.InputError, match="gradation must be positive"):
        cl.Interpolant([(0, 0), (1, 0)]).size_at([(0, 0)], gradation=0)
