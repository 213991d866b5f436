"""The doors for reading: points, curves, pieces of points, and what a file holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING, Any

from crustline.formats.catalog import able, format_of_source, suffixes_for
from crustline.formats.crs import normalize_crs
from crustline.formats.format import Format, Layer
from crustline.formats.packed import member, unpacked
from crustline.formats.signatures import known_archive
from crustline.formats.source import Source
from crustline.points import Points, as_crs

if TYPE_CHECKING:
    from crustline.curves import Curves

__all__ = ["layers", "opened", "read", "read_curves", "stream"]


def read(
    path: Any,
    *,
    format: str | None = None,
    crs: str | None = None,
    **options: Any,
) -> Points:
    """Read the points of a file, with heights, other columns and CRS beside them.

    Parameters
    ----------
    path : path-like, bytes, file-like object or iterable of bytes
        The file, or what is in it; "-" is standard input.
    format : str, optional
        The name of a format, as `crustline.formats.FORMATS` has them. By default the suffix
        decides, and the content where the suffix does not.
    crs : str, optional
        The coordinate reference system, such as "EPSG:4326", in place of what the file says.
        Nothing is transformed.
    columns : sequence of str or int, length 2 or 3, optional
        CSV, TSV, XYZ, NPY, NPZ: the columns that hold x, y and, if given, z: names, or positions
        counted from 0. By default x and y, lon and lat, longitude and latitude, easting and
        northing, or e and n are found by name in any case, and z, elevation or height with them.
        Without a header the first two columns are x and y and the third is z.
    mask, lines : bool, default False
        Pictures: points of the boundary of a mask, or of the middles of strokes, in place of edges.
    color : str or sequence of three numbers, optional
        Pictures: the color of an area or, with `lines`, of strokes, such as "#d00".
    axes : str or crustline.images.Axes, optional
        Pictures of plots: what the axes show, such as "60,430=0,1 560,30=10,1e4 log=y".
        The pixels are the columns pixel_x and pixel_y then; connect by `crustline.in_columns`.
    pixels : bool, default False
        Pictures: pixels in place of coordinates of the world. See `crustline.images`.

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
        If the format or an option is not one of the above, or its value does not fit.
    MissingExtraError
        If the format needs packages that are not installed.

    Notes
    -----
    Numbers are read exactly, to the nearest float64. csv, tsv and xyz are one reader: comma, tab,
    semicolon or spaces between columns, lines that start with # are comments, decimal commas where
    semicolons separate. Other columns are numbers if every value is one, else str objects. GeoJSON
    and WKT give the vertices of every geometry, without the vertex that closes a ring. A property
    that is everywhere a list with a value per vertex is spread over the vertices.

    Examples
    --------
    >>> points = read(b"lon,lat,name\\n8.5,47.4,Zurich\\n7.4,46.9,Bern\\n", crs="EPSG:4326")
    >>> points.xy.tolist(), points.columns["name"].tolist()
    ([[8.5, 47.4], [7.4, 46.9]], ['Zurich', 'Bern'])
    """
    source = opened(path)
    chosen = format_of_source(source, format)
    settings = chosen.settings("read", options)
    chosen.require()
    assert chosen.read is not None
    source.note("format", chosen.title)
    with _library(chosen, source):
        return _with_crs(chosen.read(source, **settings), crs)


def read_curves(
    path: Any, *, format: str | None = None, crs: str | None = None, **options: Any
) -> Curves:
    """Read the curves of a file: the lines and rings that it holds, not only their vertices.

    Parameters
    ----------
    path, format, crs, **options
        As for `read`.

    Returns
    -------
    curves : Curves
        Traced from the edges that the file gives: rings and polylines, split at branches.

    Raises
    ------
    FormatError, InputError, MissingExtraError
        As for `read`; `InputError`, too, if the format knows points only.
    """
    from dataclasses import replace

    source = opened(path)
    chosen = format_of_source(source, format, "read_curves")
    settings = chosen.settings("read_curves", options)
    chosen.require()
    assert chosen.read_curves is not None
    with _library(chosen, source):
        curves = chosen.read_curves(source, **settings)
    return replace(curves, points=_with_crs(curves.points, crs))


def stream(
    path: Any,
    rows: int = 1_000_000,
    *,
    format: str | None = None,
    crs: str | None = None,
    **options: Any,
) -> Iterator[Points]:
    """Read the points of a file piece by piece, for files larger than memory.

    Parameters
    ----------
    path, format, crs, **options
        As for `read`.
    rows : int, default 1,000,000
        About how many points a piece has.

    Yields
    ------
    points : Points
        The pieces in the order of the file. A format that cannot be read in pieces gives one.

    Raises
    ------
    FormatError, InputError, MissingExtraError
        As for `read`, where the fault is met.
    """
    source = opened(path)
    chosen = format_of_source(source, format)
    task = "stream" if chosen.stream else "read"
    settings = chosen.settings(task, options)
    chosen.require()
    assert chosen.read is not None
    with _library(chosen, source):
        if chosen.stream is None:
            pieces: Iterable[Points] = (chosen.read(source, **settings),)
        else:
            pieces = chosen.stream(source, rows, **settings)
        pieces = iter(pieces)
    while True:
        with _library(chosen, source):
            piece = next(pieces, None)
        if piece is None:
            return
        yield _with_crs(piece, crs)


def layers(path: Any, *, format: str | None = None) -> list[Layer]:
    """Return the layers of a file; none if its format knows no layers."""
    source = opened(path)
    chosen = format_of_source(source, format)
    if chosen.layers is None:
        return []
    chosen.require()
    with _library(chosen, source):
        return chosen.layers(source)


def _library(chosen: Format, source: Source) -> AbstractContextManager[None]:
    """Make whatever the library of a format raises a `FormatError`."""
    return source.library(chosen.needs[0].replace("_", "-")) if chosen.needs else nullcontext()


def opened(path: Any) -> Source:
    """Return the source of a path, unpacked."""
    source = unpacked(path if isinstance(path, Source) else Source(path))
    head = source.head
    if not head.startswith(b"PK\x03\x04") or known_archive(head):
        return source
    if any(each.sniff and each.sniff(head) for each in able("read")):
        return source
    return member(source, {*suffixes_for("read"), *suffixes_for("read_curves")})


def _with_crs(points: Points, crs: str | None) -> Points:
    name = points.crs if crs is None else as_crs(crs)
    return points if name is None else points.replace(crs=normalize_crs(name))
