"""The dialect of columns of text: separator, names, and where the rows begin."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import islice

from crustline.errors import FormatError
from crustline.formats.names import find_pair, refuse_repeated
from crustline.formats.text.lines import FIXED, Lines, Row, split
from crustline.formats.text.numbers import MISSING, looks_numeric
from crustline.formats.text.settings import Settings

__all__ = ["Dialect", "find_dialect"]

_SEPARATORS = "\t;|, "
_SAMPLE = 100  # rows, and as many characters of each as make a million
_GEOMETRIES = ("wkt", "geometry", "geom", "the_geom")
_UNITS = {
    "m", "mm", "cm", "km", "ft", "feet", "in", "inch", "mi", "yd", "nm", "um", "µm", "px", "pixel",
    "°", "deg", "degree", "degrees", "rad", "dd", "meter", "meters", "metre", "metres", "usft", "s",
    "sec", "-", "text", "string", "float", "double", "int", "integer",
}  # fmt: skip


@dataclass(frozen=True)
class Dialect:
    """How rows are to be read.

    Attributes
    ----------
    separator : str
        " " is any run of blanks.
    names : tuple of str
        What the columns are called; column0, … where there is no header but x, y and z.
    header : bool
        Whether these names are from the text.
    first : int
        The position of the line where the rows begin.
    counts : tuple of Row
        Lines before them that say how many rows there are.
    titled : bool
        Whether a title stands before the rows, as it does in formats that go on with counts.
    """

    separator: str
    names: tuple[str, ...]
    header: bool
    first: int
    counts: tuple[Row, ...] = ()
    titled: bool = False


@dataclass(frozen=True)
class _Top:
    """What stands before the rows: where these begin, the names if there are, titles, counts."""

    first: int
    names: list[str] | None
    titles: tuple[Row, ...] = ()
    counts: tuple[Row, ...] = ()


def find_dialect(lines: Lines, settings: Settings) -> tuple[Lines, Dialect]:
    """Return the dialect of lines, and the lines less what it says holds no data."""
    lines, stated = _stated_separator(lines)
    separator = settings.separator or stated or ""
    if settings.fields is not None:
        lines, separator = lines.cut(settings.fields), FIXED
    separator = separator or _separator(lines)
    if separator == ";":  # such a line starts with an empty cell
        lines = replace(lines, comments=tuple(each for each in lines.comments if each != ";"))
    rows = _sample(lines, separator)
    if not rows:
        raise FormatError(
            f"{lines.source.name} has comments and headings only: give at least one point"
        )
    top = _top(lines, rows, separator, settings)
    below = [row for row in rows if row[0] >= top.first]
    points = [row for row in below if _numbers(row[1]) >= 2]
    width = _width(points) or _width(below) or len(top.names or ())
    names = top.names or _default_names(rows, width)
    _check_names(lines, names, rows[0], separator)
    _note(lines, separator, top)
    dialect = Dialect(
        separator, tuple(names), bool(top.names), top.first, top.counts, bool(top.titles)
    )
    return lines, dialect


def _default_names(rows: list[Row], width: int) -> list[str]:
    """Return x, y, z if the third column is numbers, and what stands for the names of others."""
    third = [cells[2] for _, cells in rows if len(cells) == width > 2]
    z = "z" if any(map(looks_numeric, third)) else "column2"
    return ["x", "y", z, *(f"column{k}" for k in range(3, width))][:width]


# The separator


def _stated_separator(lines: Lines) -> tuple[Lines, str | None]:
    """Return what a first line such as "sep=;" says, and the lines without it."""
    position, line = next(lines.data(lines.first), (0, ""))
    match = re.fullmatch(r"\s*sep=(.)\s*", line, re.IGNORECASE)
    return (replace(lines, first=position + 1), match[1]) if match else (lines, None)


def _separator(lines: Lines) -> str:
    """Return the separator by which most rows have two numbers.

    Tabs, semicolons and bars hardly stand in numbers; commas and blanks do, so that of these the
    one is taken that leaves fewer other cells.
    """
    scores = {each: _score_of(lines, each) for each in _SEPARATORS}
    most = max(count for count, _ in scores.values())
    if most == 0:
        first = next((line for _, line in lines.data(lines.first)), "")
        there = [each for each in _SEPARATORS if each in first]
        named = [each for each in there if find_pair(split(first, each)) is not None]
        return next(iter((*named, *there)), " ")
    able = [each for each, (count, _) in scores.items() if count == most]
    return able[0] if able[0] not in ", " else max(able, key=lambda each: scores[each][1])


def _score_of(lines: Lines, separator: str) -> tuple[int, float]:
    """Return the score of a separator; none if quotes are not where it would have them."""
    try:
        return _score(_sample(lines, separator))
    except FormatError:
        return 0, 0.0


def _score(rows: list[Row]) -> tuple[int, float]:
    """Return how many rows have two numbers and the usual width, and the share of numbers there."""
    able = [(cells, count) for _, cells in rows if (count := _numbers(cells)) >= 2]
    width = Counter(len(cells) for cells, _ in able).most_common(1)[0][0] if able else 0
    alike = [(min(width, _SAMPLE), count) for cells, count in able if len(cells) == width]
    share = sum(count for _, count in alike) / max(1, sum(size for size, _ in alike))
    return len(alike), share


def _sample(lines: Lines, separator: str) -> list[Row]:
    """Return the first rows: two at the least, and no more than a million characters allow."""
    rows: list[Row] = []
    size = 0
    for row in islice(lines.rows(separator, lines.first), _SAMPLE):
        rows.append(row)
        size += len(lines.all[row[0]])
        if size > 1_000_000 and len(rows) > 1:
            break
    return rows


def _numbers(cells: Sequence[str]) -> int:
    return sum(map(looks_numeric, cells[:_SAMPLE]))


def _width(rows: list[Row]) -> int:
    """Return how many cells most rows have."""
    return Counter(len(cells) for _, cells in rows).most_common(1)[0][0] if rows else 0


# What stands before the rows


def _top(lines: Lines, rows: list[Row], separator: str, settings: Settings) -> _Top:
    rows = [row for row in rows if not all(map(is_missing, row[1]))] or rows
    if settings.header is False:
        return _Top(rows[0][0], None)
    for k, (_, cells) in enumerate(rows):
        if _names_coordinates(cells, rows[k + 1 :], settings, separator):
            return _below(lines, rows, k, [*rows[:k]], separator)
        if _is_point(cells, rows[k + 1 :]):
            return _above(lines, rows, k, separator)
    return _below(lines, rows, 0, [], separator)


def _names_coordinates(
    cells: list[str], below: list[Row], settings: Settings, separator: str
) -> bool:
    """Return whether a row names x and y, geometries, or what the caller has chosen."""
    if len(cells) < 2 and plain_geometry(cells) is None:
        return False
    width = _width(below)
    if below and separator == " " and len(cells) not in (width, width - 1):
        return False  # words of a title
    chosen = [each for each in settings.columns or () if isinstance(each, str)]
    named = all(each in cells for each in chosen) and not all(map(looks_numeric, chosen))
    return (
        find_pair(cells) is not None
        or plain_geometry(cells) is not None
        or (bool(chosen) and named)
    )


def plain_geometry(names: Sequence[str]) -> int | None:
    """Return the position of the first column that is called as one of geometries."""
    lower = [name.strip().lower() for name in names]
    return next((lower.index(name) for name in _GEOMETRIES if name in lower), None)


def _is_point(cells: list[str], below: list[Row]) -> bool:
    """Return whether a row has two numbers, and as many cells as most rows below."""
    return _numbers(cells) >= 2 and not (
        len(below) > 1 and len(cells) != _width(below) and _as_count(cells) is not None
    )


def _below(lines: Lines, rows: list[Row], k: int, above: list[Row], separator: str) -> _Top:
    """Return what is known where row k is the header."""
    rest = rows[k + 1 :]
    names = _names(lines, rows[k], rest)
    if rest and _is_units(rest[0][1]):
        lines.source.note("units", " ".join(rest[0][1]))
        rest = rest[1:]
    if rest and len(names) == _width(rest) - 1 and rest[0][1][-1].strip():
        names = ["row", *names]  # as R writes them
    first = rest[0][0] if rest else len(lines.all)
    titles, counts = _explained(lines, above, separator)
    return _Top(first, names, titles, counts)


def _above(lines: Lines, rows: list[Row], k: int, separator: str) -> _Top:
    """Return what is known where row k is the first point, and no row names x and y."""
    position, cells = rows[k]
    names = _commented_names(lines, position, len(cells), separator)
    before = rows[:k]
    if (
        names is None
        and before
        and len(before[-1][1]) == len(cells)
        and not _numbers(before[-1][1])
    ):
        names = _names(lines, before[-1], rows[k:])
        before = before[:-1]
    titles, counts = _explained(lines, before, separator)
    return _Top(position, names, titles, counts)


def _explained(
    lines: Lines, before: list[Row], separator: str
) -> tuple[tuple[Row, ...], tuple[Row, ...]]:
    """Return titles and counts; refuse a line that is neither."""
    titles, counts = [], []
    for position, cells in before:
        text = " ".join(cells)
        if _as_count(cells) is not None:
            counts.append((position, cells))
        elif text[:1].isalpha() and (separator == " " or not _numbers(cells)):
            titles.append((position, cells))
        else:
            raise lines.source.error(
                f"{text[:60]!r} is neither names of columns nor a point: correct it, "
                f"or leave lines out with skip_lines (--skip-lines {position + 1})",
                f"line {position + 1}",
            )
    if any(_numbers(cells) for _, cells in titles):
        lines.source.warn(
            f"{' '.join(titles[-1][1])[:60]!r} is taken for a title: "
            f"if it is not, say how many lines to leave out (--skip-lines {titles[-1][0]})"
        )
    return tuple(titles), tuple(counts)


def _as_count(cells: Sequence[str]) -> list[int] | None:
    """Return whole numbers, which may say how many rows there are."""
    try:
        numbers = [float(cell) for cell in cells[:4]]
    except ValueError:
        return None
    whole = all(number >= 0 and number.is_integer() for number in numbers) and len(cells) <= 4
    return [int(number) for number in numbers] if whole and cells else None


def _is_units(cells: Sequence[str]) -> bool:
    """Return whether every cell is a unit, or something in brackets."""
    return all(
        cell.strip().lower() in _UNITS or re.fullmatch(r"\s*(\[.*\]|\(.*\))\s*", cell)
        for cell in cells
    ) and any(cell.strip() for cell in cells)


def _commented_names(lines: Lines, first: int, width: int, separator: str) -> list[str] | None:
    """Return the names of the last comment before the rows, if it names x and y; Tecplot's, too."""
    for line in reversed(lines.all[max(lines.first, first - _SAMPLE) : first]):
        variables = re.match(r"\s*VARIABLES\s*=(.*)", line, re.IGNORECASE)
        if variables:
            return re.findall(r'"([^"]*)"', variables[1]) or split(variables[1], ",")
        if line.strip() and not lines.is_data(line):
            names = [name.strip() for name in split(line.lstrip(" \t#%!*/;"), separator)]
            if find_pair(names) is not None and len(names) == width:
                return names
    return None


def _names(lines: Lines, header: Row, below: list[Row]) -> list[str]:
    """Return the names of a header: as they are in quotes, else less the blanks around them."""
    position, cells = header
    end = below[0][0] if below else len(lines.all)
    quoted = set(re.findall(r'"((?:[^"]|"")*)"', "\n".join(lines.all[position:end])))
    return [
        name if name and name.replace('"', '""') in quoted else name.strip() or f"column{k}"
        for k, name in enumerate(cells)
    ]


def _check_names(lines: Lines, names: Sequence[str], first: Row, separator: str) -> None:
    if len(names) < 2 and plain_geometry(names) is None:
        text = lines.all[first[0]].strip()[:60]
        raise lines.source.error(
            f"{text!r} is one column, but points need two: "
            "separate x and y by a comma, a tab, a semicolon or spaces",
            f"line {first[0] + 1}",
        )
    refuse_repeated(names, lines.source.name)


def _note(lines: Lines, separator: str, top: _Top) -> None:
    words = {
        ",": "comma", ";": "semicolon", "\t": "tab", "|": "bar", " ": "blanks",
        FIXED: "none: fields of fixed width",
    }  # fmt: skip
    lines.source.note("separator", words[separator])
    lines.source.note("header", "names of columns" if top.names else "none")
    if top.titles:
        lines.source.note("title", " ".join(top.titles[0][1])[:60])


def is_missing(cell: str) -> bool:
    """Return whether a cell says that there is no value."""
    return cell.strip().lower() in MISSING
