"""Points that have no curve: clouds, lattices, filled disks. No edge of an answer is right."""

from __future__ import annotations

import numpy as np

from .families import Case
from .outline import Array

NONE = np.empty((0, 2), np.int64)


def shapeless(seed: int) -> list[Case]:
    """Return sets of points that no curve was sampled from."""
    rng = np.random.default_rng([7, seed])
    made: dict[str, Array] = {}
    for count in (50, 200, 1000):
        made[f"cloud of {count}"] = rng.random((count, 2))
        made[f"normal cloud of {count}"] = rng.normal(size=(count, 2))
        radius, angle = np.sqrt(rng.random(count)), 2 * np.pi * rng.random(count)
        made[f"disk of {count}"] = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
    for side in (6, 15, 30):
        made[f"lattice of {side}²"] = lattice(side)
        made[f"hexagons of {side}²"] = lattice(side) @ [[1, 0], [0.5, np.sqrt(0.75)]]
        made[f"uneven lattice of {side}²"] = lattice(side) + 0.05 * rng.normal(size=(side**2, 2))
        made[f"filled disk, {side} across"] = disk(side)
    return [Case(name, name.split(" of ")[0], points, NONE) for name, points in made.items()]


def lattice(side: int) -> Array:
    """Return a square lattice."""
    return np.stack(np.meshgrid(*[np.arange(side)] * 2), -1).reshape(-1, 2).astype(float)


def disk(across: int) -> Array:
    """Return the points of a lattice in a disk."""
    points = lattice(across + 1) - across / 2
    inside: Array = points[np.hypot(*points.T) <= across / 2]
    return inside
