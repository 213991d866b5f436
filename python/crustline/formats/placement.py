"""Where the pixels of a picture are in the world: a geotransform, or a world file beside it."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from crustline.arrays import FloatArray
from crustline.formats.crs import normalize_crs
from crustline.formats.source import Source

__all__ = ["Placement", "world_file_of"]


@dataclass(frozen=True)
class Placement:
    """An affine map from pixels to the world.

    Attributes
    ----------
    matrix : ndarray of float64, shape (2, 3)
        World coordinates are matrix @ (column, row, 1), the upper left corner being (0, 0).
    crs : str or None
        The coordinate reference system of the world.
    """

    matrix: FloatArray
    crs: str | None

    def place(self, points: FloatArray) -> FloatArray:
        """Return where points in pixel coordinates (x to the right, y upwards) are."""
        placed: FloatArray = (points * (1.0, -1.0)) @ self.matrix[:, :2].T + self.matrix[:, 2]
        return placed

    def pixels_of(self, places: FloatArray) -> FloatArray:
        """Return the pixel coordinates of places in the world."""
        inverse = np.linalg.inv(self.matrix[:, :2])
        pixels: FloatArray = ((places - self.matrix[:, 2]) @ inverse.T) * (1.0, -1.0)
        return pixels


def world_file_of(source: Source) -> Placement | None:
    """Return what a world file beside a picture says, and the CRS of a .prj beside that."""
    path = _beside(source, _world_suffixes(source.suffix))
    if path is None:
        return None
    with source.library("the world file"):
        words = path.read_bytes()[:4096].decode("ascii", "replace").split()
    try:
        a, d, b, e, c, f = map(float, words[:6])
    except ValueError:
        fault = f"{path.name} beside it does not hold the six numbers of a world file"
        raise source.error(f"{fault}: repair it, or add --pixels") from None
    matrix = np.array([[a, b, c - (a + b) / 2], [d, e, f - (d + e) / 2]])  # from its middle
    if not np.isfinite(matrix).all() or a * e == b * d:
        raise source.error(f"{path.name} maps all pixels to a line: repair it, or add --pixels")
    return Placement(matrix, _crs_beside(source))


def _crs_beside(source: Source) -> str | None:
    path = _beside(source, [".prj"])
    if path is None:
        return None
    return normalize_crs(path.read_bytes()[:65536].decode("utf-8", "replace")) or None


def _world_suffixes(suffix: str) -> list[str]:
    """Return how world files of a suffix end: .pgw and .pngw of .png, and .wld."""
    letters = suffix[1:]
    return [f".{letters[:1]}{letters[-1:]}w", f".{letters}w", ".wld"]


def _beside(source: Source, suffixes: list[str]) -> Path | None:
    """Return a file of the source's name with one of some suffixes, in any case."""
    if not isinstance(source.given, str | os.PathLike) or os.fspath(source.given) == "-":
        return None
    path = Path(source.given)
    names = [f"{path.stem}{each}" for suffix in suffixes for each in (suffix, suffix.upper())]
    return next((path.with_name(name) for name in names if path.with_name(name).is_file()), None)
