"""The middles of strokes: ink on paper, or lines of a color.

The skeleton says which pixels are in the middle, and C. Steger, "An Unbiased Detector of
Curvilinear Structures", PAMI 20 (1998), where between them: the second derivatives across a stroke,
taken at its own width, give the way to its middle.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.errors import require
from crustline.images.figure import as_color, membership
from crustline.images.picture import Bands, Picture, as_picture, centers
from crustline.images.skeleton import skeleton_of

__all__ = ["stroke_points"]

#: A stroke is looked for in blocks of this part of the picture's longer side, at the least of so
#: many pixels: the paper's brightness may change from one to the next.
_BLOCK, _LEAST_BLOCK = 1 / 20, 16
#: Where ink and paper differ by less than this part of the whole range there is no ink.
_LEAST_INK = 0.2
#: The way from a pixel to the middle of its stroke: more says that there is no middle near.
_MOST = 1.5
#: The least blur under which thin strokes are looked at, in pixels.
_LEAST_BLUR = 1.2


def stroke_points(image: npt.ArrayLike, *, color: object = None) -> FloatArray:
    """Return points along the middles of strokes, about one a pixel, in pixel coordinates.

    Parameters
    ----------
    image : array_like, shape (h, w) or (h, w, b)
        Dark ink on bright paper, or the reverse, evenly lit or not; or a picture with lines of a
        color.
    color : str or sequence of three numbers, optional
        The color of the lines: "#d00", "#dd0000" or (221, 0, 0). By default what is darker than the
        paper around it is ink.

    Returns
    -------
    points : ndarray of float64, shape (k, 2)
        x to the right, y upwards, in the order of rows.

    Raises
    ------
    InputError
        If the picture or the color does not fit.
    MissingExtraError
        If scikit-image is not installed.

    Notes
    -----
    Of smooth strokes positions are right to some hundredths of a pixel. The ends of a stroke are
    half its width too short, and where strokes cross or turn sharply the middle is that of the
    blot. O(pixels).

    Examples
    --------
    >>> paper = np.ones((9, 30)); paper[4, 2:28] = 0
    >>> stroke_points(paper)[:, 1].round(2).tolist() == [-4.5] * 26
    True
    """
    require("image", "skimage")
    picture = as_picture(image)
    shares = _ink(picture) if color is None else membership(picture, as_color(color))
    skeleton, depth = skeleton_of(shares >= 0.5)
    rows, columns = np.nonzero(skeleton)
    if not len(rows):
        return np.empty((0, 2))
    half = float(np.median(depth[rows, columns]))
    down, right = _to_middle(shares, rows, columns, half)
    return centers(rows + down, columns + right)


def _ink(picture: Picture) -> Bands:
    """Return how much of each pixel is ink: 0 like the paper around it, 1 like most of the ink."""
    from scipy.ndimage import gaussian_filter, grey_closing
    from skimage.filters import threshold_otsu

    bright = picture.brightness
    if np.median(bright) < (float(bright.min()) + float(bright.max())) / 2:
        bright = 1 - bright
    block = max(_LEAST_BLOCK, round(_BLOCK * max(bright.shape))) | 1
    paper = gaussian_filter(grey_closing(bright, size=(block, block)), block / 4, mode="nearest")
    darker = np.maximum(paper - bright, 0)
    if float(darker.max(initial=0)) < _LEAST_INK * float(np.ptp(bright)):
        return np.zeros_like(bright)
    threshold = threshold_otsu(darker)
    ink = float(np.median(darker[darker > threshold])) if (darker > threshold).any() else 1.0
    shares: Bands = np.clip(darker / np.float32(ink), 0, 1)
    return shares


def _to_middle(
    shares: Bands, rows: IntArray, columns: IntArray, half: float
) -> tuple[FloatArray, FloatArray]:
    """Return the way, down and to the right, from pixels to the middle of their stroke."""
    from scipy.ndimage import gaussian_filter

    blur = max(half / np.sqrt(3), _LEAST_BLUR)

    def slope(*order: int) -> FloatArray:
        sloped = gaussian_filter(shares, blur, order=order, mode="nearest")
        return sloped[rows, columns].astype(np.float64)

    orders = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
    ink, dy, dx, dyy, dxy, dxx = (slope(*each) for each in orders)
    turn = np.arctan2(2 * dxy, dxx - dyy) / 2  # of the axis of the larger eigenvalue
    turn += np.where(dxx + dyy < 0, np.pi / 2, 0)  # the ridge bends down across: the least one
    across_x, across_y = np.cos(turn), np.sin(turn)
    climb = dx * across_x + dy * across_y
    bend = dxx * across_x**2 + 2 * dxy * across_x * across_y + dyy * across_y**2
    # One Newton step on the logarithm, which is a parabola where the blurred stroke is a Gaussian.
    bend = ink * bend - climb**2
    way = -ink * climb / np.where(bend < 0, bend, -np.inf)
    way = np.where(np.abs(way) <= _MOST, way, 0.0)
    return way * across_y, way * across_x
