"""What is known of the curves is so in the answer, and what contradicts itself is named."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl

LINE = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (2, 9)]
Pairs = set[tuple[int, int]]


def pairs(edges: Any) -> Pairs:
    return {(i, j) for i, j in np.asarray(edges).reshape(-1, 2).tolist()}


def some_path_edges(rng: np.random.Generator, candidates: np.ndarray, count: int) -> np.ndarray:
    """Some of the candidates, at most two a point."""
    degree: dict[int, int] = {}
    chosen = []
    for i, j in rng.permutation(candidates).tolist()[:count]:
        if degree.get(i, 0) < 2 and degree.get(j, 0) < 2:
            chosen.append((i, j))
            degree[i], degree[j] = degree.get(i, 0) + 1, degree.get(j, 0) + 1
    return np.sort(np.array(chosen, np.int64).reshape(-1, 2), axis=1)


@given(seed=st.integers(0, 2**32 - 1), grid=st.booleans())
def test_edges_to_keep_are_in_and_forbidden_ones_out(seed: int, grid: bool) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((60, 2))
    if grid:
        points = np.unique(np.round(points * 12), axis=0)
    candidates = cl.Delaunay(points).edges
    keep = some_path_edges(rng, candidates, 25)
    forbid = sorted(pairs(candidates) - pairs(keep))[::3]
    edges = cl.connect(points, keep=keep, forbid=forbid)
    assert pairs(keep) <= pairs(edges)
    assert not pairs(forbid) & pairs(edges)
    assert np.bincount(edges.ravel()).max(initial=0) <= 2


def test_an_edge_to_keep_need_not_be_a_delaunay_edge() -> None:
    angle = np.arange(20) * np.pi / 10
    circle = np.stack([np.cos(angle), 1.01 * np.sin(angle)], axis=1)
    assert [3, 14] not in cl.Delaunay(circle).edges.tolist()
    assert [3, 14] in cl.connect(circle, keep=[(14, 3)]).tolist()


def test_a_hint_wins_over_the_theorem() -> None:
    angle = np.arange(60) * np.pi / 30
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert cl.certify(circle).guaranteed
    assert [7, 8] not in cl.connect(circle, forbid=[(8, 7)]).tolist()
    assert [5, 9] in cl.connect(circle, keep=[(5, 9)]).tolist()


@given(seed=st.integers(0, 2**32 - 1))
def test_curves_go_through_no_end(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((50, 2))
    ends = rng.choice(50, 6, replace=False)
    degrees = np.bincount(cl.connect(points, ends=ends).ravel(), minlength=50)
    assert degrees[ends].max() <= 1


def test_no_edge_is_longer_than_the_longest() -> None:
    points = np.random.default_rng(2).random((300, 2))
    edges = cl.connect(points, max_edge=0.05)
    assert np.hypot(*(points[edges[:, 0]] - points[edges[:, 1]]).T).max() <= 0.05
    far = [*[(x, 0.0) for x in range(8)], *[(x, 0.0) for x in range(11, 19)]]
    assert [7, 8] in cl.connect(far, keep=[(7, 8)]).tolist()
    assert [7, 8] not in cl.connect(far, max_edge="2x").tolist()


def test_small_curves_are_left_out() -> None:
    points = [*[(x, 0.0) for x in range(8)], *[(x, 50.0) for x in range(5)]]
    assert [len(each) for each in cl.trace(points, cl.connect(points))] == [8, 5]
    assert [len(each) for each in cl.reconstruct(points, min_points=6)] == [8]


def test_repeated_points_are_known_by_any_of_their_rows() -> None:
    points = [*LINE, (2, 9), (4, 0)]
    assert [4, 5] in cl.connect(points, keep=[(7, 6)]).tolist()


@pytest.mark.parametrize(
    ("hints", "words"),
    [
        ({"keep": [(0, 1), (0, 2), (0, 3)]}, "keep: 3 edges meet at row 0"),
        ({"keep": [(0, 1)], "forbid": [(1, 0)]}, r"keep and forbid .* edge \[0, 1\] is in both"),
        ({"keep": [(0, 1), (1, 2)], "ends": [1]}, "keep and ends .* meet at 1"),
        ({"keep": [(4, 5)], "max_edge": 2}, r"keep and max_edge .* \[4, 5\] is 9.2"),
        ({"max_edge": "wide"}, "max_edge must be a length, or a multiple"),
        ({"max_edge": -1}, "max_edge must be positive"),
        ({"max_edge": "0x"}, "max_edge must be positive"),
        ({"min_points": 0}, "min_points must be a whole number"),
        ({"ends": [77]}, "ends: 77 is none of the 6 points"),
        ({"keep": [(0, 99)]}, r"keep: row 0 is \[0, 99\], but there are 6 points"),
        ({"forbid": "all"}, "forbid: "),
    ],
)
def test_what_does_not_fit_is_named(hints: dict[str, Any], words: str) -> None:
    with pytest.raises(cl.InputError, match=words):
        cl.connect(LINE, **hints)


def test_rows_mean_nothing_within_groups() -> None:
    with pytest.raises(cl.InputError, match="keep: rows of all points mean nothing"):
        cl.by_group(LINE, [0, 0, 0, 1, 1, 1], keep=[(0, 1)])
    assert cl.by_group(LINE, [0, 0, 0, 1, 1, 1], max_edge=1.5).tolist() == [[0, 1], [1, 2], [3, 4]]


# --- Counts, rings, and no point left out --------------------------------------------------------


def circle(count: int, center: tuple[float, float] = (0, 0), degrees: float = 360) -> np.ndarray:
    angle = np.radians(np.arange(count) * degrees / count)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1) + center


@given(seed=st.integers(0, 2**32 - 1), grid=st.booleans())
def test_no_point_is_left_out(seed: int, grid: bool) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((rng.integers(2, 90), 2))
    if grid:
        points = np.unique(np.round(points * 9), axis=0)
    if len(points) > 1:
        degrees = np.bincount(cl.connect(points, every_point=True).ravel(), minlength=len(points))
        assert degrees.min() >= 1
        assert degrees.max() <= 2


@given(seed=st.integers(0, 2**32 - 1), every=st.booleans())
def test_all_curves_are_rings(seed: int, every: bool) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((rng.integers(8, 90), 2))
    said = ""
    try:
        edges = cl.connect(points, closed=True, every_point=every)
    except cl.InputError as error:
        said = str(error)
    if said:
        # Not every triangulation has rings through all points, and not all of those are found.
        assert every
        assert said.startswith(("every_point: ", "closed: "))
        return
    degrees = np.bincount(edges.ravel(), minlength=len(points))
    assert set(degrees.tolist()) <= ({2} if every else {0, 2})


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 6))
def test_the_number_of_curves_is_reached(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).random((50, 2))
    assert len(cl.reconstruct(points, components=count)) == count


def test_an_open_arc_is_closed_if_it_is_known_to_be_a_ring() -> None:
    arc = circle(60, degrees=240)
    assert not cl.reconstruct(arc)[0].closed
    (ring,) = cl.reconstruct(arc, closed=True)
    assert ring.closed
    assert len(ring) == 60


def test_curves_are_joined_and_split_where_it_is_cheapest() -> None:
    """Where the gap is, and where the step is longest, though longer edges are elsewhere."""
    dashes = [*[(float(x), 0.0) for x in range(10)], *[(float(x), 0.0) for x in range(16, 26)]]
    assert len(cl.reconstruct(dashes)) == 2
    assert [9, 10] in cl.connect(dashes, components=1).tolist()
    coarse = [(30.0 + 3 * k, 20.0) for k in range(12)]
    line = [*[(float(x), 0.0) for x in range(10)], *[(x + 0.9, 0.0) for x in range(10, 20)]]
    points = [*line, *coarse]
    assert len(cl.reconstruct(points)) == 2
    assert [9, 10] not in cl.connect(points, components=3).tolist()


def test_two_rings_become_one_ring_or_three() -> None:
    two = np.concatenate([circle(36), circle(36, (2.5, 0))])
    assert [each.closed for each in cl.reconstruct(two)] == [True, True]
    assert [each.closed for each in cl.reconstruct(two, components=1, closed=True)] == [True]
    rings = cl.reconstruct(two, components=3, closed=True)
    assert [each.closed for each in rings] == [True] * 3


@pytest.mark.parametrize(
    ("hints", "words"),
    [
        ({"closed": True, "ends": [1]}, "closed and ends .* no end at row 1"),
        ({"every_point": True, "min_points": 3}, "every_point and min_points=3"),
        ({"components": 4}, "components=4: 6 points are too few .* pass 3 at most"),
        ({"components": 3, "closed": True}, "too few for so many rings: pass 2"),
        ({"components": -1}, "components must be a whole number"),
        ({"closed": "yes"}, "closed must be True or False"),
        ({"every_point": True, "forbid": [(5, k) for k in range(5)]}, "every_point: .* row 5"),
        ({"ends": [5], "max_edge": 2}, "ends: no edge is left for row 5"),
        ({"closed": True, "keep": [(0, 1)], "max_edge": 1}, "closed: no way to close"),
        ({"keep": [(4, 5)], "min_points": 9}, "keep and min_points=9 contradict each other"),
    ],
)
def test_contradictions_are_named(hints: dict[str, Any], words: str) -> None:
    with pytest.raises(cl.InputError, match=words):
        cl.connect(LINE, **hints)


def test_junctions() -> None:
    bar = [(float(x), 0.0) for x in range(-8, 9)]
    tee = [*bar, *[(0.0, float(y)) for y in range(1, 9)]]
    assert cl.reconstruct(tee).branches.tolist() == []
    made = cl.reconstruct(tee, junctions=True)
    assert made.branches.tolist() == [8]
    assert len(made) == 3
    cross = np.array([*tee, *[(0.0, -float(y)) for y in range(1, 9)]])
    cross += np.random.default_rng(0).uniform(-0.02, 0.02, cross.shape)  # off an exact tie
    made = cl.reconstruct(cross, junctions=True)
    assert [len(each) for each in made] == [9, 9, 9, 9]
    assert made.branches.tolist() == [8]


@pytest.mark.parametrize("turn", [0.0, 0.3, 2.0])
def test_three_ends_that_meet_are_joined(turn: float) -> None:
    """Two arms ended beside the point where all three meet, for it was the end of the third."""
    angles = turn + np.radians([0, 115, 240])
    arms = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    steps = np.arange(1, 13)[:, None]
    star = np.concatenate([[(0.0, 0.0)], *(steps * arm for arm in arms)])
    made = cl.reconstruct(star, junctions=True)
    assert made.branches.tolist() == [0]
    assert [len(each) for each in made] == [13, 13, 13]
