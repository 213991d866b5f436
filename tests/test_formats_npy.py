"""NPY and NPZ: shapes, names, refusals, and a result that can be read again."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crustline.curves import trace
from crustline.errors import FormatError
from crustline.formats import read, read_curves, write
from crustline.points import Points

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


def test_npy_of_two_or_three_columns(tmp_path):
    np.save(tmp_path / "two.npy", np.array([[1, 2], [3, 4]]))
    np.save(tmp_path / "three.npy", np.array([[1, 2, 9], [3, 4, 8]], dtype=np.float32))
    assert read(tmp_path / "two.npy").xy.tolist() == [[1, 2], [3, 4]]
    three = read(tmp_path / "three.npy")
    assert three.xy.tolist() == [[1, 2], [3, 4]]
    assert three.z.tolist() == [9, 8]


def test_npy_columns_can_be_chosen(tmp_path):
    np.save(tmp_path / "p.npy", np.arange(10).reshape(2, 5))
    points = read(tmp_path / "p.npy", columns=(4, 0))
    assert points.xy.tolist() == [[4, 0], [9, 5]]
    assert points.columns["column3"].tolist() == [3, 8]


def test_npz_of_x_and_y(tmp_path):
    np.savez(tmp_path / "p.npz", y=[2, 4], x=[1, 3], z=[5, 6], name=["a", "b"], other=[1, 2, 3])
    points = read(tmp_path / "p.npz")
    assert points.xy.tolist() == [[1, 2], [3, 4]]
    assert points.z.tolist() == [5, 6]
    assert {name: column.tolist() for name, column in points.columns.items()} == {
        "name": ["a", "b"]
    }


def test_npz_of_points_with_heights(tmp_path):
    np.savez(tmp_path / "p.npz", points=[[1, 2, 3]], crs="epsg:4326")
    points = read(tmp_path / "p.npz")
    assert (points.xy.tolist(), points.z.tolist(), points.crs) == ([[1, 2]], [3], "EPSG:4326")


def test_npz_columns_can_be_chosen(tmp_path):
    np.savez(tmp_path / "p.npz", a=[1, 3], b=[2, 4])
    assert read(tmp_path / "p.npz", columns=("b", "a")).xy.tolist() == [[2, 1], [4, 3]]


@pytest.mark.parametrize("suffix", ["npy", "npz", "unknown"])
@pytest.mark.parametrize("content", [b"\x93NUMPY broken", b"PK\x03\x04 broken"])
def test_broken_files_are_named(tmp_path, suffix, content):
    path = tmp_path / f"p.{suffix}"
    path.write_bytes(content)
    with pytest.raises(FormatError, match=f"p.{suffix}"):
        read(path)


def test_each_kind_of_file_is_told_from_the_others(tmp_path):
    np.save(tmp_path / "p.npy", np.zeros((2, 2)))
    np.savez(tmp_path / "p.npz", points=np.zeros((2, 2)))
    (tmp_path / "p.csv").write_text("1,2")
    for name, format in (("p.npy", "npz"), ("p.npz", "npy"), ("p.csv", "npy"), ("p.csv", "npz")):
        with pytest.raises(FormatError, match=f"{name} is .*choose"):
            read(tmp_path / name, format=format)


@pytest.mark.parametrize(
    ("array", "words"),
    [
        (np.zeros(3), ["(3,)"]),
        (np.zeros((3, 4)), ["(3, 4)"]),
        (np.array([[1, float("nan")]]), ["row 0", "nan"]),
        (np.array([[1, 2j]]), ["complex"]),
        (np.array([["a", "b"]]), ["row 0"]),
        (np.array([[None, 1]]), ["Python objects"]),
    ],
)
def test_arrays_that_do_not_fit_are_named(tmp_path, array, words):
    np.save(tmp_path / "p.npy", array)
    with pytest.raises(FormatError) as caught:
        read(tmp_path / "p.npy")
    for word in ["p.npy", *words]:
        assert word in str(caught.value)


def test_archives_that_do_not_fit_are_named(tmp_path):
    np.savez(tmp_path / "a.npz", a=[1], b=[2])
    with pytest.raises(FormatError, match="'a', 'b'"):
        read(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", x=[1, 2], y=[2])
    with pytest.raises(FormatError, match="2 rows, 'y' 1"):
        read(tmp_path / "b.npz")
    np.savez(tmp_path / "c.npz", x=np.array([None]), y=[2])
    with pytest.raises(FormatError, match=r"c.npz, array 'x'.*Python objects"):
        read(tmp_path / "c.npz")


@given(st.lists(st.tuples(FLOATS, FLOATS, FLOATS, st.text()), min_size=3))
def test_reading_gives_back_what_was_written(tmp_path_factory, rows):
    names = np.array([row[3] for row in rows], dtype=str)
    points = Points(
        [row[:2] for row in rows],
        z=[row[2] for row in rows],
        columns={"a/b": names, "indices": np.arange(len(rows))},
        crs="EPSG:25832",
        names=("e", "n"),
    )
    curves = trace(points, [(0, 1), (1, 2), (0, 2)])
    path = tmp_path_factory.mktemp("npz") / "curves.npz"
    write(curves, path)
    again = read(path)
    assert again.xy.tobytes() == points.xy.tobytes()
    assert again.z.tobytes() == points.z.tobytes()
    assert (again.crs, again.names) == ("EPSG:25832", ("e", "n"))
    assert list(again.columns) == ["a/b", "indices"]
    assert again.columns["a/b"].tolist() == names.tolist()
    with np.load(path) as archive:
        for name in ("indices", "offsets", "closed", "isolated"):
            assert np.array_equal(archive[name], getattr(curves, name))


def test_fields_of_a_structured_array_are_columns(tmp_path):
    """Names that are no Latin-1 are what NumPy writes version 3 of the format for."""
    fields = [("größe", "f8"), ("x", "f4"), ("y", "i8"), ("名", "U2"), ("both", "f8", (2,))]
    array = np.zeros(3, dtype=fields)
    array["x"], array["y"], array["名"] = [0.5, 1, 2], [3, 4, 5], ["a", "é", "名"]
    with pytest.warns(UserWarning, match="format 3"):
        np.save(tmp_path / "p.npy", array)
    assert (tmp_path / "p.npy").read_bytes()[6] == 3
    points = read(tmp_path / "p.npy")
    assert points.xy.tolist() == [[0.5, 3], [1, 4], [2, 5]]
    assert list(points.columns) == ["größe", "名"]
    assert points.columns["名"].tolist() == ["a", "é", "名"]
    assert read(tmp_path / "p.npy", columns=("y", "größe")).xy.tolist() == [[3, 0], [4, 0], [5, 0]]


@pytest.mark.parametrize("version", [(1, 0), (2, 0), (3, 0)])
def test_every_version_of_the_format_is_read(tmp_path, version):
    with open(tmp_path / "p.npy", "wb") as file:
        np.lib.format.write_array(file, np.eye(3, 2), version=version)
    assert read(tmp_path / "p.npy").xy.tolist() == np.eye(3, 2).tolist()


def test_text_of_no_characters_is_refused(tmp_path):
    """NumPy raised a SystemError for it, and that only when it was looked at."""
    no_text = np.array([0x110000, 0x41], dtype="<u4").view("<U1")
    np.savez(tmp_path / "p.npz", x=[1, 2], y=[3, 4], name=no_text)
    with pytest.raises(FormatError, match=r"'name'.*no character"):
        read(tmp_path / "p.npz")


@pytest.mark.parametrize("orient", [None, "ccw", "cw", "rfc7946", "gis"])
@pytest.mark.parametrize("start", [None, (1, 1), "east"])
def test_archives_keep_directions_and_starts(tmp_path, orient, start):
    """They were traced anew, which forgot both."""
    square = np.array([(0, 0), (9, 0), (9, 9), (0, 9)])
    points = np.concatenate([square, square / 3 + 2, [(20, 0), (21, 1), (22, 0), (30, 30)]])
    edges = [(0, 1), (1, 2), (2, 3), (0, 3), (4, 5), (5, 6), (6, 7), (4, 7), (8, 9), (9, 10)]
    curves = trace(points, edges).oriented(orient, start=start)
    curves = dataclasses.replace(curves, confidence=np.linspace(0, 1, 10))
    write(curves, tmp_path / "c.npz")
    found = read_curves(tmp_path / "c.npz")
    assert found == curves
    assert found.orient == orient


def test_rows_that_are_no_order_along_the_edges_are_traced_anew(tmp_path):
    curves = trace([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (0, 3)])
    arrays = {"points": curves.points.xy, "offsets": curves.offsets, "closed": curves.closed}
    np.savez(tmp_path / "c.npz", indices=[1, 2, 3, 0], isolated=curves.isolated, **arrays)
    assert read_curves(tmp_path / "c.npz")[0].indices.tolist() == [1, 2, 3, 0]
    np.savez(tmp_path / "c.npz", indices=[3, 2, 1, 0], isolated=curves.isolated, **arrays)
    assert read_curves(tmp_path / "c.npz")[0].indices.tolist() == [0, 1, 2, 3]
