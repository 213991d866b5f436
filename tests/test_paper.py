"""The paper's numbered statements about curves and samples, on curves and samples.

Those about formulas are in `test_theory.py`; the last test here looks for all twenty. Wherever it
is cheap, a statement's premise is also broken, and its conclusion seen to fail: so the premise is
what made it hold, and the test can tell.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import generators
from crustline import (
    Delaunay,
    beta_skeleton,
    crust,
    r_sample,
    shapes,
    theory,
)
from crustline.shapes import CurveMedialAxis, SmoothCurve
from crustline.shapes.ratio import is_r_sample, sampling_ratio
from crustline.shapes.sampling import Mode

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Edges = set[tuple[int, int]]

CURVES = {
    "ellipse": shapes.ellipse(3, 1),
    **generators.SMOOTH_CURVES,
}
RINGS = shapes.circle(1.0) + shapes.circle(1.2) + shapes.circle(1.4)
SEEDS = range(3)
# Both curve and axis are polygons here: a disk that misses by less than this share of its radius
# proves nothing.
TOLERANCE = 1e-3


@pytest.fixture(params=list(CURVES), ids=lambda name: str(name).replace(" ", "-"))
def curve(request: pytest.FixtureRequest) -> SmoothCurve:
    return CURVES[request.param]


# --- Disks, curves and medial axes --------------------------------------------------------------


def along(curve: SmoothCurve, k: int) -> FloatArray:
    """Return k values of t on each loop, (c, k)."""
    c = len(curve.loops)
    return (np.arange(c)[:, None] + np.arange(k) / k) / c


@cache
def drawn(curve: SmoothCurve) -> FloatArray:
    """Return the curve as dense points, one row for each loop, (c, k, 2)."""
    return curve.point(along(curve, 3000))


def extent(curve: SmoothCurve) -> float:
    return float(np.hypot(*np.ptp(drawn(curve).reshape(-1, 2), axis=0)))


def inside(curve: SmoothCurve, center: FloatArray, radius: FloatArray) -> BoolArray:
    """Return which of the dense points lie in the interior of each disk, (c, d, k)."""
    x, y = np.moveaxis(drawn(curve)[:, None] - center[:, None], -1, 0)
    return np.asarray(np.hypot(x, y) < radius[:, None] * (1 - 1e-9))


def meets_in_one_arc(curve: SmoothCurve, center: FloatArray, radius: FloatArray) -> BoolArray:
    """Return whether each disk meets the curve in one arc: a whole loop is not an arc."""
    within = inside(curve, center, radius)
    entries = (within & ~np.roll(within, 1, axis=-1)).sum(axis=(0, -1))
    return np.asarray((entries <= 1) & ~within.all(axis=-1).any(axis=0))


def axis_distance(axis: CurveMedialAxis, points: FloatArray) -> FloatArray:
    """Return the distance from each point to the nearest of all vertices and segments."""
    ends = axis.vertices[axis.segments]
    start, step = ends[:, 0], ends[:, 1] - ends[:, 0]
    square = np.maximum(np.sum(step * step, axis=1), 1e-300)
    out = []
    for p in points:
        share = np.clip(np.sum((p - start) * step, axis=1) / square, 0, 1)
        near = np.concatenate([axis.vertices, start + share[:, None] * step]) - p
        out.append(np.sqrt(np.min(np.sum(near * near, axis=1))))
    return np.array(out)


def random_disks(curve: SmoothCurve, seed: int, k: int = 700) -> tuple[FloatArray, FloatArray]:
    """Return disks near the curve, no larger than the part of its axis that is traced reaches."""
    rng = np.random.default_rng(seed)
    low, high = (f(drawn(curve).reshape(-1, 2), axis=0) for f in (np.min, np.max))
    size = extent(curve)
    center = rng.uniform(low - 0.1 * size, high + 0.1 * size, (k, 2))
    return center, 0.45 * size * rng.random(k) ** 2


def test_lemma_1_disk_without_medial_axis_point_meets_the_curve_in_one_arc(
    curve: SmoothCurve,
) -> None:
    center, radius = random_disks(curve, 1)
    several = ~meets_in_one_arc(curve, center, radius)
    axis = curve.medial_axis()
    free = axis_distance(axis, center) > radius * (1 + TOLERANCE)
    two_points = inside(curve, center, radius).sum(axis=(0, -1)) >= 2
    assert (free & two_points).sum() > 20
    assert several.sum() > 20
    assert not np.any(several & free)


def test_lemma_1_fails_with_a_third_of_the_medial_axis(curve: SmoothCurve) -> None:
    center, radius = random_disks(curve, 1)
    axis = curve.medial_axis()
    low, high = np.min(axis.vertices[:, 0]), np.max(axis.vertices[:, 0])
    kept = axis.vertices[axis.vertices[:, 0] < low + (high - low) / 3]
    part = CurveMedialAxis(kept, np.zeros(len(kept)), np.empty((0, 2), dtype=np.int64), 0.0)
    free = axis_distance(part, center) > radius * (1 + TOLERANCE)
    assert np.any(free & ~meets_in_one_arc(curve, center, radius))


@pytest.mark.parametrize("n", [12, 60])
def test_lemma_2_voronoi_disks_contain_a_medial_axis_point(curve: SmoothCurve, n: int) -> None:
    # Of any samples at all, not only of r-samples. Larger disks need axis that is not traced.
    samples = Delaunay(curve.point(np.random.default_rng(n).random(n)))
    small = samples.circumradii < extent(curve) / 2
    center, radius = samples.circumcenters[small], samples.circumradii[small]
    assert len(center) >= n / 2
    assert np.all(axis_distance(curve.medial_axis(), center) <= radius * (1 + TOLERANCE))


def test_lemma_2_fails_for_points_off_the_curve(curve: SmoothCurve) -> None:
    rng = np.random.default_rng(2)
    points = curve.point(rng.random(200)) + rng.normal(0, 0.01, (200, 2))
    samples = Delaunay(points)
    distance = axis_distance(curve.medial_axis(), samples.circumcenters)
    assert np.any(distance > samples.circumradii * (1 + TOLERANCE))


def disks_around(curve: SmoothCurve, diameter: float, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return disks that hold a random point p of the curve, diameter times LFS(p) across."""
    rng = np.random.default_rng(seed)
    t = rng.random(400)
    radius = curve.local_feature_size(t) * diameter / 2
    angle, share = rng.uniform(0, 2 * math.pi, 400), np.sqrt(rng.random(400))
    offset = (share * radius)[:, None] * np.stack([np.cos(angle), np.sin(angle)], -1)
    return curve.point(t) + offset, radius


def test_corollary_3_disk_through_p_of_diameter_lfs(curve: SmoothCurve) -> None:
    assert np.all(meets_in_one_arc(curve, *disks_around(curve, 1.0, 3)))
    assert not np.all(meets_in_one_arc(curve, *disks_around(curve, 4.0, 3)))


def test_corollary_3_on_the_stadium_is_within_a_factor_of_two() -> None:
    # The disk between the two sides has the diameter 2 LFS.
    stadium = CURVES["stadium"]
    center, radius = np.zeros((1, 2)), stadium.local_feature_size([0.1])
    assert meets_in_one_arc(stadium, center, radius * 0.99)
    assert not meets_in_one_arc(stadium, center, radius * 1.01)


def test_corollary_4_disk_around_p_of_radius_lfs(curve: SmoothCurve) -> None:
    t = np.random.default_rng(4).random(400)
    p, lfs = curve.point(t), curve.local_feature_size(t)
    assert np.all(meets_in_one_arc(curve, p, lfs))
    assert not np.all(meets_in_one_arc(curve, p, 4 * lfs))


def test_lemma_7_tangent_disks_of_radius_lfs_are_empty(curve: SmoothCurve) -> None:
    t = np.random.default_rng(7).random(400)
    p, normal, lfs = curve.point(t), curve.normal(t), curve.local_feature_size(t)

    def is_empty(side: int, radius: FloatArray) -> BoolArray:
        return np.asarray(
            ~inside(curve, p + side * radius[:, None] * normal, radius).any(axis=(0, -1))
        )

    for side in (1, -1):
        assert np.all(is_empty(side, lfs * (1 - TOLERANCE)))
    # Where the nearest point of the axis is the center of a tangent disk, LFS is its radius.
    larger = lfs * 1.05
    assert not np.all(is_empty(1, larger) & is_empty(-1, larger))


# --- Samples and the arcs between them ----------------------------------------------------------


@dataclass(frozen=True)
class Arcs:
    """The arcs of a curve between samples adjacent along it, s₁ to s₂ in the direction of t."""

    curve: SmoothCurve
    points: FloatArray
    pairs: npt.NDArray[np.int64]
    loop: FloatArray
    start: FloatArray
    length: FloatArray

    @property
    def edges(self) -> Edges:
        return {(min(i, j), max(i, j)) for i, j in self.pairs.tolist()}

    def ends(self) -> tuple[FloatArray, FloatArray]:
        return self.points[self.pairs[:, 0]], self.points[self.pairs[:, 1]]

    def t(self, share: FloatArray) -> FloatArray:
        """Return t at these shares of each arc, (n, k)."""
        u = (self.start[:, None] + share * self.length[:, None]) % 1.0
        return (self.loop[:, None] + np.minimum(u, 1 - 1e-15)) / len(self.curve.loops)

    def bisector(self) -> FloatArray:
        """Return t of a point of each arc as far from s₁ as from s₂."""
        low, high = np.zeros((len(self.pairs), 1)), np.ones((len(self.pairs), 1))
        first, second = self.ends()
        for _ in range(60):
            middle = (low + high) / 2
            p = self.curve.point(self.t(middle))[:, 0]
            before = (lengths(p - first) < lengths(p - second))[:, None]
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        return self.t(low)[:, 0]


def arcs(curve: SmoothCurve, t: FloatArray) -> Arcs:
    """Return the arcs between samples at t, found by sorting t: not by what `Sample` says."""
    place = t * len(curve.loops)
    loop = np.floor(place)
    pairs = []
    for i in range(len(curve.loops)):
        rows = np.flatnonzero(loop == i)
        rows = rows[np.argsort(t[rows])]
        pairs.append(np.stack([rows, np.roll(rows, -1)], -1))
    pair = np.concatenate(pairs)
    first, second = (place - loop)[pair[:, 0]], (place - loop)[pair[:, 1]]
    return Arcs(curve, curve.point(t), pair, loop[pair[:, 0]], first, (second - first) % 1.0)


def lengths(vectors: FloatArray) -> FloatArray:
    return np.asarray(np.hypot(vectors[..., 0], vectors[..., 1]))


def to_nearest(p: FloatArray, samples: FloatArray) -> FloatArray:
    return np.asarray(lengths(p[:, None] - samples).min(axis=1))


def angles(a: FloatArray, apex: FloatArray, b: FloatArray) -> FloatArray:
    """Return the angles at the apices, 0 to π."""
    u, v = a - apex, b - apex
    cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    return np.asarray(np.abs(np.arctan2(cross, np.sum(u * v, axis=1))))


@cache
def sampled(curve: SmoothCurve, r: float, seed: int) -> FloatArray:
    """Return t of an r-sample: by turns the sparsest, a random one, and one with twins."""
    mode: Mode = "random" if seed % 3 == 1 else "sparsest"
    t = r_sample(curve, r, seed=seed, mode=mode).t
    return with_twins(curve, t) if seed % 3 == 2 else t


def with_twins(curve: SmoothCurve, t: FloatArray) -> FloatArray:
    """Return t with another sample just after every third one: more samples are an r-sample, too.

    Where a tiny edge follows a long one both are at their worst.
    """
    twin = t[::3] + 1e-5
    c = len(curve.loops)
    return np.concatenate([t, twin[np.floor(twin * c) == np.floor(t[::3] * c)]])


def sampled_arcs(curve: SmoothCurve, r: float, seed: int) -> Arcs:
    return arcs(curve, sampled(curve, r, seed))


def sparse_ring_between_dense_ones() -> Arcs:
    """Return samples of three rings: four on the middle one, which are far too few."""
    t = [(i + (np.arange(n) + 0.1) / n) / 3 for i, n in enumerate((60, 4, 60))]
    return arcs(RINGS, np.concatenate(t))


@pytest.mark.parametrize("r", [0.3, 1.0])
def test_corollary_5_curve_voronoi_disks_meet_the_curve_in_one_arc(
    curve: SmoothCurve, r: float
) -> None:
    for seed in SEEDS:
        between = sampled_arcs(curve, r, seed)
        p = curve.point(between.bisector())
        assert np.all(meets_in_one_arc(curve, p, to_nearest(p, between.points)))


def test_corollary_5_fails_for_samples_that_are_too_sparse() -> None:
    between = sparse_ring_between_dense_ones()
    p = between.curve.point(between.bisector())
    assert not np.all(meets_in_one_arc(between.curve, p, to_nearest(p, between.points)))


def test_observation_6_the_two_octagons_1_sample_two_curves() -> None:
    points = shapes.two_octagons()
    graphs = []
    for curve in (shapes.two_octagons_separate(), shapes.two_octagons_joined()):
        assert is_r_sample(curve, points, 1.0)
        between = arcs(curve, octagon_parameters(curve, points))
        np.testing.assert_allclose(between.points, points, atol=1e-12)
        graphs.append(between.edges)
    separate, joined = graphs
    assert len(separate) == len(joined) == 16
    # The square between the octagons: either pair of its opposite sides.
    assert separate - joined == {(0, 7), (8, 15)}
    assert joined - separate == {(0, 15), (7, 8)}
    # Each curve is 1-sampled, so Theorem 12 holds of either graph, and no method finds both.
    assert separate | joined <= as_set(Delaunay(points).edges)


def octagon_parameters(curve: SmoothCurve, points: FloatArray) -> FloatArray:
    """Return t of the points, which are ends of the curve's pieces."""
    t = along(curve, curve.loops[0].pieces).ravel()
    return np.asarray(t[np.argmin(lengths(points[:, None] - curve.point(t)), axis=1)])


def test_observation_6_cannot_happen_where_the_crust_is_guaranteed() -> None:
    # Of a curve sampled more densely than that, the crust is the one reconstruction.
    for curve in (shapes.two_octagons_separate(), shapes.two_octagons_joined()):
        assert sampling_ratio(curve, shapes.two_octagons()) > theory.guaranteed_r("crust")


@pytest.mark.parametrize("r", [0.1, 0.5, 0.99])
def test_lemma_9_angle_at_curve_voronoi_vertices(curve: SmoothCurve, r: float) -> None:
    for seed in SEEDS:
        between = sampled_arcs(curve, r, seed)
        first, second = between.ends()
        found = angles(first, curve.point(between.bisector()), second)
        assert np.all(found >= theory.vertex_angle(r) - 1e-9)


@pytest.mark.parametrize("r", [0.1, 0.5, 0.99])
def test_lemma_10_angle_spanned_by_three_adjacent_samples(curve: SmoothCurve, r: float) -> None:
    for seed in SEEDS:
        a, b, c = three_successive(sampled_arcs(curve, r, seed))
        assert np.all(angles(a, b, c) >= theory.sample_angle(r) - 1e-9)


@pytest.mark.parametrize("n", [8, 20])
def test_lemmas_9_and_10_are_attained_on_a_circle(n: int) -> None:
    circle = shapes.circle()
    between = arcs(circle, np.arange(n) / n)
    r = 2 * math.sin(math.pi / (2 * n))
    first, second = between.ends()
    at_vertices = angles(first, circle.point(between.bisector()), second)
    np.testing.assert_allclose(at_vertices, theory.vertex_angle(r))
    np.testing.assert_allclose(angles(*three_successive(between)), theory.sample_angle(r))


def three_successive(between: Arcs) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return each sample between the one before and the one after it along the curve."""
    before, after = between.pairs[np.argsort(between.pairs[:, 1])], between.pairs
    after = after[np.argsort(after[:, 0])]
    return between.points[before[:, 0]], between.points[after[:, 0]], between.points[after[:, 1]]


# --- Section 7: the Delaunay triangulation ------------------------------------------------------


@pytest.mark.parametrize("r", [0.3, 1.0])
def test_lemma_11_a_curve_voronoi_disk_touches_adjacent_samples(
    curve: SmoothCurve, r: float
) -> None:
    for seed in SEEDS:
        assert np.all(bisector_points_are_nearest_to_their_ends(sampled_arcs(curve, r, seed)))


def test_lemma_11_fails_for_samples_that_are_too_sparse() -> None:
    assert not np.all(bisector_points_are_nearest_to_their_ends(sparse_ring_between_dense_ones()))


def bisector_points_are_nearest_to_their_ends(between: Arcs) -> BoolArray:
    p = between.curve.point(between.bisector())
    first, second = (lengths(p - end) for end in between.ends())
    np.testing.assert_allclose(first, second, rtol=1e-9)
    return np.asarray(to_nearest(p, between.points) >= first * (1 - 1e-9))


def as_set(edges: npt.NDArray[np.int64]) -> Edges:
    return {(i, j) for i, j in edges.tolist()}


@pytest.mark.parametrize("r", [0.3, 0.999])
def test_theorem_12_delaunay_contains_the_reconstruction(curve: SmoothCurve, r: float) -> None:
    for seed in SEEDS:
        between = sampled_arcs(curve, r, seed)
        assert between.edges <= as_set(Delaunay(between.points).edges)


def test_theorem_12_fails_for_samples_that_are_too_sparse() -> None:
    between = sparse_ring_between_dense_ones()
    assert not between.edges <= as_set(Delaunay(between.points).edges)


def farthest_of_each_arc(between: Arcs) -> tuple[FloatArray, FloatArray]:
    """Return of each arc the largest distance to its segment, and LFS there."""
    t = between.t(np.linspace(0, 1, 201)[None])
    p, (first, second) = between.curve.point(t), between.ends()
    start, step = first[:, None], (second - first)[:, None]
    share = np.clip(np.sum((p - start) * step, axis=2) / np.sum(step * step, axis=2), 0, 1)
    distance = lengths(p - start - share[..., None] * step)
    row, column = np.arange(len(t)), np.argmax(distance, axis=1)
    return distance[row, column], between.curve.local_feature_size(t[row, column])


@pytest.mark.parametrize("r", [0.2, 0.5, 0.9])
def test_theorem_13_distance_at_the_farthest_point_of_each_arc(
    curve: SmoothCurve, r: float
) -> None:
    # docs/theory.md: the proof is about this point of the arc, not about all of them.
    for seed in SEEDS:
        distance, lfs = farthest_of_each_arc(sampled_arcs(curve, r, seed))
        assert np.all(distance <= theory.reconstruction_error(r) * lfs * (1 + TOLERANCE))


@pytest.mark.parametrize("n", [7, 40])
def test_theorem_13_is_attained_on_a_circle(n: int) -> None:
    distance, lfs = farthest_of_each_arc(arcs(shapes.circle(3), np.arange(n) / n))
    r = 2 * math.sin(math.pi / (2 * n))
    np.testing.assert_allclose(distance, theory.reconstruction_error(r) * lfs)


# --- Sections 8 and 9: the crust and the β-skeleton ---------------------------------------------


def fails_somewhere(r: float, holds: Callable[[Arcs], bool]) -> bool:
    """Return whether some r-sample of some curve breaks a statement."""
    return not all(holds(sampled_arcs(c, r, seed)) for c in CURVES.values() for seed in SEEDS)


def fails_on_every_other_sample(holds: Callable[[Arcs], bool]) -> bool:
    """Return whether half the samples of a 1-sample of some curve break a statement."""
    halves = (arcs(c, sampled(c, 1.0, seed)[::2]) for c in CURVES.values() for seed in SEEDS)
    return not all(holds(half) for half in halves)


def crust_contains(between: Arcs) -> bool:
    return between.edges <= as_set(crust(between.points))


def crust_excludes(between: Arcs) -> bool:
    return as_set(crust(between.points)) <= between.edges


def test_theorem_14_crust_contains_adjacent_pairs(curve: SmoothCurve) -> None:
    r = 0.392
    assert r < theory.containing_r("crust")
    for seed in SEEDS:
        assert crust_contains(sampled_arcs(curve, r, seed))


def test_theorem_14_fails_for_samples_that_are_too_sparse() -> None:
    assert fails_on_every_other_sample(crust_contains)


def test_theorem_15_crust_has_no_other_edges(curve: SmoothCurve) -> None:
    for seed in SEEDS:
        assert crust_excludes(sampled_arcs(curve, 0.252, seed))


def test_theorem_15_fails_for_samples_that_are_too_sparse() -> None:
    assert fails_on_every_other_sample(crust_excludes)


def test_theorem_15_fails_at_r_1_on_the_two_octagons() -> None:
    points = shapes.two_octagons()
    for curve in (shapes.two_octagons_separate(), shapes.two_octagons_joined()):
        between = arcs(curve, octagon_parameters(curve, points))
        assert crust_contains(between)
        assert not crust_excludes(between)


def forbidden_disks(
    first: FloatArray, second: FloatArray, phi: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the centers of both forbidden disks of each pair, and their radii."""
    half, middle = (second - first) / 2, (first + second) / 2
    across = np.stack([-half[:, 1], half[:, 0]], -1) / math.tan(phi)
    return middle + across, middle - across, lengths(half) / math.sin(phi)


def next_is_forbidden(between: Arcs, phi: float) -> BoolArray:
    """Return whether s₃ lies in the forbidden region of (s₁, s₂), in either direction."""
    a, b, c = three_successive(between)
    found = []
    for start, end in ((a, c), (c, a)):
        *centers, radius = forbidden_disks(start, b, phi)
        found.append(np.min([lengths(end - center) for center in centers], axis=0) < radius)
    return np.concatenate(found)


@pytest.mark.parametrize("r", [0.1, 0.297, 0.5])
def test_lemma_17_third_sample_is_not_in_the_forbidden_region(curve: SmoothCurve, r: float) -> None:
    phi = theory.phi_above_neighbors(r) + 1e-9
    for seed in SEEDS:
        assert not np.any(next_is_forbidden(sampled_arcs(curve, r, seed), phi))


def test_lemma_17_fails_for_half_its_phi() -> None:
    # A long step, then a tiny one along the tangent: half the angle of two long ones.
    r = 0.3
    step = 4 * math.asin(r / 2) / (2 * math.pi)
    t = np.concatenate([[0, step, step + 1e-4], np.arange(0.15, 0.99, 0.05)])
    between, phi = arcs(shapes.circle(), t), theory.phi_above_neighbors(r)
    assert sampling_ratio(between.curve, between.points) == pytest.approx(r, rel=1e-3)
    assert np.any(next_is_forbidden(between, 0.49 * phi))
    assert not np.any(next_is_forbidden(between, 0.51 * phi))


def forbidden_regions_hold_axis(between: Arcs, phi: float) -> BoolArray:
    axis = between.curve.medial_axis()
    *centers, radius = forbidden_disks(*between.ends(), phi)
    nearest = np.min([axis_distance(axis, center) for center in centers], axis=0)
    return np.asarray(nearest < radius * (1 - TOLERANCE))


@pytest.mark.parametrize("r", [0.2, 0.297, 0.5])
def test_lemma_18_forbidden_regions_hold_no_medial_axis_point(curve: SmoothCurve, r: float) -> None:
    # docs/theory.md: curve (2), which is lower, is enough.
    for bound in (theory.phi_above_medial_axis, theory.phi_above_neighbors):
        between = sampled_arcs(curve, r, 0)
        assert not np.any(forbidden_regions_hold_axis(between, bound(r) + 1e-9))


@pytest.mark.parametrize("n", [8, 20])
def test_lemma_18_fails_below_curve_2_on_a_circle(n: int) -> None:
    between = arcs(shapes.circle(), np.arange(n) / n)
    phi = theory.phi_above_neighbors(2 * math.sin(math.pi / (2 * n)))
    assert not np.any(forbidden_regions_hold_axis(between, phi * 1.01))
    assert np.all(forbidden_regions_hold_axis(between, phi * 0.99))


@pytest.mark.parametrize("r", [0.1, 0.252, 0.297, 0.4])
def test_lemma_19_beta_skeleton_has_no_other_edges(curve: SmoothCurve, r: float) -> None:
    beta = theory.beta(theory.phi_below_nonadjacent(r) - 1e-9)
    for seed in SEEDS:
        between = sampled_arcs(curve, r, seed)
        assert as_set(beta_skeleton(between.points, beta)) <= between.edges


def test_lemma_19_fails_for_a_beta_of_1() -> None:
    # φ = π/2 is above the lemma's bound for every r > 0.
    assert fails_somewhere(
        0.4, lambda between: as_set(beta_skeleton(between.points, 1.0)) <= between.edges
    )


def beta_skeleton_is_the_reconstruction(between: Arcs) -> bool:
    return as_set(beta_skeleton(between.points, beta=1.70)) == between.edges


def test_theorem_20_beta_skeleton_is_the_reconstruction(curve: SmoothCurve) -> None:
    for seed in SEEDS:
        assert beta_skeleton_is_the_reconstruction(sampled_arcs(curve, 0.297, seed))


def test_theorem_20_fails_at_r_1() -> None:
    assert fails_somewhere(1.0, beta_skeleton_is_the_reconstruction)


def test_theorem_20_fails_for_a_larger_beta_on_a_circle_with_twins() -> None:
    circle = shapes.circle()
    between = sampled_arcs(circle, 0.297, 2)
    assert is_r_sample(circle, between.points, 0.297)
    assert beta_skeleton_is_the_reconstruction(between)
    # A twin is on the edge of the forbidden region for φ = 2 arcsin(r/2).
    assert not between.edges <= as_set(
        beta_skeleton(between.points, 1.03 * theory.beta(2 * math.asin(0.297 / 2)))
    )


# --- All of them --------------------------------------------------------------------------------

KINDS = {
    "lemma": (1, 2, 7, 9, 10, 11, 17, 18, 19),
    "corollary": (3, 4, 5),
    "observation": (6, 8, 16),
    "theorem": (12, 13, 14, 15, 20),
}
STATEMENTS = sorted((number, kind) for kind, numbers in KINDS.items() for number in numbers)


def test_the_paper_has_twenty_statements() -> None:
    assert [number for number, _ in STATEMENTS] == list(range(1, 21))


@pytest.mark.parametrize(("number", "kind"), STATEMENTS)
def test_each_statement_has_a_test_with_its_name(number: int, kind: str) -> None:
    here = Path(__file__)
    text = here.read_text("utf-8") + here.with_name("test_theory.py").read_text("utf-8")
    assert re.search(rf"^def test_{kind}_{number}_", text, re.MULTILINE)
