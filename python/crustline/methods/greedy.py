"""Edges in the order of their lengths: curves that grow, and longest edges that go."""

from __future__ import annotations

from numpy.typing import ArrayLike

from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, select


def crawl(points: ArrayLike | Delaunay) -> IntArray:
    """Return the curves that crawl from short edges to the nearest neighbor, at both ends.

    A curve starts as the shortest edge between two points that are still free, one of them nearest
    to the other, and grows: an end goes to its nearest Delaunay neighbor, the last two points of
    the curve left out, and stops for good if that one has two edges already [1]_. If the points are
    an r-sample of a smooth closed curve with r < 1/3, and successive steps differ at most by a
    factor of 1.5, this joins exactly the points adjacent along the curve, of which a ring has four
    or more.

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
    Exact; no point has more than two edges. Of the two ends that with the shorter step goes first;
    of equally long edges that with the lexicographically smaller end comes first, then that with
    the smaller other end. What starts a curve, and what an end does at a point that has two edges,
    is our decision where [1]_ could be read in several ways. The condition: points of another
    strand are at least the local feature size away, which for r < 1/3 is farther than the next
    sample, and on the same strand only the two points that are left out are as near. Corners are
    crossed if the next sample is nearer than any of the other side; gaps are not. O(n log n) time,
    and quadratic in the number of points on one circle.

    References
    ----------
    .. [1] A. D. Parakkat, R. Muthuganapathy, "Crawl through Neighbors: A Simple Curve
       Reconstruction Algorithm", Computer Graphics Forum 35 (2016), 177-186.

    Examples
    --------
    >>> crawl([(0, 0), (1, 0), (2, 1), (1, 2), (0, 2), (-1, 1)]).tolist()
    [[0, 1], [0, 5], [1, 2], [2, 3], [3, 4], [4, 5]]
    """
    return select(points, "crawl")


def peel(points: ArrayLike | Delaunay) -> IntArray:
    """Return what is left of the Delaunay triangulation when long edges are peeled off.

    The longest edge of every Delaunay triangle goes, which leaves the graph of Urquhart [2]_; then
    the others are looked at, from the longest on, and one goes if an end still has more than two
    [1]_. If the points are an r-sample of a smooth closed curve with r < 1/3, this joins exactly
    the points adjacent along the curve.

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
    Exact; no point has more than two edges. A triangle is any three points on an empty circle, and
    loses an edge only if one is longer than both others, so ties do not decide; in the second half,
    of equally long edges that with the lexicographically larger smaller end goes first, then that
    with the larger other end. [1]_ also treats outliers, noise and crossings; this is its core. The
    condition: an edge that passes over a sample sees it under more than 90°, so it is longest in a
    triangle; any other edge between points that are not adjacent is at least as long as the local
    feature size at its ends, which for r < 1/3 is longer than their two edges along the curve, so
    it is peeled first. No theorem covers corners, open ends or outliers; ends of open curves stay
    joined to whatever is near. O(n log n) time, and quadratic in the number of points on one
    circle.

    References
    ----------
    .. [1] A. D. Parakkat, S. Methirumangalath, R. Muthuganapathy, "Peeling the Longest: A Simple
       Generalized Curve Reconstruction Algorithm", Computers & Graphics 74 (2018), 191-201.
    .. [2] R. B. Urquhart, "Algorithms for Computation of Relative Neighbourhood Graph",
       Electronics Letters 16 (1980), 556-557.

    Examples
    --------
    >>> peel([(0, 0), (2, 0), (2, 2), (0, 2), (3, 1)]).tolist()
    [[0, 1], [0, 3], [1, 4], [2, 3], [2, 4]]
    """
    return select(points, "peel")
