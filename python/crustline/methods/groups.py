"""Many sets of points in one call: a method within each group of rows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike

from crustline import _core
from crustline.arrays import FloatArray, IntArray, as_edges, not_too_deep
from crustline.delaunay import Delaunay, How, Made, points_and_how
from crustline.errors import InputError
from crustline.methods.connect import connect
from crustline.methods.parameters import as_method


def by_group(
    points: ArrayLike | Delaunay,
    groups: ArrayLike,
    method: Callable[..., IntArray] = connect,
    **parameters: Any,
) -> IntArray:
    """Return the edges that a method selects within each group of points.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
        Coordinates, in any one unit. Finite. Points that are equal count once in each group. A
        `Delaunay` brings its threads and progress.
    groups : array_like, shape (n,)
        The group of each point: numbers, text, dates, or objects that can be sorted.
    method : callable, default `connect`
        A method: the library's own, or any function from points to edges.
    **parameters
        The parameters of the method.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, both of one group, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `groups` does not have one label a point, a label is missing (NaN), or labels cannot be
        sorted; and what the method raises. Messages name the row.

    Notes
    -----
    Each group is triangulated by itself, so the edges are those of a loop over the groups. The
    library's methods take all groups in one call of the core, on several threads: thousands of
    small groups cost little more than as many points in one set. O(n log n) time.

    Examples
    --------
    Two squares, one inside the other, told apart by their labels:

    >>> square = [(0, 0), (3, 0), (3, 3), (0, 3)]
    >>> points = square + [(1, 1), (2, 1), (2, 2), (1, 2)]
    >>> by_group(points, ["a"] * 4 + ["b"] * 4).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3], [4, 5], [4, 7], [5, 6], [6, 7]]
    """
    carried, how = points_and_how(points)
    as_method(method, parameters)
    _refuse_rows(method, parameters)
    rows, ends = _split(groups, len(carried))
    at_once = _Groups(carried.xy, rows, ends, how)
    if getattr(method, "__module__", "").startswith("crustline."):
        try:
            return method(at_once, **parameters)
        except _NeedsMoreError:
            pass
    parts = [np.empty((0, 2), np.int64)]
    for group in np.split(rows, ends[:-1]) if len(ends) else []:
        edges = as_edges(method(carried.select(group), **parameters), len(group))
        parts.append(group[edges])
    return as_edges(np.concatenate(parts), len(carried))


def _refuse_rows(method: Callable[..., IntArray], parameters: dict[str, Any]) -> None:
    """Refuse hints that are rows: each group has rows of its own."""
    for name in {"keep", "forbid", "ends"} & set(parameters) if method is connect else ():
        raise InputError(f"{name}: rows of all points mean nothing within a group: leave it away")


def _split(groups: ArrayLike, count: int) -> tuple[IntArray, IntArray]:
    """Return the rows of the groups one after another, and where each group ends."""
    try:
        labels = np.asarray(not_too_deep(groups, most=2))
    except (ValueError, TypeError, OverflowError):
        raise InputError("groups: the labels are no flat list: pass one label a point") from None
    if labels.shape != (count,):
        raise InputError(
            f"groups: the shape is {labels.shape}, not ({count},): pass one label a point"
        )
    missing = labels != labels
    if missing.any():
        raise InputError(
            f"groups: row {missing.argmax()} has no label: give it one, or remove the row"
        )
    try:
        _, number = np.unique(labels, return_inverse=True)
    except TypeError:
        raise InputError("groups: the labels cannot be sorted: pass numbers, or text") from None
    rows = np.argsort(number, kind="stable")
    return rows, np.cumsum(np.bincount(number))


class _NeedsMoreError(Exception):
    """A method asks for more of a triangulation than what the core selects from it."""


class _Groups(Delaunay):
    """What a method of the core takes for a triangulation: that of every group."""

    def __init__(self, xy: FloatArray, rows: IntArray, ends: IntArray, how: How) -> None:
        self._parts = (xy, rows, ends)
        self._how = how

    def run(self, work: Callable[..., Made], *arguments: Any) -> Any:
        if work is _core.select:
            method, parameters = arguments
        elif work is _core.connect and arguments == (None,):
            method, parameters = "connect", []
        else:
            raise _NeedsMoreError
        return _core.select_by_group(*self._parts, method, parameters, *self._how)

    def cached(self, name: str, make: Callable[[], Made], fits: Any = None) -> Made:
        return make()

    def __getattr__(self, name: str) -> NoReturn:
        raise _NeedsMoreError(name)
