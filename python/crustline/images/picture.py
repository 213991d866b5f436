"""The door for pictures: arrays of any number type become float32 bands between 0 and 1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.errors import InputError, shown

__all__ = ["MOST_PIXELS", "TOO_LARGE", "Bands", "Picture", "as_picture", "centers"]

Bands = npt.NDArray[np.float32]

#: Pixels of a picture: it takes 12 to 62 bytes for each.
MOST_PIXELS = 1 << 26
#: What is wrong with a picture of more.
TOO_LARGE = f"it has more than {MOST_PIXELS:,} pixels: cut out a part, or scale it down"


@dataclass(frozen=True)
class Picture:
    """A picture: one band of brightness or three of color, and what is opaque.

    Attributes
    ----------
    bands : ndarray of float32, shape (b, h, w)
        Between 0 and 1, b is 1 or 3; what is transparent shows white.
    alpha : ndarray of float32, shape (h, w), or None
        Between 0 and 1; None if all is opaque.
    """

    bands: Bands
    alpha: Bands | None

    @property
    def brightness(self) -> Bands:
        """The brightness (h, w), by the weights of ITU-R BT.601."""
        weights = [1.0] if len(self.bands) == 1 else [0.299, 0.587, 0.114]
        mixed: Bands = np.tensordot(np.array(weights, np.float32), self.bands, axes=1)
        return mixed


def as_picture(image: npt.ArrayLike) -> Picture:
    """Return a picture of an array: (h, w), or (h, w, b) with b = 1 to 4, the last one alpha.

    Whole numbers are shares of the largest one of their type; floats must be finite, and where they
    leave [0, 1] they are taken from their least to their greatest one.

    Raises
    ------
    InputError
        If the shape or type is another one, if a value is not finite, or if it is too large.
    """
    array = np.asarray(image)
    if array.ndim == 2:
        array = array[..., np.newaxis]
    if array.ndim != 3 or not 1 <= array.shape[2] <= 4:
        raise InputError(
            f"image: the shape is {np.shape(image)}: give (h, w), or (h, w, b) with b from 1 to 4"
        )
    if array.size == 0:
        raise InputError("image: it has no pixels: give a picture of one at least")
    if array.shape[0] * array.shape[1] > MOST_PIXELS:
        raise InputError(f"image: {TOO_LARGE}")
    shares = np.moveaxis(_as_shares(array), 2, 0)
    visible, alpha = (shares[:-1], shares[-1]) if len(shares) in (2, 4) else (shares, None)
    if alpha is None or not (alpha < 1).any():
        return Picture(visible, None)
    return Picture(1 + alpha * (visible - 1), alpha)


def _as_shares(array: npt.NDArray[Any]) -> Bands:
    if array.dtype.kind == "b":
        return array.astype(np.float32)
    if array.dtype.kind in "iu":
        least = min(0, int(array.min()))
        span = np.float32(np.iinfo(array.dtype).max - least)
        shares: Bands = (array.astype(np.float32) - np.float32(least)) / span
        return shares
    if array.dtype.kind != "f":
        raise InputError(f"image holds {shown(array.dtype)}: give whole numbers, floats or bools")
    if not np.isfinite(array).all():
        place = tuple(np.argwhere(~np.isfinite(array))[0][:2].tolist())
        raise InputError(f"image: pixel {place} (row, column) is not finite: replace it")
    low, high = min(array.min(), 0), max(array.max(), 1)
    spread = array.astype(np.float64) - low  # of the largest floats, which float32 has not
    scaled: Bands = (spread / (np.float64(high) - low)).astype(np.float32)
    return scaled


def centers(rows: npt.ArrayLike, columns: npt.ArrayLike) -> FloatArray:
    """Return the pixel coordinates (k, 2) of places counted in rows and columns from 0."""
    across = np.asarray(columns, np.float64) + 0.5
    return np.stack([across, -0.5 - np.asarray(rows, np.float64)], axis=-1)
