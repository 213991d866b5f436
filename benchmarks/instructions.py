"""Count instructions and bytes of the core, without noise: `python -m benchmarks.instructions`.

Runs the core's example `crust_once` under callgrind and under dhat, on one thread, and fails if a
count is more than 2 % above the one stored in instructions.json; `--update` stores the counts anew.
The crust is counted with its triangulation and the points' making, the medial axis and the
certificate without: what they add to the crust.

Bytes are the most that are allocated at one time, and are counted for two numbers of points: what
the larger set takes more is bytes a point, and the rest of what the smaller set takes is what a
thread holds for its leaves, however many points there are.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
STORED = HERE / "instructions.json"
TOLERANCE = 0.02
N, MORE = 20_000, 60_000
DISTRIBUTIONS = {
    "crust": ("uniform", "curves", "lattice", "circle"),
    "axis": ("uniform", "curves"),
    "certificate": ("uniform", "curves"),
}
BUILD_EXAMPLE = (
    *("cargo", "build", "--release", "--quiet", "--package", "crustline-core"),
    *("--example", "crust_once", "--message-format", "json"),
)
CALLGRIND = ("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null")
DHAT = ("valgrind", "--tool=dhat", "--dhat-out-file=/dev/null")


def build_example() -> str:
    """Build the example, and return the path that cargo reports."""
    built = subprocess.run(
        BUILD_EXAMPLE, cwd=HERE.parent, check=True, stdout=subprocess.PIPE, text=True
    )
    messages = map(json.loads, built.stdout.splitlines())
    return str(next(m["executable"] for m in messages if m.get("executable")))


def report(tool: tuple[str, ...], before: str, *command: str) -> int:
    """Run a program under a tool, and return the number that it reports after `before`."""
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    done = subprocess.run(
        (*tool, *command), env=environment, check=True, capture_output=True, text=True
    )
    return int(done.stderr.rpartition(before)[2].split()[0].replace(",", ""))


def instructions(program: str, name: str, work: str) -> int:
    return report(CALLGRIND, "Collected : ", program, name, str(N), "1", work)


def peak(program: str, name: str, work: str) -> tuple[float, int]:
    """Return the bytes a point at the peak, and the bytes that any number of points take."""
    few, many = (report(DHAT, "At t-gmax: ", program, name, str(n), "1", work) for n in (N, MORE))
    each = (many - few) / (MORE - N)
    return round(each, 2), round(few - N * each)


def counts(program: str) -> dict[str, float]:
    """Return all counts by what is counted: the work, the distribution, the unit."""
    found: dict[str, float] = {}
    for work, distributions in DISTRIBUTIONS.items():
        for name in distributions:
            own = instructions(program, name, work) - found.get(f"crust {name} instructions", 0)
            found[f"{work} {name} instructions"] = own
            each, rest = peak(program, name, work)
            found[f"{work} {name} bytes a point"] = each
            found[f"{work} {name} bytes beside"] = rest
    return found


def is_regression(case: str, counted: float, stored: float | None) -> bool:
    """Print a line for one case, and return whether its count grew past the tolerance."""
    if stored is None:
        print(f"{case}: {counted:,}, none stored; run again with --update")
        return True
    change = counted / stored - 1
    verdict = "FAIL" if change > TOLERANCE else "ok"
    print(f"{case}: {counted:,}, {change:+.2%} of the stored {stored:,}: {verdict}")
    return change > TOLERANCE


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--update", action="store_true", help="store the counts anew")
    update = parser.parse_args().update
    counted = counts(build_example())
    if update:
        STORED.write_text(json.dumps(counted, indent=1) + "\n")
    stored = json.loads(STORED.read_text()) if STORED.exists() else {}
    return sum(is_regression(case, count, stored.get(case)) for case, count in counted.items())


if __name__ == "__main__":
    sys.exit(main())
