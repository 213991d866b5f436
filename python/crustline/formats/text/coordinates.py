"""Columns to points: which of them are x, y and z, which rows have none, and what is doubtful."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from crustline.arrays import BoolArray, FloatArray
from crustline.errors import FormatError
from crustline.formats.names import find_coordinates, find_pair, is_section, quote_all
from crustline.formats.text.columns import Table, typed
from crustline.formats.text.dialect import Dialect
from crustline.formats.text.lines import Lines
from crustline.formats.text.numbers import Mark, parse_all
from crustline.formats.text.settings import Settings
from crustline.points import Points

__all__ = ["as_points", "choose_coordinates", "holds_sentinels", "is_count"]

_TWO_NUMBERS = re.compile(r"[-+]?\d[\d.]{0,40}\s+[-+]?\d[\d.]{0,40}")
#: What programs write where a value is missing.
_SENTINELS = (-9999.0, -99999.0, -999.0, -32768.0, -999999.0, 1e20, 9.96920996838687e36, 1e30)


def choose_coordinates(lines: Lines, dialect: Dialect, settings: Settings) -> list[int]:
    """Return the positions of x, y and, if there is one, z."""
    names, source = dialect.names, lines.source
    if settings.columns is None and len(names) == 2 and find_pair(names) is None:
        source.warn(
            f"takes {quote_all(names)} for x and y: if they are not, choose columns (--columns X,Y)"
        )
        return [0, 1]
    positions = find_coordinates(names, settings.columns, source.name)
    if settings.columns is None and is_section(names, positions):
        source.warn(
            f"takes {quote_all([names[k] for k in positions])} for x and y: "
            "if they are not, choose columns (--columns X,Y)"
        )
    return positions


def as_points(
    table: Table, positions: Sequence[int], settings: Settings, *, whole: bool = True
) -> Points:
    """Return the rows as points, with the other columns beside them; of a piece, if not `whole`."""
    if whole and not len(table):
        table.lines.source.warn("it has no rows: it names columns, and no points follow")
    table = _less_count(table, settings) if whole else table
    values, bad = _numbers(table, positions, settings.on_bad_row == "skip")
    values, gone = _less_missing(table, values, positions, settings)
    kept = ~(bad | gone)
    _say_what_was_left_out(table, bad, gone & ~bad)
    table, values = table.less(kept), values[kept]
    if settings.columns is None and not table.dialect.header:
        _refuse_numbering(table)
        _refuse_several_points_a_line(table)
        _refuse_commas_both_ways(table, settings)
        _say_what_was_taken(table, positions)
    if settings.columns is None and len(positions) == 3:
        _warn_of_section(table, values, positions)
    return _points(table, values, positions)


def _points(table: Table, values: FloatArray, positions: Sequence[int]) -> Points:
    names = table.names
    others = {names[k]: typed(table, k) for k in table.columns if k not in positions}
    unnamed = {f"column{k}" for k in table.columns}
    columns = {
        name: column
        for name, column in others.items()
        # What follows a separator at the end of each line is no column.
        if name not in unnamed or column.dtype != np.object_ or any(column.tolist())
    }
    return Points(
        values[:, :2],
        z=values[:, 2] if len(positions) == 3 else None,
        columns=columns,
        names=(names[positions[0]], names[positions[1]]),
    )


# Numbers, and rows that have none


def _numbers(table: Table, positions: Sequence[int], skip: bool) -> tuple[FloatArray, BoolArray]:
    """Return the coordinates, NaN where they are missing, and which rows are bad."""
    values = np.empty((len(table), len(positions)))
    bad = np.zeros(len(table), bool)
    for place, k in enumerate(positions):
        cells = table.columns[k]
        if isinstance(cells, np.ndarray):
            values[:, place] = cells
        elif skip:
            values[:, place], wrong = _each(cells, table.mark)
            bad |= wrong
        else:
            values[:, place], row = parse_all(cells, table.mark)
            if row is not None:
                advice = "correct or remove the row, or leave such rows out (--on-bad-row skip)"
                raise table.error(row, k, f"{cells[row][:60]!r} is not a number: {advice}")
    bad |= _without_value(table, values, positions, skip)
    return values, bad


def _each(cells: Sequence[str], mark: Mark) -> tuple[FloatArray, BoolArray]:
    """Return the numbers of all cells, and which of them are none."""
    numbers, row = parse_all(cells, mark)
    wrong = np.zeros(len(cells), bool)
    while row is not None:
        wrong[row] = True
        rest, further = parse_all(cells[row + 1 :], mark)
        numbers[row + 1 :] = rest
        row = None if further is None else row + 1 + further
    return numbers, wrong


def _without_value(
    table: Table, values: FloatArray, positions: Sequence[int], skip: bool
) -> BoolArray:
    """Return which rows are bad for want of a finite value; a row of NaN alone is a break."""
    finite = np.isfinite(values)
    bad = np.asarray(~finite.all(axis=1) & ~np.isnan(values).all(axis=1))
    if bad.any() and not skip:
        row = int(np.argmax(bad))
        place = int(np.argmin(finite[row]))
        k = positions[place]
        cell = str(table.columns[k][row])[:60]
        fault = f"{cell!r} is not finite" if cell.strip() else "the value is missing"
        raise table.error(
            row,
            k,
            f"{fault}: correct or remove the row, or leave such rows out (--on-bad-row skip)",
        )
    return bad


def _less_missing(
    table: Table, values: FloatArray, positions: Sequence[int], settings: Settings
) -> tuple[FloatArray, BoolArray]:
    """Return the values, and which rows hold none, as NaN or as what stands for it."""
    gone = np.asarray(np.isnan(values).all(axis=1))
    if settings.missing is None:
        _refuse_sentinels(table, values, positions)
    elif settings.missing:
        gone |= np.isin(values, settings.missing).any(axis=1)
    return values, gone


def _refuse_sentinels(table: Table, values: FloatArray, positions: Sequence[int]) -> None:
    """Refuse x and y that often stand for a missing value, and are far from all others."""
    for place, k in enumerate(positions[:2]):
        column = values[:, place]
        odd = np.isin(column, _SENTINELS)
        rest = column[~odd & np.isfinite(column)]
        if not odd.any() or len(rest) < 2:
            continue
        row = int(np.argmax(odd))
        if min(abs(rest.min() - column[row]), abs(rest.max() - column[row])) > np.ptp(rest):
            number = f"{column[row]:g}"
            raise table.error(
                row,
                k,
                f"{number} often means that there is no value: leave such rows out "
                f"(--missing {number}), or take them as they are (--missing none)",
            )


def holds_sentinels(xy: FloatArray) -> bool:
    """Return whether some coordinate often stands for a missing value."""
    return bool(np.isin(xy, _SENTINELS).any())


def _say_what_was_left_out(table: Table, bad: BoolArray, gone: BoolArray) -> None:
    source = table.lines.source
    count = int(bad.sum()) + len(table.bad)
    if count:
        lines = [table.lines.number(position) for position in table.bad[:1]]
        lines += [table.line(int(np.argmax(bad)))] if bad.any() else []
        source.warn(f"left out {_rows(count)} without a point, from line {min(lines)} on")
    if gone.any():
        count = int(gone.sum())
        source.note("rows without a value", f"{count:,}")
        source.warn(
            f"left out {_rows(count)} without a value, from line "
            f"{table.line(int(np.argmax(gone)))} on: breaks between curves are not kept"
        )


def _rows(count: int) -> str:
    return f"{count:,} row{'s' * (count != 1)}"


# Doubts


def _less_count(table: Table, settings: Settings) -> Table:
    """Return the table without a first row that says how many follow; refuse what may be one."""
    rows = len(table)
    _check_counts(table, rows)
    if settings.skip_lines is not None or settings.header is False or rows < 3:
        return table
    if table.dialect.header or not is_count(table, rows - 1):
        return table
    if not table.dialect.titled:
        raise table.error(
            0,
            None,
            f"this may be the number of the {rows - 1} points that follow, or a point: "
            f"leave it out (--skip-lines {table.line(0)}), or say that it is one "
            f"(--skip-lines {table.line(0) - 1})",
        )
    table.lines.source.note("count", f"{rows - 1:,} rows, as the text says")
    kept = np.ones(rows, bool)
    kept[0] = False
    return table.less(kept)


def is_count(table: Table, rows: int) -> bool:
    """Return whether the first row is whole numbers, the first or the sum of which is `rows`."""
    if not len(table):
        return False
    try:
        first = [float(table.columns[k][0]) for k in table.columns]
    except ValueError:
        return False
    whole = all(number >= 0 and number.is_integer() for number in first)
    return whole and (first[0] == rows or sum(first) == rows)


def _check_counts(table: Table, rows: int) -> None:
    """Refuse lines above the rows that look like their number, but are not."""
    if not table.dialect.counts:
        return
    position, cells = table.dialect.counts[-1]
    numbers = [float(cell) for cell in cells]
    if rows not in (numbers[0], sum(numbers)):
        raise table.lines.source.error(
            f"{' '.join(cells)[:60]!r} is no point, and not the number of the {rows} rows below: "
            f"leave lines out (--skip-lines {position + 1})",
            f"line {position + 1}",
        )
    table.lines.source.note("count", f"{rows:,} rows, as the text says")


def _refuse_numbering(table: Table) -> None:
    """Refuse three columns and more of which the first counts the rows: it is hardly x."""
    rows = len(table)
    if rows < 3 or len(table.columns) < 3:
        return
    first = table.columns[0]
    numbers = first if isinstance(first, np.ndarray) else parse_all(first, table.mark)[0]
    if _is_numbering(np.asarray(numbers, dtype=np.float64), len(table.columns)):
        raise FormatError(
            f"{table.lines.source.name}: the first column numbers the rows and is hardly x: "
            "choose columns (--columns 1,2, or --columns 0,1 if it is)"
        )


def _is_numbering(numbers: FloatArray, width: int) -> bool:
    """Return whether numbers go up by ones, from 0 or 1, or from anywhere beside three others."""
    by_ones = np.array_equal(numbers, np.arange(len(numbers)) + numbers[0])
    from_one = numbers[0] in (0, 1)
    return by_ones and (from_one or (width > 3 and float(numbers[0]).is_integer()))


def _say_what_was_taken(table: Table, positions: Sequence[int]) -> None:
    """Warn of what was taken for coordinates of four columns and more without names."""
    if len(table) and len(table.columns) > 3:
        taken = "x, y and z" if len(positions) == 3 else "x and y"
        table.lines.source.warn(
            f"takes the first of {len(table.columns)} columns without names for {taken}: if they "
            f"are not, choose columns (--columns {','.join(map(str, positions))} if they are)"
        )


def _refuse_several_points_a_line(table: Table) -> None:
    """Refuse x,y x,y x,y in a line, of which the first pair would be taken, or an odd mixture."""
    if not len(table):
        return
    first = [str(cells[0]) for cells in table.columns.values()]
    parted = any(_TWO_NUMBERS.fullmatch(cell.strip()) for cell in first)
    if parted or (len(table) == 1 and len(first) > 3):
        raise table.error(
            0, None, "this may be several points in a line: give each a line of its own, or choose "
            "columns (--columns 0,1) if it is one",
        )  # fmt: skip


def _refuse_commas_both_ways(table: Table, settings: Settings) -> None:
    """Refuse 600,000,200,000: every other cell is digits alone, as many of them, some from 0 on."""
    width = len(table.columns)
    if table.dialect.separator != "," or settings.separator or width % 2 or width < 4:
        return
    texts = [
        cells.split(",")
        for _, cells in zip(range(100), table.lines.all[table.dialect.first :], strict=False)
    ]
    parts = [cells[k].strip() for cells in texts if len(cells) == width for k in range(1, width, 2)]
    alike = len({len(part) for part in parts}) == 1 and len(parts[0]) > 1
    if alike and all(part.isdecimal() for part in parts) and any(part[0] == "0" for part in parts):
        raise FormatError(
            f"{table.lines.source.name}: commas are between columns, and seem to mark decimals: "
            "save the file with semicolons between columns, or give --separator comma if not"
        )


def _warn_of_section(table: Table, values: FloatArray, positions: Sequence[int]) -> None:
    """Warn of points of which all have one x, or one y, while their heights vary."""
    if len(values) < 3 or np.ptp(values[:, 2]) == 0:
        return
    for place in (0, 1):
        if np.ptp(values[:, place]) == 0:
            name, other, height = (table.names[positions[k]] for k in (place, 1 - place, 2))
            table.lines.source.warn(
                f"every {name} is {values[0, place]:g}: "
                f"if this is a section, choose its columns (--columns {other},{height})"
            )
