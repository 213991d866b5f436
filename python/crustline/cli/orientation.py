"""How curves run in what a command writes: --orient and --start."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from crustline.cli.hints import Command
from crustline.cli.sections import headed
from crustline.errors import InputError
from crustline.orientation import COMPASS, ORIENTATIONS

if TYPE_CHECKING:
    from crustline.curves import Curves


@dataclass(frozen=True)
class Orientation:
    """The rule for rings, and where curves start, as `Curves.oriented` takes them."""

    orient: str | None
    start: Any

    def of(self, curves: Curves, project: str | None) -> Curves:
        """Return curves that run so, on the map that they were found on."""
        if (self.orient, self.start, project) == (None, None, None):
            return curves
        return curves.oriented(self.orient, start=self.start, crs=project)


@headed("Output")
def orientation_options(command: Command) -> Command:
    """Give a command --orient and --start; it takes `orientation: Orientation`."""

    @click.option(
        "--orient", type=click.Choice(list(ORIENTATIONS)),
        help="How rings run: all counter-clockwise (ccw, the default) or clockwise (cw); shells "
        "ccw and holes cw (rfc7946), or the other way round, as in Shapefiles (gis).",
    )  # fmt: skip
    @click.option(
        "--start", metavar="WHERE", callback=_start,
        help=f"Where curves start: near X,Y, at a row, or farthest {', '.join(COMPASS)}.",
    )  # fmt: skip
    @functools.wraps(command)
    def run(orient: str | None, start: Any, **rest: Any) -> None:
        command(orientation=Orientation(orient, start), **rest)

    return run


def _start(context: click.Context, option: click.Parameter, value: str | None) -> Any:
    """Return a place, a row or a word."""
    if value is None or value in COMPASS:
        return value
    if value.strip().isdecimal():
        return int(value)
    try:
        x, y = map(float, value.split(","))
    except ValueError:
        words = ", ".join(COMPASS)
        raise InputError(f"--start is {value!r:.40}: give X,Y, a row, or one of {words}") from None
    return x, y
