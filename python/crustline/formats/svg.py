"""SVG: a picture of curves, points or splines, one path each, with y upwards."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from crustline.arrays import FloatArray
from crustline.curves import Curves, Feature
from crustline.formats.attributes import without_curves
from crustline.formats.backdrop import Backdrop, backdrop
from crustline.formats.format import Format
from crustline.formats.options import OVER, POLYGONS, TOLERANCE, UNIT
from crustline.formats.target import Target
from crustline.path import Path
from crustline.points import Points
from crustline.smooth import Splines

_WIDTH = 800
_MARGIN = 0.03
_STYLE = (
    'fill="none" fill-rule="evenodd" stroke="{}" stroke-linejoin="round" stroke-linecap="round"'
)
#: The color of strokes on paper, and over a picture.
_BLUE, _ORANGE = "#1f5fa8", "#f97316"
_STYLES = {
    "polygon": ' fill="#1f5fa8" fill-opacity="0.15"',
    "line": "",
    "points": ' stroke="#c2410c"',
}
# Widths in pixels. They are written in the drawing's own unit: strokes that do not scale
# (vector-effect) are unknown to some viewers, which would draw blots or nothing.
_LINE, _DOT = 1.5, 5.0
# For each unit one that SVG knows, and how many of it are in it.
_UNITS = {
    "mm": ("mm", 1.0), "cm": ("cm", 1.0), "m": ("cm", 100.0), "km": ("cm", 1e5),
    "in": ("in", 1.0), "ft": ("in", 12.0),
}  # fmt: skip


def write_curves(
    curves: Curves,
    target: Target,
    *,
    polygons: bool = False,
    unit: str = "",
    over: str | None = None,
) -> None:
    """Write a picture of curves; the same curves give the same text."""
    target.write(picture_of_curves(curves, polygons=polygons, unit=unit, over=over))


def write_points(
    points: Points, target: Target, *, unit: str = "", over: str | None = None
) -> None:
    """Write a picture of points, as dots."""
    target.write(picture_of_curves(without_curves(points), unit=unit, over=over))


def write_splines(
    splines: Splines,
    target: Target,
    *,
    tolerance: float | None = None,
    unit: str = "",
    over: str | None = None,
) -> None:
    """Write a picture of splines as cubic Bézier paths, closed by Z if they are rings."""
    target.write(picture_of_splines(splines, tolerance, unit, over))


def picture_of_curves(
    curves: Curves, *, polygons: bool = False, unit: str = "", over: str | None = None
) -> str:
    """Return a picture of curves: a path for each, dots for the isolated points.

    With a unit of the coordinates its size is that of the curves, for what cuts or prints it. Over
    a picture, which is embedded, it has that picture's size and pixels.
    """
    features = list(curves.features(polygons=polygons))
    paths = [Path.of_feature(feature, curves.points.xy) for feature in features]
    drawn = zip(features, paths, strict=True)
    return _document(_frame(curves.points.xy, over), curves, drawn, unit)


def picture_of_splines(
    splines: Splines, tolerance: float | None = None, unit: str = "", over: str | None = None
) -> str:
    """Return a picture of splines: that of their curves, with cubics in place of lines."""
    curves = splines.curves
    features = list(curves.features())
    lines, lonely = features[: len(curves)], features[len(curves) :]
    controls = zip(lines, splines.beziers(tolerance), strict=True)
    drawn = [(line, Path.beziers(control, line.closed)) for line, control in controls]
    drawn += [(each, Path.of_feature(each, curves.points.xy)) for each in lonely]
    # Control points enclose their curve.
    frame = _frame(Path.joined(path for _, path in drawn).vertices, over)
    return _document(frame, curves, drawn, unit)


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
    under: Backdrop | None = None

    def place(self, path: Path) -> Path:
        if self.under is not None:
            return replace(path, vertices=self.under.pixels_of(path.vertices))
        return replace(path, vertices=(path.vertices - self.origin) * self.scale)


def _frame(coordinates: FloatArray, over: str | None) -> _Frame:
    if over is None:
        return _frame_of(coordinates)
    under = backdrop(over)
    corner = np.array([under.width, -under.height], np.float64)
    return _Frame(np.zeros(2), 1.0, np.minimum(corner, 0), np.maximum(corner, 0), under)


def _frame_of(coordinates: FloatArray) -> _Frame:
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


def _document(
    frame: _Frame, curves: Curves, drawn: Iterable[tuple[Feature, Path]], unit: str
) -> str:
    """Return the whole drawing: features, placed in the frame, under a title that counts."""
    margin = 0.0 if frame.under else _MARGIN * float((frame.high - frame.low).max()) or 1.0
    x, y = frame.low - margin
    width, height = frame.high - frame.low + 2 * margin
    box = " ".join(f"{each:.9g}" for each in (x, -y - height, width, height))
    pixels = max(1, min(4 * _WIDTH, round(_WIDTH * height / width)))
    pixel = max(width / _WIDTH, height / pixels)
    size = _size(width, height, unit, frame) if unit else f'width="{_WIDTH}" height="{pixels}"'
    note = f' data-origin="{frame.origin[0]!s} {frame.origin[1]!s}" data-scale="{frame.scale!r}"'
    plain = not frame.origin.any() and frame.scale == 1
    style = _STYLE.format(_ORANGE if frame.under else _BLUE)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" {size}{"" if plain else note}>',
        f"<title>{_title(curves)}</title>",
        *([frame.under.svg()] if frame.under else []),
        f'<g transform="scale(1 -1)" {style} stroke-width="{_LINE * pixel:.4g}">',
        *_elements(frame, drawn, f' stroke-width="{_DOT * pixel:.4g}"'),
        "</g>",
        "</svg>",
        "",
    ]
    return "\n".join(lines)


def _size(width: float, height: float, unit: str, frame: _Frame) -> str:
    """Return the size that a drawing has in the unit of its coordinates."""
    name, count = _UNITS[unit]
    across, up = (float(side) / frame.scale * count for side in (width, height))
    return f'width="{across:.9g}{name}" height="{up:.9g}{name}"'


def _title(curves: Curves) -> str:
    rings = int(np.count_nonzero(curves.closed))
    counts = [(rings, "ring"), (len(curves) - rings, "open curve")]
    counts.append((len(curves.isolated), "isolated point"))
    return ", ".join(f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count)


def _elements(frame: _Frame, drawn: Iterable[tuple[Feature, Path]], dots: str) -> Iterator[str]:
    for feature, path in drawn:
        style = _STYLES[feature.kind] + dots * (feature.kind == "points")
        yield f'<path d="{frame.place(path).svg()}"{style}/>'


SVG = Format(
    name="svg",
    title="SVG",
    suffixes=(".svg",),
    write_points=write_points,
    write_curves=write_curves,
    write_splines=write_splines,
    options=(POLYGONS, TOLERANCE, UNIT, OVER),
)
