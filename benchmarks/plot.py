"""The log-log plot of docs/benchmarks.md: seconds by points, a panel for each task."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from .results import Results
from .rivals import CONTENDERS, OURS, Contender

PANELS = ("uniform", "curves")


def maker(contender: Contender) -> str:
    """Whose work it is; it has one color in all panels."""
    return contender.name.removesuffix(", two passes")


COLORS = {name: f"C{k}" for k, name in enumerate(dict.fromkeys(map(maker, CONTENDERS)))}
# Text stays text, and the file is the same for the same figures.
STYLE: Any = {"svg.fonttype": "none", "svg.hashsalt": "crustline", "font.size": 9}


def plot(results: Results, path: Path) -> None:
    """Draw the contenders of each task on two distributions, and write the figure."""
    with mpl.rc_context(STYLE):
        figure, grid = plt.subplots(
            2, len(PANELS), figsize=(10, 9), sharex=True, layout="constrained"
        )
        for row, task in zip(grid, ("delaunay", "crust"), strict=True):
            for axes, distribution in zip(row, PANELS, strict=True):
                draw(axes, results, distribution, task)
        figure.savefig(path, metadata={"Date": None})
        plt.close(figure)


def draw(axes: Axes, results: Results, distribution: str, task: str) -> None:
    for contender in (c for c in results.contenders if c.task == task):
        ours = contender in OURS
        found = [
            r for r in results.all if r.distribution == distribution and r.label == contender.label
        ]
        done = [r for r in found if not r.note]
        axes.loglog(
            [r.n for r in done],
            [r.seconds for r in done],
            marker="o",
            markersize=3,
            color=COLORS[maker(contender)],
            linewidth=2.2 if ours else 1,
            zorder=3 if ours else 2,
            label=contender.name,
        )
    axes.set(title=f"{task}, {distribution}", xlabel="points", ylabel="seconds")
    axes.grid(which="major", alpha=0.3)
    if axes.lines:
        axes.legend(frameon=False)
