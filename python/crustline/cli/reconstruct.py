"""`crustline reconstruct`: points to curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from crustline.cli.method import Method, method_options
from crustline.cli.output import Output, counted, output_options
from crustline.cli.progress import progress_bar
from crustline.cli.source import Source, source_options

if TYPE_CHECKING:
    from crustline.arrays import IntArray
    from crustline.curves import Curves
    from crustline.delaunay import Delaunay
    from crustline.points import Points


@click.command()
@source_options
@output_options("write_curves")
@method_options
def reconstruct(source: Source, output: Output, method: Method) -> None:
    """Find the curves that points were sampled from.

    INPUT is a file of points; - is standard input. Writes rings and lines, each in order, with the
    heights, columns and CRS of their points.

    \b
        crustline reconstruct goose.csv -o goose.geojson -o goose.svg
    """
    points, delaunay, edges = select_edges(source, method, output.quiet)

    from crustline.curves import trace

    curves = trace(points, edges)
    output.write(curves)
    counts = _count(curves, delaunay)
    output.report(
        f"{source.name}: {_in_words(counts)}",
        {"input": source.name, "method": method.name, **counts},
    )


def select_edges(source: Source, method: Method, quiet: bool) -> tuple[Points, Delaunay, IntArray]:
    """Return the points of a source, their triangulation, and the edges that a method selects."""
    from crustline.delaunay import Delaunay

    points = source.read()
    with progress_bar(quiet) as progress:
        delaunay = Delaunay(points, progress=progress)
        return points, delaunay, method.edges(delaunay)


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


def _in_words(counts: dict[str, Any]) -> str:
    words = ("point", "duplicate", "ring", "open curve", "branch", "isolated point")
    return ", ".join(map(counted, counts.values(), words))
