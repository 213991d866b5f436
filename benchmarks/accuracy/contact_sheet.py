"""Sheets of small pictures; of failures: right edges gray, wrong ones red, missing ones blue."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from .measure import Score
from .reasons import reason

COLUMNS = 6

Item = TypeVar("Item")


def draw_sheet(failures: list[Score], path: Path) -> None:
    """Write the sheet of failures to a PNG file."""
    write_sheet(failures, _draw, path, columns=COLUMNS, size=(3, 3.2), dpi=60)


def write_sheet(
    items: Sequence[Item],
    draw: Callable[[Axes, Item], None],
    path: Path,
    *,
    columns: int,
    size: tuple[float, float],
    **saving: Any,
) -> None:
    """Write small pictures of a size in inches, row by row, to a PNG file."""
    rows = max(1, -(-len(items) // columns))
    width, height = size
    figsize = (width * columns, height * rows)
    figure, axes = plt.subplots(rows, columns, figsize=figsize, squeeze=False)
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, item in zip(axes.flat, items, strict=False):
        draw(ax, item)
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, **saving)
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
