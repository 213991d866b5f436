"""The formulas of the paper against the figures they were read from, drawn with coordinates.

A statement's test builds its extremal configuration, measures it, and compares; then it tries
other configurations allowed by the premises, none of which may be worse.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from crustline import theory
from crustline.errors import InputError

RATIOS = np.linspace(0.01, 0.99, 50)
SMALL_RATIOS = np.linspace(0.01, 0.49, 49)
Vector = NDArray[np.float64]


# --- Figure 7: p at the origin, the curve's tangent along x, both unit tangent disks empty ------


def at(distance: float, angle: float) -> Vector:
    """Return the point in a direction given as an angle from the x axis."""
    return np.array([distance * math.cos(angle), distance * math.sin(angle)])


def on_tangent_circle(distance: float) -> Vector:
    """Return the point of the unit circle around (0, -1) at a distance from p, to the right."""
    y = -distance * distance / 2
    return np.array([math.sqrt(distance * distance - y * y), y])


def figure_7(r: float) -> tuple[Vector, Vector, Vector]:
    """Return s1, p, s2: both samples on one tangent circle, at distance r from p."""
    s2 = on_tangent_circle(r)
    return s2 * [-1, 1], np.zeros(2), s2


def allowed_samples(r: float, rng: np.random.Generator) -> tuple[Vector, Vector]:
    """Return two samples at one distance ≤ r from p, either side, outside both tangent disks."""
    distance = r * rng.uniform(0.01, 1)
    steepest = math.asin(distance / 2)
    left, right = rng.uniform(-steepest, steepest, 2)
    return at(distance, right), at(distance, math.pi - left)


def angle(a: Vector, apex: Vector, b: Vector) -> float:
    """Return the angle at the apex, 0 to π."""
    u, v = a - apex, b - apex
    return abs(math.atan2(u[0] * v[1] - u[1] * v[0], float(u @ v)))


def distance(a: Vector, b: Vector) -> float:
    return math.dist(a, b)


# --- An ellipse, of which medial axis and local feature size are known --------------------------


def ellipse(t: Vector, a: float) -> Vector:
    return np.column_stack([a * np.cos(t), np.sin(t)])


def ellipse_feature_size(points: Vector, a: float) -> Vector:
    """Return the distance to the medial axis: the segment between the centers of curvature."""
    end = (a * a - 1) / a
    x = np.clip(points[:, 0], -end, end)
    return np.hypot(points[:, 0] - x, points[:, 1])


def sampled_ellipse(a: float, n: int, seed: int) -> tuple[Vector, float]:
    """Return samples in order along an ellipse, and the r for which they are an r-sample."""
    rng = np.random.default_rng(seed)
    t = (np.arange(n) + rng.uniform(-0.3, 0.3, n)) * (2 * math.pi / n)
    samples = ellipse(t, a)
    curve = ellipse(np.linspace(0, 2 * math.pi, 20_000), a)
    nearest = np.min(np.linalg.norm(curve[:, None] - samples[None], axis=2), axis=1)
    return samples, float(np.max(nearest / ellipse_feature_size(curve, a)))


# --- Section 6 ----------------------------------------------------------------------------------


@pytest.mark.parametrize("r", [0.05, 0.252, 0.4, 0.9, 1.0])
def test_observation_8_lengths_and_angles_of_figure_7(r: float) -> None:
    _, p, s = figure_7(r)
    center = np.array([0.0, -1.0])
    gamma = angle(s, center, p)
    assert distance(s, p) == pytest.approx(r)
    assert s[0] == pytest.approx(math.sin(gamma))
    assert theory.central_angle(r) == pytest.approx(gamma)
    assert theory.tangent_angle(r) == pytest.approx(gamma / 2)
    assert theory.tangent_angle(r) == pytest.approx(-math.atan2(s[1], s[0]))


@pytest.mark.parametrize("r", [0.05, 0.252, 0.4, 0.9])
def test_lemma_9_angle_at_a_curve_voronoi_vertex(r: float) -> None:
    assert angle(*figure_7(r)) == pytest.approx(theory.vertex_angle(r))
    rng = np.random.default_rng(9)
    for _ in range(500):
        s1, s2 = allowed_samples(r, rng)
        assert angle(s1, np.zeros(2), s2) >= theory.vertex_angle(r) - 1e-12


@pytest.mark.parametrize("r", [0.05, 0.252, 0.4, 0.9])
def test_lemma_10_angle_spanned_by_three_adjacent_samples(r: float) -> None:
    # On a unit circle each curve Voronoi vertex is one chord r from its two samples.
    step = 2 * (2 * math.asin(r / 2))
    s1, s2, s3 = (at(1, k * step) for k in (-1, 0, 1))
    assert angle(s1, s2, s3) == pytest.approx(theory.sample_angle(r))


@pytest.mark.parametrize("a", [1.1, 2.0, 4.0])
def test_lemma_10_holds_where_the_feature_size_varies(a: float) -> None:
    for seed in range(4):
        samples, r = sampled_ellipse(a, 90, seed)
        assert r < 1
        triples = zip(np.roll(samples, 1, 0), samples, np.roll(samples, -1, 0), strict=True)
        assert min(angle(*three) for three in triples) >= theory.sample_angle(r)


def test_lemma_10_step_left_to_the_reader() -> None:
    # The medial disk at s has radius ρ and center c; p is outside it and |pc| ≥ LFS(p) = 1. So the
    # angle θ between tangent and segment (s, p), |sp| = d, is at most arcsin(d/2) for every ρ.
    d, radius = np.meshgrid(RATIOS, np.geomspace(0.05, 100, 400))
    outside_disk = d / (2 * radius)
    center_on_medial_axis = (radius**2 + d**2 - 1) / (2 * radius * d)
    assert np.all(np.minimum(outside_disk, center_on_medial_axis) <= d / 2 + 1e-12)


# --- Section 7 ----------------------------------------------------------------------------------


@pytest.mark.parametrize("r", [0.05, 0.252, 0.4, 0.9])
def test_theorem_13_distance_to_the_reconstruction(r: float) -> None:
    s1, p, s2 = figure_7(r)
    assert p[1] - s1[1] == pytest.approx(theory.reconstruction_error(r))
    assert s1[1] == s2[1]
    rng = np.random.default_rng(13)
    for _ in range(500):
        # The nearer sample alone decides: the segment is parallel to the tangent at p.
        nearer = allowed_samples(r, rng)[0]
        assert abs(nearer[1]) <= theory.reconstruction_error(r) + 1e-12


@pytest.mark.parametrize("a", [1.1, 2.0, 4.0])
def test_theorem_13_on_ellipses(a: float) -> None:
    n = 60
    samples, r = sampled_ellipse(a, n, 13)
    curve = ellipse(np.linspace(0, 2 * math.pi, 20_000), a)
    start, step = samples, np.roll(samples, -1, 0) - samples
    along = np.sum((curve[:, None] - start) * step, axis=2) / np.sum(step * step, axis=1)
    foot = start + np.clip(along, 0, 1)[..., None] * step
    to_polygon = np.min(np.linalg.norm(curve[:, None] - foot, axis=2), axis=1)
    error = to_polygon / ellipse_feature_size(curve, a)
    assert error.max() <= theory.reconstruction_error(r)


def test_note_after_theorem_13_spacing_for_a_given_error() -> None:
    sizes = np.geomspace(0.1, 100, 20)
    error = 0.02
    spacing = theory.spacing_for_error(error, sizes)
    np.testing.assert_allclose(theory.reconstruction_error(spacing / sizes) * sizes, error)
    assert theory.spacing_for_error(1e9, sizes).tolist() == sizes.tolist()
    assert theory.spacing_for_error(1e308, [0, 1e308]).tolist() == [0, 1e308]
    np.testing.assert_allclose(theory.spacing_for_error(5e199, [1e300]), 1e250)
    with pytest.raises(InputError, match="distance must be positive and finite, not 0"):
        theory.spacing_for_error(0, sizes)
    with pytest.raises(InputError, match=r"feature_size must be 0 or more, got -1\.0"):
        theory.spacing_for_error(1, [1.0, -1.0])


# --- Section 8 ----------------------------------------------------------------------------------


@pytest.mark.parametrize("r", [0.1, 0.252, 0.39, 0.6, 0.9])
def test_theorem_14_reach_of_a_voronoi_disk_in_figure_8(r: float) -> None:
    s1, p, s2 = figure_7(r)
    v = at(r, math.pi / 2)
    assert r + distance(v, s1) == pytest.approx(theory.crust_containment(r))
    rng = np.random.default_rng(14)
    for _ in range(500):
        v = at(r * math.sqrt(rng.uniform()), rng.uniform(0, 2 * math.pi))
        reach = distance(p, v) + min(distance(v, s1), distance(v, s2))
        assert reach <= theory.crust_containment(r) + 1e-12


def test_theorem_14_threshold_is_below_the_stated_one() -> None:
    r = theory.containing_r("crust")
    assert r == pytest.approx(0.39265, abs=5e-6)
    assert theory.crust_containment(r) <= 1 < theory.crust_containment(r + 1e-9)
    assert theory.crust_containment(0.40) == pytest.approx(1.0197, abs=5e-5)


@pytest.mark.parametrize("r", [0.05, 0.2, 0.252, 0.3])
def test_theorem_15_chord_of_figure_10(r: float) -> None:
    # s at the origin, t to the left. The tangents of V and V' at s enclose the right angle around
    # the x axis; s1 and s2 lie symmetrically, as sharp as Lemma 10 permits.
    center = at(1, 3 * math.pi / 4)
    assert angle(center, np.zeros(2), center * [1, -1]) == pytest.approx(math.pi / 2)
    direction = at(1, theory.sample_angle(r) / 2)
    chord = 2 * float(direction @ center)
    assert distance(chord * direction, center) == pytest.approx(1)
    assert chord / 2 - 2 * r == pytest.approx(theory.crust_exclusion(r))


@pytest.mark.parametrize("r", [0.05, 0.2, 0.252])
def test_theorem_15_curve_voronoi_vertex_lies_in_the_disk(r: float) -> None:
    # If p were outside V, LFS(p) ≤ 1 + |pv|, while |sp| is at least the chord in its direction,
    # which differs from that of s2 by at most arcsin(r/2). Then r LFS(p) < |sp|: impossible.
    least = math.pi / 4 - 3 * math.asin(r / 2)
    for psi in np.linspace(least, math.pi / 2, 50):
        for to_p in np.linspace(2 * math.sin(psi), 10, 50):
            to_center = math.sqrt(1 + to_p**2 - 2 * to_p * math.sin(psi))
            assert r * (1 + to_center) < to_p


def test_theorem_15_threshold() -> None:
    r = theory.excluding_r("crust")
    assert r == pytest.approx(0.25335, abs=5e-6)
    assert theory.crust_exclusion(r) > 0 > theory.crust_exclusion(r + 1e-9)
    assert theory.crust_exclusion(0.252) > 0
    assert theory.guaranteed_r("crust") == r


# --- Section 9 ----------------------------------------------------------------------------------


def forbidden_centers(s1: Vector, s2: Vector, phi: float) -> tuple[Vector, Vector, float]:
    """Return the two centers of the forbidden disks of an edge, and their radius."""
    half = (s2 - s1) / 2
    across = np.array([-half[1], half[0]]) / math.tan(phi)
    middle = (s1 + s2) / 2
    return middle + across, middle - across, math.hypot(*half) / math.sin(phi)


def reach_of_forbidden_region(s1: Vector, s2: Vector, phi: float, p: Vector) -> float:
    """Return the distance from p to the farthest point of the forbidden region."""
    first, second, radius = forbidden_centers(s1, s2, phi)
    return radius + max(distance(p, first), distance(p, second))


@pytest.mark.parametrize("beta", [1.0, 1.2, 1.5, 1.7, 2.0, 10.0])
def test_observation_16_phi_and_beta(beta: float) -> None:
    s1, s2 = np.array([0.0, 0.0]), np.array([2.0, 0.0])
    radius = beta * distance(s1, s2) / 2
    height = math.sqrt(max(radius**2 - 1, 0))
    tangents = np.array([height, -1.0]), np.array([height, 1.0])
    for tangent, center in zip(tangents, ([1, height], [1, -height]), strict=True):
        assert float(tangent @ np.array(center)) == pytest.approx(0, abs=1e-12)
    assert angle(tangents[0], s1, tangents[1]) == pytest.approx(2 * theory.phi(beta))
    assert theory.beta(theory.phi(beta)) == pytest.approx(beta)


@pytest.mark.parametrize("r", [0.05, 0.2, 0.297, 0.5])
def test_lemma_17_next_sample_at_the_tangent_of_the_forbidden_disk(r: float) -> None:
    s1, s2 = np.array([-1.0, 0.0]), np.zeros(2)
    s3 = at(1e-4, math.pi - theory.sample_angle(r))
    clear, inside = theory.phi_above_neighbors(r) + 1e-3, theory.phi_above_neighbors(r) - 1e-3
    for phi, expected in ((clear, False), (inside, True)):
        first, second, radius = forbidden_centers(s1, s2, phi)
        assert (min(distance(s3, first), distance(s3, second)) < radius) == expected


@pytest.mark.parametrize("r", [0.05, 0.2, 0.297, 0.5])
def test_lemma_18_radius_of_the_forbidden_disks_in_figure_12(r: float) -> None:
    s1, _, s2 = figure_7(r)
    *_, radius = forbidden_centers(s1, s2, theory.phi_above_medial_axis(r))
    assert radius == pytest.approx(0.5)


@pytest.mark.parametrize("r", [0.05, 0.2, 0.297, 0.5])
def test_lemma_18_forbidden_region_stays_within_one_feature_size(r: float) -> None:
    # The paper bounds |s1 s2| by its length in Figure 7, the shortest possible one: a straight
    # piece of curve has 2r. The conclusion holds all the same, even from curve (2) on, where the
    # forbidden region of Figure 7 just reaches the center of the tangent circle.
    s1, p, s2 = figure_7(r)
    assert distance(s1, s2) < 2 * r
    enough = theory.phi_above_neighbors(r)
    assert enough < theory.phi_above_medial_axis(r)
    assert reach_of_forbidden_region(s1, s2, enough, p) == pytest.approx(1)
    rng = np.random.default_rng(18)
    for _ in range(500):
        s1, s2 = allowed_samples(r, rng)
        for phi in (enough, theory.phi_above_medial_axis(r)):
            assert reach_of_forbidden_region(s1, s2, phi, p) <= 1 + 1e-12


@pytest.mark.parametrize("r", [0.05, 0.2, 0.297, 0.4])
def test_lemma_19_chord_of_figure_13(r: float) -> None:
    # s at the origin, t to the left, B and B' of radius one crossing at s at the angle 2φ.
    phi = theory.phi_below_nonadjacent(r)
    center = at(1, math.pi / 2 + phi)
    assert angle(center, np.zeros(2), center * [1, -1]) == pytest.approx(math.pi - 2 * phi)
    direction = at(1, theory.sample_angle(r) / 2)
    chord = 2 * float(direction @ center)
    assert distance(chord * direction, center) == pytest.approx(1)
    # Half the chord is the least r LFS(p), and LFS(p) ≤ 2: the bound is where they meet.
    assert chord / 2 == pytest.approx(2 * r)


def test_lemma_19_curve_voronoi_vertex_lies_in_the_disk() -> None:
    # As in Theorem 15: the direction of p is off by arcsin(r/2) at most, and still too long.
    least = np.arcsin(2 * SMALL_RATIOS) - np.arcsin(SMALL_RATIOS / 2)
    assert np.all(np.sin(least) > SMALL_RATIOS)


def test_theorem_20_at_beta_1_70() -> None:
    phi = theory.phi(1.70)
    assert theory.phi_above_neighbors(0.297) < phi
    assert theory.phi_above_medial_axis(0.297) < phi
    assert phi < theory.phi_below_nonadjacent(0.297)
    r = theory.guaranteed_r("beta_skeleton", beta=1.70)
    assert r == pytest.approx(0.29742, abs=5e-6)
    assert theory.phi_above_medial_axis(r) < phi < theory.phi_above_medial_axis(r + 1e-9)


def test_theorem_20_best_beta() -> None:
    beta, r = theory.best_beta()
    assert beta == pytest.approx(1.6940, abs=5e-5)
    assert r == pytest.approx(0.29850, abs=5e-6)
    assert theory.phi(beta) == pytest.approx(0.63144, abs=5e-6)
    assert theory.guaranteed_r("beta_skeleton", beta) == pytest.approx(r, abs=1e-12)
    for other in np.linspace(1, 4, 301):
        assert theory.guaranteed_r("beta_skeleton", other) <= r


def test_theorem_20_stated_phi_is_not_that_of_beta_1_70() -> None:
    assert theory.beta(0.637) == pytest.approx(1.681, abs=5e-4)
    assert theory.phi(1.70) == pytest.approx(0.62887, abs=5e-6)


def test_theorem_20_without_lemma_18_as_it_stands() -> None:
    # docs/theory.md: curve (2) implies the conclusion of Lemma 18, so (1) and (2) alone decide.
    r = 0.30430
    assert theory.phi_above_neighbors(r) < theory.phi(1.7431) < theory.phi_below_nonadjacent(r)
    assert theory.phi_above_neighbors(0.30431) > theory.phi_below_nonadjacent(0.30431)


# --- What is found without a claim that nothing else is -----------------------------------------


def test_section_11_summary() -> None:
    assert theory.containing_r("delaunay") == 1
    assert theory.containing_r("crust") > theory.guaranteed_r("crust") > 0.252
    assert theory.guaranteed_r("beta_skeleton") > 0.297 > 0.279
    assert theory.containing_r("one_step_crust") == theory.containing_r("crust")


def test_a_smaller_beta_contains_from_sparser_samples_and_excludes_from_denser_ones() -> None:
    betas = np.linspace(1, 3, 41)
    containing = [theory.containing_r("beta_skeleton", b) for b in betas]
    excluding = [theory.excluding_r("beta_skeleton", b) for b in betas]
    assert np.all(np.diff(containing) < 0)
    assert np.all(np.diff(excluding) > 0)
    assert (
        containing[0] == theory.containing_r("gabriel") == pytest.approx(2 * math.sin(math.pi / 12))
    )
    assert excluding[0] == 0 == theory.guaranteed_r("beta_skeleton", 1.0)


# --- All formulas -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bound", "sign"),
    [
        (theory.central_angle, 1),
        (theory.tangent_angle, 1),
        (theory.vertex_angle, -1),
        (theory.sample_angle, -1),
        (theory.reconstruction_error, 1),
        (theory.crust_containment, 1),
        (theory.crust_exclusion, -1),
        (theory.phi_above_neighbors, 1),
        (theory.phi_above_medial_axis, 1),
        (theory.phi_below_nonadjacent, -1),
    ],
)
def test_bounds_are_monotone_and_take_floats_and_arrays(bound: theory.Bound, sign: int) -> None:
    values = bound(SMALL_RATIOS)
    assert np.all(sign * np.diff(values) > 0)
    assert [bound(float(r)) for r in SMALL_RATIOS] == values.tolist()
    assert type(bound(0.25)) is float
    with pytest.raises(InputError, match=r"is defined for r in \[0, .*got 1\.5"):
        bound([0.2, 1.5])
    with pytest.raises(InputError, match="got nan"):
        bound(math.nan)


def test_methods_are_known_by_name_or_as_functions() -> None:
    def beta_skeleton() -> None: ...

    assert theory.guaranteed_r(beta_skeleton) == theory.guaranteed_r("beta-skeleton")
    with pytest.raises(InputError, match="nothing of this kind for 'alpha_shape'"):
        theory.guaranteed_r("alpha_shape")
    with pytest.raises(InputError, match=r"phi is defined for beta in \[1, inf\], got 0\.5"):
        theory.guaranteed_r("beta_skeleton", 0.5)
