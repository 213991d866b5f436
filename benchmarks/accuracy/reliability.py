"""Whether `connect` is as often right as it says: tables for edges and for whole answers."""

from __future__ import annotations

import numpy as np

from .calibrate import Judged, calibration_error, judge
from .families import Case
from .outline import Array
from .shapeless import shapeless

#: Where bins begin; the last ends at 1.
BINS = (0.0, 0.5, 0.8, 0.9, 0.95, 0.99, 0.999)

TEXT = """\
## How sure it is

Confidence was fitted on the half "tuned" and on points without a curve, and is judged here on the
half "unseen", all groups. Of the edges in a row, *said* is the mean confidence, *right* the share
that is right; the same for answers as a whole, right if no edge is wrong and none is missing.

"""


def reliability(cases: list[Case]) -> str:
    """Return the section of the page about confidence."""
    judged = [judge(case) for case in cases]
    edges = np.concatenate([each.confidence for each in judged])
    right = np.concatenate([each.right for each in judged]).astype(float)
    whole = np.array([each.whole for each in judged])
    exact = np.array([each.exact for each in judged], float)
    return (
        TEXT
        + _table("edges", edges, right)
        + _table("answers", whole, exact)
        + _shapeless([judge(case) for case in shapeless(2)])
    )


def _table(what: str, said: Array, right: Array) -> str:
    lines = [f"| {what} from | number | said | right |", "|---|---|---|---|"]
    which = np.searchsorted(BINS, said, side="right") - 1
    for k, least in enumerate(BINS):
        own = which == k
        if own.any():
            lines.append(
                f"| {least} | {own.sum():,} | {said[own].mean():.4f} | {right[own].mean():.4f} |"
            )
    error = calibration_error(said, right)
    return "\n".join(lines) + f"\n\nExpected calibration error, ten bins: {error:.4f}.\n\n"


def _shapeless(judged: list[Judged]) -> str:
    lines = [
        "Points that no curve was sampled from, other ones than those of the fit:\n",
        "| points | edges | at 0.9 or more | the whole |",
        "|---|---|---|---|",
    ]
    for each in judged:
        share = np.mean(each.confidence >= 0.9) if len(each.confidence) else 0.0
        lines.append(
            f"| {each.case.name} | {len(each.confidence)} | {share:.1%} | {each.whole:.4f} |"
        )
    everything = np.concatenate([each.confidence for each in judged])
    lines.append(f"\nAll of them together: {np.mean(everything >= 0.9):.1%} at 0.9 or more.\n\n")
    return "\n".join(lines)
