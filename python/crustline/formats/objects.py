"""Objects of other libraries: frames and tables to points, curves to geometries or graphs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from crustline.curves import Curves
from crustline.errors import InputError, require
from crustline.formats.attributes import attributes_of_points
from crustline.formats.features import curve_columns
from crustline.formats.geojson import collection_of
from crustline.formats.geometries import geometries_of, vertices_of
from crustline.formats.names import find_pair
from crustline.formats.options import COLUMNS
from crustline.formats.parquet import points_of_table
from crustline.formats.source import Source
from crustline.points import Points

__all__ = [
    "geo_interface",
    "points_of_object",
    "to_geopandas",
    "to_networkx",
    "to_pyvista",
    "to_scipy",
    "to_shapely",
]


def points_of_object(thing: Any, columns: Sequence[str | int] | None = None) -> Points:
    """Return the points of a GeoDataFrame or GeoSeries, or of a table.

    Tables are objects with the Arrow PyCapsule interface: those of pandas, Polars and pyarrow.
    """
    if hasattr(thing, "geometry") and hasattr(thing, "crs"):
        return _of_geopandas(thing)
    require("tables", "pyarrow")
    import pyarrow as pa

    source = Source(b"", f"<{type(thing).__name__}>")
    table = pa.table(thing)
    if columns is None and len(table.column_names) == 2 and find_pair(table.column_names) is None:
        columns = (0, 1)  # as for an array of shape (n, 2)
    return points_of_table(table, source, None if columns is None else COLUMNS.check(columns))


def _of_geopandas(frame: Any) -> Points:
    geometries = np.asarray(frame.geometry.to_numpy(), dtype=np.object_)
    columns = {}
    if hasattr(frame, "columns"):
        rest = frame.drop(columns=frame.geometry.name)
        columns = {str(name): _as_column(rest[name]) for name in rest.columns}
    crs = frame.crs
    return vertices_of(geometries).points(columns, None if crs is None else crs.to_string())


def _as_column(series: Any) -> Any:
    values = series.to_numpy()
    if values.dtype.kind in "biufSUmM":
        return values
    return np.array(["" if each is None else str(each) for each in values], dtype=np.object_)


def to_shapely(curves: Curves, polygons: bool) -> list[Any]:
    """Return a geometry a polygon, line or ring, and a MultiPoint of the isolated points."""
    return list(geometries_of(curves, list(curves.features(polygons=polygons))))


def to_geopandas(curves: Curves, polygons: bool) -> Any:
    """Return a GeoDataFrame: a row a feature, with curve, closed, length, rows and columns."""
    require("gis", "geopandas")
    import geopandas

    features = list(curves.features(polygons=polygons))
    columns = curve_columns(curves, features)
    columns["rows"] = [feature.rows.tolist() for feature in features]
    made = list(geometries_of(curves, features))
    return geopandas.GeoDataFrame(columns, geometry=made, crs=curves.points.crs)


def geo_interface(curves: Curves) -> dict[str, Any]:
    """Return the curves as the mapping of GeoJSON that `__geo_interface__` promises."""
    return dict(json.loads(collection_of(curves, polygons=False)))


def to_networkx(curves: Curves) -> Any:
    """Return a networkx graph: a node a row of the points, and the edges with their length."""
    require("graphs", "networkx")
    import networkx

    points = curves.points
    beside = attributes_of_points(points, reserved=("x", "y", "z"))
    columns = {"x": points.xy[:, 0], "y": points.xy[:, 1], **beside.columns}
    if points.z is not None:
        columns["z"] = points.z
    graph = networkx.Graph()
    graph.add_nodes_from(range(len(points)))
    for name, values in columns.items():
        networkx.set_node_attributes(graph, dict(enumerate(values.tolist())), name)
    edges = curves.edges
    graph.add_weighted_edges_from(
        zip(*edges.T.tolist(), _lengths(curves).tolist(), strict=True), weight="length"
    )
    return graph


def to_scipy(curves: Curves) -> Any:
    """Return the symmetric sparse matrix (n, n) of the lengths of the edges."""
    require("graphs", "scipy")
    from scipy.sparse import coo_array

    i, j = curves.edges.T
    lengths = _lengths(curves)
    size = len(curves.points)
    both = (np.concatenate([i, j]), np.concatenate([j, i]))
    return coo_array((np.concatenate([lengths, lengths]), both), shape=(size, size)).tocsr()


def _lengths(curves: Curves) -> Any:
    steps = np.diff(curves.points.xy[curves.edges], axis=1)[:, 0]
    return np.hypot(steps[:, 0], steps[:, 1])


def to_pyvista(curves: Curves) -> Any:
    """Return a pyvista PolyData: the points, a line a curve, and a vertex an isolated point."""
    try:
        import pyvista
    except ImportError:
        raise InputError(
            "this needs pyvista, which is not installed: pip install pyvista"
        ) from None
    points = curves.points
    heights = np.zeros(len(points)) if points.z is None else points.z
    lines = [
        np.append(len(run), run)
        for feature in curves.features()
        for run in (feature.runs if feature.kind == "line" else ())
    ]
    mesh = pyvista.PolyData(
        np.column_stack([points.xy, heights]),
        lines=np.concatenate(lines) if lines else None,
        verts=np.column_stack([np.ones_like(curves.isolated), curves.isolated]).ravel()
        if len(curves.isolated)
        else None,
    )
    for name, values in points.columns.items():
        mesh.point_data[name] = values if values.dtype.kind != "O" else values.astype(str)
    return mesh
