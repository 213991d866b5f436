"""Noisy points: curves near them, how near, and what is refused; and clean points, left alone."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import crustline as cl
import generators as make
from crustline import arrays
from crustline.denoise import clean
from crustline.denoise.ends import joined
from crustline.denoise.mixture import HALVES, PLACES, Mixture, Offsets
from crustline.denoise.polygon import Polygon
from crustline.denoise.smoother import fit
from generators import Rows

pytest.importorskip("scipy", reason="denoise needs scipy")

SHAPES: dict[str, tuple[list[tuple[Callable[[Rows], Rows], bool]], int]] = {
    "circle": ([(lambda t: np.column_stack((np.cos(t), np.sin(t))), True)], 200),
    "flower": (
        [(lambda t: ((1 + 0.3 * np.cos(3 * t)) * np.array((np.cos(t), np.sin(t)))).T, True)],
        300,
    ),
    "wave": ([(lambda t: np.column_stack((t, np.sin(2 * t) / 3)), False)], 200),
    "two rings": (
        [
            (lambda t: np.column_stack((np.cos(t), np.sin(t))), True),
            (lambda t: np.column_stack((2.2 + 0.7 * np.cos(t), 0.7 * np.sin(t))), True),
        ],
        400,
    ),
    "ring and line": (
        [
            (lambda t: np.column_stack((0.8 * np.cos(t), 2 + 0.8 * np.sin(t))), True),
            (lambda t: np.column_stack((t - 3, 0.2 * np.cos(t))), False),
        ],
        400,
    ),
}  # fmt: skip


def noisy(name: str, ratio: float, seed: int) -> tuple[Rows, Rows, float]:
    """Points with noise of so many times their spacing, the true curves finely, and the noise."""
    rng = np.random.default_rng(seed)
    parts, count = SHAPES[name]
    truth = [curve(np.linspace(0, 2 * np.pi, 4001)) for curve, _ in parts]
    lengths = [np.hypot(*np.diff(path, axis=0).T).sum() for path in truth]
    spacing = sum(lengths) / count
    points = []
    for path, length in zip(truth, lengths, strict=True):
        along = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))))
        steps = round(length / spacing)
        at = (np.arange(steps) + rng.uniform(0.2, 0.8, steps)) / steps * length
        points.append(np.column_stack([np.interp(at, along, x) for x in path.T]))
    exact = rng.permutation(np.vstack(points))
    return exact + rng.normal(0, ratio * spacing, exact.shape), np.vstack(truth), ratio * spacing


def topology(found: cl.Denoised) -> tuple[int, int]:
    rings = int(found.curves.closed.sum())
    return rings, len(found.curves) - rings


def distances(curves: cl.Curves, truth: Rows) -> Rows:
    """The distances of many places of the curves from the truth."""
    spatial = pytest.importorskip("scipy.spatial")
    places = []
    for curve in curves:
        path = Polygon(curves.points.xy[curve.indices], curve.closed)
        places.append(path.resampled(2000, smooth=False).nodes)
    return np.asarray(spatial.cKDTree(truth).query(np.vstack(places))[0])


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("ratio", [0.25, 0.5, 1.0, 2.0])
def test_rings_lines_and_components_are_kept_and_near(name: str, ratio: float) -> None:
    expected = [closed for _, closed in SHAPES[name][0]]
    for seed in range(2):
        points, truth, noise = noisy(name, ratio, seed)
        found = cl.denoise(points)
        assert topology(found) == (sum(expected), len(expected) - sum(expected))
        assert np.sqrt((distances(found.curves, truth) ** 2).mean()) < 0.6 * noise
        known = found.noise[np.isfinite(found.noise)]
        assert 0.75 * noise < np.median(known) < 1.3 * noise


@pytest.mark.parametrize("noise", [0.023, 0.059, 0.117, 0.175])
def test_a_circle_is_fitted_nearly_as_well_as_by_a_circle(noise: float) -> None:
    angle = 2 * np.pi * np.arange(200) / 200
    ratios = []
    for seed in range(5):
        rng = np.random.default_rng(seed)
        points = np.column_stack((np.cos(angle), np.sin(angle))) + rng.normal(0, noise, (200, 2))
        found = cl.denoise(points)
        assert topology(found) == (1, 0)
        radii = np.hypot(*found.curves.points.xy.T)
        ratios.append(np.sqrt(((radii - 1) ** 2).mean()) / noise)
        # As uncertain as it says, within a factor of 2.5.
        assert np.abs(radii - 1).mean() < 2.5 * found.uncertainty.mean()
    # The best circle has an error of about sqrt(3 / 200) of the noise, and the bend adds to it.
    assert np.median(ratios) < 1.5 * (math.sqrt(3 / 200) + noise / 2)


def test_every_row_has_a_vertex_near_it_or_is_an_outlier() -> None:
    points, _, noise = noisy("flower", 1.0, 3)
    found = cl.denoise(np.vstack((points, [(5, 5), (-4, 3)])))
    assert {300, 301} <= set(found.outliers.tolist()) or {len(points), len(points) + 1} <= set(
        found.outliers.tolist()
    )
    inside = found.vertices >= 0
    assert inside.mean() > 0.97
    vertices = found.curves.points.xy[found.vertices[inside]]
    assert np.hypot(*(found.points.xy[inside] - vertices).T).max() < 5 * noise
    some = int(found.vertices[inside][0])
    assert found.rows(some).tolist() == np.flatnonzero(found.vertices == some).tolist()


@pytest.mark.parametrize("name", make.SMOOTH_CURVES)
@pytest.mark.parametrize("r", [0.1, 0.2, 0.3, 0.4])
def test_clean_samples_are_left_alone(name: str, r: float) -> None:
    sample = cl.r_sample(make.SMOOTH_CURVES[name], r, seed=1)
    found = cl.denoise(sample.points)
    assert found.unchanged.all()
    assert len(found.curves)
    kept = found.vertices >= 0
    assert (found.curves.points.xy[found.vertices[kept]] == sample.points[kept]).all()
    assert kept.all()
    assert (found.uncertainty == 0).all()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", [50, 300, 1000])
def test_pure_noise_gives_no_curve(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    for points in (rng.random((count, 2)), rng.normal(size=(count, 2))):
        found = cl.denoise(points)
        assert (found.vertices < 0).mean() > 0.9


def test_several_passes_give_one_line() -> None:
    rng = np.random.default_rng(4)
    t = np.linspace(0, 1, 300)
    track = np.column_stack((6 * t, np.sin(6 * t) + 0.3 * np.sin(15 * t)))
    passes = [track[::step] for step in (1, 2, 1, 3)]
    points = np.vstack([each + rng.normal(0, 0.05, each.shape) for each in passes])
    found = cl.denoise(points)
    assert topology(found) == (0, 1)
    assert np.sqrt((distances(found.curves, track) ** 2).mean()) < 0.02
    assert len(found.outliers) < 0.02 * len(points)


def walks(seed: int, passes: int, noise: float) -> tuple[Rows, Rows, Rows]:
    """A path, and fixes of several passes along it with the times at which they were taken."""
    rng = np.random.default_rng(seed)
    fine = np.linspace(0, 1, 4001)
    phase = rng.uniform(0, 6)
    path = lambda t: np.column_stack((6 * t, np.sin(6 * t + phase) + 0.3 * np.sin(15 * t)))  # noqa: E731
    times = np.concatenate([k + np.sort(rng.uniform(0, 1, 150 + 30 * k)) for k in range(passes)])
    return path(fine), path(times % 1) + rng.normal(0, noise, (len(times), 2)), times


@pytest.mark.parametrize("order", ["by time", "of the rows at random"])
@pytest.mark.parametrize("passes", [2, 3, 6])
def test_passes_with_and_without_time_give_one_line(passes: int, order: str) -> None:
    for seed in range(3):
        path, fixes, times = walks(seed, passes, 0.05)
        rows = np.random.default_rng(seed).permutation(len(fixes))
        given = cl.Points(fixes, columns={"time": times}) if order == "by time" else fixes[rows]
        found = cl.denoise(given)
        assert topology(found) == (0, 1)
        assert np.sqrt((distances(found.curves, path) ** 2).mean()) < 0.025
        assert len(found.outliers) < 0.02 * len(fixes)
        # A vertex stands for fixes of several passes: they are one line, not several.
        own = (np.arange(len(fixes)) if order == "by time" else rows)[found.vertices >= 0]
        owners = found.vertices[found.vertices >= 0]
        spread = [len({int(t) for t in times[own[owners == v]]}) for v in np.unique(owners)]
        assert max(spread) > 1


def test_time_beside_the_points_is_kept_and_changes_nothing() -> None:
    points, _, _ = noisy("wave", 1.0, 0)
    timed = cl.Points(points, columns={"time": np.arange(len(points))})
    found = cl.denoise(timed)
    assert found.points == timed
    assert found.curves == cl.denoise(points).curves


@pytest.mark.parametrize("ratio", [0.5, 2.0])
@pytest.mark.parametrize("name", ["two rings", "wave"])
def test_the_order_of_rows_and_the_number_of_threads_change_nothing(
    name: str, ratio: float
) -> None:
    points, _, noise = noisy(name, ratio, 5)
    for given in (None, np.full(len(points), noise)):
        found = cl.denoise(points, noise=given)
        order = np.random.default_rng(0).permutation(len(points))
        moved = cl.denoise(points[order], noise=given)
        assert (moved.curves.points.xy == found.curves.points.xy).all()
        assert (moved.vertices == found.vertices[order]).all()
        for threads in (1, 2):
            assert cl.denoise(cl.Delaunay(points, threads=threads), noise=given) == found


def test_noise_that_varies_along_the_curve_is_followed() -> None:
    rng = np.random.default_rng(12)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 1200))
    each = 0.02 + 0.03 * (1 + np.cos(angle))
    circle = np.column_stack((2 * np.cos(angle), 2 * np.sin(angle)))
    found = cl.denoise(circle + rng.normal(size=circle.shape) * each[:, None])
    assert topology(found) == (1, 0)
    known = found.vertices >= 0
    assert np.corrcoef(found.noise[known], each[known])[0, 1] > 0.9
    assert 0.7 < np.median(found.noise[known] / each[known]) < 1.3


@pytest.mark.parametrize("shape", ["uniform", "pixels"])
def test_a_thick_slice_is_one_line(shape: str) -> None:
    # Neither has a normal noise, and neither is two strands.
    rng = np.random.default_rng(13)
    x = rng.uniform(0, 200, 600)
    points = np.column_stack((x, 6 * np.sin(x / 40) + rng.uniform(-3, 3, len(x))))
    points = np.unique(np.rint(points), axis=0) if shape == "pixels" else points
    assert topology(cl.denoise(points)) == (0, 1)


def strands(apart: float, closed: bool, seed: int, noise: float = 0.02) -> tuple[Rows, list[Rows]]:
    """Points of two strands so many deviations apart, 200 of each, and both finely."""
    rng = np.random.default_rng(seed)
    paths = []
    for side in (-apart * noise / 2, apart * noise / 2):
        t = np.linspace(0, 2 * np.pi, 4001)
        if closed:
            x, y = np.cos(t), 0.7 * np.sin(t)
            normal = np.column_stack((0.7 * np.cos(t), np.sin(t)))
        else:
            x, y = t - np.pi, 0.3 * np.sin(2 * t)
            normal = np.column_stack((-0.6 * np.cos(2 * t), np.ones_like(t)))
        normal /= np.hypot(*normal.T)[:, None]
        paths.append(np.column_stack((x, y)) + side * normal)
    at = [np.sort(rng.choice(4000, 200, replace=False)) for _ in paths]
    exact = np.vstack([path[own] for path, own in zip(paths, at, strict=True)])
    return rng.permutation(exact + rng.normal(0, noise, exact.shape)), paths


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("apart", [3.6, 4.5, 6.0])
def test_strands_near_each_other_are_two(apart: float, closed: bool) -> None:
    spatial = pytest.importorskip("scipy.spatial")
    for seed in range(2):
        points, paths = strands(apart, closed, seed)
        found = cl.denoise(points)
        assert topology(found) == ((2, 0) if closed else (0, 2))
        # Each is near one of the two all along, and not both near the same.
        nearest = set()
        for curve in found.curves:
            vertices = found.curves.points.xy[curve.indices]
            off = [spatial.cKDTree(path).query(vertices)[0].mean() for path in paths]
            nearest.add(int(np.argmin(off)))
            assert min(off) < 0.5 * 0.02
        assert nearest == {0, 1}
        assert 0.8 * 0.02 < np.nanmedian(found.noise) < 1.2 * 0.02


@pytest.mark.parametrize("closed", [True, False])
def test_one_strand_is_not_two(closed: bool) -> None:
    for seed in range(3):
        points, _ = strands(0, closed, seed)
        assert len(cl.denoise(points).curves) == 1


def test_a_mixture_gains_likelihood_and_finds_its_law() -> None:
    rng = np.random.default_rng(3)
    noise = rng.uniform(0.5, 1.0, 4000)
    values = noise * rng.normal(size=4000) + np.where(rng.random(4000) < 0.4, -2.0, 2.0)
    offsets = Offsets(values, noise)
    two = Mixture(PLACES, HALVES, 0.0, 1.0, 1.0)
    likelihood = [two.likelihood(offsets)]
    for _ in range(60):
        two = two.better(offsets)
        likelihood.append(two.likelihood(offsets))
    assert (np.diff(likelihood) > -1e-6).all()
    assert abs(two.half - 2) < 0.1
    assert abs(two.deviation - 1) < 0.1
    assert abs(two.shares[0] - 0.4) < 0.05


def test_sharp_corners_are_not_torn() -> None:
    vertices = np.array([(0, 0), (4, 0), (3.5, 2.5), (4, 5), (0, 4)], float)
    ring = Polygon(vertices, True).resampled(250, smooth=False)
    for seed in range(3):
        noise = np.random.default_rng(seed).normal(0, 0.5 * ring.length / 250, (250, 2))
        assert topology(cl.denoise(ring.nodes + noise)) == (1, 0)


def test_ends_that_look_at_each_other_go_on_and_those_beside_each_other_do_not() -> None:
    x = np.arange(20.0)
    left = np.column_stack((x, np.zeros(20)))
    right, beside = left + np.array([21.5, 0]), left + np.array([0, 2])
    parts = [(np.arange(20), False), (np.arange(20, 40), False)]
    width = np.ones(40)
    ((path, closed),) = joined(parts, np.vstack((left, right)), width)
    assert path.tolist() in (list(range(40)), list(range(40))[::-1])
    assert not closed
    assert len(joined(parts, np.vstack((left, beside)), width)) == 2
    assert len(joined(parts, np.vstack((left, right + np.array([5, 0]))), width)) == 2
    angle = np.linspace(0.1, 6.1, 40)
    ((_, closed),) = joined(
        [(np.arange(40), False)], 5 * np.c_[np.cos(angle), np.sin(angle)], width
    )
    assert closed


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.5, 2.0])
def test_a_ring_of_many_points_at_random_places_is_one(noise: float) -> None:
    # Gaps of 13 mean steps came in two places, and with more noise a corner where there is none.
    count = 100_000
    rng = np.random.default_rng(0)
    angle = rng.uniform(0, 2 * np.pi, count)
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    points = circle + rng.normal(0, noise * 2 * np.pi / count, circle.shape)
    assert topology(cl.denoise(points)) == (1, 0)


def test_fit_of_reconstruct_is_denoise_with_rows_beside_the_vertices() -> None:
    points, _, noise = noisy("two rings", 0.5, 8)
    given = cl.Points(np.vstack((points, [(5, 5)])), z=np.arange(401), crs="EPSG:25832")
    made = cl.Reconstruction(given, fit=True)
    found = cl.denoise(given)
    assert made.denoised == found
    assert made.points == given
    curves = made.curves
    assert curves == cl.reconstruct(given, fit=True)
    count = len(found.curves.points)
    assert (curves.points.xy[:count] == found.curves.points.xy).all()
    assert curves.isolated.tolist() == list(range(count, count + len(found.outliers)))
    assert curves.points.crs == "EPSG:25832"
    rows = [list(map(int, text.split())) for text in curves.points.columns["input_rows"]]
    assert rows[:count] == [found.rows(vertex).tolist() for vertex in range(count)]
    assert [row for own in rows[count:] for row in own] == found.outliers.tolist()
    assert curves.points.z is not None
    assert np.nanmedian(np.abs(curves.points.columns["noise"] - noise)) < 0.3 * noise
    assert len(made.medial_axis.edges)
    assert len(made.local_feature_size) == len(curves.points)
    assert made.vertices == curves.points
    assert (made.edges == curves.edges).all()
    assert pickle.loads(pickle.dumps(made)) == made != cl.Reconstruction(given)


def test_degrees_are_fitted_in_meters() -> None:
    pytest.importorskip("pyproj")
    rng = np.random.default_rng(9)
    t = np.sort(rng.uniform(0, 1, 300))
    path = np.column_stack((7.4 + 0.01 * t, 46.9 + 0.002 * np.sin(9 * t)))
    off = rng.normal(0, 5, path.shape) / (76_000, 111_000)
    points = cl.Points(path + off, crs="EPSG:4326")
    found = cl.denoise(points, crs="auto")
    assert topology(found) == (0, 1)
    assert 4 < np.nanmedian(found.noise) < 6
    assert found.curves.points.crs == "EPSG:4326"
    assert np.abs(found.curves.points.xy - path.mean(axis=0)).max() < 0.01
    assert found.points == points


@pytest.mark.parametrize("option", [{"noise": 1.0}, {"crs": "auto"}])
def test_what_is_for_fitting_needs_fit(option: dict[str, Any]) -> None:
    with pytest.raises(cl.InputError, match=r"is for fitting curves: add fit=True"):
        cl.reconstruct([(0, 0), (1, 0), (2, 1)], **option)


def test_noise_can_be_given_of_all_points_and_of_each() -> None:
    points, _, noise = noisy("circle", 1.0, 6)
    for given in (noise, np.full(len(points), noise)):
        assert topology(cl.denoise(points, noise=given)) == (1, 0)
    rng = np.random.default_rng(7)
    angle = rng.uniform(0, 2 * np.pi, 1500)
    each = 0.02 + 0.03 * (1 + np.cos(angle))
    ellipse = np.column_stack((2 * np.cos(angle), np.sin(angle)))
    found = cl.denoise(ellipse + rng.normal(size=ellipse.shape) * each[:, None], noise=each)
    assert topology(found) == (1, 0)


LINE = [(0, 0), (1, 0), (2, 1)]
BAD: dict[str, tuple[Any, Any, str]] = {
    "two points": ([(0, 0), (1, 1)], None, r"the 2 points are at 2 different .* three at least"),
    "all points equal": ([(1, 2)] * 5, None, r"the 5 points are at 1 different places"),
    "negative noise": (LINE, -1, r"noise must be 0 or more, not -1"),
    "negative noise of a row": (
        LINE,
        [0.1, -0.2, 0.1],
        r"row 1: noise must be 0 or more, not -0\.2",
    ),
    "noise of the wrong length": (LINE, [0.1, 0.1], r"one for each of the 3 rows, .* \(2,\)"),
    "noise in a table": (LINE, np.ones((3, 2)), r"one for each of the 3 rows, .* \(3, 2\)"),
    "noise in words": (LINE, ["a", "b", "c"], r"noise"),
    "ragged noise": (LINE, [[1], [1, 2], 3], r"noise"),
    "no number": (LINE, [0.1, math.nan, 0], r"row 1: noise must be 0 or more, not nan"),
    "noise zero everywhere": (LINE, 0, r"noise is 0 everywhere: leave it out"),
    "noise zero in each row": (LINE, [0, 0, 0], r"noise is 0 everywhere: leave it out"),
    "noise larger than the extent": (
        LINE,
        50,
        r"noise of 50 is larger than the extent .* 2\.23607",
    ),
    "an infinite point": ([(0, 0), (1, math.inf), (2, 1)], None, r"row 1"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_refused_in_a_sentence(name: str) -> None:
    points, noise, message = BAD[name]
    for refused in (cl.denoise, lambda p, noise: cl.reconstruct(p, fit=True, noise=noise)):
        with pytest.raises(cl.InputError, match=message) as caught:
            refused(points, noise=noise)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("noise", [0.02, 0.05, 0.1])
def test_pure_noise_with_a_known_deviation_gives_no_curve(noise: float) -> None:
    for seed in range(3):
        points = np.random.default_rng(seed).random((500, 2))
        assert (cl.denoise(points, noise=noise).vertices < 0).mean() > 0.9


@pytest.mark.parametrize("closed", [True, False])
def test_circles_and_lines_cost_nothing(closed: bool) -> None:
    # Without noise the fit of an arc is the arc, but for the sagitta of its 60 chords.
    angle = np.linspace(0, 2 * np.pi if closed else 2.0, 200, endpoint=not closed)
    arc = np.column_stack((np.cos(angle), np.sin(angle)))
    start = Polygon(1.02 * arc, closed).resampled(60)
    found = fit(arc, np.full(len(arc), 0.01), start)
    assert np.abs(np.hypot(*found.polygon.nodes.T) - 1).max() < 1 - math.cos(math.pi / 60)


@pytest.mark.parametrize("name", ["ring and line", "two rings"])
@pytest.mark.parametrize("ratio", [0.0, 0.5])
def test_working_in_parts_changes_nothing(
    name: str, ratio: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    points = noisy(name, ratio, 3)[0]
    whole = cl.denoise(points)
    monkeypatch.setattr(arrays, "PART", 40)
    monkeypatch.setattr(clean, "PART", 40)
    parts = cl.denoise(points)
    assert np.array_equal(whole.curves.points.xy, parts.curves.points.xy)
    assert np.array_equal(whole.vertices, parts.vertices)
    assert np.array_equal(whole.noise, parts.noise, equal_nan=True)
    assert np.array_equal(whole.uncertainty, parts.uncertainty)


def test_medians_of_groups_are_those_of_each(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(4)
    counts = np.array([0, 3, 1, 50, 0, 2, 41, 90, 7, 40, 0])
    group, values = np.repeat(np.arange(len(counts)), counts), rng.random(counts.sum())
    monkeypatch.setattr(clean, "PART", 40)
    found = clean._medians(values, group, len(counts))
    own = [np.median(values[group == k]) if count else np.inf for k, count in enumerate(counts)]
    assert np.array_equal(found, own)
