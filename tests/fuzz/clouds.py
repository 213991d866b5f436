"""Small sound clouds and meshes, as laspy, lazrs, pye57 and trimesh write them, and by hand."""

from __future__ import annotations

import io
import os
import struct
import tempfile
from contextlib import suppress
from typing import Any

import numpy as np

#: A cloud of so few points that a mutated byte is likely to matter.
COUNT = 40


def xyz(count: int = COUNT) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Points of a cylinder."""
    angle = np.arange(count) * (2 * np.pi / count)
    return np.stack([np.cos(angle), np.sin(angle), np.arange(count) % 4 / 4], axis=1)


def las(kind: int, packed: bool, *, count: int = COUNT) -> bytes:
    """A LAS or LAZ file of a point format, with a record and an extra dimension."""
    import laspy

    header = laspy.LasHeader(version="1.4" if kind > 5 else "1.2", point_format=kind)
    header.scales, header.offsets = [0.001] * 3, [0.0] * 3
    header.vlrs.append(laspy.VLR("tests", 7, "a record", b"1234"))
    header.add_extra_dim(laspy.ExtraBytesParams("extra", "uint16"))
    made = laspy.LasData(header)
    made.x, made.y, made.z = xyz(count).T
    made.extra = np.arange(count)
    stream = io.BytesIO()
    made.write(stream, do_compress=packed)
    return stream.getvalue()


def copc(
    kind: int = 6, *, root: int = 30, pages: int = 1, record: bytes = b"", **how: Any
) -> bytes:
    """A COPC file after its specification: a root and its eight children, each in its chunk.

    Its point format, the points of the root (200 are all), whether the children have pages of
    their own (2), another record before the points, and what `_chunks` takes.
    """
    child = (places() >= 4) @ [1, 2, 4]
    child[:root] = -1
    beside = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 2112, len(record), b"") + record
    start = 375 + 54 + 160 + (len(beside) if record else 0)
    points, packing, chunks, entries = _chunks(kind, child, start, **how)
    start += 54 + len(packing)
    end = start + len(chunks)
    listed = entries if root < 200 else entries[:1]
    if pages > 1:  # entries that lead to a page of one entry for each child
        at = end + 60 + 32 * len(listed)
        links = [
            each[:16] + struct.pack("<Qii", at + 32 * k, 32, -1)
            for k, each in enumerate(listed[1:])
        ]
        listed = [listed[0], *links, *listed[1:]]
    first = 32 * len(entries if root < 200 else entries[:1])
    info = np.array([4, 4, 4, 4, 1], "<f8").tobytes()
    info += struct.pack("<QQdd", end + 60, first, 0, 0) + b"\0" * 88
    head = _head(points, start, end, kind | 128, 3 if record else 2)
    head += struct.pack("<H16sHH32s", 0, b"copc", 1, 160, b"") + info
    head += struct.pack("<H16sHH32s", 0, b"laszip encoded", 22204, len(packing), b"") + packing
    content = b"".join(listed)
    evlr = struct.pack("<H16sHQ32s", 0, b"copc", 1000, len(content), b"")
    return head + (beside if record else b"") + chunks + evlr + content


def _chunks(
    kind: int, child: Any, start: int, step: float = 0.001, shift: float = 0.0, extra: int = 0,
    order: int = 1,
) -> tuple[Any, bytes, bytes, list[bytes]]:  # fmt: skip
    """Points, the record that says how they are packed, their chunks, and the nodes' entries.

    Steps of coordinates and where these start, bytes beside each point, and -1 for the order of
    chunks in the file that is not that of the nodes.
    """
    import laspy
    import lazrs

    header = laspy.LasHeader(version="1.4", point_format=kind)
    header.scales, header.offsets = [step] * 3, [shift] * 3
    if extra:
        header.add_extra_dim(laspy.ExtraBytesParams("extra", f"{extra}u1"))
    points = laspy.ScaleAwarePointRecord.zeros(200, header=header)
    points.x, points.y, points.z = places().T
    how = lazrs.LazVlr.new_for_compression(kind, extra, True)
    packing = how.record_data()
    start += 54 + len(packing)
    packed = io.BytesIO(b"\0" * start)
    packed.seek(start)
    compressor = lazrs.LasZipCompressor(packed, how)
    compressor.reserve_offset_to_chunk_table()
    keys = [(0, 0, 0, 0), *((1, k & 1, k >> 1 & 1, k >> 2) for k in range(8))]
    entries = [b""] * 9
    for number in [*range(9)][::order]:
        rows, before = np.flatnonzero(child == number - 1), packed.tell()
        if len(rows):
            compressor.compress_many(points.array[rows].tobytes())
            compressor.finish_current_chunk()
        size = packed.tell() - before
        entries[number] = struct.pack("<4iQii", *keys[number], before * (size > 0), size, len(rows))
    compressor.done()
    return points, packing, packed.getvalue()[start:], entries


def places() -> np.ndarray[Any, np.dtype[np.float64]]:
    """The points of COPC files, before they are rounded to steps."""
    return np.random.default_rng(0).uniform(0, 8, (200, 3))


def _head(record: Any, start: int, end: int, kind: int, records: int) -> bytes:
    """The public header of LAS 1.4, with records before and one after the points."""
    count = len(record)
    low_high = np.ravel(
        [[np.max(each), np.min(each)] for each in (record.x, record.y, record.z)]
    ).tolist()
    head = struct.pack(
        "<4sHHIHH8sBB32s32sHH", b"LASF", 0, 16, 0, 0, 0, b"", 1, 4, b"", b"", 1, 2026
    )
    size = record.array.dtype.itemsize
    head += struct.pack("<HIIBHI5I", 375, start, records, kind, size, 0, *[0] * 5)
    head += struct.pack("<12d", *record.scales, *record.offsets, *low_high)
    head += struct.pack("<QQIQ15Q", 0, end, 1, count, *[0] * 15)
    return head


def e57() -> bytes:
    """Two scans, one of them moved."""
    import pye57

    x, y, z = xyz().T
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "a.e57")
        with pye57.E57(name, mode="w") as file:
            data = {"cartesianX": x, "cartesianY": y, "cartesianZ": z}
            file.write_scan_raw(data, rotation=np.array([1.0, 0, 0, 0]),
                                translation=np.array([1.0, 2, 3]))  # fmt: skip
            file.write_scan_raw(data)
        with open(name, "rb") as made:
            return made.read()


def plys() -> list[bytes]:
    """A cloud as text and as numbers, big-endian too, and a mesh with mixed lists."""
    table = np.zeros(COUNT, [("x", ">f8"), ("y", ">f8"), ("z", ">f8"), ("red", "u1")])
    table["x"], table["y"], table["z"] = xyz().T
    properties = "property double x\nproperty double y\nproperty double z\nproperty uchar red\n"
    head = "ply\nformat {} 1.0\ncomment c\nelement vertex {}\n{}{}end_header\n"
    rows = "".join(f"{x:.4f} {y:.4f} {z:.4f} {k}\n" for k, (x, y, z) in enumerate(xyz()))
    faces = "element face 2\nproperty list uchar int vertex_indices\n"
    return [
        head.format("ascii", COUNT, properties, "").encode() + rows.encode(),
        head.format("binary_big_endian", COUNT, properties, "").encode() + table.tobytes(),
        head.format("ascii", COUNT, properties, faces).encode() + rows.encode()
        + b"3 0 1 2\n4 0 1 2 3\n",
    ]  # fmt: skip


def meshes() -> dict[str, list[bytes]]:
    """A box as STL, of numbers and of text, and as OBJ."""
    import trimesh

    box = trimesh.creation.box((2, 2, 2))
    made = {"stl": [box.export(file_type="stl"), box.export(file_type="stl_ascii").encode()]}
    text = box.export(file_type="obj").encode()
    return made | {
        "obj": [text, b"v 0 0 0\nv 1 0 1\nv 0 1 2\nv 1 1 1\nf 1/1 2/2 4 3\nf -1 -2 -3\n"]
    }


PTS = [
    b"3\n1 2 3 -5 10 20 30\n1.5 2 3 7 0 0 0\n1 2.5 3.25 0 255 255 255\n",
    b"2\r\n1 2 3\r\n4 5 6\r\n1\r\n7 8 9\r\n",
]


def seeds() -> dict[str, list[bytes]]:
    """Sound files by their keys; those without whose packages cannot be made are left out."""
    found: dict[str, list[bytes]] = {"pts": PTS, "ply": plys()}
    for make in (
        lambda: {"las": [las(3, False), las(6, False)]},
        lambda: {"laz": [las(3, True), las(6, True)], "copc": [copc()]},
        lambda: {"e57": [e57()]},
        meshes,
    ):
        with suppress(ImportError):
            found |= make()
    return found


#: All keys that `seeds` may have.
KEYS = ("las", "laz", "copc", "ply", "pts", "e57", "stl", "obj")
