"""Pieces that the figures are drawn from."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon

import crustline as cl
from crustline import plot, shapes
from crustline.plot import BLACK, VERMILLION

Rows = npt.NDArray[np.float64]

Edges = npt.NDArray[np.int64]
Box = tuple[float, float, float, float]
TEXT = 11


def contained(edges: Edges, others: Edges) -> npt.NDArray[np.bool_]:
    known = {(i, j) for i, j in others.tolist()}
    return np.array([(i, j) in known for i, j in edges.tolist()], bool)


def dense_points(curve: shapes.SmoothCurve) -> Rows:
    return curve.point(np.linspace(0, 1, 400 * len(curve.loops), endpoint=False))


def draw_curve(ax: Axes, curve: shapes.SmoothCurve) -> None:
    for loop in curve.components:
        ax.add_patch(
            Polygon(dense_points(loop), facecolor="none", edgecolor=BLACK, linewidth=2.4, zorder=3)
        )


def draw_axis(ax: Axes, curve: shapes.SmoothCurve, r: float, box: Box, outer: bool = True) -> None:
    """Draw the medial axis of dense samples, which is near the curve's own."""
    sample = cl.r_sample(curve, r)
    ax.update_datalim(np.reshape(box, (2, 2)))
    plot.plot_medial_axis(cl.medial_axis(sample.points, sample.edges), ax, outer=outer, width=1.8)


def tangent_center(curve: shapes.SmoothCurve, t: float) -> Rows:
    """Return the center of the largest empty disk inside that is tangent at t."""
    p, n = curve.point(t), curve.normal(t)
    apart = curve.point(np.linspace(0, 1, 20_000, endpoint=False) + 1e-5) - p
    bend = 2 * apart @ n / np.sum(apart**2, axis=1)
    return np.asarray(p + n / bend.max())


def nearest_on_axis(curve: shapes.SmoothCurve, p: Rows) -> Rows:
    vertices = curve.medial_axis().vertices
    return np.asarray(vertices[np.argmin(np.hypot(*(vertices - p).T))])


def draw_line(
    ax: Axes,
    a: Any,
    b: Any,
    color: str,
    style: str = "-",
    width: float = 1.4,
) -> None:
    ax.plot([a[0], b[0]], [a[1], b[1]], style, color=color, linewidth=width, zorder=3)


def draw_disk(
    ax: Axes, center: Any, radius: float, *, fill: str = "", edge: str = "none", alpha: float = 1.0
) -> None:
    """Draw a disk without border, or the circle around it."""
    x, y = center
    face, width = fill or "none", 0.0 if fill else 1.3
    circle = Circle((x, y), radius, facecolor=face, alpha=alpha, edgecolor=edge, linewidth=width)
    ax.add_patch(circle)


def draw_dots(ax: Axes, places: Iterable[Any]) -> None:
    ax.plot(*np.array(list(places)).T, "o", color=BLACK, markersize=5, zorder=5)


def write_at(ax: Axes, text: str, at: Any, offset: tuple[float, float], color: str = BLACK) -> None:
    ax.annotate(text, at, offset, textcoords="offset points", size=TEXT, color=color, zorder=6)


def mark_angle(
    ax: Axes, at: Any, start: float, end: float, size: float, name: str = "", away: float = 0.0
) -> None:
    """Mark an angle (degrees) by an arc, with its name on the bisector, `away` from the corner."""
    arc = Arc(at, 2 * size, 2 * size, theta1=start, theta2=end, color=VERMILLION, linewidth=1.2)
    ax.add_patch(arc)
    middle = math.radians((start + end) / 2)
    x, y = at[0] + away * math.cos(middle), at[1] + away * math.sin(middle)
    ax.text(x, y, name, size=TEXT, color=VERMILLION, ha="center", va="center")


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of this size in inches, in no window."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def bare_panels(
    count: int, box: Box, *, width: float, titled: bool = False
) -> tuple[Figure, list[Axes]]:
    """Return a figure of this width in inches: bare Axes side by side that show the box."""
    ratio = (box[3] - box[1]) / (box[2] - box[0])
    figure = new_figure(width, width / count * ratio + 0.35 * titled)
    axes = [figure.add_subplot(1, count, k + 1) for k in range(count)]
    for ax in axes:
        ax.set_aspect("equal")
        ax.axis("off")
    return figure, axes


def box_of(points: Rows, margin: float) -> Box:
    """Return least and largest coordinates, with a margin that is a share of the extent."""
    low, high = points.min(axis=0), points.max(axis=0)
    pad = margin * float((high - low).max())
    return (low[0] - pad, low[1] - pad, high[0] + pad, high[1] + pad)


def show_just(ax: Axes, box: Box) -> None:
    """Show just this box, without a legend: captions say what is drawn."""
    if legend := ax.get_legend():
        legend.remove()
    ax.set(xlim=(box[0], box[2]), ylim=(box[1], box[3]))


def open_frame(ax: Axes) -> None:
    ax.spines[["top", "right"]].set_visible(False)
    ax.tick_params(labelsize=9)
