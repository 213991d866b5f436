"""A building that is known, and clouds of points as a scanner sees it."""

from __future__ import annotations

import numpy as np

#: The outside of the walls, with a corner that turns in, and the walls of a courtyard, in meters.
OUTSIDE = np.array([(0, 0), (12, 0), (12, 5), (7, 5), (7, 9), (0, 9)], float)
COURT = np.array([(2, 2), (2, 5), (5, 5), (5, 2)], float)
HEIGHT = 6.0


def walls(*rings):
    """The ends of all walls, (k, 2, 2)."""
    return np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])


def scan(n=200_000, noise=0.008, seed=0, origin=(0.0, 0.0, 0.0)):
    """Points of the walls, (m, 3): noisy, dense near the scanners, and none behind a tree."""
    rng = np.random.default_rng(seed)
    ends = walls(OUTSIDE, COURT)
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    density = lengths * (1 + np.arange(len(ends)) % 4)
    wall = rng.choice(len(ends), n, p=density / density.sum())
    along = rng.random(n) ** 1.2
    xy = ends[wall, 0] + (ends[wall, 1] - ends[wall, 0]) * along[:, None]
    xyz = np.column_stack([xy, rng.uniform(0, HEIGHT, n)]) + rng.normal(0, noise, (n, 3))
    behind_a_tree = (np.abs(xyz[:, 0] - 3) < 0.4) & (xyz[:, 1] < 1)
    return xyz[~behind_a_tree] + origin


def distance_to_walls(xy, *rings):
    """How far places are from the nearest wall."""
    a, b = np.moveaxis(walls(*(rings or (OUTSIDE, COURT))), 1, 0)
    step = b - a
    share = np.einsum("nkd,kd->nk", xy[:, None] - a, step) / (step**2).sum(axis=1)
    foot = a + np.clip(share, 0, 1)[..., None] * step
    return np.linalg.norm(xy[:, None] - foot, axis=2).min(axis=1)


def along_walls(*rings, step=0.05):
    """Places on all walls."""
    return np.concatenate(
        [a + (b - a) * np.arange(0, 1, step / np.hypot(*(b - a)))[:, None]
         for a, b in walls(*(rings or (OUTSIDE, COURT)))]
    )  # fmt: skip
