"""Points carry data beside their rows, and nothing derived from them does."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable

import numpy as np
import pytest

from crustline.arrays import as_points
from crustline.errors import InputError
from crustline.points import Points


@pytest.fixture
def points():
    return Points(
        [(0, 0), (3, 4), (5, 6)],
        z=[7, 8, 9],
        columns={"name": ["a", "b", "c"], "id": [1, 2, 3]},
        crs="EPSG:25832",
        names=("easting", "northing"),
    )


def assert_carries(points):
    assert type(points) is Points
    assert points.xy.tolist() == [[0, 0], [3, 4], [5, 6]]
    assert points.z.tolist() == [7, 8, 9]
    assert {name: column.tolist() for name, column in points.columns.items()} == {
        "name": ["a", "b", "c"],
        "id": [1, 2, 3],
    }
    assert points.crs == "EPSG:25832"
    assert points.names == ("easting", "northing")


@pytest.mark.parametrize(
    "duplicate",
    [
        copy.copy,
        copy.deepcopy,
        Points.replace,
        lambda p: p.select([0, 1, 2]),
        lambda p: pickle.loads(pickle.dumps(p)),
    ],
)
def test_copies_and_pickles_carry_all_and_are_equal(points, duplicate):
    other = duplicate(points)
    assert_carries(other)
    assert other == points
    assert not any(each.flags.writeable for each in (other.xy, other.z, *other.columns.values()))


SERVES_AS_ARRAY: dict[str, Callable] = {
    "slice": lambda p: p[1:],
    "row": lambda p: p[1],
    "mask": lambda p: p[np.array([True, False, True])],
    "column": lambda p: p[:, 0],
    "asarray": np.asarray,
    "array": np.array,
    "concatenate": lambda p: np.concatenate([p, p]),
    "ufunc": np.sqrt,
    "with an array": lambda p: p + np.ones(2),
    "as_points": as_points,
    "iteration": lambda p: next(iter(p)),
}


@pytest.mark.parametrize("name", SERVES_AS_ARRAY)
def test_what_is_derived_is_that_of_the_coordinates(points, name):
    derive = SERVES_AS_ARRAY[name]
    assert type(derive(points)) is np.ndarray
    assert np.array_equal(derive(points), derive(points.xy))


def test_an_array_of_points_is_their_own_unless_it_must_be_another(points):
    assert np.asarray(points) is points.xy
    assert np.asarray(points, dtype=np.float32).dtype == np.float32
    assert not np.shares_memory(np.array(points), points.xy)


def test_nothing_of_points_can_be_changed(points):
    for name in ("xy", "z", "columns", "crs", "names", "color"):
        with pytest.raises(AttributeError, match="replace"):
            setattr(points, name, None)
    with pytest.raises(AttributeError):
        del points.z
    with pytest.raises(TypeError):
        points[0] = (9, 9)
    with pytest.raises(ValueError, match="read-only"):
        points.xy[0] = (9, 9)
    with pytest.raises(TypeError):
        points.columns["id"] = points.z
    with pytest.raises(ValueError, match="read-only"):
        points.columns["id"][0] = 9


@pytest.mark.parametrize(
    "change",
    [
        {"z": [7, 8, 10]},
        {"z": None},
        {"columns": {"name": ["a", "b", "c"]}},
        {"columns": {"id": [1, 2, 3], "name": ["a", "b", "c"]}},
        {"crs": None},
        {"names": ("x", "y")},
    ],
)
def test_points_are_equal_if_all_that_they_carry_is(points, change):
    changed = points.replace(**change)
    assert changed != points
    assert changed.replace(z=points.z, columns=points.columns, crs=points.crs) != (0, 0)
    assert np.array_equal(changed.xy, points.xy)


def test_points_are_equal_where_a_column_has_gaps():
    one, other = (Points([(0, 0)], columns={"a": [np.nan]}) for _ in range(2))
    assert one == other
    assert one != Points([(0, 1)], columns={"a": [np.nan]})
    with pytest.raises(TypeError, match="hash"):
        hash(one)


def test_coordinates_are_copied():
    array, heights, names = np.zeros((2, 2)), np.zeros(2), np.array(["a", "b"])
    points = Points(array, z=heights, columns={"name": names})
    array[0], heights[0], names[0] = 99, 99, "c"
    assert points == Points(np.zeros((2, 2)), z=[0, 0], columns={"name": ["a", "b"]})


def test_bare_points():
    points = Points([])
    assert (points.z, points.columns, points.crs, points.names) == (None, {}, None, ("x", "y"))
    assert points.xy.shape == (0, 2)
    assert repr(points) == "<Points: 0 rows of x, y; crs None>"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"coordinates": [(0, float("nan"))]}, ["row 0", "nan"]),
        ({"coordinates": [(0, 0)], "z": [1, 2]}, ["z", "(2,)"]),
        ({"coordinates": [(0, 0)], "z": [float("inf")]}, ["z", "row 0", "inf"]),
        ({"coordinates": [(0, 0)], "z": ["high"]}, ["z"]),
        ({"coordinates": [(0, 0)], "columns": {"name": ["a", "b"]}}, ["'name'", "(2,)"]),
        ({"coordinates": [(0, 0)], "columns": {"name": [None]}}, ["'name'", "objects"]),
        ({"coordinates": [(0, 0)], "columns": {"name": [[1], [1, 2]]}}, ["'name'", "a row"]),
        ({"coordinates": [(0, 0)], "columns": {5: [1]}}, ["5", "text"]),
        ({"coordinates": [(0, 0)], "columns": ["name"]}, ["['name']", "mapping"]),
        ({"coordinates": [(0, 0)], "crs": 4326}, ["4326", "crs='EPSG:4326'"]),
        ({"coordinates": [(0, 0)], "crs": ""}, ["''", "crs='EPSG:4326'"]),
        ({"coordinates": [(0, 0)], "names": ["a"]}, ["['a']", "two"]),
        ({"coordinates": [(0, 0)], "names": "xy"}, ["'xy'", "two"]),
        ({"coordinates": [(0, 0)], "names": ("x", "x")}, ["('x', 'x')", "different"]),
    ],
)
def test_what_does_not_fit_is_named(arguments, words):
    with pytest.raises(InputError) as caught:
        Points(**arguments)
    for word in words:
        assert word in str(caught.value)
