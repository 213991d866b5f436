"""Parquet, with geometries as GeoParquet 1.1 holds them, and Feather: tables by pyarrow."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import IntArray
from crustline.curves import Curves
from crustline.errors import InputError
from crustline.formats.arrow import as_table, as_wkb, column_of, points_of_wkb
from crustline.formats.attributes import attributes_of_points, table_of
from crustline.formats.features import curve_columns
from crustline.formats.format import Format
from crustline.formats.geoarrow import ENCODINGS, extension_of, vertices_of_nested
from crustline.formats.geometries import Vertices, from_wkb, geometries_of, vertices_of
from crustline.formats.names import find_coordinates, quote_all
from crustline.formats.options import COLUMNS, POLYGONS
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points, own_points

Chosen = Sequence[str | int] | None
_GEOMETRY = "geometry"
_CRS = b"crs"


def read(source: Source, *, columns: Chosen = None) -> Points:
    """Return the vertices of the geometries, or of a plain table the columns of x and y."""
    with source.path() as path, source.library("pyarrow"):
        import pyarrow.parquet as pq

        table = _sound(pq.read_table(path))
    return _points(table, source, columns)


def read_feather(source: Source, *, columns: Chosen = None) -> Points:
    """Return the columns of x and y, and those beside them."""
    with source.path() as path, source.library("pyarrow"):
        import pyarrow.feather as feather

        table = _sound(feather.read_table(path))
    return _points(table, source, columns)


def stream(source: Source, rows: int, *, columns: Chosen = None) -> Iterator[Points]:
    """Yield the points of so many rows at a time."""
    with source.path() as path, source.library("pyarrow"):
        import pyarrow as pa
        import pyarrow.parquet as pq

        with pq.ParquetFile(path) as file:
            schema = file.schema_arrow
            for batch in file.iter_batches(rows):
                table = _sound(pa.Table.from_batches([batch])).replace_schema_metadata(
                    schema.metadata
                )
                yield _points(table, source, columns)


def read_curves(source: Source) -> Curves:
    """Return the lines and rings of the geometries."""
    with source.path() as path, source.library("pyarrow"):
        import pyarrow.parquet as pq

        table = _sound(pq.read_table(path))
    about = _geometry(table, source)
    if about is None:
        raise source.error("it is a table without geometries: read points from it")
    with source.named(), source.library("pyarrow"):
        found = _vertices(table.column(about.name), about.encoding)
        return found.curves(found.points(_columns(table, [about.name, "bbox"]), about.crs))


def _sound(table: Any) -> Any:
    """Return a table whose offsets lead into it; a damaged one would end the process."""
    table.validate(full=True)
    return table


def _points(table: Any, source: Source, columns: Chosen) -> Points:
    about = None if columns is not None else _geometry(table, source)
    with source.named():
        if about is None:
            return points_of_table(table, source, columns)
        return _of(table, source, about)


def _of(table: Any, source: Source, about: _Geometry) -> Points:
    array, crs = table.column(about.name), about.crs
    rest = _columns(table, [about.name, "bbox"])
    at_once = points_of_wkb(array) if about.encoding == "wkb" else None
    if at_once is None:
        with source.library("pyarrow"):
            found = _vertices(array, about.encoding)
        points = found.points(rest, crs)
        counts = np.bincount(found.owners, minlength=len(array))
        return points.replace(
            columns={**points.columns, **_lists_a_vertex(table, about.name, counts)}
        )
    return own_points(at_once[0], z=at_once[1], columns=rest, crs=crs)


def _lists_a_vertex(table: Any, geometry: str, counts: IntArray) -> dict[str, npt.NDArray[Any]]:
    """Return the columns of lists that have a value for each vertex, spread over them."""
    import pyarrow as pa

    lists = {
        each.name: table.column(each.name).combine_chunks()
        for each in table.schema
        if pa.types.is_list(each.type) and each.name != geometry
    }
    return {
        name: column_of(pa.compute.list_flatten(array))
        for name, array in lists.items()
        if (array.value_lengths().fill_null(0).to_numpy() == counts).all()
    }


def points_of_table(table: Any, source: Source, columns: Chosen) -> Points:
    """Return the columns of x and y of an Arrow table, and those beside them."""
    names = table.column_names
    places = find_coordinates(names, columns, source.name)
    chosen = [names[place] for place in places]
    source.note("columns", ", ".join(chosen))
    x, y, *z = (_numbers(table.column(name), name, source) for name in chosen)
    xy = np.stack([x, y], axis=1)
    rest = _columns(table, chosen)
    crs = (table.schema.metadata or {}).get(_CRS)
    return Points(
        xy,
        z=z[0] if z else None,
        columns=rest,
        crs=None if crs is None else crs.decode(),
        names=(chosen[0], chosen[1]),
    )


def _numbers(array: Any, name: str, source: Source) -> npt.NDArray[Any]:
    if array.null_count:
        row = array.is_null().to_pylist().index(True)
        raise source.error(f"{name!r} has no value: remove the row or fill it in", f"row {row}")
    values = column_of(array.combine_chunks())
    if values.dtype.kind not in "fiu":
        raise source.error(f"the column {name!r} is {array.type}, not numbers: choose another")
    return values


def _columns(table: Any, left_out: Sequence[str]) -> dict[str, npt.NDArray[Any]]:
    names = [each for each in table.column_names if each not in left_out]
    names = [each for each in names if not each.startswith("__index_level_")]
    return {name: column_of(table.column(name).combine_chunks()) for name in names}


@dataclass(frozen=True)
class _Geometry:
    """The column of geometries: its name, CRS, and how it holds them, in lower case."""

    name: str
    crs: str | None
    encoding: str


def _geometry(table: Any, source: Source) -> _Geometry | None:
    """Return what the metadata of GeoParquet, or else of GeoArrow, say of geometries."""
    text = (table.schema.metadata or {}).get(b"geo")
    if text is None:
        return _extension(table, source)
    try:
        about = json.loads(text)
        name = about["primary_column"]
        column = about["columns"][name]
        encoding = str(column["encoding"]).lower()
        crs = column.get("crs", "OGC:CRS84")
    except (ValueError, KeyError, TypeError, AttributeError):
        raise source.error("its GeoParquet metadata are damaged: write it again") from None
    if name not in table.column_names:
        raise source.error(f"its geometries, {name!r:.40}, are not there: write it again")
    return _Geometry(name, _crs_name(crs), _known(encoding, source))


def _extension(table: Any, source: Source) -> _Geometry | None:
    found = [(field.name, about) for field in table.schema if (about := extension_of(field))]
    if len(found) > 1:
        names = quote_all([name for name, _ in found])
        raise source.error(f"it has the geometries {names}: keep one column of them")
    for name, (encoding, crs) in found:
        return _Geometry(name, _crs_name(crs), _known(encoding, source))
    return None


def _known(encoding: str, source: Source) -> str:
    if encoding not in ("wkb", "wkt", *ENCODINGS):
        raise source.error(f"its geometries are {encoding!s:.20}: write them as WKB")
    return encoding


def _vertices(array: Any, encoding: str) -> Vertices:
    if encoding == "wkb":
        return vertices_of(from_wkb(array))
    if encoding == "wkt":
        import shapely

        return vertices_of(shapely.from_wkt(array.to_numpy()))
    return vertices_of_nested(array, encoding)


def _crs_name(crs: Any) -> str | None:
    if crs is None or isinstance(crs, str):
        return crs
    authority = crs.get("id") or {}
    if {"authority", "code"} <= authority.keys():
        return f"{authority['authority']}:{authority['code']}"
    import pyproj

    return str(pyproj.CRS.from_json_dict(crs).to_wkt())


# Writing


def write_points(points: Points, target: Target) -> None:
    """Write a row a point."""
    kind = "Point" if points.z is None else "Point Z"
    columns: dict[str, Any] = attributes_of_points(points, reserved=(_GEOMETRY, "bbox")).columns
    columns[_GEOMETRY] = as_wkb(points.xy, points.z)
    _write(columns, [kind], points.crs, target)


def write_curves(curves: Curves, target: Target, *, polygons: bool = False) -> None:
    """Write a row a curve, with the values of its points as lists; isolated points as the last."""
    import pyarrow as pa
    import shapely

    features = list(curves.features(polygons=polygons))
    made = geometries_of(curves, features)
    columns = curve_columns(curves, features, lists=True)
    kinds = {shapely.get_type_id(each): each.geom_type for each in made}
    columns[_GEOMETRY] = pa.array(list(shapely.to_wkb(made, flavor="iso")), pa.binary())
    z = "" if curves.points.z is None else " Z"
    _write(columns, [f"{kinds[key]}{z}" for key in sorted(kinds)], curves.points.crs, target)


def _write(
    columns: Mapping[str, Any], kinds: Sequence[str], crs: str | None, target: Target
) -> None:
    import pyarrow.parquet as pq

    column = {"encoding": "WKB", "geometry_types": list(kinds), "crs": _crs_json(crs)}
    about = {"version": "1.1.0", "primary_column": _GEOMETRY, "columns": {_GEOMETRY: column}}
    table = as_table(columns).replace_schema_metadata({b"geo": json.dumps(about).encode()})
    with target.path(".parquet") as path:
        pq.write_table(table, path, compression="zstd")


def _crs_json(crs: str | None) -> Any:
    if crs is None:
        return None
    import pyproj

    try:
        return pyproj.CRS.from_user_input(crs).to_json_dict()
    except pyproj.exceptions.CRSError:
        raise InputError(f"the CRS {crs!r:.60} is unknown: write it as EPSG:25832") from None


def write_feather(points: Points, target: Target) -> None:
    """Write the coordinates, z and the other columns, by names that lead back to the same."""
    import pyarrow.feather as feather

    table = as_table(table_of(points))
    if points.crs is not None:
        table = table.replace_schema_metadata({_CRS: points.crs.encode()})
    with target.path(".feather") as path:
        feather.write_feather(table, str(path), compression="zstd")


PARQUET = Format(
    name="parquet",
    title="GeoParquet",
    suffixes=(".parquet", ".geoparquet"),
    sniff=lambda head: head.startswith(b"PAR1"),
    read=read,
    read_curves=read_curves,
    stream=stream,
    write_points=write_points,
    write_curves=write_curves,
    options=(COLUMNS, POLYGONS),
    extra="gis",
    needs=("pyarrow", "shapely", "pyproj"),
)
FEATHER = Format(
    name="feather",
    title="Feather",
    suffixes=(".feather", ".arrow"),
    sniff=lambda head: head.startswith(b"ARROW1"),
    read=read_feather,
    write_points=write_feather,
    options=(COLUMNS,),
    extra="gis",
    needs=("pyarrow",),
)
