"""Points that differ by rounding, merged."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl

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
