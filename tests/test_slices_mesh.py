"""Slices of meshes: outlines against what is known of solids, gaps, rounding and refusals."""

from __future__ import annotations

import re
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

import crustline as cl
from crustline.cli import main
from test_slices import command, polygons_of

trimesh = pytest.importorskip("trimesh")
pytestmark = pytest.mark.filterwarnings("ignore:.*:DeprecationWarning")


def plate():
    """A plate 6 × 4 × 1 with a square hole and a round one, and a pin in the round one."""
    import shapely

    outline = shapely.box(0, 0, 6, 4) - shapely.box(0.5, 0.5, 1.5, 1.5)
    outline -= shapely.Point(4, 2).buffer(1.2)
    outline |= shapely.Point(4, 2).buffer(0.4)
    parts = [_extruded(each, 1.0) for each in outline.geoms]
    return trimesh.util.concatenate(parts), outline


def _extruded(polygon, height):
    """A prism over a polygon, its ends cut into triangles by shapely."""
    import shapely

    rings = [np.array(ring.coords)[:-1] for ring in (polygon.exterior, *polygon.interiors)]
    sides = []
    for ring in rings:
        for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            low, high = [*a, 0], [*b, 0]
            sides += [[low, high, [*a, height]], [high, [*b, height], [*a, height]]]
    caps = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    for each in caps:
        corners = np.array(each.exterior.coords)[:3]
        for z in (0, height):
            sides.append([[*corner, z] for corner in corners])
    soup = np.array(sides, float)
    return trimesh.Trimesh(soup.reshape(-1, 3), np.arange(3 * len(soup)).reshape(-1, 3),
                           process=False)  # fmt: skip


def torus(count=24):
    """A torus about z, without a corner in any plane that a test asks for."""
    return trimesh.creation.torus(2.0, 0.7, major_sections=count, minor_sections=count // 2)


@pytest.mark.parametrize("plane", ["z=0", "z=0.3", "x=0", "y=0.5", "1,2,3=0.1", "1,0,0.2=1.5"])
def test_outlines_of_a_closed_surface_are_closed(plane):
    (found,) = cl.slices(torus(), plane)
    assert found.curves.closed.all()
    assert not len(found.curves.branches)
    assert not len(found.curves.isolated)
    points = found.in_space.points
    assert np.allclose(np.c_[points.xy, points.z] @ found.plane.normal,
                       found.plane.offset, atol=1e-12)  # fmt: skip


@pytest.mark.parametrize("normal", ["x", "y", "z", "1,1,0", "1,1,1", "1,-1,2"])
def test_planes_through_corners_and_faces_leave_nothing_open(normal):
    box = trimesh.creation.box((2, 2, 2)).subdivide().subdivide()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = cl.slices(box, f"{normal}=-5:5:0.25", threads=1)
    assert len(found) > 6
    for each in found:
        assert each.curves.closed.all(), each
        assert len(each.curves) == 1


def test_areas_are_those_of_the_solid():
    solid, outline = plate()
    (found,) = cl.slices(solid, "z=0.5")
    assert sorted(len(each.holes) for each in found.curves.polygons()) == [0, 2]
    difference = polygons_of(found.curves).symmetric_difference(outline)
    assert difference.area < 1e-9
    assert len(found.curves.points) >= len(outline.boundary.geoms)


def test_the_sections_segments_are_kept():
    ball = trimesh.creation.icosphere(3)
    (found,) = cl.slices(ball, "z=0.123")
    lines = trimesh.intersections.mesh_plane(ball, [0, 0, 1], [0, 0, 0.123])
    ends = found.curves.points.xy[found.curves.edges]
    mine = np.sort(np.round(ends.mean(axis=1), 9), axis=0)
    theirs = np.sort(np.round(lines[:, :, :2].mean(axis=1), 9), axis=0)
    assert len(mine) == len(theirs)
    assert np.allclose(mine, theirs, atol=1e-8)


def test_corners_that_differ_by_rounding_are_one():
    solid, outline = plate()
    rng = np.random.default_rng(0)
    shaken = solid.vertices + rng.normal(0, 1e-10, solid.vertices.shape)
    rough = trimesh.Trimesh(shaken, solid.faces, process=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (found,) = cl.slices(rough, "z=0.5", threads=1)
    assert found.curves.closed.all()
    assert polygons_of(found.curves).symmetric_difference(outline).area < 1e-7
    (other,) = cl.slices(rough, "z=0.5", merge=1e-8)
    assert other.curves == found.curves


def test_gaps_are_decided_and_said():
    solid, outline = plate()
    centers = solid.triangles_center
    torn = ~((np.abs(centers[:, 0] - 4) < 0.2) & (np.abs(centers[:, 1] - 3.2) < 0.1))
    holed = trimesh.Trimesh(solid.vertices, solid.faces[torn], process=False)
    with pytest.warns(UserWarning, match="not closed: its slices have .* gaps were closed"):
        (found,) = cl.slices(holed, "z=0.5", closed=True)
    assert polygons_of(found.curves).symmetric_difference(outline).area < 0.02
    with pytest.warns(UserWarning, match="lines stay open"):
        (found,) = cl.slices(holed, "z=0.5", max_edge=0.1)
    assert not found.curves.closed.all()


def test_a_surface_that_cannot_be_closed_is_refused_where_closed_is_asked_for():
    x, y = np.meshgrid(np.arange(12.0), np.arange(12.0))
    vertices = np.column_stack([x.ravel(), y.ravel(), (x + 0.3 * y).ravel()])
    first = (np.arange(11)[:, None] * 12 + np.arange(11)).ravel()
    faces = np.concatenate([np.stack([first, first + 1, first + 12], 1),
                            np.stack([first + 1, first + 13, first + 12], 1)])  # fmt: skip
    slope = trimesh.Trimesh(vertices, faces, process=False)
    with pytest.warns(UserWarning, match="stay open"):
        (found,) = cl.slices(slope, "z=5.05", max_edge=0.5)
    assert len(found.curves) == 1
    with pytest.raises(cl.InputError, match="closed"):
        cl.slices(slope, "z=5.05", max_edge=0.5, closed=True)


def test_a_section_ends_where_its_line_does():
    (found,) = cl.slices(trimesh.creation.box((2, 2, 2)), cl.section("0,-5,0,0.5"))
    xy = found.curves.points.xy
    assert not found.curves.closed.any()
    assert (xy[:, 0].min(), xy[:, 0].max()) == (4, 5.5)


def test_solids_that_touch_stay_two():
    one = trimesh.creation.box((2, 2, 2))
    other = one.copy().apply_translation((2, 2, 0.3))
    (found,) = cl.slices(trimesh.util.concatenate([one, other]), "z=0.1")
    assert found.curves.closed.tolist() == [True, True]


@pytest.mark.parametrize("kind", ["stl", "stl_ascii", "obj", "ply"])
def test_files_give_outlines(kind, tmp_path, capfd):
    ezdxf = pytest.importorskip("ezdxf")
    solid, _ = plate()
    name = tmp_path / f"plate.{kind[:3]}"
    name.write_bytes(_exported(solid, kind))
    code, said = command(["reconstruct", name, "--slice", "z=0:1:0.25", "-o",
                          tmp_path / "plate.dxf"], capfd)  # fmt: skip
    assert (code, said.count("\n")) == (0, 1)
    drawing = ezdxf.readfile(tmp_path / "plate.dxf")
    assert not drawing.audit().errors
    drawn = list(drawing.modelspace())
    assert all(each.closed for each in drawn)
    assert len(drawn) == 4 * 4  # z=0 is below all of it
    assert sorted({each.dxf.elevation for each in drawn}) == [0.25, 0.5, 0.75, 1]
    assert sum(each.dxf.color == 1 for each in drawn) == 4 * 2  # holes


def _exported(solid, kind):
    made = solid.export(file_type=kind)
    return made if isinstance(made, bytes) else made.encode()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--slice", "z=9"], "is not cut by z=9: it reaches from 0 to 1"),
        (["--slice", "z=0.5", "--thickness", "1"], "without thickness"),
        (["--slice", "z=0.5", "--merge", "-1"], "merge"),
        ([], "a surface in space: cut it by planes"),
    ],
)
def test_what_the_command_refuses(arguments, words, tmp_path, capfd):
    solid, _ = plate()
    (tmp_path / "plate.stl").write_bytes(_exported(solid, "stl"))
    code, said = command(
        ["reconstruct", tmp_path / "plate.stl", *arguments, "-o", tmp_path / "out.dxf"], capfd
    )
    assert (code, said.count("\n")) == (2, 1), said
    assert words in said
    assert not (tmp_path / "out.dxf").exists()


def test_info_says_what_a_mesh_holds(tmp_path, capfd):
    solid, _ = plate()
    (tmp_path / "plate.stl").write_bytes(_exported(solid, "stl"))
    with pytest.raises(SystemExit) as caught:
        main(["info", str(tmp_path / "plate.stl")])
    said = capfd.readouterr().out
    assert not caught.value.code
    assert re.search(r"closed +yes", said)
    assert re.search(r"extent +0, 0, 0, 6, 4, 1\n", said)
    assert "--slice z=0.5" in said


@pytest.mark.parametrize(
    "content",
    [b"", b"solid a\nfacet", b"\0" * 84, b"\0" * 80 + b"\xff\xff\xff\x7f" + b"\0" * 50,
     b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\nvertex 1 0 0\nvertex 0 1 0\n"
     b"endloop\nendfacet\nendsolid"],
)  # fmt: skip
def test_ill_stl_is_refused_in_a_sentence(content, tmp_path):
    (tmp_path / "ill.stl").write_bytes(content)
    with pytest.raises(cl.FormatError) as caught:
        cl.slices(tmp_path / "ill.stl", "z=0.5")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("vertices", "faces"),
    [(np.eye(3), [[0, 1, 3]]), (np.eye(3), [[0, 1, -1]]), (np.eye(3) * np.nan, [[0, 1, 2]]),
     (np.eye(3)[:, :2], [[0, 1, 2]]), (np.eye(3), [[0, 1]]), (np.eye(3) * 1e300, [[0, 1, 2]])],
)  # fmt: skip
def test_ill_meshes_are_refused(vertices, faces):
    given = SimpleNamespace(vertices=vertices, faces=np.array(faces))
    with pytest.raises(cl.CrustlineError) as caught:
        cl.slices(given, "z=0.5")
    assert "\n" not in str(caught.value)
