"""GeoJSON (RFC 7946): the vertices of every geometry are read, curves are written as features."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain, repeat
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
import numpy.typing as npt

from crustline.arrays import IntArray
from crustline.errors import FormatError, InputError
from crustline.formats.attributes import attributes_of, coordinates_with_height
from crustline.formats.crs import geojson_member
from crustline.formats.format import Format
from crustline.formats.options import POLYGONS
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points

if TYPE_CHECKING:
    from crustline.curves import Curves

# How many lists lie around the positions of a geometry.
_DEPTHS = {
    "Point": 0,
    "MultiPoint": 1,
    "LineString": 1,
    "MultiLineString": 2,
    "Polygon": 2,
    "MultiPolygon": 3,
}
_LINES = ("LineString", "MultiLineString", "Polygon", "MultiPolygon")
_KINDS = {"polygon": "Polygon", "line": "LineString", "points": "MultiPoint"}
_SURROGATE = re.compile("[\ud800-\udfff]")
_RESERVED = ("curve", "closed", "rows", "id")


@dataclass
class _Vertices:
    """What has been read so far: positions, and how many of them each feature has."""

    source: str
    positions: list[Any] = field(default_factory=list)
    counts: list[int] = field(default_factory=list)
    properties: list[dict[str, Any]] = field(default_factory=list)


def read(source: Source) -> Points:
    """Return the vertices of all geometries, with the properties of their features as columns."""
    document = _parse(source.text(), source.name)
    vertices = _Vertices(source.name)
    for number, feature in enumerate(_features(document, source.name)):
        _add_feature(vertices, feature, number)
    coordinates = _as_array(vertices)
    z = coordinates[:, 2] if coordinates.shape[1] == 3 else None
    try:
        return Points(coordinates[:, :2], z=z, columns=_columns(vertices), crs=_crs(document))
    except InputError as error:
        raise FormatError(f"{source.name}, {error}") from None


def _parse(text: str, source: str) -> dict[str, Any]:
    def refuse(constant: str) -> NoReturn:
        raise FormatError(f"{source} holds {constant}, which JSON does not know: correct the value")

    try:
        document = json.loads(text, parse_constant=refuse)
    except json.JSONDecodeError as error:
        place = f"{source}, line {error.lineno}, column {error.colno}"
        raise FormatError(f"{place}: {error.msg}: correct the JSON") from None
    except (RecursionError, ValueError) as error:
        if isinstance(error, FormatError):
            raise
        reason = "too deep" if isinstance(error, RecursionError) else str(error).split(";")[0]
        raise FormatError(f"{source} is no GeoJSON that can be read: {reason}") from None
    if not isinstance(document, dict) or not isinstance(document.get("type"), str):
        raise FormatError(
            f"{source} is JSON but no GeoJSON: it needs a member type such as Feature"
        )
    return document


def _features(document: dict[str, Any], source: str) -> list[Any]:
    if document["type"] == "FeatureCollection":
        features = document.get("features")
        if not isinstance(features, list):
            raise FormatError(f"{source}: the FeatureCollection has no list of features: add one")
        return features
    if document["type"] == "Feature":
        return [document]
    return [{"type": "Feature", "geometry": document, "properties": None}]


def _add_feature(vertices: _Vertices, feature: Any, number: int) -> None:
    where = f"{vertices.source}, feature {number}"
    if not isinstance(feature, dict) or feature.get("type") != "Feature":
        raise FormatError(f"{where} is no Feature: it needs type, geometry and properties")
    before = len(vertices.positions)
    try:
        vertices.positions.extend(_positions(feature.get("geometry"), where))
    except RecursionError:
        raise FormatError(f"{where}: the geometries are nested too deep: flatten them") from None
    properties = feature.get("properties") or {}
    if not isinstance(properties, dict):
        raise FormatError(
            f"{where}: the properties are {properties!r:.40}, not an object: correct them"
        )
    if "id" in feature:
        properties = {"id": feature["id"], **properties}
    vertices.counts.append(len(vertices.positions) - before)
    vertices.properties.append(properties)


def _positions(geometry: Any, where: str) -> Iterable[Any]:
    if geometry is None:
        return []
    kind = geometry.get("type") if isinstance(geometry, dict) else geometry
    if kind == "GeometryCollection":
        parts = geometry.get("geometries")
        if not isinstance(parts, list):
            raise FormatError(f"{where}: the GeometryCollection has no list of geometries: add one")
        return chain.from_iterable(_positions(part, where) for part in parts)
    if not isinstance(kind, str) or kind not in _DEPTHS:
        raise FormatError(f"{where}: {kind!r:.40} is no geometry of GeoJSON: correct its type")
    coordinates = geometry.get("coordinates")
    if not isinstance(coordinates, list):
        raise FormatError(f"{where}: the {kind} has no list of coordinates: add it")
    return _flatten(coordinates, _DEPTHS[kind], kind in _LINES, where)


def _flatten(coordinates: Any, depth: int, line: bool, where: str) -> Iterator[Any]:
    """Yield the positions under some levels of lists, without those that close a ring."""
    if depth == 0:
        if coordinates:  # an empty Point is no vertex
            yield coordinates
        return
    if not isinstance(coordinates, list):
        raise FormatError(f"{where}: {coordinates!r:.40} should be a list: correct the coordinates")
    if depth > 1:
        for part in coordinates:
            yield from _flatten(part, depth - 1, line, where)
    elif line and len(coordinates) > 3 and coordinates[0] == coordinates[-1]:
        yield from coordinates[:-1]
    else:
        yield from coordinates


def _as_array(vertices: _Vertices) -> npt.NDArray[np.float64]:
    positions = vertices.positions
    if not positions:
        return np.empty((0, 2))
    sound = set(map(type, positions)) <= {list}
    widths = set(map(len, positions)) if sound else set()
    numbers = sound and set(map(type, chain.from_iterable(positions))) <= {int, float}
    if not numbers or widths not in ({2}, {3}):
        raise FormatError(_name_bad_position(vertices))
    try:
        return np.array(positions, dtype=np.float64)
    except OverflowError:
        raise FormatError(
            f"{vertices.source}: an integer is too large for float64: shorten it"
        ) from None


def _name_bad_position(vertices: _Vertices) -> str:
    width = len(vertices.positions[0]) if isinstance(vertices.positions[0], list) else 2
    owners = np.repeat(np.arange(len(vertices.counts)), vertices.counts)
    for owner, position in zip(owners, vertices.positions, strict=True):
        where = f"{vertices.source}, feature {owner}: the position {position!r:.60}"
        numbers = isinstance(position, list) and {*map(type, position)} <= {int, float}
        if not numbers or len(position) not in (2, 3):
            return f"{where} is not two or three numbers: correct it"
        if len(position) != width:
            fault = f"has {len(position)} numbers, others have {width}"
            return f"{where} {fault}: give all a height or none"
    return f"{vertices.source}: the positions do not fit together: correct them"


# Properties


def _columns(vertices: _Vertices) -> dict[str, npt.NDArray[Any]]:
    names = dict.fromkeys(chain.from_iterable(vertices.properties))
    return {name: _column(vertices, name) for name in names}


def _column(vertices: _Vertices, name: str) -> npt.NDArray[Any]:
    """Return a property at every vertex; lists with a value per vertex are spread over them."""
    values = [properties.get(name) for properties in vertices.properties]
    here = [(value, count) for value, count in zip(values, vertices.counts, strict=True) if count]
    lists = [value for value, count in here if isinstance(value, list) and len(value) == count]
    if len(lists) == len(here):
        return _as_column(list(chain.from_iterable(lists)))
    column = _as_column([value for value, _ in here])
    return np.repeat(column, [count for _, count in here])


def _as_column(values: list[Any]) -> npt.NDArray[Any]:
    """Return bools, integers, floats (null is NaN) or text (null is empty, objects are JSON)."""
    kinds = set(map(type, values))
    if kinds == {bool}:
        return np.array(values, dtype=np.bool_)
    try:
        if kinds == {int}:
            return np.array(values, dtype=np.int64)
        if kinds and kinds <= {int, float, type(None)} and kinds != {type(None)}:
            return np.array(values, dtype=np.float64)
    except OverflowError:
        pass
    return np.array([_as_word(value) for value in values], dtype=np.object_)


def _as_word(value: Any) -> str:
    if value is None:
        return ""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _crs(document: dict[str, Any]) -> str | None:
    member = document.get("crs")
    properties = member.get("properties") if isinstance(member, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    return name if isinstance(name, str) else None


# Writing


def write_curves(curves: Curves, target: Target, *, polygons: bool = False) -> None:
    """Write the curves as a FeatureCollection, a line of text for each feature."""
    target.write(collection_of(curves, polygons=polygons))


def collection_of(curves: Curves, *, polygons: bool) -> str:
    """Return the text of the FeatureCollection of curves."""
    features = map(_dump, _features_of(curves, polygons))
    return _collection(attributes_of(curves).crs, features)


def write_points(points: Points, target: Target) -> None:
    """Write points as a FeatureCollection of Points, the other columns as properties."""
    positions = np.asarray(points)
    if points.z is not None:
        positions = np.column_stack([positions, points.z])
    columns = [_as_json(values) for values in points.columns.values()]
    rows = zip(*columns, strict=True) if columns else repeat(())
    features = (
        _dump(
            {
                "type": "Feature",
                "properties": dict(zip(points.columns, row, strict=True)),
                "geometry": {"type": "Point", "coordinates": position},
            }
        )
        for position, row in zip(positions.tolist(), rows, strict=False)
    )
    target.write(_collection(points.crs, features))


def _collection(name: str | None, features: Iterable[str]) -> str:
    member = geojson_member(name)
    crs = "" if member is None else f'"crs":{_dump(member)},'
    body = ",\n".join(features)
    return f'{{"type":"FeatureCollection",{crs}"features":[\n{body}\n]}}\n'


def _features_of(curves: Curves, polygons: bool) -> Iterator[dict[str, Any]]:
    """Yield features: positions with heights, and the other columns vertex by vertex."""
    columns = attributes_of(curves, reserved=_RESERVED).columns

    def line(rows: IntArray, closed: bool) -> list[list[float]]:
        positions: list[list[float]] = coordinates_with_height(curves, rows).tolist()
        return positions + positions[:1] if closed else positions

    for feature in curves.features(polygons=polygons):
        lines = [line(part, feature.closed) for part in feature.parts]
        rows = np.concatenate(feature.parts)
        properties = {"curve": feature.number, "closed": feature.closed, "rows": rows.tolist()}
        properties |= {name: _as_json(values[rows]) for name, values in columns.items()}
        coordinates = lines if feature.kind == "polygon" else lines[0]
        geometry = {"type": _KINDS[feature.kind], "coordinates": coordinates}
        yield {"type": "Feature", "properties": properties, "geometry": geometry}


def _as_json(values: npt.NDArray[Any]) -> list[Any]:
    if values.dtype.kind == "f":
        return [value if np.isfinite(value) else None for value in values.tolist()]
    return values.tolist() if values.dtype.kind in "biuUO" else list(map(str, values))


def _dump(value: Any) -> str:
    text = json.dumps(value, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    if _SURROGATE.search(text):  # which UTF-8 does not hold, but an escape does
        text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return text


def _is_geojson(head: bytes) -> bool:
    return head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{")


GEOJSON = Format(
    name="geojson",
    title="GeoJSON",
    suffixes=(".geojson", ".json"),
    sniff=_is_geojson,
    read=read,
    write_points=write_points,
    write_curves=write_curves,
    options=(POLYGONS,),
)
