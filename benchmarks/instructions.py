"""Count the instructions of the core, which no noise moves: `python -m benchmarks.instructions`.

Runs the core's example `crust_once DISTRIBUTION N` under callgrind, and fails if a count is more
than 5 % above the one stored in instructions.json; `--update` stores the counts anew.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
STORED = HERE / "instructions.json"
TOLERANCE = 0.05
CASES = (("uniform", 20_000), ("curves", 20_000), ("lattice", 20_000), ("circle", 20_000))
BUILD_EXAMPLE = (
    *("cargo", "build", "--release", "--quiet", "--package", "crustline-core"),
    *("--example", "crust_once", "--message-format", "json"),
)
CALLGRIND = ("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null")


def build_example() -> str:
    """Build the example, and return the path that cargo reports."""
    built = subprocess.run(
        BUILD_EXAMPLE, cwd=HERE.parent, check=True, stdout=subprocess.PIPE, text=True
    )
    messages = map(json.loads, built.stdout.splitlines())
    return str(next(m["executable"] for m in messages if m.get("executable")))


def count(program: str, distribution: str, n: int) -> int:
    """Return how many instructions one crust takes, on one thread, the points' making included."""
    command = (*CALLGRIND, program, distribution, str(n))
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    return int(done.stderr.rpartition("Collected : ")[2].split()[0])


def is_regression(case: str, counted: int, stored: int | None) -> bool:
    """Print a line for one case, and return whether its count grew past the tolerance."""
    if stored is None:
        print(f"{case}: {counted:,} instructions, none stored; run again with --update")
        return True
    change = counted / stored - 1
    verdict = "FAIL" if change > TOLERANCE else "ok"
    print(f"{case}: {counted:,} instructions, {change:+.2%} of the stored {stored:,}: {verdict}")
    return change > TOLERANCE


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--update", action="store_true", help="store the counts anew")
    update = parser.parse_args().update
    program = build_example()
    counts = {f"{name} {n}": count(program, name, n) for name, n in CASES}
    if update:
        STORED.write_text(json.dumps(counts, indent=1) + "\n")
    stored = json.loads(STORED.read_text()) if STORED.exists() else {}
    return sum(is_regression(case, counted, stored.get(case)) for case, counted in counts.items())


if __name__ == "__main__":
    sys.exit(main())
