"""Endless fields of points, of which any square cell can be made by itself."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from crustline.arrays import FloatArray

#: Points in a cell of side 1.
IN_CELL = 500

Field = Callable[[np.random.Generator], FloatArray]


def rings(random: np.random.Generator) -> FloatArray:
    """Return a closed curve with lobes, evenly sampled but for a tenth of the step."""
    turn = 2 * np.pi / IN_CELL
    angle = (np.arange(IN_CELL) + 0.1 * random.uniform(-1, 1, IN_CELL)) * turn
    phase, lobes = random.random() * 2 * np.pi, random.integers(2, 6)
    radius = 0.3 * (1 + 0.25 * np.sin(lobes * angle + phase))
    points: FloatArray = 0.5 + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return points


def uniform(random: np.random.Generator) -> FloatArray:
    """Return points anywhere."""
    return random.random((IN_CELL, 2))


def noisy(random: np.random.Generator) -> FloatArray:
    """Return a closed curve whose points are off by their spacing."""
    return rings(random) + random.normal(0, 0.004, (IN_CELL, 2))


def open_arcs(random: np.random.Generator) -> FloatArray:
    """Return a third of a ring, and one point far from it."""
    points = rings(random)[: IN_CELL // 3]
    return np.concatenate([points, random.random((1, 2))])


FIELDS: dict[str, Field] = {
    "closed curves": rings,
    "uniform": uniform,
    "noise as large as the spacing": noisy,
    "open arcs, single points": open_arcs,
}


def cells(field: Field, low: tuple[int, int], side: int) -> list[FloatArray]:
    """Return the points of each cell of a square block; a cell is the same in every block."""
    return [
        field(np.random.default_rng([x, y])) + np.array([x, y])
        for x in range(low[0], low[0] + side)
        for y in range(low[1], low[1] + side)
    ]
