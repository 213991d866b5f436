"""Measure families of figures, and write docs/benchmarks.md: `python -m benchmarks.run [FAMILY …]`.

A family is a distribution of points, "nearly degenerate", "small calls", "connect", "after the
crust", "limits" or "tiles". Each is stored in results.json as soon as it is measured, in the place
of what was stored of it; by default all are measured, which takes most of an hour. With `--quick`,
`--sizes` or `--contenders` the page of what was measured is printed, and nothing is stored.
"""

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict

from . import table
from .after_crust import after_crust
from .build_rivals import available
from .connect import connect_figures
from .data import HOSTILE
from .limits import limits
from .machine import describe
from .measure import Bounds, Result, measure
from .nearly_degenerate import nearly_degenerate
from .results import (
    AFTER_CRUST,
    CONNECT,
    FAMILIES,
    LIMITS,
    NEARLY_DEGENERATE,
    SMALL_CALLS,
    TILES,
    Family,
    Results,
    store,
)
from .rivals import OURS, Contender
from .small_calls import small_calls
from .targets import errors
from .tiles import tiles

FULL = Bounds(turns=5, run_seconds=15, timeout=30)
QUICK = Bounds(turns=5, run_seconds=0.7, timeout=10)
QUICK_FAMILIES = ("uniform", "curves", SMALL_CALLS, LIMITS)

#: The families without contenders: seconds by description.
SECONDS: dict[str, Callable[[], dict[str, float]]] = {
    NEARLY_DEGENERATE: nearly_degenerate,
    SMALL_CALLS: small_calls,
    CONNECT: connect_figures,
    AFTER_CRUST: after_crust,
    LIMITS: limits,
    TILES: tiles,
}


def sizes_of(distribution: str) -> list[int]:
    """Return the numbers of points that a distribution is measured at."""
    if distribution in HOSTILE:
        return [10**k for k in range(4, 7)]
    return [10**k for k in range(3, 8 if distribution in ("uniform", "curves") else 7)]


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
    parser.add_argument("families", nargs="*", metavar="FAMILY", help=", ".join(FAMILIES))
    parser.add_argument("--quick", action="store_true", help="two distributions, to 10⁵ points")
    parser.add_argument("--sizes", nargs="+", type=int, metavar="N", help="print these alone")
    parser.add_argument("--contenders", nargs="+", metavar="NAME", help="print these alone")
    options = parser.parse_args()
    for name in options.families:
        if name not in FAMILIES:
            parser.error(f"{name!r} is no family: name some of {', '.join(FAMILIES)}")
    return options


def contenders_of(options: argparse.Namespace) -> tuple[list[Contender], dict[str, str]]:
    """Return the contenders that are asked for, and why others are absent."""
    contenders, absent = available()
    if options.contenders:
        contenders = [c for c in contenders if c.name.startswith(tuple(options.contenders))]
    return contenders, absent


def families(options: argparse.Namespace) -> Iterator[tuple[str, Family]]:
    """Measure the families that are asked for."""
    contenders, absent = contenders_of(options)
    for name in options.families or (QUICK_FAMILIES if options.quick else FAMILIES):
        machine = describe()
        if name in SECONDS:
            yield name, {"machine": machine, "seconds": SECONDS[name]()}
            continue
        sizes = options.sizes or ([10**3, 10**5] if options.quick else sizes_of(name))
        bounds = QUICK if options.quick else FULL
        results = [asdict(result) for result in run(name, sorted(sizes), contenders, bounds)]
        yield name, {"machine": machine, "absent": absent, "results": results}


def main() -> int:
    options = arguments()
    is_partial = bool(options.quick or options.sizes or options.contenders)
    measured: dict[str, Family] = {}
    for name, family in families(options):
        measured[name] = family
        if not is_partial:
            store(name, family)
    results = Results(measured)
    if is_partial:
        print(table.page(results))
    else:
        table.publish()
    return bool(errors(results))


if __name__ == "__main__":
    sys.exit(main())
