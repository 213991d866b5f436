"""Thinning (paper, §5): the fewest samples that still r-sample their reconstruction."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.curves import trace
from crustline.delaunay import Delaunay, as_delaunay
from crustline.interpolant import local_feature_size
from crustline.methods import as_selected
from crustline.scalars import as_share

# Beyond this many edges a step, thinning strides instead of looking at every sample as a start.
MOST_SERVED = 150
# What sums of the lengths of edges may be wrong by, as a share, and more.
ROUNDING = 1e-9


def thin(
    points: npt.ArrayLike | Delaunay, edges: npt.ArrayLike | None = None, *, r: float
) -> IntArray:
    """Return the samples to keep: the fewest that still r-sample the reconstruction.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Samples, dense ones.
    edges : array_like of int, shape (m, 2), optional
        Their reconstruction; by default the crust.
    r : float
        In (0, 1]. For r = 0.2 the crust of what is kept is in general the same curve, drawn with
        fewer points.

    Returns
    -------
    kept : ndarray of int64, shape (k,)
        Rows of `points`, sorted. Isolated points, endpoints and branches are always kept, and at
        least three points of each ring.

    Raises
    ------
    InputError
        If r is not in (0, 1], or the edges do not fit the points.

    Notes
    -----
    Every point p of the edges has a kept point within r · LFS(p), one of the two next to p along
    its curve; between the samples LFS is taken as low as a 1-Lipschitz function can be, and the
    distance to a kept point as large as a convex one. Where the samples themselves are not dense
    enough for that, all of them are kept. Of all choices with that property, one of the fewest,
    except on rings that r would leave with less than three points, and on curves from which more
    than a hundred samples are dropped for each one kept: those may keep one more. LFS is that of
    the reconstruction, estimated from the samples (`local_feature_size(points, edges)`), not that
    of the unknown curve. The time is proportional to the number of samples and, up to that
    hundred, to the number of them in a step.

    Examples
    --------
    A circle of a hundred points needs fifteen of them for r = 0.25:

    >>> from crustline.shapes import regular_polygon
    >>> len(thin(regular_polygon(100), r=0.25))
    15
    """
    r = as_share("r", r)
    delaunay = as_delaunay(points)
    selected = as_selected(delaunay, edges)
    if not len(selected):
        return np.arange(len(delaunay))
    extent = float(np.ptp(delaunay.points.xy, axis=0).max())
    lfs = np.minimum(local_feature_size(delaunay, selected), 8 * extent / r)
    curves = trace(delaunay, selected)
    kept = [curves.isolated]
    for curve in curves:
        i = curve.indices
        kept.append(i[_thinned(curve.points, lfs[i], r, curve.closed)])
    return np.unique(np.concatenate(kept))


def _thinned(points: FloatArray, lfs: FloatArray, r: float, closed: bool) -> IntArray:
    """Return the positions to keep of one traced curve."""
    k = len(points)
    if k <= 3:
        return np.arange(k)
    ahead = _served_edges(points, lfs, r, closed)
    if ahead is None:
        return _Strides(points, lfs, r, closed).kept()
    behind = _served_edges(points[::-1], lfs[::-1], r, closed)
    if behind is None:
        return _Strides(points, lfs, r, closed).kept()
    behind = behind[::-1]
    own = np.arange(k)
    if not closed:
        return _chain(_farthest(own + ahead, own - behind).tolist(), 0, k - 1)
    twice = np.arange(2 * k)
    steps = _farthest(twice + np.tile(ahead, 2), twice - np.tile(behind, 2))[:k] - own
    # No step longer than a third of the ring, or fewer than three points might be left of it.
    steps = np.clip(steps, 1, k // 3)
    following = np.concatenate([own + steps, own + steps + k]).tolist()
    # The fewest points of all have one within the first step.
    rings = (_chain(following, start, start + k)[:-1] for start in range(int(steps[0])))
    return np.sort(min(rings, key=len) % k)


def _chain(following: list[int], start: int, end: int) -> IntArray:
    """Return start, what follows it, and so on, and in the end the end."""
    chain = [start]
    while (ahead := following[chain[-1]]) < end:
        chain.append(ahead)
    return np.array([*chain, end], dtype=np.int64)


def _farthest(reach: npt.NDArray[Any], need: npt.NDArray[Any]) -> IntArray:
    """Return for each i the largest j > i with need[j] ≤ reach[i]: they serve all between."""
    lowest = np.minimum.accumulate(need[::-1])[::-1]
    farthest = np.searchsorted(lowest, reach, side="right") - 1
    return np.maximum(farthest, np.arange(len(reach)) + 1).astype(np.int64)


def _served_edges(points: FloatArray, lfs: FloatArray, r: float, closed: bool) -> FloatArray | None:
    """Return how many edges ahead of each position are within its reach, the last in part.

    None if that would be more than MOST_SERVED for the average position.
    """
    k = len(points)
    edges = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    last = k if closed else k - 1
    served = _surely_served(edges, lfs, r, closed)
    part = np.zeros(k)
    active = np.arange(last)
    while len(active := active[served[active] < (last if closed else last - active)]):
        if served.sum() > MOST_SERVED * k:
            return None
        near = (active + served[active]) % k
        part[active] = _served_part(points, lfs, edges, r, active, near)
        active = active[part[active] >= 1]
        served[active] += 1
        part[active] = 0.0
    return None if served.sum() > MOST_SERVED * k else served + part


def _surely_served(edges: FloatArray, lfs: FloatArray, r: float, closed: bool) -> IntArray:
    """Return how many edges ahead of each position are surely within its reach: way ≤ room.

    More than MOST_SERVED may be left out.
    """
    k, room = len(edges), _room(edges, lfs, r)
    if not closed:
        room[-1] = -1.0  # the edge from the end to the start is none
    # Row b: the least room of the 2^b edges ahead of each position, and their length.
    rooms, lengths = [room], [edges]
    while 2 ** len(rooms) <= min(4 * MOST_SERVED, k - 1):
        half = 2 ** (len(rooms) - 1)
        rooms.append(np.minimum(rooms[-1], np.roll(rooms[-1], -half)))
        lengths.append(lengths[-1] + np.roll(lengths[-1], -half))
    served, way, least = np.zeros(k, dtype=np.int64), np.zeros(k), np.full(k, np.inf)
    own = np.arange(k)
    for b in range(len(rooms) - 1, -1, -1):
        at = (own + served) % k
        farther, less = way + lengths[b][at], np.minimum(least, rooms[b][at])
        near = (farther <= less) & (served + 2**b < k)
        served += near * 2**b
        way, least = np.where(near, farther, way), np.where(near, less, least)
    return served


def _room(edges: FloatArray, lfs: FloatArray, r: float) -> FloatArray:
    """Return a bound for r · LFS along each edge: LFS falls by half the edge from an end, at most.

    A sample is at most as far as the way to it along the edges.
    """
    room: FloatArray = r * (np.minimum(lfs, np.roll(lfs, -1)) - edges / 2) * (1 - ROUNDING)
    return room


class _Strides:
    """Longest steps along one curve so dense that most samples need not be looked at."""

    def __init__(self, points: FloatArray, lfs: FloatArray, r: float, closed: bool) -> None:
        self.r, self.closed, self.k = r, closed, len(points)
        self.ahead = _Direction(points, lfs, r)
        self.behind = _Direction(points[::-1], lfs[::-1], r)

    def kept(self) -> IntArray:
        """Return the positions to keep, from position 0 on."""
        end = self.k if self.closed else self.k - 1
        longest = self.k // 3 if self.closed else self.k
        chain = [0]
        while (ahead := min(self._step(chain[-1]), chain[-1] + longest)) < end:
            chain.append(ahead)
        return np.array(chain if self.closed else [*chain, end], dtype=np.int64)

    def _step(self, i: int) -> int:
        """Return the largest j found that serves, with i, all between them."""
        reach = i + self._served(self.ahead, i)
        good, width = max(i + 1, math.floor(reach)), 1
        while self._serves(bad := good + width, reach) and bad - i < self.k:
            good, width = bad, 2 * width
        while bad - good > 1:
            middle = (good + bad) // 2
            good, bad = (middle, bad) if self._serves(middle, reach) else (good, middle)
        return good

    def _serves(self, j: int, reach: float) -> bool:
        """Return whether the sample at j serves all from reach on to itself."""
        if not self.closed and j >= self.k:
            return False
        return j - self._served(self.behind, self.k - 1 - j % self.k) <= reach

    def _served(self, way: _Direction, i: int) -> float:
        """Return how many edges on from position i are within its reach."""
        i %= self.k
        count = self.k if self.closed else self.k - 1 - i
        done, width = way.surely_served(i, count), 256
        while done < count:
            near = (i + np.arange(done, min(done + width, count))) % self.k
            part = _served_part(way.points, way.lfs, way.edges, self.r, np.full(len(near), i), near)
            short = np.flatnonzero(part < 1)
            if len(short):
                return done + int(short[0]) + float(part[short[0]])
            done, width = done + len(near), 2 * width
        return float(count)


class _Direction:
    """The samples of a curve in one of its two directions."""

    def __init__(self, points: FloatArray, lfs: FloatArray, r: float) -> None:
        self.points, self.lfs = points, lfs
        self.edges = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
        self.room = _room(self.edges, lfs, r)

    def surely_served(self, i: int, count: int) -> int:
        """Return how many of `count` edges on from position i are surely within its reach."""
        done, width, way, least = 0, 1024, 0.0, np.inf
        while done < count:
            near = (i + np.arange(done, min(done + width, count))) % len(self.edges)
            ways = way + np.cumsum(self.edges[near])
            rooms = np.minimum(least, np.minimum.accumulate(self.room[near]))
            short = np.flatnonzero(ways > rooms)
            if len(short):
                return done + int(short[0])
            way, least = float(ways[-1]), float(rooms[-1])
            done, width = done + len(near), 2 * width
        return count


def _served_part(
    points: FloatArray, lfs: FloatArray, edges: FloatArray, r: float, i: IntArray, near: IntArray
) -> FloatArray:
    """Return the share of the edge after `near` that is within r · LFS of the samples i.

    Along the edge the distance to a sample is convex, so at most linear between its ends; LFS falls
    from either end with slope at most 1, so it is least where the two slopes meet.
    """
    far = (near + 1) % len(points)
    length = edges[near]
    start, end = (np.hypot(*(points[at] - points[i]).T) for at in (near, far))
    slope = (end - start) / np.where(length > 0, length, 1.0)
    trough = np.clip((length + lfs[near] - lfs[far]) / 2, 0.0, length)
    falling = _first_excess(r * lfs[near] - start, -r - slope, trough)
    at_trough = r * np.maximum(lfs[near] - trough, lfs[far] - (length - trough))
    rising = _first_excess(at_trough - (start + slope * trough), r - slope, length - trough)
    reached = np.where(falling < trough, falling, trough + rising)
    return np.where(length > 0, reached / np.where(length > 0, length, 1.0), 1.0)


def _first_excess(room: FloatArray, growth: FloatArray, length: FloatArray) -> FloatArray:
    """Return how far along `length` the room, which grows linearly, stays at least 0."""
    shrinks = growth < 0
    last = np.where(shrinks, room / np.where(shrinks, -growth, 1.0), np.inf)
    return np.where(room < 0, 0.0, np.minimum(last, length))
