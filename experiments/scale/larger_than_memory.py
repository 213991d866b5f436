"""Runs under a hard limit of memory: python -m experiments.scale.larger_than_memory FOLDER SIZES…

Writes rings of so many samples to Parquet files in FOLDER, reconstructs them with one worker whose
address space is limited, compares every edge with the rings, and removes all of it. What the runs
took is kept in results.json beside this file, and docs/scale_report.md is made of it.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from crustline.arrays import IntArray
from crustline.distributed import Result, reconstruct
from crustline.distributed.cluster import ENGINE
from experiments.scale.report import RESULTS, write_page
from experiments.scale.rings import Rings

TILE_POINTS = 150_000
#: Bytes that the worker may hold; 10⁸ points are five times as many, their rows not counted.
LIMIT = 320_000_000
FILE, GROUP = 1_000_000, 100_000


def memory(process: int) -> dict[str, int]:
    """Return bytes of a process: its address space, what is resident, what was at most."""
    status = Path(f"/proc/{process}/status").read_text(encoding="ascii")
    found = re.findall(r"^(VmSize|VmRSS|VmHWM):\s+(\d+)", status, re.MULTILINE)
    return {name: int(kilobytes) * 1024 for name, kilobytes in found}


def limit_to(size: int) -> None:
    """Limit the address space of this process, for good."""
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (size, size))


def write_input(folder: Path, rings: Rings) -> str:
    """Write the samples by row groups; return the pattern of the files' names."""
    import pyarrow as pa
    from pyarrow import parquet

    folder.mkdir(parents=True)
    schema = pa.schema([("x", pa.float64()), ("y", pa.float64())])
    for start in range(0, rings.points, FILE):
        stop = min(start + FILE, rings.points)
        with parquet.ParquetWriter(folder / f"{start // FILE:05}.parquet", schema) as file:
            for first in range(start, stop, GROUP):
                xy = rings.xy(np.arange(first, min(first + GROUP, stop)))
                columns = [pa.array(np.ascontiguousarray(column)) for column in xy.T]
                file.write_batch(pa.record_batch(columns, schema=schema))
    return str(folder / "*.parquet")


class Watch(threading.Thread):
    """Notes what processes hold at most in each stage, from outside."""

    def __init__(self, processes: dict[str, int]) -> None:
        super().__init__(daemon=True)
        self.processes, self.stage, self.peaks = processes, "read", dict[str, dict[str, int]]()

    def run(self) -> None:
        """Look every 20 ms, until the stage is empty or a process has gone."""
        with suppress(OSError):
            while self.stage:
                here = self.peaks.setdefault(self.stage, {})
                for name, process in self.processes.items():
                    here[name] = max(here.get(name, 0), memory(process).get("VmRSS", 0))
                time.sleep(0.02)

    def see(self, stage: str, fraction: float) -> None:
        """Note the stage, as the progress of a run."""
        if stage != self.stage:
            print(f"{time.strftime('%H:%M:%S')} {stage}", flush=True)
        self.stage = stage


def measured(folder: Path, rings: Rings) -> dict[str, Any]:
    """Return what a run takes, and how many edges of the rings it has missed."""
    from dask import config
    from distributed import Client, LocalCluster

    # Else Arrow, and malloc for each thread, set addresses aside that they may never use.
    os.environ |= {"ARROW_DEFAULT_MEMORY_POOL": "system", "MALLOC_ARENA_MAX": "1"}
    source, few = write_input(folder / "in", rings), write_input(folder / "few", Rings(40))
    with (
        config.set(ENGINE),
        LocalCluster(
            n_workers=1, threads_per_worker=1, memory_limit=None, dashboard_address="127.0.0.1:0"
        ) as cluster,
        Client(cluster) as client,
    ):
        reconstruct(few, folder / "warm", client=client, tile_points=2000)
        (worker,) = client.run(os.getpid).values()
        warm = memory(worker)
        client.run(limit_to, warm["VmSize"] + LIMIT - warm["VmRSS"])
        watch = Watch({"worker": worker, "client": os.getpid()})
        watch.start()
        start = time.perf_counter()
        result = reconstruct(
            source, folder / "out", client=client, tile_points=TILE_POINTS, progress=watch.see
        )
        wall = time.perf_counter() - start
        watch.stage = ""
        peak = memory(worker)["VmHWM"]
    checked = {"missing": rings.missing(edges_in(result)), "open": open_curves(result)}
    stages = {name: rounded(stage) for name, stage in result.report["stages"].items()}
    about: dict[str, Any] = {
        "points": rings.points,
        "tile_points": TILE_POINTS,
        "limit": LIMIT,
        "peak": peak,
    }
    about |= {"warm": warm["VmRSS"], "wall": round(wall), "load": round(os.getloadavg()[2], 1)}
    return about | {"counts": result.counts, "stages": stages, "peaks": watch.peaks} | checked


def rounded(stage: dict[str, Any]) -> dict[str, Any]:
    """Return what the page tells of a stage."""
    about = {name: stage[name] for name in ("steps", "cpu", "files", "bytes")}
    seen = {name: stage.get(name, 0) for name in ("halo", "points", "open_vertices", "open_edges")}
    return about | {name: count for name, count in seen.items() if count}


def edges_in(result: Result) -> Iterator[IntArray]:
    """Yield the edges of each tile."""
    from pyarrow import parquet

    for path in sorted((result.folder / "edges").glob("*.parquet")):
        table = parquet.read_table(path)
        yield np.stack([table[name].to_numpy() for name in ("i", "j")], axis=1)


def open_curves(result: Result) -> int:
    """Return how many curves are no rings."""
    from pyarrow import parquet

    files = [path for name in ("curves", "long") for path in (result.folder / name).iterdir()]
    closed = (parquet.read_table(path, columns=["closed"])["closed"].to_numpy() for path in files)
    return sum(int(np.count_nonzero(~each)) for each in closed)


def main(folder: Path, sizes: list[int]) -> None:
    """Measure runs, note them, and make the page."""
    if folder.exists():
        sys.exit(f"{folder} is there already: give a new folder")
    for size in sizes:
        try:
            run = measured(folder, Rings(size // 500))
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        known = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else []
        runs = [each for each in known if each["points"] != run["points"]] + [run]
        runs.sort(key=lambda each: each["points"])
        RESULTS.write_text(json.dumps(runs, indent=1) + "\n", encoding="utf-8")
        write_page(runs)


if __name__ == "__main__":
    main(Path(sys.argv[1]), [int(float(size)) for size in sys.argv[2:]])
