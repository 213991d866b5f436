"""Laws without a tolerance: which graph lies in which, and what changes nothing."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import crustline as cl
import generators as make
from generators import Rows

Pairs = set[tuple[int, int]]
Method = Callable[..., NDArray[np.int64]]

# Every method of the table, with what it needs.
NEEDED: dict[str, tuple[Any, ...]] = {
    "gamma-graph": (0.5, -0.25),
    "crossing-angle-graph": (1.7,),
    "alpha-shape": (1.25,),
    "a-shape": ([(1, 1), (2.5, 2), (9, 9)],),
}


def _with_what_it_needs(name: str) -> Method:
    return lambda points: cl.METHODS[name](points, *NEEDED.get(name, ()))


METHODS: dict[str, Method] = {name: _with_what_it_needs(name) for name in cl.METHODS} | {
    "lune": lambda points: cl.beta_skeleton(points, 1.7, kind="lune"),
    "lens": lambda points: cl.beta_skeleton(points, 0.8),
}
# They break their ties by coordinates: a turn may choose other edges.
DIRECTED = {"minimum-spanning-tree", "crawl", "peel"}
# Their parameter would have to be scaled, or moved, too.
SIZED, PLACED = {"alpha-shape"}, {"a-shape"}
BETAS = (0.3, 0.5, 0.9, 1.0, 1.1, 1.5, 1.7, 2.0, 4.0)


def rows(points: list[tuple[int, int]]) -> Rows:
    return np.array(points, np.float64).reshape(-1, 2)


def pairs(edges: NDArray[np.int64]) -> Pairs:
    return {(i, j) for i, j in edges.tolist()}


@st.composite
def hard_sets(draw: st.DrawFn) -> Rows:
    """A degenerate family, general position or a curve, as it is or a few ulps off."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    family = draw(st.sampled_from([make.degenerate, make.general_position, make.noisy_curve]))
    points = family(rng)
    return make.few_ulps_off(rng, points) if draw(st.booleans()) else points


def integers() -> st.SearchStrategy[Rows]:
    coordinate = st.integers(-5, 5)
    return st.lists(st.tuples(coordinate, coordinate), max_size=14).map(rows)


ANY = st.one_of(integers(), hard_sets())
KINDS = st.sampled_from(["circle", "lune"])


# Which lies in which.


@given(ANY, st.randoms(use_true_random=False))
def test_crust_lies_in_every_delaunay_triangulation(points: Rows, random) -> None:  # type: ignore[no-untyped-def]
    distinct = np.unique(points, axis=0)
    order = list(range(len(distinct)))
    random.shuffle(order)
    for shuffled in (distinct, distinct[order].reshape(-1, 2)):
        assert pairs(cl.crust(shuffled)) <= pairs(cl.Delaunay(shuffled).edges)


@given(ANY)
def test_crust_lies_in_the_one_step_crust(points: Rows) -> None:
    assert pairs(cl.crust(points)) <= pairs(cl.one_step_crust(points))


@given(ANY)
def test_one_step_crust_lies_in_the_delaunay_triangulation(points: Rows) -> None:
    assert pairs(cl.one_step_crust(points)) <= pairs(cl.Delaunay(points).edges)


@given(
    ANY, st.sampled_from([beta for beta in BETAS if beta >= 1]), st.sampled_from(["circle", "lune"])
)
def test_beta_skeleton_lies_in_the_gabriel_graph(points: Rows, beta: float, kind: str) -> None:
    assert pairs(cl.beta_skeleton(points, beta, kind=kind)) <= pairs(cl.gabriel(points))


@given(ANY, KINDS)
def test_gabriel_is_the_beta_skeleton_of_one(points: Rows, kind: str) -> None:
    assert pairs(cl.beta_skeleton(points, 1, kind=kind)) == pairs(cl.gabriel(points))


@given(ANY)
def test_relative_neighborhood_is_the_lune_of_two(points: Rows) -> None:
    assert pairs(cl.beta_skeleton(points, 2, kind="lune")) == pairs(
        cl.relative_neighborhood(points)
    )


@given(st.integers(0, 2**32 - 1))
def test_gabriel_lies_in_delaunay_where_no_four_are_cocircular(seed: int) -> None:
    points = make.general_position(np.random.default_rng(seed))
    assert pairs(cl.gabriel(points)) <= pairs(cl.Delaunay(points).edges)


@given(ANY)
def test_tree_lies_in_the_relative_neighborhood_graph_and_that_in_gabriel(points: Rows) -> None:
    tree, relative = (
        pairs(cl.minimum_spanning_tree(points)),
        pairs(cl.relative_neighborhood(points)),
    )
    assert tree <= relative <= pairs(cl.gabriel(points))


@given(ANY, st.sampled_from([1.0, 1.25, 2.0]))
def test_conservative_crust_lies_in_the_crust(points: Rows, ratio: float) -> None:
    assert pairs(cl.conservative_crust(points, ratio)) <= pairs(cl.crust(points))


@given(ANY)
def test_larger_disks_give_a_smaller_conservative_crust(points: Rows) -> None:
    crusts = [pairs(cl.conservative_crust(points, ratio)) for ratio in (0.5, 1.0, 1.25, 2.0, 4.0)]
    for larger, smaller in pairwise(crusts):
        assert smaller <= larger


@given(ANY)
def test_compatible_at_90_degrees_lies_in_the_nn_crust(points: Rows) -> None:
    assert pairs(cl.compatible_crust(points, math.pi / 2)) <= pairs(cl.nn_crust(points))


@given(ANY)
def test_spheres_of_influence_meet_where_two_points_are_nearest_to_each_other(points: Rows) -> None:
    distinct = np.unique(points, axis=0)
    squares = ((distinct[:, None] - distinct) ** 2).sum(axis=2) + np.diag([np.inf] * len(distinct))
    found = pairs(cl.sig_delaunay(distinct))
    for i, j in combinations(range(len(distinct)), 2):
        others = np.concatenate((np.delete(squares[i], [i, j]), np.delete(squares[j], [i, j])))
        if np.isfinite(squares[i, j]) and (others > 1.001 * squares[i, j]).all():
            assert (i, j) in found


@pytest.mark.parametrize("method", [cl.crawl, cl.peel])
@given(points=ANY)
def test_greedy_methods_leave_no_point_more_than_two_edges(method: Method, points: Rows) -> None:
    assert np.bincount(method(points).ravel(), minlength=1).max() <= 2


@given(ANY, st.floats(0.1, 1.5))
def test_gathan_of_longer_cells_is_smaller(points: Rows, angle: float) -> None:
    # The ratio admits short edges before long ones, so the shortest of a side stays the same.
    graphs = [pairs(cl.gathan(points, angle, ratio)) for ratio in (0, 0.5, 1.0, 2.0)]
    for larger, smaller in pairwise(graphs):
        assert smaller <= larger


@given(ANY)
def test_minimum_spanning_tree_spans(points: Rows) -> None:
    distinct = np.unique(points, axis=0)
    tree = cl.minimum_spanning_tree(distinct)
    assert len(tree) == max(len(distinct) - 1, 0)
    parent = list(range(len(distinct)))

    def root(k: int) -> int:
        while parent[k] != k:
            k = parent[k]
        return k

    for i, j in tree.tolist():
        assert root(i) != root(j)
        parent[root(i)] = root(j)


@given(ANY, KINDS)
def test_a_larger_beta_gives_a_smaller_skeleton(points: Rows, kind: str) -> None:
    skeletons = [pairs(cl.beta_skeleton(points, beta, kind=kind)) for beta in BETAS]
    for larger, smaller in pairwise(skeletons):
        assert smaller <= larger


@given(ANY, st.sampled_from([1.0, 1.5, 1.7, 2.0, 4.0]))
def test_circle_based_skeleton_lies_in_the_lune_based(points: Rows, beta: float) -> None:
    assert pairs(cl.beta_skeleton(points, beta)) <= pairs(
        cl.beta_skeleton(points, beta, kind="lune")
    )


@given(ANY, st.sampled_from([0.5, 0.75, 0.875]))
def test_gamma_of_equal_sizes_is_the_beta_skeleton(points: Rows, c: float) -> None:
    # Sizes for which 1 / (1 - c) is exact in doubles.
    assert pairs(cl.gamma_graph(points, c, c)) == pairs(cl.beta_skeleton(points, 1 / (1 - c)))
    assert pairs(cl.gamma_graph(points, -c, -c)) == pairs(cl.beta_skeleton(points, 1 - c))


@given(ANY)
def test_crossing_at_a_right_angle_is_the_one_step_crust(points: Rows) -> None:
    right = pairs(cl.crossing_angle_graph(points, math.pi / 2))
    assert right == pairs(cl.one_step_crust(points))


@given(ANY)
def test_a_larger_crossing_angle_gives_a_smaller_graph(points: Rows) -> None:
    graphs = [pairs(cl.crossing_angle_graph(points, angle)) for angle in (0.5, 1.0, 1.7, 2.5)]
    for larger, smaller in pairwise(graphs):
        assert smaller <= larger


@given(ANY)
def test_more_extra_points_give_a_smaller_a_shape(points: Rows) -> None:
    center = points.mean(axis=0, keepdims=True) if len(points) else np.zeros((1, 2))
    far = center + 100
    shapes = [
        pairs(cl.a_shape(points, extra)) for extra in (center[:0], center, np.vstack((center, far)))
    ]
    assert shapes[2] <= shapes[1] <= shapes[0]


@given(st.integers(0, 2**32 - 1))
def test_crust_has_degree_at_most_three_in_general_position(seed: int) -> None:
    points = np.random.default_rng(seed).random((40, 2))
    assert np.bincount(cl.crust(points).ravel(), minlength=1).max() <= 3


# What changes nothing.


@pytest.mark.parametrize("name", METHODS)
@given(points=ANY, seed=st.integers(0, 2**32 - 1))
def test_a_duplicate_row_changes_nothing(name: str, points: Rows, seed: int) -> None:
    rng = np.random.default_rng(seed)
    again = points[rng.integers(0, len(points), 3)] if len(points) else points
    both = np.vstack((points, again))
    assert METHODS[name](both).tolist() == METHODS[name](points).tolist()


@pytest.mark.parametrize("name", METHODS)
@given(points=ANY, seed=st.integers(0, 2**32 - 1))
def test_permuting_rows_permutes_the_answer(name: str, points: Rows, seed: int) -> None:
    distinct = np.unique(points, axis=0)
    order = np.random.default_rng(seed).permutation(len(distinct))
    back = METHODS[name](distinct[order])
    expected = np.sort(order[back.reshape(-1, 2)], axis=1)
    assert pairs(expected) == pairs(METHODS[name](distinct))


@pytest.mark.parametrize("name", METHODS)
def test_the_number_of_threads_changes_nothing(name: str) -> None:
    method = METHODS[name]
    points = np.random.default_rng(14).integers(0, 200, (20_000, 2)).astype(np.float64)
    one, *others = (method(cl.Delaunay(points, threads=threads)).tolist() for threads in (1, 2, 5))
    assert others == [one, one]


EXACT_MAPS: dict[str, Callable[[Rows], Rows]] = {
    "quarter turn": lambda points: np.column_stack((-points[:, 1], points[:, 0])),
    "half turn": lambda points: -points,
    "three quarters": lambda points: np.column_stack((points[:, 1], -points[:, 0])),
    "mirror": lambda points: points * (-1, 1),
    "transpose": lambda points: points[:, ::-1],
    "2^30": lambda points: np.ldexp(points, 30),
    "2^-30": lambda points: np.ldexp(points, -30),
    "2^300": lambda points: np.ldexp(points, 300),
    "2^-300": lambda points: np.ldexp(points, -300),
}


@pytest.mark.parametrize("name", sorted(set(METHODS) - PLACED))
@given(points=ANY)
def test_exact_similarities_change_nothing(name: str, points: Rows) -> None:
    edges = METHODS[name](points).tolist()
    for what, similar in EXACT_MAPS.items():
        if name not in (SIZED if what.startswith("2^") else DIRECTED):
            assert METHODS[name](similar(points)).tolist() == edges, what


@pytest.mark.parametrize("name", sorted(set(METHODS) - PLACED))
@given(points=integers(), shift=st.tuples(*[st.integers(-(2**40), 2**40)] * 2))
def test_exact_translations_change_nothing(name: str, points: Rows, shift: tuple[int, int]) -> None:
    assert METHODS[name](points + shift).tolist() == METHODS[name](points).tolist()


@pytest.mark.parametrize("name", METHODS)
@given(points=ANY)
def test_edges_are_sorted_distinct_rows(name: str, points: Rows) -> None:
    edges = METHODS[name](points)
    assert edges.shape == (len(edges), 2)
    assert edges.dtype == np.int64
    found = [tuple(edge) for edge in edges.tolist()]
    assert found == sorted(set(found))
    assert all(0 <= i < j < len(points) for i, j in found)
