"""What points carry beside their coordinates: heights, columns, and how files name them."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves
from crustline.formats.names import find_coordinates, find_pair
from crustline.points import Points


@dataclass(frozen=True)
class Attributes:
    """Heights, columns and CRS of points; nothing of it for a bare array."""

    z: FloatArray | None
    columns: dict[str, npt.NDArray[Any]]
    crs: str | None


def attributes_of(curves: Curves, reserved: Collection[str] = ()) -> Attributes:
    """Return what the points of curves carry; a column with a reserved name becomes input_NAME."""
    return attributes_of_points(curves.points, reserved)


def attributes_of_points(points: Points, reserved: Collection[str] = ()) -> Attributes:
    """Return what points carry, for `attributes_of`."""
    columns: dict[str, npt.NDArray[Any]] = {}
    taken = {*reserved, *points.columns} - (set(reserved) & set(points.columns))
    for name, values in points.columns.items():
        free = name
        while free in reserved or (free != name and free in taken):
            free = f"input_{free}"
        taken.add(free)
        columns[free] = values
    return Attributes(points.z, columns, points.crs)


def table_of(points: Points) -> dict[str, npt.NDArray[Any]]:
    """Return the coordinates, z and the other columns, by names that lead back to the same.

    The coordinates keep their names if these are known ones, else they are x and y; a column that
    would be taken for a coordinate becomes input_NAME.
    """
    known = find_pair(points.names) == (0, 1)
    columns: dict[str, npt.NDArray[Any]] = dict(
        zip(points.names if known else ("x", "y"), points.xy.T, strict=True)
    )
    if points.z is not None:
        columns["z"] = points.z
    reserved: set[str] = set(columns)
    while True:
        others = attributes_of_points(points, reserved).columns
        taken = _mistaken([*columns, *others], len(columns))
        if not taken:
            return columns | others
        reserved |= taken


def _mistaken(names: list[str], coordinates: int) -> set[str]:
    """Return names of other columns that reading would take for coordinates."""
    pair = find_pair(names)
    found = find_coordinates(names, None, "") if pair else []
    if found == list(range(coordinates)):
        return set()
    return {names[k] for k in found if k >= coordinates} or set(names[coordinates:])


def without_curves(points: Points) -> Curves:
    """Return points as curves of which there are none: every row is isolated, repeated ones too."""
    none = np.zeros(0, dtype=np.int64)
    rows = np.arange(len(points))
    return Curves(points, none, np.zeros(1, np.int64), none.astype(bool), rows)


def coordinates_with_height(curves: Curves, rows: IntArray) -> FloatArray:
    """Return the coordinates of some rows, shape (k, 2), or (k, 3) where there are heights."""
    z = attributes_of(curves).z
    coordinates = curves.points.xy[rows]
    return coordinates if z is None else np.column_stack([coordinates, z[rows]])


def texts(values: npt.NDArray[Any]) -> list[str]:
    """Return a column as text, its numbers with the fewest digits that give them again."""
    if values.dtype.kind == "b":
        return ["true" if value else "false" for value in values.tolist()]
    if values.dtype.kind == "f":
        return list(map(repr, values.astype(np.float64).tolist()))
    if values.dtype.kind == "S":
        values = np.char.decode(values, "utf-8", "replace")
    return list(map(str, values.tolist() if values.dtype.kind not in "mM" else values))
