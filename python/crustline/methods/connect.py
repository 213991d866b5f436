"""Connecting imperfect points: corners, open ends, gaps, outliers and noise."""

from __future__ import annotations

from numpy.typing import ArrayLike

from crustline import _core
from crustline.arrays import IntArray
from crustline.delaunay import Delaunay, as_delaunay
from crustline.methods.hints import as_hints


def connect(  # noqa: PLR0913 - each is something that a user may know
    points: ArrayLike | Delaunay,
    *,
    keep: ArrayLike | None = None,
    forbid: ArrayLike | None = None,
    ends: ArrayLike | None = None,
    max_edge: float | str | None = None,
    min_points: int | None = None,
    every_point: bool = False,
    closed: bool = False,
    components: int | None = None,
    junctions: bool = False,
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
        Rows of points at which a curve ends: each has one edge.
    max_edge : float or str, optional
        The length of the longest edge, in the unit of the points; or, such as "3x", in spacings:
        the greater of the distances between neighbors that are usual around its two ends.
    min_points : int, optional
        Curves of fewer points than this are left out.
    every_point : bool, default False
        Whether every point has an edge: none is an outlier.
    closed : bool, default False
        Whether all curves are rings.
    components : int, optional
        The number of curves, isolated points not counted.
    junctions : bool, default False
        Whether ends that go straight on to a curve are joined to it: T, X and Y. Up to four edges
        may meet at a point then.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted. No point has more than two, but with
        `junctions`.

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

    Hints come first, then the theorem, then the costs. What `every_point`, `ends` and `closed` ask
    for and the messages did not reach is reached by the cheapest alternating paths: edges come in
    and go out in turn, weighed by the messages' beliefs. `components` takes the cheapest change
    that joins or splits curves, again and again: an edge between ends, two edges of two curves for
    two others, a curve dropped, an edge cut. Each change is the cheapest of its kind; that their
    sum is the least of all is not proven. These changes break ties by coordinates, so that with
    these hints a turn of the points may choose another of several equally good answers.

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
    delaunay = as_delaunay(points)
    told = {
        "keep": keep,
        "forbid": forbid,
        "ends": ends,
        "max_edge": max_edge,
        "min_points": min_points,
        "components": components,
        "every_point": every_point,
        "closed": closed,
        "junctions": junctions,
    }
    return delaunay.run(_core.connect, as_hints(delaunay, told))
