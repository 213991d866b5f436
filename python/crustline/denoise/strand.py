"""Strands: the parts of a ridge, each a curve with the rows that belong to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray, in_parts
from crustline.curves import trace
from crustline.delaunay import Delaunay
from crustline.denoise.ends import joined
from crustline.denoise.mixture import pair
from crustline.denoise.polygon import Feet, Polygon
from crustline.denoise.smoother import Fit, fit

#: Points of a ridge, and rows, that a strand has at least, but where nothing has moved.
CRESTS, ROWS = 4, 8
#: Deviations of the noise from the curve beyond which a row is an outlier.
FAR = 4.0
#: Deviations of the noise that a strand is long at least.
LONG = 6.0
#: Noise over the spacing that is none to speak of.
CLEAN = 0.03
#: Nodes in a window of the ridge, and on a strand at least.
NODES, FEWEST = 2, 24


@dataclass(frozen=True, eq=False)
class Strand:
    """A curve, and the rows that it stands for."""

    vertices: FloatArray
    closed: bool
    uncertainty: FloatArray
    rows: IntArray
    owners: IntArray
    """The vertex of each of the rows."""
    noise: FloatArray
    """The deviation of the noise at each of the rows."""
    unchanged: bool

    @property
    def edges(self) -> IntArray:
        """The edges between successive vertices."""
        count = len(self.vertices)
        first = np.arange(count if self.closed else count - 1)
        return np.column_stack((first, (first + 1) % count))

    def of_rows(self, rows: IntArray) -> Strand:
        """Return it for points of which the present ones are the `rows`."""
        return replace(self, rows=rows[self.rows])


@dataclass(frozen=True, eq=False)
class _Ridge:
    """What the core knows of each row and of each point of the ridge."""

    noise: FloatArray
    width: FloatArray
    """The windows: with little noise about twice the spacing."""
    rows: IntArray
    """The row that each point of the ridge comes from."""
    at: FloatArray
    still: BoolArray
    """Whether a point of the ridge is where it was."""
    known: bool
    """Whether the noise was given."""


def strands(
    delaunay: Delaunay, noise: FloatArray | None, method: Callable[..., ArrayLike]
) -> list[Strand]:
    """Return the strands of the ridge of points, whose noise is estimated or known."""
    ridge = _ridge(delaunay, noise)
    if len(ridge.at) < 2:
        return []
    curves = trace(ridge.at, method(delaunay.alike(ridge.at)))
    bounds = zip(curves.offsets[:-1], curves.offsets[1:], curves.closed, strict=True)
    parts = [(curves.indices[a:b], bool(closed)) for a, b, closed in bounds]
    still = [part for part in parts if ridge.still[part[0]].all()]
    moved = [p for p in parts if len(p[0]) >= CRESTS and not ridge.still[p[0]].all()]
    parts = still + joined(moved, ridge.at, ridge.width[ridge.rows])
    if not parts:
        return []
    starts = [_start(ridge, *part) for part in parts]
    owner = _owners(delaunay.points.xy, starts, ridge)
    made = []
    for number, ((crests, _), start) in enumerate(zip(parts, starts, strict=True)):
        made += _strands(delaunay.points.xy, ridge, crests, start, np.flatnonzero(owner == number))
    return made


def _ridge(delaunay: Delaunay, known: FloatArray | None) -> _Ridge:
    first_rows, noise, first, vertices, at = _core.ridge(delaunay._core, known, *delaunay._how)
    count = len(delaunay)
    by_row = np.full((2, count), np.nan)
    by_row[:, first_rows] = noise, np.maximum(first, 1.5 * np.nan_to_num(noise))
    for row, same in delaunay.duplicates:
        by_row[:, row] = by_row[:, same]
    rows = first_rows[vertices]
    still = (delaunay.points.xy[rows] == at).all(axis=1)
    return _Ridge(by_row[0], by_row[1], rows, at, still, known is not None)


def _start(ridge: _Ridge, crests: IntArray, closed: bool) -> Polygon:
    """Return the strand as evenly spaced nodes, several in a window."""
    path = Polygon(ridge.at[crests], closed)
    spacing = np.nanmedian(ridge.width[ridge.rows[crests]]) / NODES
    count = int(np.clip(path.length / spacing, FEWEST, 20 * len(ridge.noise) + FEWEST))
    return path.resampled(count, smooth=False)


def _owners(points: FloatArray, starts: list[Polygon], ridge: _Ridge) -> IntArray:
    """Return the number of the nearest strand of each row, -1 for rows far from all."""
    from scipy.spatial import cKDTree

    numbers = np.repeat(np.arange(len(starts)), [len(start) for start in starts])
    tree = cKDTree(np.vstack([start.nodes for start in starts]))
    reach = (FAR + 2) * np.nan_to_num(ridge.noise) + ridge.width
    owners = np.empty(len(points), np.int64)
    for part in in_parts(len(points)):
        distance, node = tree.query(points[part])
        owners[part] = np.where(distance <= reach[part], numbers[node], -1)
    return owners


def _strands(
    points: FloatArray, ridge: _Ridge, crests: IntArray, start: Polygon, rows: IntArray
) -> list[Strand]:
    """Return the strands along a part of the ridge: none, one, or two near each other."""
    # In the order of the coordinates, so that sums do not depend on that of the rows.
    rows = rows[np.lexsort((ridge.noise[rows], *points[rows].T))]
    noise = np.nan_to_num(ridge.noise[rows], nan=float(np.nanmedian(ridge.noise)))
    spacing = start.length / max(len(rows), 1)
    noise = np.maximum(noise, 1e-3 * spacing)
    is_still = bool(ridge.still[crests].all())
    if is_still and (len(rows) < ROWS or np.median(ridge.noise[rows]) < 2 * CLEAN * spacing):
        return [_kept(points, ridge, crests, start.closed)]
    if len(rows) < ROWS or start.length < LONG * np.median(noise):
        return []
    fitted = fit(points[rows], noise, start)
    if np.median(noise) * fitted.deviation < CLEAN * spacing:
        if is_still:
            return [_kept(points, ridge, crests, start.closed)]
        return [_ordered(points, rows, fitted, noise)]
    # Estimates feel both strands, so they tell nothing of either.
    alike = noise if ridge.known else np.full(len(noise), np.median(noise))
    two = pair(points[rows], alike, fitted.polygon)
    return [_new(points, rows[own], each, alike[own]) for own, each in two] or [
        _new(points, rows, fitted, noise)
    ]


def _kept(points: FloatArray, ridge: _Ridge, crests: IntArray, closed: bool) -> Strand:
    """Return the strand of points that have not moved."""
    rows = ridge.rows[crests]
    zero = np.zeros(len(rows))
    return Strand(points[rows], closed, zero, rows, np.arange(len(rows)), ridge.noise[rows], True)


def _ordered(points: FloatArray, rows: IntArray, fitted: Fit, noise: FloatArray) -> Strand:
    """Return the strand through the points themselves, in their order along the curve."""
    _, first = np.unique(points[rows], axis=0, return_index=True)
    along = fitted.polygon.feet(points[rows[first]]).along
    order = first[np.argsort(along, kind="stable")]
    chosen, own = rows[order], fitted.deviation * noise[order]
    zero, owners = np.zeros(len(chosen)), np.arange(len(chosen))
    return Strand(points[chosen], fitted.polygon.closed, zero, chosen, owners, own, True)


def _new(points: FloatArray, rows: IntArray, fitted: Fit, noise: FloatArray) -> Strand:
    """Return the strand through new vertices, without outliers and cut where the points end."""
    polygon, noise = fitted.polygon, fitted.deviation * noise
    feet = polygon.feet(points[rows])
    near = np.abs(feet.offset) <= FAR * noise
    first, last = (0, len(polygon)) if polygon.closed else _ends(polygon, feet, noise, near)
    owners = np.rint(feet.along).astype(int)
    owners = owners % len(polygon) if polygon.closed else owners.clip(first, last - 1) - first
    return Strand(
        polygon.nodes[first:last],
        polygon.closed,
        fitted.uncertainty[first:last],
        rows[near],
        owners[near],
        noise[near],
        False,
    )


def _ends(polygon: Polygon, feet: Feet, noise: FloatArray, near: BoolArray) -> tuple[int, int]:
    """Return the range of nodes of an open curve between which the points' density says it lies.

    A few deviations inside, the density is not touched by the noise at the end; as many points as
    lie outside of that place have room for so much length at this density.
    """
    steps, along = len(polygon) - 1, feet.along[near]
    step = polygon.length / steps
    inset = min(3.0 * float(np.median(noise)) / step, steps / 4)
    middle = (along > inset) & (along < steps - inset)
    density = middle.sum() / max(steps - 2 * inset, 1e-9)
    if not density:
        return 0, steps + 1
    low = inset - (along <= inset).sum() / density
    high = steps - inset + (along >= steps - inset).sum() / density
    first = int(np.clip(round(low), 0, steps // 4))
    last = int(np.clip(round(high), steps - steps // 4, steps))
    return first, last + 1
