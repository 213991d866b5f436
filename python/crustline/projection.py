"""Map projections, by PROJ: distances and angles on the globe for methods of the plane."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crustline.delaunay import Delaunay, points_and_how
from crustline.errors import InputError, MissingExtraError, require, shown
from crustline.points import Points, as_crs

__all__ = [
    "is_geographic",
    "looks_geographic",
    "project",
    "projected",
    "stereographic",
    "to_longitude_latitude",
]

_LONGITUDE_LATITUDE = "OGC:CRS84"
_LONGITUDES, _LATITUDES = {"lon", "lng", "long", "longitude"}, {"lat", "latitude"}
_WGS_84 = (_LONGITUDE_LATITUDE, "EPSG:4326")
#: Mean directions shorter than this belong to points all around the globe.
_AROUND = 0.1


def project(points: ArrayLike | Delaunay, crs: str = "auto") -> Points:
    """Return points in another coordinate reference system, with all that they carry.

    Parameters
    ----------
    points : Points or Delaunay
        With a CRS.
    crs : str, default "auto"
        Where to: "EPSG:25832" or whatever PROJ knows; or "auto", which leaves planar coordinates as
        they are and takes longitudes and latitudes to the stereographic projection about the middle
        of the points. It is conformal, and circles on the sphere stay circles, so that a curve
        across the 180th meridian, or around a pole, is as whole as any other.

    Returns
    -------
    points : Points
        The same rows. x is east, y is north; in meters for "auto".

    Raises
    ------
    InputError
        If the points have no CRS, a CRS is unknown, or a point is nowhere in the new one; names the
        row.
    MissingExtraError
        If pyproj is not installed.

    Examples
    --------
    >>> fiji = Points([(179.5, -17), (-179.5, -17)], crs="EPSG:4326")
    >>> across = project(fiji)
    >>> bool(abs(across.xy[1, 0] - across.xy[0, 0]) < 107_000)
    True
    """
    points, _ = points_and_how(points)
    crs = as_crs(crs) or "auto"
    if points.crs is None:
        raise InputError("the points have no CRS to project from: name it with crs (--crs)")
    source = _crs(points.crs)
    if crs != "auto":
        return _transformed(points, source, _crs(crs), crs)
    if not source.is_geographic:
        return points
    longitude, latitude = _middle(to_longitude_latitude(points).xy)
    name = f"+proj=stere +lat_0={latitude!r} +lon_0={longitude!r} +datum=WGS84 +units=m"
    return _transformed(points, source, _crs(name), name)


def projected(method: Callable[..., Any], crs: str = "auto") -> Callable[..., Any]:
    """Return a method that selects the edges of projected points.

    Parameters
    ----------
    method : callable
        Takes points and returns edges, such as `crust`.
    crs : str, default "auto"
        As for `project`.

    Returns
    -------
    method : callable
        Takes points with a CRS and returns edges: rows of the points as they were passed.

    Examples
    --------
    >>> from crustline.methods import crust
    >>> fiji = Points([(179, -17), (180, -16), (-179, -17), (-180, -18)], crs="EPSG:4326")
    >>> projected(crust)(fiji).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    """

    @wraps(method)
    def select(points: Any, **parameters: Any) -> Any:
        return method(project(points, crs), **parameters)

    vars(select)["projected_to"] = crs
    return select


def unprojected(method: Callable[..., Any]) -> tuple[Callable[..., Any], str | None]:
    """Return the method that `projected` was given, and the CRS; any other one as it is, and None.

    Examples
    --------
    >>> from crustline.methods import crust
    >>> unprojected(projected(crust)) == (crust, "auto"), unprojected(crust) == (crust, None)
    (True, True)
    """
    crs: str | None = getattr(method, "projected_to", None)
    return (method, None) if crs is None else (method.__wrapped__, crs)  # type: ignore[attr-defined]


def to_longitude_latitude(points: Points) -> Points:
    """Return points that have a CRS in longitude and latitude on WGS 84, in this order."""
    if points.crs in _WGS_84:
        return points
    return project(points, _LONGITUDE_LATITUDE)


def is_geographic(points: Points) -> bool:
    """Return whether the coordinates of points are angles, as far as is known of their CRS."""
    if points.crs is None or points.crs in _WGS_84:
        return points.crs is not None
    try:
        return bool(_crs(points.crs).is_geographic)
    except (InputError, MissingExtraError):
        return False


def looks_geographic(points: Points) -> bool:
    """Return whether points without a CRS are called longitude and latitude, and can be."""
    words = {word for name in points.names for word in re.findall("[a-z]+", name.lower())}
    called = bool(words & _LONGITUDES) and bool(words & _LATITUDES)
    within = bool((np.abs(points.xy) <= (360, 90)).all())
    return points.crs is None and called and within


def stereographic(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return longitudes and latitudes on the stereographic map of a sphere about their middle."""
    middle, parallel = np.radians(_middle(degrees))
    longitude, latitude = np.radians(degrees).T
    east = np.cos(latitude) * np.sin(longitude - middle)
    away = np.cos(latitude) * np.cos(longitude - middle)
    north = np.cos(parallel) * np.sin(latitude) - np.sin(parallel) * away
    towards = np.sin(parallel) * np.sin(latitude) + np.cos(parallel) * away
    scale = 2 / np.maximum(1 + towards, 1e-15)  # the point on the other side is infinitely far
    return np.stack([scale * east, scale * north], axis=1)


def _crs(name: str) -> Any:
    require("gis", "pyproj")
    import pyproj

    try:
        return pyproj.CRS.from_user_input(name)
    except (pyproj.exceptions.CRSError, UnicodeEncodeError):
        raise InputError(f"the CRS {shown(name)} is unknown: write it as EPSG:25832") from None


def _transformed(points: Points, source: Any, target: Any, name: str) -> Points:
    import pyproj

    change: Callable[..., Any] = pyproj.Transformer.from_crs(
        source, target, always_xy=True
    ).transform
    xy = np.stack(change(*points.xy.T), axis=1) if len(points) else points.xy
    lost = ~np.isfinite(xy).all(axis=1)
    if lost.any():
        row = int(np.argmax(lost))
        place = points.xy[row].tolist()
        raise InputError(f"points: row {row}, {place}, is nowhere in {name}: choose another CRS")
    return Points(xy, z=points.z, columns=points.columns, crs=name, names=points.names)


def _middle(degrees: ArrayLike) -> tuple[float, float]:
    """Return the longitude and latitude in the middle of points on the globe.

    It is the mean direction. Points all around the globe, along its equator or any other great
    circle, have none; the axis that they run around serves then.
    """
    longitude, latitude = np.radians(np.asarray(degrees, dtype=np.float64)).T
    flat = np.cos(latitude)
    places: NDArray[np.float64] = np.stack(
        [flat * np.cos(longitude), flat * np.sin(longitude), np.sin(latitude)], axis=1
    )
    mean = places.mean(axis=0) if len(places) else np.array([1.0, 0.0, 0.0])
    if np.linalg.norm(mean) < _AROUND:
        mean = np.linalg.svd(places, full_matrices=False)[2][2]
    x, y, z = mean
    return float(np.degrees(np.arctan2(y, x))), float(np.degrees(np.arctan2(z, np.hypot(x, y))))
