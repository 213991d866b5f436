"""Columns of text: what is found in them, what is refused by name, and what is written."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crustline.curves import trace
from crustline.errors import FormatError, FormatWarning
from crustline.formats import read, write
from crustline.points import Points

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


@pytest.fixture
def read_text(tmp_path):
    """Read text, or bytes, from a file with some name."""

    def read_text(text, name="points.csv", **options):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read(path, **options)

    return read_text


@pytest.mark.parametrize(
    "text",
    [
        "x,y\n1,2\n3,4.5\n",
        "x\ty\n1\t2\n3\t4.5\n",
        "x;y\n1;2\n3;4.5\n",
        "x;y\n1;2\n3;4,5\n",
        "x y\n1 2\n3 4.5\n",
        "  x   y\n 1\t 2 \n\n3   4.5",
        "1,2\n3,4.5\n",
        "1 2\n3 4.5",
        "1, 2\n3, 4.5\n",
        "x,y\r\n1,2\r\n3,4.5\r\n",
        "x,y\r1,2\r3,4.5\r",
        "\ufeffx,y\n1,2\n3,4.5\n",
        "X,Y\n1,2\n3,4.5\n",
        " x , y \n1,2\n3,4.5\n",
        "# made by hand\nx,y\n# and more\n1,2\n3,4.5\n",
        "# x y\n1 2\n3 4.5\n",
        "1 2 # first\n3 4.5 # second\n",
        '"x","y"\n"1","2"\n3,4.5\n',
        "x,y\n1e0,2E+0\n+3.,.45e1\n",
        "\n\n1,2\n\n   \n3,4.5\n\n",
        "x,y,\n1,2,\n3,4.5,\n",
        "Lon,Lat\n1,2\n3,4.5\n",
        "latitude,longitude\n2,1\n4.5,3\n",
        "Northing,Easting\n2,1\n4.5,3\n",
        "N;E\n2;1\n4.5;3\n",
        "y,x,2019\n2,1,0\n4.5,3,0\n",
    ],
)
def test_the_same_points_in_many_spellings(read_text, text):
    assert read_text(text).xy.tolist() == [[1, 2], [3, 4.5]]


@pytest.mark.parametrize("name", ["p.csv", "p.tsv", "p.xyz", "p.txt", "p.dat", "p", "p.unknown"])
def test_the_suffix_does_not_matter_for_text(read_text, name):
    assert read_text("1 2 3\n4 5 6\n", name).z.tolist() == [3, 6]


def test_utf_16_is_read(read_text):
    assert read_text("x,y\n1,2\n".encode("utf-16")).xy.tolist() == [[1, 2]]


@pytest.mark.parametrize("height", ["z", "Elevation", "HEIGHT"])
def test_heights_are_found(read_text, height):
    points = read_text(f"id,{height},y,x\n7,3,2,1\n8,6,5,4\n")
    assert points.xy.tolist() == [[1, 2], [4, 5]]
    assert points.z.tolist() == [3, 6]
    assert list(points.columns) == ["id"]


def test_other_columns_keep_their_type_and_order(read_text):
    text = "code,x,name,y,count,share,big\n"
    text += '00123,1,"a, ""b""",2,7,0.5,9007199254740993\n'
    text += "00124,3,,4,-8,nan,1\n"
    columns = read_text(text).columns
    assert list(columns) == ["code", "name", "count", "share", "big"]
    assert columns["code"].tolist() == ["00123", "00124"]
    assert columns["name"].tolist() == ['a, "b"', ""]
    assert columns["count"].tolist() == [7, -8]
    assert columns["count"].dtype == np.int64
    assert columns["share"].tolist()[0] == 0.5
    assert np.isnan(columns["share"][1])
    assert columns["big"].tolist() == [9007199254740993, 1]


def test_numbers_only_columns_keep_their_type(read_text):
    columns = read_text("x,y,id,t,code\n1,2,3,4.0,05\n1,2,4,5.0,06\n").columns
    assert columns["id"].dtype == np.int64
    assert columns["t"].dtype == np.float64
    assert columns["code"].tolist() == ["05", "06"]


@pytest.mark.parametrize(
    "columns", [("b", "a"), (2, 1), ("2", "1"), ["B", "A"], ("b", 1), ("b", "a", "c")]
)
def test_columns_can_be_chosen(read_text, columns):
    points = read_text("c,a,b\n9,2,1\n9,4,3\n", columns=columns)
    assert points.xy.tolist() == [[1, 2], [3, 4]]
    assert points.names == ("b", "a")
    assert (points.z is None) == (len(columns) == 2)


def test_a_header_alone_is_no_points(read_text):
    with pytest.warns(FormatWarning, match="no rows"):
        points = read_text("x,y,name\n")
    assert points.xy.shape == (0, 2)
    assert points.columns["name"].shape == (0,)


def test_the_crs_can_be_given(read_text):
    assert read_text("1,2", crs="urn:ogc:def:crs:EPSG::25832").crs == "EPSG:25832"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["empty"]),
        (" \n\n", ["empty"]),
        ("# only a comment\n", ["comments"]),
        ("x,y\n1,2\n3,abc\n", ["line 3", "'y'", "'abc'"]),
        ("# note\nx,y\n\n1,2\n3,abc\n", ["line 5", "'y'", "'abc'"]),
        ("x,y\n1,2\n,4\n", ["line 3", "'x'", "missing"]),
        ("x,y\n1,2\n3\n", ["line 3", "1 column,", "not 2"]),
        ("x,y\n1,2\n3,4,5\n", ["line 3", "3 columns", "not 2"]),
        ("1 2\n3 4\n5\n", ["line 3", "1 column"]),
        ("x,y\n1,nan\n", ["line 2", "'y'", "'nan'"]),
        ("x,y\n1,2\n-inf,2\n", ["line 3", "'x'", "'-inf'"]),
        ("x,y\n1,1e999\n", ["line 2", "'1e999'"]),
        ("x,y\n1_0,2\n", ["line 2", "'1_0'"]),
        ("x,y,z\n1,2,\n", ["line 2", "'z'", "missing"]),
        ("oops,2\n3,4\n", ["line 1", "'oops 2'", "--skip-lines"]),
        ("a,b,c\n1,2,3\n", ["'a', 'b', 'c'", "columns"]),
        ("x,y,x\n1,2,3\n", ["'x'", "more than once"]),
        ("1\n2\n", ["line 1", "one column"]),
        ("x,y\n1,2\n3,4j\n", ["line 3", "'4j'"]),
        (b"x,y\n1,2\n\xff\xfe,4\n", ["line 3", "UTF-8"]),
        (b"\x00\x01\x02\x03", ["points.csv"]),
    ],
)
def test_what_does_not_fit_is_named(read_text, text, words):
    with pytest.raises(FormatError) as caught:
        read_text(text)
    message = str(caught.value)
    assert "points.csv" in message
    assert "\n" not in message
    for word in words:
        assert word in message


@pytest.mark.parametrize("columns", [("q", "x"), (0, 9), (-1, 0), ("x", "9")])
def test_unknown_columns_are_named_with_those_there_are(read_text, columns):
    with pytest.raises(FormatError, match=r"has no column .*'x', 'y', 'name'"):
        read_text("x,y,name\n1,2,a\n", columns=columns)


def test_a_bad_cell_behind_the_first_block_is_named(read_text):
    rows = [f"{k},{k},n" for k in range(70_000)]
    rows[69_000] = "1,?,n"
    with pytest.raises(FormatError, match=r"line 69002, column 'y': '\?'"):
        read_text("x,y,name\n" + "\n".join(rows))


def test_a_hundred_thousand_rows_are_read(read_text):
    rows = np.random.default_rng(0).random((100_000, 2))
    text = "x,y\n" + "\n".join(f"{x!r},{y!r}" for x, y in rows.tolist())
    assert np.array_equal(read_text(text), rows)


# Writing


def triangle_and_more():
    points = Points(
        [(0, 0), (1, 0), (0, 1), (5, 5), (6, 5), (9, 9)],
        z=[1, 2, 3, 4, 5, 6],
        columns={"name": ["a", "b,c", 'd"e', "", " f", "#g"], "row": [10, 11, 12, 13, 14, 15]},
    )
    return trace(points, [(0, 1), (1, 2), (0, 2), (3, 4)])


def test_csv_has_a_row_for_each_place_in_a_curve(tmp_path):
    path = tmp_path / "curves.csv"
    triangle_and_more().write(path)
    lines = path.read_text().splitlines()
    assert lines[0] == "curve,order,row,x,y,z,closed,name,input_row"
    assert lines[1] == "0,0,0,0.0,0.0,1.0,1,a,10"
    assert lines[2] == '0,1,1,1.0,0.0,2.0,1,"b,c",11'
    assert lines[4] == "1,0,3,5.0,5.0,4.0,0,,13"
    assert lines[6] == '-1,0,5,9.0,9.0,6.0,0,"#g",15'


@pytest.mark.parametrize("name", ["curves.csv", "curves.tsv"])
def test_a_result_can_be_read_again(tmp_path, name):
    curves = triangle_and_more()
    write(curves, tmp_path / name)
    points = read(tmp_path / name)
    rows = points.columns["row"]
    assert points.columns["order"].tolist() == [0, 1, 2, 0, 1, 0]
    assert np.array_equal(points, np.asarray(curves.points)[rows])
    assert np.array_equal(points.z, curves.points.z[rows])
    assert np.array_equal(points.columns["name"], curves.points.columns["name"][rows])
    assert np.array_equal(points.columns["input_row"], curves.points.columns["row"][rows])


@given(st.lists(st.tuples(FLOATS, FLOATS, st.text("a ,\t\"'#;\n0.1é")), min_size=1))
def test_reading_gives_back_what_was_written(tmp_path_factory, rows):
    points = Points(
        [row[:2] for row in rows], columns={"text": np.array([row[2] for row in rows], dtype=str)}
    )
    path = tmp_path_factory.mktemp("csv") / "points.csv"
    points.write(path)
    again = read(path, missing=())
    assert again.xy.tobytes() == points.xy.tobytes()
    if again.columns["text"].dtype.kind == "O":  # else all of them were numbers
        assert again.columns["text"].tolist() == points.columns["text"].tolist()


def header_work(columns):
    """Processor seconds of reading a table of so many columns, the least of three."""
    text = "\n".join(",".join(f"{mark}{k}" for k in range(columns)) for mark in ("c", "", "1"))
    seconds = []
    for _ in range(3):
        start = time.process_time()
        read(text.encode(), format="csv", columns=["c0", "c1"])
        seconds.append(time.process_time() - start)
    return min(seconds)


def test_work_is_linear_in_the_columns():
    """20,000 header cells took 23 s, 100,000 over a minute."""
    assert header_work(40_000) < 3 * 8 * header_work(5_000)


def test_long_names_are_looked_at_once():
    """A unit was looked for at each of their characters."""
    for long in (" " * 100_000, "[" * 100_000):
        points = read(f"x{long}x,y,x\n1,2,3\n4,5,6\n".encode(), format="csv")
        assert points.xy.tolist() == [[3, 2], [6, 5]]
