"""Serve a contender called from Python: `python -m benchmarks.rivals.serve MODULE METHOD FILE`.

Requests come as lines on standard input, answers go as JSON to standard output:

- on start it loads the file, raw pairs of float64, and answers `{"points": n}`;
- `run K`: do the work K times; mean seconds of `wall` and `cpu`, without reading or freeing;
- `edges PATH`: do it once more, and write the `edges`, each once, as pairs of int32 rows.
"""

import importlib
import json
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

WARM_UP_POINTS = np.random.default_rng(0).random((20, 2))


def run(work: Callable[[np.ndarray], Any], points: np.ndarray, repeats: int) -> dict[str, float]:
    wall = cpu = 0.0
    for _ in range(repeats):
        wall_start, cpu_start = time.perf_counter(), time.process_time()
        answer = work(points)
        wall += time.perf_counter() - wall_start
        cpu += time.process_time() - cpu_start
        del answer
    return {"wall": wall / repeats, "cpu": cpu / repeats}


def write(edges: np.ndarray, path: str) -> dict[str, int]:
    edges.astype("<i4").tofile(path)
    return {"edges": len(edges)}


def answer(message: dict[str, Any]) -> None:
    print(json.dumps(message), flush=True)


def main(module: str, method: str, path: str) -> None:
    work, edges_of = importlib.import_module(f"benchmarks.rivals.{module}").METHODS[method]
    points = np.fromfile(path, "<f8").reshape(-1, 2)
    work(WARM_UP_POINTS)  # imports, which are not the contender's memory
    answer({"points": len(points)})
    for line in sys.stdin:
        request, argument = line.rstrip("\n").split(" ", 1)
        if request == "run":
            answer(run(work, points, int(argument)))
        else:
            answer(write(edges_of(work(points)), argument))


if __name__ == "__main__":
    main(*sys.argv[1:])
