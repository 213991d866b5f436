"""The chunks of a LAZ file, held against the file: lazrs makes room for whatever sizes they claim.

A chunk of a format from 6 on starts with a point as it is, the number of points, and the sizes of
the layers that follow, one for each part of a point that is packed apart.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from dataclasses import dataclass
from typing import BinaryIO

from crustline.formats.source import Source

__all__ = ["VARIABLE", "Packing", "check_chunks", "check_layers"]

_LAYERED = 3
#: A chunk may hold as many points as it likes: then the table says how many.
VARIABLE = 0xFFFFFFFF
#: Bytes that a chunk may unpack to.
_LARGEST = 1 << 28
#: Layers of the parts of a point, by LASzip's numbers of them; extra bytes have one each.
_LAYERS = {10: 9, 11: 1, 12: 2, 13: 1}
_EXTRA_BYTES = 14


@dataclass(frozen=True)
class Packing:
    """What the record of LASzip says: whether chunks are layered, their size, parts of points."""

    kind: int
    chunk: int
    items: list[tuple[int, int]]

    @classmethod
    def of(cls, record: bytes) -> Packing:
        """Return what a record of at least 34 bytes says."""
        kind, chunk = struct.unpack_from("<H", record)[0], struct.unpack_from("<I", record, 12)[0]
        count = min(struct.unpack_from("<H", record, 32)[0], (len(record) - 34) // 6)
        items = [struct.unpack_from("<HH", record, 34 + 6 * k) for k in range(count)]
        return cls(int(kind), int(chunk), [(int(part), int(size)) for part, size in items])

    @property
    def size(self) -> int:
        """The bytes of a point."""
        return sum(size for _, size in self.items)

    @property
    def layers(self) -> int:
        """The number of layers of a chunk."""
        return sum(
            size if part == _EXTRA_BYTES else _LAYERS.get(part, 0) for part, size in self.items
        )


def check_chunks(file: BinaryIO, record: bytes, starts: int, end: int, source: Source) -> None:
    """Raise `FormatError` unless the table of chunks tells of what is between two places."""
    import lazrs

    packing = Packing.of(record)
    _check_sizes([] if packing.chunk == VARIABLE else [packing.chunk], packing, source)
    file.seek(starts)
    table = lazrs.read_chunk_table(file, lazrs.LazVlr(record))
    total = sum(size for _, size in table)
    if total > end - starts - 8 or any(size < 0 for _, size in table):
        raise source.error(
            f"its table of chunks tells of {total:,} bytes, and {end - starts - 8:,} are there: "
            "it was cut off, or its table is wrong"
        )
    if packing.chunk == VARIABLE:
        _check_sizes((count for count, _ in table), packing, source)
    places, place = [], starts + 8
    for count, size in table:
        if count:
            places.append((place, size))
        place += size
    check_layers(file, packing, places, source)


def _check_sizes(counts: Iterable[int], packing: Packing, source: Source) -> None:
    """Refuse chunks of more points than there may be room for: lazrs unpacks a chunk at once."""
    largest = max(counts, default=0)
    if largest * packing.size > _LARGEST:
        raise source.error(
            f"its chunks have {largest:,} points, more than {_LARGEST >> 20} MB: write it again "
            "with chunks of 50,000"
        )


def check_layers(
    file: BinaryIO, packing: Packing, chunks: Iterable[tuple[int, int]], source: Source
) -> None:
    """Raise `FormatError` unless the layers of chunks, each a place and a size, fit into them."""
    if packing.kind != _LAYERED:
        return
    form = struct.Struct(f"<{packing.layers}I")
    for place, size in chunks:
        file.seek(place + packing.size + 4)
        head = file.read(form.size)
        room = size - packing.size - 4 - form.size
        if room < 0 or len(head) < form.size or sum(form.unpack(head)) > room:
            raise source.error(
                f"the chunk at byte {place:,} tells of layers that it has no room for: "
                "copy it again"
            )
