"""How sure `connect` is: what it says, that it is honest, and laws."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl
from crustline.cli import commands
from crustline.projection import projected

Array = np.ndarray


def circle(count: int) -> Array:
    angle = np.arange(count) * 2 * np.pi / count
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def lattice(side: int) -> Array:
    return np.stack(np.meshgrid(*[np.arange(side)] * 2), -1).reshape(-1, 2).astype(float)


def disk(across: int) -> Array:
    points = lattice(across + 1) - across / 2
    return points[np.hypot(*points.T) <= across / 2]


SHAPELESS = {
    "lattice": lattice(14),
    "small lattice": lattice(6),
    "hexagons": lattice(14) @ [[1, 0], [0.5, math.sqrt(0.75)]],
    "filled disk": disk(16),
    "cloud": np.random.default_rng(11).random((400, 2)),
    "normal cloud": np.random.default_rng(12).normal(size=(400, 2)),
}


@pytest.mark.parametrize("name", SHAPELESS)
def test_no_confident_lie_where_there_is_no_curve(name: str) -> None:
    found = cl.connection(SHAPELESS[name])
    assert len(found.edges) > 20
    assert np.mean(found.confidence >= 0.9) <= 0.05
    assert found.whole < 0.5


def test_a_dense_circle_is_sure() -> None:
    found = cl.connection(circle(60))
    assert found.confidence.min() > 0.97
    assert found.whole > 0.9
    assert not len(found.left_out)
    assert not len(found.outliers)


def test_edges_are_those_of_connect_and_differences_those_from_the_crust() -> None:
    rng = np.random.default_rng(3)
    points = np.concatenate([circle(50), rng.uniform(-2, 2, (12, 2)), circle(3)[:2]])
    found = cl.connection(points)
    edges, crust = (set(map(tuple, made(points).tolist())) for made in (cl.connect, cl.crust))
    assert set(map(tuple, found.edges.tolist())) == edges
    assert set(map(tuple, found.left_out.tolist())) == crust - edges
    assert set(map(tuple, found.added.tolist())) == edges - crust
    assert len(found.left_out_reasons) == len(found.left_out)
    assert len(found.added_reasons) == len(found.added)
    assert len(found.confidence) == len(found.edges)
    assert found == cl.Reconstruction(points).connection


def test_reasons() -> None:
    corner = [(-1.5, 3), (-1, 2), (-0.5, 1), (0, 0), (0.5, 1), (1, 2), (1.5, 3)]
    found = cl.connection(corner)
    assert (found.left_out.tolist(), found.left_out_reasons) == ([[2, 4]], ("chord",))
    with_outlier = np.concatenate([circle(40), [(2.5, 0.3)]])
    assert cl.connection(with_outlier).outliers.tolist() == [40]
    assert set(cl.connection(with_outlier).left_out_reasons) <= {"outlier"}
    kept = cl.connection(circle(40), keep=[(3, 9)])
    assert kept.added_reasons[kept.added.tolist().index([3, 9])] == "hint"
    assert "gap" in cl.connection(circle(100)[:84]).left_out_reasons


@pytest.mark.parametrize("count", [12, 25, 40])
def test_a_coarse_ring_among_outliers_is_no_row_of_outliers(count: int) -> None:
    """Counters of letters, of few points beside an outline of many, used to be dropped whole."""
    rng = np.random.default_rng(count)
    outline, inner = 12 * circle(170), 3 * circle(count) * rng.uniform(0.95, 1.05, (count, 1))
    lone = np.array([(7, 0), (0, 8), (-7, -2), (2, -7), (16, 3), (-14, 9), (0, -15)])
    edges = cl.connect(np.concatenate([outline, inner, lone]))
    joined = np.bincount(edges.ravel(), minlength=170 + count + len(lone))
    assert (joined[: 170 + count] == 2).all()
    assert not joined[170 + count :].any()


def test_only_connect_says_how_sure_it_is() -> None:
    with pytest.raises(cl.InputError, match="only connect"):
        _ = cl.Reconstruction(circle(8), cl.crust).connection


def test_projected_connect_says_how_sure_it_is() -> None:
    pytest.importorskip("pyproj")
    places = cl.Points(circle(40) * [2, 1] + [10, 60], crs="EPSG:4326")
    made = cl.Reconstruction(places, projected(cl.connect))
    assert made.connection.points == places
    assert made.edges.tolist() == made.connection.edges.tolist()
    assert made.connection.whole > 0.9


LAWS: dict[str, Callable[[Array], Array]] = {
    "scale": lambda points: points * 2.0**-40,
    "translation": lambda points: points - np.array([4096, 65536]),
    "quarter turn": lambda points: points[:, ::-1] * [-1, 1],
    "mirror": lambda points: points * [1, -1],
}


def samples(seed: int, grid: bool) -> Array:
    rng = np.random.default_rng(seed)
    points = rng.random((rng.integers(3, 60), 2))
    if seed % 2:
        angle = rng.random(rng.integers(5, 80)) * 2 * math.pi
        points = np.stack([np.cos(angle), np.sin(2 * angle)], axis=1)
    step = 2.0**-3 if grid else 2.0**-20
    return np.unique(np.round(points / step) * step, axis=0)


@pytest.mark.parametrize("law", LAWS)
@given(seed=st.integers(0, 2**32 - 1), grid=st.booleans())
def test_law(law: str, seed: int, grid: bool) -> None:
    points = samples(seed, grid)
    one, other = cl.connection(points), cl.connection(LAWS[law](points))
    assert one.edges.tolist() == other.edges.tolist()
    assert one.confidence.tolist() == other.confidence.tolist()
    if not grid:  # at exact ties a neighbor may be left out on one side only
        assert one.left_out_reasons == other.left_out_reasons
        assert one.added_reasons == other.added_reasons


@given(seed=st.integers(0, 2**32 - 1))
def test_order_of_rows_does_not_matter(seed: int) -> None:
    points = samples(seed, False)
    order = np.random.default_rng(seed).permutation(len(points))
    one, other = cl.connection(points), cl.connection(points[order])
    assert math.isclose(one.whole, other.whole, rel_tol=1e-12)
    assert one == replace(other.renamed(one.points, order), whole=one.whole)


def test_threads_do_not_matter() -> None:
    rng = np.random.default_rng(5)
    points = np.concatenate([circle(12_000), rng.uniform(-1, 1, (3000, 2))])
    one, three = (cl.connection(cl.Delaunay(points, threads=threads)) for threads in (1, 3))
    assert one == three


def test_curves_and_geojson_say_how_sure_each_edge_is(tmp_path: Path) -> None:
    points = circle(100)[:70]
    curves = cl.connection(points).curves
    curves.write(tmp_path / "arc.geojson")
    (feature,) = json.loads((tmp_path / "arc.geojson").read_text())["features"]
    sure = feature["properties"]["confidence"]
    assert len(sure) == 69
    assert feature["properties"]["least_sure"] == min(sure)
    assert cl.reconstruct(points).confidence is None


def test_the_command_says_how_sure_it_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cl.Points(np.concatenate([circle(40), [(2.5, 0.3)]])).write(tmp_path / "points.csv")
    files = [str(tmp_path / "points.csv"), "-o", str(tmp_path / "out.geojson")]
    commands.main(["reconstruct", *files, "--json"], standalone_mode=False)
    said = json.loads(capsys.readouterr().out)["connection"]
    assert said["outliers"] == [40]
    assert 0 <= said["confidence"] <= 1
    commands.main(["reconstruct", *files, "--confidence"], standalone_mode=False)
    assert "sure as a whole" in capsys.readouterr().err
    features = json.loads((tmp_path / "out.geojson").read_text())["features"]
    assert len(features[0]["properties"]["confidence"]) == 40
