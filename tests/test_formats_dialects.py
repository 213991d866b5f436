"""Text as it is in the wild: each dialect is read as it is meant, or refused by name."""

from __future__ import annotations

import warnings
from typing import Any

import pytest

from crustline import FormatError, InputError, Points, read
from crustline.errors import FormatWarning

TRIANGLE = [[1.5, 2.5], [3.5, 4.5], [5.5, 2.5]]


def read_text(text: str | bytes, **options: Any) -> Points:
    """Read text without a name; whatever warns is an error."""
    return read(text.encode() if isinstance(text, str) else text, **options)


def read_with_warning(text: str, words: list[str], **options: Any) -> Points:
    """Read text that is doubtful, and find the words in one of the warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        points = read_text(text, **options)
    messages = [str(each.message) for each in caught if each.category is FormatWarning]
    assert any(all(word in message for word in words) for message in messages), messages
    return points


def refused(text: str | bytes, words: list[str], **options: Any) -> None:
    """Assert that text is refused in one sentence that holds the words."""
    with pytest.raises((FormatError, InputError)) as caught:
        read_text(text, **options)
    message = str(caught.value)
    assert "\n" not in message
    assert len(message) < 400
    for word in words:
        assert word in message


BODY = "1.5 2.5\n3.5 4.5\n5.5 2.5\n"

UNDERSTOOD = {
    "airfoil: a title, then columns": "E387\n" + BODY,
    "a title of several words": "Eppler airfoil, smoothed by hand\n" + BODY,
    "a count alone": "3\n" + BODY,
    "qhull: dimension and count": "2\n3\n" + BODY,
    "title and count": "profile\n3\n" + BODY,
    "tekal: comments, block name, size": "* column 1 : x\n* column 2 : y\nL001\n3 2\n" + BODY,
    "Lednicer: two counts": "E387\n  1.  2.\n\n1.5 2.5\n\n3.5 4.5\n5.5 2.5\n",
    "Tecplot": 'TITLE = "t"\nVARIABLES = "X", "Y"\nZONE T="a", I=3, F=POINT\n' + BODY,
    "Tecplot, two zones": 'VARIABLES = "X" "Y"\nZONE\n1.5 2.5\nZONE T="b"\n3.5 4.5\n5.5 2.5\n',
    "GMT: segment headers": "> -Z1\n1.5 2.5\n3.5 4.5\n> -Z2\n5.5 2.5\n",
    "xmgrace: sets end with &": "1.5 2.5\n3.5 4.5\n&\n5.5 2.5\n&\n",
    "comments with %": "% made by hand\n" + BODY,
    "comments with //": "// made by hand\n" + BODY,
    "comments with ;": "; made by hand\n" + BODY,
    "comments with !": "! made by hand\n1.5 2.5\n! more\n3.5 4.5\n5.5 2.5\n",
    "comments with *": "* made by hand\n" + BODY,
    "Excel: sep=;": "sep=;\nx;y\n1,5;2,5\n3,5;4,5\n5,5;2,5\n",
    "units below names": "x,y\n[mm],[mm]\n1.5,2.5\n3.5,4.5\n5.5,2.5\n",
    "units without brackets": "x y\nm m\n" + BODY,
    "Fortran exponents": "0.15D+01 2.5d0\n3.5 4.5D0\n.55D1 2.5\n",
    "decimal commas with tabs": "1,5\t2,5\n3,5\t4,5\n5,5\t2,5\n",
    "decimal commas with blanks": "1,5 2,5\n3,5  4,5\n5,5 2,5\n",
    "decimal commas with bars": "x|y\n1,5|2,5\n3,5|4,5\n5,5|2,5\n",
    "decimal commas in quotes": 'x,y\n"1,5","2,5"\n"3,5","4,5"\n"5,5","2,5"\n',
    "run together at signs": "1.5 2.5\n3.5+4.5\n5.5+2.5\n",
    "a color is a column": "1.5 2.5 #ff0000\n3.5 4.5 #00ff00\n5.5 2.5 #0000ff\n",
    "R: names without that of the rows": '"x" "y"\n"1" 1.5 2.5\n"2" 3.5 4.5\n"3" 5.5 2.5\n',
    "pandas: an index without a name": ",x,y\n0,1.5,2.5\n1,3.5,4.5\n2,5.5,2.5\n",
    "a separator behind each row, not the names": "x,y\n1.5,2.5,\n3.5,4.5,\n5.5,2.5,\n",
    "a comment behind a row": "1.5 2.5 # first\n3.5 4.5 # second\n5.5 2.5\n",
    "UTF-16 without a mark": "x,y\n1.5,2.5\n3.5,4.5\n5.5,2.5\n".encode("utf-16-le"),
    "UTF-16 of the other end": "x,y\n1.5,2.5\n3.5,4.5\n5.5,2.5\n".encode("utf-16-be"),
    "UTF-16 with a mark": "x,y\n1.5,2.5\n3.5,4.5\n5.5,2.5\n".encode("utf-16"),
    "UTF-8 with a mark": "\ufeffx,y\n1.5,2.5\n3.5,4.5\n5.5,2.5\n",
    "lines of old Macs": "x,y\r1.5,2.5\r3.5,4.5\r5.5,2.5\r",
    "names in a comment": "# x y\n" + BODY,
    "ParaView, unquoted": "Points:0,Points:1\n1.5,2.5\n3.5,4.5\n5.5,2.5\n",
    "a WKT-like name": "Polygon,x,y\n1,1.5,2.5\n2,3.5,4.5\n3,5.5,2.5\n",
    "names in a comment with %": "% x  y\n" + BODY,
}


@pytest.mark.parametrize("text", UNDERSTOOD.values(), ids=UNDERSTOOD.keys())
def test_dialects_that_are_understood(text: str | bytes) -> None:
    assert read_text(text).xy.tolist() == TRIANGLE


NAMES = [
    "lng,lat", "long,lat", "R [m],Z [m],", "POINT_X,POINT_Y", "xcoord,ycoord", "x_coord,y_coord",
    "X [m],Y [m]", "X (mm),Y (mm)", "X_UTM,Y_UTM", "decimalLongitude,decimalLatitude",
    "x-coordinate,y-coordinate", "Points:0,Points:1", "Este,Norte", "Rechtswert,Hochwert",
    "east,north", "px,py", "col,row", "Longitude (deg),Latitude (deg)", "GPS_X,GPS_Y",
]  # fmt: skip


@pytest.mark.parametrize("names", [names for names in NAMES if "R [m]" not in names])
def test_names_of_coordinates(names: str) -> None:
    rows = "".join(f"7,{x},{y}\n" for x, y in TRIANGLE)
    points = read_text(f"id,{names}\n{rows}")
    assert points.xy.tolist() == TRIANGLE
    assert points.names == tuple(names.split(","))


@pytest.mark.parametrize("names", ["x,z", "R,Z", "R [m],Z [m]"])
def test_a_section_says_what_it_takes_for_y(names: str) -> None:
    rows = "".join(f"{x},{y}\n" for x, y in TRIANGLE)
    points = read_with_warning(f"{names}\n{rows}", ["for x and y", "--columns"])
    assert points.xy.tolist() == TRIANGLE


def test_two_columns_of_unknown_names_are_x_and_y_with_a_warning() -> None:
    points = read_with_warning("a,b\n1,2\n3,4\n", ["'a', 'b'", "--columns"])
    assert (points.xy.tolist(), points.names) == ([[1, 2], [3, 4]], ("a", "b"))


def test_two_systems_in_a_file_are_for_the_user_to_choose_from() -> None:
    text = "X_UTM,Y_UTM,X_WGS84,Y_WGS84\n1,2,3,4\n"
    refused(text, ["X_UTM", "--columns"])
    assert read_text(text, columns=("X_WGS84", "Y_WGS84")).xy.tolist() == [[3, 4]]


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        ("""8°30'36"E;47°15'N""", [8.51, 47.25]),
        ("8.5E;47.25N", [8.5, 47.25]),
        ("""2.0E;40°20'0.5"N""", [2.0, 40 + 20 / 60 + 0.5 / 3600]),
        ("73.5 W;2.0S", [-73.5, -2.0]),
        ("E 8° 30.6';N 47° 15'", [8.51, 47.25]),
        ("8:30:36E;47:15:00N", [8.51, 47.25]),
        ("-73°30';-2°", [-73.5, -2.0]),
        ("1'234'567.5;2'000", [1234567.5, 2000]),
        ("1.234.567,5;2.000,25", [1234567.5, 2000.25]),
        ("1,234,567.5;2,000", [1234567.5, 2000]),
        ("600 000,5;200 000,25".replace(" ", "\u202f"), [600000.5, 200000.25]),
        ("600 000,5;1 200 000,25", [600000.5, 1200000.25]),
        ("\u22121.5;2.5", [-1.5, 2.5]),
    ],
)
def test_spellings_of_numbers(row: str, expected: list[float]) -> None:
    points = read_text(f"lon;lat\n{row}\n")
    assert points.xy[0].tolist() == pytest.approx(expected, abs=1e-12)


def test_a_title_that_holds_a_number_is_told() -> None:
    points = read_with_warning("NACA 0012\n" + BODY, ["'NACA 0012'", "title", "--skip-lines"])
    assert points.xy.tolist() == TRIANGLE


def test_rows_of_nan_part_curves_and_are_counted() -> None:
    for gap in ("NaN NaN", "NA NA", "nan nan"):
        text = f"1.5 2.5\n{gap}\n3.5 4.5\n{gap}\n5.5 2.5\n"
        points = read_with_warning(text, ["left out 2 rows", "line 2"])
        assert points.xy.tolist() == TRIANGLE


def test_a_count_line_that_may_be_a_point_is_refused() -> None:
    text = "4 0\n0 0\n2 0\n2 2\n0 2\n"
    refused(text, ["line 1", "--skip-lines 1", "--skip-lines 0"])
    assert len(read_text(text, skip_lines=1)) == 4
    assert len(read_text(text, skip_lines=0)) == 5


def test_a_count_that_is_none_is_refused() -> None:
    refused("2024\n" + BODY, ["'2024'", "3 rows", "--skip-lines 1"])
    assert read_text("2024\n" + BODY, skip_lines=1).xy.tolist() == TRIANGLE


def test_a_node_file_has_counts_above_and_numbers_in_front() -> None:
    text = "3 2 0 0\n1 1.5 2.5\n2 3.5 4.5\n3 5.5 2.5\n"
    refused(text, ["--columns 1,2"])
    assert read_text(text, columns=(1, 2)).xy.tolist() == TRIANGLE


def test_a_first_column_that_counts_is_no_x() -> None:
    text = "".join(f"{k},{x},{y}\n" for k, (x, y) in enumerate(TRIANGLE, 1))
    refused(text, ["numbers the rows", "--columns 1,2", "--columns 0,1"])
    assert read_text(text, columns=(1, 2)).xy.tolist() == TRIANGLE


def test_a_sentinel_is_refused_until_it_is_declared() -> None:
    text = "x,y\n1.5,2.5\n-9999,-9999\n3.5,4.5\n5.5,2.5\n"
    refused(text, ["line 3", "-9999", "--missing"])
    points = read_with_warning(text, ["left out 1 row"], missing=-9999)
    assert points.xy.tolist() == TRIANGLE
    assert len(read_text(text, missing=())) == 4
    near = "x,y\n-9000,1\n-9999,2\n-9990,3\n"
    assert len(read_text(near)) == 3


def test_a_section_whose_y_is_constant_is_told() -> None:
    text = "x,y,z\n0,0,5\n1,0,6\n2,0,7\n"
    points = read_with_warning(text, ["every y is 0", "--columns x,z"])
    assert len(points) == 3
    assert read_text(text, columns=("x", "z")).xy.tolist() == [[0, 5], [1, 6], [2, 7]]


def test_names_without_rows_are_told() -> None:
    assert len(read_with_warning("x,y\n", ["no rows"])) == 0


def test_commas_both_ways_are_refused() -> None:
    refused("600,000,200,000\n600,500,200,250\n600,125,200,750\n", ["commas", "--separator"])
    refused("x,y\n600,000,200,000\n", ["line 2", "4 columns", "semicolons"])
    assert len(read_with_warning("1,25,3,75\n1,50,3,25\n", ["4 columns without names"])) == 2


def test_a_comma_before_three_digits_in_quotes_may_mean_two_things() -> None:
    text = 'x,y\n"600,000","200,000"\n"600,500","200,250"\n'
    refused(text, ["600,000", "--decimal"])
    assert read_text(text, decimal=".").xy.tolist() == [[600000, 200000], [600500, 200250]]


def test_a_comma_before_three_digits_may_mean_two_things() -> None:
    text = "x;y\n600,000;200,000\n600,500;200,250\n"
    refused(text, ["600,000", "--decimal"])
    assert read_text(text, decimal=",").xy.tolist() == [[600, 200], [600.5, 200.25]]
    assert read_text(text, decimal=".").xy.tolist() == [[600000, 200000], [600500, 200250]]
    assert read_text('x,y\n"600,000",1.5\n').xy.tolist() == [[600000, 1.5]]


def test_text_with_commas_does_not_mark_decimals() -> None:
    assert read_text('x,y,note\n0.375,1.625,"1,5"\n').xy.tolist() == [[0.375, 1.625]]
    assert read_text("x;y;note\n0.375;1.625;1,5\n").xy.tolist() == [[0.375, 1.625]]


def test_latin_1_is_asked_for() -> None:
    text = "x,y,name\n1,2,Zürich\n".encode("latin-1")
    refused(text, ["line 2", "0xfc", "--encoding"])
    assert read_text(text, encoding="latin-1").columns["name"].tolist() == ["Zürich"]
    with pytest.raises(InputError, match="encoding"):
        read_text(text, encoding="rot13")


def test_lines_can_be_left_out_at_the_top() -> None:
    text = "a 1 b\n1 x 2\nx y\n1 2\n"
    assert read_text(text, skip_lines=2).xy.tolist() == [[1, 2]]


def test_a_header_can_be_denied() -> None:
    assert read_text("1 2\n3 4\n", header=False).xy.tolist() == [[1, 2], [3, 4]]
    refused("x y\n3 4\n", ["line 1", "'x'"], header=False)


def test_comments_can_be_chosen() -> None:
    assert read_text("$ note\n1 2\n", comment="$").xy.tolist() == [[1, 2]]


def test_bad_rows_can_be_left_out() -> None:
    text = "x,y\n1.5,2.5\n1,abc\n2\n3.5,4.5\n,7\n1,inf\n5.5,2.5\n"
    refused(text, ["--on-bad-row skip"])
    points = read_with_warning(text, ["left out 4 rows", "line 3"], on_bad_row="skip")
    assert points.xy.tolist() == TRIANGLE


def test_a_number_that_overflows_its_format_is_no_comment() -> None:
    refused("1.5 2.5\n****** 4.5\n5.5 2.5\n", ["line 2", "'******'"])


def test_a_cell_may_be_long() -> None:
    points = read_text(f"x,y,note\n1,2,{'a' * 200_000}\n")
    assert len(points.columns["note"][0]) == 200_000


def test_a_hundred_thousand_columns_are_read() -> None:
    names = ",".join(["x", "y", *(f"c{k}" for k in range(100_000))])
    row = ",".join(["1"] * 100_002)
    points = read_text(f"{names}\n{row}\n{row}\n")
    assert (len(points), len(points.columns)) == (2, 100_000)


def test_a_column_of_well_known_text_gives_its_vertices() -> None:
    text = 'id,wkt,name\n7,POINT (1 2),a\n8,"LINESTRING (3 4, 5 6)",b\n9,,c\n'
    points = read_text(text)
    assert points.xy.tolist() == [[1, 2], [3, 4], [5, 6]]
    assert points.columns["id"].tolist() == [7, 8, 8]
    assert points.columns["name"].tolist() == ["a", "b", "b"]
    refused("wkt;name\nPOINT (1 2);a\nPOINT (1 b);b\n", ["line 3", "'1 b'"])
    refused("wkt;name\n-9999;a\n1.5;b\n", ["line 2", "-9999"])  # a column of numbers alone
    refused('x;y\n1,5;",5\n3,";4,5\n', ["line 2", "is not a number"])  # a cell of two lines
    assert read_text("wkt;x;y\nPOINT (9 9);1;2\n").xy.tolist() == [[1, 2]]


@pytest.mark.parametrize(
    "text",
    [
        "[[1.5, 2.5], [3.5, 4.5], [5.5, 2.5]]",
        '[{"x": 1.5, "y": 2.5}, {"x": 3.5, "y": 4.5}, {"x": 5.5, "y": 2.5}]',
        '{"lon": [1.5, 3.5, 5.5], "lat": [2.5, 4.5, 2.5]}',
        '{"x": 1.5, "y": 2.5}\n{"x": 3.5, "y": 4.5}\n{"x": 5.5, "y": 2.5}\n',
        "[1.5, 2.5]\n[3.5, 4.5]\n[5.5, 2.5]\n",
        '{"type":"Point","coordinates":[1.5,2.5]}\n'
        '{"type":"LineString","coordinates":[[3.5,4.5],[5.5,2.5]]}\n',
    ],
)
def test_json_that_is_no_geojson(text: str) -> None:
    assert read_text(text).xy.tolist() == TRIANGLE


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[[1, 2], [3]]", ["row 1", "[3]"]),
        ('[{"x": 1, "y": 2}, {"x": 3}]', ["row 1", "'y'", "None"]),
        ('{"x": [1, 2], "y": [3]}', ["'y' has 1 values", "'x' 2"]),
        ('{"a": 1}', ["neither GeoJSON", "nor rows"]),
        ('[1, "a"]', ["neither GeoJSON", "nor rows"]),
        ('{"x": 1, "y": 2}\n{"x": 1, "y"}\n', ["line 2"]),
        ("[[1, 2], [3, NaN]]", ["NaN"]),
        ("[[1, 2], [3, 1e999]]", ["row 1", "inf"]),
        ("[" * 100_000, ["too deep"]),
    ],
)
def test_json_that_is_no_points_is_refused(text: str, words: list[str]) -> None:
    refused(text, words)


@pytest.mark.parametrize(
    "text",
    [
        "0,0 1,0 1,1 0,1\n",  # a polygon in SVG: it was one point, 0.0 and 1.0, with a height
        "8.5,47.4,0 8.6,47.5,0 8.7,47.4,0\n",  # KML
        "1,2,0 3,4,0\n5,6,0 7,8,0\n",
    ],
)
def test_several_points_a_line_are_refused(text: str) -> None:
    """The first of each line was taken, and the others were columns of it, or lost."""
    refused(text, ["several points in a line", "--columns 0,1"])


def test_numbers_of_points_are_not_taken_for_x() -> None:
    """As surveyors write them: number, easting, northing, height, code."""
    rows = "".join(f"{k},{x},{y},7.5,TREE\n" for k, (x, y) in enumerate(TRIANGLE, 101))
    refused(rows, ["numbers the rows", "--columns 1,2"])
    assert read_text(rows, columns=(1, 2, 3)).xy.tolist() == TRIANGLE


def test_many_columns_without_names_say_what_was_taken() -> None:
    points = read_with_warning(
        "1.5 2.5 7 A\n3.5 4.5 8 B\n5.5 2.5 9 C\n", ["4 columns", "x, y and z"]
    )
    assert points.xy.tolist() == TRIANGLE
    assert read_text("1.5 2.5 7 A\n", columns=(0, 1)).xy.tolist() == [[1.5, 2.5]]
