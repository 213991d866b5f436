"""NPY and NPZ: shapes, names, refusals, and a result that can be read again."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crustline.curves import trace
from crustline.errors import FormatError
from crustline.formats import read, write
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
