"""The vertices of the geometries of a file, and the edges that join them there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves, trace
from crustline.formats.source import Source
from crustline.points import Points

__all__ = ["Vertices", "edges_along"]


@dataclass
class Vertices:
    """Positions, part after part.

    A part is a line, a ring, or points by themselves; the position that only closes a ring is left
    out.

    Attributes
    ----------
    positions : list
        x, y and maybe more of each vertex: lists of numbers, or of their text.
    sizes : list of int
        How many positions each part has.
    lines, closed : list of bool
        Whether each part is a line or ring, and whether it is a ring.
    """

    source: Source
    positions: list[Any] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)
    lines: list[bool] = field(default_factory=list)
    closed: list[bool] = field(default_factory=list)

    def add(self, positions: Sequence[Any], line: bool) -> None:
        """Add a part."""
        closed = line and len(positions) > 3 and positions[0] == positions[-1]
        self.positions.extend(positions[:-1] if closed else positions)
        self.sizes.append(len(positions) - closed)
        self.lines.append(line)
        self.closed.append(closed)

    def coordinates(self) -> FloatArray:
        """Return the positions as numbers, (n, 2), or (n, 3) if every one of them has a height.

        Raises `ValueError` if one is no number, and `OverflowError` if it is too large.
        """
        widths = set(map(len, self.positions))
        if min(widths, default=2) < 2:
            raise ValueError("a position has no two numbers")
        if widths - {2, 3}:
            self.source.warn("numbers beyond x, y and z are left out")
        width = 3 if widths and min(widths) >= 3 else 2
        if width == 2 and widths - {2}:
            self.source.warn(
                "some positions have no height: the heights of the others are left out"
            )
        if len(widths) > 1 or max(widths, default=2) > width:
            self.positions = [position[:width] for position in self.positions]
        return np.array(self.positions, dtype=np.float64).reshape(len(self.positions), width)

    def points(self, coordinates: FloatArray, **beside: Any) -> Points:
        """Return coordinates as points; what does not fit is named by the source."""
        z = coordinates[:, 2] if coordinates.shape[1] == 3 else None
        with self.source.named():
            return Points(coordinates[:, :2], z=z, **beside)

    def curves(self, points: Points) -> Curves:
        """Return the points, joined as the parts join them."""
        sizes, lines, closed = map(np.array, (self.sizes, self.lines, self.closed))
        return trace(points, edges_along(sizes.astype(np.int64), lines, closed))


def edges_along(
    sizes: IntArray, lines: npt.NDArray[np.bool_], closed: npt.NDArray[np.bool_]
) -> IntArray:
    """Return the edges between neighbors along parts whose vertices follow one another.

    Parameters
    ----------
    sizes : ndarray of int64, shape (p,)
        The number of vertices of each part.
    lines, closed : ndarray of bool, shape (p,)
        Whether a part is a line or ring, and whether it is a ring. Others have no edges.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)

    Examples
    --------
    >>> sizes, lines, closed = np.array([3, 2]), np.array([True, True]), np.array([True, False])
    >>> edges_along(sizes, lines, closed).tolist()
    [[0, 1], [1, 2], [2, 0], [3, 4]]
    """
    if not len(sizes):
        return np.empty((0, 2), np.int64)
    starts = np.cumsum(sizes) - sizes
    part = np.repeat(np.arange(len(sizes)), sizes)
    rows = np.arange(len(part))
    last = rows == (starts + sizes - 1)[part]
    ends = np.where(last, starts[part], rows + 1)
    kept = lines[part] & (~last | closed[part]) & (ends != rows)
    return np.stack([rows[kept], ends[kept]], axis=1)
