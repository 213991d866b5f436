"""The pictures of the page."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import crustline as cl
from crustline.plot import BLACK, BLUE, GRAY, GREEN, ORANGE, PURPLE, SKY, VERMILLION
from experiments.theory.sizes import HALVED, SIZED
from experiments.theory.trials import METHODS, MODES, Trials

Rows = npt.NDArray[np.float64]

STYLES = {
    "crust": (BLUE, "-", "o"), "β = 1.7": (VERMILLION, "-", "s"), "β = 1.25": (GREEN, "-", "^"),
    "NN-crust": (PURPLE, "--", "D"), "one-step crust": (SKY, "--", "v"),
    "Gabriel": (ORANGE, ":", "P"), "RCGH": (GRAY, ":", "X"),
}  # fmt: skip


def draw_shares(t: Trials) -> Figure:
    """Draw the share of exact reconstructions against r, for both modes."""
    figure, axes = _figure(9.2, 3.9, 2)
    for mode, ax in enumerate(axes):
        for name, (color, style, marker) in STYLES.items():
            shares = 100 * t.exact[:, mode, :, :, list(METHODS).index(name)].mean(axis=(0, 2))
            ax.plot(t.ratios, shares, style, color=color, marker=marker, markersize=4, label=name)
        for r, words in (
            (cl.guaranteed_r("crust"), "crust proven"),
            (0.66, "0.66"),
            (0.72, "0.72"),
        ):
            ax.axvline(r, color=BLACK, linewidth=0.7, linestyle=":")
            ax.annotate(words, (r, 3), (2, 0), textcoords="offset points", size=7, rotation=90)
        ax.set(xlabel="r", title=f"{MODES[mode]} samples", ylim=(-2, 103))
    axes[0].set_ylabel("exact reconstructions, %")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=7, fontsize=8, frameon=False)
    return figure


def draw_orders(sizes: dict[str, list[Rows]], errors: dict[str, Rows]) -> Figure:
    """Draw the errors of the feature size, and of polygons and splines, against r."""
    figure, (left, right) = _figure(9.2, 3.9, 2)
    chosen = {"ellipse 2:1": (BLUE, "o"), "trefoil": (GREEN, "^"), "stadium 2": (ORANGE, "s"),
              "blob 7": (PURPLE, "D")}  # fmt: skip
    for name, (color, marker) in chosen.items():
        if name not in sizes:
            continue
        style: dict[str, Any] = {"color": color, "marker": marker, "markersize": 4}
        sized = [sizes[name][SIZED.index(r)] for r in HALVED]
        size = np.array([(np.median(np.abs(e)), np.abs(e).max()) for e in sized])
        left.plot(HALVED, np.maximum(size[:, 0], 1e-7), "-", label=f"{name}, median", **style)
        left.plot(HALVED, np.maximum(size[:, 1], 1e-7), ":", label=f"{name}, worst", **style)
        right.plot(HALVED, errors[name][:, 0], ":", label=f"{name}, polygon", **style)
        right.plot(HALVED, errors[name][:, 1], "-", label=f"{name}, spline", **style)
    left.set(title="local feature size from samples", ylabel="relative error")
    right.set(title="distance from the curve", ylabel="largest distance")
    for ax in (left, right):
        ax.set(xscale="log", yscale="log", xlabel="r")
        ax.set_xticks(HALVED, [f"{r:g}" for r in HALVED])
        ax.minorticks_off()
        ax.legend(fontsize=7, frameon=False, loc="lower right")
    return figure


def _figure(width: float, height: float, count: int) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    axes = [figure.add_subplot(1, count, k + 1) for k in range(count)]
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
        ax.grid(color="#e5e5e5", linewidth=0.6)
    return figure, axes
