"""The door for writing: points, curves, splines, and what becomes one of these."""

from __future__ import annotations

from collections.abc import Mapping
from functools import singledispatch
from typing import Any

from crustline.certify import Certificate
from crustline.curves import Curves
from crustline.errors import InputError
from crustline.formats.catalog import format_of_target
from crustline.formats.format import Format
from crustline.formats.target import Target
from crustline.medial_axis import MedialAxis
from crustline.points import Points
from crustline.smooth import Splines

__all__ = ["as_written", "task_of", "write"]


def write(thing: Any, path: Any, *, format: str | None = None, **options: Any) -> None:
    """Write points, curves or what is computed from them to a file, whole or not at all.

    Parameters
    ----------
    thing : Points, Curves, Splines, MedialAxis, Certificate, array_like, or mapping
        A medial axis is written as curves, cut off at its own box; a certificate as the points that
        break it, with their row and the reason. A mapping of names to things is written as the
        layers of one file, in formats that have layers.
    path : path-like or file-like object
        The file, which is replaced if it exists; "-" is standard output.
    format : str, optional
        The name of a format, as `crustline.formats.FORMATS` has them. By default the suffix
        decides.
    polygons : bool, default False
        Curves in GeoJSON, WKT and SVG: rings as polygons with holes (see `Curves.polygons`).
        Polylines remain lines.
    tolerance : float, optional
        Splines: as few pieces as stay within this distance of them, in the unit of the points. By
        default the pieces are the splines themselves.
    over : path-like, optional
        SVG: the picture that the curves were found in, in pixels or in the world; the drawing has
        its size, and shows it below the curves.

    Raises
    ------
    FormatError
        If the file cannot be written; nothing is left behind then.
    InputError
        If the thing, the format or an option is not one of the above, or its value does not fit.
    MissingExtraError
        If the format needs packages that are not installed.

    Notes
    -----
    Coordinates are written with the fewest digits that give the same float64 again.

    - GeoJSON: a feature for each curve with the properties curve, closed and rows; heights as third
      coordinates; the other columns as lists with a value per vertex; one MultiPoint of the
      isolated points. Rings are closed LineStrings, or Polygons that follow the right-hand rule of
      RFC 7946.
    - CSV and TSV: columns curve, order, row, x, y, z if there is one, closed (1 or 0), then the
      input's other columns; isolated points follow as curve -1.
    - WKT: a geometry a line, with the SRID of an EPSG code; a MULTIPOINT of the isolated points.
    - SVG: a path for each curve, y upwards, dots for the isolated points.
    - NPZ: arrays points, indices, offsets, closed, isolated, and z, crs and columns/NAME where
      there are; `read` takes the points from it in the input's order.

    Points that belong to no curves are a row, a Point feature, a member of one MULTIPOINT or a dot
    each; XYZ and NPY hold their coordinates and heights alone.

    Examples
    --------
    >>> from crustline.curves import trace
    >>> write(trace([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (0, 2)]), "-", format="wkt")
    LINESTRING (0.0 0.0, 1.0 0.0, 0.0 1.0, 0.0 0.0)
    """
    target = path if isinstance(path, Target) else Target(path)
    written = as_written(thing)
    task = task_of(written)
    chosen = format_of_target(target, format, task)
    settings = chosen.settings(task, options)
    chosen.require()
    _function(chosen, task)(written, target, **settings)


def _function(chosen: Format, task: str) -> Any:
    return getattr(chosen, task)


def task_of(written: Any) -> str:
    """Return which function of a format writes a thing."""
    if isinstance(written, Mapping):
        return "write_layers"
    kinds = ((Points, "write_points"), (Curves, "write_curves"), (Splines, "write_splines"))
    return next(task for kind, task in kinds if isinstance(written, kind))


@singledispatch
def as_written(thing: Any) -> Any:
    """Return a thing as points, curves or splines, or a mapping of names to points and curves."""
    try:
        return Points(thing)
    except InputError as error:
        raise InputError(
            f"a {type(thing).__name__} is nothing that can be written ({error}): "
            "pass points, curves, splines, a medial axis or a certificate"
        ) from None


@as_written.register(Points)
@as_written.register(Curves)
@as_written.register(Splines)
def _as_it_is(thing: Any) -> Any:
    return thing


@as_written.register
def _axis(thing: MedialAxis) -> Curves:
    return thing.curves()


@as_written.register
def _weak_places(thing: Certificate) -> Points:
    return thing.weak_places()


@as_written.register(Mapping)
def _layers(thing: Mapping[str, Any]) -> dict[str, Any]:
    return {str(name): as_written(each) for name, each in thing.items()}
