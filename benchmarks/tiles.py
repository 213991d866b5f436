"""Curves in tiles against one piece: processor time, and what the coordinator sees."""

import tempfile
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

import numpy as np

from .data import point_file

TURNS = 3
TILES = 4
TILE_POINTS = 10**6


def tiles(tile_points: int = TILE_POINTS) -> dict[str, float]:
    """Return processor seconds of edges and curves of four tiles' curve samples, from run reports.

    One piece is on one thread. Of a run in tiles, with one worker in this process, what reading
    the input and reading and writing files take is told apart. `ratio` is the median over the turns
    of tiles without files by one piece; `coordinator` the share of the points that one task sees.
    """
    try:
        import distributed
        import pyarrow as pa
        from pyarrow import parquet

        import crustline.distributed
    except ImportError:
        return {}
    samples = np.fromfile(point_file("curves", TILES * tile_points)).reshape(-1, 2)
    with (
        tempfile.TemporaryDirectory() as folder,
        distributed.Client(
            processes=False, n_workers=1, threads_per_worker=1, dashboard_address=None
        ) as client,
    ):
        for k, part in enumerate(np.array_split(samples, TILES)):
            table = pa.table({"x": part[:, 0], "y": part[:, 1]})
            parquet.write_table(table, Path(folder, f"{k}.parquet"))
        turns = []
        for turn in range(TURNS):
            alone = one_piece(samples)
            out = Path(folder, f"out-{turn}")
            result = crustline.distributed.reconstruct(
                f"{folder}/*.parquet", out, client=client, tile_points=tile_points
            )
            turns.append({"one piece": alone} | of_report(result.report, alone))
    return {name: median(turn[name] for turn in turns) for name in turns[0]}


def one_piece(samples: np.ndarray) -> float:
    import crustline as cl

    start = process_time()
    delaunay = cl.Delaunay(samples, threads=1)
    cl.trace(delaunay, cl.crust(delaunay))
    return process_time() - start


def of_report(report: dict[str, Any], alone: float) -> dict[str, float]:
    """Return what a run took, without the reading of the input."""
    stages = {name: stage for name, stage in report["stages"].items() if name != "read"}
    files = sum(stage["files"] for stage in stages.values())
    work = sum(stage["cpu"] for stage in stages.values()) - files
    seen = stages.get("coordinator", {}).get("points", 0)
    return {
        "tiles": work,
        "files of tiles": files,
        "ratio": work / alone,
        "coordinator": seen / report["counts"]["rows"],
    }


if __name__ == "__main__":
    for task, value in tiles().items():
        print(f"{task}: {value:.3g}")
