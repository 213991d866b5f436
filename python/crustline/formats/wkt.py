"""Well-known text: the vertices of every geometry are read, curves are written one a line.

The grammar is that of OGC Simple Features 1.2.1, section 7, without measures; SRID=n; is PostGIS's.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves
from crustline.errors import FormatError
from crustline.formats.attributes import attributes_of, coordinates_with_height, without_curves
from crustline.formats.crs import epsg_code
from crustline.formats.format import Format
from crustline.formats.options import ENCODING, POLYGONS
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.formats.vertices import Vertices
from crustline.points import Points

# How many parentheses lie around the positions of a geometry, besides the innermost.
_DEPTHS = {
    "POINT": 0,
    "LINESTRING": 0,
    "LINEARRING": 0,
    "MULTIPOINT": 0,
    "POLYGON": 1,
    "TRIANGLE": 1,
    "MULTILINESTRING": 1,
    "MULTIPOLYGON": 2,
}
_WORDS = {"polygon": "POLYGON", "line": "LINESTRING", "points": "MULTIPOINT"}
_TOKEN = re.compile(
    r"\s*(?:(?P<srid>SRID\s*=\s*\d{1,9}\s*;)|(?P<word>[A-Z]+)|(?P<leaf>\(\s*(?:[-+.\d]|nan|inf)[^()]*\))"
    r"|(?P<mark>[(),;])|(?P<end>\Z))",
    re.IGNORECASE,
)
_START = re.compile(
    rb"\s*(SRID\s*=|(POINT|LINESTRING|LINEARRING|MULTI[A-Z]+|POLYGON|TRIANGLE|GEOMETRYCOLLECTION)"
    rb"\s*(ZM?|M)?\s*(\(|EMPTY|\Z))",
    re.IGNORECASE,
)


def read(source: Source, *, encoding: str | None = None) -> Points:
    """Return the vertices of all geometries, without those that close a ring."""
    geometries = parse(source.text(encoding), source)
    return geometries.vertices.points(geometries.coordinates, crs=geometries.crs)


def read_curves(source: Source, *, encoding: str | None = None) -> Curves:
    """Return the lines and rings of all geometries."""
    geometries = parse(source.text(encoding), source)
    points = geometries.vertices.points(geometries.coordinates, crs=geometries.crs)
    return geometries.vertices.curves(points)


@dataclass(frozen=True)
class Geometries:
    """The vertices of geometries, how many each of these has, and their CRS."""

    vertices: Vertices
    coordinates: FloatArray
    counts: list[int]
    crs: str | None


def parse(text: str, source: Source, lines: Sequence[int] | None = None) -> Geometries:
    """Return the geometries of text; `lines` are the numbers of its lines, if not 1, 2, 3, …"""
    parser = _Parser(text, source, lines)
    parser.parse()
    vertices = Vertices(source)
    for leaf in parser.leaves:
        vertices.add([position.split() for position in leaf.text.split(",")], leaf.line)
    crs = None if parser.srid is None else f"EPSG:{parser.srid}"
    return Geometries(vertices, _coordinates(vertices, parser), _counts(vertices, parser), crs)


def _counts(vertices: Vertices, parser: _Parser) -> list[int]:
    ends = np.cumsum([0, *vertices.sizes])[parser.ends]
    counts: list[int] = np.diff(ends, prepend=0).tolist()
    return counts


@dataclass(frozen=True)
class _Leaf:
    """The innermost text of a geometry: positions between two parentheses, of a line or points."""

    text: str
    start: int
    line: bool


class _Parser:
    """Recursive descent over tokens, in which the positions of a line are one token."""

    def __init__(self, text: str, source: Source, lines: Sequence[int] | None) -> None:
        self.text = text
        self.source = source
        self.lines = lines
        self.leaves: list[_Leaf] = []
        self.ends: list[int] = []  # how many leaves there are after each geometry
        self.srid: int | None = None
        self.tokens = self._tokens()
        self.kind, self.value, self.start = next(self.tokens)

    def parse(self) -> None:
        try:
            while self.kind != "end":
                self._reference()
                self._geometry()
                self.ends.append(len(self.leaves))
                if self.value == ";":
                    self._advance()
        except RecursionError:
            raise self.error("the geometries are nested too deep: flatten them") from None

    def error(self, fault: str, start: int | None = None) -> FormatError:
        line = self.text.count("\n", 0, self.start if start is None else start)
        number = line + 1 if self.lines is None else self.lines[line]
        return self.source.error(fault, f"line {number}")

    def _tokens(self) -> Iterator[tuple[str, str, int]]:
        place = 0
        while True:
            match = _TOKEN.match(self.text, place)
            if match is None:
                rest = self.text[place:].lstrip()[:40].split("\n")[0]
                self.start = self.text.index(rest, place)
                raise self.error(f"{rest!r} is no well-known text: correct it")
            kind = str(match.lastgroup)
            yield kind, match[kind], match.start(kind)
            place = match.end()

    def _advance(self) -> str:
        value = self.value
        self.kind, self.value, self.start = next(self.tokens)
        return value

    def _expect(self, mark: str) -> None:
        if self.value != mark:
            found = self.value[:40] or "the end"
            raise self.error(f"{mark!r} is missing before {found!r}: complete the geometry")
        self._advance()

    def _reference(self) -> None:
        if self.kind != "srid":
            return
        srid = int(re.sub(r"\D", "", self.value))
        if self.srid not in (None, srid):
            raise self.error(f"SRID {srid} follows SRID {self.srid}: use one CRS in a file")
        self.srid = srid
        self._advance()

    def _geometry(self) -> None:
        match = re.fullmatch(r"([A-Z]+?)(ZM|Z|M)?", self.value.upper())
        base, heights = match.groups() if match else ("", None)
        if base not in _DEPTHS and base != "GEOMETRYCOLLECTION":
            known = ", ".join([*_DEPTHS, "GEOMETRYCOLLECTION"])
            raise self.error(f"{self.value[:40]!r} is no geometry: use one of {known}")
        self._advance()
        if self.kind == "word" and self.value.upper() in ("Z", "M", "ZM"):
            heights = self._advance().upper()
        if heights in ("M", "ZM"):
            raise self.error("measures (M) are not read: write the geometries without them")
        if self.value.upper() == "EMPTY":
            self._advance()
        elif base == "GEOMETRYCOLLECTION":
            self._list(self._geometry)
        else:
            self._body(base, _DEPTHS[base])

    def _list(self, item: Callable[[], None]) -> None:
        self._expect("(")
        item()
        while self.value == ",":
            self._advance()
            item()
        self._expect(")")

    def _body(self, base: str, depth: int) -> None:
        if self.value.upper() == "EMPTY":
            self._advance()
        elif depth > 0:
            self._list(lambda: self._body(base, depth - 1))
        elif base == "MULTIPOINT" and self.kind != "leaf":
            self._list(lambda: self._body("POINT", 0))
        else:
            self._leaf(base)

    def _leaf(self, base: str) -> None:
        if self.kind != "leaf":
            found = self.value[:40] or "the end"
            raise self.error(f"coordinates are missing before {found!r}: write (x y, x y, ...)")
        self.leaves.append(_Leaf(self.value[1:-1], self.start, "POINT" not in base))
        self._advance()


def _coordinates(vertices: Vertices, parser: _Parser) -> FloatArray:
    try:
        coordinates = vertices.coordinates()
        if np.isfinite(coordinates).all() and "_" not in parser.text:
            return coordinates
    except ValueError:
        pass
    for leaf in parser.leaves:
        for position in leaf.text.split(","):
            fault = _fault_of_position(position.split())
            if fault:
                raise parser.error(f"{position.strip()[:60]!r} {fault}", leaf.start)
    raise parser.error("the positions do not fit together: correct them")


def _fault_of_position(numbers: list[str]) -> str | None:
    if len(numbers) < 2:
        return "is not two or three numbers: correct it"
    try:
        finite = all(np.isfinite(float(number)) for number in numbers)
    except ValueError:
        finite = False
    sound = finite and not any("_" in number for number in numbers)
    return None if sound else "is not made of finite numbers: correct it"


# Writing


def write_curves(curves: Curves, target: Target, *, polygons: bool = False) -> None:
    """Write the curves as text, a geometry a line, the isolated points as the last one."""
    lines = _lines(curves, polygons)
    first = next(lines, "GEOMETRYCOLLECTION EMPTY")
    target.write(f"{line}\n" for line in chain([first], lines))


def write_points(points: Points, target: Target) -> None:
    """Write points as one MULTIPOINT."""
    write_curves(without_curves(points), target)


def _lines(curves: Curves, polygons: bool) -> Iterator[str]:
    attributes = attributes_of(curves)
    code = epsg_code(attributes.crs)
    reference = "" if code is None else f"SRID={code};"
    dimension = "" if attributes.z is None else " Z"

    def text(rows: IntArray) -> str:
        numbers = coordinates_with_height(curves, rows).T.tolist()
        positions = map(" ".join, zip(*(map(repr, each) for each in numbers), strict=True))
        return f"({', '.join(positions)})"

    for feature in curves.features(polygons=polygons):
        parts = list(map(text, feature.rows[:, None] if feature.kind == "points" else feature.runs))
        body = parts[0] if feature.kind == "line" else f"({', '.join(parts)})"
        yield f"{reference}{_WORDS[feature.kind]}{dimension} {body}"


def _is_wkt(head: bytes) -> bool:
    return _START.match(head.lstrip(b"\xef\xbb\xbf")) is not None


WKT = Format(
    name="wkt",
    title="WKT",
    suffixes=(".wkt",),
    sniff=_is_wkt,
    read=read,
    read_curves=read_curves,
    write_points=write_points,
    write_curves=write_curves,
    options=(POLYGONS, ENCODING),
)
