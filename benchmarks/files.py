"""Reading and writing a million points against what pyogrio and pyarrow alone take.

    python -m benchmarks.files --count 1000000 --runs 5

Both sides take turns in one process; a figure is the median of the processor's time, which tells
more than the clock's on a machine that does other things. The other side gives or takes an Arrow
table with well-known binary: no points, no checks.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pyogrio

import crustline as cl

DRIVERS = {"gpkg": "GPKG", "shp": "ESRI Shapefile", "parquet": ""}
CRS = "EPSG:25832"


def made(count: int) -> cl.Points:
    """Return points with heights and two columns."""
    rng = np.random.default_rng(1)
    columns = {"id": np.arange(count), "quality": rng.random(count)}
    return cl.Points(rng.random((count, 2)) * 1e5, z=rng.random(count), columns=columns, crs=CRS)


def other_read(path: Path) -> tuple[str, Any]:
    """Return the name of the geometries and the table, by pyarrow or pyogrio alone."""
    if path.suffix == ".parquet":
        return "geometry", pq.read_table(path)
    about, table = pyogrio.read_arrow(path)
    return about["geometry_name"] or "wkb_geometry", table


def other_write(path: Path, geometry: str, table: Any) -> None:
    """Write a table, by pyarrow or pyogrio alone."""
    if path.suffix == ".parquet":
        pq.write_table(table, path, compression="zstd")
    else:
        pyogrio.write_arrow(
            table, path, driver=DRIVERS[path.suffix[1:]], geometry_name=geometry,
            geometry_type="Point Z", crs=CRS,
        )  # fmt: skip


def medians(ours: Callable[[], Any], other: Callable[[], Any], runs: int) -> tuple[float, float]:
    """Return the median seconds of the processor of both, taken in turns."""
    taken: tuple[list[float], list[float]] = ([], [])
    for _ in range(runs):
        for work, seconds in zip((ours, other), taken, strict=True):
            started = time.process_time()
            work()
            seconds.append(time.process_time() - started)
    return statistics.median(taken[0]), statistics.median(taken[1])


def main() -> None:
    """Print a line a format and direction."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formats", nargs="*", default=list(DRIVERS))
    parser.add_argument("--count", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=5)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    points = made(given.count)
    with tempfile.TemporaryDirectory() as folder:
        for suffix in given.formats:
            path, again = Path(folder, f"a.{suffix}"), Path(folder, f"b.{suffix}")
            cl.write(points, path)
            geometry, table = other_read(path)
            pairs = {
                "read": (lambda: cl.read(path), lambda: other_read(path)),  # noqa: B023
                "write": (
                    lambda: cl.write(points, path),  # noqa: B023
                    lambda: other_write(again, geometry, table),  # noqa: B023
                ),
            }
            for name, (ours, other) in pairs.items():
                a, b = medians(ours, other, given.runs)
                print(f"{suffix} {name}: {a:.2f} s, {b:.2f} s alone, {a / b:.2f} times", flush=True)


if __name__ == "__main__":
    main()
