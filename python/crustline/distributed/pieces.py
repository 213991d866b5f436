"""Points in pieces that fit in memory, each sorted by tile: any tile's part is read alone.

Beside the points, 24 bytes each, a small file tells where each tile's part of each piece ends.
Parts are read, not mapped: what that takes is the size of the part, whatever that of the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import IntArray
from crustline.distributed.store import (
    Records,
    Written,
    damaged,
    on_files,
    write,
    write_records,
)

Points = npt.NDArray[np.void]

POINT = np.dtype([("xy", np.float64, 2), ("row", np.int64)])


@dataclass(frozen=True)
class Part:
    """What successive tiles have in one piece.

    Attributes
    ----------
    points : ndarray of POINT
        Tile by tile, in the order of their rows within each.
    sizes : ndarray of int64
        How many points each of the tiles has.
    """

    points: Points
    sizes: IntArray

    def __len__(self) -> int:
        return len(self.points)


def points_of(xy: Any, row: IntArray) -> Points:
    """Return points as one array."""
    points = np.empty(len(row), POINT)
    points["xy"], points["row"] = xy, row
    return points


def write_pieces(
    folder: Path, path: str, tiles: int, pieces: Iterable[tuple[Points, IntArray]]
) -> list[Written]:
    """Write pieces, at least one, given as points and the tile of each; sort each by tile."""
    ends: list[IntArray] = []

    def make(part: Path) -> None:
        with part.open("wb") as file:
            for points, tile in pieces:
                # Of so few bits that NumPy sorts by digits, as a rule.
                order = np.argsort(tile.astype(np.min_scalar_type(tiles)), kind="stable")
                ends.append(np.cumsum(np.bincount(tile, minlength=tiles)))
                with on_files():
                    file.write(points[order].data.cast("B"))

    written = write(folder, f"{path}.points", make)
    return [written, write_records(folder, f"{path}.ends", [{"ends": np.array(ends)}])]


def _ends(folder: Path, path: str) -> IntArray:
    ends: IntArray = Records(folder / f"{path}.ends")[0]["ends"]
    return ends


def sizes_in(folder: Path, path: str) -> IntArray:
    """Return how many points each tile has in all pieces of a file."""
    sizes: IntArray = np.diff(_ends(folder, path), axis=1, prepend=0).sum(axis=0)
    return sizes


def parts_in(folder: Path, path: str, tiles: range) -> Iterator[Part]:
    """Yield what successive tiles have in each piece of a file."""
    ends = _ends(folder, path)
    bounds = np.concatenate([np.zeros((len(ends), 1), np.int64), ends], axis=1)
    first = 0
    with _opened(folder / f"{path}.points") as file:
        for bound in bounds:
            start, stop = int(bound[tiles.start]), int(bound[tiles.stop])
            with on_files():
                file.seek((first + start) * POINT.itemsize)
                points = np.fromfile(file, POINT, stop - start)
            if len(points) < stop - start:
                raise damaged(Path(file.name), "it ends too early")
            yield Part(points, np.diff(bound[tiles.start : tiles.stop + 1]))
            first += int(bound[-1])


def _opened(path: Path) -> Any:
    try:
        return path.open("rb", buffering=0)
    except OSError as error:
        raise damaged(path, str(error)) from None
