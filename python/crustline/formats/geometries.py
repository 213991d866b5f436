"""Geometries of shapely: their vertices, and curves as geometries; nothing here reads or writes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.curves import Curves, trace
from crustline.points import Points

__all__ = ["Vertices", "curves_of", "geometries_of", "points_of", "vertices_of"]

Geometries = npt.NDArray[np.object_]
_POLYGON = 3


@dataclass(frozen=True, eq=False)
class Vertices:
    """The vertices of geometries, in their order, without those that close a ring.

    Attributes
    ----------
    xy : ndarray of float64, shape (n, 2)
    z : ndarray of float64, shape (n,), or None
        Heights, if every vertex has one.
    owners : ndarray of int64, shape (n,)
        The number of the geometry that each vertex belongs to.
    offsets : ndarray of int64, shape (k + 1,)
        Part number i, a point, line or ring, has the vertices offsets[i] to offsets[i + 1].
    closed : ndarray of bool, shape (k,)
        Whether the part is a ring.
    """

    xy: FloatArray
    z: FloatArray | None
    owners: IntArray
    offsets: IntArray
    closed: BoolArray


def vertices_of(geometries: Geometries) -> Vertices:
    """Return the vertices of geometries of any type; missing and empty ones have none."""
    import shapely

    parts, owners = _rings(geometries)
    xyz, part = shapely.get_coordinates(parts, include_z=True, return_index=True)
    counts = np.bincount(part, minlength=len(parts))
    ends = np.cumsum(counts)
    closed = shapely.is_closed(parts) & (counts > 3)
    kept = np.ones(len(xyz), dtype=np.bool_)
    kept[ends[closed] - 1] = False
    xyz, part = xyz[kept], part[kept]
    offsets = np.concatenate([[0], np.cumsum(counts - closed)])
    heights = xyz[:, 2]
    z = heights if len(xyz) and np.isfinite(heights).all() else None
    return Vertices(np.ascontiguousarray(xyz[:, :2]), z, owners[part], offsets, closed)


def _rings(geometries: Geometries) -> tuple[Geometries, IntArray]:
    """Return points, lines and rings in the order of the geometries, and whose they are."""
    import shapely

    parts, owners = shapely.get_parts(geometries, return_index=True)
    while (shapely.get_type_id(parts) > _POLYGON).any():
        parts, of_parts = shapely.get_parts(parts, return_index=True)
        owners = owners[of_parts]
    is_polygon = shapely.get_type_id(parts) == _POLYGON
    if not is_polygon.any():
        return parts, owners
    where = np.flatnonzero(is_polygon)
    rings, of_rings = shapely.get_rings(parts[where], return_index=True)
    others = np.flatnonzero(~is_polygon)
    places = np.concatenate([where[of_rings], others])
    order = np.argsort(places, kind="stable")
    return np.concatenate([rings, parts[others]])[order], owners[places[order]]


def points_of(
    geometries: Geometries, columns: Mapping[str, npt.NDArray[Any]], crs: str | None
) -> Points:
    """Return the vertices as points; columns have a value per geometry, given to each vertex."""
    found = vertices_of(geometries)
    spread = {name: np.asarray(values)[found.owners] for name, values in columns.items()}
    return Points(found.xy, z=found.z, columns=spread, crs=crs)


def curves_of(
    geometries: Geometries, columns: Mapping[str, npt.NDArray[Any]], crs: str | None
) -> Curves:
    """Return the lines and rings as curves; parts that meet in a vertex are joined there."""
    found = vertices_of(geometries)
    points = points_of(geometries, columns, crs)
    return trace(points, joined(found.xy, edges_of(found.offsets, found.closed)))


def edges_of(offsets: IntArray, closed: BoolArray) -> IntArray:
    """Return the edges (m, 2) between successive vertices of parts."""
    following = np.arange(1, offsets[-1] + 1)
    lasts = offsets[1:] - 1
    some = np.diff(offsets) > 0
    following[lasts[some]] = np.where(closed, offsets[:-1], -1)[some]
    starts = np.flatnonzero(following >= 0)
    return np.stack([starts, following[starts]], axis=1)


def joined(xy: FloatArray, edges: IntArray) -> IntArray:
    """Return edges between the first rows of equal points, without those of no length."""
    _, firsts, of_rows = np.unique(xy + 0.0, axis=0, return_index=True, return_inverse=True)
    ends = firsts[of_rows.ravel()][edges]
    different: IntArray = ends[ends[:, 0] != ends[:, 1]]
    return different


def geometries_of(curves: Curves, polygons: bool) -> tuple[Geometries, list[IntArray]]:
    """Return each polygon, then each line, as a geometry, and the rows of the points of each.

    Rings that are no polygons are closed LineStrings; the isolated points are one MultiPoint at the
    end. With heights, geometries have them.
    """
    import shapely

    z = curves.points.z
    xyz = curves.points.xy if z is None else np.column_stack([curves.points.xy, z])
    features = list(curves.features(polygons=polygons))
    rows = [np.concatenate(feature.parts) for feature in features]
    made = np.empty(len(features), dtype=np.object_)
    for number, feature in enumerate(features):
        if feature.kind == "polygon":
            shell, *holes = (xyz[part] for part in feature.parts)
            made[number] = shapely.polygons(shell, holes or None)
        elif feature.kind == "points":
            made[number] = shapely.multipoints(xyz[feature.parts[0]])
    lines = [k for k, feature in enumerate(features) if feature.kind == "line"]
    if lines:
        runs = [_run(features[k].parts[0], features[k].closed) for k in lines]
        index = np.repeat(np.arange(len(runs)), [len(run) for run in runs])
        made[lines] = shapely.linestrings(xyz[np.concatenate(runs)], indices=index)
    return made, rows


def _run(rows: IntArray, closed: bool) -> IntArray:
    return np.concatenate([rows, rows[:1]]) if closed else rows
