"""Files for the page: points of uploads, kept whole, and files made of what a page sends back.

A page gets coordinates and sends coordinates; what lies beside them (heights, columns, the CRS)
stays here, under a name that only the page which opened the file knows.
"""

from __future__ import annotations

import json
import secrets
import tempfile
import zipfile
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.errors import FormatError, InputError, MissingExtraError, shown
from crustline.formats import read, write
from crustline.formats.catalog import FORMATS, able
from crustline.formats.source import Source
from crustline.methods import METHODS, parameters_of
from crustline.points import Points
from crustline.reconstruction import reconstruct

#: How many opened files are kept; the one unused for longest goes first.
MOST_DOCUMENTS = 64
#: The longest first line of a file that a page asks for.
MOST_HEADER = 1 << 16

Missing = {"f": np.nan, "c": np.nan, "U": "", "S": b"", "O": ""}


@dataclass(frozen=True)
class Order:
    """What a page wants to save: its points, each with the row of the file that it was read from.

    Attributes
    ----------
    what : {"points", "curves"}
        What to write.
    format : str
        The name of a format.
    method, parameters : str, list of float
        The method, and its numbers in order; a kind is the number of the choice.
    document : str or None
        The opened file that the points came from.
    xy : ndarray of float64, shape (n, 2)
        Coordinates.
    rows : ndarray of int64, shape (n,)
        Rows of the opened file; -1 for new points.
    """

    what: str
    format: str
    method: str
    parameters: list[float]
    document: str | None
    xy: FloatArray
    rows: IntArray


class Desk:
    """The opened files of all pages."""

    def __init__(self) -> None:
        self._documents: OrderedDict[str, Points] = OrderedDict()

    def open(self, content: Any, name: str) -> tuple[str, Points]:
        """Read a file; return the name under which what it holds is kept, and its points."""
        points = read(Source(content, name))
        if not len(points):
            raise FormatError(f"{name} holds no points")
        return self.keep(points)

    def keep(self, points: Points) -> tuple[str, Points]:
        """Keep points under a new name; return it, and them."""
        document = secrets.token_urlsafe(16)
        self._documents[document] = points
        while len(self._documents) > MOST_DOCUMENTS:
            self._documents.popitem(last=False)
        return document, points

    def save(self, order: Order) -> tuple[str, bytes, str]:
        """Make a file; return its name, its content, and what is not in it as one would expect."""
        points, warning = self._points(order)
        thing: Any = points
        if order.what == "curves":
            parameters = named(order.method, order.parameters)
            thing = reconstruct(points, METHODS[order.method], **parameters)
        name, content = _written(thing, order)
        return name, content, warning

    def _points(self, order: Order) -> tuple[Points, str]:
        if order.document is None:
            return Points(order.xy), ""
        known = self._documents.get(order.document)
        if known is None:
            warning = (
                "The server no longer has the file that these points came from: heights, columns "
                "and CRS are left out. Open it again and repeat the edits to keep them."
            )
            return Points(order.xy), warning
        self._documents.move_to_end(order.document)
        if len(order.rows) and order.rows.max() >= len(known):
            raise InputError("the rows are not those of the opened file: open it again")
        return edited(known, order.xy, order.rows)


def edited(points: Points, xy: FloatArray, rows: IntArray) -> tuple[Points, str]:
    """Return moved, new and remaining points with what the file says beside them."""
    columns = {name: _extended(column, rows) for name, column in points.columns.items()}
    z, warning = points.z, ""
    added = int((rows < 0).sum())
    if z is not None and added:
        name = "heights"  # formats keep z for heights of all points
        columns[name] = _extended(z, rows)
        warning = (
            f"{added} new points have no height: the heights are saved as the column {name}, "
            "which is empty there."
        )
    heights = None if z is None or added else z[rows]
    edited = Points(xy, z=heights, columns=columns, crs=points.crs, names=points.names)
    return edited, warning


def _extended(column: npt.NDArray[Any], rows: IntArray) -> npt.NDArray[Any]:
    """Return a column at rows, with the missing value of its type at -1."""
    added = rows < 0
    if not added.any():
        return column[rows]
    if column.dtype.kind in "biu":
        column = column.astype(np.float64)
    values = column[np.where(added, 0, rows)] if len(column) else np.zeros(len(rows), column.dtype)
    values[added] = Missing.get(column.dtype.kind, np.datetime64("NaT"))
    return values


def named(method: str, numbers: list[float]) -> dict[str, Any]:
    """Return the parameters of a method by name; a kind is the number of the choice."""
    if method == "beta-skeleton" and len(numbers) == 2:
        return {"beta": numbers[0], "kind": ("circle", "lune")[int(numbers[1] == 1)]}
    return dict(zip(parameters_of(METHODS[method]), numbers, strict=False))


def _written(thing: Any, order: Order) -> tuple[str, bytes]:
    """Write into a folder of its own; several files become one archive."""
    suffix = FORMATS[order.format].suffixes[0]
    with tempfile.TemporaryDirectory(prefix="crustline-") as folder:
        path = Path(folder) / f"{order.what}{suffix}"
        write(thing, path, format=order.format)
        files = sorted(Path(folder).iterdir())
        if files == [path]:
            return path.name, path.read_bytes()
        archive = BytesIO()
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
            for each in files:
                packed.write(each, each.name)
        return f"{path.name}.zip", archive.getvalue()


def as_order(content: bytes) -> Order:
    """Return what a page asks for: a line of JSON, then coordinates, then rows."""
    line, separator, numbers = content.partition(b"\n")
    try:
        header = json.loads(line) if separator and len(line) <= MOST_HEADER else None
    except ValueError:
        header = None
    if not isinstance(header, Mapping):
        raise InputError("the request is not one of the editor's: reload the page")
    count = header.get("count")
    if not isinstance(count, int) or len(numbers) != 20 * count:
        raise InputError("the request holds other points than it says: reload the page")
    xy = np.frombuffer(numbers, "<f8", 2 * count).reshape(-1, 2)
    rows = np.frombuffer(numbers, "<i4", count, offset=16 * count).astype(np.int64)
    return _checked(header, xy, rows)


def _checked(header: Mapping[str, Any], xy: FloatArray, rows: IntArray) -> Order:
    what, format, method = (header.get(key) for key in ("what", "format", "method"))
    if what not in ("points", "curves"):
        raise InputError(f"what is {shown(what)}: points or curves can be saved")
    if format not in formats_for(what):
        raise InputError(f"{what} cannot be saved as {shown(format)}: choose another format")
    if method not in METHODS or method == "a-shape":
        raise InputError(f"the library saves no curves of {shown(method)}: choose another method")
    parameters = header.get("parameters")
    if not isinstance(parameters, list) or not all(_is_number(each) for each in parameters):
        raise InputError(f"the parameters are {shown(parameters)}, not numbers: reload the page")
    document = header.get("document")
    if not (document is None or isinstance(document, str)):
        raise InputError("the opened file is not named by text: reload the page")
    return Order(what, str(format), method, parameters, document, xy, rows)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def formats_for(what: str) -> list[str]:
    """Return the names of the formats that can be written with what is installed."""
    return [each.name for each in able(f"write_{what}") if _is_here(each.name)]


def _is_here(name: str) -> bool:
    try:
        FORMATS[name].require()
    except MissingExtraError:
        return False
    return True
