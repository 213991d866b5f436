"""α-shapes: edges that empty disks of one size touch, or disks that avoid other points as well."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, IntArray, as_points
from crustline.delaunay import Delaunay, points_and_how, select
from crustline.errors import InputError
from crustline.scalars import as_positive


def alpha_shape(
    points: ArrayLike | Delaunay,
    radius: float,
) -> IntArray:
    """Return the α-shape of points: edges that an empty disk of the given radius touches.

    An edge joins points i and j if some open disk of exactly `radius` touches both and holds no
    point [1]_. The edges bound what is left of the plane when all empty disks of that radius are
    taken away, with isolated edges. As the radius grows they become the convex hull.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    radius : float
        The radius of the disks, in the unit of the points. Positive and finite.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row);
        if `radius` is not positive and finite, or so far from
        the coordinates in size (some 300 orders of magnitude) that it cannot be scaled with them.

    Notes
    -----
    Exact in the double `radius`; a disk with more points on its circle joins all of them. There is
    no guarantee for curves sampled at uneven density: one radius must suit all. O(n log n) time,
    and quadratic in the number of points on one circle.

    References
    ----------
    .. [1] H. Edelsbrunner, D. G. Kirkpatrick, R. Seidel, "On the Shape of a Set of Points in the
       Plane", IEEE Transactions on Information Theory 29 (1983), 551-559.

    Examples
    --------
    >>> points = [(0, 0), (4, 0), (4, 3), (0, 3), (2, 1)]
    >>> alpha_shape(points, 100).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    >>> alpha_shape(points, 1.5).tolist()
    [[0, 3], [0, 4], [1, 2], [1, 4], [2, 4], [3, 4]]
    """
    size = as_positive("radius", radius)
    return select(points, "alpha-shape", size)


def a_shape(
    points: ArrayLike | Delaunay,
    extra: ArrayLike,
) -> IntArray:
    """Return the 𝒜-shape of points: edges with an empty disk that avoids extra points, too.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    no extra point [1]_. With the Voronoi vertices of the points as extra points it is the crust.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    extra : array_like of float, shape (k, 2)
        Points that the disks avoid, in the same unit. One that is also in `points` changes nothing.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row);
        likewise `extra`.

    Notes
    -----
    Exact in the coordinates as given. `Delaunay.circumcenters` are Voronoi vertices rounded to
    doubles, which can break ties that the crust keeps. All points of one empty circle are joined.
    O(n log n) time, and quadratic in the number of points on one circle.

    References
    ----------
    .. [1] M. Melkemi, "𝒜-Shapes of a Finite Point Set", Symposium on Computational Geometry (1997),
       367-369.

    Examples
    --------
    >>> from crustline import crust
    >>> points = [(0, 0), (4, 0), (4, 4), (0, 4)]
    >>> a_shape(points, [(2, 2)]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    >>> a_shape(points, [(2, 2)]).tolist() == crust(points).tolist()
    True
    """
    own, (threads, progress) = points_and_how(points)
    together = np.concatenate((own.xy, _as_extra(extra)))
    return Delaunay(together, threads=threads, progress=progress).select("a-shape", len(own))


def _as_extra(extra: ArrayLike) -> FloatArray:
    """Return the extra points of `a_shape` as an array, or an error that names them."""
    try:
        return as_points(extra)
    except InputError as error:
        raise InputError(f"extra, as {error}") from None
