"""What is cut: files, arrays and meshes, as clouds or surfaces."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, as_floats
from crustline.errors import InputError
from crustline.formats import Source, stream
from crustline.formats.catalog import format_of_source
from crustline.formats.cloud import Chunk, chunks_of_array
from crustline.formats.crs import normalize_crs
from crustline.formats.reading import opened
from crustline.points import Points, as_crs
from crustline.slices.cloud import Cloud

__all__ = ["as_body"]


def as_body(body: Any, format: str | None = None, crs: str | None = None, **options: Any) -> Cloud:
    """Return what a caller gives as a cloud."""
    if isinstance(body, Cloud):
        return body
    named = None if as_crs(crs) is None else normalize_crs(str(crs))
    if isinstance(body, Points):
        return _of_array(_with_heights(body), "points", named or body.crs)
    if isinstance(body, str | os.PathLike | bytes | Source) or hasattr(body, "read"):
        return _of_file(body, format, named, options)
    xyz = as_floats("body", body)
    if xyz.ndim != 2 or xyz.shape[1] != 3:
        raise InputError(f"the shape of the cloud is {xyz.shape}, not (n, 3): give x, y and z")
    return _of_array(xyz, "cloud", named)


def _with_heights(points: Points) -> FloatArray:
    if points.z is None:
        raise InputError("points without heights are a slice already: reconstruct them")
    return np.column_stack([points.xy, points.z])


def _of_array(xyz: FloatArray, name: str, crs: str | None) -> Cloud:
    return Cloud(name, lambda box: chunks_of_array(xyz), crs)


def _of_file(path: Any, format: str | None, crs: str | None, options: dict[str, Any]) -> Cloud:
    source = opened(path)
    chosen = format_of_source(source, format)
    chosen.require()
    if chosen.cloud is None:
        return Cloud(source.name, lambda box: _streamed(source, chosen.name, options), crs)
    settings = chosen.settings("cloud", options)
    read = chosen.cloud
    return Cloud(source.name, lambda box: read(source, box, **settings), crs)


def _streamed(source: Source, format: str, options: dict[str, Any]) -> Iterator[Chunk]:
    """Yield the points of a format that is read as points of the plane with heights."""
    for points in stream(source, format=format, **options):
        if points.z is None:
            raise InputError(f"{source.name} has no heights: give x, y and z")
        yield Chunk((points.xy[:, 0], points.xy[:, 1], points.z), crs=points.crs)
