"""A sheet of small pictures of failures: right edges gray, wrong ones red, missing ones blue."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from .measure import Score
from .reasons import reason

COLUMNS = 6


def draw_sheet(failures: list[Score], path: Path) -> None:
    """Write the sheet of failures to a PNG file."""
    rows = max(1, -(-len(failures) // COLUMNS))
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(3 * COLUMNS, 3.2 * rows), squeeze=False)
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, score in zip(axes.flat, failures, strict=False):
        _draw(ax, score)
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=60)
    plt.close(figure)


def _draw(ax: Axes, score: Score) -> None:
    points = score.case.points
    found, true = (set(map(tuple, rows.tolist())) for rows in (score.edges, score.case.edges))
    for edges, color in ((found & true, "0.6"), (found - true, "red"), (true - found, "blue")):
        rows = np.array(sorted(edges), dtype=np.int64).reshape(-1, 2)
        ax.add_collection(LineCollection(list(points[rows]), colors=color))
    ax.plot(*points.T, "k.", markersize=1.5)
    ax.set_aspect("equal")
    title = f"{score.case.name}: +{score.extra} -{score.missing}\n{reason(score)}"
    ax.set_title(title, fontsize=7)
