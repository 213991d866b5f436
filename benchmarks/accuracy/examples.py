"""The outlines of `examples/`, of which is known that the crust is right: they were made so."""

from __future__ import annotations

from pathlib import Path

import crustline as cl

from .families import Case

EXAMPLES = Path(__file__).parents[2] / "examples"
OUTLINES = ("goose", "new_zealand")


def examples() -> list[Case]:
    """Return the outlines; a case is a group of its own."""
    delaunays = {name: cl.Delaunay(cl.read(EXAMPLES / f"{name}.csv")) for name in OUTLINES}
    return [Case(name, name, own.points.xy, cl.crust(own)) for name, own in delaunays.items()]
