"""Points carry data beside their rows, and nothing derived from them does."""

from __future__ import annotations

import copy
import operator
import pickle

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
    assert points.tolist() == [[0, 0], [3, 4], [5, 6]]
    assert points.z.tolist() == [7, 8, 9]
    assert {name: column.tolist() for name, column in points.columns.items()} == {
        "name": ["a", "b", "c"],
        "id": [1, 2, 3],
    }
    assert points.crs == "EPSG:25832"
    assert points.names == ("easting", "northing")


@pytest.mark.parametrize(
    "duplicate",
    [copy.copy, copy.deepcopy, Points.copy, lambda p: pickle.loads(pickle.dumps(p))],
)
def test_copies_and_pickles_carry_all(points, duplicate):
    other = duplicate(points)
    assert_carries(other)
    assert not np.shares_memory(other, points)


DERIVED = {
    "slice": lambda p: p[1:],
    "row": lambda p: p[1],
    "mask": lambda p: p[np.array([True, False, True])],
    "column": lambda p: p[:, 0],
    "ellipsis": lambda p: p[...],
    "sum": lambda p: p + 1,
    "right sum": lambda p: 1 + p,
    "compare": lambda p: p == p,
    "negative": operator.neg,
    "matrix product": lambda p: p @ np.eye(2),
    "ufunc": np.sqrt,
    "reduce": lambda p: np.add.reduce(p),
    "transpose": lambda p: p.T,
    "reshape": lambda p: p.reshape(-1),
    "astype": lambda p: p.astype(np.float32),
    "mean": lambda p: p.mean(axis=0),
    "concatenate": lambda p: np.concatenate([p, p]),
    "sort": lambda p: np.sort(p, axis=0),
    "copy function": lambda p: np.copy(p),
    "where": lambda p: np.where(p > 1, p, 0),
    "asarray": np.asarray,
    "array": np.array,
    "ascontiguousarray": np.ascontiguousarray,
    "as_points": as_points,
    "split": lambda p: np.split(p, 3)[0],
    "iteration": lambda p: next(iter(p)),
    "zeros_like": np.zeros_like,
}


@pytest.mark.parametrize("name", DERIVED)
def test_what_is_derived_is_a_plain_array(points, name):
    assert type(DERIVED[name](points)) is np.ndarray


def test_no_method_of_ndarray_gives_points_without_their_data(points):
    arguments = {"reshape": (6,), "astype": (int,), "take": ([0],), "repeat": (2,), "clip": (0, 1)}
    arguments |= {
        "swapaxes": (0, 1),
        "compress": ([True],),
        "searchsorted": (1,),
        "dot": (np.eye(2),),
    }
    arguments |= {"argpartition": (0,), "choose": ([[1, 2]] * 8,)}
    makers = {"view", "copy", "getfield"}
    for name in sorted(set(dir(np.ndarray)) - makers):
        method = getattr(points, name)
        if name.startswith("_") or not callable(method):
            continue
        try:
            result = method(*arguments.get(name, ()))
        except (TypeError, ValueError):
            continue
        assert not isinstance(result, Points), name


def test_in_place_arithmetic_keeps_the_points(points):
    same = points
    points += 1
    assert points is same
    assert points.tolist() == [[1, 1], [4, 5], [6, 7]]
    assert points.z.tolist() == [7, 8, 9]


def test_assignment_reaches_the_points(points):
    points[0] = (9, 9)
    assert points.tolist()[0] == [9, 9]
    assert len(points) == 3


def test_coordinates_are_copied():
    array = np.zeros((2, 2))
    assert not np.shares_memory(Points(array), array)


def test_bare_points():
    points = Points([])
    assert (points.z, points.columns, points.crs, points.names) == (None, {}, None, ("x", "y"))
    assert points.shape == (0, 2)
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
    ],
)
def test_what_does_not_fit_is_named(arguments, words):
    with pytest.raises(InputError) as caught:
        Points(**arguments)
    for word in words:
        assert word in str(caught.value)
