"""The contenders: crustline and its rivals, each a process that answers requests over pipes.

A contender in Python is a module here with `METHODS`: for each method, the work that is timed, from
points to any answer, and the edges of that answer. Programs in other languages are in `cgal/` and
`rust/`. All speak the protocol of `serve.py`.
"""

import sys
from dataclasses import dataclass, replace
from typing import Literal

from ..data import BUILD

Task = Literal["delaunay", "crust"]


@dataclass(frozen=True)
class Contender:
    """A name for the tables, what it computes, and the command; the path of points follows.

    `threads` is how many rayon is to use; the others have one.
    """

    name: str
    task: Task
    command: tuple[str, ...]
    threads: int = 1

    @property
    def label(self) -> str:
        return f"{self.name}, {self.task}"


def python(name: str, task: Task, module: str, method: str) -> Contender:
    command = (sys.executable, "-m", "benchmarks.rivals.serve", module, method)
    return Contender(name, task, command)


def crustline(task: Task, threads: int) -> Contender:
    plural = "s" * (threads > 1)
    name = f"crustline, {threads} thread{plural}"
    return replace(python(name, task, "crustline", task), threads=threads)


CGAL = str(BUILD / "cgal")
RUST = str(BUILD / "rust" / "release" / "rivals")

CRUST, CRUST_2 = crustline("crust", 1), crustline("crust", 2)
DELAUNAY, DELAUNAY_2 = crustline("delaunay", 1), crustline("delaunay", 2)
OURS = (CRUST, CRUST_2, DELAUNAY, DELAUNAY_2)
CGAL_DELAUNAY = Contender("CGAL", "delaunay", (CGAL, "delaunay"))
CGAL_CRUST = Contender("CGAL, two passes", "crust", (CGAL, "crust"))

# In the order of a turn: those that the targets compare are neighbors.
CONTENDERS = (
    CRUST,
    CGAL_DELAUNAY,
    CRUST_2,
    CGAL_CRUST,
    DELAUNAY,
    DELAUNAY_2,
    python("Triangle", "delaunay", "triangle", "delaunay"),
    Contender("spade", "delaunay", (RUST, "spade")),
    Contender("delaunator", "delaunay", (RUST, "delaunator")),
    python("CDT", "delaunay", "cdt", "delaunay"),
    python("GEOS (shapely)", "delaunay", "shapely", "delaunay"),
    python("Qhull (scipy)", "delaunay", "scipy", "delaunay"),
    python("Qhull (scipy), two passes", "crust", "scipy", "crust"),
)
