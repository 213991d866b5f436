"""What a command writes and says: -o, --output-format, --json, -q."""

from __future__ import annotations

import functools
import json
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import click

from crustline.cli.method import Command
from crustline.errors import InputError

CURVES = ".geojson, .csv, .tsv, .wkt, .svg or .npz"
POINTS = ".csv, .tsv, .xyz, .geojson, .wkt, .npy, .npz or .svg"


@dataclass(frozen=True)
class Output:
    """Files to write, each with its format, and how to say what was done."""

    files: dict[str, str]
    as_json: bool
    quiet: bool
    started: float = field(default_factory=time.perf_counter)

    def write(self, write: Callable[..., None]) -> None:
        """Call `write(file, format=format)` for each file."""
        for file, form in self.files.items():
            write(file, format=form)

    def report(self, sentence: str, summary: dict[str, Any]) -> None:
        """Say in a line, or as JSON, what was done; both end with the files and the seconds."""
        seconds = time.perf_counter() - self.started
        if self.as_json:
            summary = summary | {"outputs": list(self.files), "seconds": round(seconds, 3)}
            click.echo(json.dumps(summary, allow_nan=False), err="-" in self.files)
        elif not self.quiet:
            names = ("standard output" if each == "-" else each for each in self.files)
            written = ", ".join(names)
            end = f"wrote {written}" if written else "nothing written: add -o FILE"
            click.echo(f"{sentence}; {seconds:.2f} s; {end}", err=True)


def _files_option(what: str, *, required: bool) -> Callable[[Command], Command]:
    return click.option(
        "-o", "--output", "files", multiple=True, metavar="OUTPUT", required=required,
        help=f"{what} Give -o again for another one.",
    )  # fmt: skip


def output_options(
    suffixes: str, task: str = "write", *, required: bool = False
) -> Callable[[Command], Command]:
    """Give a command the options that say where its result goes; it takes `output: Output`.

    `task` is what is written, as for `formats.output_format`: "write" is curves, "write_points"
    points.
    """

    def decorate(command: Command) -> Command:
        @_files_option(f"A file to write: {suffixes}; - is standard output.", required=required)
        @click.option(
            "--output-format", metavar="F",
            help="The format of outputs whose name does not say it, such as -.",
        )  # fmt: skip
        @summary_options
        @functools.wraps(command)
        def run(files: tuple[str, ...], output_format: str | None, **rest: Any) -> None:
            _pass_output(command, rest, _formats(files, output_format, task))

        return run

    return decorate


def picture_options(*suffixes: str, pipe: bool = False) -> Callable[[Command], Command]:
    """The same for pictures, whose format is that of their name alone."""

    def decorate(command: Command) -> Command:
        @_files_option(
            f"A picture to write: {_one_of(suffixes)}{'; - is standard output' * pipe}.",
            required=True,
        )
        @summary_options
        @functools.wraps(command)
        def run(files: tuple[str, ...], **rest: Any) -> None:
            check_files(files)
            for file in files:
                if not (file.lower().endswith(suffixes) or (pipe and file == "-")):
                    raise InputError(f"{file!r} is no picture: name it {_one_of(suffixes)}")
            _pass_output(command, rest, dict.fromkeys(files, ""))

        return run

    return decorate


def summary_options(command: Command) -> Command:
    """Give a command --json and -q, as they are."""
    command = click.option("-q", "--quiet", is_flag=True, help="No summary and no progress bar.")(
        command
    )
    return click.option(
        "--json", "as_json", is_flag=True,
        help="Print the summary as JSON on standard output (on standard error if an output is -).",
    )(command)  # fmt: skip


def _pass_output(command: Command, options: dict[str, Any], files: dict[str, str]) -> None:
    as_json, quiet = options.pop("as_json"), options.pop("quiet")
    command(output=Output(files, as_json, quiet), **options)


def check_files(files: tuple[str, ...]) -> None:
    """Refuse files that cannot be written, before any work is done for them."""
    from crustline.formats.file import check_writable

    for file in files:
        check_writable(file)
        if files.count(file) > 1:
            raise InputError(f"the output {file!r} is given more than once: give each file once")


def _formats(files: tuple[str, ...], output_format: str | None, task: str) -> dict[str, str]:
    from crustline.formats import format_of
    from crustline.formats import output_format as find_format

    check_files(files)
    if output_format is not None:
        find_format("-", output_format, task)
    if output_format is None and "-" in files:
        raise InputError("the output - has no name that says its format: add --output-format")
    return {file: format_of(file, task) or find_format(file, output_format, task) for file in files}


def _one_of(words: tuple[str, ...]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def counted(count: int, word: str) -> str:
    """Return a count and a word, in the plural if it must be: "1 branch", "1,200 branches"."""
    plural = f"{word}es" if word.endswith(("ch", "x")) else f"{word}s"
    return f"{count:,} {word if count == 1 else plural}"
