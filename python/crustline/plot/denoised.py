"""Fitted curves beside the noisy points, with a band as wide as they are uncertain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.denoise.polygon import Polygon
from crustline.plot.axes import GRAY, ORANGE, SKY, axes, mark
from crustline.plot.curves import plot_curves
from crustline.plot.points import plot_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.denoise import Denoised

#: Deviations that the band reaches to either side: about 19 of 20 places are in it.
BAND = 2.0


def plot_denoised(denoised: Denoised, ax: Axes | None = None, *, points: bool = True) -> Axes:
    """Draw fitted curves in a band of two standard deviations, the points gray, and the outliers.

    There is no band where they were fitted in another CRS than that of the points.

    Parameters
    ----------
    denoised : Denoised
        What `denoise` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    points : bool, default True
        Whether to draw the points, too.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import denoise
    >>> ax = plot_denoised(denoise([(k, k % 2 / 3) for k in range(40)]))
    """
    ax, xy = axes(ax, denoised.points)
    if points:
        plot_points(xy, ax, color=GRAY)
    if denoised.crs is None:
        _band(denoised, ax)
    plot_curves(denoised.curves, ax, points=False)
    mark(ax, xy[denoised.outliers], "o", ORANGE, "outlier")
    return ax


def _band(denoised: Denoised, ax: Axes) -> None:
    from matplotlib.collections import PolyCollection

    quads = []
    for curve in denoised.curves:
        polygon = Polygon(denoised.curves.points.xy[curve.indices], curve.closed)
        reach = BAND * denoised.uncertainty[curve.indices][:, None] * polygon.normals
        sides = np.stack((polygon.nodes + reach, polygon.nodes - reach), axis=1)
        after = np.roll(sides, -1, axis=0)
        pieces = np.concatenate((sides, after[:, ::-1]), axis=1)
        quads.append(pieces if curve.closed else pieces[:-1])
    bands = PolyCollection(
        list(np.concatenate(quads)) if quads else [], facecolors=SKY, alpha=0.5, linewidths=0
    )
    ax.add_collection(bands, autolim=False)
