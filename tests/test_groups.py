"""Methods within groups: the same as a loop over the groups."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import crustline as cl
import generators as make
from test_laws import NEEDED

RNG = np.random.default_rng(5)
SIZES = (1, 0, 2, 3, 40, 5, 90)
LABELS = RNG.permutation(np.repeat(np.arange(len(SIZES)), SIZES))
POINTS = np.concatenate(
    [make.degenerate(RNG)[:20], make.general_position(RNG), RNG.random((141, 2))]
)[:141]


def _looped(points: Any, labels: Any, method: Any, *parameters: Any) -> list[list[int]]:
    edges = []
    for label in np.unique(labels):
        rows = np.flatnonzero(labels == label)
        edges += rows[method(points[rows], *parameters)].tolist()
    return sorted(edges)


@pytest.mark.parametrize("name", cl.METHODS)
def test_edges_by_group_are_those_of_a_loop(name: str) -> None:
    method, needed = cl.METHODS[name], NEEDED.get(name, ())
    names = list(cl.methods.parameters_of(method))
    edges = cl.by_group(POINTS, LABELS, method, **dict(zip(names, needed, strict=False)))
    assert edges.tolist() == _looped(POINTS, LABELS, method, *needed)


def test_labels_may_be_text_and_methods_a_users_own() -> None:
    labels = np.array(list("abcdefg"))[LABELS]

    def nearest(points: cl.Points) -> list[tuple[int, int]]:
        return [(0, 1)] if len(points) > 1 else []

    assert cl.by_group(POINTS, labels).tolist() == cl.by_group(POINTS, LABELS).tolist()
    assert cl.by_group(POINTS, labels, nearest).tolist() == _looped(
        POINTS, LABELS, lambda points: np.array(nearest(points), np.int64).reshape(-1, 2)
    )


def test_no_points_and_one_group_are_groups() -> None:
    assert cl.by_group([], []).shape == (0, 2)
    assert cl.by_group(POINTS, np.zeros(141), cl.crust).tolist() == cl.crust(POINTS).tolist()


def test_points_carry_their_labels_and_threads() -> None:
    points = cl.Points(POINTS, columns={"part": LABELS})
    edges = cl.by_group(cl.Delaunay(points, threads=1), points.columns["part"], cl.crust)
    assert edges.tolist() == cl.by_group(POINTS, LABELS, cl.crust).tolist()


@pytest.mark.parametrize(
    ("labels", "message"),
    [
        ([1, 2], r"groups: the shape is \(2,\), not \(3,\)"),
        ([1, np.nan, 2], "groups: row 1 has no label"),
        ([1, None, "a"], "groups: the labels cannot be sorted"),
    ],
)
def test_labels_that_do_not_fit_are_refused(labels: list[Any], message: str) -> None:
    with pytest.raises(cl.InputError, match=message):
        cl.by_group(np.eye(3, 2), np.array(labels, object if None in labels else None))


def test_an_error_names_the_row_among_all_points() -> None:
    points = [(0, 0), (1e300, 1), (0, 5), (1e-300, 1)]
    with pytest.raises(cl.InputError, match="row 3"):
        cl.by_group(points, [0, 1, 0, 1], cl.crust)
