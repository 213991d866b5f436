"""Geometries as nested Arrow lists of coordinates, as GeoArrow and GeoParquet 1.1 hold them.

A linestring is a list of coordinates, a polygon a list of such lists, and so on; coordinates are
structures of x, y and z, or lists of two or three numbers.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from crustline.arrays import FloatArray
from crustline.formats.geometries import Vertices

__all__ = ["ENCODINGS", "extension_of", "vertices_of_nested"]

#: How many lists lie around the coordinates of a geometry, by the name of its type.
ENCODINGS = {
    "point": 0, "linestring": 1, "multipoint": 1, "polygon": 2, "multilinestring": 2,
    "multipolygon": 3,
}  # fmt: skip
_NAME, _ABOUT = b"ARROW:extension:name", b"ARROW:extension:metadata"


def extension_of(field: Any) -> tuple[str, Any] | None:
    """Return the encoding of a field that GeoArrow names, and its CRS; None for any other."""
    about = dict(field.metadata or {})
    if hasattr(field.type, "extension_name"):
        about = {_NAME: field.type.extension_name.encode(), _ABOUT: b"", **about}
    name = about.get(_NAME, b"").decode("utf-8", "replace")
    if not name.startswith("geoarrow."):
        return None
    try:
        beside = json.loads(about.get(_ABOUT) or b"{}")
    except ValueError:
        beside = {}
    return name.removeprefix("geoarrow."), beside.get("crs") if isinstance(beside, dict) else None


def vertices_of_nested(array: Any, encoding: str) -> Vertices:
    """Return the vertices of an Arrow array of geometries of one encoding; missing have none."""
    import pyarrow as pa

    array = array.combine_chunks() if isinstance(array, pa.ChunkedArray) else array
    array = getattr(array, "storage", array)
    owners = np.arange(len(array))
    sizes = np.ones(len(array), np.int64)
    for _ in range(ENCODINGS[encoding]):
        lengths = pa.compute.list_value_length(array).fill_null(0)
        sizes = np.asarray(lengths.to_numpy(zero_copy_only=False)).astype(np.int64)
        owners = np.repeat(owners, sizes)
        array = pa.compute.list_flatten(array)
    xyz = _coordinates(array)
    if encoding.endswith("point"):
        there = np.isfinite(xyz[:, :2]).all(axis=1)  # an empty point is one of NaN
        xyz, owners = xyz[there], owners[there]
        sizes = np.ones(len(xyz), np.int64)
    closed, kept = _closed(xyz[:, :2], sizes)
    xyz, owners = xyz[kept], owners[kept]
    z = xyz[:, 2] if len(xyz) and np.isfinite(xyz[:, 2]).all() else None
    return Vertices(np.ascontiguousarray(xyz[:, :2]), z, owners, sizes - closed, closed)


def _coordinates(array: Any) -> FloatArray:
    """Return coordinates as x, y, z; NaN where there is none."""
    import pyarrow as pa

    xyz = np.full((len(array), 3), np.nan)
    if pa.types.is_struct(array.type):
        known = [field.name for field in array.type]
        fields = {name: array.field(name) for name in ("x", "y", "z") if name in known}
        for k, name in enumerate(("x", "y", "z")):
            if name in fields or name != "z":
                xyz[:, k] = fields[name].to_numpy(zero_copy_only=False)
    else:
        count = array.type.list_size
        flat = array.fill_null([np.nan] * count) if array.null_count else array
        numbers = np.asarray(flat.flatten().to_numpy(zero_copy_only=False)).reshape(-1, count)
        width = 2 if array.type.value_field.name == "xym" else min(count, 3)
        xyz[:, :width] = numbers[:, :width]
    if array.null_count:
        xyz[np.asarray(array.is_null())] = np.nan
    return xyz


def _closed(xy: FloatArray, sizes: Any) -> tuple[Any, Any]:
    """Return which parts are rings, and which vertices are no repeated end of one."""
    ends = np.cumsum(sizes)
    closed = sizes > 3
    closed[closed] = (xy[(ends - sizes)[closed]] == xy[ends[closed] - 1]).all(axis=1)
    kept = np.ones(len(xy), np.bool_)
    kept[ends[closed] - 1] = False
    return closed, kept
