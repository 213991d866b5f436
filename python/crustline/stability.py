"""How far a parameter can be moved until the answer changes: β, edge by edge; the longest edge."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray, as_edges, read_only
from crustline.delaunay import Delaunay, as_delaunay
from crustline.methods.connect import connect
from crustline.methods.neighborhoods import beta_skeleton
from crustline.scalars import as_real

__all__ = ["beta_interval", "beta_of", "max_edge_interval"]

#: Pairs of an edge and a point that are looked at together.
_AT_ONCE = 1 << 20


def beta_of(points: npt.ArrayLike | Delaunay, edges: npt.ArrayLike) -> FloatArray:
    """Return for each edge the largest β at which the circle-based β-skeleton has it.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite.
    edges : array_like of int, shape (m, 2)
        Rows of `points`, of any edges.

    Returns
    -------
    beta : ndarray of float64, shape (m,)
        In the order of the edges sorted, i < j in each. Infinite if no point sees the edge; 0 if
        one is on it.

    Raises
    ------
    InputError
        If points or edges do not fit; the message names the first row at fault.

    Notes
    -----
    With θ the greatest angle under which a point sees the edge, it is 1 / sin θ up to 90°, from
    where on the region is the intersection of two disks and it is sin θ (paper [1]_, §2). On each
    side of a Delaunay edge the opposite corner sees it under the greatest angle. Floating-point, to
    a relative error of about 10⁻¹⁵ times the ratio of lengths: at that very β the exact
    `beta_skeleton` may decide either way. O(n log n) time, and O(n) more for each edge that is not
    in the Delaunay triangulation.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135. Section 2.

    Examples
    --------
    >>> beta_of([(0, 0), (1, 0), (1, 1), (0, 1), (5, 0)], [(0, 1), (0, 2)]).round(3)
    array([1.414, 1.   ])
    """
    delaunay = as_delaunay(points)
    wanted = as_edges(edges, len(delaunay))
    angle = _greatest_angles(delaunay, wanted)
    with np.errstate(divide="ignore"):
        return read_only(np.where(angle <= np.pi / 2, 1 / np.sin(angle), np.sin(np.pi - angle)))


def _greatest_angles(delaunay: Delaunay, edges: IntArray) -> FloatArray:
    """Return the greatest angle under which any point sees each edge, but for its ends."""
    xy, n = _scaled(delaunay.points.xy)[0], len(delaunay)
    corners = delaunay.triangles
    sides = np.concatenate([corners[:, [0, 1, 2]], corners[:, [1, 2, 0]], corners[:, [2, 0, 1]]])
    keys = np.sort(sides[:, :2], axis=1) @ [n, 1]
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    seen = _angle(xy, sides[order, 0], sides[order, 1], sides[order, 2])
    wanted = edges @ [n, 1]
    first, last = (np.searchsorted(keys, wanted, side) for side in ("left", "right"))
    greatest = np.zeros(len(edges))
    for number in (0, 1):
        there = first + number < last
        greatest[there] = np.maximum(greatest[there], seen[(first + number)[there]])
    others = np.flatnonzero(first == last)
    if len(corners) == 0:
        # All points are on one line, and none sees what joins two neighbors there.
        others = others[~np.isin(wanted[others], delaunay.edges @ [n, 1])]
    at_once = max(1, _AT_ONCE // max(1, n))
    for part in np.split(others, np.arange(at_once, len(others), at_once)):
        greatest[part] = _greatest_of_all(xy, edges[part])
    return greatest


def _greatest_of_all(xy: FloatArray, edges: IntArray) -> FloatArray:
    rows = np.arange(len(xy))
    ends = xy[edges]
    is_end = (xy[None] == ends[:, :1]).all(-1) | (xy[None] == ends[:, 1:]).all(-1)
    seen = _angle(xy, edges[:, :1], edges[:, 1:], rows[None])
    greatest: FloatArray = np.where(is_end, 0.0, seen).max(axis=1, initial=0.0)
    return greatest


def _angle(xy: FloatArray, i: IntArray, j: IntArray, apex: IntArray) -> FloatArray:
    """Return the angles under which some points see the segments between others."""
    u, v = xy[i] - xy[apex], xy[j] - xy[apex]
    cross = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    angle: FloatArray = np.arctan2(np.abs(cross), (u * v).sum(-1))
    return angle


def beta_interval(points: npt.ArrayLike | Delaunay, beta: float) -> tuple[float, float]:
    """Return the interval of β, of at least 1, in which the β-skeleton stays as it is.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite.
    beta : float
        At least 1.

    Returns
    -------
    low, high : float
        The circle-based β-skeleton is the same for all β > low up to high, and `beta` is one of
        these. `low` is 1 at the least, where the definition changes; `high` may be infinite.

    Raises
    ------
    InputError
        If the points do not fit, or β is below 1.

    Notes
    -----
    From `beta_of` the edges, and its accuracy. O(n log n) time.

    Examples
    --------
    >>> low, high = beta_interval([(0, 0), (2, 0), (2, 1), (0, 1)], 1.1)
    >>> round(low, 3), round(high, 3)
    (1.0, 1.118)
    """
    number = as_real("beta", beta, "a number of at least 1", lambda value: value >= 1)
    delaunay = as_delaunay(points)
    chosen = beta_skeleton(delaunay, number)
    n = [len(delaunay), 1]
    betas = beta_of(delaunay, delaunay.edges)
    is_in = np.isin(delaunay.edges @ n, chosen @ n)
    low = betas[~is_in].max(initial=1.0)
    high = betas[is_in].min(initial=np.inf)
    # What rounding says of an edge at β itself does not matter.
    return float(min(low, number)), float(max(high, number))


def max_edge_interval(points: npt.ArrayLike | Delaunay) -> tuple[float, float]:
    """Return the interval of `max_edge` in which `connect` gives what it gives without.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite.

    Returns
    -------
    low, high : float
        The answer is the same at `low`, and for every greater length that was tried; `high` is
        infinite. `low` is the longest edge of the answer, where that does, and 0 without edges.

    Raises
    ------
    InputError
        If the points do not fit.

    Notes
    -----
    An edge that is not allowed cannot help a rival either, so that the answer seldom changes before
    its own longest edge is cut; but that is not proven, so it is tried: there, and, if it differs,
    by bisection over the lengths of Delaunay edges. As many answers as that has steps.

    Examples
    --------
    >>> max_edge_interval([(0, 0), (1, 0), (2, 0), (4, 0)])
    (2.0, inf)
    """
    delaunay = as_delaunay(points)
    xy = delaunay.points.xy
    answer = connect(delaunay)
    if not len(answer):
        return 0.0, np.inf
    longest, *_ = np.sort(_lengths(xy, answer))[::-1]
    lengths = np.unique(np.append(_lengths(xy, delaunay.edges), longest))
    low, high = int(np.searchsorted(lengths, longest)), len(lengths) - 1

    def same(k: int) -> bool:
        return np.array_equal(connect(delaunay, max_edge=float(lengths[k])), answer)

    if same(low):
        return float(lengths[low]), np.inf
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if same(middle) else (middle, high)
    return float(lengths[high]), np.inf


def _lengths(xy: FloatArray, edges: IntArray) -> FloatArray:
    near, exponent = _scaled(xy)
    x, y = (near[edges[:, 0]] - near[edges[:, 1]]).T
    # As the core has them, to the last bit.
    lengths: FloatArray = np.ldexp(np.sqrt(x * x + y * y), exponent)
    return lengths


def _scaled(xy: FloatArray) -> tuple[FloatArray, int]:
    """Return coordinates over a power of two, which makes them about 1, and its exponent."""
    exponent = int(np.frexp(np.abs(xy).max(initial=0.0))[1])
    return np.ldexp(xy, -exponent), exponent
