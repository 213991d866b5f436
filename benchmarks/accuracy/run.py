"""Measure how often methods are right; writes docs/accuracy.md and, into build/, contact sheets.

python -m benchmarks.accuracy.run [FOLDER]
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import numpy as np

from .contact_sheet import draw_sheet
from .examples import examples
from .families import HALVES, HARD, cases
from .folder import read_folder
from .measure import Score, parameter_free, scores
from .noise_page import noise_section
from .reasons import reason
from .reliability import reliability

ROOT = Path(__file__).parents[2]
BUILD = ROOT / "benchmarks" / "build" / "accuracy"
#: Cases of each family in each half: 27 families make 5,400. Of 80, shares would waver by 5 %.
EACH = 200
#: How often anyone has looked at the figures of the unseen half, this page's run included.
LOOKS = 1
#: Failures on a sheet.
SHOWN = 120

INTRODUCTION = """\
# Accuracy

Written by `make accuracy`. A case is points whose curve is known; an answer is *exact* if it has
all edges between samples adjacent along the curve, and no others. A *defect* is a point whose
number of edges is wrong. Methods that need a parameter are left out.

"""
GENERATED = """\
Cases that `benchmarks/accuracy` makes, their parameters drawn uniformly over the ranges that its
docstrings state. The constants of `connect` were chosen on the half "tuned". The half "unseen" was
looked at {looks} ({date}); four earlier ones, looked at once, twice, once and twice, led to
changes and are unseen no more. Groups marked * are harder than `connect` promises to be good at:
junctions, more noise than 0.15 steps, more than 30 % outliers. T, X and Y are asked for with
`junctions=True`; without it no point has more than two edges, and none of them is exact. Precision
and recall are those of `connect`.

"""
EXAMPLES = """\
## Outlines of `examples/`

The goose and the coasts of New Zealand, which were made so that their crust is right.

"""


def main() -> None:
    """Measure, write the page and the sheets."""
    page = [INTRODUCTION]
    for half in HALVES:
        names = list(parameter_free()) if half == "unseen" else ["crust", "hnn-crust", "connect"]
        made = scores(cases(half, EACH), names)
        page += [f"## Generated cases, {half} half\n\n"]
        if half == "unseen":
            looks = "once" if LOOKS == 1 else f"{LOOKS} times"
            page += [GENERATED.format(looks=looks, date="this run included")]
            page += [_methods(made)]
        page += [_groups(made), _promise(made["connect"]), _failures(made["connect"], half)]
        if half == "unseen":
            page += [reliability(cases(half, EACH))]
    made = scores(examples(), ["crust", "hnn-crust", "connect"])
    page += [EXAMPLES, _groups(made), _failures(made["connect"], "examples")]
    for folder in map(Path, sys.argv[1:2]):
        made = scores(read_folder(folder), parameter_free())
        page += [
            "## Cases by others\n\nDrawn, scanned, vector and synthetic curves, evaluated and "
            "not shipped, since most of them may not be published.\n\n"
        ]
        page += [_methods(made), _groups(made), _failures(made["connect"], "folder")]
    page += [noise_section()]
    (ROOT / "docs" / "accuracy.md").write_text("".join(page).rstrip() + "\n", encoding="utf-8")


def _methods(made: dict[str, list[Score]]) -> str:
    lines = [
        "| method | exact | precision, mean | worst | recall, mean | worst | defects a case |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, own in sorted(made.items(), key=lambda each: -_share(each[1])):
        defects = np.mean([s.defects for s in own])
        lines.append(f"| {name} | {_share(own):.1%} | {' | '.join(_spread(own))} | {defects:.1f} |")
    return "\n".join(lines) + "\n\n"


def _groups(made: dict[str, list[Score]]) -> str:
    shown = [name for name in ("crust", "hnn-crust", "connect") if name in made]
    titles = ["group", "cases", *shown, "precision, mean", "worst", "recall, mean", "worst"]
    lines = [f"| {' | '.join(titles)} |", "|---" * len(titles) + "|"]
    for group in dict.fromkeys(s.case.group for s in made["connect"]):
        own = {name: [s for s in made[name] if s.case.group == group] for name in shown}
        shares = " | ".join(f"{_share(own[name]):.1%}" for name in shown)
        mark = " *" if group in HARD else ""
        spread = " | ".join(_spread(own["connect"]))
        lines.append(f"| {group}{mark} | {len(own['connect'])} | {shares} | {spread} |")
    return "\n".join(lines) + "\n\n"


def _spread(own: list[Score]) -> list[str]:
    """Return mean and worst of precision and of recall."""
    rows = ([getattr(s, key) for s in own] for key in ("precision", "recall"))
    return [text for row in rows for text in (f"{np.mean(row):.3f}", f"{min(row):.2f}")]


def _promise(own: list[Score]) -> str:
    easy = [s for s in own if s.case.group not in HARD]
    return f"Groups without a mark together: `connect` {_share(easy):.2%}.\n\n"


def _failures(own: list[Score], name: str) -> str:
    """Return the list of all failures with their reasons, and draw them."""
    failures = [s for s in own if not s.exact]
    for start in range(0, len(failures), SHOWN):
        sheet = BUILD / f"{name}-{start // SHOWN + 1}.png"
        draw_sheet(failures[start : start + SHOWN], sheet)
    why: dict[str, list[Score]] = {}
    for failure in failures:
        why.setdefault(reason(failure), []).append(failure)
    lines = [f"Failures of `connect`: {len(failures)}; edges too many and missing.\n"]
    for words, found in sorted(why.items(), key=lambda each: -len(each[1])):
        each = "; ".join(f"{s.case.name} +{s.extra} −{s.missing}" for s in found)
        lines.append(f"- {words}: {len(found)} ({_groups_of(found)}): {each}")
    return "\n".join(lines) + "\n\n"


def _groups_of(failures: list[Score]) -> str:
    """Return how many failures are of each group, most first."""
    counts = Counter(s.case.group for s in failures).most_common()
    return ", ".join(f"{group} {count}" for group, count in counts)


def _share(own: list[Score]) -> float:
    return float(np.mean([s.exact for s in own]))


if __name__ == "__main__":
    main()
