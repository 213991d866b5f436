"""`crustline sample`: a smooth curve to points; `crustline thin`: points to fewer points."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from crustline.cli.method import Method, method_options
from crustline.cli.output import Output, counted, output_options
from crustline.cli.progress import progress_bar
from crustline.cli.reconstruct import reconstruction
from crustline.cli.sections import Sectioned
from crustline.cli.source import Source, source_options
from crustline.errors import InputError
from crustline.scalars import as_positive, as_share

if TYPE_CHECKING:
    from crustline.shapes import SmoothCurve
    from crustline.shapes.sampling import Sample

SHAPES = ("circle", "ellipse", "stadium", "trefoil", "blob", "superformula")


@click.command(cls=Sectioned)
@click.argument("shape", metavar="SHAPE|SVG")
@click.option(
    "-r", type=float, metavar="R",
    help="Every point p of the curve gets a sample within R · LFS(p); 0 < R ≤ 1.",
)  # fmt: skip
@click.option(
    "--error", type=float, metavar="D",
    help="Instead, or too: the polygon through the samples stays within D of the curve.",
)  # fmt: skip
@click.option("--mode", type=click.Choice(["sparsest", "random"]), default="sparsest",
              show_default=True, help="Steps as long as possible, or random ones.")  # fmt: skip
@click.option(
    "--seed", type=click.IntRange(min=0), metavar="N",
    help="Where each loop starts, random steps and --shuffle; the same for the same N.",
)  # fmt: skip
@click.option("--shuffle", is_flag=True, help="Write the points in random order.")
@output_options("write_points", required=True)
def sample(
    shape: str,
    r: float | None,
    error: float | None,
    mode: Any,
    seed: int | None,
    shuffle: bool,
    output: Output,
) -> None:
    """Sample a smooth curve as the theory asks.

    SHAPE is one of these, with its parameters (crustline.shapes says what they are), or the path of
    an SVG file, whose closed paths are taken, with y downwards as there:

    \b
        circle  circle:R  ellipse:A,B  stadium:LENGTH,RADIUS  blob:SEED
        trefoil  trefoil:LOBES,DEPTH,RADIUS  superformula:M,N1,N2,N3
        blob:7,roughness=0.2

    Writes the points, in order along the curve, with t, where on the curve they are. The crust of
    samples with R < 0.253 is sure to be the curve's polygon.

    \b
        crustline sample ellipse:2,1 -r 0.25 -o points.csv
    """
    with progress_bar(output.quiet) as progress:
        taken = _take(_curve(shape), r, error, {"seed": seed, "mode": mode, "progress": progress})
    rows = np.arange(len(taken))
    if shuffle:
        np.random.default_rng(seed).shuffle(rows)

    from crustline.points import Points

    points = Points(taken.points[rows], columns={"t": taken.t[rows]})
    output.write(points)
    output.report(
        f"{shape}: {counted(len(points), 'point')}",
        {"shape": shape, "r": r, "error": error, "mode": mode, "points": len(points)},
    )


def _take(curve: SmoothCurve, r: float | None, error: float | None, how: dict[str, Any]) -> Sample:
    from crustline.shapes.sampling import r_sample, sample_for_error

    share = None if r is None else as_share("-r", r)
    if error is not None:
        error = as_positive("--error", error)
        return sample_for_error(curve, error, r=share, **how)
    if share is None:
        raise InputError("how dense the samples are is not said: add -r R, such as -r 0.25")
    return r_sample(curve, share, **how)


def _curve(spec: str) -> SmoothCurve:
    """Return the curve that a word such as ellipse:2,1 or the name of an SVG file means."""
    from crustline import shapes

    if spec.lower().endswith(".svg"):
        return _curve_of_svg(spec)
    name, _, values = spec.partition(":")
    if name not in SHAPES:
        raise InputError(
            f"no shape is called {name!r}: choose one of {', '.join(SHAPES)}, or an SVG file"
        )
    function = getattr(shapes, name)
    arguments, named = _arguments(spec, values)
    _check_names(spec, function, arguments, named)
    try:
        curve: SmoothCurve = function(*arguments, **named)
    except InputError as error:
        raise InputError(f"the shape {spec!r}: {error}") from None
    return curve


def _curve_of_svg(path: str) -> SmoothCurve:
    from crustline.shapes import bezier_path

    try:
        return bezier_path(path)
    except InputError as error:
        raise InputError(f"{path}: {str(error).removeprefix(f'{path} ')}") from None


def _arguments(spec: str, values: str) -> tuple[list[float], dict[str, float]]:
    arguments: list[float] = []
    named: dict[str, float] = {}
    for value in filter(None, values.split(",")):
        name, equals, number = value.rpartition("=")
        try:
            parsed = int(number) if number.lstrip("+-").isdigit() else float(number)
        except ValueError:
            raise InputError(f"the shape {spec!r} holds {number!r}: give a number") from None
        if equals:
            named[name] = parsed
        else:
            arguments.append(parsed)
    return arguments, named


def _check_names(
    spec: str, function: Callable[..., Any], arguments: list[float], named: dict[str, float]
) -> None:
    from inspect import signature

    known = signature(function)
    try:
        known.bind(*arguments, **named)
    except TypeError as error:
        words = ", ".join(known.parameters)
        raise InputError(
            f"the shape {spec!r} is not {function.__name__}:{words}: {error}"
        ) from None


@click.command(cls=Sectioned)
@source_options
@click.option(
    "-r", type=float, required=True, metavar="R",
    help="How far from a kept point, in parts of the local feature size; 0 < R ≤ 1.",
)  # fmt: skip
@output_options("write_points")
@method_options
def thin(source: Source, r: float, output: Output, method: Method) -> None:
    """Drop the points that the curves do not need.

    INPUT is a file of points; - is standard input. Every point p of the reconstruction keeps one
    within R · LFS(p). Writes the points that are kept, in the order of the input, with their
    heights, columns and CRS. With R = 0.2 their crust is in general the same curve.

    \b
        crustline thin scan.csv -r 0.2 -o fewer.csv
    """
    r = as_share("-r", r)
    from crustline.thinning import thin

    with reconstruction(source, method, output.quiet) as made:
        kept = made.points.select(thin(made.delaunay, made.edges, r=r))
    output.write(kept)
    output.report(
        f"{source.name}: {counted(len(kept), 'point')} of {len(made.points):,} kept",
        {
            "input": source.name,
            "method": method.name,
            "r": r,
            "points": len(made.points),
            "kept": len(kept),
        },
    )
