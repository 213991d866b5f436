"""Run a command some times while other processes keep every core busy; fail if one run fails.

python tests/fuzz/busy.py 5 .venv/bin/pytest
"""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import time

#: How many others there are, on two cores.
OTHERS = 4


def turn() -> None:
    """Keep a core busy for as long as the one who started it lives."""
    parent = os.getppid()
    while os.getppid() == parent:
        sum(range(1_000_000))


def main() -> None:
    """Run the command, say how each run ended, and fail if one did."""
    runs, *command = sys.argv[1:]
    others = [multiprocessing.Process(target=turn, daemon=True) for _ in range(OTHERS)]
    for other in others:
        other.start()
    failed = 0
    for run in range(1, int(runs) + 1):
        started = time.perf_counter()
        code = subprocess.run(command, check=False).returncode
        failed += code != 0
        load, seconds = os.getloadavg()[0], time.perf_counter() - started
        print(
            f"run {run} of {runs}: exit code {code}, {seconds:.0f} s, load {load:.1f}", flush=True
        )
    for other in others:
        other.terminate()
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
