"""NumPy's own files: both are read, curves are written as NPZ, points as both."""

from __future__ import annotations

import io
import math
import zipfile
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import read_only
from crustline.curves import Curves, trace
from crustline.errors import FormatError
from crustline.formats.attributes import attributes_of_points
from crustline.formats.format import Format
from crustline.formats.names import find_coordinates, find_pair, quote_all
from crustline.formats.options import COLUMNS
from crustline.formats.packed import refuse_bomb
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.orientation import ORIENTATIONS, arranged
from crustline.points import Points

Array = npt.NDArray[Any]
_PREFIX = "columns/"
# Version 3 differs from 2 in the encoding of names alone, which `_names_of` sees to.
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
    (3, 0): np.lib.format.read_array_header_2_0,
}
_RESULT = ("indices", "offsets", "closed", "isolated")
_BESIDE = (*_RESULT, "orient", "confidence")
_LAST_CHARACTER = 0x10FFFF


def read_npy(source: Source, *, columns: Sequence[str | int] | None = None) -> Points:
    """Return the points of one array (n, 2), (n, 3) with heights, or (n,) with fields x and y."""
    content = source.content()
    if content.startswith(b"PK"):
        raise FormatError(f"{source.name} is an NPZ archive, not an NPY file: choose format npz")
    _check_magic(content, b"\x93NUMPY", source)
    array = _array(content, source, "")
    if array.ndim == 1 and array.dtype.names is not None:
        fields = zip(_names_of(array.dtype, content), array.dtype.names, strict=True)
        return _from_arrays({name: array[field] for name, field in fields}, source, columns)
    if array.ndim != 2 or array.shape[1] < 2 or (columns is None and array.shape[1] > 3):
        raise FormatError(
            f"{source.name} has the shape {array.shape}, not (n, 2) or (n, 3): "
            "choose columns by position"
        )
    names = [*"xyz", *(f"column{k}" for k in range(3, array.shape[1]))][: array.shape[1]]
    return _from_arrays(dict(zip(names, array.T, strict=True)), source, columns)


def read_npz(source: Source, *, columns: Sequence[str | int] | None = None) -> Points:
    """Return the points of an archive: array points, or x and y, with z, crs and other columns."""
    return _points_of(_members(source), source, columns)


def read_npz_curves(source: Source) -> Curves:
    """Return the curves that an archive of ours holds."""
    arrays = _members(source)
    if not {"points", *_RESULT} <= arrays.keys():
        raise source.error(f"it holds no curves, only {quote_all(list(arrays))}: read its points")
    edges = _edges(arrays["indices"], arrays["offsets"], arrays["closed"], source)
    with source.named():
        curves = trace(_points_of(arrays, source, None), edges)
    sure = arrays.get("confidence", np.empty(0))
    if sure.shape == (len(curves.edges),) and sure.dtype == np.float64:
        curves = replace(curves, confidence=sure)
    orient = _as_word(arrays.get("orient"))
    return _as_stored(curves, arrays["indices"], orient if orient in ORIENTATIONS else None)


def _as_stored(curves: Curves, indices: Array, orient: str | None) -> Curves:
    """Return curves in the directions, and from the starts, that they were written with."""
    if not len(curves) or len(indices) != len(curves.indices):
        return curves
    sizes, starts = np.diff(curves.offsets), curves.offsets[:-1]
    first = curves.indices == np.repeat(indices[starts], sizes)
    place = np.flatnonzero(first)
    if (
        len(place) != len(curves)
        or (np.repeat(np.arange(len(curves)), sizes)[place] != np.arange(len(curves))).any()
    ):
        return curves
    ways = [
        np.logical_and.reduceat(
            arranged(curves.indices, curves.offsets, place - starts, np.full(len(curves), way))
            == indices,
            starts,
        )
        for way in (False, True)
    ]
    if not (ways[0] | (ways[1] & (~curves.closed | (orient is not None)))).all():
        return curves
    return replace(curves, indices=read_only(indices.astype(np.int64)), orient=orient)


def _points_of(
    arrays: dict[str, Array], source: Source, columns: Sequence[str | int] | None
) -> Points:
    crs, names = _as_word(arrays.get("crs")), arrays.get("names")
    arrays = {name: array for name, array in arrays.items() if name not in ("crs", "names")}
    if "points" in arrays and columns is None:
        if set(_RESULT) <= arrays.keys():  # a result of ours: a ring of n points is no column
            arrays = {name: array for name, array in arrays.items() if name not in _BESIDE}
        points = _with_columns(arrays, names, source)
    else:
        points = _from_arrays(arrays, source, columns)
    return points.replace(crs=crs)


def _edges(indices: Array, offsets: Array, closed: Array, source: Source) -> Array:
    """Return the edges along ragged curves."""
    fits = indices.dtype.kind == offsets.dtype.kind == "i" and closed.dtype.kind == "b"
    fits = fits and indices.ndim == offsets.ndim == closed.ndim == 1
    if not fits or len(offsets) != len(closed) + 1:
        raise source.error("its indices, offsets and closed do not fit together: write it again")
    parts = np.split(indices, offsets[1:-1]) if len(closed) else []
    steps = [
        np.stack([part, np.roll(part, -1)], axis=1)[: len(part) - (not ring)]
        for part, ring in zip(parts, closed.tolist(), strict=True)
    ]
    return np.concatenate([np.empty((0, 2), np.int64), *steps])


def write_npz_curves(curves: Curves, target: Target) -> None:
    """Write the curves as an archive of arrays, with the points in the order of the input."""
    result = {name: getattr(curves, name) for name in _BESIDE}
    known = {name: np.asarray(each) for name, each in result.items() if each is not None}
    target.write(_archive({"points": curves.points.xy, **known, **_carried(curves.points)}))


def write_npy(points: Points, target: Target) -> None:
    """Write points as one array (n, 2), or (n, 3) with heights; NPY has no other columns."""
    array = np.asarray(points)
    stream = io.BytesIO()
    np.save(stream, array if points.z is None else np.column_stack([array, points.z]))
    target.write(stream.getvalue())


def write_npz(points: Points, target: Target) -> None:
    """Write points as an archive of arrays: points, and z, crs, names and columns/NAME."""
    target.write(_archive({"points": np.asarray(points), **_carried(points)}))


def _carried(points: Points) -> dict[str, Array]:
    """Return what points carry, as arrays that need no pickle."""
    attributes = attributes_of_points(points)
    arrays: dict[str, Array] = {}
    for name, values in attributes.columns.items():
        text = values.dtype.kind == "O"  # which only a pickle could hold
        arrays[_PREFIX + name] = values.astype(np.str_) if text else values
    if attributes.z is not None:
        arrays["z"] = attributes.z
    if attributes.crs is not None:
        arrays["crs"] = np.array(attributes.crs)
    if isinstance(points, Points):
        arrays["names"] = np.array(points.names)
    return arrays


def _archive(arrays: dict[str, Any]) -> bytes:
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def _check_magic(content: bytes, magic: bytes, source: Source) -> None:
    if not content.startswith(magic):
        raise FormatError(f"{source.name} is no NPY or NPZ file: choose its format")


def _members(source: Source) -> dict[str, Array]:
    content = source.content()
    if content.startswith(b"\x93NUMPY"):
        raise FormatError(f"{source.name} is an NPY file, not an NPZ archive: choose format npy")
    _check_magic(content, b"PK", source)
    with source.library("zipfile"):
        archive = zipfile.ZipFile(io.BytesIO(content))
        refuse_bomb(sum(each.file_size for each in archive.infolist()), len(content), source.name)
        members = {
            each.filename.removesuffix(".npy"): archive.read(each) for each in archive.infolist()
        }
    return {name: _array(member, source, name) for name, member in members.items()}


def _array(content: bytes, source: Source, name: str) -> Array:
    """Return the array of an NPY file; its header must say how many bytes follow, no more."""
    place = f"array {name!r:.60}" if name else ""
    stream = io.BytesIO(content)
    try:
        header = _HEADERS[np.lib.format.read_magic(stream)]
        shape, columns_first, dtype = header(stream)
    except Exception as error:  # a broken header raises half a dozen kinds
        raise source.error(f"no NumPy file of numbers ({str(error)[:80]})", place) from None
    if dtype.hasobject:
        advice = "it holds Python objects, which are not read: save numbers or text"
        raise source.error(advice, place)
    count, rest = math.prod(shape), len(content) - stream.tell()
    if (dtype.names and place) or count * dtype.itemsize != rest or (count and not dtype.itemsize):
        raise source.error(
            f"the header says {dtype} of shape {shape}, which the {rest} bytes after it are not: "
            "save it again",
            place,
        )
    array = np.frombuffer(content, dtype, count, stream.tell()) if count else np.empty(0, dtype)
    for each in map(array.__getitem__, dtype.names) if dtype.names else [array]:
        if each.dtype.kind == "U" and _has_no_characters(each):
            raise source.error("its text holds what is no character: write it again", place)
    return array.reshape(shape, order="F" if columns_first else "C")


def _has_no_characters(text: Array) -> bool:
    """Return whether text holds numbers that are none of characters, which Python cannot take."""
    code = np.dtype(np.uint32).newbyteorder(text.dtype.byteorder)
    return bool((np.ascontiguousarray(text).view(code) > _LAST_CHARACTER).any())


def _names_of(dtype: np.dtype[Any], content: bytes) -> list[str]:
    """Return the names of fields: UTF-8 in files of version 3, which was read as Latin-1."""
    names = list(dtype.names or ())
    if content[6] < 3:
        return names
    return [name.encode("latin-1").decode("utf-8", "replace") for name in names]


def _as_word(array: Array | None) -> str | None:
    """Return the text of an array that is one word."""
    one = array is not None and array.ndim == 0 and array.dtype.kind == "U"
    return str(array) if one else None


def _from_arrays(
    arrays: dict[str, Array], source: Source, columns: Sequence[str | int] | None
) -> Points:
    flat = {name: array for name, array in arrays.items() if array.ndim == 1}
    names = [name.removeprefix(_PREFIX) for name in flat]
    tables = [name for name, array in arrays.items() if array.ndim == 2]
    if columns is None and len(tables) == 1 and find_pair(names) is None:
        renamed = {"points" if name in tables else name: arrays[name] for name in arrays}
        return _with_columns(renamed, None, source)
    if columns is None and find_pair(names) is None:
        raise FormatError(
            f"{source.name} holds the arrays {quote_all(list(arrays))}: name the points x and y, "
            "or points, or choose columns (--columns X,Y)"
        )
    positions = find_coordinates(names, columns, source.name)
    chosen = [list(flat)[k] for k in positions]
    first, second, *height = (flat[name] for name in chosen)
    if len(first) != len(second):
        raise FormatError(
            f"{source.name}: {chosen[0]!r} has {len(first)} rows, {chosen[1]!r} {len(second)}"
        )
    pair = (names[positions[0]], names[positions[1]])
    rest = {name: array for name, array in arrays.items() if name not in chosen}
    return _points(
        np.column_stack([first, second]), height[0] if height else None, rest, pair, source
    )


def _with_columns(arrays: dict[str, Array], names: Array | None, source: Source) -> Points:
    rest = {name: array for name, array in arrays.items() if name not in ("points", "z")}
    pair = ("x", "y") if names is None or names.shape != (2,) else tuple(map(str, names))
    table, z = arrays["points"], arrays.get("z")
    if z is None and table.ndim == 2 and table.shape[1] == 3:
        table, z = table[:, :2], table[:, 2]
    return _points(table, z, rest, pair, source)


def _points(
    table: Array, z: Array | None, rest: dict[str, Array], names: Sequence[str], source: Source
) -> Points:
    columns = {
        name.removeprefix(_PREFIX): array
        for name, array in rest.items()
        if array.shape == table.shape[:1]
    }
    with source.named():
        return Points(table, z=z, columns=columns, names=names)


def _is_npz(head: bytes) -> bool:
    """Return whether it is an archive whose first file is called NAME.npy."""
    name = head[30 : 30 + int.from_bytes(head[26:28], "little")]
    return head.startswith(b"PK\x03\x04") and name.endswith(b".npy")


NPY = Format(
    name="npy",
    title="NPY",
    suffixes=(".npy",),
    sniff=lambda head: head.startswith(b"\x93NUMPY"),
    read=read_npy,
    write_points=write_npy,
    options=(COLUMNS,),
)
NPZ = Format(
    name="npz",
    title="NPZ",
    suffixes=(".npz",),
    sniff=_is_npz,
    read=read_npz,
    read_curves=read_npz_curves,
    write_points=write_npz,
    write_curves=write_npz_curves,
    options=(COLUMNS,),
)
