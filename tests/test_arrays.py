"""The one door: what fits passes unchanged, what does not is named by its row."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from crustline.arrays import PART, as_edges, as_points, in_parts
from crustline.errors import InputError


@pytest.mark.parametrize(
    "points",
    [
        [(0, 1), (2, 3)],
        [[0.0, 1.0], [2.0, 3.0]],
        np.array([[0, 1], [2, 3]], dtype=np.uint8),
        np.array([[0, 1], [2, 3]], dtype=">f4"),
        np.array([[0, 2], [1, 3]], dtype=np.float64).T,
        np.array([[0, 1, 9], [2, 3, 9]], dtype=np.float64)[:, :2],
        ((np.int64(0), np.float32(1)), (2, 3)),
    ],
)
def test_array_likes_pass(points):
    array = as_points(points)
    assert type(array) is np.ndarray
    assert array.dtype == np.float64
    assert array.flags.c_contiguous
    assert array.tolist() == [[0, 1], [2, 3]]


def test_an_array_that_fits_is_not_copied():
    points = np.zeros((3, 2))
    assert np.shares_memory(as_points(points), points)


@pytest.mark.parametrize("none", [[], np.empty((0, 2)), np.empty((0, 2), dtype=int), ()])
def test_no_points_are_points(none):
    assert as_points(none).shape == (0, 2)


def test_the_double_range_passes():
    extremes = [[5e-324, 1.7976931348623157e308], [-0.0, 2.0**53 + 2]]
    assert as_points(extremes).tolist() == extremes


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([(0, 0), (1, float("nan"))], ["row 1", "nan", "column 1"]),
        ([(0, 0), (1, 1), (float("-inf"), 1)], ["row 2", "-inf", "column 0"]),
        ([(0, 0), (1, 2, 3)], ["row 1", "3 values"]),
        ([(0, 0), (1,)], ["row 1", "1 values"]),
        ([(0, 0), 5], ["row 1", "5"]),
        ([(0, 0), ("a", 1)], ["row 1", "'a'"]),
        ([(0, 0), (None, 1)], ["row 1", "None"]),
        ([(0, 0), (1, 1j)], ["row 0", "complex"]),
        (np.array([1 + 2j, 3]), ["complex"]),
        ([("0", "1")], ["row 0", "'0'"]),
        ([(True, False)], ["row 0", "True"]),
        ([(Fraction(1, 3), 0)], ["objects"]),
        ([(0, 2**53 + 1)], ["row 0", "9007199254740993"]),
        ([(0, 10**400)], ["objects"]),
        (np.zeros((3, 3)), ["(3, 3)", "points[:, :2]"]),
        (np.zeros(4), ["(4,)"]),
        (np.zeros((2, 2, 2)), ["(2, 2, 2)"]),
        (np.zeros((2, 0)), ["(2, 0)"]),
        (7, ["7"]),
        ("points.csv", ["points.csv"]),
        (None, ["None"]),
        ((pair for pair in [(0, 0)]), ["generator"]),
        (np.ma.masked_array([[0.0, 0], [1, 1]], mask=[[0, 0], [0, 1]]), ["row 1", "masked"]),
        (np.array([["2020-01-01", "2020-01-02"]], dtype="M8[D]"), ["row 0"]),
    ],
)
def test_what_does_not_fit_is_named(points, words):
    with pytest.raises(InputError) as caught:
        as_points(points)
    message = str(caught.value)
    assert message.startswith("points: ")
    assert "\n" not in message
    for word in words:
        assert word in message


def test_a_long_double_that_would_be_rounded_is_refused():
    if np.finfo(np.longdouble).nmant <= 52:
        pytest.skip("long double is float64 here")
    assert as_points(np.array([[0.5, 1.0]], dtype=np.longdouble)).tolist() == [[0.5, 1.0]]
    with pytest.raises(InputError, match="row 0"):
        as_points(np.array([[0.5, 1.0]], dtype=np.longdouble) / 3)


def test_edges_become_canonical():
    rng = np.random.default_rng(5)
    edges = rng.integers(0, 40, size=(300, 2))
    edges = edges[edges[:, 0] != edges[:, 1]]
    canonical = as_edges(edges, 40)
    assert [tuple(edge) for edge in canonical] == sorted(
        {tuple(sorted(edge)) for edge in edges.tolist()}
    )
    assert np.array_equal(as_edges(canonical, 40), canonical)


@pytest.mark.parametrize("none", [[], np.empty((0, 2)), np.empty((0, 2), dtype=np.int64)])
def test_no_edges_are_edges(none):
    assert as_edges(none, 0).shape == (0, 2)


@pytest.mark.parametrize(
    ("edges", "words"),
    [
        ([(0, 1), (1, 1)], ["row 1", "itself"]),
        ([(0, 1), (1, 3)], ["row 1", "[1, 3]", "3 points"]),
        ([(0, 1), (-1, 2)], ["row 1", "[-1, 2]"]),
        ([(0.0, 1.0)], ["row 0", "integers"]),
        ([("a", "b")], ["row 0", "integers"]),
        ([(True, False)], ["row 0", "integers"]),
        ([(0, 1, 2)], ["(1, 3)"]),
        ([(0, 1), (2,)], ["pairs"]),
        ([0, 1], ["(2,)"]),
        ([(0, 2**63)], ["row 0"]),
    ],
)
def test_edges_that_do_not_fit_are_named(edges, words):
    with pytest.raises(InputError) as caught:
        as_edges(edges, 3)
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize("count", [0, 1, PART, PART + 1, 5 * PART - 3])
def test_parts_cover_all_rows_once_and_are_not_long(count):
    rows = np.zeros(count, int)
    for part in in_parts(count):
        rows[part] += 1
        assert part.stop - part.start <= PART
    assert (rows == 1).all()
