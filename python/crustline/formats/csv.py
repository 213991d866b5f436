"""Columns of text: CSV, TSV, XYZ and plain columns are read alike, CSV and TSV are written.

Points without curves are written as XYZ, too: numbers alone, without a header.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.errors import FormatError
from crustline.formats.attributes import (
    attributes_of,
    attributes_of_points,
    find_coordinates,
    find_pair,
    texts,
)
from crustline.formats.format import Format
from crustline.formats.options import COLUMNS
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points

if TYPE_CHECKING:
    from crustline.curves import Curves

Column = npt.NDArray[Any]
_CHUNK = 1 << 10  # rows at a time: few, so that they stay in the cache
_LEADING_ZERO = re.compile(r"(?<![\d.eE+-])0\d")
_COMMENT = re.compile(r'("[^"]*")|^[ \t]*#[^\n]*', re.MULTILINE)  # what is in quotes is none
_INTEGER = re.compile(r"[+-]?\d+")


@dataclass(frozen=True)
class _Table:
    """Text whose comments are blanked, and where its data are."""

    source: str
    text: str
    start: int  # of the data, behind the header
    separator: str | None  # None is any run of spaces and tabs
    names: list[str]
    positions: list[int]
    decimal_comma: bool

    @property
    def first_line(self) -> int:
        return self.text.count("\n", 0, self.start) + 1

    def places(self, column: int) -> bool:
        """Return whether a column is one of the coordinates."""
        return column in self.positions

    def is_trailing(self, column: int, cells: Column) -> bool:
        """Return whether a column is only what follows a separator at the end of each line."""
        named = self.names[column] != f"column{column}"
        return not (named or self.places(column) or any(cells.tolist()))

    @property
    def others(self) -> list[int]:
        return [k for k in range(len(self.names)) if not self.places(k)]

    def error(self, row: int, column: int | None, fault: str) -> FormatError:
        """Return the error about a data row; its line is counted only now."""
        line = next(islice(_rows(self), row, None))[0]
        place = "" if column is None else f", column {self.names[column]!r}"
        return FormatError(f"{self.source}, line {line}{place}: {fault}")


def read(source: Source, *, columns: Sequence[str | int] | None = None) -> Points:
    """Return the points of columns of text; the separator is sniffed."""
    table = _survey(source.text(), source.name, columns)
    values = _read_numbers(table) or _read_cells(table)
    names = (table.names[table.positions[0]], table.names[table.positions[1]])
    coordinates = np.column_stack([values.pop(position) for position in table.positions[:2]])
    z = values.pop(table.positions[2]) if len(table.positions) == 3 else None
    others = {table.names[k]: values[k] for k in sorted(values)}
    return Points(coordinates, z=z, columns=others, names=names)


# The survey: comments, separator, header, columns


def _survey(text: str, source: str, columns: Sequence[str | int] | None) -> _Table:
    comment = None
    if "#" in text:
        comment = _last_comment_before_data(text)
        text = _COMMENT.sub(lambda match: match[1] or "", text)
    start = re.search(r"\S", text)
    if start is None:
        raise FormatError(f"{source} holds comments only: give a file with at least one point")
    begin = text.rfind("\n", 0, start.start()) + 1
    first = _line_at(text, begin)
    separator = _sniff_separator(first)
    cells = _split(first, separator)
    if _is_header(cells, columns):
        names, begin = _header(cells, source), begin + len(first) + 1
    elif comment is not None and find_pair(_split(comment, separator)) is not None:
        names = _header(_split(comment, separator), source)
    else:
        names = [*"xyz", *(f"column{k}" for k in range(3, len(cells)))][: len(cells)]
    if len(names) < 2:
        line = text.count("\n", 0, start.start()) + 1
        raise FormatError(
            f"{source}, line {line}: {first.strip()[:60]!r} is one column, but points need two: "
            "separate x and y by a comma, a tab, a semicolon or spaces"
        )
    positions = find_coordinates(names, columns, source)
    comma = separator == ";" and re.compile(r"\d,\d").search(text, begin) is not None
    return _Table(source, text, begin, separator, names, positions, comma)


def _line_at(text: str, begin: int) -> str:
    """Return the first line from a place on that is not blank."""
    match = re.compile(r"[^\n]*\S[^\n]*").search(text, begin)
    return match[0] if match else ""


def _last_comment_before_data(text: str) -> str | None:
    comment = None
    for match in re.finditer(r"[^\n]*\S[^\n]*", text):
        line = match[0].strip()
        if not line.startswith("#"):
            break
        comment = line.lstrip("# ")
    return comment


def _sniff_separator(line: str) -> str | None:
    return next((mark for mark in "\t;," if mark in line), None)


def _split(line: str, separator: str | None) -> list[str]:
    if separator is not None:
        try:
            return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
        except csv.Error:  # a cell beyond all bounds: no quotes are worth a thought
            return line.split(separator)
    line = line.split("#", 1)[0]
    if '"' in line:
        return [cell.strip('"') for cell in re.findall(r'"[^"]*"|\S+', line)]
    return line.split()


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return "_" not in cell


def _is_header(cells: list[str], columns: Sequence[str | int] | None) -> bool:
    """A first line is a header if it names x and y, names what was chosen, or holds no number."""
    if find_pair(cells) is not None or not any(map(_is_number, cells)):
        return True
    chosen = [each for each in columns or () if isinstance(each, str)]
    return (
        bool(chosen) and all(each in cells for each in chosen) and not all(map(_is_number, chosen))
    )


def _header(cells: list[str], source: str) -> list[str]:
    names = [cell.strip() or f"column{k}" for k, cell in enumerate(cells)]
    for name in names:
        if names.count(name) > 1:
            raise FormatError(
                f"{source} has the column {name!r} more than once: rename one of them"
            )
    return names


# The fast way: every cell is a number


def _read_numbers(table: _Table) -> dict[int, Column] | None:
    """Return the columns if all cells are numbers and fit; None leaves it to `_read_cells`."""
    data = table.text[table.start :]
    if not data.strip():
        return None
    if table.decimal_comma:
        data = data.replace(",", ".")
    comments = "#" if table.separator is None else None
    try:
        array = np.loadtxt(
            io.StringIO(data), delimiter=table.separator, comments=comments, quotechar='"', ndmin=2
        )
    except ValueError:
        return None
    if table.others and _LEADING_ZERO.search(data):
        return None
    if array.shape[1] != len(table.names) or not np.isfinite(array[:, table.positions]).all():
        return None
    first = _split(_line_at(table.text, table.start), table.separator)
    columns: dict[int, Column] = {k: array[:, k] for k in table.positions}
    for k in table.others:
        column = _as_integers(array[:, k]) if _INTEGER.fullmatch(first[k]) else array[:, k]
        if column is None:
            return None
        columns[k] = column
    return columns


def _as_integers(column: FloatArray) -> Column | None:
    """Return int64 where all values are integers; None if float64 may have rounded one of them."""
    if (np.abs(column) >= 2.0**53).any():
        return None
    return column.astype(np.int64) if (column == np.floor(column)).all() else column


# The way for text, which also finds what is wrong


def _read_cells(table: _Table) -> dict[int, Column]:
    chunks: list[list[Column]] = [[] for _ in table.names]
    rows, count = _rows(table), 0
    while block := [cells for _, cells in islice(rows, _CHUNK)]:
        _check_widths(table, block, count)
        for k, cells in enumerate(zip(*block, strict=True)):
            column: Column = np.array(
                cells, dtype=np.object_
            )  # "U" would give all rows the longest width
            if table.places(k):
                column = _as_coordinate(table, k, column, count)
            chunks[k].append(column)
        count += len(block)
    columns = {k: np.concatenate(parts or [np.empty(0)]) for k, parts in enumerate(chunks)}
    return {
        k: column if table.places(k) else _as_values(table, column)
        for k, column in columns.items()
        if not table.is_trailing(k, column)
    }


def _rows(table: _Table) -> Iterator[tuple[int, list[str]]]:
    """Yield the line number and the cells of each row; blank lines are no rows."""
    lines = io.StringIO(table.text[table.start :])
    before = table.first_line - 1
    if table.separator is None:
        for number, line in enumerate(lines, before + 1):
            if cells := _split(line, None):
                yield number, cells
        return
    reader = csv.reader(lines, delimiter=table.separator, skipinitialspace=True)
    try:
        for cells in reader:
            if len(cells) > 1 or (cells and cells[0].strip()):
                yield before + reader.line_num, cells
    except csv.Error as error:
        place = f"{table.source}, line {before + reader.line_num}"
        raise FormatError(f"{place}: {error}: correct the quotes") from None


def _check_widths(table: _Table, block: list[list[str]], before: int) -> None:
    width = len(table.names)
    if set(map(len, block)) <= {width}:
        return
    row = next(k for k, cells in enumerate(block) if len(cells) != width)
    what = f"{len(block[row])} columns" if len(block[row]) != 1 else "1 column"
    raise table.error(before + row, None, f"the row has {what}, not {width}: complete or remove it")


def _as_coordinate(table: _Table, column: int, cells: Column, before: int) -> FloatArray:
    numbers = _as_floats(table, cells)
    if numbers is None:
        row = next(k for k, cell in enumerate(cells) if not _parses(table, cell))
        cell = cells[row][:60]
        fault = f"{cell!r} is not a number" if cell.strip() else "the value is missing"
        raise table.error(before + row, column, f"{fault}: correct or remove the row")
    finite = np.isfinite(numbers)
    if not finite.all():
        row = int(np.argmin(finite))
        fault = f"{cells[row][:60]!r} is not finite: correct or remove the row"
        raise table.error(before + row, column, fault)
    return numbers


def _parses(table: _Table, cell: str) -> bool:
    return _as_floats(table, np.array([cell], dtype=np.object_)) is not None


def _as_floats(table: _Table, cells: Column) -> FloatArray | None:
    if table.decimal_comma:
        cells = np.array([cell.replace(",", ".") for cell in cells], dtype=np.object_)
    try:
        numbers = cells.astype(np.float64)
    except ValueError:
        return None
    # Python, unlike every file format, reads 1_000 as a number.
    return None if "_" in "".join(cells.tolist()) else numbers


def _as_values(table: _Table, cells: Column) -> Column:
    """Return numbers if every cell is one; codes such as 00123, which would change, remain text."""
    floats = _as_floats(table, cells) if len(cells) else None
    if floats is None or re.search(r"(?m)^0\d", "\n".join(cells.tolist())):
        return cells
    try:
        return cells.astype(np.int64)
    except ValueError:
        return floats
    except OverflowError:
        return cells


# Writing


def _write_curves(curves: Curves, target: Target, separator: str) -> None:
    """Write curve, order, row, x, y, z, closed, then the other columns."""
    rows = np.concatenate([curves.indices, curves.isolated])
    columns = _result_columns(curves)
    attributes = attributes_of(curves, reserved=columns)
    if attributes.z is None:
        del columns["z"]
    else:
        columns["z"] = attributes.z[rows]
    columns |= {name: values[rows] for name, values in attributes.columns.items()}
    target.write(_table(columns, separator))


def _write_points(points: Points, target: Target, separator: str) -> None:
    """Write the coordinates by the names that they had, z, the other columns."""
    columns: dict[str, Column] = dict(zip(points.names, np.asarray(points).T, strict=True))
    if points.z is not None:
        columns["z"] = points.z
    columns |= attributes_of_points(points, reserved=columns).columns
    target.write(_table(columns, separator))


def _write_xyz(points: Points, target: Target) -> None:
    """Write lines of x, y and z if there is one; XYZ has no other columns."""
    heights = [] if points.z is None else [points.z]
    cells = [texts(values) for values in (*np.asarray(points).T, *heights)]
    target.write("".join(f"{' '.join(row)}\n" for row in zip(*cells, strict=True)))


def _table(columns: dict[str, Column], separator: str) -> str:
    header = separator.join(_cells(np.array(list(columns)), separator))
    cells = [_cells(values, separator) for values in columns.values()]
    lines = [header, *map(separator.join, zip(*cells, strict=True)), ""]
    return "\n".join(lines)


def _result_columns(curves: Curves) -> dict[str, Column]:
    sizes, alone = np.diff(curves.offsets), len(curves.isolated)
    rows = np.concatenate([curves.indices, curves.isolated])
    order = np.arange(len(curves.indices)) - np.repeat(curves.offsets[:-1], sizes)
    return {
        "curve": np.concatenate([np.repeat(np.arange(len(curves)), sizes), np.full(alone, -1)]),
        "order": np.concatenate([order, np.arange(alone)]),
        "row": rows,
        "x": curves.points.xy[rows, 0],
        "y": curves.points.xy[rows, 1],
        "z": rows,
        "closed": np.concatenate([np.repeat(curves.closed, sizes), np.zeros(alone, bool)]).astype(
            int
        ),
    }


def _cells(values: Column, separator: str) -> list[str]:
    """Return the cells of a column, in quotes where the text holds what would end a cell."""
    cells = texts(values)
    if values.dtype.kind not in "USO":
        return cells
    special = re.compile(f'[{separator}"\r\n]|^[\\s#]')
    return [f'"{c.replace(chr(34), 2 * chr(34))}"' if special.search(c) else c for c in cells]


CSV = Format(
    name="csv",
    title="CSV",
    suffixes=(".csv",),
    read=read,
    write_points=partial(_write_points, separator=","),
    write_curves=partial(_write_curves, separator=","),
    options=(COLUMNS,),
)
TSV = Format(
    name="tsv",
    title="TSV",
    suffixes=(".tsv", ".tab"),
    read=read,
    write_points=partial(_write_points, separator="\t"),
    write_curves=partial(_write_curves, separator="\t"),
    options=(COLUMNS,),
)
XYZ = Format(
    name="xyz",
    title="XYZ",
    suffixes=(".xyz", ".txt", ".dat", ".asc"),
    read=read,
    write_points=_write_xyz,
    options=(COLUMNS,),
)
