"""Reading and writing points, writing curves: one file per format, and the table that finds it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from crustline.errors import InputError
from crustline.formats.crs import normalize_crs
from crustline.formats.file import describe_path, read_bytes, replace_file

if TYPE_CHECKING:
    from crustline.curves import Curves
    from crustline.points import Points

Path = str | os.PathLike[str]


@dataclass(frozen=True)
class Format:
    """Where a format lives: `read_NAME`, `write_NAME` and `write_points_NAME` in a module of this
    package. Points are written in every format."""

    module: str
    suffixes: tuple[str, ...]
    reads: bool = True
    writes: bool = True


FORMATS = {
    "csv": Format("csv", (".csv",)),
    "tsv": Format("csv", (".tsv", ".tab")),
    "xyz": Format("csv", (".xyz", ".txt", ".dat", ".asc"), writes=False),
    "npy": Format("npy", (".npy",), writes=False),
    "npz": Format("npy", (".npz",)),
    "geojson": Format("geojson", (".geojson", ".json")),
    "wkt": Format("wkt", (".wkt",)),
    "svg": Format("svg", (".svg",), reads=False),
}


def read(
    path: Path,
    *,
    columns: Sequence[str | int] | None = None,
    format: str | None = None,
    crs: str | None = None,
) -> Points:
    """Read the points of a file, with heights, other columns and CRS beside them.

    Parameters
    ----------
    path : path-like
        The file; "-" is standard input.
    columns : sequence of str or int, length 2 or 3, optional
        The columns that hold x, y and, if given, z: names, or positions counted from 0. By default
        x and y, lon and lat, longitude and latitude, easting and northing, or e and n are found by
        name in any case, and z, elevation or height with them. Without a header the first two
        columns are x and y and the third is z.
    format : {"csv", "tsv", "xyz", "npy", "npz", "geojson", "wkt"}, optional
        By default the suffix decides, and the content where the suffix is unknown.
    crs : str, optional
        The coordinate reference system, such as "EPSG:4326", in place of what the file says.
        Nothing is transformed.

    Returns
    -------
    points : Points
        One row for each point of the file, in its order, with `z`, `columns`, `crs` and `names`.

    Raises
    ------
    FormatError
        If the file cannot be read, is empty, or holds a value, row or column that does not fit; the
        message names the file, the line and the value.
    InputError
        If `columns` or `format` is not one of the above.

    Notes
    -----
    Numbers are read exactly, to the nearest float64. csv, tsv and xyz are one reader: comma, tab,
    semicolon or spaces between columns, lines that start with # are comments, decimal commas where
    semicolons separate. Other columns are numbers if every value is one, else str objects. GeoJSON
    and WKT give the vertices of every geometry, without the vertex that closes a ring. A property
    that is everywhere a list with a value per vertex is spread over the vertices.

    Examples
    --------
    >>> import os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "points.csv")
    >>> with open(path, "w") as file:
    ...     _ = file.write("lon,lat,name\\n8.5,47.4,Zurich\\n7.4,46.9,Bern\\n")
    >>> points = read(path, crs="EPSG:4326")
    >>> len(points), points.columns["name"].tolist()
    (2, ['Zurich', 'Bern'])
    """
    chosen = None if columns is None else _check_columns(columns)
    _check_format(format, "read")
    content = read_bytes(path)
    name = describe_path(path)
    key = format or format_of(path, "read") or _sniff(content)
    points: Points = _function("read", key)(content, name, chosen)
    if crs is not None or points.crs is not None:
        points = points.replace(crs=normalize_crs(crs if crs is not None else str(points.crs)))
    return points


def write(curves: Curves, path: Path, *, format: str | None = None, polygons: bool = False) -> None:
    """Write curves to a file, whole or not at all.

    Parameters
    ----------
    curves : Curves
        What `trace` or `reconstruct` returns.
    path : path-like
        The file, which is replaced if it exists; "-" is standard output.
    format : {"geojson", "csv", "tsv", "wkt", "svg", "npz"}, optional
        By default the suffix decides.
    polygons : bool, default False
        Write rings as polygons with holes (see `Curves.polygons`) where the format knows them,
        which is GeoJSON, WKT and SVG. Polylines remain lines.

    Raises
    ------
    FormatError
        If the file cannot be written; nothing is left behind then.
    InputError
        If the format is unknown.

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

    Examples
    --------
    >>> from crustline.curves import trace
    >>> write(trace([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (0, 2)]), "-", format="wkt")
    LINESTRING (0.0 0.0, 1.0 0.0, 0.0 1.0, 0.0 0.0)
    """
    key = output_format(path, format)
    replace_file(path, _function("write", key)(curves, polygons=polygons))


def write_points(points: Points, path: Path, *, format: str | None = None) -> None:
    """Write points with all that they carry to a file, whole or not at all: see `Points.write`."""
    key = output_format(path, format, "write_points")
    replace_file(path, _function("write_points", key)(points))


def output_format(path: Path, format: str | None = None, task: str = "write") -> str:
    """Return the format in which to "write" curves or to "write_points", or raise `InputError`."""
    _check_format(format, task)
    key = format or format_of(path, task)
    if key is None:
        known = ", ".join(suffix for each in _known(task) for suffix in FORMATS[each].suffixes)
        raise InputError(
            f"no format is known for the output {describe_path(path)!r}: name it {known}, "
            f"or choose one of {', '.join(_known(task))}"
        )
    return key


def format_of(path: Path, task: str) -> str | None:
    """Return the format that a path's suffix names and that can "read", "write"…"""
    suffix = PurePath(path).suffix.lower()
    return next((key for key in _known(task) if suffix in FORMATS[key].suffixes), None)


def _known(task: str) -> list[str]:
    able = {"read": "reads", "write": "writes"}.get(task)
    return [key for key, each in FORMATS.items() if able is None or getattr(each, able)]


def _check_format(format: str | None, task: str) -> None:
    if format is not None and format not in _known(task):
        known = ", ".join(_known(task))
        verb = task.removesuffix("_points")
        raise InputError(f"nobody knows how to {verb} the format {format!r}: choose one of {known}")


def _check_columns(columns: Sequence[str | int]) -> tuple[str | int, ...]:
    if isinstance(columns, str) or len(columns) not in (2, 3):
        raise InputError(f"columns is {columns!r}: choose two for x and y, or three with z")
    return tuple(columns)


def _function(task: str, key: str) -> Any:
    return getattr(import_module(f"{__name__}.{FORMATS[key].module}"), f"{task}_{key}")


def _sniff(content: bytes) -> str:
    """Return the format that the first bytes show; whatever is nothing else is columns of text."""
    from crustline.formats.wkt import looks_like_wkt

    if content.startswith(b"\x93NUMPY"):
        return "npy"
    if content.startswith(b"PK\x03\x04"):
        return "npz"
    start = content[:200].lstrip(b"\xef\xbb\xbf \t\r\n")
    if start.startswith(b"{"):
        return "geojson"
    return "wkt" if looks_like_wkt(start) else "csv"


__all__ = ["FORMATS", "format_of", "output_format", "read", "write", "write_points"]
