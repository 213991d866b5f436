"""Tables of the share of exact reconstructions."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from crustline import theory
from experiments.theory.table import table
from experiments.theory.trials import METHODS, MODES, Trials, interval

Flags = npt.NDArray[np.bool_]


def share_table(t: Trials, mode: int) -> str:
    """Return the share of exact reconstructions, per r and method, with intervals."""
    rows = []
    for k, r in enumerate(t.ratios):
        cells = [_share(t.exact[:, mode, k, :, m]) for m in range(len(METHODS))]
        rows.append([f"{r:g}", *cells])
    return table(["r", *METHODS], rows)


def _share(hits: Flags) -> str:
    low, high = interval(hits)
    return f"{_percent(hits.mean())} <sub>{100 * low:.0f}–{100 * high:.0f}</sub>"


def _percent(share: float) -> str:
    """Return a share in percent; 100 and 0 mean all and none."""
    text = f"{100 * share:.1f}"
    return {"100.0": "100" if share == 1 else "99.9", "0.0": "0" if share == 0 else "0.1"}.get(
        text, text
    )


def threshold_table(t: Trials) -> str:
    """Return for each method what is proven and up to which r all trials were right."""
    proven = {"crust": theory.guaranteed_r("crust")}
    proven |= {f"β = {beta:g}": theory.guaranteed_r("beta_skeleton", beta) for beta in BETAS}
    rows = []
    for m, name in enumerate(METHODS):
        cells = [f"{proven[name]:.4f}" if name in proven else "–"]
        for mode in range(len(MODES)):
            right = np.asarray(t.exact[:, mode, :, :, m].all(axis=(0, 2)))
            first = int(np.argmin(right)) if not right.all() else len(right)
            cells.append(f"{t.ratios[first - 1]:g}" if first else f"< {t.ratios[0]:g}")
        rows.append([name, *cells])
    return table(["method", "proven for r below", *(f"all right up to ({m})" for m in MODES)], rows)


def error_table(t: Trials) -> str:
    """Return how many edges are missing and too many, per hundred, on the sparsest samples."""
    total = t.missing.shape[0] * t.missing.shape[3]
    rows = []
    for r in (0.5, 0.7, 0.8, 1.0):
        k = min(range(len(t.ratios)), key=lambda i: abs(t.ratios[i] - r))
        cells = []
        for m in range(len(METHODS)):
            lost = t.missing[:, 0, k, :, m].sum() / total
            more = t.extra[:, 0, k, :, m].sum() / total
            cells.append(f"−{lost:.2g} +{more:.2g}")
        rows.append([f"{t.ratios[k]:g}", *cells])
    return table(["r", *METHODS], rows)


#: Of the β-skeletons tried.
BETAS = (1.7, 1.25, 1.3)
#: Shares of exact reconstructions (percent) in an earlier study of ours, sparsest samples.
EARLIER: dict[str, dict[float, float]] = {
    "crust": {0.65: 100, 0.7: 99.5, 0.8: 98, 0.9: 97, 1.0: 94},
    "β = 1.7": {0.6: 100, 0.65: 79, 0.7: 34},
    "β = 1.25": {0.8: 99},
    "β = 1.3": {0.8: 99},
    "NN-crust": {0.7: 99.5, 0.8: 97.5, 1.0: 84},
}


def earlier_table(t: Trials) -> str:
    """Return the earlier figures beside these, and whether they are inside of the intervals."""
    rows = []
    for name, figures in EARLIER.items():
        for r, before in figures.items():
            if r not in t.ratios:
                continue
            hits = t.exact[:, 0, t.ratios.index(r), :, list(METHODS).index(name)]
            low, high = interval(hits)
            # "99 or more" and "100" are met by anything above.
            agrees = low <= before / 100 <= high
            word = (
                "agrees"
                if agrees
                else "higher here"
                if hits.mean() > before / 100
                else "lower here"
            )
            rows.append([name, f"{r:g}", f"{before:g}", _share(hits), word])
    return table(["method", "r", "earlier, %", "here, %", ""], rows)
