"""Many calls in one process: memory stays flat, and eight threads at once change no answer.

    python -m benchmarks.soak --calls 1000000

Calls are of sets of 3 to 3,000 points, most of them small, in general position, on lattices and an
ulp off them; one in 1,009 is of 100,000 points. Memory is looked at ten times.
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from resource import getpagesize
from time import perf_counter

import numpy as np

import crustline as cl

LARGE = 100_000
#: A prime, so that each task has its turn at large sets of each kind.
LARGE_EVERY = 1009
#: Memory may grow by this part after the first tenth of the calls.
GROWTH = 0.05

TASKS: list[Callable[[cl.Delaunay], object]] = [
    cl.crust,
    cl.gabriel,
    cl.nn_crust,
    cl.conservative_crust,
    cl.minimum_spanning_tree,
    lambda delaunay: cl.beta_skeleton(delaunay, 1.7),
    lambda delaunay: cl.trace(delaunay, cl.crust(delaunay)),
    cl.medial_axis,
    cl.certify,
    cl.connect,
]


def sets(seed: int) -> Iterator[np.ndarray]:
    """Yield point sets of mixed sizes and kinds without end."""
    rng = np.random.default_rng(seed)
    number = 0
    while True:
        number += 1
        size = LARGE if number % LARGE_EVERY == 0 else int(3 * 10 ** (3 * rng.random() ** 3))
        points = rng.random((size, 2)) + 1
        kind = number % 3
        if kind:
            points = np.floor(points * 30) / 30
        if kind == 2:
            points = np.nextafter(points, rng.choice([0.0, 3.0], points.shape))
        yield points


def resident() -> int:
    """Return the resident memory in bytes."""
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * getpagesize()


def work(calls: int, seed: int) -> None:
    """Make so many calls."""
    for number, points in zip(range(calls), sets(seed), strict=False):
        delaunay = cl.Delaunay(points, threads=1 if len(points) < LARGE else None)
        TASKS[number % len(TASKS)](delaunay)


def threads_agree(calls: int) -> bool:
    """Do eight threads at once give the answers that they give one after the other?"""
    points = [next(sets(seed)) for seed in range(calls)]
    alone = [cl.crust(p) for p in points]
    with ThreadPoolExecutor(8) as pool:
        together = list(pool.map(cl.crust, points))
    return all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=10**6)
    calls = parser.parse_args().calls
    start, sizes = perf_counter(), []
    for tenth in range(10):
        work(calls // 10, tenth)
        sizes.append(resident())
        seconds = perf_counter() - start
        done = (tenth + 1) * (calls // 10)
        print(f"{done:,} calls, {sizes[-1] / 1e6:.1f} MB, {seconds:.0f} s", flush=True)
    agree = threads_agree(200)
    print("eight threads at once give", "the same" if agree else "SOMETHING ELSE")
    grown = max(sizes[1:]) / sizes[0] - 1
    print(f"memory grew by {grown:.1%} after the first tenth")
    return int(not agree or grown > GROWTH)


if __name__ == "__main__":
    sys.exit(main())
