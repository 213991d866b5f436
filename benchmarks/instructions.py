"""Count instructions and bytes of the core: `python -m benchmarks.instructions`.

Runs the core's example `crust_once` on one thread and fails if a count is more than 2 % above the
one stored in instructions.json; `--update` stores the counts anew. Instructions are counted by
callgrind: those of the crust with its triangulation and the points' making, those of the medial
axis and the certificate without: what they add to the crust.

Bytes are those that the process holds at its peak, for two numbers of points: what the larger set
takes more is bytes a point, and neither the program nor what a thread holds for its leaves counts,
nor memory that is asked for and not touched.
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
N = 20_000
#: Numbers of points that memory is compared at, so large that its pages do not tell.
FEW, MANY = 500_000, 2_000_000
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
ENVIRONMENT = os.environ | {"RAYON_NUM_THREADS": "1"}


def build_example() -> str:
    """Build the example, and return the path that cargo reports."""
    built = subprocess.run(
        BUILD_EXAMPLE, cwd=HERE.parent, check=True, stdout=subprocess.PIPE, text=True
    )
    messages = map(json.loads, built.stdout.splitlines())
    return str(next(m["executable"] for m in messages if m.get("executable")))


def instructions(program: str, name: str, work: str) -> int:
    """Return how many instructions the program executes."""
    command = (*CALLGRIND, program, name, str(N), "1", work)
    done = subprocess.run(command, env=ENVIRONMENT, check=True, capture_output=True, text=True)
    return int(done.stderr.rpartition("Collected : ")[2].split()[0])


def peak(program: str, name: str, n: int, work: str) -> int:
    """Return the most bytes that the program holds."""
    command = (program, name, str(n), "1", work)
    with subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.DEVNULL) as running:
        _, status, used = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
    if running.returncode:
        raise subprocess.CalledProcessError(running.returncode, command)
    return 1024 * used.ru_maxrss


def counts(program: str) -> dict[str, float]:
    """Return all counts by what is counted: the work, the distribution, the unit."""
    found: dict[str, float] = {}
    for work, distributions in DISTRIBUTIONS.items():
        for name in distributions:
            own = instructions(program, name, work) - found.get(f"crust {name} instructions", 0)
            found[f"{work} {name} instructions"] = own
            few, many = (peak(program, name, n, work) for n in (FEW, MANY))
            found[f"{work} {name} bytes a point"] = round((many - few) / (MANY - FEW), 1)
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
