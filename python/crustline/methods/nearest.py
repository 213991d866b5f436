"""Edges by distances alone: to the nearest, and to the nearest on the other side."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, select
from crustline.scalars import as_real

#: Adjacent samples are seen from the one between them under at least this angle in a 0.66-sample.
COMPATIBLE = math.pi - 4 * math.asin(0.66 / 2)


def hnn_crust(points: ArrayLike | Delaunay) -> IntArray:
    """Return the HNN-crust of points: mutual edges to the nearest and to the half neighbor.

    Each point i asks for its nearest point j, and for its half neighbor: the nearest of its
    Delaunay neighbors that are no nearer to j than to i. Two points that ask for each other are
    joined [1]_. If the points are an r-sample of a smooth closed curve with r < 0.47, the HNN-crust
    joins exactly the points adjacent along the curve.

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
    Exact; equally near points are all asked for, a point as near to j as to i counts, and among
    cocircular points all diagonals are Delaunay edges. No point of general position has more
    than two edges. The half-plane admits turns down to 60°, where the NN-crust stops at 90°, so
    sharper corners come out right; no theorem covers corners, open ends or outliers. The paper also
    proves it for ρ < 0.9, ρ being the distance to the nearest sample over the reach, the least
    local feature size of the stretch between two samples. It lets the two ends of an edge agree
    where dense samples leave no choice; that both must is our decision for all others. O(n log n)
    time, and quadratic in the number of points on one circle.

    References
    ----------
    .. [1] S. Ohrhallinger, S. A. Mitchell, M. Wimmer, "Curve Reconstruction with Many Fewer
       Samples", Computer Graphics Forum 35 (2016), 167-176.

    Examples
    --------
    A corner of 67°:

    >>> hnn_crust([(-2, 3), (-1.3, 2), (-0.6, 1), (0, 0), (0.6, 1), (1.3, 2), (2, 3)]).tolist()
    [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6]]
    """
    return select(points, "hnn-crust")


def compatible_crust(points: ArrayLike | Delaunay, angle: float = COMPATIBLE) -> IntArray:
    """Return the NN-crust with a larger angle: mutual edges to the nearest and a compatible point.

    Each point i asks for its nearest point j, and for the nearest of its Delaunay neighbors k that
    are compatible with it: the angle j i k is at least `angle`. Two points that ask for each other
    are joined. If the points are an r-sample of a smooth closed curve with r ≤ 1/3, this joins
    exactly the points adjacent along the curve.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    angle : float, default π - 4 arcsin 0.33 ≈ 1.796 (103°)
        The least angle between the two edges of a point, in radians, between 0 and π. At π / 2 this
        is the NN-crust, edges that only one end asks for left out.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row); if
        `angle` is not between 0 and π.

    Notes
    -----
    Bjerkevik [1]_ proves that an NN-crust whose second edge has to be compatible with the first
    reconstructs every 0.66-sample, and that no method can for all 0.72-samples. This follows that
    idea, not his text: compatible is decided by the angle alone, whose default is the least under
    which adjacent samples of a 0.66-sample are seen (Lemma 10 of [2]_). Proven for it is what holds
    for the NN-crust [3]_, r ≤ 1/3: there, too, the right neighbor is compatible, and a larger angle
    only leaves out others. At r = 0.66 all sparsest samples of all curves tried came out right
    (`tests/test_methods.py`). Corners sharper than `angle` are cut, so it is worse than the
    HNN-crust on samples with corners, and no theorem covers open ends or outliers.

    Exact in the cotangent of `angle`, rounded to a double; equality keeps the edge, and equally
    near points are all asked for. O(n log n) time, and quadratic in the number of points on one
    circle.

    References
    ----------
    .. [1] H. B. Bjerkevik, "Tighter Bounds for Reconstruction from ε-Samples", Symposium on
       Computational Geometry (2022), 9:1-9:17.
    .. [2] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135.
    .. [3] T. K. Dey, P. Kumar, "A Simple Provable Algorithm for Curve Reconstruction", Symposium on
       Discrete Algorithms (1999), 893-894.

    Examples
    --------
    >>> octagon = [(0, 0), (3, 0), (5, 2), (5, 5), (3, 7), (0, 7), (-2, 5), (-2, 2)]
    >>> compatible_crust(octagon).tolist()
    [[0, 1], [0, 7], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7]]
    """
    least = as_real("angle", angle, "in radians, between 0 and pi", lambda x: 0 < x < math.pi)
    return select(points, "compatible-crust", 1 / math.tan(least))


def sig_delaunay(points: ArrayLike | Delaunay) -> IntArray:
    """Return the Delaunay edges between points whose spheres of influence meet.

    The sphere of influence of a point reaches to its nearest point [1]_; an edge joins Delaunay
    neighbors i and j whose spheres meet, that is, |ij| is at most the sum of the two radii [2]_. If
    the points are an r-sample of a smooth closed curve with r < 1/3, and successive steps along the
    curve differ at most by a factor of 2, every two points adjacent along the curve are joined.

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
    A proximity graph that holds the curve, not the curve: it has other edges, too, and in [2]_ is
    what a search for the boundary starts from. Exact; spheres that touch meet, and among cocircular
    points all diagonals are Delaunay edges. The condition above follows from the definition: for r
    < 1/3 the nearest point is an adjacent one, so each radius is at least half the step. [2]_ has
    larger bounds, in terms of the reach. O(n log n) time, and quadratic in the number of points on
    one circle.

    References
    ----------
    .. [1] G. T. Toussaint, "A Graph-Theoretical Primal Sketch", in Computational Morphology
       (1988), 229-260.
    .. [2] D. Marin, S. Ohrhallinger, M. Wimmer, "SIGDT: 2D Curve Reconstruction", Computer Graphics
       Forum 41 (2022), 25-36.

    Examples
    --------
    >>> sig_delaunay([(0, 0), (1, 0), (2, 1), (5, 1), (6, 1)]).tolist()
    [[0, 1], [0, 2], [1, 2], [3, 4]]
    """
    return select(points, "sig-delaunay")
