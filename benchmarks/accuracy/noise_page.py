"""Measure how right `denoise` is; writes its part of docs/accuracy.md, and its pictures.

python -m benchmarks.accuracy.noise_page
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

import crustline as cl

from .contact_sheet import write_sheet
from .families import HALVES
from .noise import NOISE, NOISY, NoisyScore, noisy_cases, noisy_score, outlines, places
from .outline import Array

ROOT = Path(__file__).parents[2]
BUILD = ROOT / "benchmarks" / "build" / "accuracy"
TITLE = "## Noise\n"
#: Cases of each family with each noise in each half.
EACH = 10
#: How often anyone has looked at the figures of the unseen half, this page's included.
LOOKS = 1
#: Failures on a sheet.
SHOWN = 60
#: The five rows: noise, and the rivals' figures, StretchDenoise's and FitConnect's.
ROWS = (
    (0.023, 0.011, 0.020),
    (0.059, 0.043, 0.034),
    (0.117, 0.073, 0.053),
    (0.175, 0.098, 0.069),
    (0.230, 0.064, 0.098),
)

INTRODUCTION = """
How right `denoise` is, by `python -m benchmarks.accuracy.noise_page`, which `make accuracy` runs,
too. Noise is normal, and given in steps between samples. The curves are *kept* if there is one for
each true one, a ring for a ring and a line for a line, each along nine tenths of it, and no other.
Beside that stands the median over the cases of the distance of the result from the truth, root
mean square, over the noise. Families are described in `benchmarks/accuracy/noise.py`. Constants
were chosen on the half "tuned"; the half "unseen" was looked at {looks}, an earlier one twice. Each
share is of {each} cases. How two strands 3 to 6 deviations apart are told from one is
[here](decisions/0006-denoise.md).

"""
CIRCLE = """
200 points at equal steps on a circle of radius 1, normal noise, 20 seeds: the median of the root
mean square distance of 10,000 places of the result from the circle. The rivals' figures are from
their paper, whose number of points is not known, so they give the scale. The best circle is that
of least squares to the same points.

"""
PICTURES = """
![Noisy points, gray, the true curves, black, and what denoise finds](accuracy_noise.png)

The first unseen case of each family, the noise 0.5 and 1 step (rows of two): points gray, the truth
black, the result vermillion. {failures}

"""


def noise_section() -> str:
    """Measure, draw the pictures, and return the part of the page."""
    looks = "once" if LOOKS == 1 else f"{LOOKS} times"
    text = TITLE + INTRODUCTION.format(looks=looks, each=EACH)
    for half in HALVES:
        made = {noise: list(map(noisy_score, noisy_cases(half, EACH, noise))) for noise in NOISE}
        text += f"### {half.capitalize()} half\n\n" + _table(made)
    every = [score for scores in made.values() for score in scores]
    failures = [score for score in every if not score.kept]
    _sheet(failures[:SHOWN], BUILD / "noise.png", 60)
    firsts = [each for noise in (0.5, 1.0) for each in made[noise] if each.case.name.endswith(" 0")]
    _sheet(firsts, ROOT / "docs" / "accuracy_noise.png", 75)
    words = f"Of the {len(every):,} unseen cases {len(failures)} are not kept."
    return text + _circles() + PICTURES.format(failures=words)


def _table(made: dict[float, list[NoisyScore]]) -> str:
    heads = " | ".join(f"{noise:g} steps | rms" for noise in made)
    lines = [f"| group | {heads} |", "|---" * (2 * len(made) + 1) + "|"]
    for family in [*NOISY, "all"]:
        cells = []
        for scores in made.values():
            own = [s for s in scores if family in (s.case.group, "all")]
            cells.append(f"{np.mean([s.kept for s in own]):.1%}")
            cells.append(f"{np.nanmedian([s.rms for s in own]):.2f}")
        lines.append(f"| {family} | {' | '.join(cells)} |")
    apart = [[s.kept for s in own if s.case.group != "strands"] for own in made.values()]
    lines.append(
        f"| all but strands | {' | – | '.join(f'{np.mean(own):.1%}' for own in apart)} | – |"
    )
    return "\n".join(lines) + "\n\n"


def _circles() -> str:
    lines = [
        "| noise | `denoise` | best circle | ratio | StretchDenoise | FitConnect | rings |",
        "|---|---|---|---|---|---|---|",
    ]
    for noise, stretch, connect in ROWS:
        found = np.array([_circle(noise, seed) for seed in range(20)])
        own, best = np.median(found[:, :2], axis=0)
        rings = f"{int(found[:, 2].sum())} of 20"
        lines.append(
            f"| {noise:.3f} | **{own:.4f}** | {best:.4f} | {own / best:.2f} "
            f"| {stretch:.3f} | {connect:.3f} | {rings} |"
        )
    return "### A circle\n" + CIRCLE + "\n".join(lines) + "\n"


def _circle(noise: float, seed: int) -> tuple[float, float, bool]:
    """Return the errors of `denoise` and of the best circle, and whether the first is one ring."""
    angle = 2 * np.pi * np.arange(200) / 200
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    points = circle + np.random.default_rng(seed).normal(0, noise, circle.shape)
    curves = cl.denoise(points).curves
    result = np.concatenate([places(each, 10_000) for each in outlines(curves)])
    is_ring = len(curves) == 1 and bool(curves.closed[0])
    fine = np.linspace(0, 2 * np.pi, 10_000, endpoint=False)
    center, radius = _least_squares_circle(points)
    best = center + radius * np.column_stack((np.cos(fine), np.sin(fine)))
    return _off(result), _off(best), is_ring


def _off(places: Array) -> float:
    return float(np.sqrt(((np.hypot(*places.T) - 1) ** 2).mean()))


def _least_squares_circle(points: Array) -> tuple[Array, float]:
    """Return center and radius of the circle of least squares of distances."""
    from scipy.optimize import least_squares

    def off(circle: Array) -> Array:
        return np.asarray(np.hypot(*(points - circle[:2]).T) - circle[2])

    x, y, radius = least_squares(off, [0.0, 0.0, 1.0]).x
    return np.array([x, y]), float(radius)


def _sheet(scores: list[NoisyScore], path: Path, dpi: int) -> None:
    about: dict[str, Any] = {"dpi": dpi, "metadata": {"Software": None}}
    write_sheet(scores, _draw, path, columns=len(NOISY), size=(2.4, 2.6), **about)


def _draw(ax: Axes, score: NoisyScore) -> None:
    case = score.case
    ax.plot(*case.points.T, ".", color="0.7", markersize=1.5)
    for outline in case.outlines:
        ax.plot(*places(outline).T, "k-", linewidth=0.8)
    for outline in outlines(score.found.curves):
        ax.plot(*places(outline).T, "-", color="#D55E00", linewidth=1)
    ax.set_aspect("equal")
    kept = "kept" if score.kept else "not kept"
    ax.set_title(f"{case.name}, {case.noise / case.step:.2g}: {kept}", fontsize=7)


def main() -> None:
    """Put the part about noise in the place of that of the page."""
    page = ROOT / "docs" / "accuracy.md"
    before = page.read_text(encoding="utf-8").partition(TITLE)[0]
    page.write_text(before.rstrip() + "\n\n" + noise_section().rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
