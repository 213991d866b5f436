"""Edges between bright and dark, or between colors, with positions between the pixels.

J. Canny, "A Computational Approach to Edge Detection", PAMI 8 (1986); F. Devernay, "A Non-Maxima
Suppression Method for Edge Detection with Sub-Pixel Accuracy", INRIA RR-2724 (1995). Here the
parabola is laid through the logarithms of the slopes: across a blurred step these are a Gaussian,
whose logarithm is a parabola exactly.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.errors import require
from crustline.images.picture import Bands, Picture, as_picture, centers
from crustline.scalars import as_positive, as_share

__all__ = ["edge_points"]

#: Two points of an edge nearer than this, in pixels, are one: both neighbors claimed it.
_SAME = 0.5


def edge_points(image: npt.ArrayLike, *, blur: float = 1.0, contrast: float = 0.2) -> FloatArray:
    """Return points on the edges of a picture, about one a pixel, in pixel coordinates.

    A point is where brightness, or one of three colors, changes fastest.

    Parameters
    ----------
    image : array_like, shape (h, w) or (h, w, b)
        A picture; see `crustline.images`. Of four bands, or two, the last one is alpha.
    blur : float, default 1.0
        How far it is blurred first, in pixels (σ of a Gaussian): more for a noisy picture, less for
        details that are nearer to each other than four pixels.
    contrast : float, default 0.2
        The least step that is an edge, as a part of the whole range of the picture; an edge goes on
        where its step is half of that.

    Returns
    -------
    points : ndarray of float64, shape (k, 2)
        x to the right, y upwards, in the order of rows.

    Raises
    ------
    InputError
        If the picture, the blur or the contrast does not fit.
    MissingExtraError
        If scikit-image or SciPy is not installed.

    Notes
    -----
    Of a straight step without noise the position is right to 0.05 pixels, with a blur of 2 to 0.02;
    where the edge turns within a few times the blur, as at corners, it is rounded off by about the
    blur. O(pixels).

    Examples
    --------
    >>> step = np.zeros((5, 6)); step[:, 3:] = 1
    >>> edge_points(step).round(2).tolist()
    [[3.0, -1.5], [3.0, -2.5], [3.0, -3.5]]
    """
    require("image", "scipy")
    blur, contrast = as_positive("blur", blur), as_share("contrast", contrast)
    step, dx, dy = _steepest(as_picture(image), blur)
    steep = np.abs(dx) >= np.abs(dy)
    along_row, along_column = _maxima(step), _maxima(step.T).T
    found = _connected(np.where(steep, along_row, along_column), step, contrast)
    rows, columns = (each.astype(np.int64) for each in np.nonzero(found))
    sideways = steep[found]
    right = np.where(sideways, _peak(step, rows, columns, (0, 1)), 0)
    down = np.where(sideways, 0, _peak(step, rows, columns, (1, 0)))
    points = centers(rows + down, columns + right)
    return _without_doubles(points)


def _steepest(picture: Picture, blur: float) -> tuple[Bands, Bands, Bands]:
    """Return the step that each pixel sees, and its slope across and down, in its steepest band."""
    from scipy.ndimage import gaussian_filter

    span = float(np.ptp(picture.bands)) if picture.bands.size else 0.0
    step = across = down = np.zeros(picture.bands.shape[1:], np.float32)
    for band in picture.bands:
        dx, dy = (
            gaussian_filter(band, blur, order=order, mode="nearest", truncate=3)
            for order in ((0, 1), (1, 0))
        )
        size = np.hypot(dx, dy)
        more = size > step
        step, across, down = (
            np.where(more, new, old) for new, old in ((size, step), (dx, across), (dy, down))
        )
    # A step of height 1 has the slope 1 / (blur √2π) in its middle.
    return step * np.float32(blur * np.sqrt(2 * np.pi) / (span or 1.0)), across, down


def _maxima(step: Bands) -> BoolArray:
    """Return where the step is larger than at the left, and not smaller than at the right."""
    found = np.zeros(step.shape, np.bool_)
    found[:, 1:-1] = (step[:, 1:-1] > step[:, :-2]) & (step[:, 1:-1] >= step[:, 2:])
    return found


def _connected(maxima: BoolArray, step: Bands, contrast: float) -> BoolArray:
    """Return the maxima of half the contrast that lead to one of the whole, over neighbors."""
    from scipy.ndimage import label

    found = maxima & (step >= contrast / 2)
    found[[0, -1], :] = found[:, [0, -1]] = False
    numbers, count = label(found, np.ones((3, 3)))
    strong = np.zeros(count + 1, np.bool_)
    strong[numbers[found & (step >= contrast)]] = True
    return strong[numbers]


def _peak(step: Bands, rows: IntArray, columns: IntArray, ahead: tuple[int, int]) -> FloatArray:
    """Return where, between -1/2 and 1/2 of a pixel ahead, the step is largest."""
    down, right = ahead
    values = [step[rows + k * down, columns + k * right].astype(np.float64) for k in (-1, 0, 1)]
    before, here, after = (np.log(np.maximum(each, 1e-6)) for each in values)
    bend = before - 2 * here + after
    peak: FloatArray = np.clip((before - after) / (2 * np.where(bend < 0, bend, -1.0)), -0.5, 0.5)
    return peak


def _without_doubles(points: FloatArray) -> FloatArray:
    from scipy.spatial import cKDTree

    kept = np.ones(len(points), np.bool_)
    for i, j in sorted(cKDTree(points).query_pairs(_SAME)) if len(points) else ():
        if kept[i]:
            kept[j] = False
    return points[kept]
