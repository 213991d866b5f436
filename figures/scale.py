"""Redraw the picture of docs/scale.md: python -m figures.scale

Writes docs/scale.png: why an edge can be decided by what a tile sees, and what a tile hands on.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

import crustline as cl
from crustline.arrays import FloatArray
from crustline.distributed.cuts import cut
from crustline.plot import BLACK, BLUE, ORANGE, VERMILLION

TARGET = Path(__file__).parent.parent / "docs" / "scale.png"
GRAY = "0.75"


def border(site: FloatArray, others: FloatArray, directions: FloatArray, far: float) -> FloatArray:
    """Return how far the border of a site's Voronoi cell is in each direction, at most `far`."""
    steps = others - site
    along = directions @ steps.T
    with np.errstate(divide="ignore"):
        distances = np.where(along > 0, (steps**2).sum(axis=1) / (2 * along), np.inf)
    nearest: FloatArray = np.minimum(distances.min(axis=1), far)
    return nearest


def draw_reach(ax: Axes) -> None:
    """Draw the cell of a sample over what a tile has seen, and how far its partners can be."""
    angle = np.linspace(0.1, 2.7, 27)
    curve = np.stack([2 * np.cos(angle), 1.4 * np.sin(angle)], axis=1)
    seen = curve[9:]
    k = 3
    turn = np.linspace(0, 2 * np.pi, 1441)[:-1]
    directions = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    radius = border(seen[k], np.delete(seen, k, axis=0), directions, 40.0)
    quarter = np.roll(radius, -360)
    reach = 2 * np.max(1 / np.sqrt(radius**-2 + quarter**-2))
    cell = seen[k] + radius[:, None] * directions
    ax.add_patch(Polygon(cell, facecolor=BLUE, alpha=0.25))
    ax.add_patch(Circle((seen[k][0], seen[k][1]), reach, fill=False, edgecolor=VERMILLION))
    ax.axvline(seen[0, 0] + 0.09, color=BLACK, linewidth=1, linestyle="--")
    ax.plot(*curve[:9].T, "o", color=GRAY, markersize=4)
    ax.plot(*seen.T, "o", color=BLACK, markersize=4)
    ax.plot(*seen[k], "o", color=VERMILLION, markersize=6)
    ax.set(xlim=(-1.9, 2.1), ylim=(0.1, 2.4), aspect="equal")
    ax.set_title("No partner is beyond the reach", fontsize=10)


def draw_tiles(ax: Axes) -> None:
    """Draw a coast in tiles: edges that a tile decides by itself, and those across."""
    turn = np.random.default_rng(3).random(1500) * 2 * np.pi
    lobes = 1 + 0.2 * np.sin(3 * turn) + 0.08 * np.sin(11 * turn)
    points = lobes[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    tiles = cut(points, np.ones(len(points)), 200).leaf_of(points)
    edges = cl.crust(points)
    across = tiles[edges[:, 0]] != tiles[edges[:, 1]]
    for tile in range(tiles.max() + 1):
        low, high = points[tiles == tile].min(axis=0), points[tiles == tile].max(axis=0)
        size = high - low
        ax.add_patch(Rectangle((low[0], low[1]), *size, fill=False, edgecolor=GRAY))
    ax.add_collection(LineCollection(list(points[edges[~across]]), colors=BLACK, linewidths=1.5))
    ax.add_collection(LineCollection(list(points[edges[across]]), colors=ORANGE, linewidths=4))
    ax.plot(*points[edges[across]].reshape(-1, 2).T, "o", color=ORANGE, markersize=5)
    ax.set(xlim=(-1.35, 1.3), ylim=(-1.35, 1.2), aspect="equal")
    ax.set_title("Cut vertices join the chains of tiles", fontsize=10)


def draw() -> Figure:
    """Draw both panels."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), width_ratios=(1.25, 1))
    draw_reach(axes[0])
    draw_tiles(axes[1])
    for ax in axes:
        ax.set_axis_off()
    figure.tight_layout()
    return figure


if __name__ == "__main__":
    draw().savefig(TARGET, dpi=110, metadata={"Software": None})
    print(f"wrote {TARGET}")
