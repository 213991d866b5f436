"""Connecting imperfect points: corners, open ends, gaps, outliers and noise."""

from __future__ import annotations

from numpy.typing import ArrayLike

from crustline import _core
from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, as_delaunay
from crustline.methods.hints import as_hints


def connect(
    points: ArrayLike | Delaunay,
    *,
    keep: ArrayLike | None = None,
    forbid: ArrayLike | None = None,
    ends: ArrayLike | None = None,
    max_edge: float | str | None = None,
    min_points: int | None = None,
) -> IntArray:
    """Return the edges of the curves that points suggest, at most two a point.

    Of all sets of Delaunay edges with at most two a point this is one that costs little: an edge
    costs by its length relative to the spacing around it and by the angles opposite to it, a point
    by its turn and its change of step, and a free end as much as a few bad edges. Message passing
    [1]_ looks for the least; a second round weighs turns and lengths by how much they vary nearby,
    and leaves out outliers.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    keep : array_like of int, shape (m, 2), optional
        Edges that are in the answer, whatever the points say; at most two a point. They need not be
        Delaunay edges; others may cross such a one.
    forbid : array_like of int, shape (m, 2), optional
        Edges that are not.
    ends : array_like of int, shape (k,), optional
        Rows of points at which a curve ends: each has one edge at most.
    max_edge : float or str, optional
        The length of the longest edge, in the unit of the points; or, such as "3x", in spacings:
        the greater of the distances between neighbors that are usual around its two ends.
    min_points : int, optional
        Curves of fewer points than this are left out.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted. No point has more than two.

    Raises
    ------
    InputError
        If `points` is not (n, 2), or a coordinate is not finite (the message names the row); if
        hints do not fit the points, or contradict each other (the message names them).

    See Also
    --------
    crust : proven for dense samples of smooth closed curves, and sure of nothing else.

    Notes
    -----
    No theorem says that this is right, but where one says that the crust is, this gives the same:
    a ring of the crust with (1 + 0.15) · r < 0.252 at every edge, r being its sampling ratio as
    `certify` estimates it, is taken as it is.

    The costs are floating-point estimates, and the same for any order of the rows and number of
    threads, after scaling by a power of two, turns by 90°, reflections, and translations that keep
    the coordinates exact. Where edges are equally good and not all can be in, none is: nothing in
    the points tells them apart. O(n log n) time.

    References
    ----------
    .. [1] J. Pearl, "Probabilistic Reasoning in Intelligent Systems", Morgan Kaufmann (1988).

    Examples
    --------
    A corner, which the crust cuts with two chords:

    >>> corner = [(-1.5, 3), (-1, 2), (-0.5, 1), (0, 0), (0.5, 1), (1, 2), (1.5, 3)]
    >>> connect(corner).tolist()
    [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6]]

    A point that would be an outlier, and an edge that is known:

    >>> line = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (2, 9)]
    >>> connect(line).tolist()
    [[0, 1], [1, 2], [2, 3], [3, 4]]
    >>> connect(line, keep=[(4, 5)]).tolist()
    [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5]]
    """
    given = (keep, forbid, ends, max_edge, min_points)
    delaunay = as_delaunay(points)
    if all(each is None for each in given):
        return delaunay.run(_core.connect, None)
    hints = as_hints(
        delaunay,
        keep=keep,
        forbid=forbid,
        ends=ends,
        max_edge=max_edge,
        min_points=min_points,
        every_point=False,
    )
    return delaunay.run(_core.connect, hints)
