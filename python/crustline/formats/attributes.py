"""What points carry beside their coordinates: heights, columns, and how files name them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves
from crustline.errors import FormatError
from crustline.points import Points

# Names of x and y, the surest first.
_PAIRS = (
    ("x", "y"),
    ("lon", "lat"),
    ("longitude", "latitude"),
    ("easting", "northing"),
    ("e", "n"),
)
_HEIGHTS = ("z", "elevation", "height")


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


def find_coordinates(
    names: Sequence[str], chosen: Sequence[str | int] | None, source: str
) -> list[int]:
    """Return the positions of x, y and, if there is one, z among the names of columns."""
    if chosen is not None:
        return [_position(each, names, source) for each in chosen]
    lower = [name.strip().lower() for name in names]
    pair = find_pair(names)
    if pair is None:
        raise FormatError(
            f"{source} has no columns x and y, only {quote_all(names)}: "
            "choose two of them with columns (--columns X,Y)"
        )
    heights = [lower.index(name) for name in _HEIGHTS if name in lower]
    return [*pair, *heights[:1]]


def find_pair(names: Sequence[str]) -> tuple[int, int] | None:
    """Return the positions of the first known pair of names, in any case."""
    lower = [name.strip().lower() for name in names]
    pairs = ((lower.index(x), lower.index(y)) for x, y in _PAIRS if x in lower and y in lower)
    return next(pairs, None)


def _position(chosen: str | int, names: Sequence[str], source: str) -> int:
    if isinstance(chosen, str):
        if chosen in names:
            return list(names).index(chosen)
        lower = [name.lower() for name in names]
        if lower.count(chosen.lower()) == 1:
            return lower.index(chosen.lower())
        if chosen.isdecimal():
            chosen = int(chosen)
    if isinstance(chosen, int) and 0 <= chosen < len(names):
        return chosen
    raise FormatError(
        f"{source} has no column {chosen!r}: choose from {quote_all(names)}, "
        f"or a position from 0 to {len(names) - 1}"
    )


def quote_all(names: Sequence[str]) -> str:
    """Return names as a message lists them; a long list is cut."""
    shown = ", ".join(map(repr, names[:20]))
    return shown + (f" and {len(names) - 20} more" if len(names) > 20 else "")


def texts(values: npt.NDArray[Any]) -> list[str]:
    """Return a column as text, its numbers with the fewest digits that give them again."""
    if values.dtype.kind == "b":
        return ["true" if value else "false" for value in values.tolist()]
    if values.dtype.kind == "f":
        return list(map(repr, values.astype(np.float64).tolist()))
    if values.dtype.kind == "S":
        values = np.char.decode(values, "utf-8", "replace")
    return list(map(str, values.tolist() if values.dtype.kind not in "mM" else values))
