"""`crustline medial-axis`: points to the medial axis of their curves."""

from __future__ import annotations

import functools
import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import click
import numpy as np

from crustline.cli.hints import Command
from crustline.cli.method import Method, fit_options, method_options
from crustline.cli.output import Output, counted, output_options
from crustline.cli.reconstruct import reconstruction
from crustline.cli.sections import Sectioned
from crustline.cli.source import Source, source_options
from crustline.errors import CrustlineError, FormatWarning, InputError
from crustline.scalars import as_length

if TYPE_CHECKING:
    from crustline.medial_axis import MedialAxis


def polygon_options(command: Command) -> Command:
    """Give a command --edges-from-file and --accuracy; it takes `accuracy`, None without them."""

    @click.option("--edges-from-file", is_flag=True,
                  help="Take the rings that the file holds for polygons: the axis is that of their "
                  "sides, the center line, and its inner part.")  # fmt: skip
    @click.option("--accuracy", type=float, metavar="A",
                  help="With --edges-from-file, how far the axis may be off, as a part of the "
                  "local width. [default: 0.01]")  # fmt: skip
    @functools.wraps(command)
    def run(edges_from_file: bool, accuracy: float | None, **rest: Any) -> None:
        if accuracy is not None and not edges_from_file:
            raise InputError("--accuracy is for --edges-from-file: add that")
        command(accuracy=(0.01 if accuracy is None else accuracy) if edges_from_file else None,
                **rest)  # fmt: skip

    return run


def part_options(command: Command) -> Command:
    """Give a command --inner and --outer; it takes `part`, None for both."""

    @click.option("--inner", is_flag=True, help="Only what is inside of the rings.")
    @click.option("--outer", is_flag=True, help="Only what is outside of the rings.")
    @functools.wraps(command)
    def run(inner: bool, outer: bool, **rest: Any) -> None:
        if inner and outer:
            raise InputError(
                "--inner and --outer exclude each other: give neither for the whole axis"
            )
        command(part="inner" if inner else "outer" if outer else None, **rest)

    return run


@click.command("medial-axis", cls=Sectioned)
@source_options
@output_options("write_curves")
@polygon_options
@part_options
@click.option(
    "--prune", "at_least", type=float, default=0.0, metavar="LENGTH",
    help="Leave out what stands for less than this of the curve, in the unit of the points: "
    "the way along the curve between the two samples, less the straight one. [default: 0, "
    "which leaves out nothing]",
)  # fmt: skip
@click.option(
    "--box", metavar="X0,Y0,X1,Y1",
    help="Cut the axis and its rays off at this box. [default: that of the points and a quarter of "
    "its longer side beyond]",
)  # fmt: skip
@method_options
@fit_options
def medial_axis(
    source: Source,
    output: Output,
    accuracy: float | None,
    part: Literal["inner", "outer"] | None,
    at_least: float,
    box: str | None,
    method: Method,
) -> None:
    """Find the medial axis of the curves.

    INPUT is a file of points; - is standard input. Writes the Voronoi edges of the points that no
    edge of the curves belongs to, joined to lines between ends and branches, cut off at a box.

    \b
        crustline medial-axis goose.csv -o axis.geojson --inner --prune 2
        crustline medial-axis lake.wkt --edges-from-file -o axis.wkt --prune 0.5
    """
    corners = None if box is None else _corners(box)
    at_least = as_length("--prune", at_least)
    if accuracy is not None:
        axis = _center_line(source, method, accuracy, part).prune(at_least)
    else:
        with reconstruction(source, method, output.quiet) as made:
            axis = made.medial_axis.prune(at_least)
        _warn_of_polygons(source, axis)
    axis = axis.part(part) if part else axis
    output.write(axis.curves(corners))
    _report(source, method, axis, output)


def _center_line(source: Source, method: Method, accuracy: float, part: str | None) -> MedialAxis:
    from crustline.center_line import center_line
    from crustline.projection import project

    if method.name != "connect" or method.parameters or method.fit or part == "outer":
        raise InputError(
            "--edges-from-file takes the edges of the file, and has their inner axis: leave "
            "--outer, and what is for a method, away"
        )
    curves = source.read_curves()
    if method.project is not None:
        curves = replace(curves, points=project(curves.points, method.project))
    return center_line(curves, accuracy=accuracy)


def _warn_of_polygons(source: Source, axis: MedialAxis) -> None:
    """Say what to add where a file holds polygons, of which the corners alone were looked at."""
    if axis.inner.any() or source.name == "-":
        return
    try:
        closed = source.read_curves().closed.any()
    except CrustlineError:
        return
    if closed:
        warnings.warn(
            f"{source.name}: the file holds rings, and the points on them are too far apart for an "
            "axis: add --edges-from-file for that of their sides",
            FormatWarning,
            stacklevel=2,
        )


def _report(source: Source, method: Method, axis: MedialAxis, output: Output) -> None:
    inside = int(np.count_nonzero(axis.inner))
    counts = {
        "inner_edges": inside,
        "outer_edges": len(axis.edges) - inside,
        "rays": len(axis.ray_origins),
    }
    words = ("inner edge", "outer edge", "ray")
    output.report(
        f"{source.name}: {', '.join(map(counted, counts.values(), words))}",
        {"input": source.name, "method": method.name, "points": len(axis.points), **counts},
    )


def _corners(text: str) -> list[float]:
    try:
        corners = [float(number) for number in text.split(",")]
    except ValueError:
        corners = []
    ordered = len(corners) == 4 and corners[0] < corners[2] and corners[1] < corners[3]
    if not (ordered and np.isfinite(corners).all()):
        raise InputError(f"--box is {text!r}: give the least x, least y, largest x and largest y")
    return corners
