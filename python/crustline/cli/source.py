"""The points that a command works on: INPUT, --columns, --input-format, --crs, --threads."""

from __future__ import annotations

import functools
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from crustline.cli.method import Command

if TYPE_CHECKING:
    from crustline.points import Points


@dataclass(frozen=True)
class Source:
    """A file of points, and what was said about it."""

    name: str
    columns: str | None
    format: str | None
    crs: str | None

    def read(self) -> Points:
        """Return its points."""
        from crustline.formats import read

        columns = self.columns
        pair = None if columns is None else [name.strip() for name in columns.split(",")]
        return read(self.name, columns=pair, format=self.format, crs=self.crs)


def source_options(command: Command) -> Command:
    """Give a command the argument INPUT and its options; it takes `source: Source`."""

    @click.argument("name", metavar="INPUT")
    @click.option(
        "--columns", metavar="X,Y",
        help="The columns of x and y (and z): names, or positions from 0.",
    )  # fmt: skip
    @click.option(
        "--input-format", metavar="F",
        help="csv, tsv, xyz, npy, npz, geojson or wkt, whatever the name says.",
    )  # fmt: skip
    @click.option("--crs", metavar="C", help="The CRS of the input, such as EPSG:4326.")
    @threads_option
    @functools.wraps(command)
    def run(
        name: str, columns: str | None, input_format: str | None, crs: str | None, **rest: Any
    ) -> None:
        command(source=Source(name, columns, input_format, crs), **rest)

    return run


def _set_threads(context: click.Context, option: click.Parameter, value: int | None) -> None:
    # Every part of the core works in rayon's pool, which is made when it is first used.
    if value is not None:
        os.environ["RAYON_NUM_THREADS"] = str(value)


threads_option = click.option(
    "--threads", type=click.IntRange(min=1), metavar="N", help="How many threads to use.",
    expose_value=False, callback=_set_threads,
)  # fmt: skip
