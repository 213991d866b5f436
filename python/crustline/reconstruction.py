"""Reconstruction: points, the method that connects them, and all that follows, made when asked for.

The command, pictures and notebooks share it; `reconstruct` is the one-liner that gives the curves.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray, as_edges
from crustline.certify import Certificate, certify
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay, as_delaunay, points_and_how
from crustline.interpolant import local_feature_size
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.methods import as_method, connect, name_of
from crustline.points import Points

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
    delaunay : Delaunay
        The triangulation, which all else shares.
    edges : ndarray of int64, shape (m, 2)
        What the method selects: i < j in each row, rows sorted.
    curves : Curves
        The edges traced: see `trace`.
    medial_axis : MedialAxis
        See `crustline.medial_axis`.
    local_feature_size : ndarray of float64, shape (n,)
        See `crustline.local_feature_size`.
    certificate : Certificate
        See `certify`.

    Raises
    ------
    InputError
        If the points do not fit, the method is none, or its parameters are others; later, if the
        edges that it returns do not fit.

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
        **parameters: Any,
    ) -> None:
        self.method: Callable[..., npt.ArrayLike] = as_method(method, parameters)
        self.parameters: Mapping[str, Any] = MappingProxyType(parameters)
        self.points: Points = points_and_how(points)[0]
        self._given = points if isinstance(points, Delaunay) else self.points

    @cached_property
    def delaunay(self) -> Delaunay:
        """The triangulation."""
        return as_delaunay(self._given)

    @cached_property
    def edges(self) -> IntArray:
        """What the method selects, shape (m, 2): i < j in each row, rows sorted."""
        return as_edges(self.method(self.delaunay, **self.parameters), len(self.points))

    @cached_property
    def curves(self) -> Curves:
        """The rings and polylines of the edges."""
        return trace(self.delaunay, self.edges)

    @cached_property
    def medial_axis(self) -> MedialAxis:
        """The medial axis of the curves."""
        return medial_axis(self.delaunay, self.edges)

    @cached_property
    def local_feature_size(self) -> FloatArray:
        """The local feature size at each point, shape (n,), estimated."""
        return local_feature_size(self.delaunay, self.edges)

    @cached_property
    def certificate(self) -> Certificate:
        """What is guaranteed about the edges, and where not."""
        return certify(self.delaunay, self.edges)

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
        return self.__reduce__() == other.__reduce__()

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Reconstruction:
        return self

    def __deepcopy__(self, memo: object) -> Reconstruction:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild, (self._given, self.method, dict(self.parameters))

    def __repr__(self) -> str:
        count = len(self.points)
        return f"<Reconstruction: {count:,} point{'s' * (count != 1)} by {name_of(self.method)}>"


def _rebuild(
    points: Points | Delaunay, method: Callable[..., npt.ArrayLike], parameters: dict[str, Any]
) -> Reconstruction:
    return Reconstruction(points, method, **parameters)


def as_reconstruction(points: npt.ArrayLike | Delaunay | Reconstruction) -> Reconstruction:
    """Return a reconstruction as it is, and else that of the points by the default method."""
    return points if isinstance(points, Reconstruction) else Reconstruction(points)


def reconstruct(
    points: npt.ArrayLike | Delaunay,
    method: Callable[..., npt.ArrayLike] = connect,
    **parameters: Any,
) -> Curves:
    """Return the curves that the points were sampled from, by a method.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. What points carry is kept.
    method : callable, default `connect`
        Takes the triangulation of the points and returns edges.
    **parameters
        Passed on to the method, such as ``beta=1.5`` for `beta_skeleton`.

    Returns
    -------
    curves : Curves
        The edges of the method, traced: see `trace`.

    Raises
    ------
    InputError
        If the points, the method, a parameter or the edges that it returns do not fit.

    See Also
    --------
    Reconstruction : the same with the medial axis, feature sizes and certificate.

    Examples
    --------
    >>> curves = reconstruct([(0, 0), (1, 1), (1, 0), (0, 1)])
    >>> curves[0].indices.tolist(), curves[0].closed
    ([0, 2, 1, 3], True)
    """
    return Reconstruction(points, method, **parameters).curves
