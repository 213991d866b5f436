"""SVG: a picture of the curves, one path each, with y upwards."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves
from crustline.formats.attributes import without_curves
from crustline.points import Points

_WIDTH = 800
_MARGIN = 0.03
_STYLE = (
    'fill="none" fill-rule="evenodd" stroke="#1f5fa8" stroke-width="1.5" '
    'stroke-linejoin="round" stroke-linecap="round"'
)


@dataclass(frozen=True)
class _Frame:
    """Where the drawing's coordinates come from: (points - origin) * scale, both exact.

    Viewers compute in single precision, so a far origin is subtracted (exact by Sterbenz's lemma,
    for all values are within a factor of two of it) and an extreme size is scaled by a power of
    two.
    """

    origin: FloatArray
    scale: float
    low: FloatArray
    high: FloatArray

    def place(self, coordinates: FloatArray) -> FloatArray:
        return (coordinates - self.origin) * self.scale


def write_svg(curves: Curves, *, polygons: bool = False) -> bytes:
    """Return a picture of the curves; the same curves give the same text."""
    frame = frame_of(curves.points.xy)
    return document(frame, curves, _paths(curves, frame, polygons))


def document(frame: _Frame, curves: Curves, elements: Iterable[str]) -> bytes:
    """Return the whole drawing: the elements, placed in the frame, under a title that counts."""
    margin = _MARGIN * float((frame.high - frame.low).max()) or 1.0
    x, y = frame.low - margin
    width, height = frame.high - frame.low + 2 * margin
    box = " ".join(f"{each:.9g}" for each in (x, -y - height, width, height))
    pixels = max(1, min(4 * _WIDTH, round(_WIDTH * height / width)))
    note = f' data-origin="{frame.origin[0]!s} {frame.origin[1]!s}" data-scale="{frame.scale!r}"'
    plain = not frame.origin.any() and frame.scale == 1
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{_WIDTH}"'
        f' height="{pixels}"{"" if plain else note}>',
        f"<title>{_title(curves)}</title>",
        f'<g transform="scale(1 -1)" {_STYLE}>',
        *elements,
        "</g>",
        "</svg>",
        "",
    ]
    return "\n".join(lines).encode()


def write_points_svg(points: Points) -> bytes:
    """Return a picture of points, as dots."""
    return write_svg(without_curves(points))


def _title(curves: Curves) -> str:
    rings = int(np.count_nonzero(curves.closed))
    counts = [(rings, "ring"), (len(curves) - rings, "open curve")]
    counts.append((len(curves.isolated), "isolated point"))
    return ", ".join(f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count)


def frame_of(coordinates: FloatArray) -> _Frame:
    if len(coordinates) == 0:
        return _Frame(np.zeros(2), 1.0, np.zeros(2), np.ones(2))
    low, high = coordinates.min(axis=0), coordinates.max(axis=0)
    with np.errstate(over="ignore"):
        far = np.minimum(np.abs(low), np.abs(high)) > 1000 * (high - low)
    origin = np.where(far, low, 0.0)
    low, high = low - origin, high - origin
    size = float(np.maximum(np.abs(low), np.abs(high)).max())
    scale = 1.0 if size == 0 or 1e-6 < size < 1e9 else float(np.ldexp(1.0, _power(size)))
    return _Frame(origin, scale, low * scale, high * scale)


def _power(size: float) -> int:
    return int(np.clip(10 - np.frexp(size)[1], -1022, 1023))


def _paths(curves: Curves, frame: _Frame, polygons: bool) -> Iterator[str]:
    def path(rows: IntArray, closed: bool) -> str:
        numbers = frame.place(curves.points.xy[rows]).T.tolist()
        positions = map(" ".join, zip(*(map(short, each) for each in numbers), strict=True))
        return f"M{'L'.join(positions)}{'Z' if closed else ''}"

    for polygon in curves.polygons() if polygons else []:
        body = "".join(path(ring, True) for ring in (polygon.shell, *polygon.holes))
        yield element(body, ' fill="#1f5fa8" fill-opacity="0.15"')
    for curve in curves:
        if not (polygons and curve.closed):
            yield element(path(curve.indices, curve.closed))
    yield from dots(frame.place(curves.points.xy[curves.isolated]))


def dots(places: FloatArray) -> Iterator[str]:
    """Yield the element that draws the isolated points, if there are any."""
    if len(places):
        # A line of no length with round ends is a dot, whatever the zoom.
        lines = "".join(f"M{short(x)} {short(y)}h0" for x, y in places.tolist())
        yield element(lines, ' stroke="#c2410c" stroke-width="5"')


def element(body: str, style: str = "") -> str:
    return f'<path d="{body}" vector-effect="non-scaling-stroke"{style}/>'


def short(number: float) -> str:
    """Return the shortest text of a number that gives it again, integers without a point."""
    return repr(number).removesuffix(".0")
