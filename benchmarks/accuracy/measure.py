"""How right an answer is: edges that are right, and points of a degree that no curve has."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from inspect import Parameter

import numpy as np

import crustline as cl
from crustline.methods import METHODS, parameters_of

from .families import JUNCTIONS, Case


@dataclass(frozen=True)
class Score:
    """One answer beside the truth."""

    case: Case
    edges: np.ndarray
    extra: int
    missing: int
    defects: int

    @property
    def exact(self) -> bool:
        """Whether all edges are right and none is missing."""
        return not self.extra and not self.missing

    @property
    def precision(self) -> float:
        """The share of the edges that are right."""
        return 1 - self.extra / max(1, len(self.edges))

    @property
    def recall(self) -> float:
        """The share of the right edges that are there."""
        return 1 - self.missing / max(1, len(self.case.edges))


def parameter_free() -> dict[str, Callable[..., np.ndarray]]:
    """Return the methods of the table that need no parameter."""
    return {
        name: method
        for name, method in METHODS.items()
        if all(each.default is not Parameter.empty for each in parameters_of(method).values())
    }


def score(case: Case, edges: np.ndarray) -> Score:
    """Return how right edges are."""
    found, true = (set(map(tuple, rows.tolist())) for rows in (edges, case.edges))
    degree = np.bincount(edges.ravel(), minlength=len(case.points))
    right = np.bincount(case.edges.ravel(), minlength=len(case.points))
    defects = int((degree != right).sum())
    return Score(case, edges, len(found - true), len(true - found), defects)


def scores(cases: Iterable[Case], names: Iterable[str]) -> dict[str, list[Score]]:
    """Return the scores of methods on cases; each case is triangulated once.

    Where curves meet, `connect` is asked for junctions.
    """
    methods = parameter_free()
    made: dict[str, list[Score]] = {name: [] for name in names}
    for case in cases:
        delaunay = cl.Delaunay(case.points)
        for name, own in made.items():
            meets = name == "connect" and case.group in JUNCTIONS
            own.append(score(case, methods[name](delaunay, **{"junctions": True} if meets else {})))
    return made
