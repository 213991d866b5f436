"""The methods: functions from points, or a `Delaunay` of them, to edges."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crustline import _core
from crustline.delaunay import Delaunay, Progress, check_threads

Edges = NDArray[np.int64]
Method = Callable[..., Edges]


def triangulation(
    points: ArrayLike | Delaunay, threads: int | None, progress: Progress | None
) -> Delaunay:
    """Return `points` if it is a triangulation already, else its triangulation."""
    if isinstance(points, Delaunay):
        return points
    return Delaunay(points, threads=threads, progress=progress)


def crust(
    points: ArrayLike | Delaunay,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Edges:
    """Return the crust of points: edges with an empty disk that avoids the Voronoi vertices.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    no Voronoi vertex of the points [1]_. If the points are an r-sample of a smooth closed curve with
    r < 0.252, the crust joins exactly the points adjacent along the curve (Theorems 14 and 15).

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    threads : int, optional
        How many threads to use; by default `RAYON_NUM_THREADS`, or one a core. The edges are the
        same for any number.
    progress : callable, optional
        Called now and then with the name of a stage and the fraction of it that is done.

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
    delaunay = triangulation(points, threads, progress)
    return _core.crust(delaunay._core, check_threads(threads), progress)


def one_step_crust(
    points: ArrayLike | Delaunay,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Edges:
    """Return the one-step crust of points: edges whose opposite angles sum to at most 90°.

    An edge joins points i and j if some disk touches both and holds, in its interior, no point and
    neither of the centers of the edge's own Delaunay triangles [1]_. The crust asks this of all
    Voronoi vertices, so it is a subset.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    threads : int, optional
        How many threads to use; by default `RAYON_NUM_THREADS`, or one a core.
    progress : callable, optional
        Called now and then with the name of a stage and the fraction of it that is done.

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
    Exact; an angle sum of exactly 90° keeps the edge. O(n log n) time.

    References
    ----------
    .. [1] C. Gold, J. Snoeyink, "A One-Step Crust and Skeleton Extraction Algorithm", Algorithmica
       30 (2001), 144-163.

    Examples
    --------
    >>> one_step_crust([(0, 0), (1, 0), (1, 1), (0, 1)]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    """
    delaunay = triangulation(points, threads, progress)
    return _core.one_step_crust(delaunay._core, check_threads(threads), progress)


METHODS: dict[str, Method] = {
    "crust": crust,
    "one-step-crust": one_step_crust,
}
"""The name of each method on the command line."""
