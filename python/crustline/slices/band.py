"""The points of a cloud that are near planes, collected from pieces of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.formats.cloud import Chunk
from crustline.slices.plane import Plane

__all__ = ["Bands", "bands_of", "box_of"]


@dataclass(frozen=True, eq=False)
class Bands:
    """What was found near planes.

    Attributes
    ----------
    points : list of ndarray of float64, shape (k, 2)
        For each plane the plane coordinates of the points in its band.
    reach : tuple of float
        The least and greatest place along the normal of the first plane, of all that was read.
    crs : str or None
        The coordinate reference system that the cloud names.
    """

    points: list[FloatArray]
    reach: tuple[float, float]
    crs: str | None


def bands_of(chunks: Iterable[Chunk], planes: Sequence[Plane], thickness: Sequence[float]) -> Bands:
    """Return the points of a cloud that are within half a thickness of planes, one for each."""
    pieces: list[list[FloatArray]] = [[np.empty((0, 2))] for _ in planes]
    families = [_Family(planes, thickness, each) for each in _parallel(planes, thickness)]
    crs = None
    for chunk in chunks:
        crs = chunk.crs
        for family in families:
            for number, xyz in family.of(chunk):
                uv = planes[number].project(xyz)
                pieces[number].append(uv[_within(uv, planes[number])])
    return Bands([np.concatenate(each) for each in pieces], families[0].reach, crs)


def _parallel(planes: Sequence[Plane], thickness: Sequence[float]) -> list[list[int]]:
    """Return the numbers of planes in groups of one normal and one thickness."""
    groups: dict[tuple[bytes, float], list[int]] = {}
    for number, plane in enumerate(planes):
        key = (plane.normal + 0.0).tobytes(), thickness[number]
        groups.setdefault(key, []).append(number)
    return list(groups.values())


class _Family:
    """Parallel planes with bands of one thickness, sorted: distances along their normal are one."""

    def __init__(
        self, planes: Sequence[Plane], thickness: Sequence[float], members: list[int]
    ) -> None:
        self.normal = planes[members[0]].normal
        self.members = sorted(members, key=lambda number: planes[number].offset)
        offsets = np.array([planes[number].offset for number in self.members])
        half = thickness[members[0]] / 2
        self.low, self.high = offsets - half, offsets + half
        self.reach = (np.inf, -np.inf)

    def of(self, chunk: Chunk) -> Iterable[tuple[int, FloatArray]]:
        """Yield the number of each plane with points near it, and these points."""
        place = self._place(chunk)
        least, greatest = self.reach
        self.reach = (float(place.min(initial=least)), float(place.max(initial=greatest)))
        rows = chunk.counting(self._rows(place))
        xyz, place = chunk.xyz(rows), place[rows]
        for number, low, high in zip(self.members, self.low, self.high, strict=True):
            chosen = (place >= low) & (place <= high)
            if chosen.any():
                yield number, xyz[chosen]

    def _rows(self, place: FloatArray) -> IntArray:
        """Return the rows that are in any band: more of them begin below than end below."""
        if len(self.members) == 1:
            return np.flatnonzero((place >= self.low[0]) & (place <= self.high[0]))
        begun = np.searchsorted(self.low, place, side="right")
        return np.flatnonzero(begun > np.searchsorted(self.high, place, side="left"))

    def _place(self, chunk: Chunk) -> FloatArray:
        """Return how far points are along the normal; only the axes that count are looked at."""
        used = np.flatnonzero(self.normal)
        total: FloatArray = chunk.axis(used[0])
        if len(used) == 1 and self.normal[used[0]] == 1:
            return total
        total = total * self.normal[used[0]]
        for axis in used[1:]:
            total += chunk.axis(axis) * self.normal[axis]
        return total


def _within(uv: FloatArray, plane: Plane) -> BoolArray | slice:
    if plane.ends is None:
        return slice(None)
    inside: BoolArray = (uv[:, 0] >= plane.ends[0]) & (uv[:, 0] <= plane.ends[1])
    return inside


def box_of(planes: Sequence[Plane], thickness: Sequence[float]) -> FloatArray:
    """Return a box, least and greatest corner, that holds all bands."""
    corners = [_reach(plane, each / 2) for plane, each in zip(planes, thickness, strict=True)]
    return np.array(
        [np.min([low for low, _ in corners], axis=0), np.max([high for _, high in corners], axis=0)]
    )


def _reach(plane: Plane, half: float) -> tuple[FloatArray, FloatArray]:
    low, high = np.full(3, -np.inf), np.full(3, np.inf)
    alone: IntArray = np.flatnonzero(plane.normal)
    if plane.ends is not None:
        ends = plane.lift(np.array([(end, 0.0) for end in plane.ends]))[:, :2]
        low[:2], high[:2] = ends.min(axis=0) - half, ends.max(axis=0) + half
    elif len(alone) == 1:
        at = plane.origin[alone[0]]
        low[alone], high[alone] = at - half, at + half
    return low, high
