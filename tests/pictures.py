"""Pictures whose edges are known: figures rendered with a share of each pixel that they cover."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Image = npt.NDArray[np.float64]
Inside = Callable[[Image, Image], npt.NDArray[np.bool_]]

_FINE = 8


def covered(height: int, width: int, inside: Inside) -> Image:
    """The share of each pixel that a figure covers; it is asked in columns and rows from 0."""
    down = (np.arange(height * _FINE) + 0.5) / _FINE
    right = (np.arange(width * _FINE) + 0.5) / _FINE
    hits = inside(*np.meshgrid(right, down)).astype(np.float64)
    return hits.reshape(height, _FINE, width, _FINE).mean((1, 3))


def disk(size: int, x: float, y: float, radius: float) -> Image:
    return covered(size, size, lambda right, down: np.hypot(right - x, down - y) < radius)


def ring(size: int, x: float, y: float, radius: float, width: float) -> Image:
    return disk(size, x, y, radius + width / 2) - disk(size, x, y, radius - width / 2)


def painted(share: Image, color: tuple[int, int, int], paper: tuple[int, int, int]) -> npt.NDArray:
    """A picture (h, w, 3) in which a figure has a color, and what it leaves another one."""
    mixed = share[..., None] * np.array(color) + (1 - share[..., None]) * np.array(paper)
    return np.round(mixed).astype(np.uint8)


def far_from_circle(points: Image, x: float, y: float, radius: float) -> Image:
    """How far points in pixel coordinates (y upwards) are outside a circle (rows downwards)."""
    return np.hypot(points[:, 0] - x, points[:, 1] + y) - radius
