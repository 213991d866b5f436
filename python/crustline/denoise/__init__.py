"""Curves that pass near noisy points, where no edges between the points themselves are right."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray, as_floats
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay, as_delaunay
from crustline.denoise.annotated import annotated
from crustline.denoise.clean import clean_strands, rest
from crustline.denoise.strand import ROWS, Strand, strands
from crustline.errors import InputError, require
from crustline.methods import as_method, connect
from crustline.points import Points
from crustline.projection import project
from crustline.records import Record
from crustline.scalars import as_real, as_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Denoised", "denoise"]


@dataclass(frozen=True, eq=False, repr=False)
class Denoised(Record):
    """Curves through new vertices that noisy points stand behind.

    Attributes
    ----------
    points : Points
        The points as they were given, with all that they carry.
    curves : Curves
        Rings and polylines; ``curves.points`` are the new vertices.
    uncertainty : ndarray of float64, shape (v,)
        The standard deviation of each vertex across the curve; 0 where it is a point itself.
    vertices : ndarray of int64, shape (n,)
        The vertex that each row of the points belongs to; -1 for an outlier.
    noise : ndarray of float64, shape (n,)
        The standard deviation of the noise at each row, as estimated or given, and as found
        from the curve; NaN where the points do not look like a curve.
    unchanged : ndarray of bool, shape (c,)
        The curves whose vertices are the points themselves, because there is no noise to speak of.
    crs : str or None
        The CRS in whose unit uncertainty and noise are, if it is another than that of the points.
    """

    points: Points
    curves: Curves
    uncertainty: FloatArray
    vertices: IntArray
    noise: FloatArray
    unchanged: BoolArray
    crs: str | None = None

    @property
    def outliers(self) -> IntArray:
        """The rows that no curve stands for, sorted."""
        return np.flatnonzero(self.vertices < 0)

    def rows(self, vertex: int) -> IntArray:
        """Return the rows that a vertex stands for, sorted."""
        return np.flatnonzero(self.vertices == vertex)

    def annotated(self) -> Curves:
        """Return the curves as files hold them: what is known of each vertex beside it.

        Returns
        -------
        curves : Curves
            The same curves. Their points are the vertices and, after them, the outliers, which are
            isolated. Columns: ``input_rows``, the rows that a vertex stands for, with spaces
            between; ``uncertainty``; and ``noise``, the mean of that of the rows. Heights are
            such means, too. Between vertices that have rows means are linear. NaN is what is not
            known, such as the uncertainty of an outlier. The CRS is kept; other columns are of
            rows, not of vertices, and stay with ``points``.

        Examples
        --------
        >>> line = denoise([(k / 5, k % 3 / 4) for k in range(60)])
        >>> line.annotated().points.columns["input_rows"][:4].tolist()
        ['0', '1', '2', '3 4']
        """
        return annotated(self.points, self.curves, self.vertices, self.uncertainty, self.noise)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the curves beside the points with matplotlib; see `crustline.plot.plot_denoised`."""
        from crustline.plot import plot_denoised

        return plot_denoised(self, ax, **options)

    def __repr__(self) -> str:
        rings = int(self.curves.closed.sum())
        lines = len(self.curves) - rings
        outliers = len(self.outliers)
        return (
            f"<Denoised: {rings} ring{'s' * (rings != 1)}, {lines} polyline{'s' * (lines != 1)}, "
            f"{outliers} outlier{'s' * (outliers != 1)}; {len(self.points):,} points>"
        )


def denoise(
    points: ArrayLike | Delaunay,
    *,
    noise: ArrayLike | None = None,
    method: Callable[..., ArrayLike] = connect,
    crs: str | None = None,
) -> Denoised:
    """Return curves that pass near noisy points: rings, lines, several of them, and outliers aside.

    Where noise is as large as the spacing the order is not in the points, and no set of edges
    between them is right. So the points are moved to the ridge of their density [1]_, which has an
    order; a method connects it; and a smooth curve through each part is fitted to the points
    themselves, as smooth as makes them most likely. Of its vertices each says which rows it stands
    for and how uncertain it is.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite; three different ones at least. Repeated points count
        once for the order, and each for the fit.
    noise : float or array_like of float, shape (n,), optional
        The standard deviation of the noise in each direction, of all points or of each, such as
        a column of accuracies. By default it is estimated around each point.
    method : callable, default `connect`
        Connects the points of the ridge: takes their triangulation and returns edges.
    crs : str, optional
        Fit in this coordinate reference system, in whose unit the noise then is, such as
        "EPSG:25832", or "auto" for a map about the middle of the points in meters: see `project`.
        The vertices come back in that of the points. By default coordinates are taken as they are.

    Returns
    -------
    denoised : Denoised
        The curves, the rows behind each vertex, uncertainties, outliers, and the noise.

    Raises
    ------
    InputError
        If the points do not fit or are fewer than three different ones; if `noise` is negative, not
        finite, 0 everywhere, not one number or one a row, or larger than the points' extent.
    MissingExtraError
        If scipy is not installed (extra `smooth`).

    Notes
    -----
    Estimates throughout, and no theorem; the same for any order of the rows and number of threads.
    Curves of the method whose points have no noise to speak of, up to about 6 % of their spacing,
    keep them as their vertices (`unchanged`), unless `noise` is given. Sparse samples of bends,
    beyond about r = 0.4, cannot be told from noise. Points that look like a curve in no window,
    such as uniform ones, have no noise that could be told, NaN, and give no curve, also where
    `noise` is given.

    The noise is taken to be normal and the same in all directions. Two strands beside each
    other all along are told apart from about 3 deviations on, where their points together say
    so: of some hundred points at 3.5 as a rule. Where noise is several spacings, or they are near
    each other in a part only, they can merge or be crossed from one to the other. Bends sharper
    than about two deviations are rounded. Where one curve was traced several times, all passes
    together give one line. Ends of lines are where the points' density ends. O(n log n) time.

    On 200 points of a circle with noise of 2 to 23 % of its radius the result is within 1.25 times
    the error of the circle that fits best, though it knows of no circle.

    References
    ----------
    .. [1] U. Ozertem, D. Erdogmus, "Locally Defined Principal Curves and Surfaces", Journal of
       Machine Learning Research 12 (2011), 1249-1286.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> angle = rng.uniform(0, 2 * np.pi, 300)
    >>> circle = np.column_stack((np.cos(angle), np.sin(angle)))
    >>> found = denoise(circle + rng.normal(0, 0.1, circle.shape))
    >>> found
    <Denoised: 1 ring, 0 polylines, 0 outliers; 300 points>
    >>> radii = np.hypot(*found.curves.points.xy.T)
    >>> bool(np.abs(radii - 1).max() < 0.05), bool(0.09 < np.median(found.noise) < 0.11)
    (True, True)
    """
    require("smooth", "scipy")
    method = as_method(method, {})
    delaunay = as_delaunay(points)
    _check(delaunay)
    if crs is not None:
        return _in_crs(delaunay, crs, noise=noise, method=method)
    given = None if noise is None else as_noise(noise, delaunay.points.xy)
    parts = clean_strands(delaunay, method) if given is None else []
    is_left = rest(delaunay, parts) if given is None else _looks_like_a_curve(delaunay)
    rows = np.flatnonzero(is_left)
    if len(rows) == len(delaunay):
        left: Delaunay | None = delaunay
    else:
        left = delaunay.alike(delaunay.points.xy[rows]) if len(rows) >= ROWS else None
    if left is not None:
        known = None if given is None else given[rows]
        parts += [part.of_rows(rows) for part in strands(left, known, method)]
    return _assembled(delaunay.points, parts)


def _looks_like_a_curve(delaunay: Delaunay) -> BoolArray:
    """Return where the noise could be estimated: knowing it does not make a curve of a cloud."""
    first_rows, noise = delaunay.run(_core.ridge, None)[:2]
    is_seen = np.zeros(len(delaunay), bool)
    is_seen[first_rows] = np.isfinite(noise)
    repeated, first = delaunay.duplicates.T
    is_seen[repeated] = is_seen[first]
    return is_seen


def _in_crs(delaunay: Delaunay, crs: str, **how: Any) -> Denoised:
    """Return what is found in another CRS, with the vertices in that of the points."""
    flat = project(delaunay.points, crs)
    found = denoise(delaunay.alike(flat), **how)
    at = project(Points(found.curves.points.xy, crs=flat.crs), str(delaunay.points.crs))
    curves = replace(found.curves, points=at)
    return replace(found, points=delaunay.points, curves=curves, crs=flat.crs)


def as_noise(noise: ArrayLike, points: FloatArray) -> FloatArray:
    """Return deviations of the noise, one a row."""
    given = as_floats("noise", noise)
    if given.ndim == 0:
        given = np.full(len(points), as_real("noise", given.item(), "0 or more", lambda x: x >= 0))
    if given.shape != (len(points),):
        raise InputError(
            f"noise must be one number or one for each of the {len(points)} rows, "
            f"not of shape {given.shape}"
        )
    wrong = np.flatnonzero(~(np.isfinite(given) & (given >= 0)))
    if wrong.size:
        raise InputError(f"row {wrong[0]}: noise must be 0 or more, not {given[wrong[0]]}")
    if not given.any():
        raise InputError("noise is 0 everywhere: leave it out, and it is estimated")
    extent = float(np.hypot(*np.ptp(points, axis=0)))
    if given.max() > extent:
        row = int(given.argmax())
        raise InputError(
            f"row {row}: noise of {given[row]:g} is larger than the extent of the points, "
            f"{extent:g}: give it in the unit of the coordinates"
        )
    return given


def _check(delaunay: Delaunay) -> None:
    different = len(delaunay) - len(delaunay.duplicates)
    if different < 3:
        raise InputError(
            f"the {len(delaunay)} points are at {different} different places: "
            "a curve through noisy points needs three at least"
        )
    with np.errstate(over="ignore"):
        as_size("the extent of the points", float(np.ptp(delaunay.points.xy, axis=0).max()))


def _assembled(points: Points, parts: list[Strand]) -> Denoised:
    """Return the parts as one: curves, and what is known of each vertex and row."""
    offsets = np.cumsum([0, *(len(part.vertices) for part in parts)])
    edges = [part.edges + offset for part, offset in zip(parts, offsets, strict=False)]
    at = [part.vertices for part in parts]
    xy = np.vstack(at or [np.empty((0, 2))])
    curves = trace(
        Points(xy, crs=points.crs, names=points.names),
        np.vstack(edges or [np.empty((0, 2), np.int64)]),
    )
    vertices, noise = np.full(len(points), -1), np.full(len(points), np.nan)
    for part, offset in zip(parts, offsets, strict=False):
        vertices[part.rows] = part.owners + offset
        noise[part.rows] = part.noise
    first = curves.indices[curves.offsets[:-1]]
    unchanged = np.array([part.unchanged for part in parts], bool)
    return Denoised(
        points,
        curves,
        np.concatenate([part.uncertainty for part in parts] or [np.empty(0)]),
        vertices,
        noise,
        unchanged[np.searchsorted(offsets, first, side="right") - 1],
    )
