"""The methods equal their definitions on many small sets, say what is wrong with their parameters,
and find on large sets what brute force finds."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import crustline as cl
import generators as make
import oracle
from crustline import methods
from crustline.methods import METHODS
from generators import Rows

Method = Callable[..., Any]

CASES: dict[str, tuple[Method, Method]] = {
    "crust": (cl.crust, oracle.crust),
    "beta_skeleton": (cl.beta_skeleton, lambda p: oracle.beta_skeleton(p, 1.70)),
    "beta_skeleton of 5/4": (
        lambda p, **how: cl.beta_skeleton(p, 1.25, **how),
        lambda p: oracle.beta_skeleton(p, 1.25),
    ),
    "beta_skeleton of 3/5": (
        lambda p, **how: cl.beta_skeleton(p, 0.6, **how),
        lambda p: oracle.beta_skeleton(p, 0.6),
    ),
    "beta_skeleton of lunes": (
        lambda p, **how: cl.beta_skeleton(p, 1.5, kind="lune", **how),
        lambda p: oracle.beta_skeleton(p, 1.5, "lune"),
    ),
    "gabriel": (cl.gabriel, oracle.gabriel),
    "relative_neighborhood": (cl.relative_neighborhood, oracle.relative_neighborhood),
    "one_step_crust": (cl.one_step_crust, oracle.one_step_crust),
    "gamma_graph": (
        lambda p, **how: cl.gamma_graph(p, 0.5, -0.5, **how),
        lambda p: oracle.gamma_graph(p, 0.5, -0.5),
    ),
    "gamma_graph of all pairs": (
        lambda p, **how: cl.gamma_graph(p, 0.2, -0.6, **how),
        lambda p: oracle.gamma_graph(p, 0.2, -0.6),
    ),
    "crossing_angle_graph": (
        lambda p, **how: cl.crossing_angle_graph(p, 1.7, **how),
        lambda p: oracle.crossing_angle_graph(p, Fraction(math.tan(math.pi / 2 - 1.7))),
    ),
    "a_shape": (
        lambda p, **how: cl.a_shape(p, [(1, 1), (2.5, 2), (9, 9)], **how),
        lambda p: oracle.a_shape(p, [(1, 1), (2.5, 2), (9, 9)]),
    ),
    "rcgh": (cl.rcgh, oracle.rcgh),
    "nn_crust": (cl.nn_crust, oracle.nn_crust),
    "minimum_spanning_tree": (cl.minimum_spanning_tree, oracle.minimum_spanning_tree),
    "alpha_shape": (
        lambda p, **how: cl.alpha_shape(p, 1.25, **how),
        lambda p: oracle.alpha_shape(p, 1.25),
    ),
}
SCALE_FREE = [name for name in CASES if name not in ("alpha_shape", "a_shape")]


def pairs(edges: Any) -> list[tuple[int, int]]:
    """Edges as a list of pairs, in order."""
    return [tuple(edge) for edge in edges.tolist()]


@pytest.mark.parametrize("name", CASES)
def test_definition_on_small_integer_sets(name: str) -> None:
    method, definition = CASES[name]
    rng = np.random.default_rng(200)
    for _ in range(500):
        points = make.grid(rng)
        assert pairs(method(points)) == definition(points), points.tolist()


@pytest.mark.parametrize("name", CASES)
def test_definition_with_many_points(name: str) -> None:
    # Enough for the tree of boxes to have levels.
    method, definition = CASES[name]
    rng = np.random.default_rng(201)
    for points in (rng.random((45, 2)), rng.integers(0, 12, (45, 2)), make.noisy_curve(rng)):
        assert pairs(method(points)) == definition(points), points.tolist()


@pytest.mark.parametrize("name", SCALE_FREE)
@pytest.mark.parametrize("exponent", [-300, 300])
def test_scaling_by_a_power_of_two_changes_nothing(name: str, exponent: int) -> None:
    method, _ = CASES[name]
    rng = np.random.default_rng(202)
    for _ in range(40):
        points = make.few_ulps_off(rng, make.degenerate(rng))
        assert pairs(method(np.ldexp(points, exponent))) == pairs(method(points)), points.tolist()


@pytest.mark.parametrize("name", CASES)
def test_repeated_rows_change_nothing(name: str) -> None:
    method, _ = CASES[name]
    rng = np.random.default_rng(203)
    for _ in range(40):
        points = np.unique(make.degenerate(rng), axis=0)
        again = points[rng.integers(0, len(points), 5)]
        assert pairs(method(np.vstack((points, again)))) == pairs(method(points))


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("points", [[], [(1, 2)], [(1, 2), (1, 2)]])
def test_fewer_than_two_distinct_points_have_no_edges(name: str, points: list[Any]) -> None:
    edges = CASES[name][0](points)
    assert edges.shape == (0, 2)
    assert edges.dtype == np.int64


@pytest.mark.parametrize("name", CASES)
def test_threads_change_nothing(name: str) -> None:
    method, _ = CASES[name]
    points = np.random.default_rng(204).random((9000, 2))
    seen: list[tuple[str, float]] = []
    watched = cl.Delaunay(points, threads=1, progress=lambda *state: seen.append(state))
    edges = method(watched)
    assert np.array_equal(edges, method(cl.Delaunay(points, threads=2)))
    assert all(0 <= done <= 1 for _, done in seen)
    assert not edges.flags.writeable


def brute_force(points: Rows, is_forbidden: Method) -> list[tuple[int, int]]:
    """The pairs with no point in the region that `is_forbidden` gives, in floating point."""
    n = len(points)
    vectors = points[None, :, :] - points[:, None, :]
    kept = []
    for i in range(n):
        for j in range(i + 1, n):
            to_i, to_j = -vectors[i], -vectors[j]
            dots = (to_i * to_j).sum(axis=1)
            crosses = np.abs(to_i[:, 0] * to_j[:, 1] - to_i[:, 1] * to_j[:, 0])
            dots[[i, j]] = np.inf
            if not is_forbidden(dots, crosses).any():
                kept.append((i, j))
    return kept


@pytest.mark.parametrize("beta", [0.3, 0.7, 0.95])
def test_beta_skeleton_below_one_of_many_points(beta: float) -> None:
    points = np.random.default_rng(205).random((250, 2))
    cotangent = -math.sqrt(1 - beta * beta) / beta
    expected = brute_force(points, lambda dots, crosses: dots < cotangent * crosses)
    assert pairs(cl.beta_skeleton(points, beta)) == expected


def test_points_of_one_large_circle() -> None:
    points = make.integer_circle(5**2 * 13**2 * 17**2)
    n = len(points)
    assert n == 108
    rng = np.random.default_rng(206)
    rows = rng.permutation(n)
    antipodes = {
        frozenset((i, j))
        for i in range(n)
        for j in range(i)
        if not np.any(points[rows[i]] + points[rows[j]])
    }
    ring = {frozenset(edge) for edge in cl.crust(points[rows]).tolist()}
    assert {frozenset(edge) for edge in cl.gabriel(points[rows]).tolist()} == ring | antipodes
    assert len(cl.alpha_shape(points, 5 * 13 * 17)) == n * (n - 1) // 2
    assert len(cl.alpha_shape(points, np.nextafter(5.0 * 13 * 17, 2000))) == n


def test_right_crossing_angle_is_the_one_step_crust() -> None:
    rng = np.random.default_rng(207)
    for _ in range(300):
        points = make.degenerate(rng)
        assert pairs(cl.crossing_angle_graph(points, math.pi / 2)) == pairs(
            cl.one_step_crust(points)
        )


def test_gamma_of_opposite_limits_is_the_hull() -> None:
    rng = np.random.default_rng(208)
    for _ in range(100):
        points = rng.random((20, 2))
        hull = cl.Delaunay(points).hull
        around = {frozenset(edge) for edge in zip(hull, np.roll(hull, 1), strict=True)}
        assert {frozenset(edge) for edge in cl.gamma_graph(points, 1, -1).tolist()} == around


@pytest.mark.parametrize(
    "beta", [1e-300, 5e-324, 1e300, 1.7e308, np.nextafter(1, 0), np.nextafter(1, 2)]
)
@pytest.mark.parametrize("kind", ["circle", "lune"])
def test_extreme_betas_are_exact(beta: float, kind: Any) -> None:
    rng = np.random.default_rng(209)
    for _ in range(20):
        points = make.degenerate(rng)
        expected = oracle.beta_skeleton(points, float(beta), kind)
        assert pairs(cl.beta_skeleton(points, beta, kind=kind)) == expected, points.tolist()


# What is refused.

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.mark.parametrize("beta", [0, -1, math.nan, math.inf, "1.7", None, True, 1j, 10**400])
def test_a_beta_that_is_not_positive_is_refused(beta: Any) -> None:
    with pytest.raises(cl.InputError, match=r"^beta must be "):
        cl.beta_skeleton(SQUARE, beta)


def test_the_error_quotes_the_value() -> None:
    with pytest.raises(cl.InputError, match=r"beta must be positive and finite, not -2.5"):
        cl.beta_skeleton(SQUARE, -2.5)
    with pytest.raises(cl.InputError, match=r"kind must be 'circle' or 'lune', not 'disk'"):
        cl.beta_skeleton(SQUARE, kind="disk")  # type: ignore[arg-type]
    with pytest.raises(cl.InputError, match=r"c1 must be from -1 to 1, not 1.5"):
        cl.gamma_graph(SQUARE, 0, 1.5)
    with pytest.raises(cl.InputError, match=r"angle must be in radians, .* not 90"):
        cl.crossing_angle_graph(SQUARE, 90)
    with pytest.raises(cl.InputError, match=r"extra, as points: row 1 has nan"):
        cl.a_shape(SQUARE, [(0, 0), (math.nan, 1)])


@pytest.mark.parametrize("radius", [0, -1.0, math.nan, math.inf, "big"])
def test_a_radius_that_is_not_positive_is_refused(radius: Any) -> None:
    with pytest.raises(cl.InputError, match=r"^radius must be "):
        cl.alpha_shape(SQUARE, radius)


@pytest.mark.parametrize(("exponent", "radius"), [(-900, 1e300), (900, 1e-320)])
def test_a_radius_out_of_all_proportion_is_refused(exponent: int, radius: float) -> None:
    with pytest.raises(cl.InputError, match=r"radius .* too far from the coordinates"):
        cl.alpha_shape(np.ldexp(np.array(SQUARE, float), exponent), radius)


def test_the_table_of_methods_is_complete() -> None:
    """Every public function from points to edges is in the table, and every row of it is public."""
    public = {name for name in cl.__all__ if getattr(cl, name) in METHODS.values()}
    assert {name.replace("-", "_") for name in METHODS} == public
    edges_of_points = {
        name
        for name, each in vars(methods).items()
        if callable(each) and getattr(each, "__module__", "").startswith("crustline.methods.")
    }
    helpers = {"as_method", "as_selected", "check_parameters", "name_of", "parameters_of"}
    # These run a method: on each group, on columns of a table, on what a drawing has left open.
    assert edges_of_points - helpers - {"by_group", "in_columns", "close_gaps"} == public


# What the docstrings of the published methods claim, on samples that are as sparse as they may be.

CLAIMED: dict[str, tuple[Callable[[Any], Any], float]] = {
    "hnn_crust": (cl.hnn_crust, 0.47),
    "compatible_crust": (cl.compatible_crust, 0.66),
    "conservative_crust": (cl.conservative_crust, 1 / 5),
    "conservative_crust, large": (lambda points: cl.conservative_crust(points, 2.0), 1 / 7),
    "crawl": (cl.crawl, 1 / 3),
    "peel": (cl.peel, 1 / 3),
}


@pytest.mark.parametrize("name", CLAIMED)
@pytest.mark.parametrize("curve", make.SMOOTH_CURVES)
def test_a_sparsest_sample_is_reconstructed(name: str, curve: str) -> None:
    method, r = CLAIMED[name]
    for seed in range(5):
        sample = cl.r_sample(make.SMOOTH_CURVES[curve], r * 0.999, seed=seed)
        assert method(sample.points).tolist() == sample.edges.tolist()


@pytest.mark.parametrize("curve", make.SMOOTH_CURVES)
def test_spheres_of_influence_hold_steps_at_most_twice_the_next(curve: str) -> None:
    for seed in range(5):
        sample = cl.r_sample(make.SMOOTH_CURVES[curve], 0.33, seed=seed)
        steps = np.hypot(*np.diff(sample.points[sample.edges], axis=1)[:, 0].T)
        least = np.full(len(sample.points), math.inf)
        np.minimum.at(least, sample.edges.ravel(), np.repeat(steps, 2))
        within = steps <= least[sample.edges].sum(axis=1)
        found = {tuple(edge) for edge in cl.sig_delaunay(sample.points).tolist()}
        assert {tuple(edge) for edge in sample.edges[within].tolist()} <= found
        assert within.sum() > 0.9 * len(within)


def test_half_neighbors_turn_a_corner_of_62_degrees() -> None:
    corner = [(-2, 3), (-1.3, 2), (-0.6, 1), (0, 0), (0.6, 1), (1.3, 2), (2, 3)]
    assert cl.hnn_crust(corner).tolist() == [[k, k + 1] for k in range(6)]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: cl.compatible_crust(SQUARE, 0),
            r"angle must be in radians, between 0 and pi, not 0",
        ),
        (lambda: cl.compatible_crust(SQUARE, 103), r"angle must be in radians, .* not 103"),
        (lambda: cl.conservative_crust(SQUARE, 0), r"ratio must be positive and finite, not 0"),
        (lambda: cl.gathan(SQUARE, 80), r"angle must be in radians, from 0 to pi / 2, not 80"),
        (
            lambda: cl.gathan(SQUARE, ratio=-1),
            r"ratio must be a finite number of at least 0, not -1",
        ),
    ],
)
def test_parameters_of_published_methods_are_checked(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(cl.InputError, match=message):
        call()


@pytest.mark.parametrize("name", CASES)
def test_an_array_has_the_edges_of_its_triangulation_and_stays_as_it_is(name: str) -> None:
    method, _ = CASES[name]
    points = np.random.default_rng(5).random((60, 2))
    before = points.copy()
    edges = method(points)
    for same in (
        cl.Delaunay(points),
        cl.Points(points),
        points.tolist(),
        np.asfortranarray(points),
    ):
        assert np.array_equal(method(same), edges)
    assert np.array_equal(points, before)
    assert points.flags.writeable
