"""The boundary of an area: of a mask, or of all that has a color."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.errors import require
from crustline.images.figure import as_color, membership
from crustline.images.picture import Bands, as_picture, centers
from crustline.scalars import as_positive

__all__ = ["boundary_points"]

#: A mask of two values is blurred by this, in pixels, so that its boundary has no stairs; a line
#: one pixel wide survives it.
_STAIRS = 0.7
#: Points along a boundary are at least so far apart, in pixels.
_APART = 0.5


def boundary_points(
    image: npt.ArrayLike, *, color: object = None, blur: float | None = None
) -> FloatArray:
    """Return points on the boundary of an area of a picture, in pixel coordinates.

    The boundary is where a pixel would be half inside: half opaque, half as bright as the brightest
    one, or half on the way from the background to a color. What the picture cuts off ends at its
    border.

    Parameters
    ----------
    image : array_like, shape (h, w) or (h, w, b)
        A mask, or a picture. Of a mask bright is inside, unless most of its border is bright.
    color : str or sequence of three numbers, optional
        The color of the area: "#d00", "#dd0000" or (221, 0, 0).
    blur : float, optional
        How far the mask is blurred, in pixels. By default 0.7 if it has two values only, whose
        boundary would be stairs, else not at all.

    Returns
    -------
    points : ndarray of float64, shape (k, 2)
        x to the right, y upwards.

    Raises
    ------
    InputError
        If the picture, the color or the blur does not fit.
    MissingExtraError
        If scikit-image is not installed.

    Notes
    -----
    Marching squares. Of smooth masks positions are right to some hundredths of a pixel, of masks of
    two values to about a fifth. O(pixels).

    Examples
    --------
    >>> mask = np.zeros((4, 4)); mask[1:3, 1:3] = 1; mask[1, 1] = 0.75
    >>> len(boundary_points(mask))
    8
    """
    require("image", "skimage")
    from skimage.measure import find_contours

    chosen = None if color is None else as_color(color)
    shares = _blurred(membership(as_picture(image), chosen), blur)
    inside = np.pad(shares, 1)
    chains = [_spaced(each) for each in find_contours(inside, 0.5)]
    places = np.concatenate([np.empty((0, 2)), *chains]) - 1
    edge = np.array(shares.shape) - 0.5
    return centers(*np.clip(places, -0.5, edge).T)


def _blurred(shares: Bands, blur: float | None) -> Bands:
    from scipy.ndimage import gaussian_filter

    if blur is None and ((shares > 0) & (shares < 1)).any():
        return shares
    blur = _STAIRS if blur is None else as_positive("blur", blur)
    blurred: Bands = gaussian_filter(shares, blur, mode="nearest")
    return blurred


def _spaced(chain: FloatArray) -> FloatArray:
    """Return the points of a ring without those too near to the one that was kept before them."""
    kept: list[FloatArray] = []
    for place in chain[:-1] if len(chain) > 1 else chain:
        if not kept or np.abs(place - kept[-1]).sum() >= _APART:
            kept.append(place)
    if len(kept) > 1 and np.abs(kept[0] - kept[-1]).sum() < _APART:
        kept.pop()
    return np.array(kept).reshape(-1, 2)
