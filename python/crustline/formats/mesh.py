"""Surfaces of triangles by trimesh: STL and OBJ, for slices; points of the plane they are not."""

from __future__ import annotations

import logging

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.errors import require
from crustline.formats.format import Format
from crustline.formats.source import Source

__all__ = ["OBJ", "STL", "Triangles", "sound", "triangles_of"]

#: Vertices (n, 3), and triangles (m, 3) as rows of them.
Triangles = tuple[FloatArray, IntArray]


def triangles_of(source: Source, kind: str) -> Triangles:
    """Return the vertices and triangles of a file, as they are in it; polygons as fans."""
    content = source.content()
    require("mesh", "trimesh")
    with source.library("trimesh"), np.errstate(all="ignore"):
        import io

        import trimesh

        logging.getLogger("trimesh").setLevel(logging.CRITICAL)  # what it says is raised, too
        mesh = trimesh.load_mesh(
            io.BytesIO(content), file_type=kind, process=False, skip_materials=True
        )
        vertices = np.array(mesh.vertices, np.float64).reshape(-1, 3)
        faces = np.array(mesh.faces, np.int64).reshape(-1, 3)
    return sound(vertices, faces, source)


def sound(vertices: FloatArray, faces: IntArray, source: Source) -> Triangles:
    """Return vertices and triangles, or raise `FormatError` about the first that is none."""
    if not len(faces):
        raise source.error("it has no triangle: give a surface, or a cloud in a format of points")
    wrong = np.flatnonzero(~((faces >= 0) & (faces < len(vertices))).all(axis=1))
    if len(wrong):
        raise source.error(
            f"its {len(vertices):,} vertices have no rows {faces[wrong[0]].tolist()}: repair it",
            f"triangle {wrong[0]}",
        )
    used = vertices[faces]
    wrong = np.flatnonzero(~(np.abs(used) < _LARGEST).all(axis=(1, 2)))
    if len(wrong):
        raise source.error(
            f"a corner is {used[wrong[0]].tolist()!r:.90}: repair it", f"triangle {wrong[0]}"
        )
    return vertices, faces


#: Coordinates whose squares and products are numbers.
_LARGEST = 1e100

STL = Format(
    name="stl",
    title="STL",
    suffixes=(".stl",),
    sniff=lambda head: head[:6] == b"solid " and b"facet" in head,
    mesh=lambda source: triangles_of(source, "stl"),
    extra="mesh",
    needs=("trimesh",),
)
OBJ = Format(
    name="obj",
    title="OBJ",
    suffixes=(".obj",),
    mesh=lambda source: triangles_of(source, "obj"),
    extra="mesh",
    needs=("trimesh",),
)
