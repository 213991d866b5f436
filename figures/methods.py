"""Redraw the picture of docs/methods.md: every method on the same four sets of points.

python -m figures.methods

Writes docs/methods.png. Rows are methods, columns the sets: a dense curve, corners, gaps and
outliers, noise.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

import crustline as cl
from crustline.arrays import FloatArray
from crustline.shapes import trefoil

TARGET = Path(__file__).parent.parent / "docs" / "methods.png"
NEEDED: dict[str, dict[str, Any]] = {
    "gamma-graph": {"c0": 0.5, "c1": 0.25},
    "crossing-angle-graph": {"angle": 1.7},
    "alpha-shape": {"radius": 0.25},
}
#: It needs a second set of points.
LEFT_OUT = {"a-shape"}


def sets() -> dict[str, FloatArray]:
    """Return the four sets of points."""
    rng = np.random.default_rng(7)
    dense = cl.r_sample(trefoil(3, 0.4), 0.25, seed=1).points
    angle = np.arange(10) * np.pi / 5
    radius = np.where(np.arange(10) % 2, 0.55, 1.3)[:, None]
    tips = radius * np.column_stack((np.cos(angle), np.sin(angle)))
    steps = np.linspace(0, 1, 6, endpoint=False)[None, :, None]
    star = (tips[:, None] * (1 - steps) + np.roll(tips, -1, axis=0)[:, None] * steps).reshape(-1, 2)
    around = np.delete(np.linspace(0, 2 * np.pi, 60, endpoint=False), np.r_[8:12, 30:33])
    gaps = np.column_stack((1.3 * np.cos(around), np.sin(around) * (1 + 0.2 * np.cos(around))))
    gaps = np.vstack((gaps, rng.uniform(-1.3, 1.3, (8, 2))))
    turn = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    noise = np.column_stack((1.2 * np.cos(turn), np.sin(turn))) + rng.normal(0, 0.07, (120, 2))
    return {"dense": dense, "corners": star, "gaps and outliers": gaps, "noise": noise}


def draw() -> Figure:
    """Draw all methods, and `denoise`, on the four sets."""
    names = [name for name in cl.METHODS if name not in LEFT_OUT]
    figure, axes = plt.subplots(len(names) + 1, 4, figsize=(8, 2 * (len(names) + 1)))
    for column, (title, points) in enumerate(sets().items()):
        delaunay = cl.Delaunay(points)
        axes[0, column].set_title(title, fontsize=9)
        for ax, name in zip(axes[:, column], names, strict=False):
            edges = cl.METHODS[name](delaunay, **NEEDED.get(name, {}))
            _lines(ax, points, points[edges], name if not column else "")
        curves = cl.denoise(points).curves
        edges = np.vstack([_steps(curve.indices, curve.closed) for curve in curves])
        _lines(axes[-1, column], points, curves.points.xy[edges], "denoise" if not column else "")
    figure.tight_layout(pad=0.3)
    return figure


def _steps(indices: np.ndarray, closed: bool) -> np.ndarray:
    steps = np.column_stack((indices, np.roll(indices, -1)))
    return steps if closed else steps[:-1]


def _lines(ax: Any, points: FloatArray, segments: FloatArray, label: str) -> None:
    ax.add_collection(LineCollection(list(segments), colors="C0", linewidths=1))
    ax.plot(*points.T, "k.", markersize=2)
    ax.set_aspect("equal")
    ax.xaxis.set_major_locator(NullLocator())
    ax.yaxis.set_major_locator(NullLocator())
    ax.set_ylabel(label, fontsize=8)


if __name__ == "__main__":
    draw().savefig(TARGET, dpi=75, metadata={"Software": None})
