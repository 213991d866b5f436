"""`crustline reconstruct --distributed`: a folder of edges and curves from data in tiles."""

from __future__ import annotations

import functools
import json
import time
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from crustline.cli.hints import Command
from crustline.cli.method import as_method
from crustline.cli.output import counted
from crustline.cli.progress import progress_bar
from crustline.cli.sections import headed
from crustline.cli.source import is_verbose
from crustline.errors import InputError

if TYPE_CHECKING:
    from crustline.distributed import Result

#: Options that mean something to a distributed run; the others are refused.
_UNDERSTOOD = {
    "name", "files", "columns", "method", "beta", "settings", "quiet", "as_json", "verbose",
    "distributed", "scheduler", "memory", "tile_points", "resume",
}  # fmt: skip
_OWN = ("scheduler", "memory", "tile_points", "resume")


@headed("Data larger than memory")
def distributed_options(command: Command) -> Command:
    """Give a command --distributed and what goes with it; such runs do not reach the command."""

    @click.option("--distributed", is_flag=True,
                  help="Work tile by tile, for data larger than memory; -o is a folder, INPUT "
                  "may be a pattern. By crust, unless --method says otherwise.")  # fmt: skip
    @click.option("--scheduler", metavar="URL", help="A Dask scheduler, such as tcp://host:8786.")
    @click.option("--memory", metavar="SIZE", help="The memory to use, such as 8GB.")
    @click.option("--tile-points", type=click.IntRange(min=1), metavar="N",
                  help="About how many points a tile has.")  # fmt: skip
    @click.option("--resume", is_flag=True, help="Go on with the run in the output folder.")
    @functools.wraps(command)
    def run(distributed: bool, **options: Any) -> None:
        own = {name: options.pop(name) for name in _OWN}
        if distributed:
            _reconstruct(own, options)
            return
        given = [name for name, value in own.items() if value]
        if given:
            raise InputError(f"--{given[0].replace('_', '-')} is for --distributed: add that")
        command(**options)

    return run


def _reconstruct(own: dict[str, Any], options: dict[str, Any]) -> None:
    from crustline.distributed import reconstruct

    _refuse_others()
    if len(options["files"]) != 1 or options["files"][0] == "-":
        raise InputError("--distributed writes one folder: give one with -o FOLDER")
    name, folder = options["name"], options["files"][0]
    method = as_method(_method_name(options["method"]), options["beta"], options["settings"], None)
    columns = None if options["columns"] is None else options["columns"].split(",")
    started = time.perf_counter()
    with progress_bar(options["quiet"]) as progress:
        result = reconstruct(
            name, folder, method.function,
            columns=columns, client=own["scheduler"], memory_limit=own["memory"],
            tile_points=own["tile_points"], resume=own["resume"], progress=progress,
            **method.parameters,
        )  # fmt: skip
    seconds = time.perf_counter() - started
    _say(result, {"input": name, "method": method.name, "seconds": round(seconds, 3)}, options)


def _refuse_others() -> None:
    context = click.get_current_context()
    for option in context.command.params:
        told = context.get_parameter_source(option.name or "") is ParameterSource.COMMANDLINE
        if told and option.name not in _UNDERSTOOD:
            raise InputError(f"{option.opts[0]} is not for --distributed: leave one of them out")


def _method_name(name: str) -> str:
    """Return the method that was asked for, or the crust."""
    source = click.get_current_context().get_parameter_source("method")
    return name if source is ParameterSource.COMMANDLINE else "crust"


def _say(result: Result, about: dict[str, Any], options: dict[str, Any]) -> None:
    counts = result.counts
    if options["as_json"]:
        click.echo(json.dumps(about | counts | {"outputs": [str(result.folder)]}))
    elif not options["quiet"]:
        parts = {"row": "rows", "duplicate": "duplicates", "edge": "edges", "curve": "curves",
                 "isolated point": "isolated", "tile": "tiles"}  # fmt: skip
        words = ", ".join(counted(counts[key], word) for word, key in parts.items())
        end = f"{about['seconds']:.2f} s; wrote {options['files'][0]}"
        click.echo(f"{about['input']}: {words}, by {about['method']}; {end}", err=True)
        if is_verbose():
            click.echo(result.summary(), err=True)
