"""Measure where the theory's thresholds lie in practice: python -m docs.experiment [--quick]

Writes docs/experiments.md and docs/experiments_*.png: how often each method finds a curve exactly,
how good the local feature size and the splines are, and what certificates are worth. Seeded: the
same numbers every time. With --quick an eighth of it goes to the terminal, and no file is written.
"""

from __future__ import annotations

import csv
import math
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from multiprocessing import Pool
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from docs.figures import HOOK, LEAF, PEAR
from matplotlib import rc_context, rcdefaults
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import crustline as cl
from crustline import shapes, theory
from crustline.plot import BLACK, BLUE, GRAY, GREEN, ORANGE, PURPLE, SKY, VERMILLION

Rows = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

ROOT = Path(__file__).resolve().parent.parent
CASES = Path(os.environ.get("CRUSTLINE_CASES", ROOT.parent / "shared" / "data" / "curves"))

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
#: r for the orders of convergence.
HALVED = (0.5, 0.25, 0.125, 0.0625)
SIZED = (0.5, 0.25, 0.2, 0.125, 0.0625)
PROCESSES = 2


# --- The curves ---------------------------------------------------------------------------------


def families() -> dict[str, list[shapes.SmoothCurve]]:
    """Return the curves of the experiment, of one or more components, by family."""
    return {
        "ellipses": [shapes.ellipse(a, 1) for a in (1.1, 1.5, 2, 3, 4, 6)],
        "stadiums": [shapes.stadium(length, 1) for length in (1, 2, 4, 8)],
        "trefoils": [shapes.trefoil(k, d) for k in (2, 3, 4, 5, 6) for d in (0.1, 0.3)],
        "superformulas": [
            shapes.superformula(m, n1, n, n)
            for m, n1, n in ((2, 3, 4), (4, 4, 4), (4, 8, 6), (6, 3, 3), (6, 6, 3), (8, 5, 4))
        ],
        "blobs": [
            shapes.blob(k, harmonics=3 + k % 6, roughness=0.2 + 0.05 * (k % 7)) for k in range(40)
        ],
        "bent strips": [_bent(rows, k) for rows in (HOOK, LEAF, PEAR) for k in range(4)],
        "compound curves": [_pair(k) for k in range(10)] + [_nested(k) for k in range(6)],
    }


def _bent(rows: Sequence[tuple[float, float]], seed: int) -> shapes.SmoothCurve:
    """Return a spline through control points, moved a little for all seeds but 0."""
    shift = np.random.default_rng(seed).normal(0, 0.07, (len(rows), 2))
    return shapes.spline(np.array(rows) + (shift if seed else 0))


def _pair(seed: int) -> shapes.SmoothCurve:
    """Return two blobs side by side, with a gap that may be narrow."""
    rng = np.random.default_rng(seed)
    left, right = (shapes.blob(100 + 2 * seed + k, harmonics=4) for k in range(2))
    t = np.linspace(0, 1, 500)
    gap = rng.uniform(0.1, 0.6)
    step = left.point(t)[:, 0].max() - right.point(t)[:, 0].min() + gap
    return left + right.moved(offset=(step, rng.uniform(-0.5, 0.5)))


def _nested(seed: int) -> shapes.SmoothCurve:
    """Return an ellipse with a smaller, turned one inside."""
    rng = np.random.default_rng(seed)
    inner = shapes.ellipse(rng.uniform(0.5, 1.2), rng.uniform(0.2, 0.5))
    return shapes.ellipse(2, 1.5) + inner.moved(
        angle=rng.uniform(0, math.pi), offset=rng.uniform(-0.2, 0.2, 2)
    )


# --- The share of exact reconstructions ---------------------------------------------------------


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
    return Trials(*(np.array(column) for column in zip(*rows, strict=True)), ratios)


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
    names = {"crust": ("crust",), "β = 1.7": ("beta_skeleton", 1.7),
             "β = 1.25": ("beta_skeleton", 1.25), "β = 1.3": ("beta_skeleton", 1.3)}  # fmt: skip
    rows = []
    for m, name in enumerate(METHODS):
        proven = f"{theory.guaranteed_r(*names[name]):.4f}" if name in names else "–"
        cells = []
        for mode in range(len(MODES)):
            right = t.exact[:, mode, :, :, m].all(axis=(0, 2))
            first = int(np.argmin(right)) if not right.all() else len(right)
            cells.append(f"{t.ratios[first - 1]:g}" if first else f"< {t.ratios[0]:g}")
        rows.append([name, proven, *cells])
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


# --- Earlier figures ----------------------------------------------------------------------------

#: Shares of exact reconstructions (percent) in an earlier study of ours, sparsest samples.
EARLIER = {
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


# --- Local feature size from samples ------------------------------------------------------------


def measured_curves() -> dict[str, shapes.SmoothCurve]:
    """Return the curves on which errors are measured."""
    return {
        "circle": shapes.circle(),
        "ellipse 1.1:1": shapes.ellipse(1.1, 1),
        "ellipse 2:1": shapes.ellipse(2, 1),
        "ellipse 6:1": shapes.ellipse(6, 1),
        "stadium 2": shapes.stadium(2, 1),
        "trefoil": shapes.trefoil(3, 0.3),
        "superformula": shapes.superformula(6, 6, 3, 3),
        **{f"blob {k}": shapes.blob(k) for k in (1, 3, 5, 7)},
    }


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
        rows.append([name, *cells, _order(halved[:, 0]), _order(halved[:, 1])])
    head = [f"r = {r:g}" for r in SIZED]
    return table(["median / worst, %", *head, "order, median", "order, worst"], rows)


def _error(share: float) -> str:
    return f"{100 * share:.2g}" if share > 1e-6 else "0"


def _order(errors: Rows) -> str:
    """Return the slope of errors on the logarithm of r over the last halving."""
    if errors[-1] < 1e-9 or errors[-2] < 1e-9:
        return "exact"
    return f"{math.log2(errors[-2] / errors[-1]):.1f}"


# --- Splines ------------------------------------------------------------------------------------


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
        rows.append([name, *factors, _order(e[:, 0]), _order(e[:, 1])])
    head = [f"r = {r:g}" for r in HALVED]
    return table(["polygon's error / spline's", *head, "order, polygon", "order, spline"], rows)


# --- Certificates -------------------------------------------------------------------------------


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


# --- Points with known curves, from elsewhere ---------------------------------------------------


def cases_table() -> str:
    """Return the share of right edges per method and group of a collection, if it is there."""
    if not (CASES / "INDEX.csv").exists():
        return (
            "The collection was not at hand in this run; the environment variable CRUSTLINE_CASES "
            "names its folder."
        )
    with (CASES / "INDEX.csv").open(encoding="utf-8") as file:
        groups: dict[str, list[str]] = {}
        for row in csv.DictReader(file):
            groups.setdefault(row["group"], []).append(row["name"])
    scores = {group: np.array([_scores(name) for name in names]) for group, names in groups.items()}
    rows = []
    for m, method in enumerate(METHODS):
        cells = [
            f"{100 * s[:, m].mean():.1f} <sub>{np.count_nonzero(s[:, m] == 1)}/{len(s)}</sub>"
            for s in scores.values()
        ]
        rows.append([method, *cells])
    return table(["method", *scores], rows)


def _scores(name: str) -> list[float]:
    """Return Dice's coefficient of found and true edges for each method."""
    delaunay = cl.Delaunay(cl.read(CASES / f"{name}.csv"))
    pairs = np.loadtxt(CASES / f"{name}.edges.csv", delimiter=",", skiprows=1, dtype=int, ndmin=2)
    true = {*map(tuple, np.sort(pairs, axis=1).tolist())}
    found = [{*map(tuple, method(delaunay).tolist())} for method in METHODS.values()]
    return [2 * len(true & edges) / max(1, len(true) + len(edges)) for edges in found]


# --- Pictures -----------------------------------------------------------------------------------

STYLES = {
    "crust": (BLUE, "-", "o"), "β = 1.7": (VERMILLION, "-", "s"), "β = 1.25": (GREEN, "-", "^"),
    "NN-crust": (PURPLE, "--", "D"), "one-step crust": (SKY, "--", "v"),
    "Gabriel": (ORANGE, ":", "P"), "RCGH": (GRAY, ":", "X"),
}  # fmt: skip


def draw_shares(t: Trials) -> Figure:
    """Draw the share of exact reconstructions against r, for both modes."""
    figure, axes = _figure(9.2, 3.9, 2)
    for mode, ax in enumerate(axes):
        for name, (color, style, marker) in STYLES.items():
            shares = 100 * t.exact[:, mode, :, :, list(METHODS).index(name)].mean(axis=(0, 2))
            ax.plot(t.ratios, shares, style, color=color, marker=marker, markersize=4, label=name)
        for r, words in (
            (cl.guaranteed_r("crust"), "crust proven"),
            (0.66, "0.66"),
            (0.72, "0.72"),
        ):
            ax.axvline(r, color=BLACK, linewidth=0.7, linestyle=":")
            ax.annotate(words, (r, 3), (2, 0), textcoords="offset points", size=7, rotation=90)
        ax.set(xlabel="r", title=f"{MODES[mode]} samples", ylim=(-2, 103))
    axes[0].set_ylabel("exact reconstructions, %")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=7, fontsize=8, frameon=False)
    return figure


def draw_orders(sizes: dict[str, list[Rows]], errors: dict[str, Rows]) -> Figure:
    """Draw the errors of the feature size, and of polygons and splines, against r."""
    figure, (left, right) = _figure(9.2, 3.9, 2)
    chosen = {"ellipse 2:1": (BLUE, "o"), "trefoil": (GREEN, "^"), "stadium 2": (ORANGE, "s"),
              "blob 7": (PURPLE, "D")}  # fmt: skip
    for name, (color, marker) in chosen.items():
        if name not in sizes:
            continue
        style = {"color": color, "marker": marker, "markersize": 4}
        sized = [sizes[name][SIZED.index(r)] for r in HALVED]
        size = np.array([(np.median(np.abs(e)), np.abs(e).max()) for e in sized])
        left.plot(HALVED, np.maximum(size[:, 0], 1e-7), "-", label=f"{name}, median", **style)
        left.plot(HALVED, np.maximum(size[:, 1], 1e-7), ":", label=f"{name}, worst", **style)
        right.plot(HALVED, errors[name][:, 0], ":", label=f"{name}, polygon", **style)
        right.plot(HALVED, errors[name][:, 1], "-", label=f"{name}, spline", **style)
    left.set(title="local feature size from samples", ylabel="relative error")
    right.set(title="distance from the curve", ylabel="largest distance")
    for ax in (left, right):
        ax.set(xscale="log", yscale="log", xlabel="r")
        ax.set_xticks(HALVED, [f"{r:g}" for r in HALVED])
        ax.minorticks_off()
        ax.legend(fontsize=7, frameon=False, loc="lower right")
    return figure


def _figure(width: float, height: float, count: int) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    axes = [figure.add_subplot(1, count, k + 1) for k in range(count)]
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
        ax.grid(color="#e5e5e5", linewidth=0.6)
    return figure, axes


# --- The page -----------------------------------------------------------------------------------


def table(head: Iterable[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table."""
    head = list(head)
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


PAGE = """# Experiments

Made by `make experiment` from [`docs/experiment.py`](experiment.py); the same numbers every time.
{curves} smooth curves, each sampled from {starts} starts at each r: {families}. Two modes:

- *sparsest*: each step along the curve is as long as an r-sample allows;
- *random*: each step is between half and the whole of that.

Every sample is an r-sample by proof over the whole curve (`cl.r_sample`), and *exact* means that
the edges are those between samples adjacent along the curve, none missing and none too many. Small
figures are 95 % intervals (Wilson), wider than for independent trials because the starts on one
curve are not; they are about curves like these, which we chose, and not about yours.

## How sparse samples may be

![Share of exact reconstructions against r](experiments_exact.png)

{thresholds}

"Proven" is where the theorems of the paper hold ([theory](theory.md)); "all right up to" is the
last r of the tables below before the first failure.

The theorems are about the worst curve, and cautious: on these curves the crust errs nowhere below
2.5 times the r that is proven for it, the β-skeleton for β = 1.70 nowhere below twice its own.
The order is reversed, though. What can be proven is better for β = 1.70 than for the crust; what
happens is worse. On a circle, the radius βd/2 of the forbidden region exceeds the circle's own
once the sparsest samples have r > 2 sin(φ/2), φ = arcsin(1/β); then all edges are lost. That is r
= 0.62 for β = 1.70, 0.85 for β = 1.3 and 0.89 for β = 1.25, and there the columns below drop. So
β = 1.25 to 1.3, for which less can be proven, lasts longer. The one-step crust, which is cheaper
and contains the crust, is all but equal to it. Gabriel and relative neighborhood graph and RCGH
keep edges across the inside of curves at any r.

For any method at all two limits are known, by Bjerkevik [1]: from a 0.66-sample a curve can
always be reconstructed, by an algorithm similar to NN-crust; from a 0.72-sample not always, since
two curves may share it. That replaces the r = 1 of the paper's Observation 6. It is no
contradiction that most reconstructions are exact beyond 0.72: it takes one curve in all to make a
limit, and ours are not made to be hard. Nor does 0.66 promise anything for the methods here,
though in this experiment the crust, NN-crust and β = 1.3 made no error up to 0.65.

[1] H. B. Bjerkevik, "Tighter Bounds for Reconstruction from ε-Samples", 38th International
Symposium on Computational Geometry (SoCG), 2022;
[arXiv:2112.03656](https://arxiv.org/abs/2112.03656).

### Sparsest samples: exact reconstructions, %

{sparsest}

### Random samples: exact reconstructions, %

{random}

### How wrong: edges missing (−) and too many (+) for each sparsest sample

{errors}

### Against earlier figures

A study of ours with other curves had given these shares for sparsest samples.

{earlier}

That the crust is always right up to 0.65 and nearly always at 0.7 and 0.8, and where the
β-skeleton for β = 1.70 begins to fail, is confirmed. The rest depends on the curves more than on
the method: ours, with narrow gaps between components and bent strips, are harder, and give lower
shares.

## The local feature size from samples

`cl.local_feature_size(points, edges)` on the true edges, against the curve's own, at the samples of
four starts: relative errors, the median and the worst. The order is the slope over the last
halving.

![Errors against r](experiments_orders.png)

{sizes}

At r = 0.2 the median is within 10 % on each curve. The worst sample is off by up to a fifth on
blobs. Medians converge at about the second order or faster on smooth curves. The stadium is the
exception: its curvature jumps at four joints, which samples cannot show, and the error near them,
of up to 13 %, stays at any r. On the circle the estimate is exact but for rounding.

## Splines instead of polygons

`cl.smooth` through sparsest samples: how many times nearer to the curve it stays than the polygon,
at the place where each is farthest from it; the worst of four starts. Orders over the last halving.

{smooth}

The spline is of the fourth order or better where the curve is smooth enough, of the second where
the curvature jumps (stadium), in between for the superformula, whose exponents are not even
integers.
"Ten times better at r = 0.25" holds for the circle, the ellipses, the stadium, the trefoil and the
superformula, and for some of the blobs. The others need r = 0.125: LFS bounds the curvature, not
how fast it changes, and a dent may fit between three samples.

No method can have ten times for all curves. Through a 0.22-sample of blob 4 (seed 5) runs another
curve, `shapes.spline`, of which it is a 0.24-sample. The two are farther apart than a fifth of the
polygon's distance from either, so that whatever runs through these samples is not ten times nearer
to both. The stadium's joints are found from three or four samples on each side; with fewer, as on
`stadium(1, 1)` at r = 0.25, the factor stays at 4.

## What a certificate is worth

`cl.certify` for the crust and the β-skeleton of every sample above: the share of the *correct* edge
sets that it guarantees, in percent, and how many *wrong* ones it guarantees, which must be none.

{certificates}

{findings}

Past the threshold of the theorem nothing is certified, however right it is. No wrong set of edges
was certified. In fact none of them came near: each had an end, a branch or an isolated point,
which is decided exactly, so the estimate of the sampling ratio was not put to the test by these
curves.

## Points whose curves are known

76 point sets with true edges: drawn, scanned, derived from outlines, vector drawings (also jittered
and with outliers), synthetic ones with corners and open ends. They are other people's and not
part of this repository. Most are outside of the theory: corners, ends, noise. The figure is Dice's
coefficient of found and true edges, in percent, averaged over the group; small, how many point sets
are exactly right.

{cases}

On points that no theorem covers the crust is the best or nearly the best in most groups; β = 1.70
is too strict for corners and sparse outlines. With outliers no method gets a whole point set
right: to remove them is another problem.
"""


def page(t: Trials, sizes: dict[str, list[Rows]], errors: dict[str, Rows]) -> str:
    """Return docs/experiments.md."""
    fields = {
        "curves": t.exact.shape[0],
        "starts": t.exact.shape[3],
        "families": ", ".join(f"{len(f)} {name}" for name, f in families().items()),
        "sets": t.exact[..., 0].size,
        "thresholds": threshold_table(t),
        "sparsest": share_table(t, 0),
        "random": share_table(t, 1),
        "errors": error_table(t),
        "earlier": earlier_table(t),
        "sizes": feature_size_table(sizes),
        "smooth": smooth_table(errors),
        "certificates": certificate_table(t),
        "findings": certificate_findings(t),
        "cases": cases_table(),
    }
    return PAGE.format(**fields)


def main(quick: bool) -> None:
    """Run the experiment; write the page and its pictures, or print the page."""
    t = trials(8 if quick else 1, RATIOS[::3] if quick else RATIOS, 1 if quick else STARTS)
    names = list(measured_curves())[:: 5 if quick else 1]
    with Pool(PROCESSES) as pool:
        sizes = dict(zip(names, pool.map(feature_size_errors, names, chunksize=1), strict=True))
        errors = dict(zip(names, pool.map(smooth_errors, names, chunksize=1), strict=True))
    text = page(t, sizes, errors)
    if quick:
        print(text)
        return
    (ROOT / "docs" / "experiments.md").write_text(text, encoding="utf-8")
    # Matplotlib's own settings, not the user's.
    with rc_context():
        rcdefaults()
        for name, figure in (
            ("exact", draw_shares(t)),
            ("orders", draw_orders(sizes, errors)),
        ):
            path = ROOT / "docs" / f"experiments_{name}.png"
            figure.savefig(path, dpi=110, metadata={"Software": None})
    print("docs/experiments.md: written")


if __name__ == "__main__":
    main("--quick" in sys.argv[1:])
