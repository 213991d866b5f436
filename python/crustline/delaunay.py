"""The Delaunay triangulation, which every method starts from."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crustline import _core
from crustline.arrays import as_points
from crustline.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Progress = Callable[[str, float], object]
"""Called now and then during a long call with the name of a stage and the fraction of it done."""


class Delaunay:
    """The Delaunay triangulation of points: triangles whose circles hold no point inside.

    Make one to share the work between several methods, each of which takes it in place of points.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    threads : int, optional
        How many threads to use; by default `RAYON_NUM_THREADS`, or one a core. The result is the
        same, bit for bit, for any number.
    progress : callable, optional
        Called now and then with the name of a stage ("sort", "triangulate", "stars") and the
        fraction of it that is done.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 2)
        The points as given, repeated ones included.
    triangles : ndarray of int64, shape (t, 3)
        Rows of `points`, counter-clockwise. Empty if all points lie on one line.
    neighbors : ndarray of int64, shape (t, 3)
        The triangle across the side opposite to each corner; -1 outside.
    halfedges : ndarray of int64, shape (3t,)
        Half-edge 3t + k runs from corner k of triangle t to the next one; its twin, -1 outside.
    hull : ndarray of int64, shape (h,)
        Rows of the convex hull, counter-clockwise, points within its sides included. If all points
        lie on one line it runs along the line and back.
    circumcenters : ndarray of float64, shape (t, 2)
        The Voronoi vertices; row k belongs to triangle k. Infinite only beyond the double range.
    circumradii : ndarray of float64, shape (t,)
        The distance from each circumcenter to its triangle's corners.
    edges : ndarray of int64, shape (m, 2)
        Rows of `points`, i < j in each row, rows sorted.
    duplicates : ndarray of int64, shape (d, 2)
        A repeated row, and the first row with the same coordinates; sorted.

    Raises
    ------
    InputError
        If `points` is not (n, 2), a coordinate is not finite, or the coordinates are too far apart
        in size to be scaled exactly (more than about 300 orders of magnitude); names the row.

    Notes
    -----
    Exact. Where four or more points lie on one empty circle, its diagonals depend on coordinates
    alone, not on the order of the rows. Divide and conquer [1]_ with alternating cuts [2]_ along a
    Z-order curve: O(n log n) time, about 130 bytes a point at the peak. All arrays are read-only
    and made when first asked for.

    References
    ----------
    .. [1] L. Guibas, J. Stolfi, "Primitives for the Manipulation of General Subdivisions and the
       Computation of Voronoi Diagrams", ACM Transactions on Graphics 4 (1985), 74-123.
    .. [2] R. A. Dwyer, "A Faster Divide-and-Conquer Algorithm for Constructing Delaunay
       Triangulations", Algorithmica 2 (1987), 137-151.

    Examples
    --------
    >>> triangulation = Delaunay([(0, 0), (1, 0), (0, 1), (0.9, 0.9)])
    >>> triangulation.edges.tolist()
    [[0, 1], [0, 2], [0, 3], [1, 3], [2, 3]]
    >>> triangulation.hull.tolist()
    [0, 1, 3, 2]
    """

    def __init__(
        self,
        points: ArrayLike,
        *,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        rows = as_points(points)
        self._core = _core.Delaunay(rows, check_threads(threads), progress)
        self._points = rows

    def __len__(self) -> int:
        """The number of rows of `points`."""
        return len(self._points)

    def __repr__(self) -> str:
        return f"<crustline.Delaunay of {len(self):,} points>"

    @cached_property
    def points(self) -> NDArray[np.float64]:
        """The points as given."""
        view = self._points.view()
        view.flags.writeable = False
        return view

    @cached_property
    def triangles(self) -> NDArray[np.int64]:
        """Rows of `points` (t, 3), counter-clockwise."""
        return self._core.triangles()

    @cached_property
    def halfedges(self) -> NDArray[np.int64]:
        """The twin of each half-edge (3t,), -1 outside."""
        return self._core.halfedges()

    @cached_property
    def neighbors(self) -> NDArray[np.int64]:
        """The triangle (t, 3) opposite to each corner, -1 outside."""
        across = np.where(self.halfedges < 0, -1, self.halfedges // 3).reshape(-1, 3)
        # Half-edge k leaves corner k, so the side opposite to it is half-edge k + 1.
        opposite = np.roll(across, -1, axis=1)
        opposite.flags.writeable = False
        return opposite

    @cached_property
    def hull(self) -> NDArray[np.int64]:
        """Rows of the convex hull (h,), counter-clockwise."""
        return self._core.hull()

    @cached_property
    def circumcenters(self) -> NDArray[np.float64]:
        """The Voronoi vertices (t, 2), one a triangle."""
        return self._core.circumcenters()

    @cached_property
    def circumradii(self) -> NDArray[np.float64]:
        """The radii (t,) of the triangles' circles."""
        return self._core.circumradii()

    @cached_property
    def edges(self) -> NDArray[np.int64]:
        """Rows of `points` (m, 2), i < j, sorted."""
        return self._core.edges()

    @cached_property
    def duplicates(self) -> NDArray[np.int64]:
        """Repeated rows (d, 2), each with the first row of the same coordinates."""
        return self._core.duplicates()

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the triangulation with matplotlib; see `crustline.plot.plot_delaunay`."""
        from crustline.plot import plot_delaunay

        return plot_delaunay(self, ax, **options)


def check_threads(threads: int | None) -> int | None:
    """Return `threads` if it is a number of threads that can be had."""
    if threads is None:
        return None
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)) or threads < 1:
        raise InputError(f"threads must be a whole number of at least 1, not {threads!r}")
    return int(threads)
