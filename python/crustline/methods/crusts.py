"""Crusts: edges along the curve, chosen by the Voronoi diagram, or by the nearest neighbors."""

from __future__ import annotations

from numpy.typing import ArrayLike

from crustline.arrays import IntArray, as_edges
from crustline.delaunay import Delaunay, select


def crust(points: ArrayLike | Delaunay) -> IntArray:
    """Return the crust of points: edges with an empty disk that avoids the Voronoi vertices.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    no Voronoi vertex of the points [1]_. If the points are an r-sample of a smooth closed curve
    with r < 0.252, the crust joins exactly the points adjacent along the curve (Theorems 14
    and 15).

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted. Empty if there are fewer than two distinct
        points.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row).

    Notes
    -----
    Exact: the answer does not depend on rounding, on the order of rows, or on ties in the
    triangulation. O(n log n) time: one triangulation and little more. In general position a point
    has degree at most three.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135. Sections 2 and 8.

    Examples
    --------
    >>> crust([(0, 0), (1, 0), (1, 1), (0, 1)]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    """
    if isinstance(points, Delaunay):
        return points.cached("crust", lambda: points.select("crust"))
    return select(points, "crust")


def as_selected(delaunay: Delaunay, edges: ArrayLike | None) -> IntArray:
    """Return edges of the points, i < j, sorted and unique; the crust if none are given."""
    return crust(delaunay) if edges is None else as_edges(edges, len(delaunay))


def one_step_crust(points: ArrayLike | Delaunay) -> IntArray:
    """Return the one-step crust of points: edges whose opposite angles sum to at most 90°.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    neither of the centers of the edge's own Delaunay triangles [1]_. The crust asks this of all
    Voronoi vertices, so it is a subset.

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
    Exact; an angle sum of exactly 90° keeps the edge, but on the hull, where there is only one
    angle, 90° does not. O(n log n) time.

    References
    ----------
    .. [1] C. Gold, J. Snoeyink, "A One-Step Crust and Skeleton Extraction Algorithm", Algorithmica
       30 (2001), 144-163.

    Examples
    --------
    >>> one_step_crust([(0, 0), (1, 0), (1, 1), (0, 1)]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    """
    return select(points, "one-step-crust")


def rcgh(points: ArrayLike | Delaunay) -> IntArray:
    """Return the Delaunay edges that are no longer than their dual Voronoi edges.

    The rule of Robinson, Colchester, Griffin and Hawkes [1]_: a Delaunay edge lies along the
    boundary if the Voronoi edge that crosses it is at least as long, and else across. Edges of the
    hull, whose Voronoi edges have no end, are kept.

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
    Exact; equal lengths keep the edge. No guarantee is known. O(n log n) time.

    References
    ----------
    .. [1] G. P. Robinson, A. C. F. Colchester, L. D. Griffin, D. J. Hawkes, "Integrated Skeleton
       and Boundary Shape Representation for Medical Image Interpretation", European Conference on
       Computer Vision (1992), 725-729.

    Examples
    --------
    >>> rcgh([(0, 0), (4, 0), (8, 0), (0, 1), (4, 1), (8, 1)]).tolist()
    [[0, 1], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [4, 5]]
    """
    return select(points, "rcgh")


def nn_crust(points: ArrayLike | Delaunay) -> IntArray:
    """Return the NN-crust of points: edges to the nearest, and to the nearest on the other side.

    Each point i is joined with its nearest point j, and with the nearest of its Delaunay neighbors
    k such that the angle j i k is at least 90° [1]_. If the points are an r-sample of a smooth
    closed curve with r ≤ 1/3, the NN-crust joins exactly the points adjacent along the curve.

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
    Exact; equally near points are all joined, and among cocircular points all diagonals count as
    Delaunay edges, so no answer depends on the triangulation. At most two edges a point are asked
    for in general position, but a point may have more. O(n log n) time, and quadratic in the number
    of points on one circle.

    References
    ----------
    .. [1] T. K. Dey, P. Kumar, "A Simple Provable Algorithm for Curve Reconstruction", Symposium on
       Discrete Algorithms (1999), 893-894.

    Examples
    --------
    >>> nn_crust([(0, 0), (3, 0), (5, 2), (3, 5), (0, 3)]).tolist()
    [[0, 1], [0, 4], [1, 2], [2, 3], [3, 4]]
    """
    return select(points, "nn-crust")
