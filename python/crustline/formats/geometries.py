"""Geometries of shapely: their vertices, and curves as geometries; nothing here reads or writes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.curves import Curves, Feature, trace
from crustline.formats.vertices import edges_along
from crustline.points import Points

__all__ = ["Vertices", "from_wkb", "geometries_of", "joined", "vertices_of"]

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
    sizes : ndarray of int64, shape (k,)
        The number of vertices of each part: a point, line or ring.
    closed : ndarray of bool, shape (k,)
        Whether the part is a ring.
    """

    xy: FloatArray
    z: FloatArray | None
    owners: IntArray
    sizes: IntArray
    closed: BoolArray

    def points(self, columns: Mapping[str, npt.NDArray[Any]], crs: str | None) -> Points:
        """Return them as points; columns have a value per geometry, given to each vertex."""
        spread = {name: np.asarray(values)[self.owners] for name, values in columns.items()}
        return Points(self.xy, z=self.z, columns=spread, crs=crs)

    def curves(self, points: Points) -> Curves:
        """Return the points along the lines and rings; parts that meet in a vertex are joined."""
        lines = np.ones(len(self.sizes), np.bool_)
        return trace(points, joined(self.xy, edges_along(self.sizes, lines, self.closed)))


def from_wkb(array: Any) -> Geometries:
    """Return an Arrow array of well-known binary as geometries."""
    import shapely

    made: Geometries = shapely.from_wkb(array.to_numpy())
    return made


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
    heights = xyz[:, 2]
    z = heights if len(xyz) and np.isfinite(heights).all() else None
    return Vertices(np.ascontiguousarray(xyz[:, :2]), z, owners[part], counts - closed, closed)


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


def joined(xy: FloatArray, edges: IntArray) -> IntArray:
    """Return edges between the first rows of equal points, without those of no length."""
    _, firsts, of_rows = np.unique(xy + 0.0, axis=0, return_index=True, return_inverse=True)
    ends = firsts[of_rows.ravel()][edges]
    different: IntArray = ends[ends[:, 0] != ends[:, 1]]
    return different


def geometries_of(curves: Curves, features: Sequence[Feature]) -> Geometries:
    """Return each feature of curves as a geometry: a ring that is no polygon a closed LineString.

    The isolated points are a MultiPoint. With heights, geometries have them.
    """
    import shapely

    z = curves.points.z
    xyz = curves.points.xy if z is None else np.column_stack([curves.points.xy, z])
    made = np.empty(len(features), dtype=np.object_)
    for number, feature in enumerate(features):
        if feature.kind == "polygon":
            shell, *holes = (shapely.linearrings(xyz[part]) for part in feature.parts)
            made[number] = shapely.polygons(shell, holes or None)
        elif feature.kind == "points":
            made[number] = shapely.multipoints(xyz[feature.parts[0]])
    lines = [k for k, feature in enumerate(features) if feature.kind == "line"]
    if lines:
        runs = [features[k].runs[0] for k in lines]
        index = np.repeat(np.arange(len(runs)), [len(run) for run in runs])
        made[lines] = shapely.linestrings(xyz[np.concatenate(runs)], indices=index)
    return made
