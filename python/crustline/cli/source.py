"""The points that a command works on: INPUT, --input-format, --crs, and what formats ask."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from crustline.cli.hints import Command
from crustline.cli.sections import headed
from crustline.formats.catalog import able, options_for
from crustline.formats.format import Format, Option

if TYPE_CHECKING:
    from crustline.curves import Curves
    from crustline.formats.source import Source as Bytes
    from crustline.points import Points


#: Where the context of a command keeps what -v says.
VERBOSE = "crustline.verbose"


def is_verbose() -> bool:
    """Return whether the command that runs was given -v."""
    context = click.get_current_context(silent=True)
    return bool(context and context.meta.get(VERBOSE))


@dataclass(frozen=True)
class Source:
    """A file of points, and what was said about it."""

    name: str
    format: str | None
    crs: str | None
    threads: int | None
    settings: dict[str, Any]

    def read(self, opened: Bytes | None = None) -> Points:
        """Return its points; what was opened keeps notes of how it was understood."""
        from crustline.formats import Source as Opened
        from crustline.formats import read

        opened = opened or Opened(self.name)
        points = read(opened, format=self.format, crs=self.crs, **self.settings)
        if is_verbose():
            for subject, finding in opened.notes.items():
                click.echo(f"crustline: {opened.name}: {subject}: {finding}", err=True)
        return points

    def read_curves(self) -> Curves:
        """Return its lines and rings; of vertices on one spot the first, which all lead through."""
        from crustline.curves import trace
        from crustline.delaunay import Delaunay
        from crustline.formats import read_curves

        curves = read_curves(self.name, format=self.format, crs=self.crs, **self.settings)
        first = np.arange(len(curves.points))
        repeated = Delaunay(curves.points).duplicates
        first[repeated[:, 0]] = repeated[:, 1]
        kept = np.flatnonzero(first == np.arange(len(first)))
        edges = np.searchsorted(kept, first[curves.edges])
        return trace(curves.points.select(kept), edges)


def source_options(command: Command) -> Command:
    """Give a command the argument INPUT and its options; it takes `source: Source`."""

    @click.argument("name", metavar="INPUT")
    @reading_options
    @functools.wraps(command)
    def run(name: str, source: Source, **rest: Any) -> None:
        command(source=replace(source, name=name), **rest)

    return run


@headed("Input")
def reading_options(command: Command) -> Command:
    """Give a command the options of its input alone; it takes `source: Source` without a name."""

    @click.option("--input-format", metavar="F", help=f"{_names()}, whatever the name says.")
    @click.option("--crs", metavar="C", help="The CRS of the input, such as EPSG:4326.")
    @format_options("read")
    @click.option("--threads", type=click.IntRange(min=1), metavar="N",
                  help="How many threads to use.")  # fmt: skip
    @functools.wraps(command)
    def run(
        input_format: str | None,
        crs: str | None,
        threads: int | None,
        given: dict[str, Any],
        **rest: Any,
    ) -> None:
        command(source=Source("", input_format, crs, threads, given), **rest)

    return run


def _names() -> str:
    names = [each.name for each in able("read")]
    return f"{', '.join(names[:-1])} or {names[-1]}"


def format_options(task: str) -> Callable[[Command], Command]:
    """Give a command the options that formats have for a task; it takes `given`."""
    found = options_for(task)

    def decorate(command: Command) -> Command:
        @functools.wraps(command)
        def run(**options: Any) -> None:
            settings = {each.name: options.pop(each.name) for each in found}
            settings = {name: value for name, value in settings.items() if value is not None}
            command(given=settings, **options)

        decorated: Command = run
        for option, formats in reversed(found.items()):
            decorated = _click_option(option, formats)(decorated)
        return decorated

    return decorate


class _TextOption(click.Option):
    heading = "Input of text"


class _ImageOption(click.Option):
    heading = "Input of images"


#: The options of these formats alone are under a heading of their own.
_KINDS = {("csv", "tsv", "xyz"): _TextOption, ("image",): _ImageOption}


def _click_option(option: Option, formats: list[Format]) -> Callable[[Command], Command]:
    names = tuple(each.name for each in formats)
    kind = _KINDS.get(names, click.Option)
    shape: dict[str, Any] = (
        {"metavar": option.metavar}
        if option.metavar
        else {"flag_value": option.constant, "default": None}
    )
    help = f"{option.help} [{', '.join(names)}]"
    return click.option(option.spelling, option.name, cls=kind, help=help, **shape)
