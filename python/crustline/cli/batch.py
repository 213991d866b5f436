"""`crustline batch`: many files of points, each to its curves, several at once."""

from __future__ import annotations

import functools
import glob
import os
import time
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from multiprocessing import get_context
from typing import Any

import click

from crustline.cli.hints import Command
from crustline.cli.method import Method, fit_options, method_options
from crustline.cli.orientation import Orientation, orientation_options
from crustline.cli.output import counted, write_with
from crustline.cli.progress import progress_bar
from crustline.cli.sections import Sectioned, headed
from crustline.cli.source import Source, format_options, reading_options
from crustline.errors import CrustlineError, InputError
from crustline.formats.catalog import format_of_target, options_for
from crustline.formats.target import Target, check_writable


@dataclass(frozen=True)
class _Job:
    """A file to read, the one to write, and how; all of it for another process."""

    source: Source
    output: str
    method: Method
    settings: dict[str, Any]
    orientation: Orientation


@dataclass(frozen=True)
class _Pace:
    """How many files at once, whether to go on after a failure, and whether to say anything."""

    jobs: int | None
    keep_going: bool
    quiet: bool


def _pace_options(command: Command) -> Command:
    """Give a command the options of `_Pace`; it takes `pace`."""

    @click.option("-j", "--jobs", type=click.IntRange(min=1), metavar="N",
                  help="How many files to work on at once; by default one a core.")  # fmt: skip
    @click.option("--keep-going", is_flag=True,
                  help="Do the others if a file fails, and say at the end which did.")  # fmt: skip
    @click.option("-q", "--quiet", is_flag=True, help="No summary and no progress bar.")
    @functools.wraps(command)
    def run(jobs: int | None, keep_going: bool, quiet: bool, **rest: Any) -> None:
        command(pace=_Pace(jobs, keep_going, quiet), **rest)

    return run


@click.command(cls=Sectioned)
@click.argument("names", metavar="INPUT...", nargs=-1, required=True)
@click.option("-o", "--output", "pattern", metavar="PATTERN", required=True,
              help="The files to write, such as out/{stem}.geojson.")  # fmt: skip
@_pace_options
@reading_options
@headed("Output")(format_options("write_curves"))
@orientation_options
@method_options
@fit_options
def batch(
    names: tuple[str, ...],
    pattern: str,
    pace: _Pace,
    source: Source,
    given: dict[str, Any],
    orientation: Orientation,
    method: Method,
) -> None:
    """Find the curves of many files.

    INPUT are files of points, or patterns such as 'sites/*.csv'. Each one's curves are written to a
    file of its own: {stem} in -o stands for its name without folder and suffix.

    \b
        crustline batch goose.csv -o {stem}.geojson
    """
    started = time.perf_counter()
    files = list(_files(names))
    settings = _checked(given, pattern)
    kept = _Job(source, "", method, settings, orientation)
    listed = _jobs(files, pattern, kept)
    done, failed = 0, []
    with progress_bar(pace.quiet) as progress:
        for job, fault in _run(listed, pace.jobs or os.cpu_count() or 1):
            done += 1
            if fault is not None:
                name = job.source.name
                failed.append(fault if fault.startswith(name) else f"{name}: {fault}")
                if not pace.keep_going:
                    break
            if progress is not None:
                progress("files", done / len(listed))
    _report(len(listed), done, failed, time.perf_counter() - started, pace.quiet)


def _files(names: tuple[str, ...]) -> Iterator[str]:
    for name in names:
        found = (
            sorted(glob.glob(name)) if glob.has_magic(name) and not os.path.exists(name) else [name]
        )
        if not found:
            raise InputError(f"no file is called {name!r}: check the pattern")
        yield from found


def _jobs(files: list[str], pattern: str, kept: _Job) -> list[_Job]:
    """Return a job a file: what is kept of all of them, with their names."""
    if "{stem}" not in pattern and len(files) > 1:
        raise InputError(f"-o {pattern!r} is one file: write {{stem}} into it, once for each input")
    outputs = [
        pattern.replace("{stem}", os.path.basename(file).partition(".")[0]) for file in files
    ]
    places = [os.path.realpath(each) for each in (*outputs, *files)]
    for output, place in zip(outputs, places, strict=False):
        check_writable(output)
        if places.count(place) > 1:
            raise InputError(f"{output!r} would be written twice, or is an input: change -o")
    return [
        replace(kept, source=replace(kept.source, name=file), output=output)
        for file, output in zip(files, outputs, strict=True)
    ]


def _checked(given: dict[str, Any], output: str) -> dict[str, Any]:
    chosen = format_of_target(Target(output), None, "write_curves")
    known = {option.name: option for option in options_for("write_curves")}
    for name in given:
        if known[name] not in chosen.options_of("write_curves"):
            raise InputError(f"{known[name].spelling} is not for {chosen.title}: leave it away")
    return {name: known[name].check(value) for name, value in given.items()}


def _run(jobs: list[_Job], workers: int) -> Iterator[tuple[_Job, str | None]]:
    """Yield each job when it is done, and its fault if it has one."""
    if min(workers, len(jobs)) == 1:
        for job in jobs:
            yield job, _work(job)
        return
    # A process that is started anew shares no locks with this one, whatever the system.
    with ProcessPoolExecutor(min(workers, len(jobs)), get_context("spawn")) as pool:
        running: dict[Future[str | None], _Job] = {pool.submit(_work, job): job for job in jobs}
        try:
            for future in as_completed(running):
                yield running[future], future.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _work(job: _Job) -> str | None:
    from crustline.delaunay import Delaunay

    try:
        delaunay = Delaunay(job.source.read(), threads=job.source.threads or 1)
        made = job.method.reconstruction(delaunay)
        curves = job.orientation.of(made.curves, job.method.project)
        write_with(curves, job.output, None, "write_curves", job.settings)
    except (CrustlineError, MemoryError) as error:
        return " ".join(str(error).split()) or "there is not enough memory"
    return None


def _report(total: int, done: int, failed: list[str], seconds: float, quiet: bool) -> None:
    for line in failed:
        click.echo(f"crustline: error: {line}", err=True)
    if not quiet:
        left = f", {total - done:,} not tried: add --keep-going" if done < total else ""
        sentence = f"{counted(done - len(failed), 'file')} done, {len(failed):,} failed{left}"
        click.echo(f"{sentence}; {seconds:.2f} s", err=True)
    if failed:
        raise click.exceptions.Exit(2)
