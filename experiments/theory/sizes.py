"""The local feature size from samples against the curve's own."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

import crustline as cl
from experiments.theory.curves import measured_curves
from experiments.theory.table import table
from experiments.theory.trials import STARTS

Rows = npt.NDArray[np.float64]

#: r for the orders of convergence.
HALVED = (0.5, 0.25, 0.125, 0.0625)
SIZED = (0.5, 0.25, 0.2, 0.125, 0.0625)


def feature_size_errors(name: str) -> list[Rows]:
    """Return relative errors of the local feature size estimated from samples, per r."""
    curve = measured_curves()[name]
    errors = []
    for r in SIZED:
        per_start = []
        for seed in range(STARTS):
            sample = cl.r_sample(curve, r, seed=seed)
            true = curve.local_feature_size(sample.t)
            per_start.append(cl.local_feature_size(sample.points, sample.edges) / true - 1)
        errors.append(np.concatenate(per_start))
    return errors


def feature_size_table(errors: dict[str, list[Rows]]) -> str:
    """Return median and worst errors per r, and the orders of convergence."""
    rows = []
    for name, per_r in errors.items():
        size = np.array([(np.median(np.abs(e)), np.abs(e).max()) for e in per_r])
        cells = [f"{_error(m)} / {_error(w)}" for m, w in size]
        halved = size[[SIZED.index(r) for r in HALVED]]
        rows.append([name, *cells, order(halved[:, 0]), order(halved[:, 1])])
    head = [f"r = {r:g}" for r in SIZED]
    return table(["median / worst, %", *head, "order, median", "order, worst"], rows)


def _error(share: float) -> str:
    return f"{100 * share:.2g}" if share > 1e-6 else "0"


def order(errors: Rows) -> str:
    """Return the slope of errors on the logarithm of r over the last halving."""
    if errors[-1] < 1e-9 or errors[-2] < 1e-9:
        return "exact"
    return f"{math.log2(errors[-2] / errors[-1]):.1f}"
