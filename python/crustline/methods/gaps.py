"""Closing gaps: edges that are known are kept, and only what is missing between them is decided."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, IntArray, as_edges
from crustline.delaunay import Delaunay, as_delaunay
from crustline.methods.connect import connect


def close_gaps(points: ArrayLike | Delaunay, edges: ArrayLike, **hints: Any) -> IntArray:
    """Return edges, and those that `connect` adds where a point has fewer than two of them.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite.
    edges : array_like of int, shape (m, 2)
        Rows of `points`: the edges that are known, such as the segments of a drawing.
    **hints
        Those of `connect` but for `keep` and `ends`, such as ``max_edge="3x"``.

    Returns
    -------
    edges : ndarray of int64, shape (k, 2)
        All edges that were given, and others between points that have one of them or none; i < j in
        each row, rows sorted. No point has more than two, unless it was given them.

    Raises
    ------
    InputError
        If points or edges do not fit; the message names the row.

    See Also
    --------
    connect : with ``keep=``, the same for edges of which no three meet.

    Notes
    -----
    Cost and guarantees are those of `connect`.

    Examples
    --------
    Three sides of a square, in two pieces:

    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> close_gaps(square, [(0, 1), (2, 3)]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    """
    delaunay = as_delaunay(points)
    known = as_edges(edges, len(delaunay.points))
    degrees = np.bincount(known.ravel(), minlength=len(delaunay.points))
    at_branch = (degrees[known] > 2).any(axis=1)
    # `connect` allows two edges a point, so what meets in branches is laid over its answer, and of
    # two edges that it gives to the end of such an arm the shorter one is taken.
    made = connect(delaunay, keep=known[~at_branch], **hints)
    added = made[(degrees[made] < 2).all(axis=1)]
    is_arm = np.zeros(len(degrees), bool)
    is_arm[known[at_branch]] = True
    at_arm = is_arm[added].any(axis=1)
    taken = _with_room(added[at_arm], delaunay.points.xy, np.where(is_arm, 2 - degrees, 2))
    return as_edges(np.concatenate([known, added[~at_arm], taken]), len(delaunay.points))


def _with_room(edges: IntArray, xy: FloatArray, room: IntArray) -> IntArray:
    """Return edges, the shortest first, as long as both ends have room for them."""
    lengths = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T)
    taken = []
    for edge in edges[np.lexsort((edges[:, 1], edges[:, 0], lengths))].tolist():
        if (room[edge] > 0).all():
            room[edge] -= 1
            taken.append(edge)
    return np.array(taken, np.int64).reshape(-1, 2)
