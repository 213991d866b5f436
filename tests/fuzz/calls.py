"""Call public functions with arguments of every kind, by the million, each call by its number.

    python tests/fuzz/calls.py --count 1000000 --seed 1
    python tests/fuzz/calls.py --seed 1 --only 4711     # one of them again, with its traceback

Each call has five seconds and a gigabyte, and ends in an answer or in one sentence. What does not
becomes a test with its name in `tests/test_hostile.py`.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import tempfile
import time
from itertools import accumulate
from pathlib import Path

if __name__ == "__main__":  # run as a script, it finds its neighbors
    sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[2])]

import hostile
from fuzz.watch import Watch
from hostile import Call

NAMES = sorted(hostile.FUNCTIONS)
#: Functions that look for the medial axis of a smooth curve take a hundred times as long.
SLOW = {
    "SmoothCurve.local_feature_size", "SmoothCurve.medial_axis", "crustline.is_r_sample",
    "crustline.r_sample", "crustline.sample_for_error", "crustline.sampling_ratio",
}  # fmt: skip
WEIGHTS = list(accumulate(0.1 if name in SLOW else 1 for name in NAMES))
PARAMETERS = {
    name: [
        (each.name, each.default is each.empty, hostile.fitting(name, each.name))
        for each in hostile.parameters(function).values()
    ]
    for name, function in hostile.FUNCTIONS.items()
}


def call(number: int, seed: int) -> Call:
    """Return a call: of its arguments most fit, and one or two may not."""
    rng = random.Random(f"{seed} {number}")
    (name,) = rng.choices(NAMES, cum_weights=WEIGHTS)
    arguments = {
        parameter: rng.choice(fits if rng.random() < 0.8 else hostile.HOSTILE)
        for parameter, needed, fits in PARAMETERS[name]
        if needed or rng.random() < 0.4
    }
    return Call(name, hostile.FUNCTIONS[name], arguments)


def fault_of(number: int, seed: int) -> str | None:
    """Return what is wrong with how a call ends, or None if it is an answer or a sentence."""
    made = call(number, seed)
    try:
        hostile.refusal(made)
    except Exception as error:  # whatever it is, it should not be
        return f"{type(error).__name__}: {error!s:.150} in {made!r:.300}"
    return None


def main() -> None:
    """Run the calls."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        if given.only is not None:
            made = call(given.only, given.seed)
            print(made, hostile.refusal(made), sep="\n")
            return
        watch = Watch(lambda number: fault_of(number, given.seed), given.count)
        started, faults = time.perf_counter(), 0
        for number, fault in watch.faults():
            faults += 1
            print(f"{number}: {fault}", flush=True)
        seconds = time.perf_counter() - started
    resident = ", ".join(f"{each >> 20}" for each in watch.resident)
    print(f"{given.count:,} calls, {faults} faults, {seconds:.0f} s, slowest {watch.slowest:.2f} s")
    print(f"resident, in MB: {resident}")
    sys.exit(faults > 0)


if __name__ == "__main__":
    main()
