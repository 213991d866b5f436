"""What is written reads back: over names, types of columns, heights, systems and formats."""

from __future__ import annotations

import io
import warnings
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from crustline import Curves, Points, read, trace
from crustline.formats import FORMATS, read_curves, write

# Those of a plain installation; the others are held in their own tests.
BOTH_WAYS = ["csv", "tsv", "xyz", "geojson", "wkt", "npz", "npy"]
CURVES = ["csv", "tsv", "geojson", "wkt", "npz"]
WITH_COLUMNS = {"csv", "tsv", "geojson", "npz"}
KNOWN = [("x", "y"), ("lon", "lat"), ("Easting", "Northing"), ("X [m]", "Y [m]")]

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
# No UTF-8 holds a surrogate, and NumPy's own text ends before a null.
CHARACTERS = st.characters(exclude_categories=["Cs"], exclude_characters="\0")
TEXT = st.text(CHARACTERS | st.sampled_from(" ,;\t\"'#\n\r.01aE-"), max_size=6)
NAMES = st.sampled_from(["x", "y", "z", "lon", "lat", "row", "curve", "X", " x "]) | TEXT
TYPES = st.sampled_from(
    ["i1", "i4", "i8", "u1", "u8", "f2", "f4", "f8", "?", "M8[s]", "m8[h]", "U", "O"]
)


@st.composite
def columns(draw: st.DrawFn, n: int) -> np.ndarray[Any, Any]:
    kind = draw(TYPES)
    if kind in "UO":
        values = draw(st.lists(TEXT, min_size=n, max_size=n))
        return np.array(values, dtype=np.object_ if kind == "O" else str)
    finite = {"allow_nan": draw(st.booleans()), "allow_infinity": False} if kind[0] == "f" else {}
    elements = arrays.from_dtype(np.dtype(kind), **finite)
    return draw(arrays.arrays(kind, n, elements=elements))


@st.composite
def points(draw: st.DrawFn) -> Points:
    n = draw(st.integers(0, 6))
    names = draw(st.sampled_from(KNOWN) | st.tuples(TEXT, TEXT))
    assume(names[0] != names[1])
    return Points(
        draw(arrays.arrays("f8", (n, 2), elements=FLOATS)),
        z=draw(st.none() | arrays.arrays("f8", n, elements=FLOATS)),
        columns={name: draw(columns(n)) for name in draw(st.lists(NAMES, max_size=4, unique=True))},
        crs=draw(st.sampled_from([None, "EPSG:25832", "EPSG:4326", "local grid"])),
        names=names,
    )


def again(written: Points | Curves, key: str, reading: Any = read) -> Any:
    """Write something and read it, as one who knows that it holds no sentinels."""
    stream = io.BytesIO()
    write(written, stream, format=key)
    options = {"missing": ()} if any(o.name == "missing" for o in FORMATS[key].options) else {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of files without rows, and of sections
        return reading(stream.getvalue(), format=key, **options)


def plain(values: np.ndarray[Any, Any]) -> list[Any]:
    """Return what a format gives for a column: text formats hold numbers, truth and text."""
    if values.dtype.kind in "mM":
        return [str(value) for value in values]
    return [None if value != value else value for value in values.tolist()]


def same_or_a_number(found: np.ndarray[Any, Any], expected: list[Any]) -> bool:
    """Whether a column came back, as itself or, if it was text that spells numbers, as these."""
    if plain(found) == expected:
        return True
    spelled = all(isinstance(value, str) for value in expected)
    return spelled and found.dtype.kind in "iufb" and len(found) > 0


@pytest.mark.parametrize("key", BOTH_WAYS)
@given(points=points())
def test_points_come_back(key: str, points: Points) -> None:
    back = again(points, key)
    assert back.xy.tobytes() == points.xy.tobytes()
    if len(points):
        assert (back.z is None) == (points.z is None)
        assert points.z is None or back.z.tobytes() == points.z.tobytes()
    if key in WITH_COLUMNS and len(points):
        assert len(back.columns) == len(points.columns)
        for name, found in zip(points.columns, back.columns, strict=True):
            assert found == name or found.startswith("input_" if name else "column"), name
            expected = plain(points.columns[name])
            assert same_or_a_number(back.columns[found], expected), name
    if key in ("npz", "geojson"):
        assert list(back.columns) == list(points.columns) or not len(points)
        kept = points.crs if key == "npz" or points.crs != "EPSG:4326" else None
        assert back.crs == kept
    if key == "npz":
        assert back.names == points.names
    if key in ("csv", "tsv"):
        assert back.names == (points.names if points.names in KNOWN else ("x", "y"))


@st.composite
def traced(draw: st.DrawFn) -> Curves:
    n = draw(st.integers(1, 8))
    # On a small grid, so that rings and repeated points occur.
    xy = draw(arrays.arrays("f8", (n, 2), elements=st.integers(0, 3).map(float)))
    pairs = draw(st.lists(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)), max_size=10))
    z = draw(st.none() | arrays.arrays("f8", n, elements=FLOATS))
    columns_ = {"name": draw(columns(n))} if draw(st.booleans()) else {}
    edges = np.array([pair for pair in pairs if pair[0] != pair[1]], int).reshape(-1, 2)
    return trace(Points(xy, z=z, columns=columns_), edges)


@pytest.mark.parametrize("key", CURVES)
@given(curves=traced())
def test_curves_come_back(key: str, curves: Curves) -> None:
    # A line that ends where it starts is a ring to those that repeat a ring's first position.
    ends = [(each.points[0].tolist(), each.points[-1].tolist(), each.closed) for each in curves]
    assume(key in ("npz", "csv", "tsv") or all(a != b or ring for a, b, ring in ends))
    back = again(curves, key, read_curves)

    def lines(curves: Curves) -> list[tuple[list[list[float]], bool]]:
        return sorted((sorted(map(list, each.points.tolist())), each.closed) for each in curves)

    assert lines(back) == lines(curves)
    if key in ("csv", "tsv"):  # which hold no repeated points
        assert np.array_equal(back.points.xy[back.edges], curves.points.xy[curves.edges])
    if key == "npz":
        assert back.points.xy.tolist() == curves.points.xy.tolist()
        assert back.edges.tolist() == curves.edges.tolist()


def test_a_column_that_is_called_as_a_coordinate_keeps_away() -> None:
    """Coordinates lon, lat beside columns x, y once read back as x, y."""
    kept = Points([(10, 20), (30, 40)], columns={"x": [0, 1], "y": [0, 0]}, names=("lon", "lat"))
    back = again(kept, "csv")
    assert (back.xy.tolist(), back.names) == ([[10, 20], [30, 40]], ("lon", "lat"))
    assert list(back.columns) == ["input_x", "input_y"]


def test_a_column_z_is_no_height() -> None:
    """A column z beside points without heights once read back as heights."""
    back = again(Points([(1, 2)], columns={"z": [3]}), "csv")
    assert (back.z, list(back.columns)) == (None, ["input_z"])


def test_names_that_no_one_knows_are_x_and_y() -> None:
    """Coordinates a and b once made a file that was refused."""
    assert again(Points([(1, 2)], names=("a", "b"), columns={"c": [3]}), "csv").names == ("x", "y")


def test_truth_is_no_text() -> None:
    assert again(Points([(1, 2)], columns={"a": [True]}), "csv").columns["a"].dtype == bool


def test_names_keep_their_outer_blanks() -> None:
    assert list(again(Points([(1, 2)], columns={" a ": [1]}), "csv").columns) == [" a "]


def test_what_json_cannot_hold_is_refused() -> None:
    with pytest.raises(ValueError, match="column 'a' holds an infinite value"):
        write(Points([(1, 2)], columns={"a": [np.inf]}), io.BytesIO(), format="geojson")
