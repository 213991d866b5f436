"""Places along a smooth curve, as many as are needed, and whether their polygon crosses itself."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.errors import InputError
from crustline.shapes.curve import SmoothCurve, bend, turned, unit


@dataclass(frozen=True, eq=False)
class Nodes:
    """Points along the curve, loop after loop, in the order of u."""

    curve: SmoothCurve
    loop: IntArray
    u: FloatArray
    point: FloatArray
    normal: FloatArray
    curvature: FloatArray
    following: IntArray  # the row of the next node along the loop

    def __len__(self) -> int:
        return len(self.u)

    @cached_property
    def preceding(self) -> IntArray:
        """The row of the node before."""
        preceding = np.empty_like(self.following)
        preceding[self.following] = np.arange(len(self))
        return preceding

    @cached_property
    def steps(self) -> FloatArray:
        """How far on in u the following node is."""
        step = self.u[self.following] - self.u
        return np.where(step > 0, step, step + 1)

    def points_near(self, rows: IntArray, offsets: FloatArray) -> FloatArray:
        """Return the points at the u of nodes (k,) plus offsets (k, m), shape (k, m, 2)."""
        return self._near(rows, offsets)[0].reshape(*offsets.shape, 2)

    def curvatures_near(self, rows: IntArray, offsets: FloatArray) -> FloatArray:
        """Return the curvatures at the u of nodes (k,) plus offsets (k, m), shape (k, m)."""
        _, d1, d2 = self._near(rows, offsets)
        return bend(d1, d2).reshape(offsets.shape)

    def _near(self, rows: IntArray, offsets: FloatArray) -> tuple[FloatArray, ...]:
        loop = np.repeat(self.loop[rows], offsets.shape[1])
        return self.curve._on_loops(loop, (self.u[rows, None] + offsets).ravel())

    @cached_property
    def extent(self) -> float:
        """The diagonal of the bounding box."""
        return float(np.hypot(*np.ptp(self.point, axis=0)))

    @cached_property
    def grain(self) -> float:
        """The square of a distance, times a curvature, at which rounding spoils circles."""
        return max(4e-9 * self.extent, 8e-12 * float(np.abs(self.point).max()))

    def joined(self, loop: IntArray, u: FloatArray) -> tuple[Nodes, IntArray]:
        """Return these and more nodes, and the rows of the more among them."""
        loop, u = np.concatenate([self.loop, loop]), np.concatenate([self.u, u])
        order = np.lexsort((u, loop))
        # A place that is there already adds nothing.
        new = np.append(True, (np.diff(loop[order]) > 0) | (np.diff(u[order]) > 0))
        nodes = nodes_at(self.curve, loop[order][new], u[order][new])
        return nodes, np.flatnonzero(order[new] >= len(self))

    def halved(self, rows: IntArray) -> tuple[Nodes, IntArray]:
        """Return these nodes and the middles between some and those that follow."""
        return self.joined(self.loop[rows], self.u[rows] + self.steps[rows] / 2)


def nodes_at(curve: SmoothCurve, loop: IntArray, u: FloatArray) -> Nodes:
    """Return the nodes at places that are sorted by loop and u, all loops having some."""
    point, d1, d2 = curve._on_loops(loop, u)
    following = np.arange(1, len(u) + 1)
    last = np.flatnonzero(np.append(loop[1:] != loop[:-1], True))
    following[last] = np.concatenate([[0], last[:-1] + 1])
    return Nodes(curve, loop, u, point, turned(unit(d1)), bend(d1, d2), following)


# --- Crossings ----------------------------------------------------------------------------------


def refuse_crossings(nodes: Nodes) -> None:
    """Refuse a curve whose polygon of nodes crosses itself."""
    a, b = nodes.point, nodes.point[nodes.following]
    i, j = _near_segments(np.minimum(a, b), np.maximum(a, b))
    # A segment does not cross itself, the one that follows it or the one before it.
    apart = (i != j) & (nodes.following[i] != j) & (nodes.following[j] != i)
    i, j = i[apart], j[apart]
    across = (_side(a[i], b[i], a[j]) > 0) != (_side(a[i], b[i], b[j]) > 0)
    across &= (_side(a[j], b[j], a[i]) > 0) != (_side(a[j], b[j], b[i]) > 0)
    if across.any():
        p = a[i[int(np.argmax(across))]]
        raise InputError(
            f"the curve crosses or touches itself near ({p[0]:g}, {p[1]:g}): "
            "a smooth curve has no crossings, so its local feature size is not defined there"
        )


def _near_segments(low: FloatArray, high: FloatArray) -> tuple[IntArray, IntArray]:
    """Return the pairs i ≤ j of boxes that meet, found by halving boxes of boxes that do."""
    levels = [(low, high)]
    while len(low) > 1:
        starts = np.arange(0, len(low), 2)
        low, high = np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)
        levels.append((low, high))
    i = j = np.zeros(1, dtype=np.int64)
    for low, high in reversed(levels[:-1]):
        i = np.concatenate([2 * i, 2 * i, 2 * i + 1, 2 * i + 1])
        j = np.concatenate([2 * j, 2 * j + 1, 2 * j, 2 * j + 1])
        kept = (i <= j) & (i < len(low)) & (j < len(low))
        i, j = i[kept], j[kept]
        meet = ((low[i] <= high[j]) & (low[j] <= high[i])).all(axis=1)
        i, j = i[meet], j[meet]
    return i, j


def _side(p: FloatArray, q: FloatArray, x: FloatArray) -> FloatArray:
    d, e = q - p, x - p
    return np.asarray(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
