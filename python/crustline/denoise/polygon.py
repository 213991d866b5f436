"""Polygons as evenly spaced nodes: resampling them, their normals, and feet of points on them."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray, in_parts


@dataclass(frozen=True, eq=False)
class Polygon:
    """Nodes along a curve, nearly evenly spaced; a ring does not repeat its first node."""

    nodes: FloatArray
    closed: bool

    def __len__(self) -> int:
        return len(self.nodes)

    @property
    def path(self) -> FloatArray:
        """The nodes, of a ring with the first one repeated."""
        return np.vstack((self.nodes, self.nodes[:1])) if self.closed else self.nodes

    @property
    def length(self) -> float:
        """The length of the path."""
        return float(np.hypot(*np.diff(self.path, axis=0).T).sum())

    @property
    def normals(self) -> FloatArray:
        """Unit vectors to the left at the nodes, shape (m, 2)."""
        path = self.path
        if self.closed:
            across = np.roll(self.nodes, -1, axis=0) - np.roll(self.nodes, 1, axis=0)
        else:
            across = np.gradient(path, axis=0)
        x, y = across.T / np.maximum(np.hypot(*across.T), np.finfo(float).tiny)
        return np.column_stack((-y, x))

    def resampled(self, count: int, smooth: bool = True) -> Polygon:
        """Return `count` nodes evenly spaced along it, on a cubic spline or on the path itself."""
        from scipy.interpolate import CubicSpline

        path = self.path
        steps = np.hypot(*np.diff(path, axis=0).T)
        path = path[np.concatenate(([True], steps > 1e-9 * steps.sum()))]
        if self.closed:
            path[-1] = path[0]
        t = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))))
        at = np.linspace(0, t[-1], count + self.closed)[:count]
        if smooth and len(path) > 4:
            ends: Literal["periodic", "natural"] = "periodic" if self.closed else "natural"
            return Polygon(np.asarray(CubicSpline(t, path, bc_type=ends)(at), float), self.closed)
        return Polygon(np.column_stack([np.interp(at, t, x) for x in path.T]), self.closed)

    def feet(self, points: FloatArray) -> Feet:
        """Return the nearest places of the polygon, near its nearest nodes."""
        from scipy.spatial import cKDTree

        tree = cKDTree(self.nodes)
        made = [
            self._feet(points[part], np.asarray(tree.query(points[part])[1], np.int64))
            for part in in_parts(len(points))
        ]
        return Feet(*(np.concatenate([vars(feet)[f.name] for feet in made]) for f in fields(Feet)))

    def _feet(self, points: FloatArray, nearest: IntArray) -> Feet:
        path, last = self.path, len(self.path) - 2
        before = (nearest - 1) % len(self) if self.closed else np.clip(nearest - 1, 0, last)
        after = nearest if self.closed else np.clip(nearest, 0, last)
        one, other = (_feet_on(points, path, edge) for edge in (before, after))
        is_nearer = np.abs(other.offset) < np.abs(one.offset)
        pick = [
            np.where(is_nearer, getattr(other, name), getattr(one, name))
            for name in ("edge", "share", "offset")
        ]
        at_end = (pick[1] < 0) & (pick[0] == 0) | (pick[1] > 1) & (pick[0] == last)
        return Feet(pick[0], pick[1].clip(0, 1), pick[2], at_end & (not self.closed))


@dataclass(frozen=True, eq=False)
class Feet:
    """Where points are nearest to a polygon."""

    edge: IntArray
    share: FloatArray
    """How far along the edge, from 0 to 1."""
    offset: FloatArray
    """The distance, positive to the left."""
    beyond: BoolArray
    """Whether the point is beyond an open end."""

    @property
    def along(self) -> FloatArray:
        """The place in steps from the first node."""
        return self.edge + self.share


def _feet_on(points: FloatArray, path: FloatArray, edge: IntArray) -> Feet:
    start, step = path[edge], path[edge + 1] - path[edge]
    share = ((points - start) * step).sum(axis=1) / (step**2).sum(axis=1)
    gap = points - start - share.clip(0, 1)[:, None] * step
    side = np.sign(step[:, 0] * gap[:, 1] - step[:, 1] * gap[:, 0])
    offset = np.where(side < 0, -1.0, 1.0) * np.hypot(*gap.T)
    return Feet(edge, share, offset, np.zeros(len(points), bool))
