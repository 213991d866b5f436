"""What a LAS or LAZ file says of itself, held against its size before a library believes it."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from crustline.formats.laz_chunks import VARIABLE, Packing, check_chunks
from crustline.formats.source import Source

__all__ = ["LasHead", "check"]

#: Bytes of the fixed part by minor version, and of a point record by its format.
_SIZES = {0: 227, 1: 227, 2: 227, 3: 235, 4: 375}
_RECORDS = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
_VLR, _EVLR = 54, 60
_LASZIP, _COPC = b"laszip encoded", b"copc"
#: A point that says nothing new takes next to no room: what one byte may unpack to, at the most.
_DENSEST = 5000


@dataclass(frozen=True)
class LasHead:
    """The facts that reading rests on.

    Attributes
    ----------
    points : int
        How many points the file says it has.
    starts : int
        The byte at which they start.
    packed : bool
        Whether they are LAZ.
    records : list of (bytes, int, int, int)
        The user, number, place and size of each variable-length record.
    """

    points: int
    starts: int
    packed: bool
    records: list[tuple[bytes, int, int, int]]

    def record(self, user: bytes, number: int) -> tuple[int, int] | None:
        """Return the place and size of a record; None if there is none."""
        found = (each[2:] for each in self.records if each[:2] == (user, number))
        return next(found, None)


def check(file: BinaryIO, size: int, source: Source) -> LasHead:
    """Return the head of a file, or raise `FormatError` if it cannot be true."""
    head = file.read(375)
    minor = head[25] if len(head) > 25 else 0
    if not head.startswith(b"LASF") or len(head) < _SIZES.get(minor, 227):
        raise source.error("it ends within its header: copy it again")
    if head[24] != 1 or minor not in _SIZES:
        raise source.error(f"it is LAS {head[24]}.{minor}: save it as LAS 1.0 to 1.4")
    length, starts, count = struct.unpack_from("<HII", head, 94)
    if not _SIZES[minor] <= length <= starts <= size:
        raise source.error(
            f"the header says that points start at byte {starts:,}, after a header of {length:,}, "
            f"and the file has {size:,}: copy it again, or repair it"
        )
    points, packed = _points(head, minor, source), bool(head[104] & 0xC0)
    records = list(_records(file, length, starts, count, source))
    found = LasHead(points, starts, packed, records)
    if minor == 4:
        _check_extended(file, head, size, source)
    if packed:
        _check_packed(file, found, struct.unpack_from("<H", head, 105)[0], size, source)
    else:
        _check_room(head, found, size, source)
    file.seek(0)
    return found


def _points(head: bytes, minor: int, source: Source) -> int:
    kind, record = head[104] & 0x3F, struct.unpack_from("<H", head, 105)[0]
    if kind >= len(_RECORDS) or record < _RECORDS[kind]:
        raise source.error(f"the header says that points of format {kind} have {record} bytes each")
    scaling = np.frombuffer(head, "<f8", 6, 131)
    if not (np.isfinite(scaling).all() and scaling[:3].all() and (abs(scaling) < 1e60).all()):
        raise source.error(f"the header has the scales and offsets {scaling.tolist()}: repair it")
    legacy = int(struct.unpack_from("<I", head, 107)[0])
    return int(struct.unpack_from("<Q", head, 247)[0]) if minor == 4 else legacy


def _records(
    file: BinaryIO, length: int, starts: int, count: int, source: Source
) -> list[tuple[bytes, int, int, int]]:
    """Return the variable-length records between the header and the points."""
    found: list[tuple[bytes, int, int, int]] = []
    place = length
    for _ in range(count):
        file.seek(place)
        record = file.read(_VLR)
        size = struct.unpack_from("<H", record, 20)[0] if len(record) == _VLR else starts
        if place + _VLR + size > starts:
            raise source.error(
                f"the header tells of {count:,} records, of which {len(found):,} are in front of "
                "the points: repair it"
            )
        user, number = record[2:18].rstrip(b"\0"), struct.unpack_from("<H", record, 18)[0]
        found.append((user, number, place + _VLR, size))
        place += _VLR + size
    return found


def _check_extended(file: BinaryIO, head: bytes, size: int, source: Source) -> None:
    place, count = struct.unpack_from("<QI", head, 235)
    for number in range(count):
        file.seek(min(place, size))
        record = file.read(_EVLR)
        room = struct.unpack_from("<Q", record, 20)[0] if len(record) == _EVLR else size
        place += _EVLR + room
        if place > size:
            raise source.error(
                f"extended record {number} of {count:,} leads beyond the end: copy it again"
            )


def _check_room(head: bytes, found: LasHead, size: int, source: Source) -> None:
    room = (size - found.starts) // int(struct.unpack_from("<H", head, 105)[0])
    if found.points > room:
        raise source.error(
            f"the header says {found.points:,} points, and there is room for {room:,}: "
            "it was cut off, or its header is wrong"
        )


def _check_packed(file: BinaryIO, found: LasHead, record: int, size: int, source: Source) -> None:
    """Hold the LASzip record and the table of chunks against the file."""
    place = found.record(_LASZIP, 22204)
    if place is None or place[1] < 34:
        raise source.error("its points are packed, and no record says how: repair it")
    file.seek(place[0])
    data = file.read(place[1])
    packing = Packing.of(data)
    if struct.unpack_from("<H", data, 32)[0] != len(packing.items) or packing.size != record:
        raise source.error(f"its record of LASzip does not make up points of {record} bytes")
    if found.points:
        end = _table(file, found, packing.chunk, size, source)
        check_chunks(file, data, found.starts, end, source)


def _table(file: BinaryIO, found: LasHead, chunk: int, size: int, source: Source) -> int:
    """Return where the table of chunks is, or raise `FormatError` if its count cannot be true."""
    cut = "it was cut off, or was never closed: copy or write it again"
    file.seek(found.starts)
    table = _number(file.read(8), "<q")
    if table == -1:  # written to a stream, it has the place of its table at its end
        file.seek(size - 8)
        table = _number(file.read(8), "<q")
    if not found.starts + 8 <= table <= size - 8:
        raise source.error(f"its table of chunks is not in the file: {cut}")
    file.seek(table + 4)
    count = _number(file.read(4), "<I")
    least = count if chunk == VARIABLE else -(-found.points // max(chunk, 1))
    if count > size - table or count != least or chunk == 0:
        raise source.error(f"its table of {count:,} chunks does not fit the points: {cut}")
    if found.points > _DENSEST * (table - found.starts):
        raise source.error(
            f"the header says {found.points:,} points, which {table - found.starts:,} bytes are "
            "too few for: repair it"
        )
    return table


def _number(content: bytes, form: str) -> int:
    return int(struct.unpack(form, content)[0]) if len(content) == struct.calcsize(form) else -2
