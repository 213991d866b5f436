"""Where a table holds points: in two columns of numbers, or in one of geometries."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from crustline.arrays import BoolArray, FloatArray
from crustline.errors import FormatError, InputError
from crustline.formats.names import find_coordinates

#: The size of a point in well-known binary, and of one with a height.
_WKB_SIZES = (21, 29)
_UNLIKE = "has a geometry that is no point like the others: give points"


@dataclass(frozen=True)
class Place:
    """The columns that hold points, and how.

    Attributes
    ----------
    columns : tuple of str
        Those of x and y, or the one of geometries.
    encoding : {"numbers", "wkb", "point", "geometry"}
        Numbers, well-known binary, structures of x and y, or objects of geopandas.
    """

    columns: tuple[str, ...]
    encoding: str = "numbers"

    def points(self, table: Any, first: int = 0) -> Any:
        """Return the points of a record batch, or of a frame of pandas, shape (k, 2).

        Messages count its rows from the `first` one.
        """
        if self.encoding == "geometry":
            return _of_geometry(table[self.columns[0]], first)
        columns = [table[name] for name in self.columns]
        for name, column in zip(self.columns, columns, strict=True):
            missing = np.asarray(column.is_null() if hasattr(column, "is_null") else column.isna())
            _refuse(missing, f"has no {name}: remove or repair the row", first)
        if self.encoding == "numbers":
            return np.stack([_numbers(column) for column in columns], axis=1)
        return _of_wkb(columns[0], first) if self.encoding == "wkb" else _of_structures(columns[0])


def _refuse(wrong: BoolArray, fault: str, first: int) -> None:
    """Raise `InputError` with the first row that is wrong, if there is one."""
    if wrong.any():
        raise InputError(f"row {first + int(np.argmax(wrong))} {fault}")


def _numbers(column: Any) -> Any:
    return (
        column.to_numpy(zero_copy_only=False) if hasattr(column, "is_null") else column.to_numpy()
    )


def _of_structures(column: Any) -> FloatArray:
    fields = [column.field(name).to_numpy(zero_copy_only=False) for name in ("x", "y")]
    return np.stack(fields, axis=1)


def _of_wkb(column: Any, first: int) -> FloatArray:
    """Return the points of well-known binary: byte order, type, x, y and maybe z."""
    import pyarrow as pa

    column = column.cast(pa.large_binary())
    offsets = np.frombuffer(column.buffers()[1], np.int64)[column.offset :][: len(column) + 1]
    sizes = np.diff(offsets)
    if not len(sizes):
        return np.empty((0, 2))
    _refuse((sizes != sizes[0]) | ~np.isin(sizes, _WKB_SIZES), _UNLIKE, first)
    flat = np.frombuffer(column.buffers()[2], np.uint8)[offsets[0] : offsets[-1]]
    table = flat.reshape(len(sizes), -1)
    order = "<" if table[0, 0] == 1 else ">"
    kinds = table[:, 1:5].copy().view(f"{order}u4")[:, 0] % 1000
    _refuse((table[:, 0] != table[0, 0]) | (kinds & 0x0FFFFFFF != 1), _UNLIKE, first)
    return table[:, 5:21].copy().view(f"{order}f8").astype(np.float64)


def _of_geometry(column: Any, first: int) -> FloatArray:
    wrong = np.asarray(column.isna() | column.is_empty | (column.geom_type != "Point"))
    _refuse(wrong, "has a geometry that is no point: give points", first)
    return np.stack([column.x.to_numpy(), column.y.to_numpy()], axis=1)


def place_in_schema(schema: Any, columns: Sequence[str] | None, name: str) -> tuple[Place, Any]:
    """Return where a Parquet file of this Arrow schema holds points, and the CRS as it tells it."""
    about = json.loads((schema.metadata or {}).get(b"geo", b"null"))
    if columns is None and about is not None:
        column = about["primary_column"]
        told = about["columns"][column]
        encoding = str(told.get("encoding", "")).lower()
        if encoding not in ("wkb", "point"):
            raise FormatError(
                f"{name}: {column} is encoded as {encoding!r}: write it as WKB points"
            )
        return Place((column,), encoding), told.get("crs")
    positions = find_coordinates(schema.names, columns, name)[:2]
    place = Place(tuple(schema.names[k] for k in positions))
    for column in place.columns:
        refuse_text(schema.field(column).type, column, name)
    return place, None


def refuse_text(kind: Any, column: str, name: str) -> None:
    """Refuse a column of an Arrow type that is no number."""
    import pyarrow as pa

    if not (pa.types.is_floating(kind) or pa.types.is_integer(kind)):
        message = (
            f"{name}: the column {column} holds {kind}, no numbers: choose others with columns"
        )
        raise FormatError(message)


def place_in_frame(frame: Any, columns: Sequence[str] | None) -> Place:
    """Return where a Dask frame holds points."""
    geometry = getattr(frame, "_geometry_column_name", None)
    meta = getattr(frame, "_meta", frame)
    geometry = geometry or getattr(meta, "_geometry_column_name", None)
    if columns is None and geometry is not None:
        return Place((geometry,), "geometry")
    names = [str(name) for name in meta.columns]
    positions = find_coordinates(names, columns, "the frame")[:2]
    return Place(tuple(names[k] for k in positions))
