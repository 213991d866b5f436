"""The Delaunay triangulation, which every method starts from."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from inspect import signature
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crustline import _core
from crustline.arrays import IntArray, read_only
from crustline.errors import InputError, shown
from crustline.notebook import table
from crustline.points import Points, as_carried, as_coordinates
from crustline.scalars import as_whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Progress = Callable[[str, float], object]
"""Called now and then during a long call with the name of a stage and the fraction of it done."""

How = tuple[int | None, Progress | None]
"""How a long call is to run: on so many threads, reporting its progress to this."""

Made = TypeVar("Made")

MOST_THREADS = 1024


class Delaunay:
    """The Delaunay triangulation of points: triangles whose circles hold no point inside.

    Make one to share the work: every function that takes points takes it in their place, and what
    rests on the triangulation is computed once.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), or Points
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row. An
        array is copied.
    threads : int, optional
        How many threads to use, here and in every function that is given the triangulation; by
        default `RAYON_NUM_THREADS`, or one a core. The results are the same, bit for bit, for any
        number.
    progress : callable, optional
        Called now and then, here and in every such function, with the name of a stage ("sort",
        "triangulate", "stars", "select" …) and the fraction of it that is done.

    Attributes
    ----------
    points : Points
        The points as given, repeated ones included, with all that they carry.
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
    Z-order curve: O(n log n) time, about 140 bytes a point at the peak. All arrays are read-only
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
        self.points = as_carried(points)
        self._how = (None if threads is None else as_threads(threads), as_progress(progress))
        self._core = _core.Delaunay(self.points.xy, *self._how)
        self._made: dict[str, Any] = {}

    def __len__(self) -> int:
        """The number of rows of `points`."""
        return len(self.points)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the coordinates of the points."""
        return np.array(self.points.xy, dtype=dtype, copy=copy)

    def __repr__(self) -> str:
        return f"<Delaunay: {len(self):,} point{'s' * (len(self) != 1)}>"

    def _repr_html_(self) -> str:
        """Return the table that notebooks show."""
        parts = ("points", "triangles", "edges", "hull", "duplicates")
        return table("Delaunay", parts, [[len(getattr(self, part)) for part in parts]])

    def __eq__(self, other: object) -> bool:
        """Whether the points are equal, with all that they carry: they decide the triangulation."""
        return self.points == other.points if isinstance(other, Delaunay) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Delaunay:
        return self

    def __deepcopy__(self, memo: object) -> Delaunay:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(Delaunay, threads=self._how[0]), (self.points,)

    def alike(self, points: ArrayLike) -> Delaunay:
        """Return the triangulation of other points, with the same threads and progress."""
        return Delaunay(points, threads=self._how[0], progress=self._how[1])

    def run(self, work: Callable[..., Made], *arguments: object) -> Made:
        """Return what a function of the core makes of the triangulation, run as was asked for."""
        return work(self._core, *arguments, *self._how)

    def select(self, method: str, *parameters: float) -> IntArray:
        """Return the edges that a method of the core selects, with its parameters in order."""
        return self.run(_core.select, method, list(map(float, parameters)))

    def kept(self, name: str) -> Any:
        """Return what was made under a name; None if nothing was."""
        return self._made.get(name)

    def cached(
        self, name: str, make: Callable[[], Made], *, fits: Callable[[Made], bool] | None = None
    ) -> Made:
        """Return what was made under a name, if it is there and fits; else make it and keep it.

        Parameters
        ----------
        name : str
            What it is, such as "crust". One thing is kept under each name, the latest.
        make : callable
            Makes it, from this triangulation.
        fits : callable, optional
            Whether what was kept is the one wanted now.
        """
        if name not in self._made or not (fits is None or fits(self._made[name])):
            self._made[name] = make()
        made: Made = self._made[name]
        return made

    def along(self, edges: IntArray) -> _core.Curve:
        """Return edges as the core takes them, with each point's neighbors along them.

        The latest are kept: the medial axis, the interpolant and the certificate ask for them.
        """

        def made_of_them(known: _core.Curve) -> bool:
            return known.is_of(edges)

        return self.cached("along", lambda: self.run(_core.Curve, edges), fits=made_of_them)

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
        return read_only(opposite)

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


def as_progress(progress: Any) -> Progress | None:
    """Return what hears of progress; an `InputError` for what takes no stage and fraction."""
    if progress is not None:
        try:
            signature(progress).bind("stage", 0.0)
        except TypeError:
            raise InputError(
                f"progress is {shown(progress)}: give a function of a stage and a fraction"
            ) from None
        except ValueError:  # of some functions in C nobody knows
            pass
    heard: Progress | None = progress
    return heard


def as_threads(threads: object) -> int:
    """Return a number of threads that can be had."""
    return as_whole("threads", threads, 1, MOST_THREADS)


def as_delaunay(points: ArrayLike | Delaunay) -> Delaunay:
    """Return a triangulation as it is, and else the one of the points."""
    return points if isinstance(points, Delaunay) else Delaunay(points)


def select(points: ArrayLike | Delaunay, method: str, *parameters: float) -> IntArray:
    """Return the edges that a method of the core selects, with its parameters in order.

    Of points that are no triangulation nothing is kept, and no copy is made. Like any function of
    NumPy it counts on it that no other thread changes the array meanwhile.
    """
    if isinstance(points, Delaunay):
        return points.select(method, *parameters)
    return _core.select_among(as_coordinates(points), method, list(map(float, parameters)))


def points_and_how(points: ArrayLike | Delaunay) -> tuple[Points, How]:
    """Return points with all that they carry, and how long calls about them are to run."""
    if isinstance(points, Delaunay):
        return points.points, points._how
    return as_carried(points), (None, None)
