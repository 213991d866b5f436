"""JSON that is no GeoJSON: pairs, records or columns, as one document or one a line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from crustline.errors import FormatError, InputError
from crustline.formats.format import Format
from crustline.formats.geojson import is_geojson, read_document
from crustline.formats.json_text import parse
from crustline.formats.names import find_coordinates, find_pair
from crustline.formats.options import COLUMNS, ENCODING
from crustline.formats.source import Source
from crustline.formats.values import as_column
from crustline.formats.vertices import Vertices
from crustline.points import Points

__all__ = ["JSON"]


def read(
    source: Source,
    *,
    columns: Sequence[str | int] | None = None,
    encoding: str | None = None,
) -> Points:
    """Return the points of [[x, y], …], [{"x": …, "y": …}, …], {"x": […], "y": […]}, or GeoJSON.

    Frames of pandas may have any of its orientations.
    """
    document = parse(source, encoding)
    rows = document if isinstance(document, list) else [document]
    if rows and all(map(is_geojson, rows)):
        if columns is not None:
            raise InputError(f"{source.name} is GeoJSON, which has no columns: leave columns away")
        return read_document(document, source)[0]
    if isinstance(document, list) and all(isinstance(row, list) for row in document):
        return _pairs(document, source)
    return _records(_as_columns(document, source), columns, source)


def _pairs(rows: list[Any], source: Source) -> Points:
    for number, row in enumerate(rows):
        if len(row) < 2 or not {*map(type, row)} <= {int, float}:
            fault = f"{row!r:.60} is not two or three numbers: correct it"
            raise source.error(fault, f"row {number}")
    vertices = Vertices(source, rows)
    try:
        return vertices.points(vertices.coordinates())
    except OverflowError:
        raise source.error("an integer is too large for float64: shorten it") from None


def _as_columns(document: Any, source: Source) -> dict[str, list[Any]]:
    """Return columns of a document that has them, or is records of them."""
    document = _of_frame(document) if isinstance(document, dict) else document
    if (
        document
        and isinstance(document, dict)
        and all(isinstance(each, list) for each in document.values())
    ):
        return document
    if isinstance(document, list) and all(isinstance(row, dict) for row in document):
        names = dict.fromkeys(name for row in document for name in row)
        return {name: [row.get(name) for row in document] for name in names}
    raise source.error(
        "the JSON is neither GeoJSON, which has a type, nor rows of x and y: "
        "write [[x, y], …] or records with x and y"
    )


def _of_frame(document: dict[str, Any]) -> Any:
    """Return records or columns of a frame as pandas writes it, in any of its orientations."""
    rows, names = document.get("data", []), document.get("columns", [])
    if rows and isinstance(rows, list) and "schema" in document:
        return rows
    if rows and _are(str, names) and _are(list, rows):
        return [dict(zip(names, row, strict=False)) for row in rows]
    values = list(document.values())
    if not values or not _are(dict, values):
        return document
    if find_pair(list(document)) is None:
        return values  # a record for each key
    keys = dict.fromkeys(key for column in values for key in column)
    return {name: [column.get(key) for key in keys] for name, column in document.items()}


def _are(kind: type, values: Any) -> bool:
    return isinstance(values, list) and all(isinstance(each, kind) for each in values)


def _records(
    table: dict[str, list[Any]], columns: Sequence[str | int] | None, source: Source
) -> Points:
    names = list(table)
    positions = find_coordinates(names, columns, source.name)
    chosen = [names[k] for k in positions]
    arrays = {name: as_column(values) for name, values in table.items()}
    for name in chosen:
        _check(name, table[name], arrays[name], source)
    lengths = {name: len(values) for name, values in table.items()}
    short = next((name for name in names if lengths[name] != lengths[chosen[0]]), None)
    if short is not None:
        raise source.error(
            f"{short!r:.40} has {lengths[short]} values, {chosen[0]!r:.40} {lengths[chosen[0]]}: "
            "give one a row"
        )
    beside = {name: arrays[name] for name in names if name not in chosen}
    xyz = np.column_stack([arrays[name] for name in chosen])
    pair = (chosen[0], chosen[1])
    return Vertices(source).points(xyz, columns=beside, names=pair)


def _check(name: str, values: list[Any], array: Any, source: Source) -> None:
    """Refuse a coordinate that is not a number in every row."""
    if array.dtype.kind in "iuf" and np.isfinite(array).all():
        return
    for row, value in enumerate(values):
        if type(value) not in (int, float):
            fault = f"{value!r:.60} is not a number: correct it"
            raise source.error(fault, f"row {row}, column {name!r:.40}")
    if values:
        raise FormatError(f"{source.name}: a number of {name!r:.40} is too large: shorten it")


def _sniff(head: bytes) -> bool:
    return head.lstrip(b"\xef\xbb\xbf\x1e \t\r\n").startswith((b"{", b"["))


JSON = Format(
    name="json",
    title="JSON",
    suffixes=(".json", ".ndjson", ".jsonl", ".geojson"),
    sniff=_sniff,
    read=read,
    options=(COLUMNS, ENCODING),
)
