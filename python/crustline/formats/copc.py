"""COPC: the octree in a LAZ file, of which only the nodes that meet a box are unpacked.

laspy's own query gives all points of a box at once and believes what pages say of each other; here
pages are held against the file first, and nodes come in pieces.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.formats.cloud import CHUNK
from crustline.formats.las_header import LasHead
from crustline.formats.laz_chunks import Packing, check_layers
from crustline.formats.source import Source

__all__ = ["is_copc", "records_of_nodes"]

_ENTRY = np.dtype([("key", "<i4", 4), ("offset", "<u8"), ("bytes", "<i4"), ("points", "<i4")])
_DEEPEST = 30


def is_copc(head: LasHead) -> bool:
    """Return whether a LAZ file says that it has an octree."""
    return head.packed and head.points > 0 and head.record(b"copc", 1) is not None


def records_of_nodes(
    source: Source, header: Any, head: LasHead, box: FloatArray, selection: Any
) -> Iterator[Any]:
    """Yield laspy's records of the points of the nodes that meet a box."""
    with source.path(".laz") as path, open(path, "rb") as file:
        nodes = _nodes(file, path.stat().st_size, head, source)
        places = zip(nodes["offset"].tolist(), nodes["bytes"].tolist(), strict=True)
        check_layers(file, Packing.of(_packing(file, head)), places, source)
        chosen = nodes[_meets(nodes["key"], _cube(file, head, source), box)]
        for group in _groups(chosen):
            yield _unpacked(file, header, head, group, selection)


def _cube(file: BinaryIO, head: LasHead, source: Source) -> FloatArray:
    """Return the center and half the side of the root."""
    place = head.record(b"copc", 1)
    assert place is not None
    file.seek(place[0])
    content = file.read(32)
    cube = np.frombuffer(content, "<f8", 4) if len(content) == 32 else np.zeros(4)
    if not (np.isfinite(cube).all() and cube[3] > 0):
        raise source.error(f"its octree has no cube, but {cube.tolist()}: convert it to LAZ again")
    return cube


def _nodes(file: BinaryIO, size: int, head: LasHead, source: Source) -> npt.NDArray[Any]:
    """Return the entries with points, of all pages; each page is read once, within the file."""
    place = head.record(b"copc", 1)
    assert place is not None
    file.seek(place[0] + 40)
    content = file.read(16)
    pages = [struct.unpack("<QQ", content)] if len(content) == 16 else []
    found, seen = [], set()
    while pages:
        start, length = pages.pop()
        if start in seen or length < 0 or start + length > size or length % _ENTRY.itemsize:
            raise source.error(f"the octree has no sound page at byte {start:,}: repair it")
        seen.add(start)
        file.seek(start)
        entries = np.frombuffer(file.read(length), _ENTRY)
        further = entries["points"] == -1
        pages += zip(
            entries["offset"][further].tolist(), entries["bytes"][further].tolist(), strict=True
        )
        found.append(entries[entries["points"] > 0])
    nodes = np.concatenate(found)
    total, ends = int(nodes["points"].sum(dtype=np.int64)), nodes["offset"] + nodes["bytes"]
    sound = (nodes["bytes"] > 0).all() and (ends <= size).all() and (nodes["key"] >= 0).all()
    if not sound or total != head.points or (nodes["key"][:, 0] > _DEEPEST).any():
        raise source.error(
            f"the octree tells of {total:,} points, the header of {head.points:,}: repair it"
        )
    order: npt.NDArray[Any] = nodes[np.argsort(nodes["offset"], kind="stable")]
    return order


def _meets(keys: npt.NDArray[Any], cube: FloatArray, box: FloatArray) -> npt.NDArray[np.bool_]:
    side = 2 * cube[3] / 2.0 ** keys[:, :1]
    low = cube[:3] - cube[3] + keys[:, 1:] * side
    # A step more on each side: coordinates were rounded to the grid of the file.
    slack = side * 1e-6 + 1e-9
    meets: npt.NDArray[np.bool_] = ((low - slack <= box[1]) & (low + side + slack >= box[0])).all(
        axis=1
    )
    return meets


def _groups(nodes: npt.NDArray[Any]) -> Iterator[npt.NDArray[Any]]:
    """Yield nodes that together have about as many points as a chunk."""
    number = np.cumsum(nodes["points"], dtype=np.int64) // CHUNK
    for cut in np.split(nodes, np.flatnonzero(np.diff(number)) + 1):
        if len(cut):
            yield cut


def _packing(file: BinaryIO, head: LasHead) -> bytes:
    """Return the record of LASzip."""
    place = head.record(b"laszip encoded", 22204)
    assert place is not None
    file.seek(place[0])
    return file.read(place[1])


def _unpacked(
    file: BinaryIO, header: Any, head: LasHead, nodes: npt.NDArray[Any], selection: Any
) -> Any:
    import lazrs
    from laspy import PackedPointRecord, ScaleAwarePointRecord

    packed = bytearray()
    for start, length in zip(nodes["offset"].tolist(), nodes["bytes"].tolist(), strict=True):
        file.seek(start)
        packed += file.read(length)
    how = _packing(file, head)
    count = int(nodes["points"].sum(dtype=np.int64))
    out = np.zeros(count * header.point_format.size, np.uint8)
    table = list(zip(nodes["points"].tolist(), nodes["bytes"].tolist(), strict=True))
    lazrs.decompress_points_with_chunk_table(packed, how, out, table, selection.to_lazrs())
    raw = PackedPointRecord.from_buffer(out, header.point_format)
    return ScaleAwarePointRecord(raw.array, raw.point_format, header.scales, header.offsets)
