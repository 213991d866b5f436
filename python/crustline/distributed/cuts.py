"""Cutting the plane into boxes with about equally many points each: a k-d tree.

A box is half-open: a point on a cut is in the upper part. So equal points are in one box.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, IntArray

_LEAF = -1


@dataclass(frozen=True)
class Cuts:
    """A k-d tree whose leaves are numbered from left to right.

    Attributes
    ----------
    axis : ndarray of int64
        For each node, parents first: 0 to cut x, 1 to cut y, -1 for a leaf.
    at : ndarray of float64
        The coordinate of the cut; smaller ones are in the first child.
    child : ndarray of int64
        The first child, the other is next to it; of a leaf its number.
    """

    axis: IntArray
    at: FloatArray
    child: IntArray

    @property
    def leaves(self) -> int:
        """The number of leaves."""
        return int(np.count_nonzero(self.axis == _LEAF))

    def leaf_of(self, xy: FloatArray) -> IntArray:
        """Return the leaf of each point."""
        leaf = np.empty(len(xy), np.int64)
        parts = [(0, np.arange(len(xy)))]
        while parts:
            node, rows = parts.pop()
            if self.axis[node] == _LEAF:
                leaf[rows] = self.child[node]
                continue
            upper = xy[rows, self.axis[node]] >= self.at[node]
            first = int(self.child[node])
            parts += [(first, rows[~upper]), (first + 1, rows[upper])]
        return leaf

    def grafted(self, leaf: int, other: Cuts) -> Cuts:
        """Return the tree with another one in place of a leaf."""
        node = int(np.flatnonzero((self.axis == _LEAF) & (self.child == leaf))[0])
        size = len(self.axis)
        # The root of the other takes the leaf's place, its other nodes come last.
        moved = np.where(other.axis == _LEAF, _LEAF, other.child + size - 1)
        axis = np.concatenate([self.axis, other.axis[1:]])
        at = np.concatenate([self.at, other.at[1:]])
        child = np.concatenate([self.child, moved[1:]])
        axis[node], at[node], child[node] = other.axis[0], other.at[0], moved[0]
        _number_leaves(axis, child)
        return Cuts(axis, at, child)

    def arrays(self) -> dict[str, Any]:
        """Return the tree as named arrays."""
        return {"axis": self.axis, "at": self.at, "child": self.child}


def cut(sample: FloatArray, weights: FloatArray, most: int) -> Cuts:
    """Return boxes that hold about `most` points each or fewer.

    Parameters
    ----------
    sample : ndarray of float64, shape (s, 2)
        Some of the points.
    weights : ndarray of float64, shape (s,)
        How many points each of them stands for.
    most : int
        The wanted number of points in a box.
    """
    axes, ats, children = [_LEAF], [0.0], [_LEAF]
    open_nodes = [(0, np.arange(len(sample)))]
    while open_nodes:
        node, rows = open_nodes.pop()
        found = _cut_of(sample[rows], weights[rows], most)
        if found is None:
            continue
        axis, at = found
        axes[node], ats[node], children[node] = axis, at, len(axes)
        upper = sample[rows, axis] >= at
        open_nodes += [(len(axes), rows[~upper]), (len(axes) + 1, rows[upper])]
        axes += [_LEAF, _LEAF]
        ats += [0.0, 0.0]
        children += [_LEAF, _LEAF]
    child = np.array(children)
    _number_leaves(np.array(axes), child)
    return Cuts(np.array(axes), np.array(ats), child)


def _cut_of(sample: FloatArray, weights: FloatArray, most: int) -> tuple[int, float] | None:
    """Return the axis and the place of a cut, or None where there need or can be none."""
    boxes = int(np.ceil(weights.sum() / most))
    if boxes < 2:
        return None
    extents = sample.max(axis=0) - sample.min(axis=0)
    for axis in (int(np.argmax(extents)), 1 - int(np.argmax(extents))):
        values = sample[:, axis]
        order = np.argsort(values, kind="stable")
        shares = np.cumsum(weights[order])
        at = values[order[np.searchsorted(shares, shares[-1] * (boxes // 2) / boxes)]]
        larger = values[values > values.min()]
        if len(larger):
            return axis, float(max(at, larger.min()))
    return None


def _number_leaves(axis: IntArray, child: IntArray) -> None:
    stack, number = [0], 0
    while stack:
        node = stack.pop()
        if axis[node] == _LEAF:
            child[node] = number
            number += 1
        else:
            stack += [int(child[node]) + 1, int(child[node])]
