"""The skeleton of a figure, without the spurs that corners and ends of strokes grow."""

from __future__ import annotations

import numpy as np

from crustline.arrays import BoolArray, FloatArray

__all__ = ["skeleton_of"]

#: Rounds of pruning: what was a fork may be an end after one.
_ROUNDS = 3
#: The neighbors of a pixel, (down, right), counter-clockwise.
_AROUND = ((0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0), (1, 1))

Pixel = tuple[int, int]


def skeleton_of(inside: BoolArray) -> tuple[BoolArray, FloatArray]:
    """Return the skeleton of a figure, and how far each pixel is inside of it.

    A branch that ends no farther from its fork than the figure is wide there is a spur: it leads
    into a corner, or to one of the two corners at the end of a stroke.
    """
    from scipy.ndimage import distance_transform_edt
    from skimage.morphology import skeletonize

    padded = np.pad(inside, 1)
    depth = distance_transform_edt(padded)
    skeleton = skeletonize(padded)
    for _ in range(_ROUNDS):
        spurs = _spurs(skeleton, depth)
        if not spurs:
            break
        skeleton[tuple(np.array(spurs).T)] = False
        skeleton = skeletonize(skeleton)
    return skeleton[1:-1, 1:-1], depth[1:-1, 1:-1]


def _spurs(skeleton: BoolArray, depth: FloatArray) -> list[Pixel]:
    """Return the pixels of all spurs."""
    branches = _branches(skeleton)
    found: list[Pixel] = []
    for end in np.argwhere(skeleton & (branches == 1)).tolist():
        found += _spur_from((end[0], end[1]), skeleton, branches, depth)
    return found


def _branches(skeleton: BoolArray) -> FloatArray:
    """Return how many branches leave each pixel: runs of the skeleton in the circle around it."""
    ring = [np.roll(skeleton, (-down, -right), (0, 1)) for down, right in _AROUND]
    starts = [here & ~before for before, here in zip([ring[-1], *ring[:-1]], ring, strict=True)]
    branches: FloatArray = np.sum(starts, axis=0, dtype=np.float64)
    return branches


def _spur_from(
    end: Pixel, skeleton: BoolArray, branches: FloatArray, depth: FloatArray
) -> list[Pixel]:
    """Return the pixels from an end to its fork if they are a spur, else none."""
    way = [end]
    longest = 2 * float(depth[end]) + 2 * float(depth.max())
    while len(way) <= longest:
        beyond = [pixel for pixel in _neighbors(way[-1], skeleton) if pixel not in way[-3:]]
        if not beyond:
            return []
        step = beyond[0]
        if branches[step] >= 3:
            return way if _length(end, step) <= 2 * float(depth[step]) else []
        way.append(step)
    return []


def _neighbors(pixel: Pixel, skeleton: BoolArray) -> list[Pixel]:
    """Return the neighbors of a pixel in the skeleton, those beside it before those at corners."""
    row, column = pixel
    near = [(row + down, column + right) for down, right in _AROUND[::2] + _AROUND[1::2]]
    return [each for each in near if skeleton[each]]


def _length(end: Pixel, fork: Pixel) -> float:
    return float(np.hypot(end[0] - fork[0], end[1] - fork[1]))
