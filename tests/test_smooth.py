"""Smooth reconstruction: what splines and Bézier pieces promise, on curves that are known."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

pytest.importorskip("scipy", reason="the extra crustline[smooth] is not installed")

from scipy.interpolate import CubicSpline, make_interp_spline
from scipy.spatial import cKDTree

from crustline import shapes
from crustline.curves import trace
from crustline.errors import FormatError, InputError, MissingExtraError
from crustline.reconstruction import reconstruct
from crustline.shapes.ratio import sampling_ratio
from crustline.shapes.sampling import r_sample
from crustline.smooth import Ends, Spline, Splines, smooth

Floats = NDArray[np.float64]
TAU = 2 * np.pi

CURVES = {
    "circle": shapes.circle(),
    **{f"ellipse {a}:1": shapes.ellipse(a, 1) for a in (1.1, 1.5, 2, 3, 4, 6)},
    "trefoil": shapes.trefoil(3, 0.3),
    "trefoil of 5": shapes.trefoil(5, 0.3),
    "superformula 4": shapes.superformula(4, 4, 4, 4),
    "superformula 6": shapes.superformula(6, 6, 3, 3),
    "stadium 2": shapes.stadium(2, 1),
    "stadium 4": shapes.stadium(4, 1),
    "blob 6": shapes.blob(6),
    "blob 7": shapes.blob(7),
    "blob 11": shapes.blob(11),
}


def ring_edges(n: int) -> NDArray[np.int64]:
    return np.column_stack([np.arange(n), (np.arange(n) + 1) % n])


def path_edges(n: int) -> NDArray[np.int64]:
    return np.column_stack([np.arange(n - 1), np.arange(1, n)])


def circle(n: int, radius: float = 1.0) -> Floats:
    t = np.arange(n) * (TAU / n)
    return radius * np.column_stack([np.cos(t), np.sin(t)])


def wave(n: int) -> Floats:
    x = np.linspace(0, 3, n)
    return np.column_stack([x, np.sin(x)])


def ring(points: Floats, **options: float) -> Spline:
    return smooth(trace(points, ring_edges(len(points))), **options)[0]  # type: ignore[arg-type]


def on_polygon(points: Floats, parts: int = 40) -> Floats:
    steps = np.roll(points, -1, axis=0) - points
    share = np.linspace(0, 1, parts, endpoint=False)
    return (points[:, None] + share[:, None] * steps[:, None]).reshape(-1, 2)


def on_beziers(control: Floats, parts: int) -> Floats:
    u = np.linspace(0, 1, parts + 1)[:, None, None]
    a, b, c, d = np.moveaxis(control, 1, 0)
    z = 1 - u
    return np.moveaxis(z**3 * a + 3 * u * z * z * b + 3 * u * u * z * c + u**3 * d, 0, 1)


def distance(curve: shapes.SmoothCurve, places: Floats) -> float:
    """Return the largest distance of the places to the curve, by Newton's method."""
    t = np.arange(20_000) / 20_000
    u = t[cKDTree(curve.point(t)).query(places)[1]]
    for _ in range(4):
        point, first, second = curve.derivatives(u)
        gap = point - places
        slope = (first * first).sum(1) + (gap * second).sum(1)
        u = u - (gap * first).sum(1) / slope
    return float(np.hypot(*(curve.point(u) - places).T).max())


def errors(curve: shapes.SmoothCurve, r: float, seed: int | None = None) -> tuple[float, float]:
    """Return the distances of the polygon and of the spline to the curve."""
    points = r_sample(curve, r, seed=seed).points
    spline = ring(points).sample(40 * len(points))
    return distance(curve, on_polygon(points)), distance(curve, spline)


# --- Splines ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", CURVES)
def test_beats_the_polygon_tenfold_at_a_quarter(name: str) -> None:
    for seed in (None, 1):
        polygon, spline = errors(CURVES[name], 0.25, seed)
        assert polygon >= 10 * spline


@pytest.mark.parametrize("seed", range(1, 13))
def test_beats_the_polygon_tenfold_on_blobs_of_enough_samples(seed: int) -> None:
    """LFS does not bound the change of curvature: tenfold needs smaller r on some blobs."""
    polygon, spline = errors(shapes.blob(seed), 0.25)
    assert polygon > 2 * spline
    polygon, spline = errors(shapes.blob(seed), 0.125)
    assert polygon > 10 * spline


def test_no_curve_through_the_samples_could_be_ten_times_nearer_to_all_curves() -> None:
    """Two curves with the same 0.25-sample are farther apart than a fifth of the polygon's error.

    So a third one through these samples is not ten times nearer than the polygon to both.
    """
    blob = shapes.blob(4)
    points = r_sample(blob, 0.22, seed=5).points
    edges = ring_edges(len(points))
    order = trace(points, edges)[0].indices
    other = shapes.spline(points[order])
    assert sampling_ratio(other, points) < 0.25
    apart = distance(blob, other.point(np.arange(20_000) / 20_000))
    polygon = on_polygon(points[order])
    assert apart > max(distance(blob, polygon), distance(other, polygon)) / 5


def test_converges_with_the_fourth_order_at_least_where_the_polygon_has_the_second() -> None:
    for name in ("circle", "ellipse 1.5:1", "ellipse 6:1", "trefoil", "superformula 4"):
        ratios = np.array([0.125, 0.0625, 0.03125])
        table = np.log2([errors(CURVES[name], r) for r in ratios])
        polygon, spline = (-np.polyfit(-np.log2(ratios), column, 1)[0] for column in table.T)
        assert abs(polygon + (-2.0)) < 0.25, name
        assert spline > 3.7, name


def test_is_sixteen_times_nearer_where_the_curvature_jumps() -> None:
    """There both are of the second order."""
    for r in (0.25, 0.125, 0.0625, 0.03125):
        polygon, spline = errors(shapes.stadium(4, 1), r)
        assert 12 < polygon / spline < 24


@pytest.mark.parametrize("mode", ["sparsest", "random"])
def test_open_curves_converge_with_the_fourth_order_up_to_their_ends(mode: str) -> None:
    gaps = []
    for n in (10, 20, 40):
        s = np.linspace(0, 2, n)
        if mode == "random":
            s[1:-1] += np.random.default_rng(n).uniform(-0.3, 0.3, n - 2) * s[1]
        points = np.column_stack([np.cos(s), np.sin(s)])
        places = smooth(trace(points, path_edges(n)))[0].sample(2000)
        gaps.append(np.abs(np.hypot(*places.T) - 1).max())
    assert gaps[0] < 1e-4
    assert gaps[0] > 12 * gaps[1] > 12 * 12 * gaps[2]


def test_beats_theorem_13() -> None:
    """Theorem 13 bounds the polygon's distance by (r²/2) LFS; the spline's is far below."""
    _, spline = errors(shapes.circle(), 0.25)
    assert spline < 0.25**2 / 2 / 50


def test_passes_through_the_samples_exactly() -> None:
    points = shapes.blob(3).point(np.arange(70) / 70)
    for edges in (ring_edges(70), path_edges(70)):
        for spline in smooth(trace(points, edges)):
            np.testing.assert_array_equal(spline.point(spline.parameters), spline.points)


def test_is_the_spline_of_scipy_through_samples_and_middles() -> None:
    points = shapes.blob(4).point(np.arange(50) / 50)
    spline = ring(points)
    knots = np.append(spline.parameters, 1.0)
    knots = np.sort(np.append(knots, (knots[1:] + knots[:-1]) / 2))
    other = CubicSpline(knots, spline.point(knots), bc_type="periodic")
    t = np.random.default_rng(1).random(200)
    np.testing.assert_allclose(spline.point(t), other(t), atol=1e-13)


@pytest.mark.parametrize("kind", ["not-a-knot", "natural"])
def test_runs_are_those_of_scipy(kind: Ends) -> None:
    for n in (4, 5, 6, 7, 20):
        spline = smooth(trace(wave(n), path_edges(n)), ends=kind)[0]
        knots = np.sort(np.append(spline.parameters, spline.parameters[1:]))[:-1]
        knots[1::2] = (spline.parameters[1:] + spline.parameters[:-1]) / 2
        knots = np.append(knots, 1.0)
        other = CubicSpline(knots, spline.point(knots), bc_type=kind)
        t = np.linspace(0, 1, 200)
        np.testing.assert_allclose(spline.point(t), other(t), atol=1e-13)


def test_middles_are_on_the_quintic_spline_by_arc_length() -> None:
    for points, closed in ((shapes.blob(4).point(np.arange(50) / 50), True), (wave(30), False)):
        edges = ring_edges(50) if closed else path_edges(30)
        spline = smooth(trace(points, edges))[0]
        knots = np.append(spline.parameters, [1.0] * closed)
        values = spline.points[np.arange(len(knots)) % len(points)]
        quintic = make_interp_spline(knots, values, 5, bc_type="periodic" if closed else None)
        middle = (knots[1:] + knots[:-1]) / 2
        np.testing.assert_allclose(spline.point(middle), quintic(middle), atol=1e-11)


def test_does_not_depend_on_the_start_and_the_direction() -> None:
    """`trace` starts rings at their smallest index and runs counter-clockwise, so mirror them."""
    for curve in (shapes.blob(9), shapes.stadium(2, 1)):
        points = r_sample(curve, 0.25, seed=3).points
        start = points[:1]
        one = ring(points)
        begin = np.array([[-1, 1]])
        for shift, mirror in ((1, False), (7, False), (0, True), (11, True)):
            rows = np.roll(points, -shift, axis=0) * (begin if mirror else 1)
            other = ring(rows)
            where = np.flatnonzero((other.points == start * (begin if mirror else 1)).all(1))[0]
            t = np.linspace(0, 1, 200)
            places = other.point(other.parameters[where] + (-t if mirror else t))
            if mirror:
                places = places * begin
            np.testing.assert_allclose(places, one.point(t), atol=1e-11)


def test_many_curves_at_once_are_each_alone() -> None:
    rng = np.random.default_rng(2)
    parts = [circle(3), circle(5), shapes.blob(3).point(np.arange(40) / 40), wave(12), wave(3)]
    parts += [np.cumsum(rng.normal(size=(30, 2)), axis=0), wave(2)]
    edges = [ring_edges(len(p)) if k < 3 else path_edges(len(p)) for k, p in enumerate(parts)]
    rows = np.cumsum([0] + [len(part) for part in parts])
    joined = np.concatenate([e + row for e, row in zip(edges, rows[:-1], strict=True)])
    together = smooth(trace(np.concatenate(parts), joined), corner_angle=100)
    t = np.linspace(0, 1, 50)
    for spline, part, e in zip(together, parts, edges, strict=True):
        alone = smooth(trace(part, e), corner_angle=100)[0]
        assert spline.corners.size == alone.corners.size
        np.testing.assert_allclose(spline.point(t), alone.point(t), atol=1e-11)


def test_is_twice_continuously_differentiable_also_where_a_ring_closes() -> None:
    spline = ring(shapes.blob(5).point(np.arange(60) / 60))
    assert len(spline.corners) == 0
    t, tiny = spline.parameters, 1e-9
    for measure in (spline.point, spline.tangent, spline.curvature):
        np.testing.assert_allclose(measure(t - tiny), measure(t + tiny), rtol=1e-3, atol=1e-4)


def test_curvature_and_length_of_a_circle() -> None:
    spline = ring(circle(40, 5.0))
    t = np.linspace(0, 1, 300)
    np.testing.assert_allclose(spline.curvature(t), 0.2, rtol=0.005)
    assert spline.length == pytest.approx(TAU * 5, rel=1e-5)
    fine = spline.sample(100_000)
    walked = np.hypot(*np.diff(np.concatenate([fine, fine[:1]]), axis=0).T).sum()
    assert spline.length == pytest.approx(walked, rel=1e-8)


def test_tangents_are_unit_vectors_along_the_curve() -> None:
    spline = smooth(trace(wave(30), path_edges(30)))[0]
    t = np.linspace(0.01, 0.99, 50)
    step = spline.point(t + 1e-6) - spline.point(t - 1e-6)
    step /= np.hypot(*step.T)[:, None]
    np.testing.assert_allclose(spline.tangent(t), step, atol=1e-6)


def test_any_shape_of_t_and_rings_wrap() -> None:
    spline = ring(circle(12))
    assert spline.point(0.3).shape == (2,)
    assert spline.point(np.zeros((2, 3))).shape == (2, 3, 2)
    assert spline.curvature(np.zeros((2, 3))).shape == (2, 3)
    np.testing.assert_allclose(spline.point(1.25), spline.point(0.25))
    np.testing.assert_array_equal(spline.point(1.0), spline.point(0.0))


def test_natural_ends_have_no_curvature_and_less_accuracy() -> None:
    points = np.column_stack([np.cos(np.linspace(0, 2, 20)), np.sin(np.linspace(0, 2, 20))])
    t = np.linspace(0, 1, 500)
    gaps = {}
    for ends in ("natural", "not-a-knot"):
        spline = smooth(trace(points, path_edges(20)), ends=ends)[0]
        gaps[ends] = np.abs(np.hypot(*spline.point(t).T) - 1).max()
        if ends == "natural":
            np.testing.assert_allclose(spline.curvature([0.0, 1.0]), 0, atol=1e-9)
    assert gaps["not-a-knot"] < gaps["natural"] / 10


@pytest.mark.parametrize("scale", [1e-300, 1e-9, 1e9, 1e300])
def test_scales_with_the_points(scale: float) -> None:
    points = shapes.blob(3).point(np.arange(60) / 60)
    one, other = ring(points), ring(points * scale)
    t = np.linspace(0, 1, 100)
    np.testing.assert_allclose(other.point(t) / scale, one.point(t), atol=1e-13)
    np.testing.assert_allclose(other.tangent(t), one.tangent(t), atol=1e-11)
    assert other.length / scale == pytest.approx(one.length)
    assert len(other.beziers(1e-3 * scale)) == len(one.beziers(1e-3))


def test_cartographic_offset() -> None:
    one, other = ring(circle(40)), ring(circle(40) + 6e6)
    t = np.linspace(0, 1, 100)
    np.testing.assert_allclose(other.point(t) - 6e6, one.point(t), atol=1e-8)
    assert len(other.beziers(1e-3)) == len(one.beziers(1e-3))


# --- Corners and degenerate curves --------------------------------------------------------------


def test_right_angles_stay_right_and_do_not_ring() -> None:
    """A C with right angles: each side stays on its line."""
    x = np.linspace(0, 1, 6)
    outline = [(1 - x, 0 * x), (0 * x[1:], x[1:]), (x[1:], 0 * x[1:] + 1)]
    points = np.concatenate([np.column_stack(part) for part in outline])
    spline = smooth(trace(points, path_edges(len(points))))[0]
    assert spline.corners.tolist() == [5, 10]
    places = spline.sample(1000)
    on_side = np.minimum(np.abs(places[:, 1] * (1 - places[:, 1])), np.abs(places[:, 0]))
    assert on_side.max() < 1e-14
    ringing = smooth(trace(points, path_edges(len(points))), corner_angle=120)[0]
    assert len(ringing.corners) == 0
    assert ringing.sample(1000)[:, 0].min() < -0.01


def test_samples_of_smooth_curves_have_no_corners() -> None:
    """Lemma 10: at r ≤ 0.5 no sample turns by 60°."""
    for curve in CURVES.values():
        for seed in range(3):
            sample = r_sample(curve, 0.5, seed=seed, mode="random")
            assert len(ring(sample.points).corners) == 0


def test_a_ring_with_one_corner() -> None:
    """A drop: a round side, and a tip at sample 7."""
    t = np.linspace(0, 1, 41)[:-1]
    drop = np.column_stack([np.cos(TAU * t), np.sin(TAU * t) * np.sin(np.pi * t) ** 1.0])
    points = np.roll(drop, 7, axis=0)
    spline = smooth(trace(points, ring_edges(40)))[0]
    assert spline.corners.tolist() == [7]
    for control in (spline.beziers(), spline.beziers(1e-3)):
        np.testing.assert_array_equal(control[0, 0], points[7])
        np.testing.assert_array_equal(control[-1, 3], points[7])


def test_a_square_is_a_square() -> None:
    spline = ring(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]))
    assert spline.corners.tolist() == [0, 1, 2, 3]
    assert spline.length == pytest.approx(4.0)
    assert len(spline.beziers(1e-6)) == 4
    rounded = ring(spline.points, corner_angle=120)
    assert len(rounded.corners) == 0
    assert np.abs(np.hypot(*(rounded.sample(100) - 0.5).T) / 0.5**0.5 - 1).max() < 0.04


def test_three_points_in_a_ring() -> None:
    spline = ring(circle(3), corner_angle=180)
    np.testing.assert_allclose(spline.point(spline.parameters), spline.points)
    t, tiny = spline.parameters, 1e-9
    np.testing.assert_allclose(spline.tangent(t - tiny), spline.tangent(t + tiny), atol=1e-6)
    assert spline.length > ring(circle(3)).length


def test_two_and_three_points_in_a_polyline() -> None:
    line = smooth(trace([(0, 0), (3, 4)], [(0, 1)]))[0]
    assert line.length == pytest.approx(5.0)
    np.testing.assert_allclose(line.point([0.5]), [[1.5, 2]])
    np.testing.assert_allclose(line.curvature([0.0, 0.5, 1.0]), 0, atol=1e-15)
    np.testing.assert_allclose(line.beziers(1e-9)[0], [[0, 0], [1, 4 / 3], [2, 8 / 3], [3, 4]])
    parabola = smooth(trace([(-1, 1), (0, 0), (1, 1)], [(0, 1), (1, 2)]), corner_angle=170)[0]
    places = parabola.sample(50)
    np.testing.assert_allclose(places[:, 1], places[:, 0] ** 2, atol=1e-14)


def test_collinear_ring_turns_back_at_its_ends() -> None:
    points = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0]])
    spline = smooth(trace(points, ring_edges(4)))[0]
    assert sorted(spline.corners.tolist()) == [0, 3]
    assert np.abs(spline.sample(100)[:, 1]).max() == 0
    assert spline.length == pytest.approx(6.0)


def test_repeated_samples_count_once() -> None:
    points = circle(20)
    twice = np.repeat(points, 2, axis=0)
    one, other = ring(points), ring(twice)
    t = np.linspace(0, 1, 99)
    np.testing.assert_allclose(other.point(t), one.point(t), atol=1e-14)
    np.testing.assert_array_equal(other.point(other.parameters), other.points)
    assert len(other.beziers()) == 40


def test_uneven_spacing_does_not_overshoot() -> None:
    """Arcs of circles, the samples of which are near or far by up to ten powers of ten."""
    rng = np.random.default_rng(3)
    for n in (3, 5, 6, 9, 30):
        for _ in range(20):
            angle = np.cumsum(10.0 ** rng.uniform(-10, 0, n))
            angle *= rng.uniform(0.5, 5) / angle[-1]
            points = np.column_stack([np.cos(angle), np.sin(angle)])
            for spline in smooth(trace(points, path_edges(n))):
                radius = np.hypot(*spline.sample(500).T)
                assert np.abs(radius - 0.7).max() < 0.7


def test_curves_of_one_place_stand_still() -> None:
    for edges in (path_edges(3), ring_edges(3)):
        spline = smooth(trace(np.full((3, 2), 7.0), edges))[0]
        np.testing.assert_array_equal(spline.point([0.0, 0.4]), 7.0)
        assert spline.length == 0.0
        assert np.isnan(spline.tangent(0.5)).all()
        assert np.isnan(spline.curvature(0.5))
        assert np.all(spline.beziers(0.1) == 7.0)


def test_no_curves() -> None:
    none = smooth(trace(np.zeros((0, 2)), np.zeros((0, 2), np.int64)))
    assert len(none) == 0
    assert none.beziers(0.1) == []
    assert none.lengths.shape == (0,)


def test_goes_with_what_reconstruct_gives() -> None:
    points = np.concatenate([circle(30), circle(20, 0.4), [[9.0, 9.0]]])
    curves = reconstruct(points)
    splines = smooth(curves)
    assert isinstance(splines, Splines)
    assert [len(each) for each in splines] == [30, 20]
    np.testing.assert_allclose(splines.lengths, [TAU, 0.4 * TAU], rtol=1e-4)
    assert len(splines[:1]) == 1
    moved = smooth(reconstruct(points + 1))
    np.testing.assert_array_equal(moved[1].points, splines[1].points + 1)


# --- Samples and Bézier pieces ------------------------------------------------------------------


@pytest.mark.parametrize("tolerance", [0.1, 1e-3, 1e-5])
def test_polygon_within_the_tolerance(tolerance: float) -> None:
    spline = ring(shapes.blob(2).point(np.arange(60) / 60))
    vertices = spline.sample(tolerance=tolerance)
    fine = spline.sample(20_000)
    a, b = vertices, np.roll(vertices, -1, axis=0)
    step = b - a
    gaps = np.full(len(fine), np.inf)
    for start, along in zip(a, step, strict=True):
        share = np.clip((fine - start) @ along / (along @ along), 0, 1)
        gaps = np.minimum(gaps, np.hypot(*(fine - start - share[:, None] * along).T))
    assert gaps.max() <= tolerance
    known = {tuple(row) for row in vertices.tolist()}
    assert all(tuple(row) in known for row in spline.points.tolist())


def test_counts() -> None:
    assert ring(circle(12)).sample(7).shape == (7, 2)
    ends = smooth(trace(wave(12), path_edges(12)))[0].sample(2)
    np.testing.assert_array_equal(ends, wave(12)[[0, -1]])


def test_exact_beziers_are_the_spline() -> None:
    spline = ring(shapes.blob(1).point(np.arange(50) / 50))
    control = spline.beziers()
    assert control.shape == (100, 4, 2)
    np.testing.assert_array_equal(control[::2, 0], spline.points)
    np.testing.assert_array_equal(control[1::2, 3], np.roll(spline.points, -1, axis=0))
    knots = np.append(spline.parameters, 1.0)
    for half, share in ((0, 0.25), (1, 0.75)):
        places = spline.point(knots[:-1] + share * np.diff(knots))
        np.testing.assert_allclose(on_beziers(control[half::2], 2)[:, 1], places, atol=1e-14)


def nearest(places: Floats, vertices: Floats) -> Floats:
    """Return the distance of places to a fine polygon, by the two edges at the nearest vertex."""
    near = cKDTree(vertices).query(places)[1]
    gaps = []
    for first in (near - 1, near):
        a, b = vertices[first], vertices[(first + 1) % len(vertices)]
        step, way = b - a, places - a
        square = np.maximum((step * step).sum(1), 1e-300)
        share = np.clip((way * step).sum(1) / square, 0, 1)
        gaps.append(np.hypot(*(way - share[:, None] * step).T))
    return np.minimum(*gaps)


@pytest.mark.parametrize("name", ["circle", "ellipse 3:1", "blob 7"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
def test_few_beziers_keep_within_the_tolerance_both_ways(name: str, tolerance: float) -> None:
    points = r_sample(CURVES[name], 0.1).points
    spline = ring(points)
    control = spline.beziers(tolerance)
    assert len(control) <= len(points)
    fine = on_beziers(control, 4000 // len(control) * 10)[:, :-1].reshape(-1, 2)
    true = spline.sample(40_000)
    slack = 1e-8  # of the two fine polygons
    assert nearest(fine, true).max() <= tolerance + slack
    assert nearest(true, fine).max() <= tolerance + slack


def test_few_beziers_are_few() -> None:
    """The error of such fits is of the sixth order: six digits for ten times the pieces."""
    spline = ring(circle(400))
    assert len(spline.beziers(1e-3)) == 4
    assert len(spline.beziers(1e-2)) <= 3
    counts = [len(spline.beziers(10.0**-k)) for k in range(1, 9)]
    assert counts == sorted(counts)
    assert counts[7] <= 1.5 * 10 ** (4 / 6) * counts[3]


def test_few_beziers_join_smoothly_and_start_where_pieces_do() -> None:
    points = shapes.blob(8).point(np.arange(300) / 300)
    spline = ring(points)
    control = spline.beziers(1e-4)
    assert len(control) < 60
    np.testing.assert_array_equal(control[:, 3], np.roll(control[:, 0], -1, axis=0))
    leaving = control[:, 1] - control[:, 0]
    arriving = np.roll(control[:, 3] - control[:, 2], 1, axis=0)
    turn = leaving[:, 0] * arriving[:, 1] - leaving[:, 1] * arriving[:, 0]
    lengths = np.hypot(*leaving.T) * np.hypot(*arriving.T)
    assert np.abs(turn / lengths).max() < 1e-9
    starts = {tuple(row) for row in spline.beziers()[:, 0].tolist()}
    assert all(tuple(row) in starts for row in control[:, 0].tolist())


def test_long_curves_need_few_pieces_too() -> None:
    """20,000 samples are walked in parts; that must not show in the answer."""
    dense, sparse = ring(circle(20_000)), ring(circle(500))
    assert len(dense.beziers(1e-3)) == len(sparse.beziers(1e-3)) == 4


def test_a_straight_polyline_is_one_piece() -> None:
    points = np.column_stack([np.arange(100.0), 2 * np.arange(100.0)])
    assert len(smooth(trace(points, path_edges(100)))[0].beziers(1e-9)) == 1


def test_all_curves_at_once_are_each_alone() -> None:
    points = np.concatenate([shapes.blob(k).point(np.arange(90) / 90) + 9 * k for k in range(4)])
    edges = np.concatenate([ring_edges(90) + 90 * k for k in range(4)])
    splines = smooth(trace(points, edges))
    for spline, control in zip(splines, splines.beziers(1e-4), strict=True):
        np.testing.assert_allclose(control, spline.beziers(1e-4), atol=1e-9)


# --- Files and pictures -------------------------------------------------------------------------


def parsed(path: Path) -> list[tuple[Floats, bool]]:
    """Return the control points of the paths of an SVG file, y upwards, and if they close."""
    svgelements = pytest.importorskip("svgelements")
    found = []
    for path_ in svgelements.SVG.parse(str(path), reify=False).elements():
        if isinstance(path_, svgelements.Path):
            curves = [each for each in path_ if isinstance(each, svgelements.CubicBezier)]
            rows = [[each.start, each.control1, each.control2, each.end] for each in curves]
            control = np.array([[[p.x, p.y] for p in row] for row in rows])
            found.append((control, isinstance(path_[-1], svgelements.Close)))
    return found


@pytest.mark.parametrize("tolerance", [None, 1e-3])
def test_svg_read_again_is_the_beziers(tmp_path: Path, tolerance: float | None) -> None:
    points = np.concatenate([circle(30), wave(20) + 2, [[0.0, 5.0]]])
    edges = np.concatenate([ring_edges(30), path_edges(20) + 30])
    splines = smooth(trace(points, edges))
    path = tmp_path / "curves.svg"
    splines.write(path, tolerance=tolerance)
    drawn = parsed(path)[:2]
    for (control, closes), truth, spline in zip(
        drawn, splines.beziers(tolerance), splines, strict=True
    ):
        np.testing.assert_array_equal(control, truth)
        assert closes == spline.closed
    text = path.read_text()
    assert "L" not in text.split("<path", 1)[1].split("</g>")[0]
    assert "h0" in text
    assert 'transform="scale(1 -1)"' in text
    assert splines._repr_svg_().startswith("<svg")


def test_svg_of_nothing(tmp_path: Path) -> None:
    smooth(trace(np.zeros((0, 2)), np.zeros((0, 2), np.int64))).write(tmp_path / "none.svg")
    assert (tmp_path / "none.svg").read_text().startswith("<svg")


def test_plot_draws_the_beziers() -> None:
    pytest.importorskip("matplotlib")
    points = np.concatenate([circle(30), wave(20) + 2])
    splines = smooth(trace(points, np.concatenate([ring_edges(30), path_edges(20) + 30])))
    ax = splines.plot()
    assert len(ax.patches) == 2
    vertices = ax.patches[0].get_path().vertices
    np.testing.assert_allclose(
        vertices[:181],
        np.vstack([splines[0].beziers()[0, :1], splines[0].beziers()[:, 1:].reshape(-1, 2)]),
    )
    assert splines.plot(ax, points=False) is ax


# --- Errors -------------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [0, -1, 181, float("nan")])
def test_refuses_corner_angles(angle: float) -> None:
    with pytest.raises(InputError, match=r"corner_angle must be .*\(0, 180\]"):
        ring(circle(9), corner_angle=angle)


def test_refuses_bad_input(tmp_path: Path) -> None:
    points = circle(9)
    line = smooth(trace(wave(9), path_edges(9)))
    with pytest.raises(InputError, match=r"ends must be .*, not 'clamped'"):
        smooth(trace(points, ring_edges(9)), ends="clamped")  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"curves is \[\(0, 0\).*pass what trace or reconstruct"):
        smooth([(0, 0), (1, 1)])  # type: ignore[arg-type]
    for t in (-0.1, 1.1, np.nan):
        with pytest.raises(InputError, match=rf"t is {t}"):
            line[0].point([0.5, t])
    with pytest.raises(InputError, match="t is inf"):
        ring(points).point(np.inf)
    for tolerance in (0, -1, np.nan, np.inf):
        with pytest.raises(InputError, match="tolerance must be"):
            line.beziers(tolerance)
        with pytest.raises(InputError, match="tolerance must be"):
            line[0].sample(tolerance=tolerance)
    with pytest.raises(InputError, match=r"count must be .*, not 1"):
        line[0].sample(1)
    with pytest.raises(InputError, match=r"count must be .*, not 2\.5"):
        line[0].sample(2.5)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="give one"):
        line[0].sample()
    with pytest.raises(InputError, match=r"name it \.svg"):
        line.write(tmp_path / "curves.png")
    with pytest.raises(FormatError, match="cannot be written"):
        line.write(tmp_path / "missing" / "curves.svg")


def test_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(MissingExtraError, match=r"crustline\[smooth\]"):
        smooth(trace(circle(9), ring_edges(9)))


def test_the_least_corner_angle_leaves_ends_alone() -> None:
    """In radians it is 0, which ends turn by, too."""
    (spline,) = smooth(trace([(0, 0), (1, 0), (1, 1)], [(0, 1), (1, 2)]), corner_angle=5e-324)
    assert spline.corners.tolist() == [1]
