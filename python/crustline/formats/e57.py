"""E57 by pye57: the scans of a file, each in its place, in pieces."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from crustline.arrays import FloatArray
from crustline.formats.cloud import CHUNK, Chunk
from crustline.formats.format import Format
from crustline.formats.source import Source
from crustline.points import Points, own_points

__all__ = ["E57"]

_PLACES = (
    ("cartesianX", "cartesianY", "cartesianZ", "cartesianInvalidState"),
    ("sphericalRange", "sphericalAzimuth", "sphericalElevation", "sphericalInvalidState"),
)


def cloud(source: Source, box: FloatArray) -> Iterator[Chunk]:
    """Yield the valid points of all scans in space."""
    for xyz, _ in _pieces(source, CHUNK):
        yield Chunk((xyz[:, 0], xyz[:, 1], xyz[:, 2]))


def stream(source: Source, rows: int) -> Iterator[Points]:
    """Yield the valid points, seen from above, with heights and the number of their scan."""
    for xyz, scan in _pieces(source, rows):
        yield _points(xyz, np.full(len(xyz), scan))


def read(source: Source) -> Points:
    """Return the valid points, seen from above, with heights and the number of their scan."""
    pieces = list(_pieces(source, CHUNK))
    xyz = np.concatenate([np.empty((0, 3)), *(each for each, _ in pieces)])
    scans = [np.full(len(each), scan) for each, scan in pieces]
    return _points(xyz, np.concatenate([np.empty(0, np.int64), *scans]))


def _points(xyz: FloatArray, scan: Any) -> Points:
    return own_points(xyz[:, :2].copy(), z=xyz[:, 2].copy(), columns={"scan": scan})


def _pieces(source: Source, rows: int) -> Iterator[tuple[FloatArray, int]]:
    """Yield coordinates, shape (k, 3), and the number of their scan."""
    with source.path(".e57") as path, source.library("pye57"):
        import pye57

        with pye57.E57(str(path)) as file:
            for scan in range(file.scan_count):
                for xyz in _scan(file, file.get_header(scan), rows, source):
                    if not (np.abs(xyz) < 1e100).all():
                        raise source.error("a point is not finite: repair it", f"scan {scan}")
                    yield xyz, scan


def _scan(file: Any, header: Any, rows: int, source: Source) -> Iterator[FloatArray]:
    fields = next((each for each in _PLACES if set(each[:3]) <= set(header.point_fields)), None)
    if fields is None:
        raise source.error("a scan has neither x, y and z nor ranges and angles: export it again")
    known = [name for name in fields if name in header.point_fields]
    count = int(header.point_count)
    if count < 0 or count > _DENSEST * (source.size or 1 << 40):
        raise source.error(f"a scan says that it has {count:,} points: copy it again")
    data, buffers = file.make_buffers(known, min(rows, max(count, 1)))
    points = header.points.reader(buffers)
    there = 0
    while (size := int(points.read())) > 0:
        there += size
        yield _in_place(header, {name: data[name][:size] for name in known}, fields)
    points.close()
    if there != count:
        raise source.error(f"a scan says {count:,} points, and {there:,} are there: it was cut off")


#: Points that a byte of a file may hold at the most; what is constant takes next to no room.
_DENSEST = 5000


def _in_place(header: Any, data: dict[str, Any], fields: tuple[str, ...]) -> FloatArray:
    """Return the valid points of a piece, moved as its scan is."""
    first, second, third = (np.asarray(data[name], np.float64) for name in fields[:3])
    if fields is _PLACES[1]:
        level = first * np.cos(third)
        first, second, third = level * np.cos(second), level * np.sin(second), first * np.sin(third)
    xyz = np.stack([first, second, third], axis=1)
    if fields[3] in data:
        xyz = xyz[data[fields[3]] == 0]
    if header.has_pose():
        xyz = xyz @ header.rotation_matrix.T + header.translation
    return xyz


E57 = Format(
    name="e57",
    title="E57",
    suffixes=(".e57",),
    sniff=lambda head: head.startswith(b"ASTM-E57"),
    read=read,
    stream=stream,
    cloud=cloud,
    extra="lidar",
    needs=("pye57",),
)
