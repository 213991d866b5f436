"""`crustline certify`: whether the theory guarantees the curves through points, and where not."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import click

from crustline.cli.method import Method, method_options
from crustline.cli.output import POINTS, Output, output_options
from crustline.cli.reconstruct import select_edges
from crustline.cli.source import Source, source_options
from crustline.points import Points

if TYPE_CHECKING:
    from crustline.certify import Certificate


@click.command()
@source_options
@output_options(POINTS, "write_points")
@click.option("--strict", is_flag=True,
              help="Exit with code 1 if the curves are not guaranteed.")  # fmt: skip
@method_options
def certify(source: Source, output: Output, strict: bool, method: Method) -> None:
    """Say whether the theory guarantees the curves.

    INPUT is a file of points; - is standard input. Prints what is proven, what is estimated, and
    what breaks the guarantee. With -o it writes the points that break it: their row in the input,
    the reason, and what they carry. There more samples are needed.

    \b
        crustline certify goose.csv -o more_samples_here.csv
    """
    points, delaunay, edges = select_edges(source, method, output.quiet)

    from crustline.certify import certify

    certificate = certify(delaunay, edges)
    output.write(_weak(points, certificate).write)
    if output.as_json:
        about = {"input": source.name, "method": method.name, "outputs": list(output.files)}
        text = json.dumps(about | certificate.to_dict(), allow_nan=False)
    else:
        text = certificate.summary()
    if output.as_json or not output.quiet:
        click.echo(text, err="-" in output.files)
    if strict and not certificate.guaranteed:
        raise click.exceptions.Exit(1)


def _weak(points: Points, certificate: Certificate) -> Points:
    """Return the points that break the guarantee, with the row and the reason beside them."""
    rows = certificate.weak_points
    weak = points.select(rows)
    found = {"row": rows, "reason": certificate.point_reason[rows]}
    taken = {(f"input_{name}" if name in found else name): v for name, v in weak.columns.items()}
    return Points(weak, z=weak.z, columns=found | taken, crs=weak.crs, names=weak.names)
