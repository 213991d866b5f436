"""What `connect` costs beside the crust of the same points, one thread: time and peak memory.

`python -m benchmarks.connect` prints the figures; with a distribution and a number of points it
prints those of one process of its own as JSON, which is how they are measured.
"""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from .data import DISTRIBUTIONS, circle, point_file
from .small_calls import seconds_per_call

SIZE = 10**6
#: Points of the circle whose center is a hub of as many edges.
CIRCLE = 10**5
CIRCLE_AND_CENTER = "circle and center"
TURNS = 5


def connect_figures(size: int = SIZE, on_circle: int = CIRCLE) -> dict[str, float]:
    """Return seconds of both methods, the median ratio of the same turn, and bytes a point."""
    figures: dict[str, float] = {}
    for distribution in ("curves", "uniform"):
        for key, value in _alone(distribution, size).items():
            figures[f"{distribution}, {key}"] = value
    hub, ring = (_alone(what, on_circle) for what in (CIRCLE_AND_CENTER, "one circle"))
    figures |= {f"{CIRCLE_AND_CENTER}, ratio": hub["connect"] / ring["connect"]}
    return figures | _small()


def _small() -> dict[str, float]:
    try:
        from crustline import connect
    except ImportError:
        return {}
    points = np.random.default_rng(0).random((10, 2))
    return {"10 points, connect": seconds_per_call(connect, [points])["10"]}


def _alone(distribution: str, size: int) -> dict[str, float]:
    """Return the figures of one set of points, from a process of its own."""
    command = [sys.executable, "-m", "benchmarks.connect", distribution, str(size)]
    made = subprocess.run(command, capture_output=True, text=True, check=True)
    figures: dict[str, float] = json.loads(made.stdout)
    return figures


def measured(distribution: str, size: int) -> dict[str, float]:
    """Return the figures of one set of points, from here."""
    import crustline as cl

    points = _points(distribution, size)
    bytes_before = _memory("VmRSS", reset=True)
    _seconds(cl.connect, points)
    peak = _memory("VmHWM") - bytes_before
    turns = [[_seconds(method, points) for method in (cl.crust, cl.connect)] for _ in range(TURNS)]
    crust, connect = map(median, zip(*turns, strict=True))
    ratio = median(own[1] / own[0] for own in turns)
    return {
        "crust": crust,
        "connect": connect,
        "ratio": ratio,
        "bytes a point": peak / len(points),
    }


def _points(distribution: str, size: int) -> np.ndarray:
    if distribution == CIRCLE_AND_CENTER:
        return np.concatenate([circle(size, np.random.default_rng(size)), [[0.0, 0.0]]])
    return np.fromfile(point_file(distribution, size)).reshape(-1, 2)


def _seconds(method: Callable[..., object], points: np.ndarray) -> float:
    from crustline import Delaunay

    start = perf_counter()
    method(Delaunay(points, threads=1))
    return perf_counter() - start


def _memory(field: str, *, reset: bool = False) -> int:
    """Return bytes that the system tells of this process; the peak starts anew with `reset`."""
    own = Path("/proc/self")
    if reset:
        (own / "clear_refs").write_text("5")
    lines = (own / "status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith(f"{field}:"))


def main() -> None:
    """Print what is asked for."""
    if len(sys.argv) == 3:
        name, size = sys.argv[1], int(sys.argv[2])
        assert name in (*DISTRIBUTIONS, CIRCLE_AND_CENTER), name
        print(json.dumps(measured(name, size)))
        return
    for description, value in connect_figures().items():
        print(f"{value:.6g}  {description}")


if __name__ == "__main__":
    main()
