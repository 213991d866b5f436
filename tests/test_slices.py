"""Slices of clouds: what is in them, the curves against a building that is known, and refusals."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
import shapely

import crustline as cl
from building import COURT, HEIGHT, OUTSIDE, along_walls, distance_to_walls, scan
from crustline.cli import main
from crustline.formats.cloud import chunks_of_array
from crustline.slices.band import bands_of, box_of
from crustline.slices.join import thinned
from crustline.slices.plane import as_planes

pytest.importorskip("scipy")
UTM = (500_000.0, 5_400_000.0, 300.0)


def command(arguments, capfd):
    """Run the command; return its code and what it said."""
    with pytest.raises(SystemExit) as caught:
        main([str(each) for each in arguments])
    return caught.value.code, capfd.readouterr().err


def polygons_of(curves):
    """The area inside, by shapely."""
    made = [
        shapely.Polygon(curves.points.xy[each.shell], [curves.points.xy[h] for h in each.holes])
        for each in curves.polygons()
    ]
    return shapely.union_all(made)


# --- Planes ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("z=12.5", ["z=12.5"]),
        ("Z = -0", ["z=0"]),
        ("z=0:1:0.25", ["z=0", "z=0.25", "z=0.5", "z=0.75", "z=1"]),
        ("x=0:0.3:0.1", ["x=0", "x=0.1", "x=0.2", "x=0.3"]),
        ("1,0,2=5", ["1,0,2=5"]),
        ("0,0,-1=1e1", ["0,0,-1=10"]),
    ],
)
def test_planes_are_written_like_this(text, names):
    assert [plane.name for plane in as_planes(text)] == names


@pytest.mark.parametrize(
    "text",
    ["", "z", "z=", "z=a", "w=1", "z=1:2", "z=1:2:0", "z=2:1:1", "z=0:1e9:0.001", "0,0,0=1",
     "1,2=3", "z=nan", "z=inf", "z=1e999", "nan,0,1=1", "1,0,1=1:2:3:4", "z==1", "z=1=2"],
)  # fmt: skip
def test_planes_that_are_none_are_refused(text):
    with pytest.raises(cl.InputError, match="plane") as caught:
        as_planes(text)
    assert "\n" not in str(caught.value)


def test_a_plane_twice_is_refused():
    with pytest.raises(cl.InputError, match="more than once"):
        as_planes(["z=1", "z=0:2:1"])


@pytest.mark.parametrize("line", ["0,0,0,0", "1,2,3", "a,b,c,d", [1, 2], None, "0,0,nan,1"])
def test_sections_that_are_no_lines_are_refused(line):
    with pytest.raises(cl.InputError, match="section"):
        cl.section(line)


@pytest.mark.parametrize("normal", ["z", "x", "y", "1,0,2", "1,1,1", "-1,2,-3", "0,0,-1", "0,-2,0"])
def test_axes_of_a_plane_are_a_basis_and_lead_back(normal):
    (plane,) = as_planes(f"{normal}=3")
    axes = np.stack([plane.across, plane.up, plane.normal])
    assert np.allclose(axes @ axes.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1)
    assert plane.across[2] == 0 <= plane.up[2]
    known = {"x": "1,0,0", "y": "0,1,0", "z": "0,0,1"}
    wanted = [float(each) for each in known.get(normal, normal).split(",")]
    uv = np.random.default_rng(0).normal(size=(50, 2)) * 1e3
    xyz = plane.lift(uv)
    assert np.allclose(xyz @ wanted, 3, atol=1e-9)
    assert np.allclose(plane.project(xyz), uv, atol=1e-9)


def test_a_horizontal_plane_keeps_x_and_y_to_the_bit():
    xyz = np.random.default_rng(0).normal(size=(1000, 3)) * 1e7
    (plane,) = as_planes("z=0.1")
    assert (plane.project(xyz) == xyz[:, :2]).all()
    assert (plane.lift(xyz[:, :2])[:, :2] == xyz[:, :2]).all()
    assert (plane.lift(xyz[:, :2])[:, 2] == 0.1).all()


# --- Bands ----------------------------------------------------------------------------------


def test_a_band_holds_what_is_within_half_the_thickness():
    rng = np.random.default_rng(1)
    xyz = rng.uniform(-5, 5, (5000, 3))
    planes = as_planes(["z=-4:4:0.5", "x=1", "1,2,3=1:2:1", cl.section("-4,-3,3,4"), "y=-2"])
    thickness = [*rng.uniform(0.1, 1.5, 17), 0.3, 0.2, 0.2, 0.5, 1.0]
    found = bands_of(chunks_of_array(xyz), planes, thickness)
    for plane, thick, points in zip(planes, thickness, found.points, strict=True):
        uv = plane.project(xyz)
        near = np.abs(xyz @ plane.normal - plane.offset) <= thick / 2
        if plane.ends:
            near &= (uv[:, 0] >= 0) & (uv[:, 0] <= plane.ends[1])
        assert near.any()
        assert np.allclose(points, uv[near], atol=1e-12)
    low, high = box_of(planes[:1], thickness[:1])
    assert (low, high) == (pytest.approx([-np.inf, -np.inf, -4 - thickness[0] / 2]),
                           pytest.approx([np.inf, np.inf, -4 + thickness[0] / 2]))  # fmt: skip


def test_the_box_of_a_section_holds_its_band():
    rng = np.random.default_rng(2)
    xyz = rng.uniform(-5, 5, (5000, 3))
    plane = cl.section("-4,-3,3,4")
    low, high = box_of([plane], [0.5])
    inside = ((xyz >= low) & (xyz <= high)).all(axis=1)
    assert 0 < inside.sum() < len(xyz)
    every, some = (bands_of(chunks_of_array(each), [plane], [0.5]) for each in (xyz, xyz[inside]))
    assert (every.points[0] == some.points[0]).all()


def test_thinning_takes_means_of_cells_in_any_order():
    rng = np.random.default_rng(3)
    uv = rng.normal(size=(3000, 2)) + 5e6
    few = thinned(uv, 0.25)
    assert (thinned(uv[rng.permutation(3000)], 0.25) == few).all()
    cells = {tuple(cell) for cell in np.floor(uv / 0.25)}
    assert len(few) == len(cells)
    for mean in few[::50]:
        inside = (np.floor(uv / 0.25) == np.floor(mean / 0.25)).all(axis=1)
        assert np.allclose(uv[inside].mean(axis=0), mean, atol=1e-8)


# --- Curves against the truth ---------------------------------------------------------------


@pytest.mark.parametrize("origin", [(0.0, 0.0, 0.0), UTM])
def test_a_slice_of_a_building_is_its_walls(origin):
    cloud = scan(origin=origin)
    (found,) = cl.slices(cloud, f"z={origin[2] + 3}", thickness=0.1)
    curves = found.curves
    assert len(curves) == 2
    assert curves.closed.all()
    xy = curves.points.xy - origin[:2]
    assert np.quantile(distance_to_walls(xy), 0.95) < 0.015
    assert distance_to_walls(xy).max() < 0.06  # at corners, which are rounded by half a cell
    lines = shapely.union_all([shapely.LinearRing(xy[each.indices]) for each in curves])
    assert shapely.distance(shapely.points(along_walls()), lines).max() < 0.06
    truth = shapely.Polygon(OUTSIDE, [COURT])
    inside = shapely.transform(polygons_of(curves), lambda each: each - origin[:2])
    assert inside.symmetric_difference(truth).area < 0.005 * truth.area
    assert (found.in_space.points.z == origin[2] + 3).all()


def test_the_order_of_points_and_threads_decide_nothing():
    cloud = scan(30_000)
    one = cl.slices(cloud, "z=1:5:1", thickness=0.2, threads=1)
    other = cl.slices(
        cloud[np.random.default_rng(0).permutation(len(cloud))], "z=1:5:1", thickness=0.2
    )
    assert one == other


def test_a_gap_stays_open_where_it_is_told_to():
    (closed,) = cl.slices(scan(), "z=3", thickness=0.1, closed=True)
    (short,) = cl.slices(scan(), "z=3", thickness=0.1, max_edge=0.6)
    assert closed.curves.closed.all()
    assert sorted(short.curves.closed.tolist()) == [False, True]


def test_a_section_is_two_walls_and_comes_back_to_space():
    line = "-1,7,8,7.5"  # across the wing
    (found,) = cl.slices(scan(400_000), cl.section(line), thickness=0.3)
    assert len(found.curves) == 2
    assert not found.curves.closed.any()
    points = found.in_space.points
    u, v = found.curves.points.xy.T
    direction = np.array([9, 0.5]) / np.hypot(9, 0.5)
    assert np.allclose(points.xy, [-1, 7] + u[:, None] * direction, atol=1e-12)
    assert (points.z == v).all()
    assert distance_to_walls(points.xy, OUTSIDE).max() < 0.1
    for each in found.curves:
        assert np.ptp(each.points[:, 1]) > HEIGHT - 0.4


def test_upright_rings_keep_their_holes_in_space():
    rng = np.random.default_rng(0)
    angle = rng.uniform(0, 2 * np.pi, 40_000)
    radius = rng.choice([1.0, 0.5], 40_000)
    pipe = np.stack([rng.uniform(0, 2, 40_000), radius * np.cos(angle), radius * np.sin(angle)], 1)
    (found,) = cl.slices(pipe, "x=1", thickness=0.05)
    (polygon,) = found.in_space.polygons()
    assert len(polygon.holes) == 1


def test_points_can_be_joined_as_they_are():
    angle = np.arange(40) * np.pi / 20
    ring = np.stack([np.cos(angle), np.sin(angle), np.full(40, 2.0)], axis=1)
    (found,) = cl.slices(
        np.vstack([ring, ring + np.array([0, 0, 1])]), "z=2", thickness=0.1, fit=False
    )
    assert found.curves.indices.tolist() == list(range(40))
    assert (found.curves.points.xy == ring[:, :2]).all()
    (other,) = cl.slices(ring, "z=2", thickness=0.1, fit=False, method=cl.crust)
    assert other.curves == found.curves


# --- Files ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    pytest.importorskip("laspy")
    pytest.importorskip("lazrs")
    folder = tmp_path_factory.mktemp("scans")
    xyz = scan(60_000, origin=UTM)
    points = cl.Points(xyz[:, :2], z=xyz[:, 2], crs="EPSG:25832")
    for suffix in ("las", "laz", "npz", "csv"):
        points.write(folder / f"scan.{suffix}")
    return folder


@pytest.mark.parametrize("suffix", ["las", "laz", "csv", "npz"])
def test_the_command_writes_one_layered_file(folder, suffix, capfd):
    ezdxf = pytest.importorskip("ezdxf")
    pyogrio = pytest.importorskip("pyogrio")
    out = folder / suffix
    out.mkdir()
    outputs = [f"-o{out}/floors.{kind}" for kind in ("dxf", "gpkg", "geojson")]
    code, said = command(
        ["reconstruct", folder / f"scan.{suffix}", "--slice", "z=301:305:1", "--slice", "z=310",
         "--thickness", "0.3", "--polygons", "--crs", "EPSG:25832", *outputs], capfd,
    )  # fmt: skip
    assert code == 0, said
    assert "5 slices, 1 empty plane" in said
    drawing = ezdxf.readfile(out / "floors.dxf")
    assert not drawing.audit().errors
    rings = [each for each in drawing.modelspace() if each.closed]
    assert sorted({each.dxf.layer for each in rings}) == [f"z_{z}" for z in range(301, 306)]
    assert all(each.dxf.elevation == float(each.dxf.layer[2:]) for each in rings)
    assert len(rings) == 10
    assert [name for name, _ in pyogrio.list_layers(out / "floors.gpkg")] == [
        f"z={z}" for z in range(301, 306)
    ]
    frame = pyogrio.read_dataframe(out / "floors.gpkg", layer="z=303")
    assert frame.crs.to_epsg() == 25832
    truth = shapely.Polygon(OUTSIDE + UTM[:2], [COURT + UTM[:2]])
    assert frame.geometry[0].symmetric_difference(truth).area < 0.02 * truth.area
    assert frame.geometry[0].has_z
    every = pyogrio.read_dataframe(out / "floors.geojson")
    assert [each[0] for each in every["slice"]] == [f"z={z}" for z in range(301, 306)]


def test_all_formats_give_the_same_slice(folder):
    made = [cl.slices(folder / f"scan.{each}", "z=303", thickness=0.1, crs="EPSG:25832")
            for each in ("npz", "csv", "las", "laz")]  # fmt: skip
    assert made[0] == made[1]
    assert made[2] == made[3]
    assert np.allclose(made[0][0].curves.points.xy, made[2][0].curves.points.xy, atol=1e-3)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--slice", "z=99", "--thickness", "0.1"], "no point within 0.05 of z=99"),
        (["--slice", "z=303"], "thickness"),
        (["--slice", "z=303", "--thickness", "-1"], "thickness"),
        (["--slice", "z=3o3", "--thickness", "1"], "is not understood"),
        (["--section", "1,2,3", "--width", "1"], "is no line"),
        (["--section", "0,0,1,1", "--width", "1"], "no point"),
        (["--slice", "z=303", "--thickness", "0.1", "--by", "a"], "--by is not for slices"),
        (["--slice", "z=303", "--thickness", "0.1", "--fit"], "--fit is not for slices"),
        (["--thickness", "0.1"], "add --slice"),
        (["--slice", "z=303", "--thickness", "0.1", "--scale", "1e-30"], "scale"),
    ],
)
def test_what_the_command_refuses(folder, arguments, words, capfd):
    code, said = command(
        ["reconstruct", folder / "scan.laz", *arguments, "-o", folder / "none.dxf"], capfd
    )
    assert code == 2
    assert words in said
    assert said.count("\n") == 1
    assert not (folder / "none.dxf").exists()


def test_points_without_heights_are_no_cloud(folder):
    with pytest.raises(cl.InputError, match="heights"):
        cl.slices(b"x,y\n1,2\n3,4\n", "z=1", thickness=1)
    with pytest.raises(cl.InputError, match="shape"):
        cl.slices([[1, 2], [3, 4]], "z=1", thickness=1)


def test_a_large_file_needs_the_memory_of_a_piece(tmp_path):
    """Of a file of 6 million points a slice needs far less memory than the file."""
    laspy = pytest.importorskip("laspy")
    header = laspy.LasHeader(version="1.2", point_format=3)
    header.scales, header.offsets = [0.001] * 3, [0.0] * 3
    rng = np.random.default_rng(0)
    with laspy.open(tmp_path / "large.las", "w", header=header) as file:
        for _ in range(6):
            record = laspy.ScaleAwarePointRecord.zeros(1_000_000, header=header)
            record.x, record.y = rng.uniform(0, 10, (2, 1_000_000))
            record.z = rng.uniform(0, 1000, 1_000_000)
            file.write_points(record)
    program = (
        "import sys, crustline as cl, laspy\n"
        "def peak():\n"
        "    with open('/proc/self/status') as file:\n"
        "        return next(int(x.split()[1]) << 10 for x in file if x.startswith('VmHWM'))\n"
        "cl.slices\n"
        "before = peak()\n"
        "print(cl.slices(sys.argv[1], 'z=500', thickness=0.1, fit=False)[0].count, peak() - before)"
    )
    ran = subprocess.run([sys.executable, "-c", program, tmp_path / "large.las"],
                         capture_output=True, text=True, check=True)  # fmt: skip
    count, more = map(int, ran.stdout.split())
    assert 400 < count < 800
    assert more < 150 << 20  # the file has 204 MB, a piece of it 34, and its heights 8
