"""The center line of polygons: the medial axis of their sides, from samples dense enough."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.curves import Curves
from crustline.delaunay import Delaunay
from crustline.errors import InputError, shown
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.points import Points
from crustline.scalars import as_real

__all__ = ["center_line"]

#: Where rings cross, no sample is near enough: pieces of this part of the whole extent tell.
_SHORTEST = 1e-11
#: Into how many pieces a round cuts a side at the most.
_PIECES = 8
#: How many samples of the sides an axis is made of at the most: they need a few gigabytes.
_MOST = 10**7


@dataclass(frozen=True)
class _Sides:
    """Pieces of the sides of polygons.

    Attributes
    ----------
    xy : ndarray of float64, shape (n, 2)
        Their ends.
    corners : ndarray of int64, shape (n, 2)
        The two corners whose side each end is on; twice the same for a corner.
    pieces : ndarray of int64, shape (m, 2)
        From one end to the other, with the polygon to the left.
    both : ndarray of bool, shape (m,)
        Whether the polygon is to the right, too: the piece is of a line within it.
    """

    xy: FloatArray
    corners: IntArray
    pieces: IntArray
    both: BoolArray

    @property
    def lengths(self) -> FloatArray:
        """How long each piece is."""
        return _lengths(self.xy[self.pieces[:, 1]] - self.xy[self.pieces[:, 0]])


def center_line(curves: Curves, *, accuracy: float = 0.01) -> MedialAxis:
    """Return the medial axis of polygons: of their sides, not of their corners alone.

    Parameters
    ----------
    curves : Curves
        Rings, which bound the polygons (even-odd), and polylines within them. Where polygons are
        in a file, `crustline.read_curves` gives them.
    accuracy : float, default 0.01
        How far the axis may be off, as a part of the local width; in [1e-6, 1].

    Returns
    -------
    medial_axis : MedialAxis
        Its inner part. Its points are samples of the sides, the corners first, in their order.

    Raises
    ------
    InputError
        If no curve is a ring, rings cross each other, or `accuracy` asks for more than 10⁷ samples.

    Notes
    -----
    Each side is cut into pieces shorter than √(16·accuracy) times the radius of the circle through
    a piece and the sample across, and until no sample across sees it at more than 90°. Between
    parallel sides at a distance w pieces of a length s put the axis at most s²/8w off, half of what
    is allowed. Each convex corner has an arm of the axis; it ends at most `accuracy` times the
    greatest width before the corner. `MedialAxis.prune` removes what arms stand for little.

    Examples
    --------
    >>> from crustline.curves import trace
    >>> corners = [(0, 0), (10, 0), (10, 1), (0, 1)]
    >>> axis = center_line(trace(corners, [(0, 1), (1, 2), (2, 3), (0, 3)]))
    >>> along = axis.vertices[(axis.vertices[:, 0] > 0.5) & (axis.vertices[:, 0] < 9.5)]
    >>> bool(len(along)) and bool((abs(along[:, 1] - 0.5) < 0.01).all())
    True
    """
    if not isinstance(curves, Curves):
        raise InputError(f"curves is {shown(curves)}: pass what trace or reconstruct returns")
    sides = _sides_of(curves)
    accuracy = as_real("accuracy", accuracy, "in [1e-6, 1]", lambda x: 1e-6 <= x <= 1)
    part = np.sqrt(16 * accuracy)
    shortest = _SHORTEST * float(np.ptp(sides.xy, axis=0).max())
    while True:
        delaunay = Delaunay(Points(sides.xy, crs=curves.points.crs))
        counts = _pieces_needed(sides, delaunay, part, accuracy)
        if (counts == 1).all():
            return medial_axis(delaunay, np.sort(sides.pieces, axis=1)).part("inner")
        if (sides.lengths[counts > 1] < shortest).any():
            raise InputError("rings cross or touch each other, and bound no polygons: correct them")
        sides = _cut(sides, counts)


def _sides_of(curves: Curves) -> _Sides:
    """Return the sides as they are; corners on one spot are one."""
    if not curves.closed.any():
        raise InputError("no curve is a ring, so that there is no polygon: close them")
    xy, first, rows = np.unique(curves.points.xy, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    place = np.argsort(order)[rows.reshape(-1)]
    pieces, both = [], []
    for feature in curves.oriented("rfc7946").features(polygons=True):
        for run in () if feature.kind == "points" else feature.runs:
            ends = place[np.stack([run[:-1], run[1:]], axis=1)]
            pieces.append(ends[ends[:, 0] != ends[:, 1]])
            both.append(np.full(len(pieces[-1]), feature.kind == "line"))
    used, ends = np.unique(np.concatenate(pieces), return_inverse=True)
    corners = np.repeat(np.arange(len(used))[:, None], 2, axis=1)
    return _Sides(xy[order][used], corners, ends.reshape(-1, 2), np.concatenate(both))


def _pieces_needed(sides: _Sides, delaunay: Delaunay, part: float, accuracy: float) -> IntArray:
    """Return how many pieces each piece is to be cut into; 1 where it is short enough."""
    left, right = (_across(delaunay, sides.pieces[:, ::step]) for step in (1, -1))
    absent = (left < 0) & (right < 0)
    right = np.where(sides.both, right, left)
    lengths = sides.lengths
    counts = np.ones(len(lengths), np.int64)
    widest = max(_width(sides, delaunay, each).max(initial=0.0) for each in (left, right))
    for triangle in (left, right):
        allowed = _allowed(sides, delaunay, triangle, part)
        near = _at_a_corner(sides, delaunay, triangle)
        allowed = np.where(near, np.maximum(allowed, accuracy * widest), allowed)
        with np.errstate(divide="ignore", over="ignore"):
            asked = lengths / allowed
        if asked.sum(where=triangle >= 0) > _MOST:
            raise InputError(
                f"accuracy: {accuracy:g} asks for more than {_MOST:,} samples: allow a larger part"
            )
        needed = np.ceil(np.minimum(asked, _PIECES))
        counts = np.maximum(counts, np.where(triangle < 0, 1, needed).astype(np.int64))
    return np.where(absent, 2, counts)


def _across(delaunay: Delaunay, pieces: IntArray) -> IntArray:
    """Return 3 times the triangle to the left of each piece, plus the place of the piece in it.

    -1 stands for a piece that is no edge of the triangulation.
    """
    triangles, count = delaunay.triangles, len(delaunay.points)
    starts = triangles.ravel()
    keys = starts * count + np.roll(triangles, -1, axis=1).ravel()
    order = np.argsort(keys)
    wanted = pieces[:, 0] * count + pieces[:, 1]
    if not len(keys):
        return np.full(len(pieces), -1)
    places = order[np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)]
    return np.where(keys[places] == wanted, places, -1)


def _apex(delaunay: Delaunay, places: IntArray) -> IntArray:
    return delaunay.triangles[places // 3, (places + 2) % 3]


def _width(sides: _Sides, delaunay: Delaunay, places: IntArray) -> FloatArray:
    """Return how far the sample across is from the middle of each piece that has one."""
    known = np.flatnonzero(places >= 0)
    middle = sides.xy[sides.pieces[known]].mean(axis=1)
    return _lengths(sides.xy[_apex(delaunay, places[known])] - middle)


def _allowed(sides: _Sides, delaunay: Delaunay, places: IntArray, part: float) -> FloatArray:
    """Return how long each piece may be, given the sample across."""
    apex = sides.xy[_apex(delaunay, places)]
    one, other = (sides.xy[sides.pieces[:, k]] - apex for k in (0, 1))
    allowed: FloatArray = part * delaunay.circumradii[places // 3]
    # A right angle, which cut sides of equal length make, counts as seen well enough.
    obtuse = (one * other).sum(axis=1) < -1e-9 * _lengths(one) * _lengths(other)
    return np.where(obtuse, np.minimum(allowed, _lengths(one - other) / 2), allowed)


def _at_a_corner(sides: _Sides, delaunay: Delaunay, places: IntArray) -> BoolArray:
    """Return whether the sample across is on a side that meets the piece's own."""
    own = sides.corners[sides.pieces].reshape(-1, 4)
    across = sides.corners[_apex(delaunay, places)]
    near: BoolArray = (own[:, :, None] == across[:, None, :]).any(axis=(1, 2))
    return near


def _cut(sides: _Sides, counts: IntArray) -> _Sides:
    """Return the sides with each piece cut into so many of equal length."""
    piece = np.repeat(np.arange(len(counts)), counts)
    step = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
    inner = step > 0
    start, end = sides.pieces[piece].T
    t = (step / counts[piece])[:, None]
    made = (sides.xy[start] + t * (sides.xy[end] - sides.xy[start]))[inner]
    own = sides.corners[sides.pieces[piece[inner]]].reshape(-1, 4)
    corners = np.stack([own.min(axis=1), own.max(axis=1)], axis=1)
    first = np.where(inner, len(sides.xy) + np.cumsum(inner) - 1, start)
    last = step == counts[piece] - 1
    second = np.where(last, end, np.roll(first, -1))
    return _Sides(
        np.concatenate([sides.xy, made]),
        np.concatenate([sides.corners, corners]),
        np.stack([first, second], axis=1),
        sides.both[piece],
    )


def _lengths(steps: FloatArray) -> FloatArray:
    return np.hypot(steps[:, 0], steps[:, 1])
