"""Families of generated cases: parameters drawn uniformly over the ranges that are written here.

The cases of a half are the same whenever they are made: the seed is of the half and the number.
Constants are tuned on the half "tuned"; "unseen" is looked at as seldom as the page says.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import junctions
from .outline import (
    Outline,
    Rng,
    airfoil,
    arc,
    bent,
    blob,
    drawing,
    polygon,
    spiral,
    wave,
)
from .sampling import (
    Edges,
    Samples,
    adapted,
    chain,
    even,
    graded,
    joined,
    length,
    noisy,
    placed,
    thinned,
    with_outliers,
)

Family = Callable[[Rng], Samples]


@dataclass(frozen=True)
class Case:
    """Points whose curve is known: the edges between samples adjacent along it."""

    name: str
    group: str
    points: np.ndarray
    edges: Edges


def corner(rng: Rng) -> Samples:
    """A corner of 20 to 150° between two legs, straight or bent outward."""
    angle = np.radians(rng.uniform(20, 150)) / 2
    tips = np.array([[np.cos(angle), np.sin(angle)], [0, 0], [np.cos(angle), -np.sin(angle)]])
    bulges = -rng.uniform(0, 0.15, 2) * rng.integers(0, 2)
    return even(bent(tips, bulges, False), int(rng.integers(10, 60)), rng)


def star(rng: Rng) -> Samples:
    """A star of 4 to 12 tips of 20 to 100°, 3 to 12 steps a side."""
    tips = int(rng.integers(4, 13))
    half = np.radians(rng.uniform(20, 100)) / 2
    turn = np.pi / tips
    # The inner radius at which the tips have their angle; 0.9 keeps inner corners corners.
    inner = min(np.sin(half) / np.sin(half + turn), 0.9 * np.cos(turn))
    angle = np.arange(2 * tips) * turn
    radius = np.where(np.arange(2 * tips) % 2, inner, 1.0)
    vertices = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return even(polygon(vertices), 2 * tips * int(rng.integers(3, 13)), rng)


def teeth(rng: Rng) -> Samples:
    """A bar with 3 to 12 saw teeth of 30 to 120°, 2 to 8 steps a flank."""
    count, steps = int(rng.integers(3, 13)), int(rng.integers(2, 9))
    height = 0.5 / np.tan(np.radians(rng.uniform(30, 120)) / 2)
    x = np.arange(2 * count + 1) / 2
    y = np.where(np.arange(2 * count + 1) % 2, height, 0.0)
    body = [[count, -1.0 - height], [0, -1.0 - height]]
    outline = polygon(np.concatenate([np.stack([x, y], axis=1), body]))
    return even(outline, round(length(outline) / np.hypot(0.5, height) * steps), rng)


def wedge(rng: Rng) -> Samples:
    """A closed wedge of 10 to 40° with 20 to 100 points."""
    angle = np.radians(rng.uniform(10, 40)) / 2
    tips = np.array([[0, 0], [np.cos(angle), -np.sin(angle)], [np.cos(angle), np.sin(angle)]])
    return even(polygon(tips), int(rng.integers(20, 100)), rng)


def profile(rng: Rng) -> Samples:
    """A profile 6 to 25 % thick, 10 to 40 points a side, closer at both ends."""
    side = int(rng.integers(10, 41))
    row = np.arange(2 * side)
    x = (1 + np.cos(np.pi * row / side)) / 2
    y = airfoil(x, rng.uniform(0.06, 0.25))
    points = np.stack([x, np.where(row < side, y, -y)], axis=1)
    return Samples(points, chain(2 * side, True), 1 / side)


def nested(rng: Rng) -> Samples:
    """2 to 4 blobs in each other, 1.5 to 5 steps apart."""
    outline, step = blob(rng, 0.2), rng.uniform(0.05, 0.15)
    gap = rng.uniform(1.5, 5) * step
    scale, parts = 1.0, []
    for _ in range(rng.integers(2, 5)):
        ring = outline.moved(scale, 0, (0, 0))
        parts.append(even(ring, max(8, round(length(ring) / step)), rng))
        scale -= gap / np.hypot(*outline.points.T).min()
        if scale < 0.25:
            break
    return joined(parts)


def tangent(rng: Rng) -> Samples:
    """2 to 5 circles in a row, next to each other at 1 to 3 steps."""
    step, x, parts = rng.uniform(0.1, 0.3), 0.0, []
    gap = rng.uniform(1, 3) * step
    for _ in range(rng.integers(2, 6)):
        radius = rng.uniform(0.5, 1.5)
        ring = arc(360, radius).moved(1, rng.uniform(0, 6), (x + radius, 0))
        parts.append(even(ring, round(length(ring) / step), rng))
        x += 2 * radius + gap
    return joined(parts)


def mix(rng: Rng) -> Samples:
    """2 to 6 open and closed curves beside each other in cells, 10 to 60 points each."""
    parts = []
    for k in rng.permutation(9)[: rng.integers(2, 7)].tolist():
        kinds = [arc(360), arc(rng.uniform(90, 240)), wave(rng), blob(rng), spiral(2.0)]
        kind = int(rng.integers(len(kinds)))
        outline = kinds[kind].moved(0.8, rng.uniform(0, 6), (2.2 * (k % 3), 2.2 * (k // 3)))
        parts.append(even(outline, int(rng.integers(40 if kind == 4 else 12, 60)), rng))
    return joined(parts)


def open_arc(rng: Rng) -> Samples:
    """An arc of 180 to 330° with 60 to 200 points."""
    return even(arc(rng.uniform(180, 330)), int(rng.integers(60, 200)), rng)


def dashes(rng: Rng) -> Samples:
    """An open line or arc in dashes of 5 to 15 points, 3 to 8 steps apart.

    In a closed one the dashes are not in the points: it is dense enough to be sure to be a ring.
    """
    outline = wave(rng) if rng.random() < 0.5 else arc(rng.uniform(120, 270))
    step = length(outline) / int(rng.integers(60, 250))
    dash, gap = int(rng.integers(5, 16)), rng.uniform(3, 8)
    count = int(length(outline) / step / (dash - 1 + gap))
    starts = step * (dash - 1 + gap) * np.arange(max(count, 1))
    return joined([placed(outline, start + step * np.arange(dash), step) for start in starts])


def outliers(rng: Rng) -> Samples:
    """A blob or drawing of 60 to 200 points; 0 to 30 % of all points are outliers."""
    return _among_outliers(rng, rng.uniform(0, 0.3))


def many_outliers(rng: Rng) -> Samples:
    """The same with 30 to 50 % outliers."""
    return _among_outliers(rng, rng.uniform(0.3, 0.5))


def _among_outliers(rng: Rng, share: float) -> Samples:
    outline = blob(rng) if rng.random() < 0.5 else drawing(rng, 0.3)
    return with_outliers(even(outline, int(rng.integers(60, 200)), rng, jitter=0.1), share, rng)


def several_outliers(rng: Rng) -> Samples:
    """The same, with 2 to 30 % outliers, beside 1 to 3 rings and lines of 0.08 to 0.8 its size."""
    outlines = [blob(rng) if rng.random() < 0.5 else drawing(rng, 0.3)]
    step = length(outlines[0]) / int(rng.integers(60, 200))
    for k in range(1, int(rng.integers(2, 5))):
        outline = blob(rng) if rng.random() < 0.5 else drawing(rng, 0.3, bool(rng.random() < 0.7))
        place = (2.6 * k, rng.uniform(-1, 1))
        outlines.append(outline.moved(rng.uniform(0.08, 0.8), rng.uniform(0, 6), place))
    counts = [max(8, round(length(one) / step / rng.uniform(0.5, 1.5))) for one in outlines]
    parts = [even(one, count, rng, jitter=0.1) for one, count in zip(outlines, counts, strict=True)]
    return with_outliers(joined(parts), rng.uniform(0.02, 0.3), rng)


def jitter(rng: Rng) -> Samples:
    """A blob or drawing of 40 to 200 points, moved along by up to 0 to 30 % of the step."""
    outline = blob(rng) if rng.random() < 0.5 else drawing(rng, 0.3)
    return even(outline, int(rng.integers(40, 200)), rng, jitter=rng.uniform(0, 0.3))


def noise(rng: Rng) -> Samples:
    """A blob of 40 to 200 points with normal noise of 0 to 0.15 steps."""
    return noisy(even(blob(rng), int(rng.integers(40, 200)), rng), rng.uniform(0, 0.15), rng)


def much_noise(rng: Rng) -> Samples:
    """The same with noise of 0.15 to 1 step."""
    return noisy(even(blob(rng), int(rng.integers(40, 200)), rng), rng.uniform(0.15, 1), rng)


def density(rng: Rng) -> Samples:
    """A blob or wave of 100 to 400 points whose density varies up to 100-fold."""
    outline = blob(rng) if rng.random() < 0.7 else wave(rng)
    return graded(outline, int(rng.integers(100, 400)), rng, 100 ** rng.uniform(0, 1))


def strands(rng: Rng) -> Samples:
    """Two parallel strands, 1 to 4 steps apart if they are closed, 2 to 4 if they are open."""
    outline = wave(rng) if rng.random() < 0.5 else blob(rng, 0.15)
    step = length(outline) / int(rng.integers(40, 160))
    apart = rng.uniform(1 if outline.closed else 2, 4) * step
    ahead = np.roll(outline.points, -1, axis=0) - np.roll(outline.points, 1, axis=0)
    if not outline.closed:
        ahead[0], ahead[-1] = ahead[1], ahead[-2]
    normal = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1) / np.hypot(*ahead.T)[:, None]
    other = Outline(outline.points + apart * normal, outline.closed)
    return joined([even(one, round(length(one) / step), rng) for one in (outline, other)])


def drawn(rng: Rng) -> Samples:
    """1 to 3 outlines with corners, as one draws them: uneven steps, 50 to 200 points each."""
    parts = []
    for k in range(rng.integers(1, 4)):
        outline = drawing(rng, rng.uniform(0.2, 1)).moved(1, 0, (2.4 * k, 0))
        parts.append(even(outline, int(rng.integers(50, 200)), rng, jitter=rng.uniform(0, 0.4)))
    return joined(parts)


def vector(rng: Rng) -> Samples:
    """A drawing, sampled by its feature size at r = 0.3 to 0.6, open or closed."""
    outline = drawing(rng, 0.0, closed=bool(rng.random() < 0.6))
    return adapted(outline, rng.uniform(0.3, 0.6), rng)


def vector_jitter(rng: Rng) -> Samples:
    """A drawing with steps of 0.5 to 1.5 of the usual, 60 to 300 points."""
    outline = drawing(rng, rng.uniform(0, 0.4), closed=bool(rng.random() < 0.6))
    count = int(rng.integers(60, 300))
    steps = rng.uniform(0.5, 1.5, count)
    places = np.cumsum(steps) / steps.sum() * length(outline)
    if not outline.closed:
        places = np.concatenate([[0], places])
    return placed(outline, places, length(outline) / count)


def removal(rng: Rng) -> Samples:
    """A drawing of 120 to 400 even points of which 30 to 60 % are removed at random."""
    outline = drawing(rng, rng.uniform(0, 0.3), closed=bool(rng.random() < 0.6))
    full = even(outline, int(rng.integers(120, 400)), rng)
    return thinned(full, rng.uniform(0.3, 0.6), rng, outline.closed)


def vector_noise(rng: Rng) -> Samples:
    """A drawing of 60 to 300 points with normal noise of 0.05 to 0.15 steps."""
    full = even(drawing(rng, rng.uniform(0, 0.3)), int(rng.integers(60, 300)), rng, jitter=0.2)
    return noisy(full, rng.uniform(0.05, 0.15), rng)


def vector_outliers(rng: Rng) -> Samples:
    """A drawing of 60 to 300 points with 10 % outliers, three steps away or more."""
    full = even(drawing(rng, rng.uniform(0, 0.3)), int(rng.integers(60, 300)), rng, jitter=0.3)
    return with_outliers(full, 0.1, rng, apart=3.0)


FAMILIES: dict[str, Family] = {
    "corner": corner,
    "star": star,
    "teeth": teeth,
    "wedge": wedge,
    "profile": profile,
    "nested": nested,
    "tangent": tangent,
    "mix": mix,
    "arc": open_arc,
    "dashes": dashes,
    "outliers to 30 %": outliers,
    "outliers, several curves": several_outliers,
    "jitter": jitter,
    "noise to 0.15": noise,
    "density": density,
    "strands": strands,
    "drawn": drawn,
    "vector": vector,
    "vector, jitter": vector_jitter,
    "vector, removal": removal,
    "vector, noise": vector_noise,
    "vector, outliers": vector_outliers,
    "outliers 30 to 50 %": many_outliers,
    "noise 0.15 to 1": much_noise,
}

#: Families that only `junctions=True` can get right.
JUNCTIONS: dict[str, Family] = {"T": junctions.tee, "X": junctions.cross, "Y": junctions.wye}

#: Families that are reported, and promised no more than that they are not below the crust.
HARD = ("outliers 30 to 50 %", "noise 0.15 to 1", *JUNCTIONS)

#: The seed of each half. What was looked at and led to a change is unseen no more: its seed is
#: never used again, and "unseen" gets the next one.
SEEDS = {"tuned": 0, "unseen": 5}

HALVES = tuple(SEEDS)


def cases(half: str, each: int, families: dict[str, Family] | None = None) -> list[Case]:
    """Return `each` cases of every family, of one half; rows in random order."""
    made = []
    for family, make in (FAMILIES | JUNCTIONS if families is None else families).items():
        for number in range(each):
            key = [SEEDS[half], number, *family.encode()]
            rng = np.random.default_rng(key)
            made.append(_shuffled(f"{family} {number}", family, make(rng), rng))
    return made


def _shuffled(name: str, group: str, samples: Samples, rng: Rng) -> Case:
    order = rng.permutation(len(samples.points))
    row = np.empty_like(order)
    row[order] = np.arange(len(order))
    edges = np.unique(np.sort(row[samples.edges], axis=1), axis=0)
    return Case(name, group, samples.points[order], edges)
