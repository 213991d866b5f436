"""The figures of the paper and of the examples have the topology that they must have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import crustline as cl
import generators as make
import oracle
from generators import Rows


def example(folder: Path, name: str) -> Rows:
    return np.loadtxt(folder / name, delimiter=",", skiprows=1)


def turned(points: Rows, quarters: int) -> Rows:
    """Rows turned by quarter turns about the origin, exactly."""
    for _ in range(quarters):
        points = np.column_stack((-points[:, 1], points[:, 0]))
    return points


def square_lattice(side: int) -> Rows:
    return np.array([(x, y) for x in range(side) for y in range(side)], np.float64)


def lengths(points: Rows, edges: NDArray[np.int64]) -> Rows:
    return np.hypot(*(points[edges[:, 0]] - points[edges[:, 1]]).T)


# Small figures, known by hand.


@pytest.mark.parametrize("quarters", range(4))
def test_square_gives_its_sides(quarters: int) -> None:
    square = turned(np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float64), quarters)
    assert cl.crust(square).tolist() == [[0, 1], [0, 3], [1, 2], [2, 3]]


@pytest.mark.parametrize(("side", "count"), [(2, 4), (3, 12), (4, 24), (7, 84)])
def test_square_lattice_gives_its_unit_edges(side: int, count: int) -> None:
    points = square_lattice(side)
    edges = cl.crust(points)
    assert len(edges) == count
    assert np.all(lengths(points, edges) == 1)


@pytest.mark.parametrize("n", range(5, 40, 3))
def test_regular_polygon_gives_its_ring(n: int) -> None:
    for method in (cl.crust, cl.beta_skeleton):
        ring = {tuple(sorted((k, (k + 1) % n))) for k in range(n)}
        assert {tuple(edge) for edge in method(make.circle(n)).tolist()} == ring


def test_collinear_points_give_the_path_along_the_line() -> None:
    points = np.array([(3, 6), (0, 0), (1, 2), (5, 10), (1, 2)], np.float64)
    for method in (cl.crust, cl.beta_skeleton, cl.gabriel, cl.minimum_spanning_tree):
        assert method(points).tolist() == [[0, 2], [0, 3], [1, 2]]


@pytest.mark.parametrize("points", [[], [(1, 2)], [(1, 2), (1, 2), (1, 2)]])
def test_fewer_than_two_distinct_points_have_no_edge(points: list[tuple[int, int]]) -> None:
    rows = np.array(points, np.float64).reshape(-1, 2)
    for method in (cl.crust, cl.beta_skeleton, cl.gabriel, cl.minimum_spanning_tree):
        assert method(rows).shape == (0, 2)


def test_two_points_give_their_edge() -> None:
    assert cl.crust([(0, 0), (3, 4)]).tolist() == [[0, 1]]


# Figure 6: two octagons with a square between them.


def two_curves(points: Rows) -> tuple[set[tuple[int, int]], set[tuple[int, int]]]:
    """Both curves of Figure 6 as edges: the two octagons, and the one curve round both."""
    left = points[:, 0] < points[:, 0].mean()
    sides = {
        (i, j) for i, j in np.argwhere(np.triu(_is_side(points), 1)).tolist() if left[i] == left[j]
    }
    gap = {
        (i, j) for i, j in np.argwhere(np.triu(_is_side(points), 1)).tolist() if left[i] != left[j]
    }
    ends = {row for edge in gap for row in edge}
    facing = {(i, j) for i, j in sides if i in ends and j in ends}
    return sides, (sides - facing) | gap


def _is_side(points: Rows) -> NDArray[np.bool_]:
    distance = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    return np.abs(distance - 2) < 1e-9


def test_observation_6_two_octagons_have_two_curves(examples: Path) -> None:
    points = example(examples, "two_octagons.csv")
    two, one = two_curves(points)
    assert [len(points), len(two), len(one), len(two & one), len(two | one)] == [16, 16, 16, 14, 18]
    for curve, rings in ((two, 2), (one, 1)):
        curves = cl.trace(points, np.array(sorted(curve)))
        assert [len(curves), bool(np.all(curves.closed))] == [rings, True]


def test_two_octagons_crust_is_the_union_and_beta_skeleton_the_intersection(
    examples: Path,
) -> None:
    points = example(examples, "two_octagons.csv")
    two, one = two_curves(points)
    assert sorted(two | one) == oracle.crust(points)
    assert sorted(two & one) == oracle.beta_skeleton(points, 1.7)
    for quarters in range(4):
        figure = turned(points, quarters)
        assert {tuple(edge) for edge in cl.crust(figure).tolist()} == two | one
        assert {tuple(edge) for edge in cl.beta_skeleton(figure).tolist()} == two & one


# The goose and the coast.


@pytest.mark.parametrize("method", [cl.crust, cl.beta_skeleton])
def test_goose_gives_its_curves(examples: Path, method: cl.methods.Method) -> None:
    """The outline and the eye are rings, the wing is an open line; nothing is left over."""
    curves = cl.reconstruct(example(examples, "goose.csv"), method)
    assert sorted(len(curve) for curve in curves if curve.closed) == [9, 153]
    assert [len(curve) for curve in curves if not curve.closed] == [25]
    assert len(curves.isolated) == 0


def test_goose_is_sampled_densest_on_head_and_feet(examples: Path) -> None:
    points = example(examples, "goose.csv")
    steps, middle = lengths(points, cl.crust(points)), points[cl.crust(points)].mean(axis=1)[:, 1]
    back_and_breast = np.median(steps[(middle > 25) & (middle < 90)])
    assert np.median(steps[middle > 90]) < back_and_breast
    assert np.median(steps[middle < 25]) < back_and_breast


@pytest.mark.parametrize("exponent", [-30, 30])
@pytest.mark.parametrize("quarters", range(4))
@pytest.mark.parametrize("mirror", [1, -1])
def test_goose_turned_mirrored_scaled_and_shuffled(
    examples: Path, exponent: int, quarters: int, mirror: int
) -> None:
    points = example(examples, "goose.csv")
    order = np.random.default_rng(quarters).permutation(len(points))
    moved = turned(np.ldexp(points * (mirror, 1), exponent), quarters)[order]
    edges = np.sort(order[cl.crust(moved)], axis=1)
    assert sorted(edges.tolist()) == cl.crust(points).tolist()


def test_new_zealand_gives_its_coasts_and_lakes(examples: Path) -> None:
    points = example(examples, "new_zealand.csv")
    curves = cl.reconstruct(points)
    assert len(curves) == 11
    assert np.all(curves.closed)
    assert len(curves.isolated) == 0
    polygons = curves.polygons()
    assert sum(len(polygon.holes) for polygon in polygons) == 4  # Taupo, Tekapo, Pukaki, Ohau
    assert len(polygons) == 7


@pytest.mark.parametrize("name", ["goose.csv", "two_octagons.csv", "new_zealand.csv"])
def test_read_gives_the_rows_of_an_example(examples: Path, name: str) -> None:
    points = cl.read(examples / name)
    expected = example(examples, name)
    assert len(points) == len(expected)
    assert np.array_equal(np.asarray(points), expected)
