"""Reconstruction: points, the method that connects them, and all that follows, made when asked for.

The command, pictures and notebooks share it; `reconstruct` is the one-liner that gives the curves.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray, as_edges, as_floats, equal, read_only
from crustline.certify import Certificate, certify
from crustline.connection import Connection, connection
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay, as_delaunay, points_and_how
from crustline.denoise import Denoised, denoise
from crustline.errors import InputError
from crustline.interpolant import local_feature_size
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.merge import Merged, merge
from crustline.methods import as_method, connect, name_of
from crustline.points import Points
from crustline.projection import project, unprojected
from crustline.scalars import as_flag, as_length

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Reconstruction", "as_reconstruction", "reconstruct"]


class Reconstruction:
    """Points and what a method makes of them; each part is computed once, when first asked for.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. What points carry is kept. A `Delaunay` brings its
        threads and progress.
    method : callable, default `connect`
        Takes the triangulation of the points (which serves as an array of them) and returns edges.
    fit : bool, default False
        Whether to fit curves to noisy points, with new vertices: see `crustline.denoise`. The
        method connects what they are fitted from.
    noise : float or array_like of float, shape (n,), optional
        With `fit`, the standard deviation of the noise, of all points or of each. By default it is
        estimated.
    crs : str, optional
        With `fit`, the CRS to fit in, or "auto".
    merge : float, optional
        Points within this distance of each other are one: see `crustline.merge`. Rows stay those of
        the points that were given.
    **parameters
        Passed on to the method, such as ``beta=1.5`` for `beta_skeleton`.

    Attributes
    ----------
    points : Points
        The points, with all that they carry.
    method : callable
        The method.
    parameters : mapping of str to object
        Its parameters.
    fit : bool
        Whether curves are fitted.
    delaunay : Delaunay
        The triangulation of the points.
    denoised : Denoised or None
        With `fit`, the fitted curves with their rows, uncertainties and outliers.
    vertices : Points
        What edges, feature sizes and the certificate are about: the points, or with `fit` the
        vertices of the fitted curves, and the outliers after them.
    edges : ndarray of int64, shape (m, 2)
        What the method selects, or the edges of the fitted curves: rows of `vertices`, i < j in
        each, rows sorted.
    curves : Curves
        The edges traced: see `trace`. With `fit` see `Denoised.annotated`.
    medial_axis : MedialAxis
        See `crustline.medial_axis`.
    local_feature_size : ndarray of float64, shape (v,)
        See `crustline.local_feature_size`.
    certificate : Certificate
        See `certify`.
    connection : Connection
        See `crustline.connection`; of the method `connect` only.
    merged : ndarray of int64, shape (d, 2)
        A row that was merged, and the row that stands for it; sorted.

    Raises
    ------
    InputError
        If the points do not fit, the method is none, its parameters are others, or there is `noise`
        or `crs` without `fit`; later, if the edges that it returns do not fit.

    Examples
    --------
    >>> goose = Reconstruction([(0, 0), (1, 1), (1, 0), (0, 1)])
    >>> goose
    <Reconstruction: 4 points by connect>
    >>> goose.curves, goose.certificate.guaranteed
    (<Curves: 1 ring, 0 polylines, 0 isolated points; 4 points>, False)
    """

    def __init__(
        self,
        points: npt.ArrayLike | Delaunay,
        method: Callable[..., npt.ArrayLike] = connect,
        *,
        fit: bool = False,
        noise: npt.ArrayLike | None = None,
        crs: str | None = None,
        merge: float | None = None,
        **parameters: Any,
    ) -> None:
        self.fit = as_flag("fit", fit)
        for name, given in (("noise", noise), ("crs", crs)):
            if given is not None and not self.fit:
                raise InputError(f"{name} is for fitting curves: add fit=True")
        self.method: Callable[..., npt.ArrayLike] = as_method(method, parameters)
        self.parameters: Mapping[str, Any] = MappingProxyType(parameters)
        self.points: Points = points_and_how(points)[0]
        self._fit: dict[str, Any] = {"noise": _copied(noise), "crs": crs}
        self._given = points if isinstance(points, Delaunay) else self.points
        self._tolerance = None if merge is None else as_length("merge", merge)

    @cached_property
    def _merged(self) -> Merged | None:
        return None if self._tolerance is None else merge(self._given, self._tolerance)

    @cached_property
    def delaunay(self) -> Delaunay:
        """The triangulation; points that were merged are repeated ones there."""
        if self._merged is None:
            return as_delaunay(self._given)
        threads, progress = points_and_how(self._given)[1]
        snapped = self._merged.snapped(self.points)
        return Delaunay(snapped, threads=threads, progress=progress)

    @property
    def merged(self) -> IntArray:
        """A row that was merged, and the row that stands for it, shape (d, 2); sorted."""
        return np.empty((0, 2), np.int64) if self._merged is None else self._merged.merged

    @cached_property
    def denoised(self) -> Denoised | None:
        """The fitted curves, with the rows behind each vertex."""
        if not self.fit:
            return None
        method = partial(self.method, **self.parameters)
        return denoise(self.delaunay, method=method, **self._fit)

    @property
    def vertices(self) -> Points:
        """The points, or the vertices of the fitted curves and the outliers."""
        return self.curves.points if self.fit else self.points

    @cached_property
    def _of_vertices(self) -> Delaunay:
        return self.delaunay.alike(self.vertices) if self.fit else self.delaunay

    @cached_property
    def edges(self) -> IntArray:
        """What the method selects, shape (m, 2): i < j in each row, rows sorted."""
        if self.fit:
            return self.curves.edges
        if "connection" in vars(self):
            return self.connection.edges
        if self._merged is None:
            return self._selected
        return as_edges(self._merged.stands[self._selected], len(self.points))

    @cached_property
    def _selected(self) -> IntArray:
        """The same by the first of the rows that are merged, as the triangulation has them."""
        return as_edges(self.method(self.delaunay, **self.parameters), len(self.points))

    @cached_property
    def connection(self) -> Connection:
        """How sure each edge is, and why they are not those of the crust; of `connect` only."""
        method, crs = unprojected(self.method)
        if method is not connect or self.fit:
            raise InputError(
                f"only connect, without fitting, says how sure it is, and this is a reconstruction "
                f"by {name_of(self.method)}: leave the rest away"
            )
        where = self.delaunay if crs is None else self.delaunay.alike(project(self.delaunay, crs))
        found = replace(connection(where, **self.parameters), points=self.points)
        return found if self._merged is None else found.renamed(self.points, self._merged.stands)

    @cached_property
    def curves(self) -> Curves:
        """The rings and polylines of the edges."""
        if self.denoised is not None:
            return self.denoised.annotated()
        return trace(self.delaunay if self._merged is None else self.points, self.edges)

    @cached_property
    def medial_axis(self) -> MedialAxis:
        """The medial axis of the curves."""
        return medial_axis(self._of_vertices, self.edges)

    @cached_property
    def local_feature_size(self) -> FloatArray:
        """The local feature size at each vertex, shape (v,), estimated."""
        return local_feature_size(self._of_vertices, self.edges)

    @cached_property
    def certificate(self) -> Certificate:
        """What is guaranteed about the edges, and where not."""
        # By the rows that the triangulation has, so that merged ones are not missing.
        edges = self.edges if self._merged is None or self.fit else self._selected
        return certify(self._of_vertices, edges)

    def picture(
        self, path: str | os.PathLike[str], *, show: Sequence[str] = ("points", "crust")
    ) -> None:
        """Write a picture of any of it with matplotlib: see `crustline.plot.picture`."""
        from crustline.plot import picture

        picture(self, path, show=show)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the curves with matplotlib; see `crustline.plot.plot_curves`."""
        return self.curves.plot(ax, **options)

    def _repr_svg_(self) -> str:
        """Return the picture that notebooks show: that of the curves."""
        return self.curves._repr_svg_()

    def __eq__(self, other: object) -> bool:
        """Whether points, method and parameters are equal: they decide all else."""
        if not isinstance(other, Reconstruction):
            return NotImplemented
        same_fit = self.fit == other.fit and equal(self._fit, other._fit)
        same_fit &= self._tolerance == other._tolerance
        return same_fit and self.__reduce__()[1][:3] == other.__reduce__()[1][:3]

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Reconstruction:
        return self

    def __deepcopy__(self, memo: object) -> Reconstruction:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        how = {"fit": self.fit, "merge": self._tolerance, **self._fit}
        return _rebuild, (self._given, self.method, dict(self.parameters), how)

    def __repr__(self) -> str:
        count = len(self.points)
        how = f"{'fitted ' * self.fit}by {name_of(self.method)}"
        return f"<Reconstruction: {count:,} point{'s' * (count != 1)} {how}>"


def _rebuild(
    points: Points | Delaunay,
    method: Callable[..., npt.ArrayLike],
    parameters: dict[str, Any],
    how: dict[str, Any],
) -> Reconstruction:
    return Reconstruction(points, method, **how, **parameters)


def _copied(noise: npt.ArrayLike | None) -> npt.ArrayLike | None:
    """Return the noise in a form that the caller cannot change any more."""
    return read_only(as_floats("noise", noise)) if isinstance(noise, np.ndarray | list) else noise


def as_reconstruction(points: npt.ArrayLike | Delaunay | Reconstruction) -> Reconstruction:
    """Return a reconstruction as it is, and else that of the points by the default method."""
    return points if isinstance(points, Reconstruction) else Reconstruction(points)


def reconstruct(  # noqa: PLR0913 - all but the first have a default
    points: npt.ArrayLike | Delaunay,
    method: Callable[..., npt.ArrayLike] = connect,
    *,
    fit: bool = False,
    noise: npt.ArrayLike | None = None,
    crs: str | None = None,
    orient: str | None = None,
    start: Any = None,
    merge: float | None = None,
    **parameters: Any,
) -> Curves:
    """Return the curves that the points were sampled from, by a method.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. What points carry is kept.
    method : callable, default `connect`
        Takes the triangulation of the points and returns edges.
    fit : bool, default False
        Whether to fit curves to noisy points, with new vertices: see `crustline.denoise`.
    noise : float or array_like of float, shape (n,), optional
        With `fit`, the standard deviation of the noise, of all points or of each. By default it is
        estimated.
    crs : str, optional
        With `fit`, the CRS to fit in, or "auto".
    orient : {"ccw", "cw", "rfc7946", "gis"}, optional
        The direction of the rings: see `Curves.oriented`. By default counter-clockwise.
    start : pair of float, int, or {"west", "east", "south", "north"}, optional
        Where rings, and of their two ends polylines, start: see `Curves.oriented`.
    merge : float, optional
        Points within this distance of each other are one: see `crustline.merge`. The curves go
        through the row that stands for each group; the others are isolated, as repeated rows are.
    **parameters
        Passed on to the method, such as ``beta=1.5`` for `beta_skeleton`, or ``closed=True`` for
        `connect`.

    Returns
    -------
    curves : Curves
        The edges of the method, traced: see `trace`. With `fit`, curves through new vertices, each
        with its rows and its uncertainty as columns: see `Denoised.annotated`.

    Raises
    ------
    InputError
        If the points, the method, a parameter or the edges that it returns do not fit, or there is
        `noise` or `crs` without `fit`.
    MissingExtraError
        With `fit`, if scipy is not installed (extra `smooth`).

    See Also
    --------
    Reconstruction : the same with the medial axis, feature sizes and certificate.

    Examples
    --------
    >>> curves = reconstruct([(0, 0), (1, 1), (1, 0), (0, 1)])
    >>> curves[0].indices.tolist(), curves[0].closed
    ([0, 2, 1, 3], True)

    Noisy points are fitted:

    >>> rng = np.random.default_rng(0)
    >>> angle = rng.uniform(0, 2 * np.pi, 300)
    >>> circle = np.column_stack((np.cos(angle), np.sin(angle))) + rng.normal(0, 0.1, (300, 2))
    >>> fitted = reconstruct(circle, fit=True)
    >>> len(fitted), bool(fitted[0].closed), list(fitted.points.columns)
    (1, True, ['input_rows', 'uncertainty', 'noise'])

    Points that differ by rounding:

    >>> near = [(0, 0), (1, 1), (1, 0), (0, 1), (1, 1e-12), (1e-12, 1)]
    >>> [curve.indices.tolist() for curve in reconstruct(near, merge=1e-9)]
    [[0, 2, 1, 3]]
    """
    made = Reconstruction(points, method, fit=fit, noise=noise, crs=crs, merge=merge, **parameters)
    oriented = orient is not None or start is not None
    return made.curves.oriented(orient, start=start) if oriented else made.curves
