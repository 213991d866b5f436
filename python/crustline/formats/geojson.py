"""GeoJSON (RFC 7946): the vertices of every geometry are read, curves are written as features."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain, repeat
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.curves import Curves, Feature
from crustline.errors import FormatError, FormatWarning
from crustline.formats.antimeridian import crosses, cut, uncut
from crustline.formats.attributes import attributes_of, coordinates_with_height
from crustline.formats.crs import geojson_member
from crustline.formats.format import Format
from crustline.formats.json_text import dump, parse
from crustline.formats.options import ENCODING, POLYGONS
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.formats.values import as_column, as_json
from crustline.formats.vertices import Vertices
from crustline.points import Points
from crustline.projection import is_geographic

__all__ = ["GEOJSON", "is_geojson", "read_document"]

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
_TYPES = (*_DEPTHS, "GeometryCollection", "Feature", "FeatureCollection")
_TYPE = re.compile(rb'^\{\s*"type"\s*:\s*"|"type"\s*:\s*"(?:' + "|".join(_TYPES).encode() + rb')"')
_KINDS = {"polygon": "Polygon", "line": "LineString", "points": "MultiPoint"}
_RESERVED = ("curve", "closed", "rows", "id", "confidence", "least_sure", "cut")


@dataclass
class _Features:
    """What has been read so far: vertices, and how many of them each feature has."""

    vertices: Vertices
    counts: list[int] = field(default_factory=list)
    properties: list[dict[str, Any]] = field(default_factory=list)


def read(source: Source, *, encoding: str | None = None) -> Points:
    """Return the vertices of all geometries, with the properties of their features as columns."""
    return read_document(parse(source, encoding), source)[0]


def read_curves(source: Source, *, encoding: str | None = None) -> Curves:
    """Return the lines and rings of all geometries."""
    points, vertices = read_document(parse(source, encoding), source)
    return vertices.curves(points)


def read_document(document: Any, source: Source) -> tuple[Points, Vertices]:
    """Return the points of a document that has been parsed, and their parts."""
    if isinstance(document, list) and all(map(is_geojson, document)):
        features = list(chain.from_iterable(_features(each, source) for each in document))
        document = document[0] if document else {}
    elif isinstance(document, dict) and isinstance(document.get("type"), str):
        features = _features(document, source)
    else:
        raise FormatError(
            f"{source.name} is JSON but no GeoJSON: it needs a member type such as Feature"
        )
    found = _Features(Vertices(source))
    for number, feature in enumerate(features):
        _add_feature(found, feature, f"feature {number}")
    coordinates = _coordinates(found)
    columns = _columns(found)
    return found.vertices.points(coordinates, columns=columns, crs=_crs(document)), found.vertices


def is_geojson(document: Any) -> bool:
    """Return whether a document is an object of a type of GeoJSON."""
    return isinstance(document, dict) and document.get("type") in _TYPES


def _features(document: dict[str, Any], source: Source) -> list[Any]:
    if document["type"] == "FeatureCollection":
        features = document.get("features")
        if not isinstance(features, list):
            raise source.error("the FeatureCollection has no list of features: add one")
        return features
    if document["type"] == "Feature":
        return [document]
    return [{"type": "Feature", "geometry": document, "properties": None}]


def _add_feature(found: _Features, feature: Any, where: str) -> None:
    source = found.vertices.source
    if not isinstance(feature, dict) or feature.get("type") != "Feature":
        raise source.error("it is no Feature: it needs type, geometry and properties", where)
    before, geometry = len(found.vertices.positions), feature.get("geometry")
    properties = feature.get("properties") or {}
    if not isinstance(properties, dict):
        fault = f"the properties are {properties!r:.40}, not an object: correct them"
        raise source.error(fault, where)
    whole = uncut(geometry, properties.get("cut"))
    if whole is not None:
        geometry = whole
        properties = {name: value for name, value in properties.items() if name != "cut"}
    try:
        _add_geometry(found.vertices, geometry, where)
    except RecursionError:
        raise source.error("the geometries are nested too deep: flatten them", where) from None
    if "id" in feature:
        properties = {"id": feature["id"], **properties}
    found.counts.append(len(found.vertices.positions) - before)
    found.properties.append(properties)


def _add_geometry(vertices: Vertices, geometry: Any, where: str) -> None:
    if geometry is None:
        return
    source = vertices.source
    kind = geometry.get("type") if isinstance(geometry, dict) else geometry
    if kind == "GeometryCollection":
        parts = geometry.get("geometries")
        if not isinstance(parts, list):
            raise source.error("the GeometryCollection has no list of geometries: add one", where)
        for part in parts:
            _add_geometry(vertices, part, where)
        return
    if not isinstance(kind, str) or kind not in _DEPTHS:
        raise source.error(f"{kind!r:.40} is no geometry of GeoJSON: correct its type", where)
    coordinates = geometry.get("coordinates")
    if not isinstance(coordinates, list):
        raise source.error(f"the {kind} has no list of coordinates: add it", where)
    _add_parts(vertices, coordinates, _DEPTHS[kind], kind in _LINES, where)


def _add_parts(vertices: Vertices, coordinates: Any, depth: int, line: bool, where: str) -> None:
    """Add the positions under some levels of lists, as a part each innermost list of them."""
    if not isinstance(coordinates, list):
        fault = f"{coordinates!r:.40} should be a list: correct the coordinates"
        raise vertices.source.error(fault, where)
    if depth == 0:
        vertices.add([coordinates] if coordinates else [], False)  # an empty Point is no vertex
    elif depth == 1:
        vertices.add(coordinates, line)
    else:
        for part in coordinates:
            _add_parts(vertices, part, depth - 1, line, where)


def _coordinates(found: _Features) -> FloatArray:
    positions = found.vertices.positions
    sound = set(map(type, positions)) <= {list} and all(len(each) > 1 for each in positions)
    if not sound or not set(map(type, chain.from_iterable(positions))) <= {int, float}:
        raise _name_bad_position(found)
    try:
        return found.vertices.coordinates()
    except OverflowError:
        raise found.vertices.source.error(
            "an integer is too large for float64: shorten it"
        ) from None


def _name_bad_position(found: _Features) -> FormatError:
    owners = np.repeat(np.arange(len(found.counts)), found.counts).tolist()
    for owner, position in zip(owners, found.vertices.positions, strict=True):
        numbers = isinstance(position, list) and {*map(type, position)} <= {int, float}
        if not numbers or len(position) < 2:
            fault = f"the position {position!r:.60} is not two or three numbers: correct it"
            return found.vertices.source.error(fault, f"feature {owner}")
    return found.vertices.source.error("the positions do not fit together: correct them")


# Properties


def _columns(found: _Features) -> dict[str, npt.NDArray[Any]]:
    names = dict.fromkeys(chain.from_iterable(found.properties))
    return {name: _column(found, name) for name in names}


def _column(found: _Features, name: str) -> npt.NDArray[Any]:
    """Return a property at every vertex; lists with a value per vertex are spread over them."""
    values = [properties.get(name) for properties in found.properties]
    here = [(value, count) for value, count in zip(values, found.counts, strict=True) if count]
    lists = [value for value, count in here if isinstance(value, list) and len(value) == count]
    if len(lists) == len(here):
        return as_column(list(chain.from_iterable(lists)))
    column = as_column([value for value, _ in here])
    return np.repeat(column, [count for _, count in here])


def _crs(document: dict[str, Any]) -> str | None:
    member = document.get("crs")
    properties = member.get("properties") if isinstance(member, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    return name if isinstance(name, str) and name.strip() else None


# Writing


def write_curves(curves: Curves, target: Target, *, polygons: bool = False) -> None:
    """Write the curves as a FeatureCollection, a line of text for each feature.

    Lines in longitude and latitude are cut where they cross the 180th meridian (RFC 7946, 3.1.9).
    """
    features = list(_features_of(curves, polygons))
    if is_geographic(curves.points):
        features = [_cut(feature, target) for feature in features]
    target.write(_collection(attributes_of(curves).crs, map(dump, features)))


def collection_of(curves: Curves, *, polygons: bool) -> str:
    """Return the text of the FeatureCollection of curves, whole across the 180th meridian."""
    features = map(dump, _features_of(curves, polygons))
    return _collection(attributes_of(curves).crs, features)


def _cut(feature: dict[str, Any], target: Target) -> dict[str, Any]:
    """Return a feature as lines on either side of the 180th meridian, if it crosses that."""
    geometry = feature["geometry"]
    kind, coordinates = geometry["type"], geometry["coordinates"]
    if kind == "Polygon" and any(map(crosses, coordinates)):
        warnings.warn(
            f"{target.name}: polygons across the 180th meridian are not cut there, as RFC 7946 "
            "asks for: write lines",
            FormatWarning,
            stacklevel=2,
        )
    if kind != "LineString" or not crosses(coordinates):
        return feature
    pieces, added = cut(coordinates)
    properties = feature["properties"] | {"cut": added}
    geometry = {"type": "MultiLineString", "coordinates": pieces}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def write_points(points: Points, target: Target) -> None:
    """Write points as a FeatureCollection of Points, the other columns as properties."""
    positions = points.xy
    if points.z is not None:
        positions = np.column_stack([positions, points.z])
    columns = [as_json(name, values) for name, values in points.columns.items()]
    rows = zip(*columns, strict=True) if columns else repeat(())
    features = (
        dump(
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
    crs = "" if member is None else f'"crs":{dump(member)},'
    body = ",\n".join(features)
    return f'{{"type":"FeatureCollection",{crs}"features":[\n{body}\n]}}\n'


def _features_of(curves: Curves, polygons: bool) -> Iterator[dict[str, Any]]:
    """Yield features: positions with heights, and the other columns vertex by vertex."""
    columns = attributes_of(curves, reserved=_RESERVED).columns

    for feature in curves.features(polygons=polygons):
        lines = [coordinates_with_height(curves, run).tolist() for run in feature.runs]
        rows = feature.rows
        properties = {"curve": feature.number, "closed": feature.closed, "rows": rows.tolist()}
        properties |= _confidence(curves, feature)
        properties |= {name: as_json(name, values[rows]) for name, values in columns.items()}
        coordinates = lines if feature.kind == "polygon" else lines[0]
        geometry = {"type": _KINDS[feature.kind], "coordinates": coordinates}
        yield {"type": "Feature", "properties": properties, "geometry": geometry}


def _confidence(curves: Curves, feature: Feature) -> dict[str, Any]:
    """Return how sure each edge is, in order along the parts, and the least of it, if known."""
    if curves.confidence is None or feature.kind == "points":
        return {}
    keys = [len(curves.points), 1]
    known = curves.edges @ keys
    values = []
    for part in feature.parts:
        ends = np.stack([part, np.roll(part, -1)], axis=1)[: len(part) - (not feature.closed)]
        values.append(curves.confidence[np.searchsorted(known, np.sort(ends, axis=1) @ keys)])
    sure = np.round(np.concatenate(values), 4)
    return {"confidence": sure.tolist(), "least_sure": float(sure.min())}


def _sniff(head: bytes) -> bool:
    start = head.lstrip(b"\xef\xbb\xbf\x1e \t\r\n")
    return start.startswith((b"{", b"[")) and _TYPE.search(start) is not None


GEOJSON = Format(
    name="geojson",
    title="GeoJSON",
    suffixes=(".geojson", ".json", ".geojsonl", ".geojsons", ".geojsonseq"),
    sniff=_sniff,
    read=read,
    read_curves=read_curves,
    write_points=write_points,
    write_curves=write_curves,
    options=(POLYGONS, ENCODING),
)
