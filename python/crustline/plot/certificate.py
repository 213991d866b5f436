"""The certificate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crustline.plot.axes import (
    BLUE,
    VERMILLION,
    axes,
    draw_segments,
    mark,
)
from crustline.plot.points import plot_indices, plot_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.certify import Certificate

#: Reasons of a certificate, each with a marker that tells them apart without color.
MARKERS = {"undersampled": "o", "endpoint": "s", "branch": "^", "corner": "D", "isolated": "X"}


def plot_certificate(
    certificate: Certificate, ax: Axes | None = None, *, points: bool = True, indices: bool = False
) -> Axes:
    """Draw a certificate: edges that keep the guarantee blue, those that break it vermillion.

    Points that break it are marked, with one shape for each reason.

    Parameters
    ----------
    certificate : Certificate
        What `certify` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    points : bool, default True
        Whether to draw the other points, too.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import certify, crust
    >>> points = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> ax = plot_certificate(certify(points, crust(points)))
    """
    ax, xy = axes(ax, certificate.points)
    edges = np.asarray(certificate.edges).reshape(-1, 2)
    weak = np.zeros(len(edges), bool)
    weak[np.asarray(certificate.weak, np.int64)] = True
    draw_segments(ax, xy[edges[~weak]], BLUE, 1.5, label="keeps the guarantee", zorder=3)
    draw_segments(ax, xy[edges[weak]], VERMILLION, 2.5, label="breaks it", zorder=3)
    if points:
        plot_points(xy, ax)
    reasons = np.asarray(certificate.point_reason)
    for reason, marker in MARKERS.items():
        mark(ax, xy[reasons == reason], marker, VERMILLION, reason)
    ax.set_title("guaranteed" if certificate.guaranteed else "not guaranteed", size=9, loc="left")
    return plot_indices(xy, ax) if indices else ax
