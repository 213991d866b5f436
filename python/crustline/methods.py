"""The methods: functions from points, or a `Delaunay` of them, to edges.

Each is decided by its definition in exact arithmetic: no answer depends on rounding, on the order
of rows, on the number of threads, or on which diagonals a triangulation has where points are
cocircular.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from numbers import Real
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crustline import _core
from crustline.arrays import as_edges, as_points
from crustline.delaunay import Delaunay, as_delaunay, points_and_how
from crustline.errors import InputError

Edges = NDArray[np.int64]
Method = Callable[..., Edges]


def as_selected(delaunay: Delaunay, edges: ArrayLike | None) -> Edges:
    """Return edges of the points, i < j, sorted and unique; the crust if none are given."""
    return crust(delaunay) if edges is None else as_edges(edges, len(delaunay))


def check_number(name: str, value: object) -> float:
    """Return the parameter `value` as a float if it is a real number that a float can hold."""
    if isinstance(value, Real) and not isinstance(value, (bool, np.bool_)):
        try:
            return float(value)
        except OverflowError:
            pass
    raise InputError(f"{name} must be a number, not {value!r:.60}: pass a float")


def check_positive(name: str, value: object) -> float:
    """Return the parameter `value` as a float if it is positive and finite."""
    number = check_number(name, value)
    if not (number > 0 and math.isfinite(number)):
        raise InputError(f"{name} must be positive and finite, not {value!r:.60}")
    return number


def check_size(name: str, value: object) -> float:
    """Return the parameter `value` of a γ-graph as a float if it is from -1 to 1."""
    number = check_number(name, value)
    if not -1 <= number <= 1:
        raise InputError(f"{name} must be a number from -1 to 1, not {value!r:.60}")
    return number


def crust(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the crust of points: edges with an empty disk that avoids the Voronoi vertices.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    no Voronoi vertex of the points [1]_. If the points are an r-sample of a smooth closed curve
    with r < 0.252, the crust joins exactly the points adjacent along the curve (Theorems 14
    and 15).

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    delaunay = as_delaunay(points)
    return delaunay.cached("crust", lambda: delaunay.run(_core.crust))


def beta_skeleton(
    points: ArrayLike | Delaunay,
    beta: float = 1.70,
    *,
    kind: Literal["circle", "lune"] = "circle",
) -> Edges:
    """Return the β-skeleton of points: edges whose forbidden region holds no point.

    For β ≥ 1 the forbidden region of points i and j at distance d is the union of the two open
    disks of radius β d / 2 that touch both [1]_. If the points are an r-sample of a smooth closed
    curve with r ≤ 0.297, the β-skeleton of β = 1.70 joins exactly the points adjacent along the
    curve (Theorem 20).

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    size = check_positive("beta", beta)
    if kind not in ("circle", "lune"):
        raise InputError(f'kind must be "circle" or "lune", not {kind!r:.60}')
    return as_delaunay(points).run(_core.beta_skeleton, size, kind == "lune")


def gabriel(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the Gabriel graph of points: edges whose diametral disk holds no point.

    An edge joins points i and j if the open disk with the two as a diameter holds no point [1]_. It
    is the β-skeleton of β = 1.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    return as_delaunay(points).run(_core.gabriel)


def relative_neighborhood(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the relative neighborhood graph: edges with no point nearer to both of their ends.

    An edge joins points i and j if no point is nearer to i and nearer to j than the two are to each
    other [1]_. It is the lune-based β-skeleton of β = 2.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    return as_delaunay(points).run(_core.relative_neighborhood)


def one_step_crust(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the one-step crust of points: edges whose opposite angles sum to at most 90°.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    neither of the centers of the edge's own Delaunay triangles [1]_. The crust asks this of all
    Voronoi vertices, so it is a subset.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    return as_delaunay(points).run(_core.one_step_crust)


def gamma_graph(
    points: ArrayLike | Delaunay,
    c0: float,
    c1: float,
) -> Edges:
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
    points : array_like of float, shape (n, 2), or Delaunay
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
    size0, size1 = check_size("c0", c0), check_size("c1", c1)
    return as_delaunay(points).run(_core.gamma_graph, size0, size1)


def crossing_angle_graph(
    points: ArrayLike | Delaunay,
    angle: float,
) -> Edges:
    """Return the edges that two empty disks touch whose circles cross at an angle or more.

    An edge joins points i and j if two disks touch both, hold no point in their interiors, and
    their circles cross at `angle` or more: the dual Voronoi edge is seen from i under `angle`, and
    the two angles opposite to the edge sum to at most π - `angle`. Where β-skeletons fix the radius
    of both disks, this family of γ-neighborhood graphs fixes only how they cross; section 3 of [1]_
    believes in a guarantee for it, at an angle sum (Observation 16) of a bit more than π/2.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    >>> points = [(0, 0), (4, 0), (4, 3), (0, 3), (2, 1)]
    >>> crossing_angle_graph(points, math.pi / 2).tolist() == one_step_crust(points).tolist()
    True
    """
    number = check_number("angle", angle)
    if not 0 < number < math.pi:
        raise InputError(f"angle must be in radians, above 0 and below pi, not {angle!r:.60}")
    cotangent = math.tan(math.pi / 2 - number)
    return as_delaunay(points).run(_core.crossing_angle_graph, cotangent)


def alpha_shape(
    points: ArrayLike | Delaunay,
    radius: float,
) -> Edges:
    """Return the α-shape of points: edges that an empty disk of the given radius touches.

    An edge joins points i and j if some open disk of exactly `radius` touches both and holds no
    point [1]_. The edges bound what is left of the plane when all empty disks of that radius are
    taken away, with isolated edges. As the radius grows they become the convex hull.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    size = check_positive("radius", radius)
    return as_delaunay(points).run(_core.alpha_shape, size)


def a_shape(
    points: ArrayLike | Delaunay,
    extra: ArrayLike,
) -> Edges:
    """Return the 𝒜-shape of points: edges with an empty disk that avoids extra points, too.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    no extra point [1]_. With the Voronoi vertices of the points as extra points it is the crust.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    >>> points = [(0, 0), (4, 0), (4, 4), (0, 4)]
    >>> a_shape(points, [(2, 2)]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    >>> a_shape(points, [(2, 2)]).tolist() == crust(points).tolist()
    True
    """
    own, (threads, progress) = points_and_how(points)
    together = np.concatenate((own.xy, as_extra(extra)))
    return Delaunay(together, threads=threads, progress=progress).run(_core.a_shape, len(own))


def as_extra(extra: ArrayLike) -> NDArray[np.float64]:
    """Return the extra points of `a_shape` as an array, or an error that names them."""
    try:
        return as_points(extra)
    except InputError as error:
        raise InputError(f"extra, as {error}") from None


def rcgh(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the Delaunay edges that are no longer than their dual Voronoi edges.

    The rule of Robinson, Colchester, Griffin and Hawkes [1]_: a Delaunay edge lies along the
    boundary if the Voronoi edge that crosses it is at least as long, and else across. Edges of the
    hull, whose Voronoi edges have no end, are kept.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    return as_delaunay(points).run(_core.rcgh)


def nn_crust(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the NN-crust of points: edges to the nearest, and to the nearest on the other side.

    Each point i is joined with its nearest point j, and with the nearest of its Delaunay neighbors
    k such that the angle j i k is at least 90° [1]_. If the points are an r-sample of a smooth
    closed curve with r ≤ 1/3, the NN-crust joins exactly the points adjacent along the curve.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    return as_delaunay(points).run(_core.nn_crust)


def minimum_spanning_tree(
    points: ArrayLike | Delaunay,
) -> Edges:
    """Return the Euclidean minimum spanning tree: the shortest edges that join all points.

    The tree on the points of the least total length [1]_. Of equally long edges that one comes
    first whose lexicographically smaller end is smaller, then that whose other end is, so there is
    one tree.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
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
    return as_delaunay(points).run(_core.minimum_spanning_tree)


METHODS: dict[str, Method] = {
    "crust": crust,
    "beta-skeleton": beta_skeleton,
    "gabriel": gabriel,
    "relative-neighborhood": relative_neighborhood,
    "one-step-crust": one_step_crust,
    "rcgh": rcgh,
    "nn-crust": nn_crust,
    "minimum-spanning-tree": minimum_spanning_tree,
}
"""The name of each method on the command line."""
