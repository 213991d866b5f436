"""`crustline reconstruct`: points to curves."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from crustline.cli.distributed import distributed_options
from crustline.cli.method import Method, fit_options, method_options
from crustline.cli.orientation import Orientation, orientation_options
from crustline.cli.output import Output, counted, output_options
from crustline.cli.progress import progress_bar
from crustline.cli.sections import Sectioned
from crustline.cli.slices import slice_options
from crustline.cli.source import Source, source_options
from crustline.errors import FormatWarning, InputError
from crustline.formats.names import quote_all

if TYPE_CHECKING:
    from crustline.arrays import IntArray
    from crustline.delaunay import Delaunay
    from crustline.points import Points
    from crustline.reconstruction import Reconstruction


@click.command(cls=Sectioned)
@distributed_options
@source_options
@output_options("write_curves")
@orientation_options
@click.option("--by", metavar="COLUMN", help="Connect only points of equal value in a column.")
@click.option("--edges-from-file", is_flag=True,
              help="Keep the lines that the file holds, and decide their gaps only.")  # fmt: skip
@click.option("--confidence", is_flag=True,
              help="Say how sure each edge is, in GeoJSON, and the whole; of connect.")  # fmt: skip
@method_options
@fit_options
@slice_options
def reconstruct(
    source: Source,
    output: Output,
    orientation: Orientation,
    by: str | None,
    edges_from_file: bool,
    confidence: bool,
    method: Method,
) -> None:
    """Find the curves that points were sampled from.

    INPUT is a file of points; - is standard input. Writes rings and lines, each in order, with the
    heights, columns and CRS of their points. With --slice or --section, INPUT is a cloud of points
    in space or a mesh, and the curves are those in which planes cut it; several planes make a file
    of layers.

    \b
        crustline reconstruct goose.csv -o goose.geojson -o goose.svg
        crustline reconstruct tracks.csv --fit --noise accuracy -o path.geojson
    """
    with (
        completion(source, method, by, output.quiet)
        if edges_from_file
        else reconstruction(source, method, output.quiet, by)
    ) as made:
        found = made.connection if confidence or (output.as_json and _is_sure(made)) else None
        counts = _count(made)
    _warn_of_near(source, made)
    curves = found.curves if confidence and found else made.curves
    output.write(orientation.of(curves, method.project))
    summary: dict[str, Any] = {"input": source.name, "method": method.name, **counts}
    sentence = f"{source.name}: {_in_words(counts)}"
    if found is not None:
        summary["connection"] = found.summary()
        sentence += f", {found.whole:.0%} sure as a whole"
    output.report(sentence, summary)


def _is_sure(made: Reconstruction) -> bool:
    """Whether the method is the one that says how sure it is."""
    from crustline.methods import connect
    from crustline.projection import unprojected

    return unprojected(made.method)[0] is connect and not made.fit


def _warn_of_near(source: Source, made: Reconstruction) -> None:
    """Say what to add where points look like one point that was rounded."""
    from crustline.merge import near_tolerance

    tolerance = None if len(made.merged) else near_tolerance(made.delaunay)
    if tolerance is not None:
        warnings.warn(
            f"{source.name}: some points are nearer to each other than a millionth of the "
            f"distance to any other, and break the curve there: add --merge {tolerance:g} to take "
            "them for one",
            FormatWarning,
            stacklevel=2,
        )


@contextmanager
def reconstruction(
    source: Source, method: Method, quiet: bool, by: str | None = None
) -> Iterator[Reconstruction]:
    """Read a source, and yield what a method makes of it, under a progress bar."""
    from crustline.delaunay import Delaunay
    from crustline.reconstruction import Reconstruction

    points = source.read()
    method = _in_pixels(source, method)
    _warn_of_degrees(source, points, method)
    with progress_bar(quiet) as progress:
        delaunay = Delaunay(points, threads=source.threads, progress=progress)
        if by is None:
            yield method.reconstruction(delaunay)
        else:
            _refuse_what_groups_lack(method)
            yield Reconstruction(delaunay, _grouped(points, by, method))


def _in_pixels(source: Source, method: Method) -> Method:
    """Connect a digitized plot in its pixels: its axes may differ in unit and scale."""
    from crustline.formats.image import PIXELS

    if source.settings.get("axes") is None:
        return method
    if method.fit or method.project:
        other = "--fit" if method.fit else "--project"
        raise InputError(f"--axes and {other} exclude each other: leave one of them away")
    return replace(method, columns=PIXELS)


@contextmanager
def completion(
    source: Source, method: Method, by: str | None, quiet: bool
) -> Iterator[Reconstruction]:
    """Read the lines of a source, and yield them with their gaps closed, under a progress bar."""
    from crustline.delaunay import Delaunay
    from crustline.methods import close_gaps
    from crustline.projection import projected
    from crustline.reconstruction import Reconstruction

    if by is not None or method.name != "connect" or method.fit:
        other = "--by" if by else "--fit" if method.fit else f"--method {method.name}"
        raise InputError(f"--edges-from-file goes with connect, not with {other}: leave one away")
    curves = source.read_curves()
    _warn_of_degrees(source, curves.points, method)
    close = close_gaps if method.project is None else projected(close_gaps, method.project)
    with progress_bar(quiet) as progress:
        delaunay = Delaunay(curves.points, threads=source.threads, progress=progress)
        yield Reconstruction(delaunay, close, edges=curves.edges, **method.parameters)


def _warn_of_degrees(source: Source, points: Points, method: Method) -> None:
    from crustline.projection import is_geographic, looks_geographic

    if method.project is not None:
        return
    if is_geographic(points) or looks_geographic(points):
        named = "" if points.crs else "--crs EPSG:4326 "
        warnings.warn(
            f"{source.name}: longitudes and latitudes are taken for coordinates of the plane: "
            f"add {named}--project auto",
            FormatWarning,
            stacklevel=4,
        )


def _refuse_what_groups_lack(method: Method) -> None:
    if method.fit:
        raise InputError("--by and --fit exclude each other: fit each group in a file of its own")
    if method.merge is not None:
        raise InputError(
            "--by and --merge exclude each other: merge each group in a file of its own"
        )


def _grouped(points: Points, by: str, method: Method) -> Callable[[Delaunay], IntArray]:
    """Return the method within each group of points of equal value in a column."""
    from crustline.methods import by_group

    if by not in points.columns:
        has = f"choose from {quote_all(list(points.columns))}" if points.columns else "it has none"
        raise InputError(f"--by {by!r:.40} is no column beside x and y: {has}")
    groups = points.columns[by]
    return lambda delaunay: by_group(delaunay, groups, method.function, **method.parameters)


def _count(made: Reconstruction) -> dict[str, Any]:
    curves = made.curves
    rings = int(curves.closed.sum())
    counts: dict[str, Any] = {
        "points": len(made.points),
        "duplicates": len(made.delaunay.duplicates) - len(made.merged),
        "merged": len(made.merged),
        "rings": rings,
        "open_curves": len(curves) - rings,
        "branches": len(curves.branches),
    }
    if made.denoised is None:
        return counts | {"isolated": len(curves.isolated) - len(made.merged)}
    known = made.denoised.noise[np.isfinite(made.denoised.noise)]
    return counts | {
        "vertices": len(made.denoised.curves.points),
        "outliers": len(made.denoised.outliers),
        "unchanged_curves": int(made.denoised.unchanged.sum()),
        "noise": float(np.median(known)) if len(known) else None,
    }


def _in_words(counts: dict[str, Any]) -> str:
    words = {
        "points": "point", "duplicates": "duplicate", "merged": "merged row",
        "rings": "ring", "open_curves": "open curve", "branches": "branch",
        "isolated": "isolated point", "vertices": "fitted vertex",
        "outliers": "outlier", "unchanged_curves": "unchanged curve",
    }  # fmt: skip
    said = [counted(counts[key], word) for key, word in words.items()
            if key in counts and (counts[key] or key != "merged")]  # fmt: skip
    if counts.get("noise"):
        said.append(f"noise {counts['noise']:.3g}")
    return ", ".join(said)
