"""Points, their rows, and their local feature size."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, IntArray
from crustline.plot.axes import (
    BLACK,
    GRAY,
    axes,
    dot_size,
)
from crustline.plot.crowd import is_crowd, one_per_spot

if TYPE_CHECKING:
    from matplotlib.axes import Axes


#: So many labels are all written, though some may touch.
FEW_LABELS = 250
#: Labels that fit beside each other, and above each other, along the longer side.
LABEL_CELLS = (22, 50)
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
        If the points are not (n, 2) or not finite.

    Examples
    --------
    >>> ax = plot_points([(0, 0), (1, 0), (1, 1)])
    >>> len(ax.lines)
    1
    """
    ax, xy = axes(ax, points)
    diameter = dot_size(len(xy)) if size is None else size
    # A crowd of dots would hide the curve through them.
    order = 4 if len(xy) < CROWD else 1.5
    drawn = xy[one_per_spot(xy)]
    dots = ax.plot(*drawn.T, "o", color=color, markersize=diameter, markeredgewidth=0, zorder=order)
    dots[0].set_rasterized(is_crowd(drawn))
    return plot_indices(xy, ax) if indices else ax


def plot_indices(points: ArrayLike, ax: Axes | None = None, *, color: str = BLACK) -> Axes:
    """Write its row beside each point.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates. Of more than 250 points only those get a label that have room for it; how many
        is said in the corner.
    ax : Axes, optional
        Where to write; new Axes if not given.
    color : str
        Any color of matplotlib.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> [text.get_text() for text in plot_indices([(0, 0), (1, 0)]).texts]
    ['0', '1']
    """
    ax, xy = axes(ax, points)
    rows = _legible(xy)
    for row in rows.tolist():
        ax.annotate(
            str(row), xy[row], (2.5, 2.5), textcoords="offset points", size=6, color=color, zorder=6
        )
    if len(rows) < len(xy):
        note = f"{len(rows):,} of {len(xy):,} rows are written"
        ax.text(1, 1, note, transform=ax.transAxes, size=6, color=GRAY, ha="right", va="bottom")
    return ax


def _legible(xy: FloatArray) -> IntArray:
    """Return the rows whose labels have room: all of a few, and of many those clear of others."""
    if len(xy) <= FEW_LABELS:
        return np.arange(len(xy))
    low = xy.min(axis=0)
    extent = float((xy.max(axis=0) - low).max()) or 1.0
    places = (xy - low) * (np.array(LABEL_CELLS) / extent)  # a label is 1 wide and 1 high
    cells = places.astype(np.int64)
    taken: dict[tuple[int, int], FloatArray] = {}
    rows = []
    for row in np.sort(np.unique(cells, axis=0, return_index=True)[1]).tolist():
        column, line = cells[row].tolist()
        around = [(column + i, line + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        near = [taken[cell] for cell in around if cell in taken]
        if all(np.abs(places[row] - other).max() >= 1 for other in near):
            taken[column, line] = places[row]
            rows.append(row)
    return np.array(rows)


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
    (ax, xy), lfs = axes(ax, points), np.asarray(sizes, np.float64)
    from matplotlib.colors import LogNorm

    diameter = 1.6 * dot_size(len(xy))
    drawn = one_per_spot(xy, by=lfs)  # the least decides what is guaranteed
    xy, lfs = xy[drawn], lfs[drawn]
    known = np.isfinite(lfs) & (lfs > 0)
    area = diameter**2
    x, y = xy.T
    # Above the points: their black would hide the colors.
    ax.scatter(x[~known], y[~known], area, GRAY, linewidths=0, zorder=4.5)
    if not known.any():
        return ax
    scale = LogNorm(*_open_range(lfs[known]))
    dots = ax.scatter(
        x[known], y[known], area, lfs[known], norm=scale, cmap="viridis", linewidths=0, zorder=4.5
    )
    dots.set_rasterized(is_crowd(xy))
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
