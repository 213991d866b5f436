"""The medial axis of samples against its definition, and the estimate of the local feature size."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import generators
from crustline import Delaunay, InputError, crust
from crustline.interpolant import local_feature_size
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.shapes import SmoothCurve, blob, circle, ellipse, stadium
from crustline.shapes.sampling import r_sample

SEEDS = range(40)


def ring(n: int, first: int = 0) -> NDArray[np.int64]:
    rows = np.arange(n)
    return np.sort(first + np.stack([rows, (rows + 1) % n], axis=1), axis=1)


def inside_rings(
    places: NDArray[np.float64], loops: list[NDArray[np.float64]]
) -> NDArray[np.bool_]:
    """Even-odd containment by a ray to the right: the geometry that `inner` is not told."""
    count = np.zeros(len(places), int)
    for a in loops:
        b = np.roll(a, -1, axis=0)
        y = places[:, 1, None]
        spans = (a[:, 1] <= y) != (b[:, 1] <= y)
        with np.errstate(divide="ignore", invalid="ignore"):
            x = a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
        count += (spans & (x > places[:, 0, None])).sum(axis=1)
    return count % 2 == 1


@pytest.mark.parametrize("seed", SEEDS)
def test_its_duals_are_the_delaunay_edges_that_are_not_selected(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = generators.general_position(rng) if seed % 2 else generators.noisy_curve(rng)
    delaunay = Delaunay(points)
    edges = crust(delaunay)
    axis = medial_axis(delaunay, edges)
    duals = np.concatenate([axis.samples, axis.ray_samples])
    everything = np.concatenate([duals, edges])
    assert sorted(map(tuple, everything.tolist())) == sorted(map(tuple, delaunay.edges.tolist()))
    assert (np.diff(axis.samples @ [len(points), 1]) > 0).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_each_vertex_is_nearest_to_the_samples_of_its_edges_at_its_radius(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = generators.degenerate(rng) if seed % 2 else generators.noisy_curve(rng)
    axis = medial_axis(points)
    distance = np.linalg.norm(axis.vertices[:, None] - points[None], axis=2)
    np.testing.assert_allclose(
        distance.min(axis=1, initial=np.inf), axis.radii, rtol=1e-6, atol=1e-9
    )
    for k in range(2):
        ends, samples = axis.edges[:, k], axis.samples
        for side in range(2):
            np.testing.assert_allclose(
                distance[ends, samples[:, side]], axis.radii[ends], rtol=1e-6, atol=1e-9
            )


@pytest.mark.parametrize("seed", SEEDS)
def test_edges_run_from_the_left_of_their_samples_to_the_right(seed: int) -> None:
    points = generators.noisy_curve(np.random.default_rng(seed))
    axis = medial_axis(points)
    step = points[axis.samples[:, 1]] - points[axis.samples[:, 0]]
    along = axis.vertices[axis.edges[:, 1]] - axis.vertices[axis.edges[:, 0]]
    turn = step[:, 0] * along[:, 1] - step[:, 1] * along[:, 0]
    assert (turn < 0).all()
    assert len(np.unique(axis.edges)) <= len(axis.vertices)


@pytest.mark.parametrize("seed", range(12))
def test_inner_edges_are_inside_an_odd_number_of_rings(seed: int) -> None:
    shape = blob(seed, roughness=0.3)
    curve = shape + shape.moved(scale=0.3) + circle(0.4).moved(offset=(3, 0))
    sample = r_sample(curve, 0.2, seed=seed)
    axis = medial_axis(sample.points, sample.edges)
    middle = axis.vertices[axis.edges].mean(axis=1)
    loops = [component.point(np.arange(2000) / 2000) for component in curve.components]
    expected = inside_rings(middle, loops)
    assert (axis.inner == expected).all()
    assert axis.inner.any()
    assert not axis.inner.all()


def test_open_curves_do_not_separate() -> None:
    sample = r_sample(ellipse(2, 1), 0.2, seed=1)
    assert medial_axis(sample.points, sample.edges).inner.any()
    assert not medial_axis(sample.points, sample.edges[1:]).inner.any()


def test_points_on_one_circle_share_one_vertex() -> None:
    points = generators.integer_circle(65)
    axis = medial_axis(points, [])
    assert axis.vertices.tolist() == [[0.0, 0.0]]
    assert axis.radii.tolist() == [65**0.5]
    assert len(axis.edges) == 0
    assert len(axis.ray_origins) == len(points)
    lattice = np.stack(np.meshgrid(np.arange(4.0), np.arange(3.0)), axis=-1).reshape(-1, 2)
    axis = medial_axis(lattice, [])
    assert len(axis.vertices) == 6
    assert (np.ptp(axis.vertices[axis.edges], axis=1).sum(axis=1) == 1).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_rays_are_on_the_bisectors_of_the_hull(seed: int) -> None:
    points = generators.noisy_curve(np.random.default_rng(seed))
    axis = medial_axis(points, [])
    assert len(axis.ray_origins) == len(Delaunay(points).hull)
    far = axis.vertices[axis.ray_origins] + 1e3 * axis.ray_directions
    distance = np.linalg.norm(far[:, None] - points[None], axis=2)
    rows = np.arange(len(far))
    for side in range(2):
        mine = distance[rows, axis.ray_samples[:, side]]
        np.testing.assert_allclose(mine, distance.min(axis=1), rtol=1e-9)
    np.testing.assert_allclose(np.hypot(*axis.ray_directions.T), 1.0)


def test_points_on_a_line_are_separated_by_lines() -> None:
    axis = medial_axis([(0, 0), (2, 0), (4, 0), (4, 0)], [(0, 1)])
    assert axis.vertices.tolist() == [[3.0, 0.0]]
    assert axis.ray_origins.tolist() == [0, 0]
    assert axis.ray_samples.tolist() == [[1, 2], [1, 2]]
    assert sorted(axis.ray_directions.tolist()) == [[0.0, -1.0], [0.0, 1.0]]
    assert axis.clipped((0, -1, 9, 2)).tolist() == [[[3, 0], [3, -1]], [[3, 0], [3, 2]]]


def test_clipping_keeps_exactly_what_is_in_the_box() -> None:
    segments = [
        [[0.5, 0.5], [1.5, 0.5]],
        [[-1.0, 0.5], [3.0, 0.5]],
        [[1.0, -5.0], [1.0, 0.25]],
        [[-1.0, 0.0], [0.0, 2.0]],
        [[5.0, 0.5], [6.0, 0.5]],
    ]
    axis = replace(
        medial_axis([]),
        vertices=np.array(segments).reshape(-1, 2),
        edges=np.arange(10).reshape(-1, 2),
        inner=np.arange(5) < 2,
    )
    expected = [
        [[0.5, 0.5], [1.5, 0.5]],
        [[0.0, 0.5], [2.0, 0.5]],
        [[1.0, 0.0], [1.0, 0.25]],
    ]
    assert axis.clipped((0, 0, 2, 1)).tolist() == expected
    assert axis.clipped((0, 0, 2, 1), inner=True).tolist() == expected[:2]
    assert axis.clipped((0, 0, 2, 1), inner=False).tolist() == expected[2:]


@pytest.mark.parametrize("points", [[], [(1, 2)], [(1, 2), (1, 2)]])
def test_too_few_points_have_no_axis(points: list[tuple[int, int]]) -> None:
    axis = medial_axis(points)
    assert len(axis.vertices) == len(axis.edges) == len(axis.ray_origins) == 0
    assert axis.clipped((0, 0, 1, 1)).shape == (0, 2, 2)
    assert len(axis.prune(1.0).edges) == 0


def test_a_repeated_row_changes_nothing_but_numbers() -> None:
    sample = r_sample(ellipse(2, 1), 0.3, seed=1)
    once = medial_axis(sample.points, sample.edges)
    points = np.concatenate([sample.points, sample.points[:5]])
    n = len(sample.points)
    moved = np.where(sample.edges < 3, sample.edges + n, sample.edges)
    twice = medial_axis(points, moved)
    assert (once.samples == twice.samples).all()
    assert (once.vertices == twice.vertices).all()
    sizes = local_feature_size(points, moved)
    assert (sizes[n:] == sizes[:5]).all()


@pytest.mark.parametrize("seed", range(8))
def test_clipping_keeps_what_is_in_the_box_and_cuts_at_its_sides(seed: int) -> None:
    axis = medial_axis(generators.noisy_curve(np.random.default_rng(seed)), [])
    box = np.array([-0.7, -0.5, 0.8, 0.6])
    segments = axis.clipped(box)
    assert ((box[:2] <= segments) & (segments <= box[2:])).all()
    inside = ((box[:2] < axis.vertices) & (axis.vertices < box[2:])).all(axis=1)
    kept = np.unique(segments.reshape(-1, 2), axis=0)
    assert {tuple(v) for v in axis.vertices[inside].tolist()} <= {tuple(v) for v in kept.tolist()}
    for p, q in segments:
        assert on_axis((p + q) / 2, axis)


def on_axis(place: NDArray[np.float64], axis: MedialAxis) -> bool:
    """Two points are nearest, at the same distance."""
    first, second = np.sort(np.linalg.norm(axis.points - place, axis=1))[:2]
    return bool(second - first < 1e-6 * (1 + second))


@pytest.mark.parametrize("box", [(1, 0, 0, 1), (0, 0, 1), (0, 0, np.nan, 1)])
def test_a_box_that_is_none_is_refused(box: tuple[float, ...]) -> None:
    with pytest.raises(InputError, match="least x"):
        medial_axis([(0, 0), (1, 0), (0, 1)]).clipped(box)


@pytest.mark.parametrize("seed", range(8))
def test_pruning_removes_nothing_by_default_and_only_small_residuals_else(seed: int) -> None:
    curve = blob(seed) + circle(0.5).moved(offset=(4, 0))
    sample = r_sample(curve, 0.2, seed=seed)
    axis = medial_axis(sample.points, sample.edges)
    same = axis.prune()
    assert (same.samples == axis.samples).all()
    assert (same.vertices == axis.vertices).all()
    component = np.minimum((sample.t * 2).astype(int), 1)
    for kind in ("arc", "chord"):
        residual, _ = axis.residuals(kind=kind)
        between = component[axis.samples[:, 0]] != component[axis.samples[:, 1]]
        assert (np.isinf(residual) == between).all()
        limit = float(np.median(residual[~between]))
        pruned = axis.prune(limit, kind=kind)
        assert (pruned.samples == axis.samples[residual >= limit]).all()
        kept = axis.vertices[axis.edges[residual >= limit]]
        assert (pruned.vertices[pruned.edges] == kept).all()


def test_the_residual_is_the_shorter_way_around() -> None:
    points = np.array([(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (2, 1), (1, 1), (0, 1)], float)
    axis = medial_axis(points, ring(8))
    arc = dict(
        zip(map(tuple, axis.samples.tolist()), axis.residuals(kind="arc")[0].tolist(), strict=True)
    )
    assert arc == {(1, 6): 3.0, (2, 5): 3.0}
    chord = axis.residuals(kind="chord")[0]
    assert chord.tolist() == [2.0, 2.0]
    assert len(axis.prune(2.5).edges) == 0
    open_arc = medial_axis(points, ring(8)[1:]).residuals(kind="arc")[0]
    assert sorted(open_arc.tolist()) == [3.0, 5.0]


def test_it_is_written_like_curves(tmp_path: Path) -> None:
    sample = r_sample(ellipse(2, 1), 0.2, seed=1)
    axis = medial_axis(sample.points, sample.edges)
    for suffix in ("geojson", "wkt", "svg", "csv"):
        path = tmp_path / f"axis.{suffix}"
        axis.write(path)
        assert path.stat().st_size > 100
    curves = axis.curves((-3, -2, 3, 2))
    assert (curves.edges == np.unique(curves.edges, axis=0)).all()
    total = np.linalg.norm(np.diff(axis.clipped((-3, -2, 3, 2)), axis=1), axis=2).sum()
    assert curves.lengths.sum() == pytest.approx(total)


@pytest.mark.parametrize("seed", range(6))
def test_it_does_not_depend_on_the_order_of_the_rows(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sample = r_sample(blob(seed), 0.25, seed=seed)
    order = rng.permutation(len(sample.points))
    back = np.argsort(order)
    one = medial_axis(sample.points, sample.edges)
    other = medial_axis(sample.points[order], back[sample.edges])
    key = np.sort(order[other.samples], axis=1)
    sort = np.lexsort((key[:, 1], key[:, 0]))
    assert (key[sort] == one.samples).all()
    assert (other.inner[sort] == one.inner).all()
    sizes = local_feature_size(sample.points, sample.edges)
    moved = local_feature_size(sample.points[order], back[sample.edges])
    np.testing.assert_allclose(moved, sizes[order], rtol=1e-3)


CURVES = {
    **{f"ellipse {q}": ellipse(q, 1) for q in (1.1, 1.5, 2, 3, 4.5, 6)},
    "stadium 1": stadium(1, 1),
    "stadium 4": stadium(4, 1),
    **{f"blob {k}": blob(k) for k in range(4)},
}


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("mode", ["sparsest", "random"])
def test_estimate_at_a_fifth_is_within_a_tenth_in_the_median(name: str, mode: str) -> None:
    error = np.concatenate([errors(CURVES[name], 0.2, seed, mode) for seed in range(3)])
    assert np.median(np.abs(error)) < (0.1 if name.startswith("stadium") else 0.02)
    assert error.max() < 0.3
    assert error.min() > -0.45


def errors(curve: SmoothCurve, r: float, seed: int, mode: str = "sparsest") -> NDArray[np.float64]:
    sample = r_sample(curve, r, seed=seed, mode=mode)
    estimate = local_feature_size(sample.points, sample.edges)
    return estimate / curve.local_feature_size(sample.t) - 1


@pytest.mark.parametrize("name", ["ellipse 2", "ellipse 6", "blob 0", "blob 1", "blob 3"])
def test_estimate_converges_at_least_with_the_square_of_r(name: str) -> None:
    worst = [np.abs(errors(CURVES[name], r, 1)).max() for r in (0.2, 0.05)]
    assert worst[1] < worst[0] / 16 + 1e-3


def test_estimate_at_isolated_points_branches_and_along_a_line() -> None:
    points = np.array([(0, 0), (1, 0), (2, 0.1), (1, 1), (1, -1), (5, 5)], float)
    sizes = local_feature_size(points, [(0, 1), (1, 2), (1, 3), (1, 4)])
    assert sizes[1] == 0
    assert np.isnan(sizes[5])
    line = local_feature_size([(0, 0), (1, 0), (2, 0)], [(0, 1), (1, 2)])
    assert np.isinf(line).all()
    assert local_feature_size(np.empty((0, 2)), []).shape == (0,)


@pytest.mark.parametrize("r", [0.125, 0.2])
def test_samples_on_one_circle_have_its_radius_as_feature_size(r: float) -> None:
    """Where all circles of curvature coincide, a disk that touches two of them is 0/0."""
    for seed in range(10):
        points = r_sample(circle(), r, seed=seed).points
        sizes = local_feature_size(points, crust(points))
        np.testing.assert_allclose(sizes, 1, rtol=1e-5)


@pytest.mark.parametrize("exponent", [-30, 30])
def test_estimate_scales_with_the_curve(exponent: int) -> None:
    sample = r_sample(blob(1), 0.2, seed=1)
    sizes = local_feature_size(sample.points, sample.edges)
    scaled = local_feature_size(sample.points * 2.0**exponent, sample.edges)
    np.testing.assert_allclose(scaled, sizes * 2.0**exponent, rtol=1e-9)


@pytest.mark.parametrize("n", [1000, 30_000])
def test_estimate_of_dense_samples_is_not_spoilt_by_rounding(n: int) -> None:
    curve = ellipse(2, 1).moved(offset=(6e6, 5e6))
    t = np.sort(np.random.default_rng(n).random(n))
    sizes = local_feature_size(curve.point(t), ring(n))
    np.testing.assert_allclose(sizes, ellipse(2, 1).local_feature_size(t), rtol=0.05)
