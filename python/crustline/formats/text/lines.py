"""Lines of text: which of them hold data, and how a separator cuts them into cells."""

from __future__ import annotations

import csv
import re
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from crustline.formats.source import Source

__all__ = ["FIXED", "Lines", "Row", "split", "split_lines", "unbounded_cells"]

#: A record: the position of its line, and its cells.
Row = tuple[int, list[str]]

#: What separates cells that were cut from lines at fixed characters: no text holds it.
FIXED = "\x1f"
_COMMENTS = ("#", "%", "!", "//", "*", ";")
_BREAKS = re.compile(r">|&|ZONE\b|[A-Z]+\s*=|END\s*$", re.IGNORECASE)
_STARRED_NUMBER = re.compile(r"\s*\*[*\s]*[+-]?[\d.]")  # a number too wide for its Fortran format
_INLINE = re.compile(r"(?:^|\s)#(?!(?:[0-9a-fA-F]{2}){3,4}(?:\s|$)).*")  # but a color is no comment
_PIECES = re.compile(r'"((?:[^"]|"")*)"|(\S+)')


@dataclass(frozen=True)
class Lines:
    """All lines of a text, and what tells that some of them hold no data.

    Attributes
    ----------
    source : Source
        Where they are from.
    all : list of str
        Every line, without its end.
    first : int
        The position of the first that counts.
    comments : tuple of str
        What starts a comment.
    dropped : frozenset of int
        Positions of lines that are known to hold no data.
    offset : int
        How many lines of the text are before the first of these.
    """

    source: Source
    all: list[str]
    first: int = 0
    comments: tuple[str, ...] = _COMMENTS
    dropped: frozenset[int] = field(default_factory=frozenset)
    offset: int = 0

    def number(self, position: int) -> int:
        """Return the number of a line in its text, from 1."""
        return position + self.offset + 1

    def cut(self, fields: Sequence[tuple[int, int]]) -> Lines:
        """Return the lines with what stands at some characters, from 1, as cells."""
        return replace(self, all=[_cut(line, fields) for line in self.all])

    def with_comments(self, mark: str) -> Lines:
        """Return the lines with another start of comments."""
        return replace(self, comments=(mark,))

    def is_data(self, line: str) -> bool:
        """Return whether a line is neither blank, nor a comment, nor a break between curves."""
        start = line.lstrip()
        if not start:
            return False
        if start.startswith(self.comments):
            return start[0] == "*" and _STARRED_NUMBER.match(start) is not None
        return _BREAKS.match(start) is None

    def data(self, first: int) -> Iterator[tuple[int, str]]:
        """Yield the lines with data from a position on; the inside of quotes is data."""
        quoted = False
        for position in range(first, len(self.all)):
            line = self.all[position]
            if quoted or (self.is_data(line) and position not in self.dropped):
                yield position, line
                quoted ^= line.count('"') % 2 == 1

    def rows(self, separator: str, first: int) -> Iterator[Row]:
        """Yield the rows from a position on, cut at a separator."""
        if separator == " ":
            for position, line in self.data(first):
                if cells := _split_spaces(line):
                    yield position, cells
            return
        positions: list[int] = []
        reader = csv.reader(
            self._noted(first, positions), delimiter=separator, skipinitialspace=True
        )
        start = 0
        try:
            for cells in reader:
                if len(cells) > 1 or (cells and cells[0].strip()):
                    yield positions[start], cells
                start = reader.line_num
        except csv.Error as error:
            place = f"line {self.number(positions[-1])}" if positions else ""
            raise self.source.error(f"{error}: correct the quotes", place) from None

    def _noted(self, first: int, positions: list[int]) -> Iterator[str]:
        for position, line in self.data(first):
            positions.append(position)
            yield line + "\n"


def _cut(line: str, fields: Sequence[tuple[int, int]]) -> str:
    cells = [line[first - 1 : last].strip() for first, last in fields]
    if not line.strip():
        return ""
    if '"' in line:
        cells = ['"' + cell.replace('"', '""') + '"' for cell in cells]
    return FIXED.join(cells)


def split_lines(text: str) -> list[str]:
    """Return lines; the ends of Windows and of old Macs count, but for those within quotes."""
    if "\r" in text and ('"' not in text or "\n" not in text):
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text.split("\n")


def split(line: str, separator: str) -> list[str]:
    """Return the cells of one line."""
    if separator == " ":
        return _split_spaces(line)
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error:  # an end of line within it: no quotes are worth a thought
        return line.split(separator)


def _split_spaces(line: str) -> list[str]:
    if "#" in line:
        line = _INLINE.sub("", line)
    if '"' not in line:
        return line.split()
    return [quoted.replace('""', '"') or plain for quoted, plain in _PIECES.findall(line)]


@contextmanager
def unbounded_cells() -> Iterator[None]:
    """Let cells be longer than the 131,072 characters that the csv module allows."""
    limit = csv.field_size_limit(sys.maxsize)
    try:
        yield
    finally:
        csv.field_size_limit(limit)
