"""A reconstruction makes each part once, when it is asked for, as the functions make it."""

from __future__ import annotations

import copy
import gc
import pickle
import weakref
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import crustline as cl
from crustline import _core, shapes
from crustline.cli import commands
from crustline.delaunay import Delaunay

PARTS = ("edges", "curves", "medial_axis", "local_feature_size", "certificate")
POINTS = shapes.ellipse(2, 1).point(np.arange(40) / 40)


@pytest.fixture
def triangulations(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many points were triangulated each time that any were."""
    counts: list[int] = []
    make = _core.Delaunay

    def counted(points: Any, *how: Any) -> Any:
        counts.append(len(points))
        return make(points, *how)

    monkeypatch.setattr(_core, "Delaunay", counted)
    return counts


def test_all_parts_and_the_picture_triangulate_once(
    triangulations: list[int], tmp_path: Path
) -> None:
    made = cl.Reconstruction(POINTS)
    assert triangulations == []
    for part in PARTS:
        getattr(made, part)
    everything = list(pytest.importorskip("crustline.plot").LAYERS)
    made.picture(tmp_path / "all.svg", show=everything)
    assert triangulations == [40]


def test_functions_share_one_triangulation(triangulations: list[int]) -> None:
    delaunay = cl.Delaunay(POINTS)
    edges = cl.crust(delaunay)
    for function in (cl.certify, cl.medial_axis, cl.local_feature_size, cl.trace):
        function(delaunay, edges)
    cl.thin(delaunay, edges, r=0.5)
    cl.reconstruct(delaunay, cl.beta_skeleton, beta=1.5)
    assert triangulations == [40]


@pytest.mark.parametrize("command", ["reconstruct", "certify", "medial-axis", "thin", "plot"])
def test_the_command_triangulates_once(
    command: str, triangulations: list[int], tmp_path: Path
) -> None:
    cl.Points(POINTS).write(tmp_path / "points.csv")
    suffix, more = ("svg", ["--show", "lfs,certificate,medial-axis,delaunay,curves"])
    if command != "plot":
        suffix, more = ("csv", ["-r", "0.5"] if command == "thin" else [])
    files = [str(tmp_path / "points.csv"), "-o", str(tmp_path / f"out.{suffix}")]
    commands.main([command, *files, *more], standalone_mode=False)
    assert triangulations == [40]


def test_parts_are_what_the_functions_give() -> None:
    made = cl.Reconstruction(POINTS, cl.beta_skeleton, beta=1.2)
    edges = cl.beta_skeleton(POINTS, 1.2)
    assert np.array_equal(made.edges, edges)
    assert (
        made.curves == cl.trace(POINTS, edges) == cl.reconstruct(POINTS, cl.beta_skeleton, beta=1.2)
    )
    assert made.medial_axis == cl.medial_axis(POINTS, edges)
    assert made.certificate == cl.certify(POINTS, edges)
    assert np.array_equal(made.local_feature_size, cl.local_feature_size(POINTS, edges))
    for part in PARTS:
        assert getattr(made, part) is getattr(made, part)


def test_a_reconstruction_is_a_value() -> None:
    made = cl.Reconstruction(cl.Points(POINTS, crs="EPSG:25832"), cl.beta_skeleton, beta=1.2)
    assert repr(made) == "<Reconstruction: 40 points by beta_skeleton>"
    assert made._repr_svg_() == made.curves._repr_svg_()
    for duplicate in (copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made))):
        assert duplicate == made
        assert duplicate.points.crs == "EPSG:25832"
        assert duplicate.curves == made.curves
    assert made != cl.Reconstruction(made.points)
    assert made != cl.Reconstruction(made.points, cl.beta_skeleton, beta=1.3)
    assert made != POINTS.tolist()


def test_the_method_gets_the_triangulation_and_may_give_any_array_of_edges() -> None:
    seen: list[Any] = []

    def method(points: Any) -> Any:
        seen.append(points)
        return [(len(np.asarray(points)) - 1, 0)]

    assert cl.reconstruct(POINTS, method).edges.tolist() == [[0, 39]]
    assert isinstance(seen[0], Delaunay)


@pytest.mark.parametrize(
    ("method", "parameters", "words"),
    [
        ("crust", {}, "write method=cl.crust"),
        ("nn-crust", {}, "write method=cl.nn_crust"),
        ("some other", {}, "write method=cl.connect"),
        (lambda: [(0, 1)], {}, "takes no points"),
        (None, {}, "write method=cl.connect"),
        (cl.crust, {"beta": 2}, "crust has no parameter 'beta': it has none"),
        (cl.beta_skeleton, {"alpha": 2}, "no parameter 'alpha': it has beta, kind"),
        (cl.alpha_shape, {}, "alpha_shape needs radius: pass radius=…"),
        (lambda points: [(0, 1.5)], {}, "edges: row 0"),
        (lambda points: [(0, 40)], {}, r"edges: row 0 is \[0, 40\], but there are 40 points"),
        (lambda points: None, {}, "edges: "),
    ],
)
def test_what_does_not_fit_is_named(method: Any, parameters: dict[str, Any], words: str) -> None:
    with pytest.raises(cl.InputError, match=words):
        cl.reconstruct(POINTS, method, **parameters)


def test_threads_and_progress_reach_every_part() -> None:
    points = np.random.default_rng(3).random((20_000, 2))
    stages: list[str] = []
    delaunay = cl.Delaunay(points, threads=1, progress=lambda stage, done: stages.append(stage))
    made = cl.Reconstruction(delaunay)
    for part in PARTS:
        stages.clear()
        getattr(made, part)
    other = cl.Reconstruction(cl.Delaunay(points, threads=3))
    assert made.certificate == other.certificate
    assert made.medial_axis == other.medial_axis


def test_nothing_keeps_a_triangulation_alive() -> None:
    gc.disable()
    try:
        delaunay = cl.Delaunay(POINTS)
        results = [cl.certify(delaunay), cl.medial_axis(delaunay), cl.reconstruct(delaunay)]
        cl.local_feature_size(delaunay)
        made = cl.Reconstruction(delaunay)
        results.append(made.certificate)
        first, second = weakref.ref(delaunay), weakref.ref(made)
        del delaunay, made
        assert first() is None
        assert second() is None
        assert len(results) == 4
    finally:
        gc.enable()


def test_the_triangulation_keeps_one_interpolant() -> None:
    delaunay = cl.Delaunay(POINTS)
    for beta in (1.0, 1.2, 1.5, 1.7, 2.0):
        cl.certify(delaunay, cl.beta_skeleton(delaunay, beta))
    assert sorted(delaunay._made) == ["along", "crust", "interpolant"]
