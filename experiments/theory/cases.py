"""Points with known curves, from elsewhere."""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np

import crustline as cl
from experiments.theory.table import table
from experiments.theory.trials import METHODS

#: A folder of points with true edges, which is no part of this repository.
CASES = Path(os.environ.get("CRUSTLINE_CASES", "cases"))


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
