"""The command `crustline`: what goes wrong ends in one line and exit code 2, never in a traceback.

A new command is a function under `@commands.command()`; errors, Ctrl-C and pipes are `main`'s.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

import click

from crustline.errors import CrustlineError, InputError

if TYPE_CHECKING:
    from crustline.curves import Curves
    from crustline.delaunay import Delaunay

Progress = Callable[[str, float], None]
_PATIENCE = 0.5  # seconds before a progress bar appears


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command with some arguments, by default those of the process, and exit."""
    try:
        commands.main(args=arguments, prog_name="crustline", standalone_mode=False)
        sys.stdout.flush()
    except (click.Abort, KeyboardInterrupt):
        _exit(130, "interrupted")
    except click.exceptions.Exit as request:
        sys.exit(request.exit_code)
    except click.ClickException as error:
        _exit(2, _advise(error))
    except BrokenPipeError:
        # The reader has gone: nothing to say, and nothing to flush at the end either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        sys.exit(1)
    except MemoryError:
        _exit(2, "there is not enough memory: reconstruct fewer points at once")
    except (CrustlineError, OSError) as error:
        _exit(2, str(error))
    sys.exit(0)


def _exit(code: int, message: str) -> NoReturn:
    line = " ".join(message.split())
    click.echo(f"crustline: {'error: ' if code == 2 else ''}{line}", err=True)
    sys.exit(code)


def _advise(error: click.ClickException) -> str:
    context = error.ctx if isinstance(error, click.UsageError) else None
    advice = f"see {context.command_path} --help" if context else "see crustline --help"
    return f"{error.format_message().rstrip('.')}: {advice}"


def _show_version(context: click.Context, option: click.Parameter, value: bool) -> None:
    if value and not context.resilient_parsing:
        from importlib.metadata import version

        click.echo(f"crustline {version('crustline')}")
        context.exit()


@click.group(invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_version,
    help="Show the version and exit.",
)
@click.pass_context
def commands(context: click.Context) -> None:
    """Turn unordered points into the curves that they were sampled from."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


# crustline methods


@commands.command("methods")
def list_methods() -> None:
    """List the methods, each with a line and its reference."""
    from crustline.methods import METHODS

    for name, method in METHODS.items():
        click.echo(f"{name}\n    {_summary(method)}")
        if reference := _reference(method):
            click.echo(f"    {reference}")


def _summary(method: Callable[..., Any]) -> str:
    return (method.__doc__ or "").strip().split("\n")[0]


def _reference(method: Callable[..., Any]) -> str:
    """Return the first reference of a docstring, as one line."""
    _, _, references = (method.__doc__ or "").partition(".. [1] ")
    reference = references.split("\n\n")[0].split(".. [2] ")[0]
    return " ".join(reference.split())


# crustline reconstruct


@commands.command()
@click.argument("source", metavar="INPUT")
@click.option(
    "-o", "--output", "outputs", multiple=True, metavar="OUTPUT",
    help="A file to write: .geojson, .csv, .tsv, .wkt, .svg or .npz; - is standard output. "
    "Give -o again for another one.",
)  # fmt: skip
@click.option("--method", default="crust", show_default=True, metavar="NAME",
              help="The method; `crustline methods` lists them.")  # fmt: skip
@click.option("--beta", type=float, metavar="B", help="The β of a β-skeleton.")
@click.option(
    "-p", "--parameter", "settings", multiple=True, metavar="NAME=VALUE",
    help="Any parameter of the method, such as alpha=0.5.",
)  # fmt: skip
@click.option("--polygons", is_flag=True,
              help="Write rings as polygons with holes, where the format knows them.")  # fmt: skip
@click.option(
    "--columns", metavar="X,Y",
    help="The columns of x and y (and z): names, or positions from 0.",
)  # fmt: skip
@click.option("--input-format", metavar="F",
              help="csv, tsv, xyz, npy, npz, geojson or wkt, whatever the name says.")  # fmt: skip
@click.option("--output-format", metavar="F",
              help="The format of outputs whose name does not say it, such as -.")  # fmt: skip
@click.option("--crs", metavar="C", help="The CRS of the input, such as EPSG:4326.")
@click.option("--threads", type=click.IntRange(min=1), metavar="N", help="How many threads to use.")
@click.option("--json", "as_json", is_flag=True,
              help="Print the summary as JSON on standard output (on standard error if an "
              "output is -).")  # fmt: skip
@click.option("-q", "--quiet", is_flag=True, help="No summary and no progress bar.")
def reconstruct(
    source: str,
    outputs: tuple[str, ...],
    method: str,
    beta: float | None,
    settings: tuple[str, ...],
    polygons: bool,
    columns: str | None,
    input_format: str | None,
    output_format: str | None,
    crs: str | None,
    threads: int | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Reconstruct the curves through the points of INPUT (- is standard input)."""
    started = time.perf_counter()
    formats = _check_outputs(outputs, output_format)
    chosen, parameters = _method(method, beta, settings)

    from crustline.curves import trace
    from crustline.delaunay import Delaunay
    from crustline.formats import read, write

    pair = None if columns is None else [name.strip() for name in columns.split(",")]
    points = read(source, columns=pair, format=input_format, crs=crs)
    with _progress(quiet) as progress:
        options: dict[str, Any] = {"threads": threads, "progress": progress}
        delaunay = Delaunay(points, **options)
        edges = chosen(delaunay, **parameters, **_accepted(chosen, options))
    curves = trace(points, edges)
    for output, form in zip(outputs, formats, strict=True):
        write(curves, output, format=form, polygons=polygons)

    summary = {"input": source, "method": method, **_count(curves, delaunay)}
    summary |= {"outputs": list(outputs), "seconds": round(time.perf_counter() - started, 3)}
    if as_json:
        click.echo(json.dumps(summary), err="-" in outputs)
    elif not quiet:
        click.echo(_sentence(summary), err=True)


def _check_outputs(outputs: tuple[str, ...], output_format: str | None) -> list[str]:
    """Return the format of each output, before any work is done for one that cannot be written."""
    from crustline.formats import format_of
    from crustline.formats import output_format as find_format
    from crustline.formats.file import check_writable

    for output in outputs:
        check_writable(output)
        if outputs.count(output) > 1:
            raise InputError(f"the output {output!r} is given more than once: give each file once")
    if output_format is not None:
        find_format("-", output_format)
    if output_format is None and "-" in outputs:
        raise InputError("the output - has no name that says its format: add --output-format")
    return [format_of(output, "write") or find_format(output, output_format) for output in outputs]


def _method(
    name: str, beta: float | None, settings: tuple[str, ...]
) -> tuple[Callable[..., Any], dict[str, Any]]:
    """Return a method by its name, with the parameters that were set for it."""
    from crustline.methods import METHODS

    if name not in METHODS:
        raise InputError(f"no method is called {name!r}: choose one of {', '.join(METHODS)}")
    method, parameters = METHODS[name], dict(map(_setting, settings))
    if beta is not None:
        parameters["beta"] = beta
    _check_parameters(name, method, parameters)
    return method, parameters


def _setting(text: str) -> tuple[str, Any]:
    name, equals, value = text.partition("=")
    if not equals or not name:
        raise InputError(f"the parameter {text!r} has no value: write NAME=VALUE")
    try:
        return name, json.loads(value)
    except ValueError:
        return name, value


def _check_parameters(name: str, method: Callable[..., Any], given: dict[str, Any]) -> None:
    from inspect import Parameter, signature

    known = dict(list(signature(method).parameters.items())[1:])
    own = [each for each in known if each not in ("threads", "progress")]
    for each in given:
        if each not in own:
            has = f"it has {', '.join(own)}" if own else "it has none"
            raise InputError(f"the method {name} has no parameter {each!r}: {has}")
    missing = [each for each in own if known[each].default is Parameter.empty and each not in given]
    if missing:
        raise InputError(f"the method {name} needs {missing[0]!r}: add -p {missing[0]}=VALUE")


def _accepted(method: Callable[..., Any], options: dict[str, Any]) -> dict[str, Any]:
    from inspect import signature

    return {name: value for name, value in options.items() if name in signature(method).parameters}


def _count(curves: Curves, delaunay: Delaunay) -> dict[str, int]:
    rings = int(curves.closed.sum())
    return {
        "points": len(curves.points),
        "duplicates": len(delaunay.duplicates),
        "rings": rings,
        "open_curves": len(curves) - rings,
        "branches": len(curves.branches),
        "isolated": len(curves.isolated),
    }


def _sentence(summary: dict[str, Any]) -> str:
    words = ("point", "duplicate", "ring", "open curve", "branch", "isolated point")
    counts = [summary[key] for key in list(summary)[2:8]]
    found = ", ".join(
        f"{count:,} {_plural(word, count)}" for word, count in zip(words, counts, strict=True)
    )
    written = ", ".join("standard output" if each == "-" else each for each in summary["outputs"])
    end = f"wrote {written}" if written else "nothing written: add -o FILE"
    return f"{summary['input']}: {found}; {summary['seconds']:.2f} s; {end}"


def _plural(word: str, count: int) -> str:
    return word if count == 1 else f"{word}es" if word.endswith("ch") else f"{word}s"


# The progress bar


@contextmanager
def _progress(quiet: bool) -> Iterator[Progress | None]:
    """Yield what methods report to: a bar on standard error, if that is a terminal."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    bar = _Bar()
    try:
        yield bar
    finally:
        bar.stop()


class _Bar:
    """A bar that appears when the work turns out to be long; rich is imported only then."""

    def __init__(self) -> None:
        self.started = time.perf_counter()
        self.display: Any = None

    def __call__(self, stage: str, fraction: float) -> None:
        if self.display is None:
            if time.perf_counter() - self.started < _PATIENCE:
                return
            self._start()
        self.display.update(self.task, description=stage, completed=fraction)

    def _start(self) -> None:
        from rich.console import Console
        from rich.progress import Progress

        self.display = Progress(console=Console(stderr=True), transient=True)
        self.task = self.display.add_task("", total=1.0)
        self.display.start()

    def stop(self) -> None:
        if self.display is not None:
            self.display.stop()
