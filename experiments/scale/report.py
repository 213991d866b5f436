"""The page of runs under a hard limit: python -m experiments.scale.report makes it anew."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).with_name("results.json")
PAGE = Path(__file__).parents[2] / "docs/scale_report.md"

Run = dict[str, Any]

INTRODUCTION = """\
# Runs under a hard limit of memory

<!-- Made by python -m experiments.scale.larger_than_memory; do not edit. -->

Rings of 500 samples each, their rows shuffled over all of the plane, in Parquet files of a million;
one worker of one thread, in tiles of about {tile_points:,} points. Once the worker has done a small
run, and holds what that takes, its address space is limited (`RLIMIT_AS`) to what lets it hold
{limit:,.0f} MB: what asks for more fails, and the run with it. The coordinates of 10⁸ points are
1,600 MB; with the numbers of their rows, as a run sorts them, 2,400 MB. What is resident was looked
at from outside, every 20 ms.

Every edge was compared with those of the rings, which are known. An edge that no ring has would
stop the script; *missing* are those that were not found. To try it:

    python -m experiments.scale.larger_than_memory FOLDER 1e6 3e6 1e7 1e8

"""

COLUMNS = (
    "points", "tiles", "edges", "missing", "rings", "open", "worker at first, MB", "at most, MB",
    "client, MB", "processors, s", "µs a point", "minutes", "load",
)  # fmt: skip

NOTE = """
The load is that of the last quarter of an hour, on two cores: where it is above one, the run waited
for its turn, and minutes are too many. Workers keep no samples of what they do, which Dask's do by
default: they grow by some 15 kB with each step.
"""


def write_page(runs: list[Run]) -> None:
    """Write the page."""
    largest = runs[-1]
    head = INTRODUCTION.format(tile_points=largest["tile_points"], limit=largest["limit"] / 1e6)
    table = [f"| {' | '.join(COLUMNS)} |", "|" + " --- |" * len(COLUMNS), *map(_row, runs)]
    PAGE.write_text(head + "\n".join([*table, NOTE, *stages(largest)]) + "\n", encoding="utf-8")


def _row(run: Run) -> str:
    counts, points = run["counts"], run["points"]
    cpu = sum(stage["cpu"] for stage in run["stages"].values())
    client = max(peak["client"] for peak in run["peaks"].values())
    return (
        f"| {points:,} | {counts['tiles']:,} | {counts['edges']:,} | {run['missing']} | "
        f"{counts['curves']:,} | {run['open']} | "
        f"{run['warm'] / 1e6:.0f} | {run['peak'] / 1e6:.0f} | {client / 1e6:.0f} | "
        f"{cpu:.0f} | {cpu / points * 1e6:.2f} | {run['wall'] / 60:.1f} | "
        f"{run['load']:.0f} |"
    )


def stages(run: Run) -> list[str]:
    """Return the stages of a run in a table."""
    rows = [
        f"| {name} | {stage['steps']:,} | {stage['cpu']:.1f} | {stage['files']:.1f} | "
        f"{stage['bytes'] / 1e6:,.0f} | {run['peaks'].get(name, {}).get('worker', 0) / 1e6:.0f} |"
        for name, stage in run["stages"].items()
    ]
    tiles = run["stages"]["tiles"]
    left = tiles.get("open_vertices", 0) + tiles.get("open_edges", 0)
    return [
        f"## {run['points']:,} points by stage",
        "",
        "| stage | steps | processors, s | of it files, s | written, MB | worker at most, MB |",
        "|" + " --- |" * 6,
        *rows,
        "",
        f"The tiles saw {tiles.get('halo', 0) / run['points']:.2%} more points around them than "
        f"they have, and left {left:,} edges and vertices open.",
    ]


if __name__ == "__main__":
    write_page(json.loads(RESULTS.read_text(encoding="utf-8")))
