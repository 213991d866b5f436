"""Meshes as other tools write them: a cube of side 1, of which each slice is a square."""

from __future__ import annotations

import struct

import numpy as np
import pytest

import crustline as cl
from test_slices import polygons_of

pytest.importorskip("trimesh")
pytestmark = pytest.mark.filterwarnings("ignore:.*:DeprecationWarning")

CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [(a, b, c) for a, b, c, _ in QUADS] + [(a, c, d) for a, _, c, d in QUADS]


def stl_text(name="cube", number="{:g}", end="\n", upper=False, normals=True):
    """STL of text, in the dialects of exporters."""
    lines = [f"solid {name}"]
    for triangle in TRIANGLES:
        lines.append("facet normal " + ("0 0 1" if normals else "0 0 0"))
        lines.append("  outer loop")
        for corner in triangle:
            lines.append("    vertex " + " ".join(map(number.format, CORNERS[corner])))
        lines += ["  endloop", "endfacet"]
    lines.append(f"endsolid {name}")
    text = end.join(lines) + end
    return (text.upper() if upper else text).encode()


def stl_binary(header=b"", attribute=0):
    """STL of numbers, with whatever a tool puts into its header and attributes."""
    made = header.ljust(80, b"\0") + struct.pack("<I", len(TRIANGLES))
    for triangle in TRIANGLES:
        made += struct.pack("<3f", 0, 0, 0)
        made += b"".join(struct.pack("<3f", *CORNERS[corner]) for corner in triangle)
        made += struct.pack("<H", attribute)
    return made


def obj(face="{}", faces=QUADS, before="", number="{}"):
    """OBJ with faces in some style."""
    lines = [before] + ["v " + " ".join(map(number.format, corner)) for corner in CORNERS]
    lines += ["vt 0 0", "vn 0 0 1"]
    lines += ["f " + " ".join(face.format(each + 1, each - 8) for each in every) for every in faces]
    return "\n".join(lines).encode()


def ply(order="ascii", name="vertex_indices", count="uchar", item="int", faces=QUADS, extra=False):
    """PLY with lists of faces in some types, and with colors and edges."""
    codes = {"uchar": "B", "int": "i", "uint": "I", "ushort": "H", "short": "h", "char": "b"}
    head = f"ply\nformat {order} 1.0\nelement vertex 8\n"
    head += "property float x\nproperty float y\nproperty float z\n"
    head += "property uchar red\n" * extra
    head += f"element face {len(faces)}\nproperty list {count} {item} {name}\n"
    head += "property uchar flags\n" * extra + "end_header\n"
    body = b""
    for corner in CORNERS:
        row = (*corner, 7) if extra else corner
        body += (
            (" ".join(map(str, row)) + "\n").encode()
            if order == "ascii"
            else struct.pack((">" if "big" in order else "<") + "3f" + "B" * extra, *row)
        )
    for face in faces:
        row = (len(face), *face, *([1] * extra))
        sign = ">" if "big" in order else "<"
        form = sign + codes[count] + codes[item] * len(face) + "B" * extra
        body += (
            (" ".join(map(str, row)) + "\n").encode()
            if order == "ascii"
            else struct.pack(form, *row)
        )
    return head.encode() + body


STL = {
    "plain": stl_text(),
    "no name": stl_text(""),
    "a name with spaces and ü": stl_text("Körper 1 of 2"),
    "exponents": stl_text(number="{:.6e}"),
    "many digits": stl_text(number="{:.17f}"),
    "CRLF": stl_text(end="\r\n"),
    "no normals": stl_text(normals=False),
    "upper case": stl_text(upper=True),
    "numbers": stl_binary(),
    "numbers, solid in the header": stl_binary(b"solid made by some CAD"),
    "numbers, COLOR in the header": stl_binary(b"COLOR=\xff\x00\x00\xff,MATERIAL="),
    "numbers, colors in attributes": stl_binary(attribute=0x7FFF),
}
OBJ = {
    "quads": obj(),
    "triangles": obj(faces=TRIANGLES),
    "textures": obj("{0}/1"),
    "textures and normals": obj("{0}/1/1"),
    "normals": obj("{0}//1"),
    "backwards": obj("{1}"),
    "comments and groups": obj(before="# Blender\no Cube\ng side\ns off"),
    "a library that is not there": obj(before="mtllib cube.mtl\nusemtl red"),
    "exponents": obj(number="{:.3e}"),
    "smoothing": obj(before="s 1"),
}
PLY = {
    "text": ply(),
    "vertex_index": ply(name="vertex_index"),
    "triangles": ply(faces=TRIANGLES),
    "quads and triangles": ply(faces=[*QUADS[:3], *TRIANGLES[3:6], *TRIANGLES[9:]]),
    "little-endian": ply("binary_little_endian"),
    "big-endian": ply("binary_big_endian"),
    "unsigned": ply("binary_little_endian", item="uint"),
    "shorts": ply("binary_little_endian", item="ushort", faces=TRIANGLES),
    "counts of int": ply("binary_little_endian", count="int"),
    "colors and flags": ply("binary_little_endian", extra=True),
}
FILES = [("stl", name, content) for name, content in STL.items()]
FILES += [("obj", name, content) for name, content in OBJ.items()]
FILES += [("ply", name, content) for name, content in PLY.items()]


@pytest.mark.parametrize(("key", "name", "content"), FILES, ids=lambda each: str(each)[:30])
def test_a_slice_is_a_square(key, name, content):
    (found,) = cl.slices(content, "z=0.25", format=key)
    assert found.curves.closed.tolist() == [True]
    square = polygons_of(found.curves)
    assert square.area == pytest.approx(1, abs=1e-12)
    assert np.allclose(square.bounds, (0, 0, 1, 1))
