"""Known curves as fine polylines: what the generated cases are sampled from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Rng = np.random.Generator

#: Points of a fine polyline between two corners.
FINE = 400


@dataclass(frozen=True)
class Outline:
    """A curve as a fine polyline; a closed one does not repeat its first point.

    `corners` are rows of points where the curve turns abruptly; samples may be placed there.
    """

    points: Array
    closed: bool
    corners: tuple[int, ...] = ()

    def moved(self, scale: float, angle: float, offset: tuple[float, float]) -> Outline:
        """Return the curve scaled, turned by an angle in radians, and moved, in this order."""
        c, s = np.cos(angle), np.sin(angle)
        points = scale * self.points @ np.array([[c, s], [-s, c]]) + offset
        return Outline(points, self.closed, self.corners)


def polygon(vertices: Array, closed: bool = True) -> Outline:
    """Return straight sides between vertices, all of which are corners."""
    return bent(vertices, np.zeros(len(vertices)), closed)


def bent(vertices: Array, bulges: Array, closed: bool = True) -> Outline:
    """Return sides between corners, each bent into a parabola of this height over its length."""
    ends = np.roll(vertices, -1, axis=0) if closed else vertices[1:]
    t = np.linspace(0, 1, FINE, endpoint=False)[:, None]
    sides = []
    for a, b, bulge in zip(vertices, ends, bulges, strict=False):
        normal = np.array([a[1] - b[1], b[0] - a[0]])
        sides.append(a + t * (b - a) + 4 * bulge * t * (1 - t) * normal)
    points = np.concatenate(sides if closed else [*sides, vertices[-1:]])
    corners = range(0, FINE * len(sides), FINE) if closed else range(FINE, FINE * len(sides), FINE)
    return Outline(points, closed, tuple(corners))


def smooth(vertices: Array, closed: bool = True, sharp: NDArray[np.bool_] | None = None) -> Outline:
    """Return a curve through vertices, smooth but at those that are sharp (Catmull and Rom)."""
    count = len(vertices)
    sharp = np.zeros(count, bool) if sharp is None else sharp
    at = np.arange(count if closed else count - 1)
    before, after, later = at - 1, at + 1, at + 2
    if closed:
        before, after, later = (k % count for k in (before, after, later))
    else:
        before, later = np.maximum(before, 0), np.minimum(later, count - 1)
    a, b = vertices[at], vertices[after]
    leave = np.where(sharp[at, None], b - a, (b - vertices[before]) / 2)
    enter = np.where(sharp[after, None], b - a, (vertices[later] - a) / 2)
    t = np.linspace(0, 1, FINE, endpoint=False)[None, :, None]
    hermite = (
        a[:, None] * (1 + 2 * t) * (1 - t) ** 2
        + b[:, None] * t**2 * (3 - 2 * t)
        + leave[:, None] * t * (1 - t) ** 2
        + enter[:, None] * t**2 * (t - 1)
    )
    points = hermite.reshape(-1, 2)
    if not closed:
        points = np.concatenate([points, vertices[-1:]])
    corners = [v for v in at.tolist() if sharp[v] and (closed or v > 0)]
    return Outline(points, closed, tuple(v * FINE for v in corners))


def arc(degrees: float, radius: float = 1.0) -> Outline:
    """Return an arc of a circle; 360 degrees are the whole circle."""
    closed = degrees >= 360
    angle = np.radians(np.linspace(0, min(degrees, 360), 8 * FINE, endpoint=not closed))
    return Outline(radius * np.stack([np.cos(angle), np.sin(angle)], axis=1), closed)


def blob(rng: Rng, wobble: float = 0.3) -> Outline:
    """Return a smooth closed curve around the origin: a radius of a few random waves."""
    angle = np.linspace(0, 2 * np.pi, 8 * FINE, endpoint=False)
    radius = np.ones_like(angle)
    for k in range(2, rng.integers(3, 7)):
        radius += wobble / k * rng.normal() * np.cos(k * angle + rng.uniform(0, 2 * np.pi))
    radius = np.maximum(radius, 0.3)
    return Outline(radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1), True)


def drawing(rng: Rng, sharpness: float, closed: bool = True) -> Outline:
    """Return an outline as one draws it: vertices around a center, some of them sharp.

    An open one goes around by 120 to 220°, so that its ends are far apart.
    """
    count = int(rng.integers(5, 13))
    span = 2 * np.pi if closed else np.radians(rng.uniform(120, 220))
    angle = (np.arange(count) + rng.uniform(-0.3, 0.3, count)) * span / count
    radius = rng.uniform(0.35, 1, count)
    vertices = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    sharp = rng.random(count) < sharpness
    return smooth(vertices, closed, sharp)


def wave(rng: Rng) -> Outline:
    """Return an open wave from left to right."""
    x = np.linspace(-1, 1, 8 * FINE)
    y = rng.uniform(0.05, 0.3) * np.sin(rng.uniform(2, 7) * x + rng.uniform(0, 6))
    return Outline(np.stack([x, y], axis=1), False)


def spiral(turns: float) -> Outline:
    """Return a spiral of Archimedes; its windings are 1 / turns apart."""
    t = np.linspace(0.15, 1, 16 * FINE)
    angle = 2 * np.pi * turns * t
    return Outline(t[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1), False)


def airfoil(x: Array, thickness: float) -> Array:
    """Return half the thickness of a profile of four digits (NACA) at places from nose to tail."""
    series = 0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4
    return 5 * thickness * series
