"""`crustline plot`: points and what is computed from them; `crustline smooth`: splines in SVG."""

from __future__ import annotations

import click

from crustline.cli.method import Method, fit_options, method_options
from crustline.cli.output import Output, counted, output_options, picture_options
from crustline.cli.reconstruct import reconstruction
from crustline.cli.sections import Sectioned
from crustline.cli.source import Source, source_options
from crustline.errors import InputError
from crustline.scalars import as_degrees

LAYERS = (
    "points", "delaunay", "voronoi", "curves", "medial-axis", "lfs", "confidence",
    "certificate", "indices",
)  # fmt: skip


@click.command(cls=Sectioned)
@source_options
@picture_options(".png", ".svg", ".pdf")
@click.option("--show", default="points,curves", show_default=True, metavar="WORDS",
              help=f"What to draw, any of {', '.join(LAYERS)}.")  # fmt: skip
@click.option(
    "--background",
    metavar="FILE|world",
    help="Outlines of a map below: lines and polygons of a file, or the world's coasts.",
)
@method_options
@fit_options
def plot(source: Source, output: Output, show: str, background: str | None, method: Method) -> None:
    """Draw points and what is computed from them.

    INPUT is a file of points; - is standard input. Writes a picture: `curves`
    are those that the method finds, `confidence` how sure it is of them, `lfs` colors points by
    their local feature size, `indices` numbers them. With --fit it is the fitted curves, in a band
    as wide as they are uncertain. Needs matplotlib: pip install 'crustline[plot]'.

    \b
        crustline plot goose.csv -o goose.png --show points,curves,medial-axis
    """
    layers = [word.strip() for word in show.split(",")]
    for word in layers:
        if word not in LAYERS:
            raise InputError(f"--show {word!r} is unknown: choose from {', '.join(LAYERS)}")

    from crustline.plot import picture

    with reconstruction(source, method, output.quiet) as made:
        for file in output.files if not output.dry_run else ():
            picture(made, file, show=layers, background=background)
    count = len(made.points)
    output.report(
        f"{source.name}: {counted(count, 'point')}",
        {"input": source.name, "method": method.name, "points": count, "show": layers},
    )


@click.command(cls=Sectioned)
@source_options
@output_options("write_splines", required=True)
@click.option(
    "--corner-angle", type=float, default=60.0, show_default=True, metavar="DEGREES",
    help="A point at which the curve turns by this or more is a corner.",
)  # fmt: skip
@method_options
@fit_options
def smooth(source: Source, output: Output, corner_angle: float, method: Method) -> None:
    """Draw smooth curves through points.

    INPUT is a file of points; - is standard input. Writes an SVG of
    cubic Bézier paths, one for each ring and line: splines with continuous curvature, but at
    corners. Needs scipy: pip install 'crustline[smooth]'.

    \b
        crustline smooth goose.csv -o goose.svg --tolerance 0.1
    """
    corner_angle = as_degrees("--corner-angle", corner_angle)
    from crustline.smooth import smooth

    with reconstruction(source, method, output.quiet) as made:
        splines = smooth(made.curves, corner_angle=corner_angle)
    tolerance = output.settings.get("tolerance")
    pieces = sum(map(len, splines.beziers(tolerance)))
    corners = sum(len(spline.corners) for spline in splines)
    output.write(splines)
    counts = {"curves": len(splines), "pieces": pieces, "corners": corners}
    words = ("curve", "piece", "corner")
    output.report(
        f"{source.name}: {', '.join(map(counted, counts.values(), words))}",
        {
            "input": source.name,
            "method": method.name,
            "points": len(made.points),
            "tolerance": tolerance,
            **counts,
        },
    )
