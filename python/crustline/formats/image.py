"""Pictures: points of edges, of the boundary of an area, or of the middles of strokes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.errors import InputError
from crustline.formats.format import Format, Option
from crustline.formats.options import flag, length, whole
from crustline.formats.raster import Raster, is_picture, open_raster
from crustline.formats.source import Source
from crustline.images import Axes, boundary_points, edge_points, stroke_points
from crustline.images.figure import as_color
from crustline.points import Points, own_points
from crustline.scalars import as_share


def read(
    source: Source,
    *,
    band: int | None = None,
    axes: Axes | None = None,
    pixels: bool = False,
    **search: Any,
) -> Points:
    """Return points of the edges, or of what `mask`, `color` and `lines` say.

    They are in the world if the picture says where it is, or what the axes of a plot show; then
    the pixels are columns beside them.
    """
    wanted = _Search(**search)
    raster = open_raster(source, band, pixels or axes is not None)
    with source.named():
        points = wanted.points(raster.image)
        if not len(points):
            raise source.error(f"no {wanted.what} is found in it: {_ADVICE[wanted.what]}")
        return _placed(points, raster, axes)


#: The columns of the pixels, beside what axes show: distances mean something between them.
PIXELS = ("pixel_x", "pixel_y")
_ADVICE = {
    "edge": "look for weaker ones (--contrast 0.05), or for a color (--color '#d00')",
    "boundary": "give a mask with bright and dark, or another color (--color '#d00')",
    "stroke": "give dark lines on bright paper, or their color (--color '#d00')",
}


@dataclass(frozen=True)
class _Search:
    """What is looked for in a picture."""

    mask: bool = False
    color: tuple[float, ...] | None = None
    lines: bool = False
    blur: float | None = None
    contrast: float | None = None

    def __post_init__(self) -> None:
        if self.mask and (self.color is not None or self.lines):
            raise InputError("--mask goes with neither --color nor --lines: leave one of them away")
        if self.contrast is not None and self.what != "edge":
            raise InputError("--contrast is for edges, not for --mask, --color or --lines")
        if self.blur is not None and self.lines:
            raise InputError("--blur is not for --lines: leave it away")

    @property
    def what(self) -> str:
        if self.lines:
            return "stroke"
        return "boundary" if self.mask or self.color is not None else "edge"

    def points(self, image: npt.NDArray[Any]) -> FloatArray:
        if self.what == "stroke":
            return stroke_points(image, color=self.color)
        if self.what == "boundary":
            return boundary_points(image, color=self.color, blur=self.blur)
        return edge_points(image, blur=self.blur or 1.0, contrast=self.contrast or 0.2)


def _placed(points: FloatArray, raster: Raster, axes: Axes | None) -> Points:
    if axes is not None:
        pixels = dict(zip(PIXELS, points.T.copy(), strict=True))
        return own_points(axes.place(points), columns=pixels)
    if raster.placement is not None:
        return own_points(raster.placement.place(points), crs=raster.placement.crs)
    return own_points(points)


def _as_axes(value: Any) -> Axes:
    if isinstance(value, Axes):
        return value
    if not isinstance(value, str):
        raise ValueError("give text, such as '60,430=0,0 560,30=10,100', or crustline.images.Axes")
    return Axes.parse(value)


def _as_color(value: Any) -> tuple[float, ...]:
    return tuple((255 * as_color(value)).tolist())


def _as_contrast(value: Any) -> float:
    try:
        return as_share("contrast", float(value) if isinstance(value, str) else value)
    except ValueError:
        raise ValueError("give a number in (0, 1]") from None


IMAGE = Format(
    name="image",
    title="a picture",
    suffixes=(
        ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".gif", ".bmp", ".webp", ".pgm", ".ppm", ".pbm",
    ),
    sniff=is_picture,
    read=read,
    options=(
        flag("mask", "Take the boundary of a mask: of what is opaque or bright, not edges."),
        Option("color", "Take the boundary of what has a color, such as '#d00'.", _as_color, "C"),
        flag("lines", "Take the middles of strokes: of ink on paper, or of lines of --color."),
        Option(
            "axes",
            "What the axes of a plot show at pixels: 'COLUMN,ROW=X,Y COLUMN,ROW=X,Y [log=y]'.",
            _as_axes,
            "A",
        ),
        flag("pixels", "Give pixels (y upwards, from 0 at the top), not places in the world."),
        whole("band", "The band to take, of a file with many.", "K", least=1),
        length("blur", "How far edges are blurred, in pixels: more if noisy [1].", "B"),
        Option("contrast", "The least step that is an edge, of 1 [0.2].", _as_contrast, "C"),
    ),
    extra="image",
    needs=("PIL", "scipy", "skimage", "rasterio"),
)  # fmt: skip
