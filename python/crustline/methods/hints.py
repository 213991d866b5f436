"""Hints: what the caller knows of the curves that `connect` looks for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import IntArray, as_edges, as_rows
from crustline.delaunay import Delaunay
from crustline.errors import InputError, shown
from crustline.scalars import MOST_POINTS, as_flag, as_positive, as_whole

__all__ = ["Hints", "as_hints"]


@dataclass(frozen=True, eq=False)
class Hints:
    """Hints as the core takes them, repeated points by their first row."""

    keep: IntArray
    forbid: IntArray
    ends: IntArray
    longest: float | None
    in_spacings: bool
    fewest: int
    components: int | None
    every_point: bool
    closed: bool
    junctions: bool


_FLAGS = ("every_point", "closed", "junctions")


def as_hints(delaunay: Delaunay, told: Mapping[str, Any]) -> Hints | None:
    """Return what `connect` was told by name, if it fits the points and itself; None for nothing.

    An `InputError` names what does not fit, or contradicts each other.
    """
    flags = {name: as_flag(name, told.get(name, False)) for name in _FLAGS}
    given = {name: value for name, value in told.items() if value is not None and name not in flags}
    if not given and not any(flags.values()):
        return None
    longest, in_spacings = _longest(given.get("max_edge"))
    hints = Hints(
        _edges("keep", given.get("keep"), delaunay),
        _edges("forbid", given.get("forbid"), delaunay),
        _points("ends", given.get("ends"), delaunay),
        longest,
        in_spacings,
        as_whole("min_points", given.get("min_points", 1), 1, MOST_POINTS),
        as_whole("components", given["components"], 0) if "components" in given else None,
        **flags,
    )
    _refuse_contradictions(hints, delaunay.points.xy)
    return hints


def _longest(max_edge: object) -> tuple[float | None, bool]:
    """Return the number of "3x", and whether it counts spacings."""
    if not isinstance(max_edge, str):
        return (None if max_edge is None else as_positive("max_edge", max_edge)), False
    try:
        number = float(max_edge.removesuffix("x"))
    except ValueError:
        raise InputError(
            f"max_edge must be a length, or a multiple of the spacing such as '3x', not "
            f"{shown(max_edge)}"
        ) from None
    return as_positive("max_edge", number), max_edge.endswith("x")


def _first_rows(delaunay: Delaunay) -> IntArray:
    first = np.arange(len(delaunay))
    first[delaunay.duplicates[:, 0]] = delaunay.duplicates[:, 1]
    return first


def _edges(name: str, edges: ArrayLike | None, delaunay: Delaunay) -> IntArray:
    if edges is None:
        return np.empty((0, 2), np.int64)
    given = _named(name, as_edges, edges, len(delaunay))
    moved = _first_rows(delaunay)[given]
    same = moved[:, 0] == moved[:, 1]
    if same.any():
        i, j = given[np.argmax(same)].tolist()
        raise InputError(f"{name}: rows {i} and {j} are the same point: remove this edge")
    return as_edges(moved, len(delaunay))


def _points(name: str, rows: ArrayLike | None, delaunay: Delaunay) -> IntArray:
    if rows is None:
        return np.empty(0, np.int64)
    return np.unique(_first_rows(delaunay)[_named(name, as_rows, rows, len(delaunay))])


def _named(name: str, door: Any, given: object, n: int) -> IntArray:
    """Return what a door makes of rows, which are called by the name of the hint."""
    try:
        made: IntArray = door(given, n)
    except InputError as error:
        said = str(error).removeprefix("edges: ").removeprefix("rows: ")
        raise InputError(f"{name}: {said}") from None
    return made


def _refuse_contradictions(hints: Hints, xy: np.ndarray) -> None:
    both = _shared(hints.keep, hints.forbid, len(xy))
    if both is not None:
        raise InputError(f"keep and forbid contradict each other: the edge {both} is in both")
    degrees = np.bincount(hints.keep.ravel(), minlength=len(xy))
    if degrees.max(initial=0) > 2:
        row = int(np.argmax(degrees > 2))
        raise InputError(f"keep: {degrees[row]} edges meet at row {row}: a curve has two at most")
    full = hints.ends[degrees[hints.ends] > 1]
    if len(full):
        raise InputError(
            f"keep and ends contradict each other: two edges to keep meet at {full[0]}"
        )
    if hints.every_point and hints.fewest > 1:
        raise InputError(
            f"every_point and min_points={hints.fewest} contradict each other: pass one of them"
        )
    if hints.closed and len(hints.ends):
        raise InputError(
            f"closed and ends contradict each other: a ring has no end at row {hints.ends[0]}"
        )
    _refuse_many(hints, len(np.unique(xy, axis=0)) if hints.components else 0)
    if hints.longest is not None and not hints.in_spacings:
        _refuse_long(hints.keep, hints.longest, xy)


def _refuse_many(hints: Hints, points: int) -> None:
    least = 3 if hints.closed else 2
    if hints.components and hints.components * least > points:
        raise InputError(
            f"components={hints.components}: {points} points are too few for so many "
            f"{'rings' if hints.closed else 'curves'}: pass {points // least} at most"
        )


def _shared(one: IntArray, other: IntArray, n: int) -> list[int] | None:
    """Return the first edge that is in both lists."""
    keys = np.intersect1d(one @ [n, 1], other @ [n, 1])
    return [int(part) for part in divmod(keys[0], n)] if len(keys) else None


def _refuse_long(edges: IntArray, longest: float, xy: np.ndarray) -> None:
    lengths = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T)
    if (lengths > longest).any():
        row = int(np.argmax(lengths > longest))
        raise InputError(
            f"keep and max_edge contradict each other: the edge {edges[row].tolist()} is "
            f"{lengths[row]:g} long, and max_edge is {longest:g}"
        )
