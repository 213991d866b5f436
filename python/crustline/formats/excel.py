"""Excel workbooks (xlsx, xls, xlsb, ods), read by python-calamine: a header, then a row a point."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.formats.format import Format, Layer
from crustline.formats.names import find_coordinates
from crustline.formats.options import COLUMNS, LAYER
from crustline.formats.sheet_extent import extents
from crustline.formats.source import Source
from crustline.points import Points

Row = list[Any]
#: Cells of a sheet, empty ones included: they take a few dozen bytes each.
_MOST_CELLS = 50_000_000


def read(
    source: Source, *, layer: str | None = None, columns: Sequence[str | int] | None = None
) -> Points:
    """Return the rows of a sheet, by default the first that holds any; a header names columns."""
    name, rows = _sheet(source, layer)
    source.note("sheet", name)
    first, has_header = 1, any(isinstance(cell, str) and cell.strip() for cell in rows[0])
    names = [str(cell).strip() or f"column {k}" for k, cell in enumerate(rows[0])]
    if not has_header:
        first, names = 0, ["x", "y", "z", *(f"column {k}" for k in range(3, len(rows[0])))]
        names = names[: len(rows[0])]
    places = find_coordinates(names, columns, f"{source.name}, sheet {name!r}")
    body = [row for row in rows[first:] if any(cell != "" for cell in row)]
    coordinates = [_numbers(source, body, place, names[place], first) for place in places]
    rest = {
        names[k]: _column([row[k] for row in body]) for k in range(len(names)) if k not in places
    }
    pair = (names[places[0]], names[places[1]])
    z = coordinates[2] if len(coordinates) == 3 else None
    with source.named():
        return Points(np.stack(coordinates[:2], axis=1), z=z, columns=rest, names=pair)


def layers(source: Source) -> list[Layer]:
    """Return the sheets."""
    return [Layer(name, "sheet", len(rows)) for name, rows in _sheets(source)]


def _sheet(source: Source, wanted: str | None) -> tuple[str, list[Row]]:
    sheets = _sheets(source)
    names = [name for name, _ in sheets]
    for name, rows in sheets:
        if wanted == name or (wanted is None and rows):
            if not rows:
                break
            return name, rows
    if wanted is None or wanted in names:
        raise source.error("the sheet is empty: give one with a row a point")
    raise source.error(f"there is no sheet {wanted!r:.60}: choose from {names}")


def _sheets(source: Source) -> list[tuple[str, list[Row]]]:
    with source.path() as path, source.library("python-calamine"):
        _refuse_far_cells(source, path)
        from python_calamine import CalamineWorkbook

        book = CalamineWorkbook.from_path(path)
        return [
            (name, book.get_sheet_by_name(name).to_python(skip_empty_area=True))
            for name in book.sheet_names
        ]


def _refuse_far_cells(source: Source, path: Path) -> None:
    """Refuse a sheet with a cell far from the others: the library makes room for all between.

    What it has no room for ends the process.
    """
    if not zipfile.is_zipfile(path):
        return
    with zipfile.ZipFile(path) as archive:
        for height, width in extents(archive):
            if height * width > _MOST_CELLS:
                rows, columns = (f"{min(each, _MOST_CELLS):,}" for each in (height, width))
                raise source.error(
                    f"a sheet spans {rows} rows and {columns} columns at the least: "
                    "delete what is far from the points"
                )


def _numbers(
    source: Source, rows: list[Row], place: int, name: str, first: int
) -> npt.NDArray[np.float64]:
    for number, row in enumerate(rows):
        cell = row[place]
        if isinstance(cell, bool) or not isinstance(cell, int | float):
            fault = f"{cell!r:.40} is not a number" if cell != "" else "the value is missing"
            raise source.error(
                f"{fault}: correct or remove the row", f"row {number + first + 1}, column {name!r}"
            )
    return np.array([row[place] for row in rows], dtype=np.float64)


def _column(cells: list[Any]) -> npt.NDArray[Any]:
    """Return bools, numbers (whole ones as such; missing is NaN) or text."""
    kinds = {type(cell) for cell in cells if cell != ""}
    if kinds == {bool} and "" not in cells:
        return np.array(cells, dtype=np.bool_)
    if kinds and kinds <= {int, float}:
        numbers = np.array([np.nan if cell == "" else cell for cell in cells], dtype=np.float64)
        whole = bool((numbers == np.floor(numbers)).all() and (np.abs(numbers) < 2**53).all())
        return numbers.astype(np.int64) if whole else numbers
    return np.array([str(cell) for cell in cells], dtype=np.object_)


def _is_workbook(head: bytes) -> bool:
    packed = head.startswith(b"PK\x03\x04")
    parts = (b"xl/", b"[Content_Types].xml", b"opendocument.spreadsheet")
    return head.startswith(b"\xd0\xcf\x11\xe0") or (packed and any(p in head for p in parts))


EXCEL = Format(
    name="excel",
    title="Excel",
    suffixes=(".xlsx", ".xls", ".xlsb", ".ods"),
    sniff=_is_workbook,
    read=read,
    layers=layers,
    options=(COLUMNS, LAYER),
    extra="tables",
    needs=("python_calamine",),
)
