"""What a certificate is worth."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from experiments.theory.table import table
from experiments.theory.trials import METHODS, MODES, PROVEN, Trials

Flags = npt.NDArray[np.bool_]


def certificate_table(t: Trials) -> str:
    """Return per r how many correct edge sets are certified, and wrong ones, while any are."""
    rows = []
    last = int(np.flatnonzero(t.guaranteed.any(axis=(0, 1, 3, 4))).max(initial=-1))
    for k, r in enumerate(t.ratios[: last + 2]):
        row = [f"{r:g}"]
        for m, name in enumerate(PROVEN):
            right = t.exact[:, :, k, :, list(METHODS).index(name)]
            sure = t.guaranteed[:, :, k, :, m]
            row += [*(_of(sure[:, i] & right[:, i], right[:, i]) for i in range(2))]
            row.append(str(int(np.count_nonzero(sure & ~right))))
        rows.append(row)
    head = [f"{name}, {what}" for name in PROVEN for what in (*MODES, "wrong but guaranteed")]
    return table(["r", *head], rows)


def _of(part: Flags, whole: Flags) -> str:
    return f"{100 * part.sum() / whole.sum():.1f}" if whole.any() else "–"


def certificate_findings(t: Trials) -> str:
    """Return how near a wrong set of edges came to a guarantee."""
    lines = []
    for m, name in enumerate(PROVEN):
        wrong = ~t.exact[..., list(METHODS).index(name)]
        closed = wrong & t.rings[..., m]
        least = float(t.ratio[..., m][closed].min(initial=math.inf))
        lines.append(
            f"- {name}: {wrong.size} certificates, {np.count_nonzero(wrong)} of them for wrong "
            f"edges, of which {np.count_nonzero(t.guaranteed[..., m] & wrong)} said guaranteed. "
            f"{np.count_nonzero(closed)} of the wrong ones were rings through all points, so that "
            f"only the estimate could tell{_estimated(least)}"
        )
    return "\n".join(lines)


def _estimated(ratio: float) -> str:
    if math.isinf(ratio):
        return "."
    return f"; the smallest was {ratio:.3f}."
