"""The medial axis of a smooth curve, traced by its empty disks, and the distance to it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray, as_points
from crustline.errors import InputError
from crustline.shapes.contacts import contact_grid, refined
from crustline.shapes.curve import SmoothCurve, refuse_extent
from crustline.shapes.nodes import Nodes

# Where contacts no farther apart than this share of the radii have centers far apart, the axis
# between the centers lies along the normal that they share.
SAME_CONTACT = 1e-6


@dataclass(frozen=True, eq=False)
class CurveMedialAxis:
    """The medial axis of a smooth curve, as far as its local feature size depends on it.

    Attributes
    ----------
    vertices : ndarray of float64, shape (v, 2)
        Points of the axis: centers of maximal empty disks.
    radii : ndarray of float64, shape (v,)
        The radii of those disks.
    segments : ndarray of int64, shape (s, 2)
        Rows of `vertices` that follow one another along the axis. The axis between them is near the
        segment.
    error : float
        Bound for the relative error of a distance from the curve to the vertices and segments; 0 if
        the axis is known in closed form.

    Notes
    -----
    Parts of the axis whose disks are larger than half the extent of the curve are left
    out: no point of the curve has its nearest point of the axis there. An interior disk gives each
    point a nearer one.
    """

    vertices: FloatArray
    radii: FloatArray
    segments: IntArray
    error: float

    @cached_property
    def _tree(self) -> _core.Tree:
        alone = np.delete(np.arange(len(self.vertices)), self.segments.ravel())
        first, last = np.concatenate([self.segments, np.stack([alone, alone], -1)]).T
        return _core.Tree(self.vertices[first], self.vertices[last])

    def distance(self, points: npt.ArrayLike) -> FloatArray:
        """Return the distance from each of points (k, 2) to the axis, shape (k,)."""
        return self._tree.distances(as_points(points))


@lru_cache(maxsize=128)
def medial_axis(curve: SmoothCurve, rtol: float) -> CurveMedialAxis:
    """Return the medial axis of a smooth curve: see `SmoothCurve.medial_axis`."""
    _refuse_extremes(curve)
    if len(curve.loops) == 1 and curve.loops[0].axis is not None:
        return _known_axis(curve, curve.loops[0].axis)
    return _linked(_traced(*contact_grid(curve), math.sqrt(8 * rtol)), rtol)


def _refuse_extremes(curve: SmoothCurve) -> None:
    u = np.arange(256) / 256
    for part in curve.components:
        with np.errstate(all="ignore"):
            points = part.point(u)
        finite = np.isfinite(points).all(axis=1)
        if not finite.all():
            raise InputError(
                f"a loop's point at u = {u[np.argmin(finite)]:g} is not finite: correct the loop"
            )
        refuse_extent(points)


def _known_axis(curve: SmoothCurve, ends: FloatArray) -> CurveMedialAxis:
    places = curve.point(np.arange(4096) / 4096)
    radii = _core.Tree(places, places).distances(ends)
    rows = np.arange(len(ends))
    return CurveMedialAxis(ends, radii, np.stack([rows[:-1], rows[1:]], -1), 0.0)


def _traced(grid: Nodes, disks: FloatArray, gap: float) -> tuple[Nodes, FloatArray]:
    """Return nodes and curvatures (2, k) of their disks, centers at most gap radii apart."""

    def are_far_apart(nodes: Nodes, disks: FloatArray) -> BoolArray:
        left, right = (_far_apart(nodes, disks[k], sign, gap) for k, sign in ((0, 1), (1, -1)))
        return left | right

    return refined(grid, disks, are_far_apart)


def _far_apart(nodes: Nodes, disks: FloatArray, side: int, gap: float) -> BoolArray:
    """Return whether the axis between a center and the following one needs a vertex."""
    center, radius = _centers(nodes, disks, side)
    step = np.hypot(*(center[nodes.following] - center).T)
    least = np.minimum(radius, radius[nodes.following])
    apart = np.hypot(*(nodes.point[nodes.following] - nodes.point).T) > SAME_CONTACT * least
    one = np.isfinite(radius) ^ np.isfinite(radius[nodes.following])
    both = np.isfinite(radius + radius[nodes.following])
    # A disk beyond half the extent matters to no point, so where the axis runs off its end may stay
    # rough.
    wide = both & apart & (step > gap * least)
    return np.asarray(wide | (one & (least < 0.6 * nodes.extent)))


def _centers(nodes: Nodes, disks: FloatArray, side: int) -> tuple[FloatArray, FloatArray]:
    """Return centers on one side and radii, infinite where a disk is too large to matter."""
    matters = disks * nodes.extent > 1
    radius = np.where(matters, 1 / np.where(matters, disks, 1.0), np.inf)
    reach = np.where(matters, side * radius, 0.0)
    return nodes.point + reach[:, None] * nodes.normal, radius


def _linked(traced: tuple[Nodes, FloatArray], rtol: float) -> CurveMedialAxis:
    """Return the axis with one vertex for each disk, linked along the curve."""
    nodes, disks = traced
    vertices, radii, segments, count = [], [], [], 0
    for side, curvature in zip((1, -1), disks, strict=True):
        center, radius = _centers(nodes, curvature, side)
        kept = np.isfinite(radius)
        row = count + np.cumsum(kept) - 1
        linked = kept & kept[nodes.following]
        segments.append(np.stack([row[linked], row[nodes.following[linked]]], -1))
        vertices.append(center[kept])
        radii.append(radius[kept])
        count += int(kept.sum())
    joined = np.concatenate(vertices), np.concatenate(radii), np.concatenate(segments)
    return CurveMedialAxis(*joined, error=rtol)
