"""Points, their rows, and their local feature size."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, as_points
from crustline.errors import InputError
from crustline.plot.axes import (
    BLACK,
    GRAY,
    axes,
    dot_size,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


#: More labels than this hide each other, and take minutes.
MOST_LABELS = 5_000
#: From this many points on, lines are drawn above them.
CROWD = 20_000


def plot_points(
    points: ArrayLike,
    ax: Axes | None = None,
    *,
    color: str = BLACK,
    size: float | None = None,
    indices: bool = False,
) -> Axes:
    """Draw points as dots.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    size : float, optional
        Diameter of a dot in typographic points; by default smaller the more points there are.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    InputError
        If the points are not (n, 2) or not finite, or too many to be labeled.

    Examples
    --------
    >>> ax = plot_points([(0, 0), (1, 0), (1, 1)])
    >>> len(ax.lines)
    1
    """
    xy = as_points(points)
    ax = axes(ax, xy)
    diameter = dot_size(len(xy)) if size is None else size
    # A crowd of dots would hide the curve through them.
    order = 4 if len(xy) < CROWD else 1.5
    ax.plot(*xy.T, "o", color=color, markersize=diameter, markeredgewidth=0, zorder=order)
    return plot_indices(xy, ax) if indices else ax


def plot_indices(points: ArrayLike, ax: Axes | None = None, *, color: str = BLACK) -> Axes:
    """Write its row beside each point.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates; at most 5000.
    ax : Axes, optional
        Where to write; new Axes if not given.
    color : str
        Any color of matplotlib.

    Returns
    -------
    ax : Axes

    Raises
    ------
    InputError
        If there are more than 5000 points.

    Examples
    --------
    >>> [text.get_text() for text in plot_indices([(0, 0), (1, 0)]).texts]
    ['0', '1']
    """
    xy = as_points(points)
    if len(xy) > MOST_LABELS:
        raise InputError(
            f"the labels of {len(xy)} points would hide each other: "
            f"label at most {MOST_LABELS}, for instance a part of them"
        )
    ax = axes(ax, xy)
    for row, place in enumerate(xy):
        ax.annotate(
            str(row), place, (2.5, 2.5), textcoords="offset points", size=6, color=color, zorder=6
        )
    return ax


def plot_local_feature_size(points: ArrayLike, sizes: ArrayLike, ax: Axes | None = None) -> Axes:
    """Draw points in colors that tell their local feature size, on a logarithmic scale.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    sizes : array_like of float, shape (n,)
        What `local_feature_size` gives. Points with none (NaN, infinite, 0) are gray.
    ax : Axes, optional
        Where to draw; new Axes if not given.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> ax = plot_local_feature_size([(0, 0), (1, 0)], [0.1, 10.0])
    """
    xy, lfs = as_points(points), np.asarray(sizes, np.float64)
    ax = axes(ax, xy)
    from matplotlib.colors import LogNorm

    known = np.isfinite(lfs) & (lfs > 0)
    area = (1.6 * dot_size(len(xy))) ** 2
    x, y = xy.T
    ax.scatter(x[~known], y[~known], area, GRAY, linewidths=0, zorder=3)
    if not known.any():
        return ax
    scale = LogNorm(*_open_range(lfs[known]))
    dots = ax.scatter(
        x[known], y[known], area, lfs[known], norm=scale, cmap="viridis", linewidths=0, zorder=3
    )
    figure: Any = ax.get_figure(root=True)
    bar = figure.colorbar(dots, ax=ax, shrink=0.7)
    bar.set_label("local feature size", size=8)
    for which in ("major", "minor"):
        bar.ax.tick_params(which=which, labelsize=7)
    bar.outline.set_visible(False)
    return ax


def _open_range(values: FloatArray) -> tuple[float, float]:
    """Return least and largest value, apart if they are equal, for a scale of colors."""
    low, high = float(values.min()), float(values.max())
    return (low, high) if low < high else (low / 2, high * 2)
