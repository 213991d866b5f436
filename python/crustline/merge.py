"""Points that differ by rounding, merged: one point stands for each group of near ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, IntArray, read_only
from crustline.delaunay import Delaunay, as_delaunay
from crustline.errors import InputError
from crustline.points import Points
from crustline.scalars import as_length

__all__ = ["Merged", "merge"]

#: A group wider than this many tolerances is a chain of points, not one point that was rounded.
WIDEST = 3.0
#: Points nearer to each other than this part of the distance to all others look like one point.
NEAR = 1e-6


@dataclass(frozen=True, eq=False)
class Merged:
    """Points of which near ones were merged, and the way back to the rows.

    Attributes
    ----------
    points : Points
        The points that are left, in the order of their rows, with what they carry.
    rows : ndarray of int64, shape (k,)
        The row of each of them in the points that were given.
    merged : ndarray of int64, shape (d, 2)
        A row that was merged, and the row that stands for it; sorted.
    """

    points: Points
    rows: IntArray
    merged: IntArray

    def snapped(self, points: Points) -> Points:
        """Return all the points that were given, those merged at the place of what stands for them.

        Merged rows are repeated points then, with all their rows as they were.
        """
        xy = points.xy.copy()
        xy[self.merged[:, 0]] = xy[self.merged[:, 1]]
        kept = {name: getattr(points, name) for name in ("z", "columns", "crs", "names")}
        return Points(xy, **kept)

    @property
    def stands(self) -> IntArray:
        """For each row that was given, shape (n,), the one that stands for it."""
        stands = np.arange(len(self.rows) + len(self.merged))
        stands[self.merged[:, 0]] = self.merged[:, 1]
        return stands

    def __repr__(self) -> str:
        return f"<Merged: {len(self.rows):,} points, {len(self.merged):,} rows merged>"


def merge(points: ArrayLike | Delaunay, tolerance: float) -> Merged:
    """Return points of which those within a tolerance of each other are merged into one.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite.
    tolerance : float
        The greatest distance, in the unit of the points, at which two points are one. Not negative.

    Returns
    -------
    merged : Merged
        The points that are left and their rows; the rows that were merged are in `merged.merged`.

    Raises
    ------
    InputError
        If the points or the tolerance do not fit, or a group is wider than three tolerances: then
        the message names two of its rows.

    Notes
    -----
    Groups are the connected components of pairs within the tolerance, whatever the order of the
    rows; the lexicographically smallest point stands for each, at its first row. A minimum spanning
    tree joins the points of a group by edges within the tolerance, and it is part of the Delaunay
    triangulation, so only Delaunay edges are looked at. O(n log n) time.

    Examples
    --------
    >>> near = merge([(0, 0), (1, 0), (1 + 1e-9, 0), (0, 1)], 1e-6)
    >>> near.rows.tolist(), near.merged.tolist()
    ([0, 1, 3], [[2, 1]])
    """
    limit = as_length("tolerance", tolerance)
    delaunay = as_delaunay(points)
    xy = delaunay.points.xy
    steps = xy[delaunay.edges[:, 0]] - xy[delaunay.edges[:, 1]]
    near = delaunay.edges[np.hypot(steps[:, 0], steps[:, 1]) <= limit]
    groups = _components(len(xy), np.concatenate([near, delaunay.duplicates]))
    stands = _representatives(xy, groups)
    _refuse_wide(xy, stands, limit)
    rows = np.flatnonzero(stands == np.arange(len(xy)))
    gone = np.flatnonzero(stands != np.arange(len(xy)))
    merged = np.stack([gone, stands[gone]], axis=1)
    return Merged(delaunay.points.select(rows), read_only(rows), read_only(merged))


def near_tolerance(points: ArrayLike | Delaunay) -> float | None:
    """Return a tolerance for `merge` if some points look like one point that was rounded, or None.

    They do if they are nearer to each other than 10⁻⁶ of the distance from any of them to the
    nearest point that is not one of them, and no wider apart than `merge` accepts.

    Examples
    --------
    >>> near_tolerance([(0, 0), (1, 0), (1 + 1e-9, 0), (0, 1)])
    1.1e-09
    >>> near_tolerance([(0, 0), (1, 0), (0, 1)]) is None
    True
    """
    delaunay = as_delaunay(points)
    xy, edges = delaunay.points.xy, delaunay.edges
    with np.errstate(over="ignore"):
        lengths = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T)
    if not len(edges) or lengths.min() > NEAR * lengths.max():
        return None
    # Nearest points are Delaunay neighbors, so only points with an edge as short can be near.
    may_be_near = np.zeros(len(xy), bool)
    may_be_near[edges[lengths <= NEAR * lengths.max()]] = True
    some = may_be_near[edges].any(axis=1)
    rows, ends = np.unique(edges[some], return_inverse=True)
    return _tolerance_of(xy[rows], ends.reshape(-1, 2), lengths[some])


def _tolerance_of(xy: np.ndarray, edges: IntArray, lengths: FloatArray) -> float | None:
    """Return the tolerance that takes all groups of near points, given all edges at them."""
    short = lengths <= NEAR * _length_after_jump(edges, lengths, len(xy))[edges].min(axis=1)
    group = _components(len(xy), edges[short])
    within = group[edges[:, 0]] == group[edges[:, 1]]
    widest = np.zeros(len(xy))
    np.maximum.at(widest, group[edges[short][:, 0]], lengths[short])
    around = np.full(len(xy), np.inf)
    for end in (0, 1):
        np.minimum.at(around, group[edges[~within][:, end]], lengths[~within])
    low, high = (np.full((len(xy), 2), sign * np.inf) for sign in (1, -1))
    np.minimum.at(low, group, xy)
    np.maximum.at(high, group, xy)
    span = np.hypot(*np.where(widest > 0, (high - low).T, 0.0))
    fits = (widest > 0) & (widest <= NEAR * around) & (span <= WIDEST * widest)
    return _rounded_up(float(widest[fits].max())) if fits.any() else None


def _length_after_jump(edges: IntArray, lengths: FloatArray, n: int) -> FloatArray:
    """Return for each row the first length of its edges that is a million times the one before.

    Where there is none it is 0: nothing is near then.
    """
    ends, both = edges.T.ravel(), np.tile(lengths, 2)
    order = np.lexsort((both, ends))
    ends, both = ends[order], both[order]
    jumps = (ends[1:] == ends[:-1]) & (both[:-1] <= NEAR * both[1:])
    after = np.zeros(n)
    where = np.flatnonzero(jumps)[::-1]  # so that the first one remains
    after[ends[where]] = both[where + 1]
    return after


def _rounded_up(length: float) -> float:
    """Return a length with two digits, at least a twentieth above a given one."""
    digits = 1 - int(np.floor(np.log10(1.05 * length)))
    return float(f"{np.ceil(1.05 * length * 10.0**digits) / 10.0**digits:.1e}")


def _components(n: int, edges: IntArray) -> IntArray:
    """Return for each of n rows the smallest row of its component."""
    label = np.arange(n)
    while True:
        least = label[edges].min(axis=1)
        before = label.copy()
        for end in (0, 1):
            np.minimum.at(label, label[edges[:, end]], least)
            np.minimum.at(label, edges[:, end], least)
        label = label[label]
        if np.array_equal(label, before):
            return label


def _representatives(xy: np.ndarray, groups: IntArray) -> IntArray:
    """Return for each row that of the lexicographically smallest point of its group."""
    order = np.lexsort((np.arange(len(xy)), xy[:, 1], xy[:, 0], groups))
    starts = np.flatnonzero(np.diff(groups[order], prepend=-1))
    first = np.empty(len(xy), np.int64)
    first[groups[order[starts]]] = order[starts]
    return first[groups]


def _refuse_wide(xy: np.ndarray, stands: IntArray, limit: float) -> None:
    order = np.argsort(stands, kind="stable")
    starts = np.flatnonzero(np.diff(stands[order], prepend=-1))
    for group in np.split(order, starts[1:]):
        # Two points within the tolerance are never too wide.
        if len(group) < 3 or np.hypot(*np.ptp(xy[group], axis=0)) <= WIDEST * limit:
            continue
        for row in group.tolist():
            far = np.hypot(*(xy[group] - xy[row]).T)
            if far.max() > WIDEST * limit:
                other = int(group[np.argmax(far)])
                raise InputError(
                    f"rows {row} and {other} are {far.max():g} apart, in one chain of points "
                    f"within the tolerance {limit:g}: it is too large, pass less"
                )
