"""LAS and LAZ by laspy, in pieces: points are read as the header says once it was found honest."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from crustline.arrays import FloatArray
from crustline.formats.cloud import CHUNK, Chunk
from crustline.formats.copc import is_copc, records_of_nodes
from crustline.formats.crs import normalize_crs
from crustline.formats.format import Format
from crustline.formats.las_header import LasHead, check
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points, own_points

__all__ = ["LAS", "LAZ"]

#: What stands for coordinates, or for parts of other dimensions.
_RAW = {"X", "Y", "Z"}
#: The finest step of a coordinate that is written, and the largest number of steps.
_FINEST, _MOST_STEPS = -9, 2**31 - 1


def cloud(source: Source, box: FloatArray) -> Iterator[Chunk]:
    """Yield the points in space, piece by piece; of a COPC file only the nodes that meet a box."""
    with _opened(source, places_alone=True) as (reader, head):
        if is_copc(head):
            chosen = reader.decompression_selection
            records = records_of_nodes(source, reader.header, head, box, chosen)
        else:
            records = _records(source, reader, head, CHUNK)
        crs = _crs(reader.header)
        for record in records:
            yield Chunk(_axes(record), _Kept(record), crs)


def stream(source: Source, rows: int) -> Iterator[Points]:
    """Yield the points, seen from above, with heights and all other dimensions."""
    with _opened(source) as (reader, head):
        crs = _crs(reader.header)
        for record in _records(source, reader, head, rows):
            yield _points(record, crs)


def read(source: Source) -> Points:
    """Return the points, seen from above, with heights and all other dimensions."""
    with _opened(source) as (reader, head):
        pieces = list(_records(source, reader, head, CHUNK))
        if not pieces:
            return Points(np.empty((0, 2)), z=[], crs=_crs(reader.header))
        record = pieces[0]
        record.array = np.concatenate([each.array for each in pieces])
        return _points(record, _crs(reader.header))


@contextmanager
def _opened(source: Source, *, places_alone: bool = False) -> Iterator[tuple[Any, LasHead]]:
    """Open a file whose header is true, as a reader of laspy; of all dimensions, or of places."""
    with source.path(".laz") as path, open(path, "rb") as file, _without_panic(source):
        import laspy

        logging.getLogger("laspy").setLevel(logging.CRITICAL)  # what it says is raised, too
        head = check(file, path.stat().st_size, source)
        chosen = laspy.DecompressionSelection.all()
        if places_alone:
            chosen = laspy.DecompressionSelection.base().decompress_z().decompress_flags()
        with laspy.open(file, closefd=False, decompression_selection=chosen) as reader:
            yield reader, head


@contextmanager
def _without_panic(source: Source) -> Iterator[None]:
    """Make what lazrs gives up on, and whatever else it raises, a `FormatError`."""
    try:
        with source.library("laspy"):
            yield
    except BaseException as error:
        if type(error).__name__ != "PanicException":
            raise
        raise source.error("its packed points are damaged: copy it again") from None


def _records(source: Source, reader: Any, head: LasHead, rows: int) -> Iterator[Any]:
    """Yield the records of points; fewer than the header says are an error."""
    there = 0
    for record in reader.chunk_iterator(rows):
        there += len(record)
        yield record
    if there != head.points:
        raise source.error(
            f"the header says {head.points:,} points, and {there:,} are there: it was cut off"
        )


def _axes(record: Any) -> tuple[_Scaled, _Scaled, _Scaled]:
    x, y, z = (_Scaled(getattr(record, name), record.scales[k], record.offsets[k])
               for k, name in enumerate("XYZ"))  # fmt: skip
    return x, y, z


class _Scaled:
    """Steps of an axis, made coordinates when they are asked for.

    laspy has such views, but takes two rows for a row and a column.
    """

    def __init__(self, steps: Any, scale: float, offset: float) -> None:
        self.steps, self.scale, self.offset = steps, scale, offset

    def __len__(self) -> int:
        return len(self.steps)

    def __getitem__(self, rows: Any) -> FloatArray:
        found: FloatArray = self.steps[rows] * self.scale + self.offset
        return found

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        return self[:]


class _Kept:
    """Whether points are not withheld; looked at where it is asked for alone."""

    def __init__(self, record: Any) -> None:
        self.withheld = (
            record.withheld if "withheld" in record.point_format.dimension_names else None
        )

    def __getitem__(self, rows: Any) -> Any:
        if self.withheld is None:
            return np.ones(len(rows), np.bool_)
        return np.asarray(self.withheld[rows]) == 0


def _points(record: Any, crs: str | None) -> Points:
    xy = np.stack([np.asarray(record.x), np.asarray(record.y)], axis=1)
    columns = {
        name.lower() if name.isupper() else name: np.array(record[name])
        for name in record.point_format.dimension_names
        if name not in _RAW and np.asarray(record[name]).ndim == 1
    }
    return own_points(xy, z=np.array(record.z), columns=columns, crs=crs)


def _crs(header: Any) -> str | None:
    try:
        found = header.parse_crs()
    except Exception:  # pyproj is not here, or does not know it: points are what they are
        return None
    if found is None:
        return None
    code = found.to_authority()
    return normalize_crs(":".join(code) if code else found.to_wkt())


def write_points(points: Points, target: Target) -> None:
    """Write LAS 1.4 (LAZ by its name): numbers beside the points as extra dimensions.

    Coordinates are rounded to the finest power of ten whose steps fit 32 bits, 10⁻⁹ at the least.
    """
    import laspy

    xyz = np.column_stack([points.xy, np.zeros(len(points)) if points.z is None else points.z])
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.offsets, header.scales = _grid(xyz)
    if points.crs is not None:
        import pyproj

        header.add_crs(pyproj.CRS.from_user_input(points.crs))
    own = set(header.point_format.dimension_names)
    columns = {name: each for name, each in points.columns.items() if each.dtype.kind in "iufb"}
    for name, column in columns.items():
        if name not in own:
            header.add_extra_dim(laspy.ExtraBytesParams(name[:32], _kind(column)))
    las = laspy.LasData(header)
    las.x, las.y, las.z = xyz.T
    for name, column in columns.items():
        las[name[:32]] = column
    with target.path(".laz") as path:
        las.write(str(path))


def _grid(xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return offsets and steps: decimal ones, and as fine as the extent of the points allows."""
    if not len(xyz):
        return np.zeros(3), np.full(3, 1e-3)
    offsets = np.round((xyz.min(axis=0) + xyz.max(axis=0)) / 2)
    reach = np.abs(xyz - offsets).max(axis=0)
    digits = np.ceil(np.log10(np.maximum(reach, 1e-300) / _MOST_STEPS))
    return offsets, 10.0 ** np.maximum(digits, _FINEST)


def _kind(column: Any) -> str:
    return "uint8" if column.dtype.kind == "b" else str(column.dtype)


LAS = Format(
    name="las",
    title="LAS",
    suffixes=(".las",),
    sniff=lambda head: head.startswith(b"LASF") and not (head[104:105] or b"\0")[0] & 0xC0,
    read=read,
    stream=stream,
    cloud=cloud,
    write_points=write_points,
    extra="lidar",
    needs=("laspy",),
)
LAZ = Format(
    name="laz",
    title="LAZ",
    suffixes=(".laz",),
    sniff=lambda head: head.startswith(b"LASF") and bool((head[104:105] or b"\0")[0] & 0xC0),
    read=read,
    stream=stream,
    cloud=cloud,
    write_points=write_points,
    extra="lidar",
    needs=("laspy", "lazrs"),
)
