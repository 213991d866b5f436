"""`crustline info`: what a file holds and how it was understood; `convert`: the same otherwise."""

from __future__ import annotations

import json
import shlex
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from crustline.cli.output import Output, counted, output_options
from crustline.cli.sections import Sectioned
from crustline.cli.source import Source, source_options

if TYPE_CHECKING:
    from crustline.arrays import FloatArray
    from crustline.delaunay import Delaunay
    from crustline.formats.source import Source as Bytes
    from crustline.points import Points


@click.command(cls=Sectioned)
@source_options
@click.option("--json", "as_json", is_flag=True, help="Print it as JSON.")
def info(source: Source, as_json: bool) -> None:
    """Say what a file of points or a mesh holds, and how it was understood.

    INPUT is a file of points; - is standard input. Prints its format, what was found in its text,
    the number of points, their extent, CRS, columns, duplicates and spacing, and what to try; of a
    mesh its vertices and triangles, its extent, whether it is closed, and how to cut it.

    \b
        crustline info goose.csv
    """
    from crustline.delaunay import Delaunay
    from crustline.formats.source import Source as Bytes

    opened = Bytes(source.name)
    about = _about_mesh(opened, source)
    if not about:
        points = source.read(opened)
        about = {"file": opened.name, **opened.notes, **_about_points(points)}
        if len(points):
            about |= _about_spacing(Delaunay(points, threads=source.threads))
        about["to try"] = _to_try(source, points)
    if as_json:
        click.echo(json.dumps(about))
        return
    width = max(map(len, about))
    for name, value in about.items():
        click.echo(f"{name.ljust(width)}  {_in_words(value)}")


def _about_mesh(opened: Bytes, source: Source) -> dict[str, Any]:
    """Return what is to be said of a file of a surface; nothing of one of points."""
    from crustline.slices.body import mesh_of

    if source.name == "-":  # read once
        return {}
    mesh = mesh_of(opened, source.format)
    if mesh is None:
        return {}
    used = mesh.vertices[np.unique(mesh.triangles)]
    low, high = used.min(axis=0), used.max(axis=0)
    return {
        "file": mesh.name,
        "vertices": len(used),
        "triangles": len(mesh.triangles),
        "extent": [*low.tolist(), *high.tolist()],
        "closed": "yes" if mesh.is_closed else "no",
        "to cut it": f"crustline reconstruct {mesh.name} --slice z={(low[2] + high[2]) / 2:.6g}",
    }


def _about_points(points: Points) -> dict[str, Any]:
    about: dict[str, Any] = {"points": len(points), "x and y": list(points.names)}
    if len(points):
        about["extent"] = [*points.xy.min(axis=0).tolist(), *points.xy.max(axis=0).tolist()]
    if points.z is not None and len(points):
        about["heights"] = [float(points.z.min()), float(points.z.max())]
    about["CRS"] = points.crs or "not given"
    about["columns"] = {name: str(column.dtype) for name, column in points.columns.items()}
    return about


def _to_try(source: Source, points: Points) -> str:
    """Return the command that makes curves of such points, with the options that they call for."""
    from crustline.delaunay import Delaunay
    from crustline.merge import near_tolerance
    from crustline.projection import is_geographic, looks_geographic

    options = [shlex.quote(source.name)]
    if looks_geographic(points):
        options.append("--crs EPSG:4326")
    if is_geographic(points) or looks_geographic(points):
        options.append("--project auto")
    tolerance = near_tolerance(Delaunay(points)) if len(points) else None
    if tolerance is not None:
        options.append(f"--merge {tolerance:g}")
    options += [f"--by {shlex.quote(name)}" for name in _groups(points)[:1]]
    return f"crustline reconstruct {' '.join(options)} -o curves.geojson"


def _groups(points: Points) -> list[str]:
    """Return the columns that look like the names of curves: few values, each at several rows."""
    found = []
    for name, values in points.columns.items():
        if values.dtype.kind in "OUi" and len(points):
            groups, counts = np.unique(values.astype(str), return_counts=True)
            runs = 1 + int(np.count_nonzero(values[1:] != values[:-1]))
            if 1 < len(groups) == runs and counts.min() > 2:
                found.append(name)
    return found


def _about_spacing(delaunay: Delaunay) -> dict[str, Any]:
    about: dict[str, Any] = {"duplicates": len(delaunay.duplicates)}
    distances = _nearest(delaunay)
    if len(distances):
        quantiles = np.quantile(distances, [0, 0.25, 0.5, 0.75, 1], method="nearest")
        about["spacing"] = [float(f"{value:.6g}") for value in quantiles]
    return about


def _nearest(delaunay: Delaunay) -> FloatArray:
    """Return the distance of each point to its nearest neighbor, to which it has an edge."""
    xy, edges = delaunay.points.xy, delaunay.edges
    steps = xy[edges[:, 1]] - xy[edges[:, 0]]
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    nearest = np.full(len(xy), np.inf)
    np.minimum.at(nearest, edges[:, 0], lengths)
    np.minimum.at(nearest, edges[:, 1], lengths)
    found: FloatArray = nearest[np.isfinite(nearest)]
    return found


def _in_words(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} ({kind})" for name, kind in value.items()) or "none"
    if isinstance(value, list):
        return ", ".join(f"{each:.12g}" if isinstance(each, float) else str(each) for each in value)
    return f"{value:,}" if isinstance(value, int) else str(value)


@click.command(cls=Sectioned)
@source_options
@output_options("write_points", required=True)
def convert(source: Source, output: Output) -> None:
    """Write the points of a file in another format.

    INPUT is a file of points; - is standard input. Heights, columns and CRS are kept where the
    format holds them.

    \b
        crustline convert goose.csv -o goose.geojson
    """
    points = source.read()
    output.write(points)
    summary = {"input": source.name, "points": len(points)}
    output.report(f"{source.name}: {counted(len(points), 'point')}", summary)
