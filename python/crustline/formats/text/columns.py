"""Rows of text to columns: at once where every cell is a number, cell by cell where not."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import chain, islice
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from crustline.errors import FormatError
from crustline.formats.text.dialect import Dialect
from crustline.formats.text.lines import Lines, split
from crustline.formats.text.numbers import Mark, decimal_mark
from crustline.formats.text.settings import Settings

__all__ = ["Table", "read_columns", "typed"]

Column = npt.NDArray[Any]

_CHUNK = 1 << 10  # rows at a time: few, so that they stay in the cache
_LEADING_ZERO = re.compile(r"(?<![\d.eE+-])0\d")
_INTEGER = re.compile(r"[+-]?\d+")
_GLUED = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")


@dataclass
class Table:
    """Columns as they were read: arrays of numbers, or lists of cells.

    Attributes
    ----------
    columns : dict of int to ndarray or list of str
        By position.
    positions : list of int, or None
        The line of each row; None until an error asks for it.
    mark : "." or ","
        The decimal mark.
    bad : list of int
        Lines that were left out because they are no rows.
    """

    lines: Lines
    dialect: Dialect
    columns: dict[int, Any]
    positions: list[int] | None = None
    mark: Mark = "."
    bad: list[int] = field(default_factory=list)

    @property
    def names(self) -> tuple[str, ...]:
        """What the columns are called."""
        return self.dialect.names

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def line(self, row: int) -> int:
        """Return the number of a row's line, counted from 1."""
        if self.positions is not None:
            return self.lines.number(self.positions[row])
        rows = self.lines.rows(self.dialect.separator, self.dialect.first)
        return self.lines.number(next(islice(rows, row, None))[0])

    def error(self, row: int, column: int | None, fault: str) -> FormatError:
        """Return the error about a row, or a cell of it."""
        place = "" if column is None else f", column {self.names[column]!r:.60}"
        return self.lines.source.error(fault, f"line {self.line(row)}{place}")

    def less(self, kept: npt.NDArray[np.bool_]) -> Table:
        """Return the table with some of its rows."""
        if kept.all():
            return self
        rows = np.flatnonzero(kept).tolist()
        columns = {k: _taken(column, rows) for k, column in self.columns.items()}
        positions = [self.positions[row] for row in rows] if self.positions else None
        return Table(self.lines, self.dialect, columns, positions, self.mark, self.bad)


def _taken(column: Any, rows: list[int]) -> Any:
    return column[rows] if isinstance(column, np.ndarray) else [column[row] for row in rows]


def read_columns(
    lines: Lines, dialect: Dialect, coordinates: Sequence[int], settings: Settings
) -> Table:
    """Return all columns; rows of another width are refused, or left out."""
    table = None if settings.decimal == "," else _all_numbers(lines, dialect, coordinates)
    if table is None:
        table = _cells(lines, dialect, settings.on_bad_row == "skip")
        cells = chain.from_iterable(table.columns[k] for k in coordinates)
        table.mark = cast(Mark, settings.decimal or _mark(lines, cells))
    lines.source.note("decimal mark", "comma" if table.mark == "," else "point")
    return table


def _mark(lines: Lines, cells: Iterable[str]) -> Mark:
    mark = decimal_mark(cells)
    if mark is None:
        raise FormatError(
            f"{lines.source.name}: a comma before three digits, as in 600,000, marks decimals or "
            "thousands: say what the decimal mark is (--decimal , or --decimal .)"
        )
    return mark


# The fast way: every cell is a number


def _all_numbers(lines: Lines, dialect: Dialect, coordinates: Sequence[int]) -> Table | None:
    """Return the columns if all cells are numbers and fit; None leaves it to `_cells`."""
    suspect = {mark[0] for mark in (*lines.comments, *">&")}
    data = [
        line
        for line in lines.all[dialect.first :]
        if line and (line[0] not in suspect or lines.is_data(line))
    ]
    array = None if lines.dropped else _loaded(data, dialect)
    width = len(dialect.names)
    if array is None or array.shape[1] != width or not np.isfinite(array[:, coordinates]).all():
        return None
    if width > len(coordinates) and any(map(_LEADING_ZERO.search, data)):
        return None
    first = split(next(line for line in data if line.strip()), dialect.separator)
    whole = [k for k, cell in enumerate(first) if _INTEGER.fullmatch(cell.strip())]
    integers = _as_integers(array, sorted({*whole} - {*coordinates}))
    return (
        None
        if integers is None
        else Table(lines, dialect, {**dict(enumerate(array.T)), **integers})
    )


def _loaded(data: list[str], dialect: Dialect) -> Column | None:
    """Return the numbers of all cells; None if one is none, or not spelled in the usual way."""
    if not data or any("#" in line for line in data):
        return None
    separator = None if dialect.separator == " " else dialect.separator
    try:
        return np.loadtxt(data, delimiter=separator, comments=None, quotechar='"', ndmin=2)
    except ValueError:
        return None


def _as_integers(array: Column, columns: list[int]) -> dict[int, Column] | None:
    """Return columns of integers as int64; None if float64 may have rounded one of some columns."""
    block = array[:, columns]
    if (np.abs(block) >= 2.0**53).any():
        return None
    integral = np.flatnonzero((block == np.floor(block)).all(axis=0)).tolist()
    return {columns[place]: block[:, place].astype(np.int64) for place in integral}


# The way for text, which also finds what is wrong


def _cells(lines: Lines, dialect: Dialect, skip: bool) -> Table:
    width = len(dialect.names)
    columns: list[list[str]] = [[] for _ in range(width)]
    positions: list[int] = []
    table = Table(lines, dialect, {}, positions)
    rows = lines.rows(dialect.separator, dialect.first)
    while block := list(islice(rows, _CHUNK)):
        if {len(cells) for _, cells in block} != {width}:
            block = _fitted(table, block, width, skip)
        if block:
            positions.extend(position for position, _ in block)
            for column, cells in zip(
                columns, zip(*(cells for _, cells in block), strict=True), strict=True
            ):
                column.extend(cells)
    table.columns = dict(enumerate(columns))
    return table


def _fitted(
    table: Table, block: list[tuple[int, list[str]]], width: int, skip: bool
) -> list[tuple[int, list[str]]]:
    """Return the rows with a cell for each column; refuse the others, or leave them out."""
    fitting = []
    for position, cells in block:
        row = _as_wide(cells, width, table.names[-1] == f"column{width - 1}")
        if row is not None:
            fitting.append((position, row))
        elif skip:
            table.bad.append(position)
        else:
            raise _misfit(table, position, cells, width)
    return fitting


def _as_wide(cells: list[str], width: int, open_end: bool) -> list[str] | None:
    """Return cells of the width; a last one may be empty, numbers may be parted by signs only."""
    if len(cells) == width:
        return cells
    if len(cells) == width + 1 and not cells[-1].strip():
        return cells[:-1]
    if len(cells) == width - 1 and open_end and width > 2:
        return [*cells, ""]
    glued = [part for cell in cells for part in _GLUED.findall(cell)]
    return glued if len(glued) == width and "".join(glued) == "".join(cells) else None


def _misfit(table: Table, position: int, cells: list[str], width: int) -> FormatError:
    what = f"{len(cells)} columns" if len(cells) != 1 else "1 column"
    advice = "complete or remove it, or leave such rows out (--on-bad-row skip)"
    if table.dialect.separator == "," and len(cells) == 2 * width:
        advice = "if commas mark decimals, too, save the file with semicolons between columns"
    return table.lines.source.error(
        f"the row has {what}, not {width}: {advice}", f"line {table.lines.number(position)}"
    )


# Values of the other columns


def typed(table: Table, column: int) -> Column:
    """Return a column as bools, integers, floats or text; codes such as 00123 remain text."""
    cells = table.columns[column]
    text: Column = np.array(cells) if isinstance(cells, np.ndarray) else _objects(cells)
    if text.dtype != np.object_ or not len(text):
        return text
    if set(cells) <= {"true", "false"}:
        return np.array([cell == "true" for cell in cells])
    joined = "\n".join(cells)
    # Python, unlike every file format, reads 1_000 as a number.
    numeric = "_" not in joined and re.search(r"(?m)^0\d", joined) is None
    return _numeric(cells, table.mark) if numeric else text


def _numeric(cells: list[str], mark: str) -> Column:
    """Return numbers if every cell is one that a type holds exactly, else text."""
    text = _objects(cells)
    for kind in (np.int64, np.uint64):
        try:
            return text.astype(kind)
        except (ValueError, OverflowError):
            continue
    if all(map(_INTEGER.fullmatch, cells)):
        return text  # too large for any integer, and float64 would round it
    try:
        plain = text if mark == "." else _objects([cell.replace(",", ".") for cell in cells])
        return plain.astype(np.float64)
    except ValueError:
        return text


def _objects(cells: list[str]) -> Column:
    """Return cells as objects: as text of NumPy's own all would take the longest one's room."""
    return np.array(cells, dtype=np.object_)
