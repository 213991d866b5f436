"""What a cloud in space is read as: pieces of coordinates, each axis made when it is asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, IntArray

__all__ = ["CHUNK", "Chunk", "chunks_of_array"]

#: Points that are read at once.
CHUNK = 1_000_000


@dataclass(frozen=True, eq=False)
class Chunk:
    """Some points of a cloud, in the order of the file.

    Attributes
    ----------
    axes : sequence of three array-likes, shape (k,)
        x, y and z. They may be views that are scaled when they are read.
    valid : array-like of bool, shape (k,), optional
        Which points count; by default all do.
    crs : str, optional
        The coordinate reference system.
    """

    axes: tuple[Any, Any, Any]
    valid: Any = None
    crs: str | None = None

    def __len__(self) -> int:
        return len(self.axes[0])

    def axis(self, number: int) -> FloatArray:
        """Return all values of an axis."""
        return np.asarray(self.axes[number], dtype=np.float64)

    def counting(self, rows: IntArray) -> IntArray:
        """Return those of some rows that count."""
        return rows if self.valid is None else rows[np.asarray(self.valid[rows], dtype=np.bool_)]

    def xyz(self, rows: IntArray) -> FloatArray:
        """Return the coordinates of some rows, shape (k, 3)."""
        return np.stack([np.asarray(axis[rows], np.float64) for axis in self.axes], axis=1)


def chunks_of_array(xyz: FloatArray) -> Iterator[Chunk]:
    """Yield the rows of an array (n, 3) in pieces."""
    for start in range(0, len(xyz), CHUNK):
        x, y, z = xyz[start : start + CHUNK].T
        yield Chunk((x, y, z))
