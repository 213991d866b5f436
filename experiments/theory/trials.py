"""How often each method finds a curve exactly, and what certificates say about it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from multiprocessing import Pool
from typing import Any

import numpy as np
import numpy.typing as npt

import crustline as cl
from crustline import shapes
from experiments.theory.curves import families

Rows = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

METHODS: dict[str, Callable[..., Any]] = {
    "crust": cl.crust,
    "β = 1.7": cl.beta_skeleton,
    "β = 1.25": partial(cl.beta_skeleton, beta=1.25),
    "β = 1.3": partial(cl.beta_skeleton, beta=1.3),
    "one-step crust": cl.one_step_crust,
    "NN-crust": cl.nn_crust,
    "Gabriel": cl.gabriel,
    "relative neighborhood": cl.relative_neighborhood,
    "RCGH": cl.rcgh,
}
#: The methods with a theorem, whose edges `certify` can guarantee.
PROVEN = ("crust", "β = 1.7")
#: Reasons of a certificate that say that edges are not just rings through all points.
OPEN = ("isolated", "endpoint", "branch")
MODES = ("sparsest", "random")
RATIOS = (0.2, 0.25, 0.3, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0)
STARTS = 4
PROCESSES = 2


@dataclass(frozen=True, eq=False)
class Trials:
    """What came of samples of the curves: axes are curve, mode, r, start (and method)."""

    exact: Flags
    missing: npt.NDArray[np.int64]
    extra: npt.NDArray[np.int64]
    guaranteed: Flags
    ratio: Rows
    rings: Flags
    ratios: tuple[float, ...]


def trials(every: int, ratios: tuple[float, ...], starts: int) -> Trials:
    """Sample every n-th curve in both modes at all r, and reconstruct it."""
    names = [(name, k) for name, family in families().items() for k in range(len(family))]
    with Pool(PROCESSES) as pool:
        rows = pool.map(partial(_tried, ratios=ratios, starts=starts), names[::every], chunksize=1)
    columns: list[Any] = [np.array(column) for column in zip(*rows, strict=True)]
    exact, missing, extra, guaranteed, ratio, rings = columns
    return Trials(exact, missing, extra, guaranteed, ratio, rings, ratios)


def _tried(name: tuple[str, int], ratios: tuple[float, ...], starts: int) -> list[Any]:
    family, k = name
    curve = families()[family][k]
    outcomes = [
        [[_outcome(curve, mode, r, seed) for seed in range(starts)] for r in ratios]
        for mode in MODES
    ]
    columns = range(len(outcomes[0][0][0]))
    return [[[[cell[c] for cell in row] for row in mode] for mode in outcomes] for c in columns]


def _outcome(curve: shapes.SmoothCurve, mode: Any, r: float, seed: int) -> tuple[list[Any], ...]:
    sample = cl.r_sample(curve, r, seed=seed, mode=mode)
    delaunay = cl.Delaunay(sample.points)
    true = {*map(tuple, sample.edges.tolist())}
    found = {name: method(delaunay) for name, method in METHODS.items()}
    sets = [{*map(tuple, edges.tolist())} for edges in found.values()]
    missing = [len(true - edges) for edges in sets]
    extra = [len(edges - true) for edges in sets]
    exact = [not m and not e for m, e in zip(missing, extra, strict=True)]
    certificates = [cl.certify(delaunay, found[name]) for name in PROVEN]
    return (
        exact,
        missing,
        extra,
        [c.guaranteed for c in certificates],
        [c.sampling_ratio for c in certificates],
        [not np.isin(c.point_reason, OPEN).any() for c in certificates],
    )


def interval(hits: Flags) -> tuple[float, float]:
    """Return Wilson's 95 % interval for a share, from hits of shape (curves, starts).

    Starts on one curve are not independent: the number of trials is divided by the design effect
    that the spread between curves shows; where all trials agree, only curves are counted.
    """
    curves, starts = hits.shape
    share, effect = hits.mean(), float(starts)
    if 0 < share < 1 and starts > 1:
        between = hits.mean(axis=1).var(ddof=1)
        effect = float(np.clip(starts * between / (share * (1 - share)), 1.0, starts))
    n, z = curves * starts / effect, 1.959964
    middle = (share + z * z / (2 * n)) / (1 + z * z / n)
    half = z * math.sqrt(share * (1 - share) / n + z * z / (4 * n * n)) / (1 + z * z / n)
    return max(0.0, middle - half), min(1.0, middle + half)
