"""Columns of text, in five stages: bytes, lines, dialect, columns, coordinates.

CSV, TSV, XYZ and plain columns are read alike, CSV and TSV are written. Points without curves are
written as XYZ, too: numbers alone, without a header.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

from crustline.curves import Curves
from crustline.formats.format import Format
from crustline.formats.source import Source
from crustline.formats.text.columns import read_columns
from crustline.formats.text.coordinates import as_points, choose_coordinates
from crustline.formats.text.curves import curves_of
from crustline.formats.text.dialect import find_dialect
from crustline.formats.text.geometries import find_geometries, points_of_geometries
from crustline.formats.text.lines import Lines, split_lines, unbounded_cells
from crustline.formats.text.pieces import LARGE, pieces_of, read_large
from crustline.formats.text.settings import OPTIONS, Settings
from crustline.formats.text.writer import write_curves, write_points, write_xyz
from crustline.points import Points

__all__ = ["CSV", "TSV", "XYZ"]


def read(source: Source, **options: Any) -> Points:
    """Return the points of columns of text; the options are those of `Settings`."""
    settings = Settings(**options)
    if (source.size or 0) > LARGE and (points := read_large(source, settings)) is not None:
        return points
    with unbounded_cells():
        lines = Lines(source, split_lines(source.text(settings.encoding)), settings.skip_lines or 0)
        if settings.comment is not None:
            lines = lines.with_comments(settings.comment)
        lines, dialect = find_dialect(lines, settings)
        geometries = find_geometries(dialect.names, settings)
        if geometries is not None:
            table = read_columns(lines, dialect, [], settings)
            return points_of_geometries(table, geometries)
        positions = choose_coordinates(lines, dialect, settings)
        table = read_columns(lines, dialect, positions, settings)
        return as_points(table, positions, settings)


def stream(source: Source, rows: int, **options: Any) -> Iterator[Points]:
    """Yield the points of so many lines at a time."""
    return pieces_of(source, rows, Settings(**options))


def read_curves(source: Source, **options: Any) -> Curves:
    """Return the curves of columns curve, order, row and closed."""
    return curves_of(read(source, **options), source)


CSV = Format(
    name="csv",
    title="CSV",
    suffixes=(".csv",),
    read=read,
    stream=stream,
    read_curves=read_curves,
    write_points=partial(write_points, delimiter=","),
    write_curves=partial(write_curves, delimiter=","),
    options=OPTIONS,
)
TSV = Format(
    name="tsv",
    title="TSV",
    suffixes=(".tsv", ".tab"),
    read=read,
    stream=stream,
    read_curves=read_curves,
    write_points=partial(write_points, delimiter="\t"),
    write_curves=partial(write_curves, delimiter="\t"),
    options=OPTIONS,
)
XYZ = Format(
    name="xyz",
    title="XYZ",
    suffixes=(".xyz", ".txt", ".dat", ".asc"),
    read=read,
    stream=stream,
    write_points=write_xyz,
    options=OPTIONS,
)
