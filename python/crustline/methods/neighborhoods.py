"""Graphs of empty neighborhoods: edges whose region, different in each graph, holds no point."""

from __future__ import annotations

import math
from typing import Literal

from numpy.typing import ArrayLike

from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, select
from crustline.scalars import as_choice, as_positive, as_real
from crustline.theory import BETA


def beta_skeleton(
    points: ArrayLike | Delaunay,
    beta: float = BETA,
    *,
    kind: Literal["circle", "lune"] = "circle",
) -> IntArray:
    """Return the β-skeleton of points: edges whose forbidden region holds no point.

    For β ≥ 1 the forbidden region of points i and j at distance d is the union of the two open
    disks of radius β d / 2 that touch both [1]_. If the points are an r-sample of a smooth closed
    curve with r ≤ 0.297, the β-skeleton of β = 1.70 joins exactly the points adjacent along the
    curve (Theorem 20).

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    beta : float, default 1.70
        The size of the forbidden region, positive and finite. For β < 1 the region is the
        intersection of the two open disks of radius d / 2β that touch both points.
    kind : {"circle", "lune"}, default "circle"
        "lune" is the other family of Kirkpatrick and Radke [2]_: for β ≥ 1 the region is the
        intersection of the two open disks of radius β d / 2 that touch one of the points each and
        are centered on the line through both. For β ≤ 1 the two are the same.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row);
        if `beta` is not positive and finite, or `kind` is
        neither of the two.

    Notes
    -----
    Exact in the double `beta`; a point on the boundary of the region keeps the edge. O(n log n)
    time for β ≥ 1. The circle-based skeleton of β > 1 is a part of every Delaunay triangulation,
    and an edge is in it if neither of its two opposite angles exceeds arcsin(1/β). The lune-based
    one is a part, too, and each edge is tested against the points near it with a tree of boxes.

    For β < 1 all pairs of points are candidates and up to all of them are edges. A tree of boxes
    leaves out those pairs that a Delaunay neighbor rules out in bulk: about O(m log n) time for m
    edges, O(n³) at worst, and O(m) memory.

    A larger β gives a subset.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135. Sections 2 and 9.
    .. [2] D. G. Kirkpatrick, J. D. Radke, "A Framework for Computational Morphology", in
       Computational Geometry (1985), 217-248.

    Examples
    --------
    >>> points = [(5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (3, -4)]
    >>> beta_skeleton(points, 1.5).tolist()
    [[0, 1], [0, 5], [1, 2], [2, 3], [3, 4], [4, 5]]
    >>> beta_skeleton(points).tolist()
    [[0, 1], [0, 5], [2, 3], [3, 4]]
    """
    size = as_positive("beta", beta)
    as_choice("kind", kind, ("circle", "lune"))
    return select(points, "beta-skeleton", size, kind == "lune")


def gabriel(points: ArrayLike | Delaunay) -> IntArray:
    """Return the Gabriel graph of points: edges whose diametral disk holds no point.

    An edge joins points i and j if the open disk with the two as a diameter holds no point [1]_. It
    is the β-skeleton of β = 1.

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
    Exact; a point on the circle keeps the edge, so a rectangle has both diagonals. A part of the
    Delaunay triangulation where no four points are cocircular. O(n log n) time, and quadratic in
    the number of points on one circle.

    References
    ----------
    .. [1] K. R. Gabriel, R. R. Sokal, "A New Statistical Approach to Geographic Variation
       Analysis", Systematic Zoology 18 (1969), 259-278.

    Examples
    --------
    >>> gabriel([(0, 0), (4, 0), (2, 1), (2, 9)]).tolist()
    [[0, 2], [1, 2], [2, 3]]
    """
    return select(points, "gabriel")


def relative_neighborhood(points: ArrayLike | Delaunay) -> IntArray:
    """Return the relative neighborhood graph: edges with no point nearer to both of their ends.

    An edge joins points i and j if no point is nearer to i and nearer to j than the two are to each
    other [1]_. It is the lune-based β-skeleton of β = 2.

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
    Exact; a point at the same distance keeps the edge. A part of the Gabriel graph, and a superset
    of the minimum spanning tree, so connected. O(n log n) time on all data met in practice: each
    edge is tested against the points near it with a tree of boxes.

    References
    ----------
    .. [1] G. T. Toussaint, "The Relative Neighbourhood Graph of a Finite Planar Set", Pattern
       Recognition 12 (1980), 261-268.

    Examples
    --------
    >>> relative_neighborhood([(0, 0), (4, 0), (2, 3), (2, 9)]).tolist()
    [[0, 2], [1, 2], [2, 3]]
    """
    return select(points, "relative-neighborhood")


def gamma_graph(
    points: ArrayLike | Delaunay,
    c0: float,
    c1: float,
) -> IntArray:
    r"""Return the γ-neighborhood graph: edges with no point in two disks of different sizes.

    For points i and j at distance d take two open disks that touch both, of radius d / 2(1 -
    \|c0\|) and d / 2(1 - \|c1\|), with their centers on different sides of the edge if c0 and c1
    have the same sign, else on one side. The neighborhood is their union if the larger in size of
    c0 and c1 is positive, else their intersection. The edge is in the graph if one of the two such
    neighborhoods, mirror images in the edge, holds no point [1]_.

    In angles: no point on one side of the edge sees it under more than φ(c0), and none on the other
    side under more than φ(c1), where sin φ(c) = 1 - \|c\| and φ is acute for c ≥ 0, obtuse for c <
    0.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    c0, c1 : float
        The sizes of the two disks, from -1 to 1, in any order.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row);
        if `c0` or `c1` is not from -1 to 1.

    Notes
    -----
    Exact in the doubles c0 and c1; a point on the boundary keeps the edge. The segment between i
    and j is always a part of the neighborhood, which closes the limits: γ(1, -1) is the convex hull
    and γ(-1, -1) joins all pairs that see each other. γ(c, c) is the circle-based β-skeleton of β =
    1 / (1 - c) for c ≥ 0, and of β = 1 + c below; γ(0, 0) is the Gabriel graph. A Delaunay edge in
    general position is in γ(c, -c) for some c.

    O(n log n) time for c0 + c1 ≥ 0, where the edges join points on empty circles. For c0 + c1 < 0
    all pairs are candidates and up to all are edges: about O(m log n) time for m edges, O(n³) at
    worst.

    References
    ----------
    .. [1] R. C. Veltkamp, "The γ-Neighborhood Graph", Computational Geometry: Theory and
       Applications 1 (1992), 227-246.

    Examples
    --------
    >>> points = [(0, 0), (4, 0), (4, 3), (0, 3), (2, 1)]
    >>> gamma_graph(points, 1, -1).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    >>> gamma_graph(points, 0.2, 0.2).tolist() == beta_skeleton(points, 1.25).tolist()
    True
    """
    sizes = [as_real(name, c, "from -1 to 1", _is_size) for name, c in (("c0", c0), ("c1", c1))]
    return select(points, "gamma-graph", *sizes)


def _is_size(c: float) -> bool:
    return -1 <= c <= 1


def crossing_angle_graph(
    points: ArrayLike | Delaunay,
    angle: float,
) -> IntArray:
    """Return the edges that two empty disks touch whose circles cross at an angle or more.

    An edge joins points i and j if two disks touch both, hold no point in their interiors, and
    their circles cross at `angle` or more: the dual Voronoi edge is seen from i under `angle`, and
    the two angles opposite to the edge sum to at most π - `angle`. Where β-skeletons fix the radius
    of both disks, this family of γ-neighborhood graphs fixes only how they cross; section 3 of [1]_
    believes in a guarantee for it, at an angle sum (Observation 16) of a bit more than π/2.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    angle : float
        In radians, above 0 and below π.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row);
        if `angle` is not between 0 and π.

    Notes
    -----
    Exact in the cotangent of `angle`, which is the double nearest to tan(π/2 - angle) that the
    platform computes, with π/2 the double `math.pi / 2`. So `angle = math.pi / 2` has cotangent 0
    and gives the one-step crust exactly. Equality keeps an edge; on the hull, where the outer disk
    grows without end, equality is not reached and does not. A larger angle gives a subset. O(n log
    n) time.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135. Sections 3 and 9.

    Examples
    --------
    >>> import math
    >>> from crustline import one_step_crust
    >>> points = [(0, 0), (4, 0), (4, 3), (0, 3), (2, 1)]
    >>> crossing_angle_graph(points, math.pi / 2).tolist() == one_step_crust(points).tolist()
    True
    """
    number = as_real("angle", angle, "in radians, above 0 and below pi", lambda x: 0 < x < math.pi)
    cotangent = math.tan(math.pi / 2 - number)
    return select(points, "crossing-angle-graph", cotangent)
