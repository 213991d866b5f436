"""Closing gaps: edges that are known are kept, and only what is missing between them is decided."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import IntArray, as_edges
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
    # `connect` allows two edges a point, so what meets in branches is laid over its answer.
    at_branch = (degrees[known] > 2).any(axis=1)
    beside = np.unique(known[at_branch])
    made = connect(delaunay, keep=known[~at_branch], ends=beside[degrees[beside] <= 2], **hints)
    added = made[(degrees[made] < 2).all(axis=1)]
    return as_edges(np.concatenate([known, added]), len(delaunay.points))
