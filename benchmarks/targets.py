"""The figures that the project set itself, against those measured."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from .data import CRUST_EDGES, DISTRIBUTIONS, HOSTILE
from .measure import Result
from .results import AFTER_CRUST, CONNECT, NEARLY_DEGENERATE, SMALL_CALLS, TILES, Results
from .rivals import CGAL_CRUST, CGAL_DELAUNAY, CRUST, CRUST_2, OURS

MILLION = 10**6


@dataclass(frozen=True)
class Target:
    """What is asked, the bound, and what was measured: None if it was not."""

    text: str
    bound: float
    measured: float | None
    unit: str = ""

    @property
    def verdict(self) -> str:
        if self.measured is None:
            return "not measured"
        return "met" if self.measured <= self.bound else "**not met**"


def largest(values: Iterable[float | None]) -> float | None:
    return max((value for value in values if value is not None), default=None)


def targets(results: Results) -> Iterator[Target]:
    """Yield the targets of the crust, then those of what comes after it, and of tiles."""
    for distribution, contender, bound in (
        ("curves", CRUST, 0.69),
        ("curves", CRUST_2, 0.42),
        ("uniform", CRUST, 0.9),
        ("uniform", CRUST_2, 0.53),
    ):
        measured = results.ratio(distribution, MILLION, contender, CGAL_DELAUNAY)
        text = f"crust of 10⁶ points, {distribution}: {contender.name} / one CGAL triangulation"
        yield Target(text, bound, measured)
    worst = largest(results.ratio(d, MILLION, CRUST, CGAL_DELAUNAY) for d in DISTRIBUTIONS)
    text = f"crust of 10⁶ points, worst distribution: {CRUST.name} / one CGAL triangulation"
    yield Target(text, 1, worst)
    yield Target(
        "crust: 10⁷ points / 10⁶ points", 11.5, growth(results, ("uniform", "curves"), 10 * MILLION)
    )
    yield Target("crust: peak memory over the input", 132, memory(results), " bytes a point")
    yield from of_few(results)
    worst = largest(results.ratio(d, MILLION, CRUST, CGAL_CRUST) for d in DISTRIBUTIONS)
    yield Target("crust of 10⁶ points, worst distribution: / CGAL's two-pass crust", 0.25, worst)
    yield Target(
        "nothing quadratic, worst hostile input: 10⁶ / 10⁵", 20, growth(results, HOSTILE, MILLION)
    )
    yield Target(
        "edges unlike CGAL's (general position), or unlike the definition (ties)",
        0,
        errors(results),
    )
    for kind, key, bound in (("curve samples", "ratio", 2), ("noisy ones", "ratio, noisy", 3)):
        text = f"medial axis, local feature size and certificate of 10⁶ {kind}: / their crust"
        yield Target(text, bound, results.seconds(AFTER_CRUST).get(key))
    yield Target(
        "10⁵ nearly degenerate points, worst kind, task and distance: / in general position",
        10,
        largest(results.seconds(NEARLY_DEGENERATE).values()),
    )
    yield from of_tiles(results.seconds(TILES))
    yield from connect_targets(results.seconds(CONNECT))


def of_tiles(figures: dict[str, float]) -> Iterator[Target]:
    text = "curve samples in tiles of 10⁶: processor time without files / one piece"
    yield Target(text, 1.5, figures.get("ratio"))
    share = figures.get("coordinator")
    text = "curve samples in tiles of 10⁶: points in one place"
    yield Target(text, 100, None if share is None else 1e6 * share, " of 10⁶")


def of_few(results: Results) -> Iterator[Target]:
    yield small_call(results, 10, 8e-6)
    yield small_call(results, 100, 20e-6)
    for name in ("curves", "uniform"):
        measured = results.ratio(name, 1000, CRUST, CGAL_DELAUNAY)
        text = f"crust of 1,000 points, {name}: {CRUST.name} / one CGAL triangulation"
        yield Target(text, 1, measured)
    measured = results.seconds(SMALL_CALLS).get("groups")
    yield Target("crusts of 10,000 groups of 100 points / one of all points", 2, measured)


def connect_targets(connect: dict[str, float]) -> Iterator[Target]:
    """Yield the targets of `connect`."""
    for distribution, bound in (("curves", 4), ("uniform", 8)):
        text = f"connect of 10⁶ points, {distribution}: / their crust, one thread"
        yield Target(text, bound, connect.get(f"{distribution}, ratio"))
    bytes_a_point = (connect.get(f"{name}, bytes a point") for name in ("curves", "uniform"))
    yield Target(
        "connect: peak memory over the input", 400, largest(bytes_a_point), " bytes a point"
    )
    small = connect.get("10 points, connect")
    yield Target("connect of 10 points", 60, small and small * 1e6, " µs")
    text = "connect of a circle of 10⁵ points with its center: / the circle"
    yield Target(text, 2, connect.get("circle and center, ratio"))


def growth(results: Results, distributions: Iterable[str], n: int) -> float | None:
    pairs = ((results.find(d, n, CRUST), results.find(d, n // 10, CRUST)) for d in distributions)
    return largest(a.seconds / b.seconds for a, b in pairs if a and b)


def memory(results: Results) -> float | None:
    found = [results.find(d, n, CRUST) for d in DISTRIBUTIONS for n in (MILLION, 10 * MILLION)]
    return largest(result.peak_bytes / result.n for result in found if result)


def small_call(results: Results, n: int, bound: float) -> Target:
    measured = results.seconds(SMALL_CALLS).get(str(n))
    return Target(f"crust of {n} points", bound * 1e6, measured and measured * 1e6, " µs")


def errors(results: Results) -> int | None:
    """Return how many edges of ours differ from CGAL's, or in number from the definition."""
    ours = {contender.label for contender in OURS}
    return sum_or_none(wrong_edges(result) for result in results.all if result.label in ours)


def wrong_edges(result: Result) -> int | None:
    known = CRUST_EDGES.get(result.distribution)
    if result.differing is not None or result.edges is None:
        return result.differing
    return abs(result.edges - known(result.n)) if known and result.task == "crust" else None


def sum_or_none(values: Iterable[int | None]) -> int | None:
    found = [value for value in values if value is not None]
    return sum(found) if found else None
