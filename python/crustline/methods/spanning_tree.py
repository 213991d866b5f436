"""The Euclidean minimum spanning tree."""

from __future__ import annotations

from numpy.typing import ArrayLike

from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, select


def minimum_spanning_tree(points: ArrayLike | Delaunay) -> IntArray:
    """Return the Euclidean minimum spanning tree: the shortest edges that join all points.

    The tree on the points of the least total length [1]_. Of equally long edges that one comes
    first whose lexicographically smaller end is smaller, then that whose other end is, so there is
    one tree.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row).

    Notes
    -----
    Exact. A part of the relative neighborhood graph. A tree has no rings, so it cannot close a
    curve, and it branches. O(n log n) time.

    References
    ----------
    .. [1] J. B. Kruskal, "On the Shortest Spanning Subtree of a Graph and the Traveling Salesman
       Problem", Proceedings of the American Mathematical Society 7 (1956), 48-50.

    Examples
    --------
    >>> minimum_spanning_tree([(0, 0), (1, 0), (1, 1), (0, 1)]).tolist()
    [[0, 1], [0, 3], [2, 3]]
    """
    return select(points, "minimum-spanning-tree")
