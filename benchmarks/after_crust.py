"""What else a curve has, medial axis, local feature size and certificate, against its crust."""

from collections.abc import Callable
from statistics import median
from time import perf_counter

import numpy as np

from .data import point_file

TURNS = 7
SIZE = 10**6


def after_crust() -> dict[str, float]:
    """Return median seconds by task, and the median ratio of the same turn; noisy samples' last."""
    noisy = of_samples("noisy curves")
    return of_samples("curves") | {f"{task}, noisy": value for task, value in noisy.items()}


def of_samples(distribution: str) -> dict[str, float]:
    """Return the figures of one distribution.

    The crust is from the points; the rest from the triangulation and edges that it leaves.
    """
    try:
        import crustline as cl
    except ImportError:
        return {}
    samples = np.fromfile(point_file(distribution, SIZE)).reshape(-1, 2)
    turns = []
    for _ in range(TURNS):
        turn = {"crust": seconds(cl.crust, samples)}
        delaunay = cl.Delaunay(samples)
        edges = cl.crust(delaunay)
        tasks = (cl.medial_axis, cl.local_feature_size, cl.certify)
        turn |= {task.__name__: seconds(task, delaunay, edges) for task in tasks}
        turn["ratio"] = sum(turn.values()) / turn["crust"] - 1
        turns.append(turn)
    return {task: median(turn[task] for turn in turns) for task in turns[0]}


def seconds(task: Callable[..., object], *arguments: object) -> float:
    start = perf_counter()
    task(*arguments)
    return perf_counter() - start


if __name__ == "__main__":
    for task, value in after_crust().items():
        print(f"{task}: {value:.3f}{'' if task.startswith('ratio') else ' s'}")
