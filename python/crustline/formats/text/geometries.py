"""A column of well-known text: each row is the vertices of its geometry."""

from __future__ import annotations

import numpy as np

from crustline.formats.names import find_pair
from crustline.formats.text.columns import Table, typed
from crustline.formats.text.dialect import plain_geometry
from crustline.formats.text.settings import Settings
from crustline.formats.wkt import parse
from crustline.points import Points

__all__ = ["find_geometries", "points_of_geometries"]


def find_geometries(names: tuple[str, ...], settings: Settings) -> int | None:
    """Return the position of the column of geometries, if no columns are x and y."""
    chosen = settings.columns is not None or find_pair(names) is not None
    return None if chosen else plain_geometry(names)


def points_of_geometries(table: Table, column: int) -> Points:
    """Return the vertices of all rows, with the other columns repeated over those of a row."""
    # A column of numbers alone is there as numbers, and refused as any text that is no geometry.
    cells = [str(cell).replace("\n", " ") for cell in table.columns[column]]
    filled = np.array([bool(cell.strip()) for cell in cells], bool)
    rows = np.flatnonzero(filled).tolist()
    if len(rows) < len(cells):
        table.lines.source.note("rows without a geometry", f"{len(cells) - len(rows):,}")
    lines = [table.line(row) for row in rows]
    text = "\n".join(cells[row] for row in rows)
    geometries = parse(text, table.lines.source, [*lines, lines[-1]] if lines else [1])
    counts = np.zeros(len(cells), np.int64)
    counts[filled] = _one_a_row(geometries.counts, table, rows)
    columns = {
        table.names[k]: np.repeat(typed(table, k), counts) for k in table.columns if k != column
    }
    vertices = geometries.vertices
    return vertices.points(geometries.coordinates, columns=columns, crs=geometries.crs)


def _one_a_row(counts: list[int], table: Table, rows: list[int]) -> list[int]:
    if len(counts) != len(rows):
        raise table.lines.source.error("a row has more than one geometry: give each a row")
    return counts
