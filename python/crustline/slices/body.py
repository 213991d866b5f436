"""What is cut: files, arrays and meshes, as clouds or surfaces."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, as_floats
from crustline.errors import InputError
from crustline.formats import Source, stream
from crustline.formats.catalog import able, format_of_source
from crustline.formats.cloud import Chunk, chunks_of_array
from crustline.formats.crs import normalize_crs
from crustline.formats.mesh import sound
from crustline.formats.reading import opened
from crustline.points import Points, as_crs
from crustline.slices.cloud import Cloud
from crustline.slices.mesh import Mesh

__all__ = ["as_body", "mesh_of"]


def as_body(
    body: Any, format: str | None = None, crs: str | None = None, **options: Any
) -> Cloud | Mesh:
    """Return what a caller gives as a cloud or a mesh."""
    if isinstance(body, Cloud | Mesh):
        return body
    named = None if as_crs(crs) is None else normalize_crs(str(crs))
    if isinstance(body, Points):
        return _of_array(_with_heights(body), "points", named or body.crs)
    if isinstance(body, str | os.PathLike | bytes | Source) or hasattr(body, "read"):
        return _of_file(body, format, named, options)
    if hasattr(body, "vertices") and hasattr(body, "faces"):  # of trimesh, or alike
        return _of_faces(body, named)
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


def _of_faces(body: Any, crs: str | None) -> Mesh:
    vertices = as_floats("vertices", body.vertices)
    faces = np.asarray(body.faces)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] != 3:
        raise InputError(
            f"the mesh has vertices of shape {vertices.shape} and faces of shape {faces.shape}, "
            "not (n, 3) and (m, 3): give triangles"
        )
    return Mesh.of(
        "the mesh", *sound(vertices, faces.astype(np.int64), Source(b"", "the mesh")), crs
    )


def _of_file(
    path: Any, format: str | None, crs: str | None, options: dict[str, Any]
) -> Cloud | Mesh:
    source = opened(path)
    mesh = mesh_of(source, format, crs)
    if mesh is not None:
        return mesh
    chosen = format_of_source(source, format)
    chosen.require()
    if chosen.cloud is None:
        return Cloud(source.name, lambda box: _streamed(source, chosen.name, options), crs)
    settings = chosen.settings("cloud", options)
    read = chosen.cloud
    return Cloud(source.name, lambda box: read(source, box, **settings), crs)


def mesh_of(source: Source, format: str | None, crs: str | None = None) -> Mesh | None:
    """Return the triangles of a file by its format or suffix; None if it holds points alone."""
    for each in able("mesh"):
        by_suffix = format is None and source.suffix in each.suffixes
        by_name = isinstance(format, str) and format == each.name
        if (by_name or by_suffix) and each.mesh is not None:
            triangles = each.mesh(source)
            return None if triangles is None else Mesh.of(source.name, *triangles, crs)
    return None


def _streamed(source: Source, format: str, options: dict[str, Any]) -> Iterator[Chunk]:
    """Yield the points of a format that is read as points of the plane with heights."""
    for points in stream(source, format=format, **options):
        if points.z is None:
            raise InputError(f"{source.name} has no heights: give x, y and z")
        yield Chunk((points.xy[:, 0], points.xy[:, 1], points.z), crs=points.crs)
