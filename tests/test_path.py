"""The one path that every drawing is made from, and the one walk over curves."""

from __future__ import annotations

import numpy as np
import pytest

from crustline import Curves, trace
from crustline.path import CLOSE, CUBIC, LINE, MOVE, Path

SQUARE = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)])
PIECES = np.array([[(0, 0), (1, 0), (1, 1), (2, 1)], [(2, 1), (3, 1), (3, 0), (0, 0)]], float)


def lake() -> Curves:
    """An outline around a hole, a line, and a point of no edge."""
    inner = SQUARE / 4 + 0.5
    points = np.concatenate([SQUARE, inner, [(5, 0), (6, 0), (9, 9)]])
    ring = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])
    return trace(points, np.concatenate([ring, ring + 4, [(8, 9)]]))


def test_every_curve_is_in_one_feature():
    curves = lake()
    assert [(each.number, each.kind, each.closed) for each in curves.features()] == [
        (0, "line", True), (1, "line", True), (2, "line", False), (None, "points", False),
    ]  # fmt: skip
    polygon, line, lonely = curves.features(polygons=True)
    assert (polygon.number, polygon.kind, line.number, lonely.number) == (0, "polygon", 1, None)
    assert [part.tolist() for part in polygon.parts] == [[0, 1, 2, 3], [4, 7, 6, 5]]
    rows = np.concatenate([*polygon.parts, *line.parts, *lonely.parts])
    assert sorted(rows.tolist()) == list(range(len(curves.points)))


def test_a_hole_runs_the_other_way_round():
    polygon = next(lake().features(polygons=True))
    x, y = (lake().points.xy[part] for part in polygon.parts)
    areas = [
        np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1)) for p in (x, y)
    ]
    assert areas[0] > 0 > areas[1]


def test_a_path_is_the_same_in_svg_in_commands_and_in_matplotlib():
    outline = pytest.importorskip("matplotlib.path")
    path = Path.joined([Path.through(SQUARE, closed=True), Path.beziers(PIECES, closed=True)])
    assert path.svg() == "M0 0L2 0L2 2L0 2ZM0 0C1 0 1 1 2 1C3 1 3 0 0 0Z"
    assert [verb for verb, _ in path.commands()] == [
        "move", "line", "line", "line", "close", "move", "cubic", "cubic", "close",
    ]  # fmt: skip
    assert [len(at) for _, at in path.commands()] == [1, 1, 1, 1, 0, 1, 3, 3, 0]
    theirs = outline.Path(path.vertices, path.codes)
    kinds = [code for _, code in theirs.iter_segments(simplify=False, curves=True)]
    assert kinds == [MOVE, LINE, LINE, LINE, CLOSE, MOVE, CUBIC, CUBIC, CLOSE]


def test_a_path_of_a_feature_holds_its_parts():
    curves = lake()
    polygon, line, lonely = (
        Path.of_feature(each, curves.points.xy) for each in curves.features(polygons=True)
    )
    assert polygon.svg() == "M0 0L2 0L2 2L0 2ZM0.5 0.5L0.5 1L1 1L1 0.5Z"
    assert (line.svg(), lonely.svg()) == ("M5 0L6 0", "M9 9h0")


def test_no_strokes_are_no_text():
    assert Path.joined([]).svg() == ""
    assert list(Path.dots(np.empty((0, 2))).commands()) == []
