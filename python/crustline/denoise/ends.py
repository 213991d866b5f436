"""Ends of a ridge that go on from each other: at gaps that chance makes, and at sharp corners.

Each end is decided where it is, so of a hundred thousand a few are wrong. What tells them is the
other end: nothing else than a curve that goes on makes two of them so near.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from crustline.arrays import FloatArray, IntArray

#: Windows within which two ends go on from each other, whichever way they point: at a corner the
#: ridge of one side runs past that of the other.
NEAR = 3.0
#: The cosine between two ends above which they are beside each other, as those of two strands are.
BESIDE = 0.9
#: Ends that look at each other go on over a gap so many times the longest in their curves; the
#: rates add up at which each nears the other, 2 at the most.
LONGER, FACING = 1.5, 1.7
#: Windows over which the direction of an end is taken.
BACK = 4.0
#: Ends that are looked at about each.
AROUND = 6

Part = tuple[IntArray, bool]


@dataclass(frozen=True, eq=False)
class _Ends:
    """Both ends of each of some paths: of path k those numbered 2k and 2k + 1."""

    at: FloatArray
    outward: FloatArray
    """Unit vectors along the path and out of it."""
    width: FloatArray
    """The window there."""
    longest: FloatArray
    """The longest step of the path."""
    length: FloatArray
    """The length of the path."""


def joined(parts: list[Part], at: FloatArray, widths: FloatArray) -> list[Part]:
    """Return paths, numbers of places, of which those are one whose ends go on from each other.

    Rings are what the second of each tells. `widths` are those of the windows at the places.
    """
    paths = [path for path, closed in parts if not closed]
    if not paths:
        return parts
    ends = _ends(paths, at, widths)
    partner = np.full(2 * len(paths), -1)
    for one, other in _pairs(ends):
        if partner[one] < 0 and partner[other] < 0:
            partner[[one, other]] = other, one
    return [part for part in parts if part[1]] + list(_walks(paths, partner))


def _ends(paths: list[IntArray], at: FloatArray, widths: FloatArray) -> _Ends:
    both = [turned for path in paths for turned in (path[::-1], path)]
    steps = [np.hypot(*np.diff(at[path], axis=0).T) for path in paths]
    outward = np.array([_outward(at[path], BACK * widths[path[-1]]) for path in both])
    last = np.array([path[-1] for path in both])
    longest = np.repeat([each.max() for each in steps], 2)
    return _Ends(at[last], outward, widths[last], longest, np.repeat([s.sum() for s in steps], 2))


def _outward(path: FloatArray, back: float) -> FloatArray:
    """Return the direction of the last end from the place so far back along a path."""
    away = np.hypot(*(path - path[-1]).T)
    far = np.flatnonzero(away >= back)
    from_there = path[-1] - path[far[-1] if len(far) else 0]
    length = max(float(np.hypot(*from_there)), np.finfo(float).tiny)
    return np.asarray(from_there / length)


def _pairs(ends: _Ends) -> list[tuple[int, int]]:
    """Return the ends that go on from each other, the nearest first."""
    from scipy.spatial import cKDTree

    count = min(AROUND, len(ends.at))
    near = np.atleast_2d(cKDTree(ends.at).query(ends.at, k=count)[1])
    one = np.repeat(np.arange(len(ends.at)), count)
    pairs = np.unique(np.sort(np.column_stack((one, near.ravel())), axis=1), axis=0)
    one, other = pairs[pairs[:, 0] < pairs[:, 1]].T
    gap = ends.at[other] - ends.at[one]
    length = np.hypot(*gap.T)
    ahead = gap / np.maximum(length, np.finfo(float).tiny)[:, None]
    nearing = ((ends.outward[one] - ends.outward[other]) * ahead).sum(axis=1)
    along = (ends.outward[one] * ends.outward[other]).sum(axis=1)
    is_near = (length <= NEAR * np.maximum(ends.width[one], ends.width[other])) & (along < BESIDE)
    longest = np.maximum(ends.longest[one], ends.longest[other])
    goes_on = is_near | (length <= LONGER * longest) & (nearing > FACING)
    # A path shorter than a few gaps does not close upon itself.
    goes_on &= (one // 2 != other // 2) | (ends.length[one] > 4 * length)
    chosen = np.flatnonzero(goes_on)
    middle = ends.at[one] + ends.at[other]
    order = chosen[np.lexsort((*middle[chosen].T, length[chosen]))]
    return list(zip(one[order].tolist(), other[order].tolist(), strict=True))


def _walks(paths: list[IntArray], partner: IntArray) -> Iterator[Part]:
    """Yield the paths as they are joined: first those with ends, then rings."""
    is_done = np.zeros(len(paths), bool)
    starts = np.concatenate((np.flatnonzero(partner < 0), np.flatnonzero(partner >= 0)))
    for start in starts.tolist():
        if is_done[start // 2]:
            continue
        walk, end = [], start
        while end >= 0 and not is_done[end // 2]:
            is_done[end // 2] = True
            path = paths[end // 2]
            walk.append(path if end % 2 == 0 else path[::-1])
            end = int(partner[end ^ 1])
        yield np.concatenate(walk), end >= 0
