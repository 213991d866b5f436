"""How fast it could be at all: what a million points cost to move, to sort, and to test.

Figures of the core, such as its predicates alone, come from build/limits.json if it is there:
seconds for a million points, by description.
"""

import json
import timeit
from collections.abc import Callable

import numpy as np

from .data import BUILD

N = 1_000_000
BYTES_MOVED = 160  # per point, if the peak memory is written and read once


def limits() -> dict[str, float]:
    """Return seconds for a million points, by description."""
    source = np.random.default_rng(0).integers(2**63, size=16 * N, dtype=np.uint64)
    target = np.empty_like(source)
    copy = best(lambda: np.copyto(target, source)) / (2 * source.nbytes)
    keys = source[:N]
    core = BUILD / "limits.json"
    return {
        f"memory copy at {1e-9 / copy:.1f} GB/s, {BYTES_MOVED} bytes a point": copy
        * BYTES_MOVED
        * N,
        "np.sort of 64-bit keys, one for each point": best(lambda: np.sort(keys)),
        **(json.loads(core.read_text()) if core.exists() else {}),
    }


def best(work: Callable[[], object]) -> float:
    return min(timeit.repeat(work, number=1, repeat=5))


if __name__ == "__main__":
    for description, seconds in limits().items():
        print(f"{seconds:.4f} s  {description}")
