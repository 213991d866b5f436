"""What of all points has not been seen: rectangles, from which parts are read and cut out.

All points lie in groups, some hundred neighbors of one tile, each in the rectangle around it. What
is not in a rectangle is known to be empty. At first a whole tile is one rectangle; where something
of it is asked for, its groups take its place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.distributed.store import Arrays, together

WHOLE = -1

#: No points, with what is told of points that were seen.
NOTHING: Arrays = {
    "xy": np.empty((0, 2)),
    "row": np.empty(0, np.int64),
    "tile": np.empty(0, np.int64),
    "known": np.empty(0, bool),
}


@dataclass(frozen=True)
class Atlas:
    """Where the points are.

    Attributes
    ----------
    tiles : ndarray of float64, shape (tiles, 4)
        Left, bottom, right, top of each tile's points.
    groups : callable
        Takes a tile, returns the same of its groups, and how many points each has.
    """

    tiles: FloatArray
    groups: Callable[[int], tuple[FloatArray, IntArray]]


class Sight:
    """The rectangles that have not been seen, some of them known from before.

    Parameters
    ----------
    atlas : Atlas
        Where the points are.
    read : callable
        Takes a tile and numbers of its groups, returns their records.
    seen : int, optional
        A tile that is all seen.
    """

    def __init__(
        self, atlas: Atlas, read: Callable[[int, list[int]], list[Arrays]], seen: int | None = None
    ) -> None:
        tiles = np.flatnonzero(atlas.tiles[:, 0] <= atlas.tiles[:, 2])
        tiles = tiles[tiles != seen]
        self._atlas, self._read = atlas, read
        self.bounds = atlas.tiles[tiles]
        self.tile, self.group = tiles, np.full(len(tiles), WHOLE)
        self.known = np.zeros(len(tiles), bool)

    def know_tile(self, tile: int) -> None:
        """Mark a tile as known."""
        self.known |= self.tile == tile

    def know(self, rectangle: FloatArray) -> None:
        """Mark what lies in a rectangle as known."""
        self._open(np.flatnonzero(~self.known & meets(self.bounds, rectangle)))
        pieces = np.flatnonzero(~self.known & meets(self.bounds, rectangle))
        parts = common(self.bounds[pieces], rectangle)
        tile, group = self.tile[pieces], self.group[pieces]
        self._cut(pieces, parts)
        self._add(parts, tile, group, np.ones(len(pieces), bool))

    def within(self, rectangle: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the pieces that meet a rectangle, and the part of each in it."""
        self._open(np.flatnonzero(meets(self.bounds, rectangle)))
        pieces = np.flatnonzero(meets(self.bounds, rectangle))
        return pieces, common(self.bounds[pieces], rectangle)

    def see(self, pieces: IntArray, parts: FloatArray) -> Arrays:
        """Return the points in parts of pieces, which are then seen.

        Of a whole tile its groups are cut to what is asked of it.
        """
        is_whole = self.group[pieces] == WHOLE
        tiles, asked = self.tile[pieces[is_whole]], parts[is_whole]
        found = [self._take(pieces[~is_whole], parts[~is_whole])]
        self._open(np.flatnonzero((self.group == WHOLE) & np.isin(self.tile, tiles)))
        for tile, part in zip(tiles, asked, strict=True):
            inside = np.flatnonzero((self.tile == tile) & meets(self.bounds, part))
            found.append(self._take(inside, common(self.bounds[inside], part)))
        return together(found, NOTHING)

    def _take(self, pieces: IntArray, parts: FloatArray) -> Arrays:
        found = self._points(pieces, parts)
        self._cut(pieces, parts)
        return found

    def _points(self, pieces: IntArray, parts: FloatArray) -> Arrays:
        found = []
        for owner in np.unique(self.tile[pieces]):
            mine = np.flatnonzero(self.tile[pieces] == owner)
            groups, which = np.unique(self.group[pieces[mine]], return_inverse=True)
            records = self._read(int(owner), groups.tolist())
            for k, number in zip(mine, which, strict=True):
                record = records[number]
                inside = holds(parts[k], record["xy"])
                about = {"tile": owner, "known": self.known[pieces[k]]}
                count = np.count_nonzero(inside)
                found.append(
                    {"xy": record["xy"][inside], "row": record["row"][inside]}
                    | {name: np.full(count, value) for name, value in about.items()}
                )
        return together(found, NOTHING)

    def _open(self, pieces: IntArray) -> None:
        """Put the groups of those pieces that are whole tiles in their place."""
        whole = pieces[self.group[pieces] == WHOLE]
        tiles, known = self.tile[whole], self.known[whole]
        self._drop(whole)
        for tile, was_known in zip(tiles, known, strict=True):
            bounds, _ = self._atlas.groups(tile)
            numbers = np.arange(len(bounds))
            self._add(bounds, np.full(len(bounds), tile), numbers, np.full(len(bounds), was_known))

    def _cut(self, pieces: IntArray, parts: FloatArray) -> None:
        rest, origin = without(self.bounds[pieces], parts)
        origin = pieces[origin]
        kept = (self.tile[origin], self.group[origin], self.known[origin])
        self._drop(pieces)
        self._add(rest, *kept)

    def _drop(self, pieces: IntArray) -> None:
        stay = np.ones(len(self.tile), bool)
        stay[pieces] = False
        self.bounds, self.known = self.bounds[stay], self.known[stay]
        self.tile, self.group = self.tile[stay], self.group[stay]

    def _add(self, bounds: FloatArray, tile: IntArray, group: IntArray, known: BoolArray) -> None:
        self.bounds = np.concatenate([self.bounds, bounds])
        self.tile, self.group = np.append(self.tile, tile), np.append(self.group, group)
        self.known = np.append(self.known, known)


def around(xy: FloatArray) -> FloatArray:
    """Return left, bottom, right, top of points; of none, a rectangle that meets nothing."""
    if not len(xy):
        return np.array([np.inf, np.inf, -np.inf, -np.inf])
    return np.concatenate([xy.min(axis=0), xy.max(axis=0)])


def grown(rectangle: FloatArray, width: float) -> FloatArray:
    """Return a rectangle that is larger on all sides."""
    low, high = rectangle[:2] - width, rectangle[2:] + width
    return np.concatenate([low, high])


def meets(rectangles: FloatArray, other: FloatArray) -> BoolArray:
    """Return whether each of the rectangles meets the other one, borders included."""
    apart = (rectangles[:, :2] > other[2:]) | (other[:2] > rectangles[:, 2:])
    return ~(apart[:, 0] | apart[:, 1])


def holds(rectangle: FloatArray, xy: FloatArray) -> BoolArray:
    """Return whether a rectangle holds each point, borders included."""
    outside = (xy < rectangle[:2]) | (xy > rectangle[2:])
    return ~(outside[:, 0] | outside[:, 1])


def common(rectangles: FloatArray, other: FloatArray) -> FloatArray:
    """Return what each of the rectangles has in common with the other one."""
    low = np.maximum(rectangles[:, :2], other[:2])
    return np.concatenate([low, np.minimum(rectangles[:, 2:], other[2:])], axis=1)


def without(rectangles: FloatArray, parts: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return what is left of rectangles without their parts, and which of them each piece is of.

    Coordinates are doubles, so the pieces start at the next double beside the part.
    """
    left, bottom, right, top = rectangles.T
    a, b, c, d = parts.T
    pieces = np.stack(
        [
            np.stack([left, bottom, np.nextafter(a, -np.inf), top], axis=1),
            np.stack([np.nextafter(c, np.inf), bottom, right, top], axis=1),
            np.stack([a, bottom, c, np.nextafter(b, -np.inf)], axis=1),
            np.stack([a, np.nextafter(d, np.inf), c, top], axis=1),
        ],
        axis=1,
    )
    real = (pieces[:, :, 0] <= pieces[:, :, 2]) & (pieces[:, :, 1] <= pieces[:, :, 3])
    return pieces[real], np.nonzero(real)[0]
