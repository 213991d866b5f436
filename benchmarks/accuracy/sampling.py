"""Samples of known curves, with their order, and what happens to real ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from .outline import Array, Outline, Rng

Edges = NDArray[np.int64]


@dataclass(frozen=True)
class Samples:
    """Points, the edges between those adjacent along their curve, and the usual step."""

    points: Array
    edges: Edges
    step: float


def along(outline: Outline) -> Array:
    """Return the arc length at each point of an outline, and at its end."""
    points = outline.points
    if outline.closed:
        points = np.concatenate([points, points[:1]])
    return np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def length(outline: Outline) -> float:
    """Return the length of an outline."""
    return float(along(outline)[-1])


def at(outline: Outline, places: Array) -> Array:
    """Return the points at places, arc lengths, of an outline."""
    s = along(outline)
    points = outline.points
    if outline.closed:
        places = places % s[-1]
        points = np.concatenate([points, points[:1]])
    return np.stack([np.interp(places, s, points[:, k]) for k in (0, 1)], axis=1)


def even(
    outline: Outline, count: int, rng: Rng, *, jitter: float = 0.0, at_corners: bool = True
) -> Samples:
    """Return about `count` samples at equal steps, each moved along by up to `jitter` steps."""
    total = length(outline)
    step = total / count
    marks = along(outline)[list(outline.corners)] if at_corners else np.empty(0)
    if not outline.closed:
        marks = np.concatenate([[0], marks, [total]])
    elif not len(marks):
        marks = np.array([rng.uniform(0, step)])
    ends = np.append(marks[1:], marks[0] + total) if outline.closed else marks[1:]
    places = []
    for start, end in zip(marks, ends, strict=False):
        steps = max(1, round((end - start) / step))
        inner = np.arange(1, steps) + rng.uniform(-jitter, jitter, steps - 1)
        places.append(start + (end - start) / steps * np.concatenate([[0], inner]))
    if not outline.closed:
        places.append(marks[-1:])
    return placed(outline, np.concatenate(places), step)


def graded(outline: Outline, count: int, rng: Rng, ratio: float) -> Samples:
    """Return about `count` samples whose density varies smoothly by this ratio."""
    s = np.linspace(0, 1, 20_000)
    waves = int(rng.integers(1, 3))
    phase = rng.uniform(0, 2 * np.pi)
    density = np.exp(np.log(ratio) / 2 * np.cos(2 * np.pi * waves * s + phase))
    amount = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2)])
    amount *= count / amount[-1]
    steps = np.arange(count) + (0.5 if outline.closed else 0.0)
    places = np.interp(steps, amount, s) * length(outline)
    return placed(outline, places, length(outline) / count)


def adapted(outline: Outline, r: float, rng: Rng) -> Samples:
    """Return an r-sample of an outline, as sparse as one goes along it: about its sparsest."""
    total = length(outline)
    s = np.linspace(0, total, 1500, endpoint=not outline.closed)
    size = np.maximum(feature_size(at(outline, s), outline.closed), 0.004 * total)
    start = rng.uniform(0, s[20]) if outline.closed else 0.0
    steps = np.linspace(0, total, 3000)
    places = [start]
    while True:
        # From the place in the middle of a step both of its ends are equally far.
        middle = np.interp((places[-1] + steps / 2) % total, s, size)
        step = steps[np.argmax(steps / 2 > r * middle)]
        if step == 0 or places[-1] + step >= start + total:
            break
        places.append(places[-1] + step)
    if outline.closed and start + total - places[-1] < 0.3 * (places[-1] - places[-2]):
        places.pop()
    return placed(outline, np.array(places), float(np.median(np.diff(places))))


def feature_size(fine: Array, closed: bool) -> Array:
    """Return the distance from each point of a fine polyline to its medial axis."""
    ahead = np.roll(fine, -1, axis=0) - np.roll(fine, 1, axis=0)
    if not closed:
        ahead[0], ahead[-1] = fine[1] - fine[0], fine[-1] - fine[-2]
    left = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) / np.hypot(*ahead.T)[:, None]
    centers = [_centers(fine, normal) for normal in (left, -left)]
    return np.asarray(KDTree(np.concatenate(centers)).query(fine)[0])


def _centers(fine: Array, normal: Array) -> Array:
    """Return the centers of the largest empty disks that touch a polyline on one side."""
    centers = []
    for k in range(len(fine)):
        other = np.delete(fine, slice(max(0, k - 3), k + 4), axis=0) - fine[k]
        across = other @ normal[k]
        radius = (other**2).sum(1)[across > 0] / (2 * across[across > 0])
        if len(radius):
            centers.append(fine[k] + radius.min() * normal[k])
    return np.reshape(centers, (-1, 2))


def placed(outline: Outline, places: Array, step: float) -> Samples:
    """Return the samples at ascending places of an outline."""
    return Samples(at(outline, places), chain(len(places), outline.closed), step)


def chain(count: int, closed: bool) -> Edges:
    """Return the edges between successive rows, and from the last to the first."""
    ends = np.arange(count)
    edges = np.stack([ends, np.roll(ends, -1)], axis=1)
    return edges if closed and count > 2 else edges[:-1]


def joined(parts: list[Samples]) -> Samples:
    """Return several curves' samples as one."""
    starts = np.cumsum([0, *(len(part.points) for part in parts[:-1])])
    return Samples(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.edges + start for part, start in zip(parts, starts, strict=True)]),
        float(np.median([part.step for part in parts])),
    )


def thinned(samples: Samples, share: float, rng: Rng, closed: bool) -> Samples:
    """Return samples without a random share of them; their neighbors are adjacent then."""
    kept = np.flatnonzero(rng.random(len(samples.points)) >= share)
    points = samples.points[kept]
    return Samples(points, chain(len(points), closed), samples.step / (1 - share))


def noisy(samples: Samples, sigma: float, rng: Rng) -> Samples:
    """Return samples moved in each coordinate by a normal of `sigma` usual steps."""
    moved = samples.points + sigma * samples.step * rng.normal(size=samples.points.shape)
    return Samples(moved, samples.edges, samples.step)


def with_outliers(samples: Samples, share: float, rng: Rng, apart: float = 2.0) -> Samples:
    """Return samples and outliers around, this share of all points, none nearer than some steps."""
    points = samples.points
    count = round(len(points) * share / (1 - share))
    low, high = points.min(0), points.max(0)
    margin = 0.1 * (high - low).max()
    lone: list[Array] = []
    for _ in range(200 * count):
        if len(lone) == count:
            break
        place = rng.uniform(low - margin, high + margin)
        if np.hypot(*(points - place).T).min() > apart * samples.step:
            lone.append(place)
    return Samples(np.concatenate([points, np.reshape(lone, (-1, 2))]), samples.edges, samples.step)
