"""What else a curve has, medial axis, local feature size and certificate, against its crust."""

from collections.abc import Callable
from statistics import median
from time import perf_counter

import numpy as np

from .data import point_file

TURNS = 7
SIZE = 10**6


def after_crust() -> dict[str, float]:
    """Return median seconds for curve samples by task, and the median ratio of the same turn.

    The crust is from the points; the rest from the triangulation and edges that it leaves.
    """
    try:
        import crustline as cl
    except ImportError:
        return {}
    samples = np.fromfile(point_file("curves", SIZE)).reshape(-1, 2)
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
        print(f"{task}: {value:.3f}{'' if task == 'ratio' else ' s'}")
