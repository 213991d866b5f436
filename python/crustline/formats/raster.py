"""Pictures in files: by Pillow; GeoTIFF, and what has a GDAL sidecar, by rasterio."""

from __future__ import annotations

import io
import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.formats.crs import normalize_crs
from crustline.formats.placement import Placement, world_file_of
from crustline.formats.source import Source
from crustline.images.picture import MOST_PIXELS, TOO_LARGE

__all__ = ["Raster", "is_picture", "open_raster"]

_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
#: The first bytes of what Pillow is asked to open, and its name for it.
_PILLOW = {
    b"\x89PNG\r\n": "PNG", b"\xff\xd8\xff": "JPEG", b"GIF8": "GIF", b"BM": "BMP",
    b"P1": "PPM", b"P2": "PPM", b"P3": "PPM", b"P4": "PPM", b"P5": "PPM", b"P6": "PPM",
}  # fmt: skip
#: Pixels to a byte: only what shows nothing is packed into less.
_MOST_PACKED = 4000
#: Modes of Pillow that are bands as they stand; others are converted to colors.
_PLAIN = ("1", "L", "LA", "RGB", "RGBA", "I", "F", "I;16", "I;16B", "I;16L", "I;16N")


@dataclass(frozen=True)
class Raster:
    """A picture as an array (h, w, b), and where it is, if it says so."""

    image: npt.NDArray[Any]
    placement: Placement | None


def is_picture(head: bytes) -> bool:
    """Return whether first bytes are those of a picture."""
    return head.startswith(_TIFF) or _kind_of(head) is not None


def _kind_of(head: bytes) -> str | None:
    if head.startswith(b"RIFF") and head[8:12] == b"WEBP":
        return "WEBP"
    found = next((name for magic, name in _PILLOW.items() if head.startswith(magic)), None)
    # Text may begin with two letters, too.
    plain = {"BMP": head[6:10] == b"\0\0\0\0", "PPM": head[2:3].isspace() or head[2:3] == b"#"}
    return found if plain.get(str(found), True) else None


def open_raster(source: Source, band: int | None, pixels: bool) -> Raster:
    """Return the picture of a source, or one band of it; its place unless pixels are asked for."""
    if source.head.startswith(_TIFF) or (not pixels and _has_sidecar(source)):
        return _by_rasterio(source, band, pixels)
    placement = None if pixels else world_file_of(source)
    return Raster(_one_of(source, _by_pillow(source, placement is None), band), placement)


def _has_sidecar(source: Source) -> bool:
    given = source.given
    is_path = isinstance(given, str | os.PathLike) and os.fspath(given) != "-"
    return is_path and Path(f"{os.fspath(given)}.aux.xml").is_file()


# Pillow


def _by_pillow(source: Source, turned: bool) -> npt.NDArray[Any]:
    """Return the bands (h, w, b) of a picture, turned as its EXIF tag says if that is wanted."""
    content = source.content()
    with source.library("Pillow"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from PIL import Image, ImageOps, UnidentifiedImageError

        kind = _kind_of(content[:16])
        if kind is None:
            raise source.error("it is no picture that is known: save it as PNG or TIFF")
        try:
            opened = Image.open(io.BytesIO(content), formats=(kind,))
        except Image.DecompressionBombError:
            raise source.error(TOO_LARGE) from None
        except UnidentifiedImageError:
            raise source.error(f"it begins as {kind} and is damaged: save it again") from None
        with opened as picture:
            _refuse_size(source, picture.width, picture.height, len(content))
            source.note(
                "picture", f"{picture.width} x {picture.height} pixels, {kind}, {picture.mode}"
            )
            plain = picture if _is_plain(picture) else picture.convert(_colors_of(picture))
            array = np.asarray(ImageOps.exif_transpose(plain) if turned else plain)
    return array.reshape(*array.shape[:2], -1)


def _refuse_size(source: Source, width: int, height: int, size: int | None) -> None:
    """Refuse a picture that is too large, and one that says so and cannot be."""
    if width * height > MOST_PIXELS:
        raise source.error(TOO_LARGE)
    if size is not None and width * height > size * _MOST_PACKED:
        raise source.error(
            f"it says that it has {width:,} x {height:,} pixels, which {size:,} bytes do not "
            "hold: it is empty or damaged, save it again"
        )


def _is_plain(picture: Any) -> bool:
    return picture.mode in _PLAIN and "transparency" not in picture.info


def _colors_of(picture: Any) -> str:
    transparent = "transparency" in picture.info or picture.mode in ("PA", "La", "RGBa")
    return "RGBA" if transparent else "RGB"


def _one_of(source: Source, bands: npt.NDArray[Any], band: int | None) -> npt.NDArray[Any]:
    if band is None:
        return bands
    _refuse_band(source, band, bands.shape[2])
    return bands[..., band - 1]


def _refuse_band(source: Source, band: int, count: int) -> None:
    if not 1 <= band <= count:
        has = "one band" if count == 1 else f"{count} bands"
        raise source.error(f"it has {has}, and no band {band}: choose from 1 to {count}")


# rasterio


def _by_rasterio(source: Source, band: int | None, pixels: bool) -> Raster:
    with _opened(source) as data:
        _refuse_size(source, data.width, data.height, source.size)
        source.note("picture", f"TIFF, {data.width} x {data.height}, bands: {data.count}")
        placement = None if pixels else _placement_of(source, data)
        return Raster(_bands_of(source, data, band), placement)


@contextmanager
def _opened(source: Source) -> Iterator[Any]:
    with source.path(".tif") as path, source.library("rasterio"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import logging

        import rasterio

        logging.getLogger("rasterio").setLevel(logging.CRITICAL)
        with rasterio.Env(GDAL_CACHEMAX=64, GDAL_NUM_THREADS=1), rasterio.open(path) as data:
            yield data


def _placement_of(source: Source, data: Any) -> Placement | None:
    transform = data.transform
    if not transform.is_identity:
        return Placement(np.array(transform[:6]).reshape(2, 3), _crs_of(data.crs))
    if data.gcps[0]:
        raise source.error(
            "its place is told by ground control points alone: warp it first (gdalwarp), or add "
            "--pixels"
        )
    if data.crs is not None:
        raise source.error(
            f"it has a CRS ({_crs_of(data.crs):.40}) and no geotransform: repair it, or add "
            "--pixels"
        )
    return None


def _crs_of(crs: Any) -> str | None:
    if crs is None:
        return None
    code = crs.to_epsg()
    return f"EPSG:{code}" if code else normalize_crs(crs.to_wkt())


def _bands_of(source: Source, data: Any, band: int | None) -> npt.NDArray[Any]:
    """Return the bands (h, w, b): the one that is asked for, or gray or colors, and alpha."""
    from rasterio.enums import ColorInterp, MaskFlags

    kinds = data.colorinterp
    visible = [k for k in range(1, data.count + 1) if kinds[k - 1] != ColorInterp.alpha]
    if band is not None:
        _refuse_band(source, band, data.count)
        visible = [band]
    if len(visible) not in (1, 3) or kinds[0] == ColorInterp.cyan:
        raise source.error(
            f"it has {len(visible)} bands, which are neither gray nor red, green and blue: choose "
            "one (--band 1)"
        )
    bands = data.read(visible)
    if kinds[visible[0] - 1] == ColorInterp.palette:
        bands = _palette(data.colormap(visible[0]))[:, bands[0]]
    if all(MaskFlags.all_valid in flags for flags in data.mask_flag_enums):
        return np.moveaxis(bands, 0, 2)
    return _masked(bands, data.dataset_mask() > 0)


def _masked(bands: npt.NDArray[Any], valid: npt.NDArray[np.bool_]) -> npt.NDArray[Any]:
    """Return the bands and alpha, which is as large as its type makes what is opaque."""
    known = bands[:, valid]
    if bands.dtype.kind == "f":
        low, high = (known.min(), known.max()) if known.size else (0.0, 1.0)
        bands = (bands - low) / (high - low or 1.0)
    bands = np.where(valid, bands, 0)
    opaque = np.iinfo(bands.dtype).max if bands.dtype.kind in "iu" else 1
    return np.stack([*bands, valid * np.array(opaque, bands.dtype)], axis=2)


def _palette(colors: dict[int, tuple[int, ...]]) -> npt.NDArray[np.uint8]:
    table = np.zeros((3, 65536), np.uint8)
    for value, color in colors.items():
        table[:, value] = color[:3]
    return table
