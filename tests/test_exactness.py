"""Methods equal their definitions in exact arithmetic, at ties, near-ties, offsets and scales."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import crustline as cl
import generators as make
import oracle
from generators import Rows

Edges = NDArray[np.int64]
Method = Callable[[Rows], Edges]
Definition = Callable[[Any], list[tuple[int, int]]]

PARAMETER_FREE: dict[str, tuple[Method, Definition]] = {
    name: (getattr(cl, name), getattr(oracle, name))
    for name in (
        "gabriel",
        "relative_neighborhood",
        "one_step_crust",
        "rcgh",
        "nn_crust",
        "hnn_crust",
        "crawl",
        "peel",
        "sig_delaunay",
        "minimum_spanning_tree",
    )
}
WITH_PARAMETERS: dict[str, tuple[Method, Definition]] = {
    "compatible_crust": (
        lambda points: cl.compatible_crust(points, 1.8),
        lambda points: oracle.compatible_crust(points, Fraction(1 / math.tan(1.8))),
    ),
    "conservative_crust": (cl.conservative_crust, lambda s: oracle.conservative_crust(s, 1.0)),
    "conservative_crust, large": (
        lambda points: cl.conservative_crust(points, 1.5),
        lambda points: oracle.conservative_crust(points, 1.5),
    ),
    "conservative_crust, small": (
        lambda points: cl.conservative_crust(points, 0.7),
        lambda points: oracle.conservative_crust(points, 0.7),
    ),
    "gathan": (cl.gathan, lambda points: oracle.gathan(points, math.sin(1.4), 1.0)),
    "gathan, narrow": (
        lambda points: cl.gathan(points, math.asin(0.6), 0.75),
        lambda points: oracle.gathan(points, math.sin(math.asin(0.6)), 0.75),
    ),
}
GRAPHS = PARAMETER_FREE | WITH_PARAMETERS
BETAS = (0.5, 0.9, 1.0, 1.2, 1.7, 2.0, 3.0)


def assert_is(edges: Edges, expected: list[tuple[int, int]], points: Rows) -> None:
    """Fail, showing the points in full, unless the edges are the expected ones in order."""
    assert edges.dtype == np.int64
    assert edges.ndim == 2
    assert edges.shape[1] == 2
    found = [tuple(edge) for edge in edges.tolist()]
    assert found == expected, (
        f"missing {sorted(set(expected) - set(found))}, wrong {sorted(set(found) - set(expected))} "
        f"(and sorted: {found == sorted(set(found))}) for points = {points.tolist()!r}"
    )


def sets(generator: make.Generator, count: int, seed: int) -> Iterator[Rows]:
    """`count` sets of one family."""
    rng = np.random.default_rng(seed)
    return (generator(rng) for _ in range(count))


# The crust, on everything.


@pytest.mark.parametrize("seed", range(10))
def test_crust_of_small_integer_grids(seed: int) -> None:
    for points in sets(make.grid, 220, seed):
        assert_is(cl.crust(points), oracle.crust(points), points)


@pytest.mark.parametrize("family", make.DEGENERATE)
def test_crust_of_degenerate_families(family: str) -> None:
    for points in sets(make.DEGENERATE[family], 60, seed=20):
        assert_is(cl.crust(points), oracle.crust(points), points)


@pytest.mark.parametrize("seed", range(3))
def test_crust_a_few_ulps_from_degenerate(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    for points in sets(make.degenerate, 100, seed):
        moved = make.few_ulps_off(rng, points)
        assert_is(cl.crust(moved), oracle.crust(moved), moved)


@pytest.mark.parametrize("offset", [1e7, -1e7, 6_378_137.0, 2.0**40])
def test_crust_far_from_the_origin(offset: float) -> None:
    # Eighths move exactly; what does not is a few ulps (of the offset) off, and just as binding.
    for points in sets(make.degenerate, 80, seed=30):
        for moved in (points / 8 + offset, points / 7 + (offset, -offset / 3)):
            assert_is(cl.crust(moved), oracle.crust(moved), moved)


@pytest.mark.parametrize("exponent", [-300, -150, -30, 30, 150, 300])
def test_crust_at_every_scale(exponent: int) -> None:
    rng = np.random.default_rng(7)
    for points in sets(make.degenerate, 40, seed=40):
        moved = np.ldexp(make.few_ulps_off(rng, points), exponent)
        assert_is(cl.crust(moved), oracle.crust(moved), moved)


@pytest.mark.parametrize("exponent", [-1074, -1022, -600, 600, 1000, 1013])
def test_crust_at_the_ends_of_the_double_range(exponent: int) -> None:
    for points in sets(make.degenerate, 40, seed=41):
        moved = np.ldexp(np.round(points * 8), exponent)
        assert_is(cl.crust(moved), oracle.crust(moved), moved)


@pytest.mark.parametrize("reach", [30, 400, 1000])
def test_crust_of_mixed_magnitudes_is_exact_or_refused_by_name(reach: int) -> None:
    rng = np.random.default_rng(12)
    for points in sets(make.degenerate, 40, seed=42):
        moved = np.ldexp(points, rng.integers(-reach, reach, points.shape))
        try:
            edges = cl.crust(moved)
        except cl.InputError as refusal:
            assert "row" in str(refusal)  # noqa: PT017
        else:
            assert_is(edges, oracle.crust(moved), moved)


def test_crust_beside_the_smallest_double() -> None:
    rng = np.random.default_rng(13)
    for points in sets(make.degenerate, 60, seed=43):
        moved = np.where(rng.random(points.shape) < 0.3, np.nextafter(points, np.inf), points)
        assert_is(cl.crust(moved), oracle.crust(moved), moved)


def test_crust_of_noisy_curves() -> None:
    for points in sets(make.noisy_curve, 40, seed=50):
        assert_is(cl.crust(points), oracle.crust(points), points)


def test_crust_of_noisy_curves_on_a_fine_grid() -> None:
    for points in sets(make.noisy_curve, 40, seed=51):
        rounded = np.round(points * 32)
        assert_is(cl.crust(rounded), oracle.crust(rounded), rounded)


def test_crust_of_general_position() -> None:
    for points in sets(make.general_position, 200, seed=52):
        assert_is(cl.crust(points), oracle.crust(points), points)


def two_pass_crust(points: Rows) -> list[tuple[int, int]]:
    """The recipe of the paper in floating point: two Delaunay triangulations."""
    spatial = pytest.importorskip("scipy.spatial", reason="the two-pass recipe needs scipy")
    both = np.vstack((points, spatial.Voronoi(points).vertices))
    triangles = spatial.Delaunay(both).simplices
    edges = np.sort(np.vstack((triangles[:, :2], triangles[:, 1:], triangles[:, ::2])), axis=1)
    own = np.unique(edges[edges[:, 1] < len(points)], axis=0)
    return [(i, j) for i, j in own.tolist()]


@pytest.mark.parametrize("waves", [0, 7])
def test_crust_of_many_points_equals_the_two_pass_recipe(waves: int) -> None:
    # In general position rounding decides nothing: uniform points, and a wavy curve with noise.
    rng = np.random.default_rng(53 + waves)
    points = rng.random((3000, 2))
    if waves:
        angle = 2 * np.pi * points[:, 0]
        radius = 1 + 0.3 * np.sin(waves * angle) + 0.01 * points[:, 1]
        points = radius[:, None] * np.column_stack((np.cos(angle), np.sin(angle)))
    assert_is(cl.crust(points), two_pass_crust(points), points)


# The beta-skeletons.


@pytest.mark.parametrize("kind", ["circle", "lune"])
@pytest.mark.parametrize("beta", BETAS)
def test_beta_skeleton_of_small_integer_grids(beta: float, kind: str) -> None:
    for points in sets(make.grid, 150, seed=60):
        expected = oracle.beta_skeleton(points, beta, kind)
        assert_is(cl.beta_skeleton(points, beta, kind=kind), expected, points)


@pytest.mark.parametrize("kind", ["circle", "lune"])
@pytest.mark.parametrize("beta", BETAS)
def test_beta_skeleton_of_hard_sets(beta: float, kind: str) -> None:
    rng = np.random.default_rng(8)
    for points in sets(make.degenerate, 40, seed=61):
        shifted = points / 8 + 1e7
        for moved in (points, make.few_ulps_off(rng, points), shifted, np.ldexp(points, -300)):
            expected = oracle.beta_skeleton(moved, beta, kind)
            assert_is(cl.beta_skeleton(moved, beta, kind=kind), expected, moved)


def test_beta_skeleton_at_the_very_angle_of_a_point() -> None:
    # dot / |cross| of the apex (0, h) over (-1, 0)(1, 0) is (h^2 - 1) / 2h: for h = 2 it is 3/4,
    # the bound of beta = 5/4.
    points = np.array([(-1, 0), (1, 0), (0, 2)], np.float64)
    for beta in (1.25, np.nextafter(1.25, 0), np.nextafter(1.25, 2)):
        assert_is(cl.beta_skeleton(points, beta), oracle.beta_skeleton(points, beta), points)
    assert [0, 1] in cl.beta_skeleton(points, 1.25).tolist()
    assert [0, 1] not in cl.beta_skeleton(points, np.nextafter(1.25, 2)).tolist()


# The other graphs.


@pytest.mark.parametrize("name", GRAPHS)
def test_graph_of_small_integer_grids(name: str) -> None:
    method, definition = GRAPHS[name]
    for points in sets(make.grid, 500, seed=70):
        assert_is(method(points), definition(points), points)


@pytest.mark.parametrize("name", GRAPHS)
def test_graph_of_hard_sets(name: str) -> None:
    method, definition = GRAPHS[name]
    rng = np.random.default_rng(9)
    for points in sets(make.degenerate, 60, seed=71):
        for moved in (
            points,
            make.few_ulps_off(rng, points),
            points / 8 + 1e7,
            np.ldexp(points, 300),
        ):
            assert_is(method(moved), definition(moved), moved)


@pytest.mark.parametrize("name", GRAPHS)
def test_graph_of_noisy_curves(name: str) -> None:
    method, definition = GRAPHS[name]
    for points in sets(make.noisy_curve, 6, seed=72):
        assert_is(method(points), definition(points), points)


@pytest.mark.parametrize("radius", [0.5, 0.75, 1.0, 1.25, 2.5, 5.0, 1e3])
def test_alpha_shape(radius: float) -> None:
    for points in sets(make.degenerate, 60, seed=73):
        assert_is(cl.alpha_shape(points, radius), oracle.alpha_shape(points, radius), points)


def test_alpha_shape_at_the_very_radius_of_a_circle() -> None:
    for points in sets(make.exactly_cocircular, 30, seed=74):
        for radius in (5.0, np.nextafter(5.0, 0), np.nextafter(5.0, 9)):
            assert_is(cl.alpha_shape(points, radius), oracle.alpha_shape(points, radius), points)


def test_alpha_shape_at_every_scale() -> None:
    for points in sets(make.degenerate, 30, seed=75):
        for exponent in (-300, -30, 30, 300):
            scaled, radius = np.ldexp(points, exponent), float(np.ldexp(1.25, exponent))
            assert_is(cl.alpha_shape(scaled, radius), oracle.alpha_shape(scaled, radius), scaled)


def test_a_shape_of_arbitrary_extra_points() -> None:
    rng = np.random.default_rng(10)
    for points in sets(make.degenerate, 200, seed=76):
        extra = rng.integers(-8, 17, (rng.integers(0, 8), 2)) / 2
        assert_is(cl.a_shape(points, extra), oracle.a_shape(points, extra), points)


def test_a_shape_of_exact_voronoi_vertices_is_the_crust() -> None:
    """Melkemi's remark: with the Voronoi vertices as extra points the shape is the crust."""
    seen = 0
    for points in sets(make.grid, 1500, seed=77):
        vertices = oracle.voronoi_vertices(points)
        extra = np.array([(float(x), float(y)) for x, y in vertices]).reshape(-1, 2)
        if all(Fraction(float(a)) == a for vertex in vertices for a in vertex):
            seen += 1
            assert_is(cl.a_shape(points, extra), oracle.crust(points), points)
    assert seen >= 100


SIZES = (-1.0, -0.75, -0.5, -0.25, 0.0, 0.2, 0.25, 0.5, 0.75, 1.0)


@pytest.mark.parametrize("c0", SIZES)
def test_gamma_graph(c0: float) -> None:
    rng = np.random.default_rng(15)
    for points in sets(make.degenerate, 60, seed=78):
        c1 = float(rng.choice(SIZES))
        for moved in (points, make.few_ulps_off(rng, points)):
            assert_is(cl.gamma_graph(moved, c0, c1), oracle.gamma_graph(moved, c0, c1), moved)


@pytest.mark.parametrize("angle", [0.3, math.pi / 4, 1.2, math.pi / 2, 1.7, 3 * math.pi / 4, 3.0])
def test_crossing_angle_graph(angle: float) -> None:
    cot = Fraction(math.tan(math.pi / 2 - angle))
    rng = np.random.default_rng(16)
    for points in sets(make.degenerate, 60, seed=79):
        for moved in (points, make.few_ulps_off(rng, points)):
            expected = oracle.crossing_angle_graph(moved, cot)
            assert_is(cl.crossing_angle_graph(moved, angle), expected, moved)


# What the triangulation says of itself.


def test_delaunay_edges_lie_between_the_ties() -> None:
    for points in sets(make.degenerate, 150, seed=80):
        own = {tuple(edge) for edge in cl.Delaunay(points).edges.tolist()}
        exact = oracle.PointSet(points)
        assert set(oracle.every_delaunay_triangulation(exact)) <= own
        assert own <= set(oracle.delaunay_graph(exact))


# Order.


def permuted(edges: list[tuple[int, int]], order: NDArray[np.int64]) -> list[tuple[int, int]]:
    """Edges over rows k of the original as edges over the rows of points[order]."""
    place = np.argsort(order)
    pairs = (sorted((int(place[i]), int(place[j]))) for i, j in edges)
    return sorted((i, j) for i, j in pairs)


ALL = {
    "crust": cl.crust,
    "beta_skeleton": cl.beta_skeleton,
    "lune": lambda points: cl.beta_skeleton(points, 1.7, kind="lune"),
    "below_one": lambda points: cl.beta_skeleton(points, 0.9),
    "alpha_shape": lambda points: cl.alpha_shape(points, 2.5),
    "gamma_graph": lambda points: cl.gamma_graph(points, 0.5, -0.25),
    "crossing_angle_graph": lambda points: cl.crossing_angle_graph(points, 1.7),
    **{name: method for name, (method, _) in PARAMETER_FREE.items()},
}


@pytest.mark.parametrize("name", ALL)
def test_permuting_rows_permutes_the_answer(name: str) -> None:
    rng = np.random.default_rng(11)
    for points in sets(make.degenerate, 60, seed=90):
        distinct = rng.permutation(np.unique(points, axis=0))
        order = rng.permutation(len(distinct))
        expected = permuted(ALL[name](distinct).tolist(), order)
        assert_is(ALL[name](distinct[order]), expected, distinct)


@pytest.mark.parametrize("name", ALL)
def test_a_delaunay_serves_like_its_points(name: str) -> None:
    for points in sets(make.degenerate, 20, seed=91):
        expected = [tuple(edge) for edge in ALL[name](points).tolist()]
        assert_is(ALL[name](cl.Delaunay(points)), expected, points)
