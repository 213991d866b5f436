"""What of a picture belongs to a figure: how much of each pixel, between 0 and 1."""

from __future__ import annotations

import re

import numpy as np
import numpy.typing as npt

from crustline.errors import InputError, shown
from crustline.images.picture import Bands, Picture

__all__ = ["as_color", "membership"]

Color = npt.NDArray[np.float32]

#: How far from the way between background and color a mixed pixel may be, as a part of that way
#: and at the least: half as far it counts wholly, so far not at all.
_ASIDE, _LEAST_ASIDE = 0.25, 0.2
#: Colors nearer than this to the one that is looked for are not the background.
_NOT_BACKGROUND = 0.25


def membership(picture: Picture, color: Color | None) -> Bands:
    """Return how much of each pixel is of a color; without one, how opaque or bright it is.

    Bright and dark change places if most of the border is bright: what is there is outside.
    """
    if color is not None:
        return _of_color(picture, color)
    opaque = picture.alpha is not None and np.ptp(picture.alpha) > 0
    found = picture.alpha if opaque and picture.alpha is not None else picture.brightness
    low, high = float(found.min(initial=1)), float(found.max(initial=0))
    if high <= low:
        return np.zeros_like(found)
    shares: Bands = (found - np.float32(low)) / np.float32(high - low)
    border = np.concatenate([shares[0], shares[-1], shares[:, 0], shares[:, -1]])
    if np.median(border) > 0.5:
        shares = 1 - shares
    return shares


def _of_color(picture: Picture, color: Color) -> Bands:
    """Return how far each pixel is on the way from the background to a color.

    A pixel on a boundary mixes the two, so it is half a member where the boundary is in its middle.
    """
    bands = np.broadcast_to(picture.bands, (3, *picture.bands.shape[1:]))
    background = _background(bands, color)
    way = color - background
    length2 = np.float32(way @ way)
    beyond = bands - background[:, None, None]
    share: Bands = np.clip(np.tensordot(way, beyond, axes=1) / length2, 0, 1)
    aside = np.sqrt(sum((beyond[k] - share * way[k]) ** 2 for k in range(3)))
    most = max(_ASIDE * float(np.sqrt(length2)), _LEAST_ASIDE)
    belongs: Bands = (share * np.clip(2 - 2 * aside / most, 0, 1)).astype(np.float32)
    return belongs


def _background(bands: Bands, color: Color) -> Color:
    """Return the most frequent color of those that are not near a color."""
    bins = np.clip(bands * 16, 0, 15).astype(np.intp)
    keys = (bins[0] * 16 + bins[1]) * 16 + bins[2]
    counts = np.bincount(keys.ravel(), minlength=4096)
    middles = (np.stack(np.unravel_index(np.arange(4096), (16, 16, 16))) + 0.5) / 16
    counts[np.linalg.norm(middles - color[:, None], axis=0) < _NOT_BACKGROUND] = 0
    if not counts.any():
        raise InputError("color: the picture has no other color than this one: choose another one")
    members = bands[:, keys == np.argmax(counts)].astype(np.float64)
    mean: Color = members.mean(axis=1).astype(np.float32)
    return mean


def as_color(value: object) -> Color:
    """Return red, green and blue between 0 and 1, from "#d00", "#dd0000" or three numbers to 255.

    >>> as_color("#f00").tolist()
    [1.0, 0.0, 0.0]
    """
    advice = f"color is {shown(value)}: write it as '#d00', '#dd0000' or (221, 0, 0)"
    if isinstance(value, str):
        digits = re.fullmatch(r"#?([0-9a-fA-F]{3}|[0-9a-fA-F]{6})", value.strip())
        if digits is None:
            raise InputError(advice)
        size = len(digits[1]) // 3
        parts = [digits[1][k * size : (k + 1) * size] * (3 - size) for k in range(3)]
        value = [int(part, 16) for part in parts]
    try:
        color: Color = np.asarray(value, np.float32) / np.float32(255)
    except (ValueError, TypeError, OverflowError):
        raise InputError(advice) from None
    if color.shape != (3,) or not ((color >= 0) & (color <= 1)).all():
        raise InputError(advice)
    return color
