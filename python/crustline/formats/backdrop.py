"""A picture below a drawing, pixel on pixel."""

from __future__ import annotations

import base64
import io
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.errors import require
from crustline.formats.placement import Placement
from crustline.formats.raster import Raster, open_raster
from crustline.formats.source import Source

__all__ = ["Backdrop", "backdrop"]

#: How well a picture without alpha is kept, of 100.
_QUALITY = 85


@dataclass(frozen=True)
class Backdrop:
    """A picture as it is embedded, its size in pixels, and where it is in the world."""

    data: str
    width: int
    height: int
    placement: Placement | None

    def pixels_of(self, places: FloatArray) -> FloatArray:
        """Return the pixel coordinates, y upwards, of what is where the picture's points are."""
        return places if self.placement is None else self.placement.pixels_of(places)

    def svg(self) -> str:
        """Return the element of SVG."""
        return f'<image width="{self.width}" height="{self.height}" href="{self.data}"/>'


def backdrop(path: str | os.PathLike[str]) -> Backdrop:
    """Return a picture in a file as a backdrop."""
    require("image", "PIL", "rasterio")
    source = Source(path)
    raster = _read(source)
    height, width = raster.image.shape[:2]
    with source.library("Pillow"):
        return Backdrop(_embedded(raster.image), width, height, raster.placement)


def _read(source: Source) -> Raster:
    raster = open_raster(source, None, False)
    image = raster.image
    if image.dtype != np.uint8:
        low, high = (float(end) for end in (image.min(), image.max()))
        image = ((image - low) * (255 / ((high - low) or 1.0))).astype(np.uint8)
    return Raster(image, raster.placement)


def _embedded(image: npt.NDArray[Any]) -> str:
    """Return a picture as a URL that holds it: PNG if it has alpha, else JPEG."""
    from PIL import Image

    kind = "PNG" if image.shape[2] in (2, 4) else "JPEG"
    stream = io.BytesIO()
    Image.fromarray(image[..., 0] if image.shape[2] == 1 else image).save(
        stream, kind, quality=_QUALITY
    )
    packed = base64.b64encode(stream.getvalue()).decode("ascii")
    return f"data:image/{kind.lower()};base64,{packed}"
