"""What has been measured, family by family: results.json, which the page is made from.

A family is a distribution of points, or another kind of figures. Each is stored with its machine
and its day, so that one can be measured anew without the others.
"""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .data import DISTRIBUTIONS, HOSTILE
from .measure import Result, ratio
from .rivals import CONTENDERS, Contender

RESULTS = Path(__file__).parent / "results.json"
SMALL_CALLS, CONNECT = "small calls", "connect"
AFTER_CRUST, LIMITS, TILES = "after the crust", "limits", "tiles"
NEARLY_DEGENERATE = "nearly degenerate"
OTHERS = (NEARLY_DEGENERATE, SMALL_CALLS, CONNECT, AFTER_CRUST, LIMITS, TILES)
FAMILIES = (*DISTRIBUTIONS, *HOSTILE, *OTHERS)

#: What is stored of a family: its `machine`, and either the `results` of contenders on points and
#: those that were `absent`, or `seconds` (or ratios of them) by description.
Family = dict[str, Any]


class Results:
    """All that is stored, found by what was measured; a contender that failed is not found."""

    def __init__(self, families: Mapping[str, Family]) -> None:
        self.families = {name: families[name] for name in FAMILIES if name in families}
        self.all = list(self._results())
        self.places = list(dict.fromkeys((r.distribution, r.size) for r in self.all))
        self.distributions = list(dict.fromkeys(distribution for distribution, _ in self.places))
        labels = {result.label for result in self.all}
        self.contenders = [contender for contender in CONTENDERS if contender.label in labels]
        self.index = {(r.distribution, r.size, r.label): r for r in self.all}

    def _results(self) -> Iterator[Result]:
        for family in self.families.values():
            for fields in family.get("results", []):
                yield Result(**fields)

    def find(self, distribution: str, size: int, contender: Contender) -> Result | None:
        result = self.index.get((distribution, size, contender.label))
        return None if result is None or result.note else result

    def ratio(self, distribution: str, n: int, one: Contender, other: Contender) -> float | None:
        a, b = self.find(distribution, n, one), self.find(distribution, n, other)
        return ratio(a, b) if a and b else None

    def seconds(self, family: str) -> dict[str, float]:
        """Return the seconds of a family that has no contenders, by description."""
        found: dict[str, float] = self.families.get(family, {}).get("seconds", {})
        return found


def load() -> dict[str, Family]:
    """Return what is stored."""
    families: dict[str, Family] = {}
    if RESULTS.exists():
        families = json.loads(RESULTS.read_text(encoding="utf-8"))
    return families


def store(name: str, family: Family) -> None:
    """Put one family in the place of what was stored of it."""
    families = load() | {name: family}
    lines = (f"{json.dumps(name)}: {text(families[name])}" for name in FAMILIES if name in families)
    RESULTS.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def text(family: Family) -> str:
    """Return a family as JSON, a contender in a line."""
    return json.dumps(family, ensure_ascii=False).replace('{"distribution"', '\n{"distribution"')
