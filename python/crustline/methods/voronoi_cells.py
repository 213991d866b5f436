"""Edges by the shape of Voronoi cells: across the normals, and away from the medial axis."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, select
from crustline.scalars import as_positive, as_real


def conservative_crust(points: ArrayLike | Delaunay, ratio: float = 1.0) -> IntArray:
    """Return the conservative crust: edges that keep away from the medial axis of the others.

    The largest set of edges of which each has an empty disk that it is a diameter of (a Gabriel
    edge), and meets the following: the disk about its middle of `ratio` times that radius holds no
    Voronoi vertex, and meets no Voronoi edge of two points that the set does not join. So what
    is not joined makes a medial axis, and what is joined keeps its distance from it [1]_. If the
    points are an r-sample of a smooth closed curve with r < 1 / (2 ratio + 3), for ratio ≥ 1, this
    joins exactly the points adjacent along the curve.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    ratio : float, default 1.0
        The size of the disks, positive and finite. A larger one gives a subset.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row); if
        `ratio` is not positive and finite.

    Notes
    -----
    Exact in the double `ratio`; the disks are open, so touching keeps the edge. There is one
    largest set: an edge leaves it when its disk meets the dual of one that has left, in whatever
    order. From `ratio` = 1 on it is a part of the crust. Edges with a dual of no length, the
    diagonals of cocircular points, are never in.

    [1]_ asks of any points which edges a smooth curve, open or closed, would justify, and this is
    that idea in our words: it joins too little rather than too much, and so finds open ends and
    leaves gaps. The condition: a disk of an edge between adjacent samples at distance d that meets
    a Voronoi edge of samples that are not adjacent shows a point of the medial axis within (ratio +
    1) d, which is less than the local feature size; and for r < 0.252 no other edge is in the
    crust. Corners end it. O(n log n) time on samples of curves; a disk that meets k cells costs k.

    References
    ----------
    .. [1] T. K. Dey, K. Mehlhorn, E. A. Ramos, "Curve Reconstruction: Connecting Dots with Good
       Reason", Computational Geometry: Theory and Applications 15 (2000), 229-244.

    Examples
    --------
    >>> points = [(0, 0), (2, 0), (4, 0), (6, 0), (8, 0), (5, 3)]
    >>> conservative_crust(points).tolist()
    [[0, 1], [1, 2], [2, 3], [3, 4]]
    >>> conservative_crust(points, 1.5).tolist()
    [[0, 1], [1, 2], [3, 4]]
    """
    return select(points, "conservative-crust", as_positive("ratio", ratio))


def gathan(points: ArrayLike | Delaunay, angle: float = 1.4, ratio: float = 1.0) -> IntArray:
    """Return the edges across the normals that long Voronoi cells show, also at sharp corners.

    The normal of a point leads to its pole, the farthest Voronoi vertex of its cell; on the convex
    hull, where the cell has no end, it is across the chord of the two neighbors on the hull. On
    either side of the normal a point asks for its shortest Delaunay edge of those that make at most
    `angle` with the tangent, and of which the pole is at least `ratio` times as far. Two points
    that ask for each other are joined [1]_.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    angle : float, default 1.4 (80°)
        The largest angle between an edge and the tangent, in radians, from 0 to π / 2. At a corner
        of θ edges make (π - θ) / 2 with the tangent of the pole, so this admits corners of 20°.
    ratio : float, default 1.0
        The least of the distance to the pole over the length of the edge, from 0 on.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row); if
        `angle` or `ratio` is out of its range.

    Notes
    -----
    Exact in the sine of `angle`, rounded to a double, and in `ratio`; equality keeps the edge.
    Equally short edges, and those for any of equally far poles, are all asked for; diagonals of
    cocircular points are not. No point of general position has more than two edges.

    [1]_ proves nothing; a later algorithm of the authors, GathanG, has a proof under a sampling
    condition for corners, and is not this one. Which edges it asks both conditions of is from the
    paper's idea; the two defaults and the normal on the hull are ours, the defaults the best of
    those tried on curves with corners. O(n log n) time.

    References
    ----------
    .. [1] T. K. Dey, R. Wenger, "Reconstructing Curves with Sharp Corners", Computational Geometry:
       Theory and Applications 19 (2001), 89-99.

    Examples
    --------
    >>> gathan([(0, 0), (2, 0), (4, 0), (4, 2), (4, 4), (2, 5), (0, 4), (0, 2)]).tolist()
    [[0, 1], [0, 7], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7]]
    """
    steepest = as_real(
        "angle", angle, "in radians, from 0 to pi / 2", lambda x: 0 <= x <= math.pi / 2
    )
    least = as_real("ratio", ratio, "a finite number of at least 0", lambda x: x >= 0)
    return select(points, "gathan", math.sin(steepest), least)
