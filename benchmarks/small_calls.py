"""What a call with few points costs, so that a loop over thousands of groups is fine."""

import timeit
from collections.abc import Callable
from statistics import median

import numpy as np

SIZES = (10, 1000)
LOOP_SECONDS = 0.2


def small_calls() -> dict[str, float]:
    """Return the median seconds of one `crust`, by the number of points."""
    try:
        from crustline import crust
    except ImportError:
        return {}
    rng = np.random.default_rng(0)
    return {str(n): seconds_per_call(crust, rng.random((n, 2))) for n in SIZES}


def seconds_per_call(call: Callable[[np.ndarray], object], points: np.ndarray) -> float:
    timer = timeit.Timer(lambda: call(points))
    loops = max(1, int(LOOP_SECONDS / timer.timeit(1)))
    return median(timer.repeat(5, loops)) / loops


if __name__ == "__main__":
    for size, seconds in small_calls().items():
        print(f"crust of {size} points: {seconds * 1e6:.1f} µs")
