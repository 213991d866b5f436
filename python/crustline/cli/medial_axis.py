"""`crustline medial-axis`: points to the medial axis of their curves."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from crustline.cli.method import Method, fit_options, method_options
from crustline.cli.output import Output, counted, output_options
from crustline.cli.reconstruct import reconstruction
from crustline.cli.source import Source, source_options
from crustline.errors import InputError
from crustline.scalars import as_length

if TYPE_CHECKING:
    from crustline.medial_axis import MedialAxis


@click.command("medial-axis")
@source_options
@output_options("write_curves")
@click.option("--inner", is_flag=True, help="Only what is inside of the rings.")
@click.option("--outer", is_flag=True, help="Only what is outside of the rings.")
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
    inner: bool,
    outer: bool,
    at_least: float,
    box: str | None,
    method: Method,
) -> None:
    """Find the medial axis of the curves.

    INPUT is a file of points; - is standard input. Writes the Voronoi edges of the points that no
    edge of the curves belongs to, joined to lines between ends and branches, cut off at a box.

    \b
        crustline medial-axis goose.csv -o axis.geojson --inner --prune 2
    """
    corners = None if box is None else _corners(box)
    at_least = as_length("--prune", at_least)
    if inner and outer:
        raise InputError("--inner and --outer exclude each other: give neither for the whole axis")
    part = "inner" if inner else "outer" if outer else None
    with reconstruction(source, method, output.quiet) as made:
        axis = _part(made.medial_axis.prune(at_least), part)
    output.write(axis.curves(corners))
    inside = int(np.count_nonzero(axis.inner))
    counts = {
        "inner_edges": inside,
        "outer_edges": len(axis.edges) - inside,
        "rays": len(axis.ray_origins),
    }
    words = ("inner edge", "outer edge", "ray")
    output.report(
        f"{source.name}: {', '.join(map(counted, counts.values(), words))}",
        {"input": source.name, "method": method.name, "points": len(made.points), **counts},
    )


def _part(axis: MedialAxis, part: str | None) -> MedialAxis:
    """Return the axis with its inner or its outer edges only; rays are outer ones."""
    if part is None:
        return axis
    kept = axis.inner if part == "inner" else ~axis.inner
    chosen: dict[str, Any] = {
        name: getattr(axis, name)[kept] for name in ("edges", "samples", "inner")
    }
    if part == "inner":
        rays = ("ray_origins", "ray_directions", "ray_samples")
        chosen |= {name: getattr(axis, name)[:0] for name in rays}
    return replace(axis, **chosen)


def _corners(text: str) -> list[float]:
    try:
        corners = [float(number) for number in text.split(",")]
    except ValueError:
        corners = []
    ordered = len(corners) == 4 and corners[0] < corners[2] and corners[1] < corners[3]
    if not (ordered and np.isfinite(corners).all()):
        raise InputError(f"--box is {text!r}: give the least x, least y, largest x and largest y")
    return corners
