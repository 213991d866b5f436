"""NumPy's own files: both are read, curves are written as NPZ, points as both."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from crustline.errors import FormatError, InputError
from crustline.formats.attributes import attributes_of_points
from crustline.formats.format import Format
from crustline.formats.names import find_coordinates, find_pair, quote_all
from crustline.formats.options import COLUMNS
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points

if TYPE_CHECKING:
    from crustline.curves import Curves

Array = npt.NDArray[Any]
_PREFIX = "columns/"
_RESULT = ("indices", "offsets", "closed", "isolated")


def read_npy(source: Source, *, columns: Sequence[str | int] | None = None) -> Points:
    """Return the points of one array of shape (n, 2), or (n, 3) with heights."""
    return _from_table(_load(source.content(), source.name), source.name, columns)


def read_npz(source: Source, *, columns: Sequence[str | int] | None = None) -> Points:
    """Return the points of an archive: array points, or x and y, with z, crs and other columns."""
    archive = _load(source.content(), source.name)
    if isinstance(archive, np.ndarray):
        raise FormatError(
            f"{source.name} is an NPY file, not an NPZ archive: choose the format npy"
        )
    arrays = {name: _member(archive, name, source.name) for name in archive.files}
    crs = arrays.pop("crs", None)
    names = arrays.pop("names", None)
    if "points" in arrays and columns is None:
        if set(_RESULT) <= arrays.keys():  # a result of ours: a ring of n points is no column
            arrays = {name: array for name, array in arrays.items() if name not in _RESULT}
        points = _with_columns(arrays, names, source.name)
    else:
        points = _from_arrays(arrays, source.name, columns)
    return points.replace(crs=None if crs is None else str(crs))


def write_npz_curves(curves: Curves, target: Target) -> None:
    """Write the curves as an archive of arrays, with the points in the order of the input."""
    result = {name: getattr(curves, name) for name in _RESULT}
    target.write(_archive({"points": curves.points.xy, **result, **_carried(curves.points)}))


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


def _load(content: bytes, source: str) -> Any:
    if not content.startswith((b"\x93NUMPY", b"PK")):
        raise FormatError(f"{source} is no NPY or NPZ file: choose its format")
    try:
        return np.load(io.BytesIO(content), allow_pickle=False)
    except Exception as error:  # a broken header or archive raises half a dozen kinds
        raise FormatError(f"{source} is no NumPy file of numbers: {_first_line(error)}") from None


def _member(archive: Any, name: str, source: str) -> Array:
    try:
        return np.asarray(archive[name])
    except Exception as error:
        raise FormatError(
            f"{source}, array {name!r} cannot be read: {_first_line(error)}"
        ) from None


def _first_line(error: Exception) -> str:
    if "allow_pickle" in str(error):
        return "it holds Python objects, which are not read: save numbers or text"
    return f"{(str(error) or type(error).__name__).splitlines()[0]}: save it again"


def _from_table(array: Any, source: str, columns: Sequence[str | int] | None) -> Points:
    if not isinstance(array, np.ndarray):
        raise FormatError(f"{source} is an NPZ archive, not an NPY file: choose the format npz")
    if array.ndim != 2 or array.shape[1] < 2 or (columns is None and array.shape[1] > 3):
        raise FormatError(
            f"{source} has the shape {array.shape}, not (n, 2) or (n, 3): "
            "choose columns by position"
        )
    names = [*"xyz", *(f"column{k}" for k in range(3, array.shape[1]))][: array.shape[1]]
    return _from_arrays({name: array[:, k] for k, name in enumerate(names)}, source, columns)


def _from_arrays(
    arrays: dict[str, Array], source: str, columns: Sequence[str | int] | None
) -> Points:
    flat = {name: array for name, array in arrays.items() if array.ndim == 1}
    names = [name.removeprefix(_PREFIX) for name in flat]
    if columns is None and find_pair(names) is None:
        raise FormatError(
            f"{source} holds the arrays {quote_all(list(arrays))}: name the points x and y, "
            "or points, or choose columns (--columns X,Y)"
        )
    positions = find_coordinates(names, columns, source)
    chosen = [list(flat)[k] for k in positions]
    first, second, *height = (flat[name] for name in chosen)
    if len(first) != len(second):
        raise FormatError(
            f"{source}: {chosen[0]!r} has {len(first)} rows, {chosen[1]!r} {len(second)}"
        )
    pair = (names[positions[0]], names[positions[1]])
    rest = {name: array for name, array in arrays.items() if name not in chosen}
    return _points(
        np.column_stack([first, second]), height[0] if height else None, rest, pair, source
    )


def _with_columns(arrays: dict[str, Array], names: Array | None, source: str) -> Points:
    rest = {name: array for name, array in arrays.items() if name not in ("points", "z")}
    pair = ("x", "y") if names is None or names.shape != (2,) else tuple(map(str, names))
    table, z = arrays["points"], arrays.get("z")
    if z is None and table.ndim == 2 and table.shape[1] == 3:
        table, z = table[:, :2], table[:, 2]
    return _points(table, z, rest, pair, source)


def _points(
    table: Array, z: Array | None, rest: dict[str, Array], names: Sequence[str], source: str
) -> Points:
    columns = {
        name.removeprefix(_PREFIX): array
        for name, array in rest.items()
        if array.shape == table.shape[:1]
    }
    try:
        return Points(table, z=z, columns=columns, names=names)
    except InputError as error:
        raise FormatError(f"{source}, {error}") from None


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
    sniff=lambda head: head.startswith(b"PK\x03\x04"),
    read=read_npz,
    write_points=write_npz,
    write_curves=write_npz_curves,
    options=(COLUMNS,),
)
