"""Arrow tables: their columns as NumPy arrays and back, and points as well-known binary in bulk."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
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
# The same to be read: order and type within one number, x and y as bytes, in half the time.
_READ = {
    size: np.dtype({
        "names": ["head", "xy"] + ["z"] * (size == 29),
        "formats": ["<u8", "V16"] + ["<f8"] * (size == 29),
        "offsets": [0, 5] + [21] * (size == 29),
        "itemsize": size,
    })
    for size in _POINTS
}  # fmt: skip
_HEAD = 2**40 - 1
_LARGEST = max(_POINTS)
_BLOCK = 1 << 14


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


def points_of_wkb(array: Any) -> tuple[FloatArray, FloatArray | None] | None:
    """Return the coordinates (n, 2), and heights if there are, if all of an Arrow array are points.

    They are taken a block at a time, which stays in the processor's cache.
    """
    chunks = [chunk for chunk in getattr(array, "chunks", [array]) if len(chunk)]
    sizes = {_size_of_points(chunk) for chunk in chunks}
    if len(sizes) != 1 or None in sizes or sys.byteorder != "little":
        return None
    size = int(sizes.pop() or 0)
    xy = np.empty((sum(map(len, chunks)), 2))
    z = np.empty(len(xy)) if size == _LARGEST else None
    pairs, heads = xy.view("V16")[:, 0], [code << 8 | 1 for code in _POINTS[size][1]]
    place = 0
    for block in _blocks(chunks, size):
        end = place + len(block)
        found = block["head"] & _HEAD
        if not ((found == heads[0]).all() or np.isin(found, heads).all()):
            return None
        pairs[place:end] = block["xy"]
        if z is not None:
            z[place:end] = block["z"]
        place = end
    return xy, z


def _size_of_points(chunk: Any) -> int | None:
    """Return how many bytes each geometry of a chunk has, if it is as many as those of points."""
    import pyarrow as pa

    if chunk.null_count or not (
        pa.types.is_binary(chunk.type) or pa.types.is_large_binary(chunk.type)
    ):
        return None
    ends = _ends_of(chunk)
    size = int(ends[1]) - int(ends[0])
    even = size in _POINTS and all(
        (np.diff(ends[k : k + _BLOCK + 1]) == size).all() for k in range(0, len(chunk), _BLOCK)
    )
    return size if even else None


def _ends_of(chunk: Any) -> npt.NDArray[Any]:
    import pyarrow as pa

    wide = np.int64 if pa.types.is_large_binary(chunk.type) else np.int32
    offsets = np.frombuffer(chunk.buffers()[1], wide)
    return offsets[chunk.offset : chunk.offset + len(chunk) + 1]


def _blocks(chunks: list[Any], size: int) -> Iterator[npt.NDArray[Any]]:
    for chunk in chunks:
        first = int(_ends_of(chunk)[0])
        points = np.frombuffer(chunk.buffers()[2], _READ[size], len(chunk), first)
        for start in range(0, len(points), _BLOCK):
            yield points[start : start + _BLOCK]
