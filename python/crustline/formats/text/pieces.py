"""Text larger than memory, piece by piece: the dialect of the first is that of all."""

from __future__ import annotations

import codecs
import warnings
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from crustline.errors import FormatError, FormatWarning
from crustline.formats.source import Source, likely_encoding
from crustline.formats.text.columns import Table, read_columns
from crustline.formats.text.coordinates import (
    as_points,
    choose_coordinates,
    holds_sentinels,
    is_count,
)
from crustline.formats.text.dialect import Dialect, find_dialect
from crustline.formats.text.geometries import find_geometries
from crustline.formats.text.lines import Lines, split_lines, unbounded_cells
from crustline.formats.text.settings import Settings
from crustline.points import Points, own_points

__all__ = ["LARGE", "pieces_of", "read_large"]

#: Files of more bytes are read in pieces of so many rows.
LARGE, _ROWS = 1 << 25, 1 << 18
_CHUNK = 1 << 18


def read_large(source: Source, settings: Settings) -> Points | None:
    """Return the points of a large file that holds nothing odd; None leaves it to a second look.

    What is odd shows in a look at the whole alone: a count, a number that stands for none, a column
    that is text farther below. Memory is that of the points, twice, and of one piece.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", FormatWarning)
            pieces = list(pieces_of(source, _ROWS, settings))
    except (FormatError, FormatWarning):
        return None
    kinds = [{name: values.dtype.kind for name, values in p.columns.items()} for p in pieces]
    if any(each != kinds[0] for each in kinds) or any(p.names != pieces[0].names for p in pieces):
        return None
    xy = np.concatenate([piece.xy for piece in pieces])
    if settings.missing is None and holds_sentinels(xy):
        return None
    heights = [piece.z for piece in pieces if piece.z is not None]
    points = own_points(
        xy,
        z=np.concatenate(heights) if heights else None,
        columns={name: np.concatenate([p.columns[name] for p in pieces]) for name in kinds[0]},
    )
    return points.replace(names=pieces[0].names)


def pieces_of(source: Source, rows: int, settings: Settings) -> Iterator[Points]:
    """Yield the points of about so many lines at a time."""
    total, first = 0, None
    dialect: Dialect | None = None
    with unbounded_cells():
        for offset, texts in _blocks(source, rows, settings.encoding):
            lines = Lines(source, texts, offset=offset)
            if settings.comment is not None:
                lines = lines.with_comments(settings.comment)
            if dialect is None:
                lines = replace(lines, first=settings.skip_lines or 0)
                lines, dialect = find_dialect(lines, settings)
                if find_geometries(dialect.names, settings) is not None:
                    raise source.error("geometries in a column are read at once only: use read")
                positions = choose_coordinates(lines, dialect, settings)
                table = read_columns(lines, dialect, positions, settings)
                settings = replace(settings, decimal=table.mark)
                first = table
            else:
                lines = lines.cut(settings.fields) if settings.fields else lines
                follows = replace(dialect, first=0, counts=(), titled=False)
                table = read_columns(lines, follows, positions, settings)
            total += len(table)
            yield as_points(table, positions, settings, whole=False)
        if dialect is None:
            source.content()  # which says that it is empty
    _refuse_count(first, dialect, total, settings)


def _refuse_count(
    first: Table | None, dialect: Dialect | None, total: int, settings: Settings
) -> None:
    """Refuse, at the end, a first row that may have said how many would follow."""
    if first is None or dialect is None or settings.skip_lines is not None:
        return
    if dialect.counts or (not dialect.header and is_count(first, total - 1)):
        raise first.lines.source.error(
            "a line at the top says how many rows follow, or may do so: leave lines out "
            "(--skip-lines 1), or read it at once"
        )


def _blocks(source: Source, rows: int, encoding: str | None) -> Iterator[tuple[int, list[str]]]:
    """Yield blocks of whole lines, none of which ends within quotes, and how many are before."""
    found = encoding or likely_encoding(source.head)
    source.note("encoding", found)
    decoder = codecs.getincrementaldecoder(found)()
    lines: list[str] = []
    before, quotes, rest = 0, 0, ""
    for chunk in _with_end(source.chunks(_CHUNK)):
        try:
            text = rest + decoder.decode(chunk or b"", final=chunk is None)
        except UnicodeDecodeError as error:
            raise source.error(f"it is not {error.encoding.upper()} text: say what it is") from None
        if "\0" in text:
            raise source.error("it holds null characters, and is no text: choose its format")
        end = len(text) if chunk is None else text.rfind("\n") + 1
        whole, rest = text[:end], text[end:]
        for line in split_lines(whole.removesuffix("\n")) if whole else ():
            lines.append(line)
            quotes += line.count('"')
            if len(lines) >= rows and quotes % 2 == 0:
                yield before, lines
                before, lines = before + len(lines), []
    if lines:
        yield before, lines


def _with_end(chunks: Iterator[bytes]) -> Iterator[Any]:
    yield from chunks
    yield None
