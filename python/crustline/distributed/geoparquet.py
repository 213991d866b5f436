"""Curves as GeoParquet: well-known binary, bounding boxes, and what crustline knows of each curve.

The columns are geometry, bbox, closed, first (its first row), length (in the unit of the points)
and rows. A ring is a line string that ends where it starts; an isolated point is a point.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.distributed.store import write_batches

_LINE, _POINT = 2, 1


@dataclass(frozen=True)
class Ragged:
    """Curves one after another, none repeats its first row.

    Attributes
    ----------
    rows : ndarray of int64, shape (k,)
        Rows of the points.
    xy : ndarray of float64, shape (k, 2)
        Their coordinates.
    offsets : ndarray of int64, shape (c + 1,)
        Where each curve starts.
    closed : ndarray of bool, shape (c,)
        Whether it is a ring. A curve of one row is an isolated point.
    """

    rows: IntArray
    xy: FloatArray
    offsets: IntArray
    closed: BoolArray

    @property
    def drawn(self) -> tuple[FloatArray, IntArray]:
        """The vertices of all curves as drawn, rings to their end, and where each starts."""
        sizes = np.diff(self.offsets) + self.closed
        offsets = np.concatenate([[0], np.cumsum(sizes)])
        places = np.arange(offsets[-1]) - np.repeat(offsets[:-1] - self.offsets[:-1], sizes)
        places[offsets[1:][self.closed] - 1] = self.offsets[:-1][self.closed]
        return self.xy[places], offsets


def write_curves(path: Path, parts: Iterable[Ragged], crs: Any) -> None:
    """Write curves to a file, a row group for each part."""
    write_batches(path, _schema(crs), (table_of(part, crs) for part in parts))


def table_of(curves: Ragged, crs: Any) -> Any:
    """Return curves as a record batch."""
    import pyarrow as pa

    vertices, offsets = curves.drawn
    geometry = pa.Array.from_buffers(
        pa.large_binary(), len(curves.closed), [None, *map(pa.py_buffer, _wkb(vertices, offsets))]
    )
    box = [np.minimum.reduceat(vertices, offsets[:-1]), np.maximum.reduceat(vertices, offsets[:-1])]
    corners = np.concatenate(box, axis=1) if len(vertices) else np.empty((0, 4))
    rows = pa.LargeListArray.from_arrays(pa.array(curves.offsets), pa.array(curves.rows))
    columns = [
        geometry,
        pa.StructArray.from_arrays([pa.array(side.copy()) for side in corners.T], list(_BOX)),
        pa.array(curves.closed),
        pa.array(curves.rows[curves.offsets[:-1]]),
        pa.array(_lengths(vertices, offsets)),
        rows,
    ]
    return pa.record_batch(columns, schema=_schema(crs))


_BOX = ("xmin", "ymin", "xmax", "ymax")


def _schema(crs: Any) -> Any:
    import pyarrow as pa

    covering = {"bbox": {side: ["bbox", side] for side in _BOX}}
    column = {"encoding": "WKB", "geometry_types": [], "crs": crs, "covering": covering}
    about = {"version": "1.1.0", "primary_column": "geometry", "columns": {"geometry": column}}
    fields = [
        ("geometry", pa.large_binary()),
        ("bbox", pa.struct([(side, pa.float64()) for side in _BOX])),
        ("closed", pa.bool_()),
        ("first", pa.int64()),
        ("length", pa.float64()),
        ("rows", pa.large_list(pa.int64())),
    ]
    return pa.schema(fields, metadata={"geo": json.dumps(about)})


def _lengths(vertices: FloatArray, offsets: IntArray) -> FloatArray:
    steps = np.append(np.hypot(*np.diff(vertices, axis=0).T), 0.0) if len(vertices) else np.empty(0)
    # From the end of a curve to the start of the next is no step.
    steps[offsets[1:] - 1] = 0.0
    lengths: FloatArray = np.add.reduceat(steps, offsets[:-1]) if len(steps) else steps
    return lengths


def _wkb(vertices: FloatArray, offsets: IntArray) -> tuple[Any, Any]:
    """Return where the geometries start, and all of them in well-known binary."""
    sizes = np.diff(offsets)
    is_point = sizes == 1
    # Byte order and type, the count but for points, x and y.
    heads = np.where(is_point, 5, 9)
    starts = np.concatenate([[0], np.cumsum(heads + 16 * sizes)])
    content = np.zeros(int(starts[-1]), np.uint8)
    is_vertex = np.ones(len(content), bool)
    head = np.zeros((len(sizes), 9), np.uint8)
    head[:, 0] = 1
    head[:, 1:5] = np.where(is_point, _POINT, _LINE).astype("<u4")[:, None].view(np.uint8)
    head[:, 5:9] = sizes.astype("<u4")[:, None].view(np.uint8)
    for size in (5, 9):
        of_size = heads == size
        places = starts[:-1][of_size, None] + np.arange(size)
        content[places] = head[of_size, :size]
        is_vertex[places] = False
    content[is_vertex] = np.ascontiguousarray(vertices, "<f8").view(np.uint8).ravel()
    return starts, content
