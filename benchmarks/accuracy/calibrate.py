"""Fit the calibration of `connect`'s confidence on the tuned half; prints what calibrate.rs holds.

python -m benchmarks.accuracy.calibrate
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

import crustline as cl
from crustline import _core

from .families import Case, cases
from .shapeless import shapeless

Array = np.ndarray

#: Cases of each family: every other one is fitted first and judged by the rest, then all are.
EACH = 70
#: The weight of the edges of shapeless points, all of which count as wrong, relative to all others.
SHAPELESS = 0.1
#: The same of the sets of shapeless points as answers.
WHOLE = 0.02
#: The confidence of an edge of the theorem.
PROVEN = 0.999
#: The variance of the weights before anything is known.
PRIOR = 25.0


@dataclass(frozen=True)
class Judged:
    """An answer: what describes it and its edges, and whether they are right."""

    case: Case
    features: Array
    right: Array
    confidence: Array
    description: Array
    whole: float
    exact: bool


def judge(case: Case) -> Judged:
    """Return the answer of `connect` beside the truth."""
    made: dict[str, Any] = cl.Delaunay(case.points).run(_core.connection)
    keys = (edges @ [len(case.points), 1] for edges in (made["edges"], case.edges))
    found, true = keys
    right = np.isin(found, true)
    exact = bool(right.all() and len(found) == len(true))
    return Judged(
        case,
        made["features"],
        right,
        made["confidence"],
        made["description"],
        made["whole"],
        exact,
    )


def fit(features: Array, right: Array, weight: Array) -> Array:
    """Return the weights of a logistic regression: Newton's method, with a normal prior."""
    scale = np.maximum(features.std(0), 1e-9)
    scale[0] = 1.0
    x = features / scale
    w = np.zeros(x.shape[1])
    prior = np.full(len(w), 1 / PRIOR)
    prior[0] = 0.0
    for _ in range(50):
        p = 1 / (1 + np.exp(-x @ w))
        gradient = x.T @ (weight * (right - p)) - prior * w
        hessian = (x.T * (weight * p * (1 - p))) @ x + np.diag(prior) + 1e-9 * np.eye(len(w))
        step = np.linalg.solve(hessian, gradient)
        w += step
        if np.abs(step).max() < 1e-9:
            break
    made: Array = w / scale
    return made


def edges_of(judged: list[Judged]) -> tuple[Array, Array]:
    """Return what describes all edges that messages were sent about, and whether they are right."""
    features = np.concatenate([each.features for each in judged])
    right = np.concatenate([each.right for each in judged]).astype(float)
    known = ~np.isnan(features[:, 0])
    return features[known], right[known]


def logistic(values: Array, weights: Array) -> Array:
    """Return the probabilities."""
    made: Array = 1 / (1 + np.exp(-values @ weights))
    return made


def describe(confidence: Array, isolated: float) -> Array:
    """Return what describes an answer, as calibrate.rs does."""
    doubts = 1 - confidence
    worst = doubts.max(initial=0.0)
    logs = (max(doubts.sum(), 1e-4), max(worst, 1e-4), len(doubts) + 1)
    total, least, count = map(np.log, logs)
    mean = total - count
    return np.array([1, total, least, isolated, count, mean, mean**2])


def _described(judged: Judged, edge: Array) -> Array:
    """Return what describes an answer whose edges are weighed anew."""
    known = ~np.isnan(judged.features[:, 0])
    sure = np.where(known, logistic(np.nan_to_num(judged.features), edge), PROVEN)
    return describe(sure, judged.description[3])


def calibration_error(confidence: Array, right: Array, bins: int = 10) -> float:
    """Return the mean difference between confidence and share of right ones, over bins."""
    which = np.minimum((confidence * bins).astype(int), bins - 1)
    gaps = [abs((right - confidence)[which == k].sum()) for k in range(bins)]
    return float(sum(gaps) / max(1, len(right)))


def fitted(judged: list[Judged], clouds: list[Judged]) -> tuple[Array, Array]:
    """Return the weights for edges and those for answers."""
    features, right = edges_of(judged)
    none, _ = edges_of(clouds)
    # Each set of shapeless points weighs the same, however many it has.
    alike = np.concatenate(
        [np.full(len(own), 1 / len(own)) for own, _ in map(edges_of, [[c] for c in clouds])]
    )
    weight = np.concatenate([np.ones(len(right)), alike * SHAPELESS * len(right) / alike.sum()])
    x = np.concatenate([features, none])
    edge = fit(x, np.concatenate([right, np.zeros(len(none))]), weight)
    rows = [_described(each, edge) for each in (*judged, *clouds)]
    exact = np.array([each.exact for each in judged] + [False] * len(clouds), float)
    weight = np.concatenate(
        [np.ones(len(judged)), np.full(len(clouds), WHOLE * len(judged) / len(clouds))]
    )
    return edge, fit(np.array(rows), exact, weight)


def main() -> None:
    """Fit, print the weights, and how well those of one half of the cases do on the other."""
    all_cases = cases("tuned", EACH)
    number = [int(case.name.split()[-1]) for case in all_cases]
    judged = [judge(case) for case in all_cases]
    clouds = [judge(case) for case in shapeless(0)]
    train = [each for each, k in zip(judged, number, strict=True) if k % 2 == 0]
    test = [each for each, k in zip(judged, number, strict=True) if k % 2]
    edge, whole = fitted(train, clouds)
    features, right = edges_of(test)
    print("edges of others:", calibration_error(logistic(features, edge), right))
    rows = [_described(each, edge) for each in test]
    exact = np.array([each.exact for each in test], float)
    print("answers of others:", calibration_error(logistic(np.array(rows), whole), exact))
    for case in map(judge, shapeless(1)):
        p = logistic(case.features[~np.isnan(case.features[:, 0])], edge)
        print(f"{case.case.name}: {np.mean(p >= 0.9):.1%} of {len(p)} edges at 0.9 or more")
    for name, weights in zip(("EDGE", "ANSWER"), fitted(judged, clouds), strict=True):
        print(name, ", ".join(f"{value:.4}" for value in weights))


if __name__ == "__main__":
    main()
