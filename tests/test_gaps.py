"""Closing gaps: every edge that was given is kept, and no point gets more than two by others."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import crustline as cl
from crustline.cli import main


def ring(n: int, radius: float = 10.0) -> list[tuple[float, float]]:
    t = np.arange(n) * (2 * np.pi / n)
    return list(zip(radius * np.cos(t), radius * np.sin(t), strict=True))


@given(st.data())
def test_given_edges_are_kept_and_others_only_fill_up(data: st.DataObject) -> None:
    places = st.tuples(st.integers(0, 9), st.integers(0, 9))
    points = data.draw(st.lists(places, min_size=2, max_size=12, unique=True))
    row = st.integers(0, len(points) - 1)
    pairs = data.draw(st.lists(st.tuples(row, row).filter(lambda p: p[0] != p[1]), max_size=12))
    known = {(min(pair), max(pair)) for pair in pairs}
    made = set(map(tuple, cl.close_gaps(points, sorted(known) or np.zeros((0, 2), int)).tolist()))
    assert known <= made
    degrees = np.bincount(np.array(sorted(known) or [(0, 0)]).ravel(), minlength=len(points))
    total = np.bincount(np.array(sorted(made) or [(0, 0)]).ravel(), minlength=len(points))
    if known and made:
        assert (total <= np.maximum(degrees, 2)).all()


def test_without_known_edges_it_is_connect() -> None:
    points = ring(20)
    none = np.zeros((0, 2), int)
    np.testing.assert_array_equal(cl.close_gaps(points, none), cl.connect(points))


@pytest.fixture
def drawing(tmp_path: Path) -> Path:
    """A ring of loose segments and points with gaps, and three lines that meet in a point."""
    made = ezdxf.new()
    space, places = made.modelspace(), ring(20)
    for k in (0, 1, 2, 4, 5, 6, 9, 10, 13, 14, 15):
        space.add_line(places[k], places[(k + 1) % 20])
    for k in (8, 12, 17, 18, 19):
        space.add_point(places[k])
    for end in ((-3, 0), (2, 3), (2, -3)):
        space.add_line((0, 0), end)
    made.saveas(tmp_path / "loose.dxf")
    return tmp_path / "loose.dxf"


def test_a_drawing_keeps_its_lines_and_gets_its_gaps_closed(
    drawing: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """openscad #448: the laser cutter wants closed polylines, not loose lines."""
    output = drawing.with_name("closed.dxf")
    with pytest.raises(SystemExit) as caught:
        main(["reconstruct", str(drawing), "--edges-from-file", "-o", str(output)])
    assert caught.value.code == 0
    assert "1 ring, 3 open curves, 1 branch, 0 isolated points" in capsys.readouterr().err
    written = ezdxf.readfile(output)
    assert not written.audit().errors
    found = [(each.dxf.layer, each.closed, len(each)) for each in written.modelspace()]
    assert sorted(found) == [("OPEN", False, 2)] * 3 + [("RINGS", True, 20)]


@pytest.mark.parametrize("more", [["--by", "layer"], ["--method", "crust"], ["--fit"]])
def test_what_does_not_go_with_edges_from_the_file_is_refused(
    drawing: Path, capsys: pytest.CaptureFixture[str], more: list[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["reconstruct", str(drawing), "--edges-from-file", *more])
    assert caught.value.code == 2
    assert "leave one away" in capsys.readouterr().err
