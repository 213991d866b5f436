"""Families of noisy cases, and how right curves near them are: topology, and distance from truth.

Noise is normal, the same in both coordinates, and so many usual steps wide. Parameters are drawn
uniformly over the ranges that are written here, from a seed that is the half, the noise and the
number, as for `families`. A family is told the noise in steps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

import crustline as cl

from .families import SEEDS
from .outline import Array, Outline, Rng, arc, blob, drawing, wave
from .sampling import at, even, length

#: Noise in usual steps.
NOISE = (0.25, 0.5, 1.0, 2.0)
#: Places on a curve at which distances are taken.
PLACES = 2000
#: The share of a true curve that one found curve must cover, and within how many deviations
#: or steps.
COVERED, WITHIN = 0.9, 4.0


@dataclass(frozen=True)
class Scene:
    """Curves, and points near them without noise; the noise at each, relative."""

    outlines: tuple[Outline, ...]
    points: Array
    step: float
    noise: Array


@dataclass(frozen=True)
class NoisyCase:
    """Noisy points of known curves."""

    group: str
    name: str
    outlines: tuple[Outline, ...]
    points: Array
    step: float
    noise: float
    """The deviation, the mean one where it varies."""


@dataclass(frozen=True)
class NoisyScore:
    """An answer beside the truth."""

    case: NoisyCase
    found: cl.Denoised
    kept: bool
    """Whether there is one curve for each true one, a ring for a ring, and no other."""
    rms: float
    """The distance of the found curves from the true ones over the noise."""


def scene(
    outlines: list[Outline], counts: list[int], rng: Rng, noise: Callable[[int], Array] = np.ones
) -> Scene:
    """Return the curves with samples whose steps vary by up to 30 % either way."""
    parts = [
        even(each, count, rng, jitter=0.3, at_corners=False)
        for each, count in zip(outlines, counts, strict=True)
    ]
    points = np.concatenate([part.points for part in parts])
    step = sum(map(length, outlines)) / sum(counts)
    return Scene(
        tuple(outlines), points, step, np.concatenate([noise(len(p.points)) for p in parts])
    )


def ring(rng: Rng, _: float) -> Scene:
    """A blob of 60 to 300 points."""
    return scene([blob(rng)], [int(rng.integers(60, 300))], rng)


def line(rng: Rng, _: float) -> Scene:
    """A wave, an arc of 90 to 240°, or an open drawing, of 60 to 300 points."""
    kinds = [wave(rng), arc(rng.uniform(90, 240)), drawing(rng, 0.0, closed=False)]
    return scene([kinds[int(rng.integers(3))]], [int(rng.integers(60, 300))], rng)


def components(rng: Rng, _: float) -> Scene:
    """2 to 5 rings and lines beside each other in cells, 60 to 150 points each."""
    outlines, counts = [], []
    for k in rng.permutation(9)[: rng.integers(2, 6)].tolist():
        kinds = [arc(360), arc(rng.uniform(90, 240)), wave(rng), blob(rng)]
        outline = kinds[int(rng.integers(4))].moved(
            0.8, rng.uniform(0, 6), (2.6 * (k % 3), 2.6 * (k // 3))
        )
        outlines.append(outline)
        counts.append(max(20, round(length(outline) / 5 * rng.uniform(0.9, 1.1) * 120)))
    return scene(outlines, counts, rng)


def corners(rng: Rng, _: float) -> Scene:
    """A closed drawing of 100 to 300 points, half of its vertices sharp."""
    return scene([drawing(rng, 0.5)], [int(rng.integers(100, 300))], rng)


def random(rng: Rng, _: float) -> Scene:
    """A blob of 100 to 400 points at random places: the gaps between them vary without bound."""
    outline, count = blob(rng), int(rng.integers(100, 400))
    points = at(outline, np.sort(rng.uniform(0, length(outline), count)))
    return Scene((outline,), points, length(outline) / count, np.ones(count))


def varying(rng: Rng, _: float) -> Scene:
    """A blob of 150 to 400 points whose noise varies fourfold along it."""
    turn = rng.uniform(0, 2 * np.pi)

    def noise(count: int) -> Array:
        return np.asarray(1 + 0.6 * np.cos(turn + 2 * np.pi * np.arange(count) / count))

    return scene([blob(rng)], [int(rng.integers(150, 400))], rng, noise)


def strands(rng: Rng, noise: float) -> Scene:
    """Two nested blobs, or two waves, 3 to 6 deviations apart, of 100 to 300 points each."""
    outline = wave(rng) if rng.random() < 0.5 else blob(rng, 0.15)
    count = int(rng.integers(100, 300))
    apart = rng.uniform(3, 6) * noise * length(outline) / count
    ahead = np.roll(outline.points, -1, axis=0) - np.roll(outline.points, 1, axis=0)
    if not outline.closed:
        ahead[0], ahead[-1] = ahead[1], ahead[-2]
    normal = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1) / np.hypot(*ahead.T)[:, None]
    other = Outline(outline.points + apart * normal, outline.closed)
    return scene([outline, other], [count, round(count * length(other) / length(outline))], rng)


def passes(rng: Rng, _: float) -> Scene:
    """2 to 5 passes of 100 to 200 points over an open drawing or wave; the step is that of all."""
    outline = drawing(rng, 0.0, closed=False) if rng.random() < 0.5 else wave(rng)
    count = int(rng.integers(2, 6))
    each = [even(outline, int(rng.integers(100, 200)), rng, jitter=0.3) for _ in range(count)]
    points = np.concatenate([part.points for part in each])
    return Scene((outline,), points, length(outline) / len(points), np.ones(len(points)))


NOISY: dict[str, Callable[[Rng, float], Scene]] = {
    "ring": ring,
    "line": line,
    "components": components,
    "corners": corners,
    "random steps": random,
    "varying noise": varying,
    "passes": passes,
    "strands": strands,
}


def noisy_cases(half: str, each: int, noise: float) -> Iterator[NoisyCase]:
    """Yield `each` cases of every family, of one half, with one noise; rows in random order."""
    for family, make in NOISY.items():
        for number in range(each):
            key = [SEEDS[half], number, round(100 * noise), *f"noisy {family}".encode()]
            rng = np.random.default_rng(key)
            made = make(rng, noise)
            deviation = noise * made.step
            moved = made.points + deviation * made.noise[:, None] * rng.normal(
                size=made.points.shape
            )
            name = f"{family} {number}"
            yield NoisyCase(
                family, name, made.outlines, rng.permutation(moved), made.step, deviation
            )


def noisy_score(case: NoisyCase) -> NoisyScore:
    """Return how right `denoise` is."""
    found = cl.denoise(case.points)
    paths = outlines(found.curves)
    truth, answer = [places(each) for each in case.outlines], [places(each) for each in paths]
    if not answer:
        return NoisyScore(case, found, False, float("nan"))
    distance = np.asarray(KDTree(np.concatenate(truth)).query(np.concatenate(answer))[0])
    kept = len(paths) == len(truth) and _match(case, paths, truth, answer)
    return NoisyScore(case, found, kept, float(np.sqrt((distance**2).mean()) / case.noise))


def places(outline: Outline, count: int = PLACES) -> Array:
    """Return evenly spaced places of a curve."""
    return at(outline, np.linspace(0, length(outline), count))


def outlines(curves: cl.Curves) -> list[Outline]:
    """Return curves as outlines."""
    return [Outline(curves.points.xy[each.indices], each.closed) for each in curves]


def _match(case: NoisyCase, paths: list[Outline], truth: list[Array], answer: list[Array]) -> bool:
    """Whether each true curve is covered by a found one of its kind, each by another."""
    near = WITHIN * max(case.noise, case.step)
    taken = set()
    for outline, fine in zip(case.outlines, truth, strict=True):
        gaps = [np.asarray(KDTree(own).query(fine)[0]) for own in answer]
        # The nearest: within `near`, which may be wider than strands are apart, all cover it.
        best = int(np.argmin([gap.mean() for gap in gaps]))
        if (gaps[best] <= near).mean() < COVERED or paths[best].closed != outline.closed:
            return False
        taken.add(best)
    return len(taken) == len(truth)
