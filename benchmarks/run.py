"""Measure everything: `python -m benchmarks.run` writes docs/benchmarks.md, `--quick` prints it."""

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from . import table
from .after_crust import after_crust
from .build_rivals import available
from .data import DISTRIBUTIONS, HOSTILE
from .limits import limits
from .machine import describe
from .measure import Bounds, Result, measure
from .rivals import OURS, Contender
from .small_calls import small_calls
from .targets import Results, errors

FULL = Bounds(turns=5, run_seconds=15, timeout=30)
QUICK = Bounds(turns=5, run_seconds=0.7, timeout=10)


def plan(quick: bool) -> dict[str, list[int]]:
    """Return the sizes for each distribution."""
    if quick:
        return {name: [10**3, 10**5] for name in ("uniform", "curves")}
    sizes = {name: [10**k for k in range(3, 7)] for name in DISTRIBUTIONS}
    sizes |= {name: [10**k for k in range(4, 7)] for name in HOSTILE}
    for name in ("uniform", "curves"):
        sizes[name].append(10**7)
    return sizes


def run(
    distribution: str, sizes: Sequence[int], contenders: Sequence[Contender], bounds: Bounds
) -> Iterator[Result]:
    """Measure one distribution in growing sizes, leaving out whoever has become too slow."""
    history: dict[str, list[Result]] = {contender.label: [] for contender in contenders}
    for size in sizes:
        notes = {c: reason_to_skip(history[c.label], size, bounds) for c in contenders}
        chosen = [c for c in contenders if c in OURS or notes[c] is None]
        for result in measure(distribution, size, chosen, bounds):
            history[result.label].append(result)
            print(table.line(result), flush=True)
            yield result
        for c in contenders:
            if c not in chosen:
                yield Result(distribution, size, size, c.name, c.task, note=notes[c] or "")


def reason_to_skip(history: Sequence[Result], size: int, bounds: Bounds) -> str | None:
    if not history:
        return None
    last = history[-1]
    if last.note:
        return last.note if "(at" in last.note else f"{last.note} (at {last.size:,} points)"
    expected = expected_seconds(history, size)
    return (
        f"too slow: about {table.seconds(expected)} expected"
        if expected > bounds.run_seconds
        else None
    )


def expected_seconds(history: Sequence[Result], size: int) -> float:
    """Continue the growth seen so far, which is at least linear."""
    last = history[-1]
    growth = size / last.size
    if len(history) > 1:
        growth = max(growth, last.seconds / history[-2].seconds)
    return last.seconds * growth


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="two distributions, to 10⁵ points")
    parser.add_argument("--only", nargs="+", metavar="DISTRIBUTION", help="print these alone")
    parser.add_argument("--sizes", nargs="+", type=int, metavar="N", help="print these alone")
    parser.add_argument("--contenders", nargs="+", metavar="NAME", help="print these alone")
    return parser.parse_args()


def chosen_plan(options: argparse.Namespace) -> dict[str, list[int]]:
    """Return the plan, or what the options say instead."""
    sizes = plan(options.quick)
    chosen = {name: options.sizes or sizes[name] for name in options.only or sizes}
    return {name: sorted(sizes) for name, sizes in chosen.items()}


def main() -> int:
    options = arguments()
    contenders, absent = available()
    if options.contenders:
        contenders = [c for c in contenders if c.name.startswith(tuple(options.contenders))]
    bounds = QUICK if options.quick else FULL
    results = [
        result
        for distribution, sizes in chosen_plan(options).items()
        for result in run(distribution, sizes, contenders, bounds)
    ]
    figures = {
        "machine": describe(),
        "absent": absent,
        "results": [asdict(result) for result in results],
        "small_calls": small_calls(),
        "after_crust": {} if options.quick else after_crust(),
        "limits": limits(),
    }
    if options.quick or options.only or options.sizes or options.contenders:
        print(table.page(figures))
    else:
        table.RESULTS.write_text(json.dumps(figures, indent=1))
        table.publish(figures)
    return bool(errors(Results(results)))


if __name__ == "__main__":
    sys.exit(main())
