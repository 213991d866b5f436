"""How far the cells of each sheet of a workbook are spread, without making room for them."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Iterator

#: Rows and columns that a sheet spans.
Extent = tuple[int, int]

#: Where a cell of an xlsx, or a row, says that it is.
_PLACE = re.compile(rb'<(?:\w{1,20}:)?(?:c|row)\s[^>]*?\br="([A-Za-z]*)(\d+)"')
#: A sheet, row or cell of an ods begins; a cell that is closed at once holds a value at most.
_OPENING = re.compile(rb"<table:(table|table-row|(?:covered-)?table-cell)(?=[\s/>])([^>]*)>")
_REPEATED = re.compile(rb'table:number-(?:rows|columns)-repeated="(\d{1,18})"')
#: Kinds of records of an xlsb: a row's header, and the cells that may follow.
_ROW, _CELLS = 0, range(1, 12)


def extents(archive: zipfile.ZipFile) -> Iterator[Extent]:
    """Yield the extent of each sheet of an xlsx, xlsb or ods."""
    for name in archive.namelist():
        for pattern, reader in _SHEETS.items():
            if re.fullmatch(pattern, name):
                yield from reader(archive.read(name))


def _of_xlsx(sheet: bytes) -> Iterator[Extent]:
    places = _PLACE.findall(sheet)
    rows = {int(row) for _, row in places} or {0}
    columns = [_column_number(each) for each in {letters for letters, _ in places}]
    yield max(rows) - min(rows) + 1, max(columns, default=0) + 1


def _column_number(letters: bytes) -> int:
    """Return the position of a column by its letters: 0 for A."""
    number = 0
    for letter in letters.upper():
        number = 26 * number + letter - 64
    return number - 1


def _of_ods(content: bytes) -> Iterator[Extent]:
    """Yield the extents of sheets; rows and cells follow one another, some of them many times."""
    height = width = rows = row = column = 0
    for kind, attributes in _OPENING.findall(content):
        repeated = _REPEATED.search(attributes)
        times = int(repeated[1]) if repeated else 1
        if kind == b"table":
            yield height, width
            height = width = rows = 0
        elif kind == b"table-row":
            row, column = times, 0
            rows += row
        else:
            column += times
            if b"office:value" in attributes or not attributes.endswith(b"/"):
                height, width = rows, max(width, column)
    yield height, width


def _of_xlsb(sheet: bytes) -> Iterator[Extent]:
    rows, width, row = [0], 0, 0
    for kind, start in _records(sheet):
        number = int.from_bytes(sheet[start : start + 4], "little")
        if kind == _ROW:
            row = number
        elif kind in _CELLS:
            rows.append(row)
            width = max(width, number + 1)
    rows = rows[1:] or rows
    yield max(rows) - min(rows) + 1, width


def _records(sheet: bytes) -> Iterator[tuple[int, int]]:
    """Yield the kind of each record, and where its body starts."""
    place = 0
    while place < len(sheet):
        kind, place = _number(sheet, place, 2)
        size, place = _number(sheet, place, 4)
        yield kind, place
        place += size


def _number(sheet: bytes, place: int, most: int) -> tuple[int, int]:
    """Return a number of up to so many bytes, seven bits in each, and where it ends."""
    number = 0
    for k, byte in enumerate(sheet[place : place + most]):
        number |= (byte & 0x7F) << 7 * k
        if byte < 0x80:
            return number, place + k + 1
    return number, place + most


_SHEETS: dict[str, Callable[[bytes], Iterator[Extent]]] = {
    r"xl/worksheets/[^/]+\.xml": _of_xlsx,
    r"xl/worksheets/[^/]+\.bin": _of_xlsb,
    r"content\.xml": _of_ods,
}
