"""Why an answer is wrong, in a word or two, from what can be seen of it."""

from __future__ import annotations

import numpy as np

import crustline as cl

from .measure import Score


def reason(score: Score) -> str:
    """Return the reason of a failure."""
    case = score.case
    degree = np.bincount(case.edges.ravel(), minlength=len(case.points))
    found, true = (set(map(tuple, rows.tolist())) for rows in (score.edges, case.edges))
    missing, extra = true - found, found - true
    candidates = set(map(tuple, cl.Delaunay(case.points).edges.tolist()))
    if missing - candidates:
        return "the truth is not in the Delaunay triangulation"
    if degree.max() > 2:
        return "curves meet in another way there"
    if any(degree[row] == 0 for edge in extra for row in edge):
        return "outliers were joined"
    if not extra:
        return "a gap where the curve goes on"
    if not missing:
        return "an open end was joined"
    return "another order of points was cheaper"
