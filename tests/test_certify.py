"""The certificate: never "guaranteed" for wrong edges, and seldom silent about right ones."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

import generators
from crustline import Delaunay, InputError, beta_skeleton, crust, gabriel, nn_crust
from crustline.certify import MARGIN, Certificate, certify
from crustline.shapes import (
    SmoothCurve,
    blob,
    circle,
    ellipse,
    stadium,
    trefoil,
    two_octagons,
)
from crustline.shapes.sampling import r_sample
from crustline.theory import guaranteed_r, sample_angle

Random = np.random.Generator
Rows = NDArray[np.int64]
GRID = 3000
RATIOS_OF_A_CURVE = 24


@dataclass(frozen=True)
class Trial:
    """Edges of samples, whether they are those of the curve, and what is certified."""

    r: float
    method: str
    right: bool
    certificate: Certificate


def random_curve(rng: Random) -> SmoothCurve:
    seed = int(rng.integers(1 << 30))
    match rng.integers(7):
        case 0:
            return ellipse(rng.uniform(1.1, 6), 1)
        case 1:
            return stadium(rng.uniform(0.2, 5), 1)
        case 2 | 3:
            harmonics = int(rng.integers(2, 9))
            return blob(seed, harmonics=harmonics, roughness=rng.uniform(0.2, 0.7))
        case 4:
            return trefoil(int(rng.integers(2, 7)), rng.uniform(0.1, 0.6))
        case 5:
            beside = circle(rng.uniform(0.2, 1)).moved(offset=(rng.uniform(2.6, 4), 0))
            return blob(seed, roughness=0.3) + beside
    beside = ellipse(1, rng.uniform(0.2, 1)).moved(offset=(rng.uniform(3, 4), 0))
    return ellipse(1.5, 1) + beside


class Sampled:
    """A curve as a table, to take many samples of it fast; r up to more than 1."""

    def __init__(self, curve: SmoothCurve) -> None:
        self.curve, self.loops = curve, len(curve.loops)
        self.t = np.arange(GRID * self.loops) / (GRID * self.loops)
        self.points = curve.point(self.t)
        self.sizes = curve.local_feature_size(self.t, rtol=1e-3)

    def take(self, r: float, mode: int, rng: Random) -> NDArray[np.float64]:
        """Return t of samples: even in arc length over LFS, with random gaps, or jittered."""
        taken = []
        for loop in range(self.loops):
            rows = slice(loop * GRID, (loop + 1) * GRID)
            step = np.hypot(*(np.roll(self.points[rows], -1, 0) - self.points[rows]).T)
            along = np.concatenate([[0], np.cumsum(step / (2 * r * self.sizes[rows]))])
            places = self._places(along[-1], mode, rng)
            ends = np.append(self.t[rows], (loop + 1) / self.loops)
            places = np.sort((places + rng.uniform() * along[-1]) % along[-1])
            taken.append(np.interp(places, along, ends))
        return np.unique(np.concatenate(taken))

    @staticmethod
    def _places(total: float, mode: int, rng: Random) -> NDArray[np.float64]:
        n = max(3, int(np.ceil(total)))
        if mode == 1:
            gaps = np.cumsum(rng.uniform(0.3, 1, 4 * n))
            return gaps[: max(3, int((gaps < total).sum()))]
        jitter = rng.uniform(-0.45, 0.45, n) if mode == 2 else 0.0
        return (np.arange(n) + jitter) / n * total

    def ratio(self, t: NDArray[np.float64]) -> float:
        """The sampling ratio, on the table."""
        away = self.points[:, None] - self.curve.point(t)
        return float((np.hypot(away[..., 0], away[..., 1]).min(axis=1) / self.sizes).max())

    def edges(self, t: NDArray[np.float64]) -> Rows:
        loop = np.minimum((t * self.loops).astype(int), self.loops - 1)
        parts = [np.flatnonzero(loop == k) for k in range(self.loops)]
        edges = np.concatenate([np.stack([rows, np.roll(rows, -1)], 1) for rows in parts])
        return np.unique(np.sort(edges, axis=1), axis=0)


def by_hand(edges: Rows, n: int, rng: Random) -> Rows:
    """The edges with one removed, one added or one moved."""
    k = int(rng.integers(len(edges)))
    other = np.sort(rng.choice(n, 2, replace=False))[None]
    match rng.integers(3):
        case 0:
            return np.delete(edges, k, axis=0)
        case 1:
            return np.unique(np.concatenate([edges, other]), axis=0)
    return np.unique(np.concatenate([np.delete(edges, k, axis=0), other]), axis=0)


def trials(seed: int, sets: int) -> Iterator[Trial]:
    """Point sets of random curves at r from 0.1 to 1.2, four sets of edges for each."""
    rng = np.random.default_rng(seed)
    count = 0
    while count < sets:
        try:
            sampled = Sampled(random_curve(rng))
        except InputError:  # It crosses itself, so it is no curve.
            continue
        for r in rng.uniform(0.1, 1.2, RATIOS_OF_A_CURVE):
            t = sampled.take(r, int(rng.integers(3)), rng)
            truth, delaunay = sampled.edges(t), Delaunay(sampled.curve.point(t))
            found = {
                "crust": crust(delaunay),
                "beta-skeleton": beta_skeleton(delaunay),
                "nn-crust": nn_crust(delaunay),
                "by hand": by_hand(truth, len(t), rng),
            }
            ratio = sampled.ratio(t)
            for method, edges in found.items():
                right = np.array_equal(edges, truth)
                yield Trial(ratio, method, right, certify(delaunay, edges))
            count += 1


def check(found: list[Trial]) -> None:
    wrong = [trial for trial in found if not trial.right]
    assert len(wrong) > len(found) / 10
    assert not any(trial.certificate.guaranteed for trial in wrong)
    right = [t for t in found if t.right and t.r <= 0.2 and t.method != "by hand"]
    assert len(right) > len(found) / 100
    certified = sum(trial.certificate.guaranteed for trial in right)
    assert certified >= 0.9 * len(right)


def test_no_wrong_edges_are_guaranteed_and_most_right_ones_are() -> None:
    check(list(trials(1, 400)))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 12))
def test_no_wrong_edges_are_guaranteed_in_ten_thousand_sets(seed: int) -> None:
    check(list(trials(seed, 1000)))


@pytest.mark.parametrize("seed", range(60))
def test_points_of_no_curve_are_never_guaranteed(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = generators.degenerate(rng) if seed % 2 else generators.general_position(rng)
    for edges in (crust(points), beta_skeleton(points), np.empty((0, 2), int)):
        certificate = certify(points, edges)
        assert not certificate.guaranteed or certificate.sampling_ratio < 0.26
        assert (
            certificate.guaranteed
            or len(edges) == 0
            or len(certificate.weak)
            or (len(certificate.weak_points))
        )


def test_two_octagons_of_observation_6_are_not_guaranteed() -> None:
    points = np.asarray(two_octagons())
    for method in (crust, beta_skeleton, nn_crust):
        assert not certify(points, method(points)).guaranteed


@pytest.mark.parametrize("r", [0.1, 0.15, 0.2])
@pytest.mark.parametrize("mode", ["sparsest", "random"])
def test_the_ratio_is_that_of_the_curve(r: float, mode: str) -> None:
    for curve in (ellipse(2, 1), ellipse(5, 1), blob(3), blob(4) + circle(0.3)):
        sample = r_sample(curve, r, seed=3, mode=mode)
        certificate = certify(sample.points, sample.edges)
        assert certificate.guaranteed
        assert 0.9 * r < certificate.sampling_ratio < 1.1 * r or mode == "random"


def test_the_theorem_is_that_of_the_method_whose_edges_they_are() -> None:
    sample = r_sample(ellipse(2, 1), 0.2, seed=1)
    certificate = certify(sample.points, sample.edges)
    assert certificate.theorem.startswith("Theorem 20")
    assert certificate.threshold == guaranteed_r("beta_skeleton")
    assert certify(sample.points, sample.edges[1:]).theorem == ""
    cornered = square()
    assert not np.array_equal(crust(cornered), beta_skeleton(cornered))
    certificate = certify(cornered)
    assert certificate.theorem.startswith("Theorems 14 and 15")
    assert certificate.threshold == guaranteed_r("crust")


def square() -> NDArray[np.float64]:
    """40 points on each side of a square."""
    side = np.linspace(0, 1, 40, endpoint=False)
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)], float)
    steps = np.diff(corners, axis=0)
    return (corners[:-1, None] + side[None, :, None] * steps[:, None]).reshape(-1, 2)


def test_the_crust_is_found_once_for_all_edges_that_are_certified(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rng = np.random.default_rng(4)
    delaunay = Delaunay(rng.random((300, 2)))
    certificates = [certify(delaunay, nn_crust(delaunay)).to_dict()]
    kept = delaunay.kept("crust")
    assert kept is not None
    assert np.array_equal(kept, crust(Delaunay(delaunay.points)))
    assert not kept.flags.writeable
    monkeypatch.setattr(Delaunay, "select", None)
    assert crust(delaunay) is kept
    monkeypatch.undo()
    # Known or not, it leads to the same.
    edges = gabriel(delaunay)
    alone = certify(Delaunay(delaunay.points), edges)
    certificates += [alone.to_dict(), certify(delaunay, edges).to_dict()]
    assert delaunay.kept("crust") is kept
    assert certificates[0] != certificates[1] == certificates[2]


def test_each_reason_has_its_points() -> None:
    sample = r_sample(ellipse(2, 1), 0.15, seed=1)
    n = len(sample.points)
    points = np.concatenate([sample.points, [(9.0, 9.0)]])
    certificate = certify(points, sample.edges[1:])
    i, j = sample.edges[0]
    assert not certificate.guaranteed
    assert certificate.point_reason[n] == "isolated"
    assert certificate.point_reason[[i, j]].tolist() == ["endpoint", "endpoint"]
    touching = (np.isin(certificate.edges, [i, j])).any(axis=1)
    assert (certificate.edge_reason[touching] == "endpoint").all()
    branch = certify(sample.points, np.concatenate([sample.edges, [(0, n // 2)]]))
    assert branch.point_reason[[0, n // 2]].tolist() == ["branch", "branch"]
    extra = (branch.edges == (0, n // 2)).all(axis=1)
    assert branch.edge_reason[extra].tolist() == ["unselected"]
    missing = certify(points[:-1], np.delete(sample.edges, 5, axis=0))
    assert set(missing.weak_points) == set(sample.edges[5])


def test_a_corner_is_one_that_lemma_10_forbids() -> None:
    certificate = certify(square())
    assert not certificate.guaranteed
    assert np.flatnonzero(certificate.point_reason == "corner").tolist() == [0, 40, 80, 120]
    for n in (6, 8, 10, 12, 14):
        certificate = certify(generators.circle(n))
        most = np.pi - float(sample_angle(certificate.threshold))
        assert (certificate.point_reason == "corner").tolist() == [2 * np.pi / n > most] * n


def test_weak_edges_are_where_samples_are_missing() -> None:
    sample = r_sample(ellipse(2, 1), 0.12, seed=1)
    removed = np.arange(7, 10)
    points = np.delete(sample.points, removed, axis=0)
    certificate = certify(points)
    assert not certificate.guaranteed
    worst = certificate.edges[np.argmax(certificate.ratio)]
    assert worst.tolist() == [6, 7]
    assert set(certificate.weak_points) >= {6, 7}
    assert len(certificate.weak) < 6


def test_words_say_what_is_proven_and_what_is_estimated() -> None:
    sample = r_sample(ellipse(2, 1), 0.2, seed=1)
    good, bad = certify(sample.points), certify(sample.points[::3])
    assert str(good) == good.summary()
    assert str(good).startswith("Guaranteed: ")
    assert str(bad).startswith("Not guaranteed: ")
    for certificate in (good, bad):
        assert "Proven: if the points are an r-sample" in str(certificate)
        assert "-sample the smooth interpolant" in str(certificate)
        assert "is not known" in str(certificate)
    assert "undersampled" in str(bad)
    assert MARGIN > 0


def test_it_is_plain_json() -> None:
    for points in (r_sample(ellipse(2, 1), 0.2).points, np.empty((0, 2)), np.zeros((3, 2))):
        certificate = certify(points)
        plain = json.loads(json.dumps(certificate.to_dict(), allow_nan=False))
        assert plain["guaranteed"] is certificate.guaranteed
        assert len(plain["ratio"]) == len(certificate.edges)


@pytest.mark.parametrize("points", [[], [(0, 0)], [(0, 0), (1, 0)], [(0, 0), (1, 0), (2, 0)]])
def test_too_few_points_are_not_guaranteed(points: list[tuple[int, int]]) -> None:
    certificate = certify(points)
    assert not certificate.guaranteed
    assert len(certificate.ratio) == len(certificate.edges)
    assert str(certificate)


def test_repeated_rows_do_not_break_a_guarantee() -> None:
    sample = r_sample(ellipse(2, 1), 0.2, seed=1)
    points = np.concatenate([sample.points, sample.points[:4]])
    assert certify(points).guaranteed
