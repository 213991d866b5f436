"""Points that differ by rounding, merged."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl
from crustline.cli import commands
from crustline.errors import FormatWarning
from crustline.merge import near_tolerance

Array = np.ndarray
SHIFT = np.array([1e-9, 0])


def octagon() -> Array:
    angle = np.arange(8) * np.pi / 4
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def test_octagon_and_its_shifted_copy_are_one_ring_of_8() -> None:
    both = np.concatenate([octagon(), octagon() + SHIFT])
    near = cl.merge(both, 1e-6)
    assert near.rows.tolist() == list(range(8))
    assert near.merged.tolist() == [[row + 8, row] for row in range(8)]
    curves = cl.trace(near.points, cl.connect(near.points))
    assert [(curve.closed, len(curve)) for curve in curves] == [(True, 8)]


def test_section_of_a_mesh_becomes_its_outline() -> None:
    """Each point is there once for each triangle that was cut, rounded differently."""
    rng = np.random.default_rng(0)
    angle = np.arange(60) * np.pi / 30
    outline = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    section = rng.permutation(np.repeat(outline, 2, axis=0) + rng.uniform(-1e-9, 1e-9, (120, 2)))
    near = cl.merge(section, 1e-7)
    curves = cl.trace(near.points, cl.connect(near.points))
    assert [(curve.closed, len(curve)) for curve in curves] == [(True, 60)]


@given(seed=st.integers(0, 2**32 - 1), tolerance=st.floats(0, 1.2))
def test_groups_are_those_of_the_definition(seed: int, tolerance: float) -> None:
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 12, (rng.integers(0, 40), 2)).astype(float)
    between = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    group = np.arange(len(points))
    for _ in points:
        group = np.where(between <= tolerance, group, len(points)).min(axis=1, initial=len(points))
    wide = any(between[np.ix_(group == g, group == g)].max() > 3 * tolerance for g in set(group))
    if wide:
        with pytest.raises(cl.InputError, match="in one chain of points"):
            cl.merge(points, tolerance)
        return
    near = cl.merge(points, tolerance)
    smallest = [
        min(np.flatnonzero(group == g).tolist(), key=lambda row: (*points[row], row))
        for g in set(group.tolist())
    ]
    assert near.rows.tolist() == sorted(smallest)
    assert all(group[row] == group[kept] for row, kept in near.merged.tolist())
    assert len(near.rows) + len(near.merged) == len(points)


def test_order_of_rows_does_not_matter() -> None:
    rng = np.random.default_rng(1)
    points = np.concatenate([octagon(), octagon() + SHIFT])
    order = rng.permutation(16)
    one, other = cl.merge(points, 1e-6), cl.merge(points[order], 1e-6)
    assert {*map(tuple, one.points.xy.tolist())} == {*map(tuple, other.points.xy.tolist())}


@pytest.mark.parametrize("tolerance", [-1, float("nan"), "1", None])
def test_bad_tolerance_is_named(tolerance: object) -> None:
    with pytest.raises(cl.InputError, match="tolerance"):
        cl.merge(octagon(), tolerance)  # type: ignore[arg-type]


# --- In a reconstruction, and on the command line ------------------------------------------------


def section() -> Array:
    """The section of a mesh: each point once for each triangle, rounded differently."""
    rng = np.random.default_rng(0)
    angle = np.arange(60) * np.pi / 30
    outline = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    return rng.permutation(np.repeat(outline, 2, axis=0) + rng.uniform(-1e-9, 1e-9, (120, 2)))


def test_reconstruct_merges_and_keeps_the_rows() -> None:
    points = section()
    made = cl.Reconstruction(points, merge=1e-7)
    (ring,) = made.curves
    assert ring.closed
    assert len(ring) == 60
    near = cl.merge(points, 1e-7)
    assert np.array_equal(made.merged, near.merged)
    assert set(ring.indices.tolist()) == set(near.rows.tolist())
    assert np.array_equal(made.curves.points.xy, points)
    assert np.array_equal(made.edges, near.rows[cl.connect(near.points)])
    assert np.array_equal(made.connection.edges, made.edges)
    assert len(made.connection.outliers) == 0
    assert len(made.connection.repeated) == 60
    assert np.isfinite(made.local_feature_size[ring.indices]).all()
    assert made.certificate.guaranteed == cl.certify(near.points).guaranteed
    assert made != cl.Reconstruction(points)


def test_merging_works_with_any_method_and_keeps_what_points_carry() -> None:
    points = cl.Points(section(), columns={"number": range(120)}, crs="EPSG:25832")
    curves = cl.reconstruct(points, cl.crust, merge=1e-7)
    assert [(each.closed, len(each)) for each in curves] == [(True, 60)]
    assert curves.points == points


def test_octagon_and_its_shifted_copy_are_warned_of_without_merging(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And the tolerance that the warning names makes one ring of 8."""
    both = np.concatenate([octagon(), octagon() + SHIFT])
    cl.Points(both).write(tmp_path / "both.csv")
    with pytest.warns(FormatWarning, match="add --merge 1.1e-09"):
        commands.main(["reconstruct", str(tmp_path / "both.csv")], standalone_mode=False)
    (ring,) = cl.reconstruct(both, merge=1.1e-9)
    assert (ring.closed, len(ring)) == (True, 8)


def test_section_of_a_mesh_becomes_its_outline_in_one_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cl.Points(section()).write(tmp_path / "section.csv")
    files = [str(tmp_path / "section.csv"), "-o", str(tmp_path / "outline.geojson")]
    commands.main(["reconstruct", *files, "--merge", "1e-7"], standalone_mode=False)
    assert "60 merged rows, 1 ring" in capsys.readouterr().err
    (curve,) = cl.read_curves(tmp_path / "outline.geojson")
    assert (curve.closed, len(curve)) == (True, 60)


@given(seed=st.integers(0, 2**32 - 1))
def test_a_tolerance_is_named_only_if_it_merges(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((rng.integers(1, 40), 2))
    assert near_tolerance(points) is None
    copies = points[rng.integers(0, len(points), 5)] + rng.uniform(-1, 1, (5, 2)) * 1e-10
    tolerance = near_tolerance(np.concatenate([points, copies]))
    if len(points) > 8:
        assert tolerance is not None
        assert len(cl.merge(np.concatenate([points, copies]), tolerance).rows) < len(points) + 5


def test_clusters_far_apart_are_not_one_point_each() -> None:
    points = np.random.default_rng(0).random((200, 2))
    points[100:] += 1e8
    assert near_tolerance(points) is None
    assert near_tolerance([]) is None
    assert near_tolerance([(1, 1)] * 4) is None


def test_merging_points_of_different_groups_is_refused(tmp_path: Path) -> None:
    cl.Points(octagon(), columns={"part": [0, 1] * 4}).write(tmp_path / "parts.csv")
    arguments = ["reconstruct", str(tmp_path / "parts.csv"), "--by", "part", "--merge", "1"]
    with pytest.raises(cl.InputError, match="--by and --merge exclude each other"):
        commands.main(arguments, standalone_mode=False)
