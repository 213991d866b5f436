"""Thinning. The samples are dense, so what is known of the curve is nearly true of its edges."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import generators
from crustline import shapes, thinning
from crustline.shapes import SmoothCurve
from crustline.shapes.ratio import sampling_ratio
from crustline.shapes.sampling import r_sample
from crustline.thinning import thin

FloatArray = npt.NDArray[np.float64]

CURVES = {
    "circle": shapes.circle(2),
    "ellipse 1.1": shapes.ellipse(1.1, 1),
    "ellipse 6": shapes.ellipse(6, 1),
    **generators.SMOOTH_CURVES,
}


@pytest.fixture(params=list(CURVES), ids=lambda name: str(name).replace(" ", "-"))
def curve(request: pytest.FixtureRequest) -> SmoothCurve:
    return CURVES[request.param]


def dense(curve: SmoothCurve, r: float = 0.01) -> tuple[FloatArray, npt.NDArray[np.int64]]:
    sample = r_sample(curve, r, seed=0, mode="random")
    order = np.random.default_rng(0).permutation(len(sample))
    rank = np.argsort(order)
    return sample.points[order], np.sort(rank[sample.edges], axis=1)


@pytest.mark.parametrize("r", [0.2, 0.5])
def test_thinned_samples_still_r_sample_the_curve(curve: SmoothCurve, r: float) -> None:
    points, edges = dense(curve)
    kept = thin(points, edges, r=r)
    assert np.array_equal(kept, np.unique(kept))
    assert sampling_ratio(curve, points[kept]) <= r * 1.1
    assert len(kept) <= 1.25 * len(r_sample(curve, r)) + 2


def test_thin_keeps_endpoints_branches_and_isolated_points() -> None:
    t = np.linspace(0, 1, 101)
    bow = np.stack([t, 0.2 * np.sin(3 * t)], -1)
    points = np.vstack([bow, [[0.5, 5.0]]])
    edges = np.stack([np.arange(100), np.arange(1, 101)], -1)
    kept = thin(points, edges, r=0.3)
    assert {0, 100, 101} <= set(kept.tolist())
    assert len(kept) < 30


def test_thin_of_sparse_samples_keeps_all() -> None:
    sample = r_sample(shapes.trefoil(3, 0.4), 0.4)
    assert np.array_equal(thin(sample.points, sample.edges, r=0.1), np.arange(len(sample)))


def test_thin_without_edges_keeps_all() -> None:
    assert thin([(0, 0), (1, 1)], np.empty((0, 2), dtype=int), r=0.2).tolist() == [0, 1]


def test_thinned_chain_is_the_fewest_of_all_choices() -> None:
    """Against dynamic programming over the same pairs, with LFS given."""
    rng = np.random.default_rng(8)
    for _ in range(20):
        angle = np.sort(rng.random(24)) * 2 * np.pi
        points = np.stack([np.cos(angle), np.sin(angle)], -1)
        lfs = np.full(24, 1.0)
        kept = thinning._thinned(points, lfs, 0.5, closed=False)
        assert len(kept) == _fewest(points, lfs, 0.5)


@pytest.mark.parametrize("closed", [True, False])
def test_strides_over_very_dense_samples_are_the_longest_steps(
    closed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    curve = shapes.trefoil(3, 0.4)
    t = np.arange(3000) / 3000
    points, lfs = curve.point(t), curve.local_feature_size(t)
    every = thinning._thinned(points, lfs, 0.2, closed)
    monkeypatch.setattr(thinning, "MOST_SERVED", 0)
    strides = thinning._thinned(points, lfs, 0.2, closed)
    assert len(every) <= len(strides) <= len(every) + closed
    if closed:
        assert sampling_ratio(curve, points[strides]) <= 0.2 * 1.001
    else:
        assert np.array_equal(strides, every)


@pytest.mark.parametrize("closed", [True, False])
def test_surely_served_edges_are_served(closed: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Thinning begins at a bound; from nothing it comes to the same, edge by edge."""

    def none(edges: FloatArray, *_: object) -> npt.NDArray[np.int64]:
        return np.zeros(len(edges), dtype=np.int64)

    rng = np.random.default_rng(2)
    for n, r in ((5, 1.0), (60, 0.5), (700, 0.3), (2000, 0.2)):
        t = np.sort(rng.random(n))
        points = shapes.blob(n).point(t)
        lfs = shapes.blob(n).local_feature_size(t)
        begun = thinning._served_edges(points, lfs, r, closed)
        with monkeypatch.context() as patch:
            patch.setattr(thinning, "_surely_served", none)
            afresh = thinning._served_edges(points, lfs, r, closed)
        assert begun is not None
        assert afresh is not None
        assert np.allclose(begun, afresh, rtol=1e-12)


def test_thinning_very_dense_samples_looks_at_few_of_their_edges(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looked = []
    served_part = thinning._served_part

    def counted(*arguments: FloatArray) -> FloatArray:
        looked.append(len(arguments[-1]))
        return served_part(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(thinning, "_served_part", counted)
    n = 60_000
    points = shapes.trefoil(3, 0.3).point(np.arange(n) / n)
    edges = np.stack([np.arange(n), (np.arange(n) + 1) % n], -1)
    assert len(thin(points, edges, r=0.2)) < 60
    assert sum(looked) < 20 * n


def _fewest(points: FloatArray, lfs: FloatArray, r: float) -> int:
    count = {0: 1}
    for j in range(1, len(points)):
        count[j] = min(count[i] for i in range(j) if _serve(points, lfs, r, i, j)) + 1
    return count[len(points) - 1]


def _serve(points: FloatArray, lfs: FloatArray, r: float, i: int, j: int) -> bool:
    """Return whether samples i and j serve the edges between them, distances at their worst."""
    if j == i + 1:
        return True
    for k in range(i, j):
        s = np.linspace(0, 1, 201)[:, None]
        length = np.hypot(*(points[k + 1] - points[k]))
        low = np.maximum(lfs[k] - length * s[:, 0], lfs[k + 1] - length * (1 - s[:, 0]))
        ends = (np.hypot(*(points[[k, k + 1]] - points[end]).T) for end in (i, j))
        near = np.minimum(*(first + s[:, 0] * (last - first) for first, last in ends))
        if np.any(near > r * low * (1 + 1e-9)):
            return False
    return True
