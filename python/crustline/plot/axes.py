"""Axes, and strokes, markers and names of them, in colors that the color-blind can tell apart."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, as_points
from crustline.errors import require
from crustline.path import CLOSE, LINE, MOVE, Path
from crustline.plot.crowd import is_crowd, thinned

if TYPE_CHECKING:
    from matplotlib.axes import Axes


BLACK, GRAY = "#000000", "#9a9a9a"
ORANGE, SKY, GREEN = "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILLION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"
#: Agg gives up on one path with too many crossings; many short paths cost no more.
CHUNK = 10_000


def axes(ax: Axes | None, points: ArrayLike) -> tuple[Axes, FloatArray]:
    """Return the Axes given, or new ones, of equal aspect, that show at least points, and those."""
    xy = as_points(points)
    require("plot", "matplotlib")
    if ax is None:
        ax = _new_axes(xy)
    elif ax.get_aspect() == "auto":
        ax.set_aspect("equal")
    if len(xy):
        ax.update_datalim([xy.min(axis=0), xy.max(axis=0)])
        ax.autoscale_view()
    return ax, xy


def _new_axes(xy: FloatArray) -> Axes:
    """Return quiet Axes of equal aspect in a figure of about the proportions of the points."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = np.ptp(xy, axis=0) if len(xy) else (1.0, 1.0)
    ratio = float(np.clip(height / width if width > 0 else 1.0, 0.3, 1.6))
    figure = Figure(figsize=(6.4, 6.4 * ratio + 0.6), layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot()
    ax.set_aspect("equal", adjustable="datalim")
    ax.margins(0.05)
    ax.spines[["top", "right"]].set_visible(False)
    ax.spines[["left", "bottom"]].set_color(GRAY)
    ax.tick_params(color=GRAY, labelcolor="#555555", labelsize=7, length=2)
    ax.locator_params(nbins=6)
    # Coordinates as they are, such as 500001.5: no "+5e5" to be added in the head.
    ax.ticklabel_format(useOffset=False, scilimits=(-4, 9))
    for axis in (ax.xaxis, ax.yaxis):
        axis.get_offset_text().set_fontsize(7)
    return ax


def draw_segments(
    ax: Axes,
    segments: FloatArray,
    color: str,
    width: float,
    *,
    label: str | None = None,
    zorder: float = 2,
) -> Axes:
    """Draw segments (m, 2, 2)."""
    path = Path.through_all(segments.reshape(-1, 2), np.arange(0, 2 * len(segments), 2))
    return stroke(ax, path, color, width, label=label, zorder=zorder)


def stroke(
    ax: Axes,
    path: Path,
    color: str,
    width: float,
    *,
    label: str | None = None,
    zorder: float = 2,
) -> Axes:
    """Draw a path of lines."""
    if not len(path):
        return ax
    from matplotlib.collections import PathCollection
    from matplotlib.path import Path as Outline

    path = thinned(path)
    # A closing would lead to where its chunk starts; its vertex is the start of the ring.
    codes = np.where(path.codes == CLOSE, LINE, path.codes).astype(np.uint8)
    outlines = []
    for k in range(0, len(path), CHUNK):
        part = codes[k : k + CHUNK + 1].copy()
        part[0] = MOVE
        outlines.append(Outline(path.vertices[k : k + CHUNK + 1], part))
    lines = PathCollection(
        outlines,
        facecolors="none",
        edgecolors=color,
        linewidths=width,
        capstyle="round",
        joinstyle="round",
        zorder=zorder,
        rasterized=is_crowd(path.vertices),
    )
    ax.add_collection(lines, autolim=False)
    if label:
        ax.plot([], [], color=color, linewidth=width, label=label)
        _legend(ax)
    return ax


def mark(ax: Axes, xy: FloatArray, marker: str, color: str, label: str) -> None:
    """Draw open markers, and name them in the legend."""
    if len(xy):
        style = {"markerfacecolor": "none", "markeredgecolor": color, "markeredgewidth": 1.3}
        ax.plot(*xy.T, marker, linestyle="none", markersize=7, zorder=5, label=label, **style)  # type: ignore[arg-type]
        _legend(ax)


def _legend(ax: Axes) -> None:
    """Name what is drawn below the Axes, where it hides nothing."""
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=3, frameon=False, fontsize=8)


def dot_size(n: int) -> float:
    """Return a diameter for each of n dots: 3.5 points for a few, 0.5 for a million."""
    return float(np.clip(40 / math.sqrt(n + 1), 0.5, 3.5))


def box_around(xy: FloatArray) -> FloatArray:
    """Return a box of three times the extent of the points: least x, least y, largest x and y."""
    if not len(xy):
        return np.array([-1.0, -1.0, 1.0, 1.0])
    low, high = xy.min(axis=0), xy.max(axis=0)
    margin = math.hypot(*(high - low)) or 1.0
    return np.concatenate([low - margin, high + margin])
