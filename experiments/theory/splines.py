"""Splines and polygons through samples against the curve."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import crustline as cl
from crustline import shapes
from experiments.theory.curves import measured_curves
from experiments.theory.sizes import HALVED, order
from experiments.theory.table import table
from experiments.theory.trials import STARTS

Rows = npt.NDArray[np.float64]


def smooth_errors(name: str) -> Rows:
    """Return the largest distance of polygon and of spline from the curve, per r: shape (4, 2).

    From the sample at which the spline is the fewest times nearer than the polygon.
    """
    curve = measured_curves()[name]
    worst = []
    for r in HALVED:
        starts = [_distances(curve, cl.r_sample(curve, r, seed=k)) for k in range(STARTS)]
        worst.append(min(starts, key=lambda pair: pair[0] / pair[1]))
    return np.array(worst)


def _distances(curve: shapes.SmoothCurve, sample: cl.Sample) -> tuple[float, float]:
    """Return the distances of a single loop's polygon and spline from it."""
    spline = cl.smooth(cl.trace(sample.points, sample.edges))[0]
    share = (np.arange(24) + 0.5) / 24
    a = np.concatenate([spline.parameters, [1.0]])
    rows = np.append(spline.indices, spline.indices[0])
    t = sample.t[rows]
    step = (np.diff(t) + 0.5) % 1.0 - 0.5
    guess = (t[:-1, None] + step[:, None] * share).ravel()
    p = sample.points[rows]
    polygon = (p[:-1, None] + np.diff(p, axis=0)[:, None] * share[:, None]).reshape(-1, 2)
    smooth = spline.point((a[:-1, None] + np.diff(a)[:, None] * share).ravel())
    return _farthest(curve, polygon, guess), _farthest(curve, smooth, guess)


def _farthest(curve: shapes.SmoothCurve, places: Rows, t: Rows) -> float:
    """Return the largest distance of places from a loop; t is near the feet, Newton's method."""
    for _ in range(12):
        p, d1, d2 = curve.derivatives(t)
        slope = np.sum((p - places) * d1, axis=1)
        bend = np.sum(d1 * d1, axis=1) + np.sum((p - places) * d2, axis=1)
        t = t - np.clip(slope / np.where(bend > 0, bend, np.sum(d1 * d1, axis=1)), -0.05, 0.05)
    return float(np.hypot(*(curve.point(t) - places).T).max())


def smooth_table(errors: dict[str, Rows]) -> str:
    """Return by what factor splines are nearer to the curve than polygons, and both orders."""
    rows = []
    for name, e in errors.items():
        factors = [f"{polygon / spline:.3g}" for polygon, spline in e]
        rows.append([name, *factors, order(e[:, 0]), order(e[:, 1])])
    head = [f"r = {r:g}" for r in HALVED]
    return table(["polygon's error / spline's", *head, "order, polygon", "order, spline"], rows)
