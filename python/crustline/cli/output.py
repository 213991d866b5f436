"""What a command writes and says: -o, --output-format, --json, -q, and what formats ask."""

from __future__ import annotations

import functools
import json
import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import click

from crustline.cli.hints import Command
from crustline.cli.sections import headed
from crustline.cli.source import VERBOSE, format_options
from crustline.errors import InputError
from crustline.formats.catalog import able, format_of_target, options_for, suffixes_for
from crustline.formats.format import Format
from crustline.formats.target import Target, check_writable


@dataclass(frozen=True)
class Output:
    """Files to write, each with its format, and how to say what was done."""

    files: dict[str, str]
    as_json: bool
    quiet: bool
    task: str = ""
    settings: dict[str, Any] = field(default_factory=dict)
    dry_run: bool = False
    started: float = field(default_factory=time.perf_counter)

    def write(self, thing: Any) -> None:
        """Write a thing to each file, with those of the settings that its format knows."""
        for file, form in self.files.items() if not self.dry_run else ():
            write_with(thing, file, form, self.task, self.settings)

    def report(self, sentence: str, summary: dict[str, Any]) -> None:
        """Say in a line, or as JSON, what was done; both end with the files and the seconds."""
        seconds = time.perf_counter() - self.started
        if self.as_json:
            summary = summary | {"outputs": list(self.files), "seconds": round(seconds, 3)}
            click.echo(json.dumps(summary, allow_nan=False), err="-" in self.files)
        elif not self.quiet:
            names = ("standard output" if each == "-" else each for each in self.files)
            written = ", ".join(names)
            verb = "would write" if self.dry_run else "wrote"
            end = f"{verb} {written}" if written else "nothing written: add -o FILE"
            click.echo(f"{sentence}; {seconds:.2f} s; {end}", err=True)


def write_with(
    thing: Any, file: str, form: str | None, task: str, settings: dict[str, Any]
) -> None:
    """Write a thing to a file, with those of some settings that its format knows."""
    from crustline.formats import write

    chosen = format_of_target(Target(file), form, task)
    known = {option.name for option in chosen.options_of(task)}
    write(thing, file, format=chosen.name, **{k: v for k, v in settings.items() if k in known})


def _files_option(what: str, *, required: bool) -> Callable[[Command], Command]:
    return click.option(
        "-o", "--output", "files", multiple=True, metavar="OUTPUT", required=required,
        help=f"{what} Give -o again for another one.",
    )  # fmt: skip


def output_options(task: str, *, required: bool = False) -> Callable[[Command], Command]:
    """Give a command the options that say where its result goes; it takes `output: Output`.

    `task` is what writes it: "write_points", "write_curves" or "write_splines".
    """
    suffixes = suffixes_for(task)

    @headed("Output")
    def decorate(command: Command) -> Command:
        @_files_option(f"A file to write: {_one_of(suffixes)}; - is stdout.", required=required)
        @click.option(
            "--output-format", metavar="F",
            help="The format of outputs whose name does not say it, such as -.",
        )  # fmt: skip
        @format_options(task)
        @summary_options
        @functools.wraps(command)
        def run(
            files: tuple[str, ...],
            output_format: str | None,
            given: dict[str, Any],
            **rest: Any,
        ) -> None:
            formats = _formats(files, output_format, task)
            _pass_output(command, rest, formats, task, _checked(given, formats, task))

        return run

    return decorate


def picture_options(*suffixes: str, pipe: bool = False) -> Callable[[Command], Command]:
    """The same for pictures, whose format is that of their name alone."""

    @headed("Output")
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
    """Give a command --json, --dry-run, -v and -q, as they are."""
    command = click.option("--dry-run", is_flag=True, help="Do the work, but write nothing.")(
        command
    )
    command = click.option("-v", "--verbose", is_flag=True, expose_value=False, callback=_verbose,
                           help="Say how the input was understood, too.")(command)  # fmt: skip
    command = click.option("-q", "--quiet", is_flag=True, help="No summary and no progress bar.")(
        command
    )
    return click.option(
        "--json", "as_json", is_flag=True,
        help="Print the summary as JSON on standard output (on standard error if an output is -).",
    )(command)  # fmt: skip


def _pass_output(
    command: Command,
    options: dict[str, Any],
    files: dict[str, str],
    task: str = "",
    settings: dict[str, Any] | None = None,
) -> None:
    as_json, quiet, dry = (options.pop(name) for name in ("as_json", "quiet", "dry_run"))
    command(output=Output(files, as_json, quiet, task, settings or {}, dry), **options)


def _verbose(context: click.Context, option: click.Parameter, value: bool) -> None:
    context.meta[VERBOSE] = value


def _checked(settings: dict[str, Any], formats: dict[str, str], task: str) -> dict[str, Any]:
    """Refuse, before any work, a setting that is ill or that no output takes."""
    takers = {option.name: (option, each) for option, each in options_for(task).items()}
    checked = {}
    for name, value in settings.items():
        option, formats_of_it = takers[name]
        names = [each.name for each in formats_of_it]
        if not set(names) & set(formats.values()):
            raise InputError(f"{option.spelling} is for {', '.join(names)}: add such an output")
        checked[name] = option.check(value)
    return checked


def check_files(files: tuple[str, ...]) -> None:
    """Refuse files that cannot be written, before any work is done for them."""
    source = click.get_current_context().params.get("name")
    taken = {_place(source)} if source not in (None, "-") else set()
    for number, file in enumerate(files):
        check_writable(file)
        if file in files[:number] or _place(file) in map(_place, files[:number]):
            raise InputError(f"the output {file!r} is given more than once: give each file once")
        if _place(file) in taken:
            raise InputError(f"the output {file!r} is the input: give another name")


def _place(file: str) -> str:
    """Return where a file really is, whatever links lead to it."""
    return file if file == "-" else os.path.realpath(file)


def _formats(files: tuple[str, ...], output_format: str | None, task: str) -> dict[str, str]:
    check_files(files)
    if output_format is not None:
        format_of_target(Target("-"), output_format, task)
    if output_format is None and "-" in files:
        if len(able(task)) > 1:
            raise InputError("the output - has no name that says its format: add --output-format")
        output_format = able(task)[0].name
    return {file: _format(Target(file), output_format, task).name for file in files}


def _format(target: Target, output_format: str | None, task: str) -> Format:
    """Return the format of a target's name, and of the option only where the name says none."""
    named = target.given != "-" and target.suffix in suffixes_for(task)
    return format_of_target(target, None if named else output_format, task)


def _one_of(words: Sequence[str]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def counted(count: int, word: str) -> str:
    """Return a count and a word, in the plural if it must be: "1 branch", "1,200 branches"."""
    plural = f"{word}es" if word.endswith(("ch", "x")) else f"{word}s"
    plural = plural.replace("vertexes", "vertices")
    return f"{count:,} {word if count == 1 else plural}"
