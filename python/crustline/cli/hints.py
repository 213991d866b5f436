"""What is known of the curves, on the command line: --closed, --components, --max-edge, …"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import click

from crustline.cli.sections import headed
from crustline.errors import InputError

Command = Callable[..., None]

NAMES = (
    "closed", "components", "every_point", "junctions", "max_edge", "min_points", "ends",
)  # fmt: skip


@headed("What is known of the curves")
def hint_options(command: Command) -> Command:
    """Give a command the hints that `connect` takes; it takes `hints`, those that were given."""

    @click.option("--closed", is_flag=True, help="All curves are rings.")
    @click.option("--components", type=click.IntRange(min=0), metavar="K",
                  help="There are K curves.")  # fmt: skip
    @click.option("--every-point", is_flag=True, help="No point is left out.")
    @click.option("--junctions", is_flag=True, help="Curves may meet: T, X and Y.")
    @click.option("--max-edge", metavar="LENGTH",
                  help="The longest edge, in the points' unit, or in spacings, as 3x.")  # fmt: skip
    @click.option("--min-points", type=click.IntRange(min=1), metavar="N",
                  help="Leave out curves of fewer points.")  # fmt: skip
    @click.option("--ends", metavar="ROWS",
                  help="Rows of points at which a curve ends, from 0, such as 3,17.")  # fmt: skip
    @functools.wraps(command)
    def run(**options: Any) -> None:
        given = {name: options.pop(name) for name in NAMES}
        hints = {name: value for name, value in given.items() if value not in (None, False)}
        if "max_edge" in hints:
            hints["max_edge"] = _longest(hints["max_edge"])
        if "ends" in hints:
            hints["ends"] = _rows(hints["ends"])
        command(hints=hints, **options)

    return run


def _longest(text: str) -> float | str:
    """Return a length as a number; what counts spacings stays text."""
    try:
        return float(text)
    except ValueError:
        return text


def _rows(text: str) -> list[int]:
    try:
        return [int(row) for row in text.split(",")]
    except ValueError:
        raise InputError(f"--ends {text!r:.40} are no rows: write numbers such as 3,17") from None
