"""Turn what is stored into docs/benchmarks.md and its plot: `python -m benchmarks.table`."""

import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from .measure import Result, ratio
from .nearly_degenerate import TASKS, worst
from .plot import plot
from .results import AFTER_CRUST, CONNECT, LIMITS, NEARLY_DEGENERATE, TILES, Results, load
from .rivals import CGAL_DELAUNAY, CONTENDERS, CRUST, DELAUNAY, OURS, Contender
from .targets import MILLION, Target, targets

DOCS = Path(__file__).parent.parent / "docs"
#: Points whose crust caches hold.
IN_CACHE = 10_000
#: What is said of the run, not of the machine.
OF_A_RUN = ("date", "load")

INTRODUCTION = """\
# Benchmarks

What `python -m benchmarks.table` makes of `benchmarks/results.json`, and nothing else; a test
compares. A family, which is a distribution of points or another kind of figures, is measured in one
run on one machine, by itself (`python -m benchmarks.run curves`) or with all others (`make bench`).

Each contender is a process of its own that holds the points in memory. A turn runs every
contender once (short work is repeated until it takes 20 ms), and five turns follow one another, A
B C … A B C …; a time is the median of the turns, a ratio the median of the ratios of two times
*of the same turn*, so that a slow minute of the machine hits both. The clock runs from the points
in the contender's own form to its own form of the answer: reading the file and freeing the answer
are not counted. Peak memory is the highest resident size during the first run, less the resident
size before it. "crust" is the whole call `crustline.crust`, NumPy array in, edges out; "two
passes" is the paper's recipe, a triangulation of the points and then of them and their Voronoi
vertices. All contenders but crustline use one thread.
"""
AGREEMENT = """\
In general position there is one Delaunay triangulation and one crust, and the edges of every
contender are compared with CGAL's, row by row; what is counted are edges that one of the two has
and the other has not. CGAL's two-pass crust rounds the Voronoi vertices to doubles. A lattice,
one circle and repeated points have many triangulations, and the two-pass recipe breaks ties by
accident: there the number of edges of crustline's crust is held against the definition (lattice:
all unit edges; one circle: its n sides; line: n − 1; all equal: none; all but one equal: one).
"""
AFTER = """\
What else samples of curves have, a million of them on all cores: the crust from the points, and
the rest from the triangulation and the edges that it leaves. The certificate uses the interpolant
that the local feature size was measured on.
"""
NEARLY = """\
Processor time on one thread of 10⁵ points at relative distances from one ulp to 10⁻⁶, over that of
the same task on points that are made the same way at a distance of 10⁻²: the largest ratio over
the distances, and where it was. Each is the median of three turns.
"""
IN_TILES = """\
Curve samples, four million of them, as one piece on one thread and in tiles of a million, to edges
and curves: seconds of processors, from the reports of the runs. Reading the input is not counted,
reading and writing the files of the run is told apart.
"""
BESIDE = """\
`connect` and `crust` of the same points, each from the points with its own triangulation, one
thread, in a process of its own; ratios are medians of those of the same turn. The last but one is
that of a circle of 100,000 points with its center, which sees them all, to the circle alone.
"""
FLOOR = "What a million points cost at least, beside what crustline takes for them on one thread:\n"
CACHE = """\
Times the time of one CGAL triangulation in the same turn. In parentheses: what crustline's crust
holds at its peak, its input included, against the last cache that the machine's table gives. What
waits for memory is counted as the part of the time for a point by which it is longer than at 10,000
points, which caches hold; the depth of the division grows, too, so that it is less than that.
"""
LOAD = """\
The load is that of the minute before, in processes that want to run: where it is not small beside
the cores, the machine did other work meanwhile, seconds are too many, and ratios are what to read.
Of runs without a load medians of three digits are all that was kept, and ratios are theirs.
"""


def publish() -> None:
    """Write the page and its plot."""
    results = Results(load())
    DOCS.mkdir(exist_ok=True)
    plot(results, DOCS / "benchmarks.svg")
    (DOCS / "benchmarks.md").write_text(page(results), encoding="utf-8")


def page(results: Results) -> str:
    """Return the page as Markdown."""
    size = min(MILLION, max((result.size for result in results.all), default=0))
    return "\n".join(
        [
            INTRODUCTION,
            *machines(results),
            LOAD,
            "![Seconds by points](benchmarks.svg)\n",
            "## Targets\n",
            markdown(
                ["target", "at most", "measured", ""],
                map(target_row, targets(results)),
            ),
            f"## Seconds for {size:,} points\n",
            "In parentheses: times one CGAL triangulation of the same points.\n",
            by_distribution(results, size, lambda result: with_ratio(results, result)),
            f"## Processor seconds for {size:,} points\n",
            by_distribution(results, size, lambda result: seconds(result.processor_seconds)),
            f"## Peak memory, bytes a point over the input, {size:,} points\n",
            by_distribution(results, size, lambda result: f"{result.peak_bytes / result.n:.0f}"),
            "## In cache and out of it\n",
            CACHE,
            *(in_and_out_of_cache(results, distribution) for distribution in results.distributions),
            "## Seconds by the number of points\n",
            *(by_size(results, distribution) for distribution in results.distributions),
            "## After the crust\n",
            AFTER,
            markdown(["", "seconds"], after_rows(results.seconds(AFTER_CRUST))),
            "## Nearly degenerate points\n",
            NEARLY,
            markdown(["", *TASKS], nearly_rows(results.seconds(NEARLY_DEGENERATE))),
            "## In tiles\n",
            IN_TILES,
            markdown(["", "processor seconds"], tile_rows(results.seconds(TILES))),
            "## connect beside the crust\n",
            BESIDE,
            markdown(["", "measured"], connect_rows(results.seconds(CONNECT))),
            "## Where crustline loses\n",
            bullets(losses(results)) or "Nowhere in this run.\n",
            "## Agreement\n",
            AGREEMENT,
            by_distribution(results, size, difference),
            "## Left out\n",
            bullets(left_out(results)) or "Nothing.\n",
            "## Limits\n",
            FLOOR,
            markdown(["", "seconds"], limit_rows(results, results.seconds(LIMITS))),
        ]
    )


def machines(results: Results) -> Iterator[str]:
    """Yield each machine, with the families that were measured on it, and when."""
    families: dict[str, list[str]] = {}
    for name, family in results.families.items():
        lasting = {what: said for what, said in family["machine"].items() if what not in OF_A_RUN}
        families.setdefault(json.dumps(lasting), []).append(name)
    for machine, names in families.items():
        yield markdown(["machine", ""], json.loads(machine).items())
        runs = ((name, results.families[name]["machine"]) for name in names)
        rows = ([name, *(machine[what] for what in OF_A_RUN)] for name, machine in runs)
        yield markdown(["family", *OF_A_RUN], rows)


def markdown(head: list[str], rows: Iterable[Iterable[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def bullets(lines: Iterable[str]) -> str:
    return "".join(f"- {line}\n" for line in lines)


def seconds(value: float) -> str:
    """Three digits, in the unit that needs no zeros."""
    for unit, scale in (("s", 1), ("ms", 1e3), ("µs", 1e6)):
        if value * scale >= 1:
            return f"{value * scale:#.3g} {unit}".replace(". ", " ")
    return f"{value * 1e9:.0f} ns"


def line(result: Result) -> str:
    """Return what is printed while measuring."""
    place = f"{result.distribution}, {result.n:,} points, {result.label}:"
    if result.note:
        return f"{place} {result.note}"
    bytes_a_point = f"{result.peak_bytes / result.n:.0f} bytes a point"
    return f"{place} {seconds(result.seconds)}, {bytes_a_point}, {difference(result)}"


def target_row(target: Target) -> list[str]:
    measured = "" if target.measured is None else f"{target.measured:.4g}{target.unit}"
    return [target.text, f"{target.bound:g}{target.unit}", measured, target.verdict]


def by_distribution(results: Results, size: int, cell: Callable[[Result], str]) -> str:
    """One row for each contender, one column for each distribution."""
    columns = [name for name in results.distributions if (name, size) in results.places]
    return markdown(
        ["", *columns],
        (
            [c.label, *(shown(results, name, size, c, cell) for name in columns)]
            for c in results.contenders
        ),
    )


def by_size(results: Results, distribution: str) -> str:
    """One row for each contender, one column for each size."""
    columns = sorted(size for name, size in results.places if name == distribution)
    rows = (
        [
            c.label,
            *(
                shown(results, distribution, size, c, lambda r: seconds(r.seconds))
                for size in columns
            ),
        ]
        for c in results.contenders
    )
    return markdown([distribution, *(f"{size:,}" for size in columns)], rows)


def in_and_out_of_cache(results: Results, distribution: str) -> str:
    """One row for each contender of ours, one column for each size: times CGAL's triangulation."""
    found = [
        (size, crust)
        for name, size in sorted(results.places)
        if name == distribution
        and results.find(name, size, CGAL_DELAUNAY)
        and (crust := results.find(name, size, CRUST))
    ]
    if len(found) < 2:
        return ""
    heads = (f"{size:,}{held(crust)}" for size, crust in found)
    rows = (
        [ours.label, *(times_cgal(results, distribution, size, ours) for size, _ in found)]
        for ours in OURS
    )
    waits = ["waits for memory", *(waiting(results, crust) for _, crust in found)]
    return markdown([distribution, *heads], [*rows, waits])


def waiting(results: Results, crust: Result) -> str:
    """Return by which part of it the time for a point is longer than at few of them."""
    few = results.find(crust.distribution, IN_CACHE, CRUST)
    if few is None or crust.n <= few.n:
        return ""
    return f"{max(0.0, 1 - few.seconds / few.n / (crust.seconds / crust.n)):.0%}"


def held(result: Result) -> str:
    """Return the bytes at the peak, the input included, where they were measured."""
    megabytes = (result.peak_bytes + 16 * result.n) / 1e6
    return f" ({megabytes:.1f} MB)" if result.peak_bytes else ""


def times_cgal(results: Results, distribution: str, size: int, contender: Contender) -> str:
    relation = results.ratio(distribution, size, contender, CGAL_DELAUNAY)
    return "" if relation is None else f"{relation:.2f}"


def shown(
    results: Results,
    distribution: str,
    size: int,
    contender: Contender,
    cell: Callable[[Result], str],
) -> str:
    result = results.index.get((distribution, size, contender.label))
    if result is None:
        return ""
    if result.note:
        return "too slow" if result.note.startswith("too slow") else "fails"
    return cell(result)


def with_ratio(results: Results, result: Result) -> str:
    reference = results.find(result.distribution, result.size, CGAL_DELAUNAY)
    relation = f" ({ratio(result, reference):.2f})" if reference else ""
    return seconds(result.seconds) + relation


def difference(result: Result) -> str:
    if result.edges is None:
        return "not compared"
    edges = f"{result.edges:,} edges"
    return edges if result.differing is None else f"{edges}, {result.differing:,} differ"


def losses(results: Results) -> Iterator[str]:
    """Yield where a rival takes less time for the same task than crustline on one thread."""
    for distribution, size in results.places:
        for rival in (c for c in CONTENDERS if c not in OURS):
            ours = CRUST if rival.task == "crust" else DELAUNAY
            relation = results.ratio(distribution, size, ours, rival)
            if relation is not None and relation > 1:
                place = f"{distribution}, {size:,} points, {rival.task}"
                yield f"{place}: crustline takes {relation:.2f} × the time of {rival.name}."


def left_out(results: Results) -> Iterator[str]:
    for name, family in results.families.items():
        for label, reason in family.get("absent", {}).items():
            yield f"{name}, {label}: {reason}"
    for result in results.all:
        if result.note:
            yield f"{result.distribution}, {result.size:,} points, {result.label}: {result.note}"


def after_rows(after_crust: dict[str, float]) -> Iterator[list[str]]:
    for task, value in after_crust.items():
        if not task.startswith("ratio"):
            yield [f"`{task}`", seconds(value)]


def nearly_rows(ratios: dict[str, float]) -> Iterator[list[str]]:
    for kind, tasks in worst(ratios):
        yield [kind, *(f"{ratio:.1f} ({distance})" for ratio, distance in tasks)]


def tile_rows(figures: dict[str, float]) -> Iterator[list[str]]:
    for what, value in figures.items():
        if what not in ("ratio", "coordinator"):
            yield [what, seconds(value)]


def connect_rows(connect: dict[str, float]) -> Iterator[list[str]]:
    for text, value in connect.items():
        if text.endswith("ratio"):
            yield [text, f"{value:.2f}"]
        elif text.endswith("bytes a point"):
            yield [text, f"{value:.0f}"]
        else:
            yield [text, seconds(value)]


def limit_rows(results: Results, limits: dict[str, float]) -> Iterator[list[str]]:
    for text, value in limits.items():
        yield [text, seconds(value)]
    for distribution in ("uniform", "curves"):
        for contender in (DELAUNAY, CRUST):
            result = results.find(distribution, MILLION, contender)
            if result:
                yield [f"{contender.label}, {distribution}", seconds(result.seconds)]


if __name__ == "__main__":
    publish()
