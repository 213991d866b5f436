"""Arrow tables: their columns as NumPy arrays and back, and points as well-known binary in bulk."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.errors import InputError

__all__ = ["as_arrow", "as_table", "as_wkb", "column_of", "points_of_wkb"]

Column = npt.NDArray[Any]
# A point as little-endian well-known binary (OGC 06-103r4, section 8), and the codes of its type.
_POINTS = {
    21: ([("order", "u1"), ("type", "<u4"), ("xyz", "<f8", (2,))], (1,)),
    29: ([("order", "u1"), ("type", "<u4"), ("xyz", "<f8", (3,))], (1001, 0x8000_0001)),
}


# Units of time that Arrow has.
_DURATIONS = ("s", "ms", "us", "ns")


def column_of(array: Any) -> Column:
    """Return an Arrow array as numbers, bools, dates or text; missing is NaN, NaT or "".

    Whole numbers or bools with missing ones among them become floats; lists and structures text.
    """
    import pyarrow as pa

    kind = array.type
    if pa.types.is_dictionary(kind):
        return column_of(array.cast(kind.value_type))
    if pa.types.is_duration(kind):
        return np.asarray(array.to_numpy(zero_copy_only=False))
    if pa.types.is_temporal(kind) and not pa.types.is_time(kind):
        unit = "us" if pa.types.is_timestamp(kind) else "D"
        return np.asarray(array.to_numpy(zero_copy_only=False)).astype(f"datetime64[{unit}]")
    if pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_boolean(kind):
        if array.null_count and not pa.types.is_floating(kind):
            array = array.cast(pa.float64())
        return np.asarray(array.to_numpy(zero_copy_only=False))
    return np.array([_as_text(value) for value in array.to_pylist()], dtype=np.object_)


def _as_text(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, list | dict):
        return json.dumps(value, ensure_ascii=False, default=str)
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def as_arrow(values: Column) -> Any:
    """Return a column as an Arrow array."""
    import pyarrow as pa

    if values.dtype.kind == "S":
        values = np.char.decode(values, "utf-8", "replace")
    if values.dtype.kind in "OU":
        return pa.array(values.tolist(), pa.string())
    if values.dtype.kind == "m" and np.datetime_data(values.dtype)[0] not in _DURATIONS:
        values = _as_unit(values, "s")
    if values.dtype.kind == "M" and np.datetime_data(values.dtype)[0] != "D":
        values = _as_unit(values, "us")  # as they are read
    if values.dtype.kind == "f":
        values = values.astype(np.float64, copy=False)
    return pa.array(np.ascontiguousarray(values))


def _as_unit(values: Column, unit: str) -> Column:
    """Return times or durations in another unit, or refuse those that it does not reach."""
    made = values.astype(f"{values.dtype.kind}8[{unit}]")
    if (~np.isnat(values) & (made.astype(values.dtype) != values)).any():
        raise InputError(f"a time in a column is beyond what {unit} reach: write it as a number")
    return made


def as_table(columns: Mapping[str, Any]) -> Any:
    """Return columns, NumPy or Arrow arrays, as an Arrow table."""
    import pyarrow as pa

    arrays = [as_arrow(each) if isinstance(each, np.ndarray) else each for each in columns.values()]
    return pa.table(arrays, names=list(columns))


def as_wkb(xy: FloatArray, z: FloatArray | None) -> Any:
    """Return points as an Arrow array of well-known binary, without a Python object a point."""
    import pyarrow as pa

    size = 21 if z is None else 29
    fields, codes = _POINTS[size]
    points = np.empty(len(xy), dtype=fields)
    points["order"], points["type"] = 1, codes[0]
    points["xyz"][:, :2] = xy
    if z is not None:
        points["xyz"][:, 2] = z
    small = points.nbytes < 2**31
    offsets = np.arange(len(xy) + 1, dtype=np.int32 if small else np.int64) * size
    kind = pa.binary() if small else pa.large_binary()
    buffers = [None, pa.py_buffer(offsets), pa.py_buffer(points.view(np.uint8))]
    return pa.Array.from_buffers(kind, len(xy), buffers)


def points_of_wkb(array: Any) -> FloatArray | None:
    """Return the coordinates (n, 2) or (n, 3) if all of an Arrow array are points, else None."""
    parts = [_points_of_chunk(chunk) for chunk in getattr(array, "chunks", [array]) if len(chunk)]
    found = [part for part in parts if part is not None]
    if not found or len(found) < len(parts) or len({part.shape[1] for part in found}) > 1:
        return None
    return np.concatenate(found)


def _points_of_chunk(chunk: Any) -> FloatArray | None:
    import pyarrow as pa

    if chunk.null_count or not (
        pa.types.is_binary(chunk.type) or pa.types.is_large_binary(chunk.type)
    ):
        return None
    wide = np.int64 if pa.types.is_large_binary(chunk.type) else np.int32
    _, offsets, data = chunk.buffers()
    ends = np.frombuffer(offsets, wide)[chunk.offset : chunk.offset + len(chunk) + 1]
    size = int(ends[1] - ends[0])
    if size not in _POINTS or (np.diff(ends) != size).any():
        return None
    fields, codes = _POINTS[size]
    points = np.frombuffer(data, fields, len(chunk), int(ends[0]))
    if not ((points["order"] == 1) & np.isin(points["type"], codes)).all():
        return None
    return np.ascontiguousarray(points["xyz"])
