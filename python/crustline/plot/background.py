"""Outlines of a map below the curves: the coasts of the world, or what a file holds.

`coast.npz` holds the coasts of Natural Earth at 1:110,000,000, which are in the public domain
(https://www.naturalearthdata.com), in hundredths of a degree.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crustline.arrays import FloatArray
from crustline.curves import Curves, trace
from crustline.errors import InputError
from crustline.formats import read_curves
from crustline.formats.vertices import edges_along
from crustline.plot.axes import axes, draw_segments
from crustline.points import Points
from crustline.projection import is_geographic, looks_geographic, project

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LIGHT = "#bdb7a8"
_WORLD = "EPSG:4326"
#: Of the extent of the points on each side, and of the whole earth's: what is drawn around them.
_AROUND, _LEAST = 1.0, 1e-9


def plot_background(
    points: Points, ax: Axes | None = None, *, outlines: str | os.PathLike[str] | Curves = "world"
) -> Axes:
    """Draw the outlines of a map around points, in the CRS of the points.

    Parameters
    ----------
    points : Points
        What is drawn above, with its CRS; columns called longitude and latitude need none.
    ax : Axes, optional
        Where to draw; new Axes if not given. Its limits stay those of the points.
    outlines : "world", path-like or Curves, default "world"
        The world's coasts, at 1:110,000,000; or lines and polygons, in a file of any format that
        curves are read from, such as coast.gpkg.

    Returns
    -------
    ax : Axes

    Raises
    ------
    InputError
        If only one of both has a CRS.

    Examples
    --------
    >>> from crustline import Points
    >>> fiji = Points([(177, -18), (178, -17)], crs="EPSG:4326")
    >>> ax = plot_background(fiji)
    """
    ax, xy = axes(ax, points)
    known = outlines if isinstance(outlines, Curves) else _read(outlines)
    segments = _around(known, points) if len(xy) else np.empty((0, 2, 2))
    return draw_segments(ax, segments, LIGHT, 0.8, zorder=0.5)


def _read(outlines: str | os.PathLike[str]) -> Curves:
    return _coasts() if outlines == "world" else read_curves(outlines)


@cache
def _coasts() -> Curves:
    with np.load(Path(__file__).with_name("coast.npz")) as kept:
        sizes, xy = kept["sizes"].astype(np.int64), kept["hundredths"] / 100
    lines = np.ones(len(sizes), np.bool_)
    return trace(Points(xy, crs=_WORLD), edges_along(sizes, lines, ~lines))


def _around(outlines: Curves, points: Points) -> FloatArray:
    """Return the segments of outlines near points, (m, 2, 2), in the CRS of the points."""
    crs = _WORLD if looks_geographic(points) else points.crs
    there = outlines.points
    if (there.crs is None) != (crs is None):
        without = "points" if crs is None else "outlines of the background"
        raise InputError(f"the {without} have no CRS, and the others have: name it (--crs)")
    if crs is None or there.crs is None or crs == there.crs:
        return _near(there.xy, outlines.edges, points.xy, is_geographic(there))
    # What is far away may be nowhere in the other system: only what is near is projected.
    here = project(points.replace(crs=crs), there.crs)
    segments = _near(there.xy, outlines.edges, here.xy, is_geographic(there))
    if not len(segments):
        return segments
    ends = Points(segments.reshape(-1, 2), crs=there.crs)
    projected: FloatArray = project(ends, crs).xy.reshape(-1, 2, 2)
    return projected


def _near(
    xy: FloatArray, edges: NDArray[np.int64], points: FloatArray, degrees: bool
) -> FloatArray:
    """Return the segments whose boxes meet that around points."""
    low, high = points.min(axis=0), points.max(axis=0)
    margin = _AROUND * (high - low).max() + _LEAST
    segments: FloatArray = xy[edges]
    least, most = segments.min(axis=1), segments.max(axis=1)
    near = ((most >= low - margin) & (least <= high + margin)).all(axis=1)
    if degrees:  # across the 180th meridian they would lead around the world
        near &= most[:, 0] - least[:, 0] <= 180
    kept: FloatArray = segments[near]
    return kept
