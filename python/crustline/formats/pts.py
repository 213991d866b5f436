"""PTS: blocks of points, each after a line with their number: x y z, intensity, red green blue."""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from crustline.arrays import FloatArray
from crustline.formats.cloud import CHUNK, Chunk
from crustline.formats.format import Format
from crustline.formats.source import Source
from crustline.points import Points, own_points

__all__ = ["PTS"]

_NAMES = {3: (), 4: ("intensity",), 6: ("red", "green", "blue"),
          7: ("intensity", "red", "green", "blue")}  # fmt: skip
_LONGEST_LINE = 1 << 16


def cloud(source: Source, box: FloatArray) -> Iterator[Chunk]:
    """Yield the points in space."""
    for table in _tables(source, CHUNK):
        yield Chunk((table[:, 0], table[:, 1], table[:, 2]))


def stream(source: Source, rows: int) -> Iterator[Points]:
    """Yield the points, seen from above, with heights and what is beside them."""
    for table in _tables(source, rows):
        yield _points(table, source)


def read(source: Source) -> Points:
    """Return the points, seen from above, with heights and what is beside them."""
    tables = list(_tables(source, CHUNK))
    width = min(each.shape[1] for each in tables)
    if any(each.shape[1] > width for each in tables):
        source.warn("its blocks have different columns: those that not all have are left out")
    return _points(np.concatenate([each[:, :width] for each in tables]), source)


def _points(table: FloatArray, source: Source) -> Points:
    names = _NAMES.get(table.shape[1], ())
    columns = {name: table[:, 3 + k].copy() for k, name in enumerate(names)}
    with source.named():
        return own_points(table[:, :2].copy(), z=table[:, 2].copy(), columns=columns)


def _tables(source: Source, rows: int) -> Iterator[FloatArray]:
    """Yield the rows of numbers of all blocks; as many as their first lines say."""
    blocks = 0
    with source.open() as file:
        line = 0
        while (head := _next_line(file)) is not None:
            line += head[1]
            words = head[0].split()
            if len(words) != 1 or not words[0].isdigit() or len(words[0]) > 18:
                raise source.error(
                    f"{head[0][:60]!r} is no number of points: a block of PTS starts with it",
                    f"line {line}",
                )
            blocks += 1
            yield from _block(file, int(words[0]), rows, line, source)
            line += int(words[0])
    if not blocks:
        raise source.error("it is empty: give a file with at least one point")


def _next_line(file: BinaryIO) -> tuple[bytes, int] | None:
    """Return the next line that is not blank, and how many lines further that is."""
    count = 0
    while line := file.readline(_LONGEST_LINE):
        count += 1
        if line.strip():
            return line, count
    return None


def _block(
    file: BinaryIO, count: int, rows: int, line: int, source: Source
) -> Iterator[FloatArray]:
    width = None
    done = 0
    while done < count:
        size = min(rows, count - done)
        lines = [each for _ in range(size) if (each := file.readline(_LONGEST_LINE)).strip()]
        if len(lines) < size:
            raise source.error(
                f"the block at line {line} says {count:,} points, and {done + len(lines):,} are "
                "there: it was cut off"
            )
        width = width or len(lines[0].split())
        if width not in _NAMES:
            raise source.error(f"{width} columns are none of PTS: it has 3, 4, 6 or 7",
                               f"line {line + 1}")  # fmt: skip
        yield _numbers(lines, width, line + done, source)
        done += size
    if not count:
        yield np.empty((0, 3))


def _numbers(lines: list[bytes], width: int, before: int, source: Source) -> FloatArray:
    words = b"".join(lines).split()
    try:
        if len(words) == width * len(lines):
            table = np.array(words, np.float64).reshape(len(lines), width)
            if np.isfinite(table).all():
                return table
    except ValueError:
        pass
    for number, each in enumerate(lines, before + 1):
        if not _is_row(each, width):
            raise source.error(f"{each[:60]!r} are not {width} numbers", f"line {number}")
    raise source.error("its rows are not numbers")


def _is_row(line: bytes, width: int) -> bool:
    try:
        values = np.array(line.split(), np.float64)
    except ValueError:
        return False
    return len(values) == width and bool(np.isfinite(values).all())


PTS = Format(
    name="pts",
    title="PTS",
    suffixes=(".pts",),
    read=read,
    stream=stream,
    cloud=cloud,
)
