"""Well-known text: the vertices of every geometry in, one geometry a line out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crustline.curves import trace
from crustline.errors import FormatError, FormatWarning, InputError
from crustline.formats import read, write
from crustline.points import Points

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


@pytest.fixture
def read_wkt(tmp_path):
    """Read text as WKT."""

    def read_wkt(text, name="points.wkt", **options):
        (tmp_path / name).write_text(text)
        return read(tmp_path / name, **options)

    return read_wkt


@pytest.mark.parametrize(
    "text",
    [
        "POINT (1 2)\nPOINT (3 4)\n",
        "point(1 2)point(3 4)",
        "POINT (1 2);\nPOINT (3 4);",
        "MULTIPOINT (1 2, 3 4)",
        "MULTIPOINT ((1 2), (3 4))",
        "LINESTRING (1 2, 3 4)",
        "LINESTRING\n(1   2,\n3 4 )",
        "MULTILINESTRING ((1 2, 3 4))",
        "GEOMETRYCOLLECTION (POINT (1 2), LINESTRING EMPTY, GEOMETRYCOLLECTION (POINT (3 4)))",
        "POINT EMPTY\nLINESTRING (1e0 2., +3 .4e1)",
        "MULTIPOINT (EMPTY, (1 2), (3 4))",
    ],
)
def test_the_same_points_in_many_spellings(read_wkt, text):
    points = read_wkt(text)
    assert points.xy.tolist() == [[1, 2], [3, 4]]
    assert (points.z, points.crs) == (None, None)
    assert read_wkt(text, "unknown.geometry").xy.tolist() == [[1, 2], [3, 4]]


@pytest.mark.parametrize(
    "text",
    [
        "POLYGON ((0 0, 4 0, 0 4, 0 0))",
        "LINESTRING (0 0, 4 0, 0 4, 0 0)",
        "MULTIPOLYGON (((0 0, 4 0, 0 4, 0 0)))",
        "TRIANGLE ((0 0, 4 0, 0 4, 0 0))",
    ],
)
def test_the_vertex_that_closes_a_ring_is_left_out(read_wkt, text):
    assert read_wkt(text).xy.tolist() == [[0, 0], [4, 0], [0, 4]]


@pytest.mark.parametrize("text", ["POINT Z (1 2 3)", "POINTZ(1 2 3)", "POINT (1 2 3)"])
def test_heights(read_wkt, text):
    points = read_wkt(text)
    assert (points.xy.tolist(), points.z.tolist()) == ([[1, 2]], [3])


def test_the_reference_system(read_wkt):
    assert read_wkt("SRID=25832;POINT (1 2)\nSRID=25832;POINT (3 4)").crs == "EPSG:25832"
    assert read_wkt("SRID=25832;POINT (1 2)", crs="EPSG:3857").crs == "EPSG:3857"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("POINT (1 2)\nPOINT (1 b)", ["line 2", "'1 b'"]),
        ("POINT (1 2)\nPOINT (nan 2)", ["line 2", "nan"]),
        ("POINT (1 1e999)", ["line 1", "1e999"]),
        ("POINT (1 1_0)", ["line 1", "1_0"]),
        ("POINT (1)", ["line 1", "'1'"]),
        ("SRID=" + "1" * 5000 + ";POINT (1 2)", ["line 1", "'SRID'"]),
        ("POINT M (1 2 3)", ["line 1", "measures"]),
        ("POINT ZM (1 2 3 4)", ["measures"]),
        ("POINT (1 2", ["line 1"]),
        ("POLYGON ((1 2, 3 4)", ["line 1", "')'"]),
        ("POLYGON (1 2, 3 4)", ["line 1", "'('"]),
        ("LINESTRING (1 2, , 3 4)", ["line 1"]),
        ("CIRCLE (1 2)", ["line 1", "'CIRCLE'"]),
        ("POINT", ["line 1", "the end"]),
        ("POINT (1 2)\n?", ["line 2", "'?'"]),
        ("SRID=1;POINT (1 2)\nSRID=2;POINT (1 2)", ["line 2", "SRID 2"]),
        ("GEOMETRYCOLLECTION (" * 5000, ["line 1"]),
    ],
)
def test_what_does_not_fit_is_named(read_wkt, text, words):
    with pytest.raises(FormatError) as caught:
        read_wkt(text)
    for word in ["points.wkt", *words]:
        assert word in str(caught.value)
    assert "\n" not in str(caught.value)


def test_heights_that_some_positions_lack_are_left_out(read_wkt):
    with pytest.warns(FormatWarning, match="no height"):
        assert read_wkt("POINT (1 2)\nPOINT (1 2 3)").z is None


def test_nothing_is_written_and_read(tmp_path):
    write(Points([]), tmp_path / "none.wkt")
    assert (tmp_path / "none.wkt").read_text() == "GEOMETRYCOLLECTION EMPTY\n"
    assert len(read(tmp_path / "none.wkt")) == 0


def test_columns_cannot_be_chosen(read_wkt):
    with pytest.raises(InputError, match="columns"):
        read_wkt("POINT (1 2)", columns=("x", "y"))


def lake():
    outline = [(0, 0), (9, 0), (0, 9), (2, 2), (3, 2), (2, 3), (20, 0), (21, 0.1), (30, 0), (31, 0)]
    edges = [(0, 1), (1, 2), (0, 2), (3, 4), (4, 5), (3, 5), (6, 7)]
    return trace(Points(outline, crs="EPSG:25832"), edges)


def test_each_curve_is_a_line(tmp_path):
    write(lake(), tmp_path / "curves.wkt")
    assert (tmp_path / "curves.wkt").read_text().splitlines() == [
        "SRID=25832;LINESTRING (0.0 0.0, 9.0 0.0, 0.0 9.0, 0.0 0.0)",
        "SRID=25832;LINESTRING (2.0 2.0, 3.0 2.0, 2.0 3.0, 2.0 2.0)",
        "SRID=25832;LINESTRING (20.0 0.0, 21.0 0.1)",
        "SRID=25832;MULTIPOINT ((30.0 0.0), (31.0 0.0))",
    ]


def test_polygons_have_their_holes_the_other_way_round(tmp_path):
    write(lake(), tmp_path / "curves.wkt", polygons=True)
    assert (tmp_path / "curves.wkt").read_text().splitlines()[0] == (
        "SRID=25832;POLYGON ((0.0 0.0, 9.0 0.0, 0.0 9.0, 0.0 0.0), "
        "(2.0 2.0, 2.0 3.0, 3.0 2.0, 2.0 2.0))"
    )


@given(st.lists(st.tuples(FLOATS, FLOATS, FLOATS), min_size=1), st.booleans())
def test_reading_gives_back_what_was_written(tmp_path_factory, rows, heights):
    table = np.array(rows)
    points = Points(table[:, :2], z=table[:, 2] if heights else None)
    path = tmp_path_factory.mktemp("wkt") / "points.wkt"
    points.write(path)
    again = read(path)
    assert again.xy.tobytes() == points.xy.tobytes()
    assert (again.z is None) == (not heights)
    assert not heights or again.z.tobytes() == points.z.tobytes()
