"""What calls with few points cost, and one call with many groups of few."""

import timeit
from collections.abc import Callable, Sequence
from statistics import median
from time import perf_counter

import numpy as np

SIZES = (10, 100, 1000)
#: Rounds of all sizes in turns, so that a slow second of the machine hits each alike.
ROUNDS, LOOP_SECONDS = 51, 0.1
#: Groups, each of `OF` points, beside the same points in one set.
GROUPS, OF, TURNS = 10_000, 100, 5


def small_calls() -> dict[str, float]:
    """Return the median seconds of a `crust` by its number of points, and the ratio of groups."""
    try:
        from crustline import crust
    except ImportError:
        return {}
    rng = np.random.default_rng(0)
    found = seconds_per_call(crust, [rng.random((n, 2)) for n in SIZES])
    return found | {"groups": groups_to_one_set(rng.random((GROUPS * OF, 2)))}


def groups_to_one_set(points: np.ndarray) -> float:
    """Return the median ratio of the time of a crust in each group to that of one of all."""
    from crustline import by_group, crust

    groups = np.repeat(np.arange(GROUPS), OF)
    turns = []
    for _ in range(TURNS):
        start = perf_counter()
        by_group(points, groups, crust)
        middle = perf_counter()
        crust(points)
        turns.append((middle - start) / (perf_counter() - middle))
    return median(turns)


def seconds_per_call(
    call: Callable[[np.ndarray], object], sets: Sequence[np.ndarray]
) -> dict[str, float]:
    """Return the median seconds of a call by its number of points."""
    rounds = [[seconds_of_one(call, points) for points in sets] for _ in range(ROUNDS)]
    medians = map(median, zip(*rounds, strict=True))
    return {str(len(points)): seconds for points, seconds in zip(sets, medians, strict=True)}


def seconds_of_one(call: Callable[[np.ndarray], object], points: np.ndarray) -> float:
    timer = timeit.Timer(lambda: call(points))
    timer.timeit(1)  # Whatever is to be made once.
    loops = max(1, int(LOOP_SECONDS / timer.timeit(1)))
    return timer.timeit(loops) / loops


if __name__ == "__main__":
    for what, value in small_calls().items():
        print(
            f"{what}: {value:.2f}" if what == "groups" else f"{what} points: {value * 1e6:.1f} µs"
        )
