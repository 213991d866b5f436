"""Tracing, its shapes and sums, and rings nested into polygons."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from crustline.curves import Curve, Curves, trace
from crustline.errors import InputError
from crustline.points import Points
from crustline.reconstruction import reconstruct
from crustline.testing import assert_same_curves, assert_same_edges


def cycle(rows):
    return [(rows[k - 1], rows[k]) for k in range(len(rows))]


def path(rows):
    return list(pairwise(rows))


def square(center=(0.0, 0.0), half=1.0):
    x, y = center
    return [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]


def rings(*outlines):
    """Trace outlines, each a ring; the k-th ring holds rows in the order of the outlines."""
    points: list = []
    edges: list = []
    for outline in outlines:
        rows = range(len(points), len(points) + len(outline))
        edges += cycle(list(rows))
        points += outline
    return trace(points, edges)


def signed_area(points):
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


# Tracing


def test_a_ring_starts_at_its_smallest_row_and_runs_counter_clockwise():
    points = square()
    for order in ([0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]):
        shuffled = [points[k] for k in order]
        rows = [order.index(k) for k in range(4)]
        (ring,) = trace(shuffled, cycle(rows))
        assert ring.closed
        assert ring.indices[0] == 0
        assert signed_area(ring.points) == 4


def test_a_polyline_starts_at_its_end_of_smaller_index():
    (polyline,) = trace([(3, 0), (1, 0), (2, 0), (0, 0)], path([3, 1, 2, 0]))
    assert not polyline.closed
    assert polyline.indices.tolist() == [0, 2, 1, 3]


def test_curves_split_at_branches():
    points = [(0, 0), (1, 0), (-1, 1), (-1, -1), (2, 0)]
    curves = trace(points, [(0, 1), (0, 2), (0, 3), (1, 4)])
    assert [curve.indices.tolist() for curve in curves] == [[0, 1, 4], [0, 2], [0, 3]]
    assert curves.branches.tolist() == [0]
    assert curves.endpoints.tolist() == [2, 3, 4]


def test_a_loop_based_at_one_branch_is_a_ring():
    points = [(0, 0), (1, 1), (1, -1), (-1, 0)]
    curves = trace(points, [(0, 1), (1, 2), (0, 2), (0, 3)])
    assert [(curve.indices.tolist(), curve.closed) for curve in curves] == [
        ([0, 2, 1], True),
        ([0, 3], False),
    ]


def random_planar_edges(rng, n=60):
    """Some edges of a lattice: every degree from 0 to 4, loops and branches."""
    points = [(k % 10, k // 10) for k in range(n)]
    right = [(k, k + 1) for k in range(n) if k % 10 < 9]
    up = [(k, k + 10) for k in range(n - 10)]
    edges = np.array(right + up)
    return np.array(points, dtype=float), edges[rng.random(len(edges)) < rng.uniform(0.2, 0.9)]


def test_every_edge_is_in_exactly_one_curve_and_every_point_is_accounted_for():
    rng = np.random.default_rng(11)
    for _ in range(50):
        points, edges = random_planar_edges(rng)
        flipped = np.where(rng.random((len(edges), 1)) < 0.5, edges[:, ::-1], edges)
        curves = trace(points, rng.permutation(flipped))
        assert_same_edges(curves.edges, edges)
        steps = sum(len(c) if c.closed else len(c) - 1 for c in curves)
        assert steps == len(edges)
        touched = set(edges.ravel().tolist())
        assert set(curves.isolated.tolist()) == set(range(len(points))) - touched
        degrees = np.bincount(edges.ravel(), minlength=len(points))
        assert curves.branches.tolist() == np.flatnonzero(degrees >= 3).tolist()
        assert curves.endpoints.tolist() == np.flatnonzero(degrees == 1).tolist()
        first = [int(c.indices[0]) for c in curves]
        assert first == sorted(first)
        for curve in curves:
            inner = curve.indices[1:] if curve.closed else curve.indices[1:-1]
            assert (degrees[inner] == 2).all() or (
                curve.closed and (degrees[inner] != 2).sum() == 1
            )


def test_a_repeated_edge_counts_once():
    curves = trace([(0, 0), (1, 0)], [(0, 1), (1, 0), (0, 1)])
    assert curves.edges.tolist() == [[0, 1]]


def test_no_edges_and_no_points():
    assert len(trace([], [])) == 0
    curves = trace([(0, 0), (1, 1)], [])
    assert (len(curves), curves.isolated.tolist()) == (0, [0, 1])
    assert curves.edges.shape == (0, 2)
    assert curves.lengths.shape == (0,)
    assert curves.polygons() == []


def test_bad_edges_are_named():
    with pytest.raises(InputError, match="row 1"):
        trace([(0, 0), (1, 1)], [(0, 1), (0, 2)])


def test_points_are_kept_as_they_were_passed():
    points = Points([(0, 0), (1, 0)], z=[5, 6])
    curves = trace(points, [(0, 1)])
    assert curves.points is points
    assert type(curves[0].points) is np.ndarray


def test_reconstruct_passes_the_points_and_parameters_to_the_method():
    seen = []

    def method(points, *, alpha):
        seen.append((points, alpha))
        return [(0, 1)]

    points = Points([(0, 0), (1, 0)])
    curves = reconstruct(points, method, alpha=3)
    assert seen[0][0].points is points
    assert seen[0][1] == 3
    assert curves.edges.tolist() == [[0, 1]]


def test_reconstruct_a_circle():
    angles = np.random.default_rng(1).permutation(40) * (2 * math.pi / 40)
    points = np.column_stack([np.cos(angles), np.sin(angles)])
    (ring,) = reconstruct(points)
    assert ring.closed
    along = np.unwrap(np.arctan2(ring.points[:, 1], ring.points[:, 0]))
    assert np.allclose(np.diff(along), 2 * math.pi / 40)


# Curves as a sequence


def test_curves_are_a_sequence():
    curves = rings(square(), square((5, 0)))
    assert len(curves) == 2
    assert curves[-1].indices.tolist() == [4, 5, 6, 7]
    assert [c.indices.tolist() for c in curves[:1]] == [[0, 1, 2, 3]]
    assert len(list(reversed(curves))) == 2
    with pytest.raises(IndexError):
        curves[2]


def test_lengths_are_the_sums_of_their_edges():
    points, edges = random_planar_edges(np.random.default_rng(3))
    curves = trace(points, edges)
    assert np.allclose(curves.lengths, [curve.length for curve in curves])
    assert math.isclose(curves.lengths.sum(), len(edges))


def test_the_repr_counts():
    curves = trace([*square(), (9, 9)], cycle([0, 1, 2, 3]))
    assert repr(curves) == "<Curves: 1 ring, 0 polylines, 1 isolated point; 5 points>"
    assert repr(curves[0]) == "<Curve: ring of 4 points>"


def test_results_are_read_only():
    curves = rings(square())
    for array in (curves.indices, curves.offsets, curves.closed, curves.edges, curves.lengths):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


# Polygons


def nested(curves):
    return [
        (polygon.shell.tolist(), [hole.tolist() for hole in polygon.holes])
        for polygon in curves.polygons()
    ]


def test_an_island_in_a_lake_is_a_shell_again():
    curves = rings(square(half=4), square(half=3), square(half=2), square(half=1), square((20, 0)))
    outer, lake, island, pond, away = ([4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3] for k in range(5))
    assert nested(curves) == [(outer, [lake]), (island, [pond]), (away, [])]


def test_nesting_does_not_depend_on_the_order_of_rings():
    rng = np.random.default_rng(2)
    for _ in range(20):
        sizes = rng.permutation(np.arange(1.0, 8.0))
        curves = rings(*(square(half=half) for half in sizes))
        shells = {float(sizes[shell[0] // 4]): holes for shell, holes in nested(curves)}
        assert sorted(shells) == [1, 3, 5, 7]
        for half in (3.0, 5.0, 7.0):
            (hole,) = shells[half]
            assert sizes[hole[0] // 4] == half - 1


def test_a_ring_that_touches_another_at_a_branch_nests_by_its_own_points():
    # Two triangles share point 0: one inside the other, and one outside of it.
    outer = [(0, 0), (8, -4), (8, 4)]
    points = [*outer, (4, -1), (4, 1), (-4, -1), (-4, 1)]
    curves = trace(points, cycle([0, 1, 2]) + cycle([0, 3, 4]) + cycle([0, 6, 5]))
    found = nested(curves)
    assert ([0, 1, 2], [[0, 3, 4]]) in found
    assert ([0, 6, 5], []) in found


def test_many_islands_agree_with_an_oracle():
    rng = np.random.default_rng(4)
    lake = [(60 * math.cos(t), 60 * math.sin(t)) for t in np.arange(200) * (math.pi / 100)]
    centers = [(x, y) for x in range(-75, 80, 3) for y in range(-75, 80, 3)]
    centers = [c for c in centers if abs(math.hypot(*c) - 60) > 3]
    curves = rings(lake, *(square(c, rng.uniform(0.1, 1.4)) for c in centers))
    inside = {4 * k + 200 for k, c in enumerate(centers) if math.hypot(*c) < 60}
    by_start = {int(polygon.shell[0]): polygon for polygon in curves.polygons()}
    assert {int(hole[0]) for hole in by_start[0].holes} == inside
    assert len(by_start) == 1 + len(centers) - len(inside)


@pytest.mark.parametrize("scale", [2.0**-300, 2.0**-30, 2.0**300])
@pytest.mark.parametrize("offset", [0.0, 2.0**23])
def test_nesting_is_exact_at_any_scale(scale, offset):
    # The inner point lies one unit in the last place off an edge of the other ring.
    outer = [(0.0, 0.0), (3.0, 1.0), (0.0, 2.0)]
    inner = [(np.nextafter(1.5, 0.0), 0.5), (1.0, 1.25), (0.5, 1.0)]
    outside = [(np.nextafter(1.5, 2.0), 0.5), (3.0, 0.5), (2.5, 0.25)]

    def place(outline):
        return [(scale * (x + offset), scale * (y + offset)) for x, y in outline]

    if offset:
        inner[0], outside[0] = (1.5 - 2**-29, 0.5), (1.5 + 2**-29, 0.5)
    found = nested(rings(place(outer), place(inner), place(outside)))
    assert sorted((min(shell), sorted(min(h) for h in holes)) for shell, holes in found) == [
        (0, [3]),
        (6, []),
    ]


def test_crossing_rings_do_not_fail():
    polygons = rings(square(), square((1, 1))).polygons()
    assert sum(1 + len(polygon.holes) for polygon in polygons) == 2


def test_thousands_of_rings_nest_fast():
    centers = [(3.0 * x, 3.0 * y) for x in range(60) for y in range(60)]
    curves = rings(square((90, 90), 200), *(square(center) for center in centers))
    (polygon,) = curves.polygons()
    assert len(polygon.holes) == 3600


# The assertions of crustline.testing


def a_curve(rows, closed):
    return Curve(np.array(rows), closed, np.zeros((len(rows), 2)))


def test_same_curves_up_to_start_and_direction():
    ring, line = [0, 4, 2, 3], [5, 6, 7]
    expected = [a_curve(ring, True), a_curve(line, False)]
    for turned in (ring[2:] + ring[:2], ring[::-1], [2, 4, 0, 3]):
        assert_same_curves([a_curve(line[::-1], False), a_curve(turned, True)], expected)


@pytest.mark.parametrize(
    ("rows", "closed"), [([0, 2, 4, 3], True), ([0, 4, 2, 3], False), ([0, 4, 2], True)]
)
def test_other_curves_differ(rows, closed):
    with pytest.raises(AssertionError, match="missing ring 0-3-2-4; extra"):
        assert_same_curves([a_curve(rows, closed)], [a_curve([0, 4, 2, 3], True)])


def test_isolated_points_differ():
    two = trace([(0, 0), (1, 0), (2, 0)], [(0, 1)])
    three = trace([(0, 0), (1, 0)], [(0, 1)])
    with pytest.raises(AssertionError, match="isolated points differ: extra 2"):
        assert_same_curves(two, three)


def test_other_edges_differ():
    assert_same_edges([], np.empty((0, 2)))
    assert_same_edges([(1, 0)], [(0, 1)])
    with pytest.raises(AssertionError, match=r"missing \(0, 2\), \(1, 2\); extra \(0, 1\)"):
        assert_same_edges([(1, 0)], [(2, 1), (2, 0)])
    with pytest.raises(AssertionError, match="extra"):
        assert_same_edges([(0, 1), (1, 0)], [(0, 1)])


def test_notebooks_show_a_picture():
    assert rings(square())._repr_svg_().startswith("<svg")
    assert isinstance(rings(square()), Curves)


def test_a_repeated_row_of_a_joined_point_is_not_isolated() -> None:
    square = [(0, 0), (1, 0), (1, 1), (0, 1), (1, 1), (9, 9), (9, 9)]
    curves = trace(square, [(0, 1), (1, 2), (2, 3), (0, 3)])
    assert curves.isolated.tolist() == [5]


# Orientation


def area_signs(curves):
    return [np.sign(signed_area(curve.points)) for curve in curves if curve.closed]


NESTED = rings(square(half=5), square(half=3), square(half=1), square((20, 0)))


@pytest.mark.parametrize(
    ("rule", "signs"),
    [
        ("ccw", [1, 1, 1, 1]),
        ("cw", [-1, -1, -1, -1]),
        ("rfc7946", [1, -1, 1, 1]),
        ("gis", [-1, 1, -1, -1]),
    ],
)
def test_rings_run_as_the_rule_says_whatever_they_did_before(rule, signs):
    assert area_signs(NESTED.oriented(rule)) == signs
    for before in ("ccw", "cw", "rfc7946", "gis"):
        again = NESTED.oriented(before).oriented(rule)
        assert again == NESTED.oriented(rule)
        assert [curve.indices[0] for curve in again] == [0, 4, 8, 12]
        np.testing.assert_array_equal(again.edges, NESTED.edges)


@pytest.mark.parametrize(("rule", "signs"), [(None, [1, -1]), ("ccw", [1, 1]), ("gis", [-1, 1])])
def test_polygons_run_as_their_rings_were_oriented(rule, signs):
    feature = next(NESTED.oriented(rule).features(polygons=True))
    assert [np.sign(signed_area(NESTED.points.xy[rows])) for rows in feature.parts] == signs


def test_curves_start_where_they_are_asked_to():
    ring, line = square(), [(5.0, 0.0), (6.0, 0.0), (7.0, 1.0)]
    curves = trace(ring + line, [*cycle([0, 1, 2, 3]), (4, 5), (5, 6)])

    def firsts(start):
        return [int(curve.indices[0]) for curve in curves.oriented(start=start)]

    assert firsts((9, 9)) == [2, 6]
    assert firsts((6, 0)) == [1, 4]  # a polyline starts at an end
    assert firsts("north") == [2, 6]  # of rows 2 and 3, the smaller
    assert firsts("west") == [0, 4]
    assert firsts("east") == [1, 6]
    assert firsts(3) == [3, 4]
    assert firsts(np.int64(6)) == [0, 6]
    assert curves.oriented(start=6)[1].indices.tolist() == [6, 5, 4]
    assert curves.oriented("cw", start=2)[0].indices.tolist() == [2, 1, 0, 3]
    for row in (5, 7, -1):
        with pytest.raises(InputError, match="at no end"):
            firsts(row)
    for start in ("up", (1, 2, 3), (math.nan, 0), object(), True):
        with pytest.raises(InputError, match="give x and y, a row"):
            firsts(start)
    with pytest.raises(InputError, match="orient must be"):
        curves.oriented("left")
    assert curves.oriented() == curves


def test_no_curves_can_be_oriented():
    none = trace([(0, 0)], [])
    assert len(none.oriented("gis", start=(0, 0))) == 0


def test_reconstruct_orients():
    points = square()
    assert reconstruct(points, orient="cw", start="north")[0].indices.tolist() == [2, 1, 0, 3]


def test_rings_across_the_180th_meridian_nest_in_degrees():
    """In the plane of degrees the outer one was a band around the globe, and its lakes outside."""

    def box(west, east, south, north):
        return [(west, south), (east, south), (east, north), (west, north)]

    rings = [box(170, -170, -20, -10), box(175, 178, -16, -14), box(179, -179, -16, -14)]
    points = Points(np.concatenate(rings), crs="EPSG:4326")
    edges = [(4 * k + i, 4 * k + (i + 1) % 4) for k in range(3) for i in range(4)]
    (polygon,) = trace(points, edges).polygons()
    assert sorted(polygon.shell) == [0, 1, 2, 3]
    assert [sorted(hole) for hole in polygon.holes] == [[4, 5, 6, 7], [8, 9, 10, 11]]
    antarctica = [(x, -70) for x in range(-180, 180, 30)] + box(-10, 10, -80, -75)
    edges = [(i, (i + 1) % 12) for i in range(12)] + [(12 + i, 12 + (i + 1) % 4) for i in range(4)]
    (polygon,) = trace(Points(antarctica, crs="OGC:CRS84"), edges).polygons()
    assert len(polygon.holes) == 1
