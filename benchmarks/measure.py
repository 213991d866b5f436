"""Measure contenders on one set of points, in turn, and compare their edges."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from math import ceil
from pathlib import Path
from statistics import median

import numpy as np

from .data import GENERAL_POSITION, point_file
from .rivals import CGAL_CRUST, CGAL_DELAUNAY, Contender, Task
from .rivals.edges import distinct_edges
from .worker import ContenderFailedError, Worker

TURN_SECONDS = 0.02  # short work is repeated until a turn takes as long


@dataclass
class Result:
    """One contender on one set of points: seconds per turn, or why there are none."""

    distribution: str
    size: int  # the power of ten that was asked for
    n: int  # the points there are: a lattice has a few less
    contender: str
    task: Task
    wall: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)
    peak_bytes: int = 0
    edges: int | None = None
    differing: int | None = None  # edges that CGAL has and this one not, or the other way round
    note: str = ""

    @property
    def seconds(self) -> float:
        return median(self.wall)

    @property
    def processor_seconds(self) -> float:
        return median(self.cpu)

    @property
    def label(self) -> str:
        return f"{self.contender}, {self.task}"


def ratio(one: Result, other: Result) -> float:
    """Return the median over the turns of the ratio of two times measured in the same turn."""
    return median(a / b for a, b in zip(one.wall, other.wall, strict=True))


@dataclass(frozen=True)
class Bounds:
    """How many turns, how long a run may be expected to take, and how long it may take."""

    turns: int
    run_seconds: float
    timeout: float


def measure(
    distribution: str, size: int, contenders: Sequence[Contender], bounds: Bounds
) -> list[Result]:
    """Run all contenders in turn, A B C … A B C …, then compare their edges."""
    path = point_file(distribution, size)
    n = path.stat().st_size // 16
    results = {c: Result(distribution, size, n, c.name, c.task) for c in contenders}
    with ExitStack() as stack:
        workers = dict(start(results, path, bounds, stack))
        repeats = {c: warm_up(results[c], worker, bounds) for c, worker in workers.items()}
        for _ in range(bounds.turns):
            take_turns(results, workers, repeats)
        compare_edges(results, workers)
    return list(results.values())


def start(
    results: dict[Contender, Result], path: Path, bounds: Bounds, stack: ExitStack
) -> Iterator[tuple[Contender, Worker]]:
    for contender, result in results.items():
        worker = stack.enter_context(closing(Worker(contender, path, bounds.timeout)))
        try:
            worker.wait_for_points()
        except ContenderFailedError as failure:
            result.note = str(failure)
        else:
            yield contender, worker


def warm_up(result: Result, worker: Worker, bounds: Bounds) -> int:
    """Run once for the peak memory; return how many runs fill a turn."""
    try:
        seconds, result.peak_bytes = worker.first_run()
        if seconds["wall"] < TURN_SECONDS:
            seconds = worker.run(1)
    except ContenderFailedError as failure:
        result.note = str(failure)
        return 0
    if seconds["wall"] > bounds.run_seconds:
        result.note = f"too slow: {seconds['wall']:.0f} s, measured once"
    return ceil(TURN_SECONDS / seconds["wall"])


def take_turns(
    results: dict[Contender, Result],
    workers: dict[Contender, Worker],
    repeats: dict[Contender, int],
) -> None:
    for contender, worker in workers.items():
        result = results[contender]
        if result.note:
            continue
        try:
            seconds = worker.run(repeats[contender])
        except ContenderFailedError as failure:
            result.note = str(failure)
        else:
            result.wall.append(seconds["wall"])
            result.cpu.append(seconds["cpu"])


def compare_edges(results: dict[Contender, Result], workers: dict[Contender, Worker]) -> None:
    """Count the edges of each contender, and in general position those that differ from CGAL's."""
    keys: dict[Contender, np.ndarray] = {}
    for contender, worker in workers.items():
        result = results[contender]
        if result.note:
            continue
        try:
            edges = worker.edges()
        except ContenderFailedError:
            continue  # then the tables hold no number of edges
        result.edges = len(edges)
        if result.distribution in GENERAL_POSITION:
            keys[contender] = edge_keys(edges, result.n)
    for contender, mine in keys.items():
        theirs = keys.get(CGAL_CRUST if contender.task == "crust" else CGAL_DELAUNAY)
        if theirs is not None:
            results[contender].differing = len(np.setxor1d(mine, theirs, assume_unique=True))


def edge_keys(edges: np.ndarray, n: int) -> np.ndarray:
    low, high = distinct_edges(edges, n).T
    return np.asarray(low * n + high)
