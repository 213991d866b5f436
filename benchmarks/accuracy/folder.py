"""Cases in a folder: NAME.csv (x,y), NAME.edges.csv (i,j), and INDEX.csv with their groups."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from .families import Case


def read_folder(folder: Path) -> list[Case]:
    """Return the cases that INDEX.csv of a folder lists."""
    with open(folder / "INDEX.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [_read(folder, row["name"], row["group"]) for row in rows]


def _read(folder: Path, name: str, group: str) -> Case:
    points = np.loadtxt(folder / f"{name}.csv", delimiter=",", skiprows=1, usecols=(0, 1))
    rows = np.loadtxt(folder / f"{name}.edges.csv", delimiter=",", skiprows=1, usecols=(0, 1))
    edges = rows.astype(np.int64).reshape(-1, 2)
    return Case(name, group, points, np.unique(np.sort(edges, axis=1), axis=0))
