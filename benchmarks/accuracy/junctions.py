"""Cases where three or four arms of a curve meet in a point: maps, drawings, cracks."""

from __future__ import annotations

import numpy as np

from .outline import Array, Rng, bent
from .sampling import Samples, even


def tee(rng: Rng) -> Samples:
    """A straight bar and an arm at 60 to 120° to it."""
    return _arms(rng, np.radians([0, 180, rng.uniform(60, 120)]))


def cross(rng: Rng) -> Samples:
    """Two bars that cross at 45 to 90°."""
    tilt = rng.uniform(45, 90)
    return _arms(rng, np.radians([0, tilt, 180, 180 + tilt]))


def wye(rng: Rng) -> Samples:
    """Three arms, 90 to 150° apart."""
    return _arms(rng, np.radians([0, rng.uniform(105, 130), rng.uniform(230, 255)]))


def _arms(rng: Rng, angles: Array) -> Samples:
    """Return arms from a common point, of 6 to 20 steps each, slightly bent, with little noise."""
    step = 1.0
    points, edges = [np.zeros((1, 2))], []
    for angle in angles + rng.uniform(0, 2 * np.pi):
        steps = int(rng.integers(6, 21))
        tip = steps * step * np.array([[0.0, 0.0], [np.cos(angle), np.sin(angle)]])
        arm = even(bent(tip, rng.uniform(-0.05, 0.05, 1), False), steps, rng).points[1:]
        rows = np.arange(len(arm)) + sum(map(len, points))
        edges.append(np.stack([np.concatenate([[0], rows[:-1]]), rows], axis=1))
        points.append(arm)
    moved = np.concatenate(points) + 0.05 * step * rng.normal(size=(sum(map(len, points)), 2))
    return Samples(moved, np.concatenate(edges), step)
