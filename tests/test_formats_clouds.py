"""Clouds in files: round trips, other readers, files by other tools' conventions, and refusals."""

from __future__ import annotations

import io
import struct

import numpy as np
import pytest

import crustline as cl
from fuzz import clouds

laspy = pytest.importorskip("laspy")
pytest.importorskip("lazrs")


def refusal(content, **how):
    """What is said of a file, read and sliced; one sentence."""
    said = []
    for call in (cl.read, lambda each, **how: cl.slices(each, "z=0.3", thickness=0.5, **how)):
        with pytest.raises(cl.FormatError) as caught:
            call(content, **how)
        said.append(str(caught.value))
    assert "\n" not in "".join(said)
    return said[0]


def patched(content, place, form, *values):
    """A file with some numbers changed."""
    made = bytearray(content)
    struct.pack_into(form, made, place, *values)
    return bytes(made)


# --- Round trips and other readers ----------------------------------------------------------


@pytest.mark.parametrize("suffix", ["las", "laz"])
def test_las_keeps_places_to_its_step_and_columns_to_the_bit(suffix, tmp_path):
    rng = np.random.default_rng(0)
    xyz = rng.uniform(0, 100, (500, 3)) + np.array([500_000, 5_000_000, 0])
    columns = {"intensity": np.arange(500, dtype=np.uint16), "quality": rng.random(500)}
    points = cl.Points(xyz[:, :2], z=xyz[:, 2], columns=columns, crs="EPSG:25832")
    path = tmp_path / f"a.{suffix}"
    points.write(path)
    back = cl.read(path)
    assert np.abs(back.xy - points.xy).max() < 1e-6
    assert back.crs == "EPSG:25832"
    assert (back.columns["intensity"] == columns["intensity"]).all()
    assert (back.columns["quality"] == columns["quality"]).all()
    other = laspy.read(path)
    assert other.header.point_count == 500
    assert other.header.parse_crs().to_epsg() == 25832
    assert np.abs(np.asarray(other.z) - xyz[:, 2]).max() < 1e-6


def test_ply_keeps_all_to_the_bit_and_trimesh_reads_it(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    xyz = np.random.default_rng(0).normal(size=(100, 3)) * 1e7
    columns = {"red": np.arange(100, dtype=np.uint8), "w": xyz[:, 0] / 7, "n": np.arange(100)}
    points = cl.Points(xyz[:, :2], z=xyz[:, 2], columns=columns)
    points.write(tmp_path / "a.ply")
    assert cl.read(tmp_path / "a.ply") == points.replace(columns={**columns, "n": np.arange(100.0)})
    assert (np.asarray(trimesh.load(tmp_path / "a.ply").vertices) == xyz).all()


def test_streams_are_the_whole(tmp_path):
    from crustline.formats import stream

    for key in ("las", "laz", "ply", "pts", "e57"):
        for content in clouds.seeds().get(key, []):
            pieces = list(stream(content, 7, format=key))
            whole = cl.read(content, format=key)
            assert (np.concatenate([each.xy for each in pieces]) == whole.xy).all()
            assert (np.concatenate([np.asarray(each.z) for each in pieces]) == whole.z).all()


def test_copc_gives_what_the_whole_file_gives():
    content = clouds.copc()
    whole = laspy.read(io.BytesIO(content))
    xyz = np.asarray(whole.xyz)
    for plane in ("z=1", "z=6", "x=4", "1,1,1=12"):
        (found,) = cl.slices(content, plane, thickness=0.8, fit=False, format="laz")
        near = np.abs(xyz @ found.plane.normal - found.plane.offset) <= 0.4
        assert 0 < near.sum() == found.count
    (found,) = cl.slices(content, cl.section("0,0,8,3"), thickness=1, fit=False, format="laz")
    assert found.count > 10


def test_an_octree_is_read_where_it_meets_a_box():
    from crustline.formats.las import cloud
    from crustline.formats.source import Source

    box = np.array([[-np.inf, -np.inf, 0.5], [np.inf, np.inf, 1.5]])
    some = sum(map(len, cloud(Source(clouds.copc()), box)))
    assert 30 < some < 200


@pytest.mark.parametrize("key", ["las", "laz"])
def test_a_slice_may_have_two_points_of_a_file(key):
    """laspy takes an index of two rows for a row and a column."""
    content = clouds.seeds()[key][0]
    (found,) = cl.slices(content, ["x=1", "y=0"], thickness=0.002, fit=False, format=key)[:1]
    assert found.count == 1
    z = clouds.xyz(8)[:, 2]
    (found,) = cl.slices(clouds.las(3, key == "laz", count=8), "z=0.25", thickness=0.1, fit=False,
                         format=key)  # fmt: skip
    assert found.count == (z == 0.25).sum() == 2


def test_withheld_points_are_no_part_of_a_slice():
    made = laspy.read(io.BytesIO(clouds.las(6, False)))
    made.withheld[::2] = 1
    stream = io.BytesIO()
    made.write(stream, do_compress=False)
    every, half = (
        cl.slices(each, "z=0.3", thickness=1, fit=False)[0].count
        for each in (clouds.las(6, False), stream.getvalue())
    )
    assert half * 2 == every > 10


# --- Files as other tools write them --------------------------------------------------------

ROWS = [(1.5, 2.5, 3.5), (4, 5, 6), (7, 8, 9.25)]
FACE = b"element face 0\nproperty list uchar int vertex_indices\n"


def binary_ply(order, kinds, extra=b"", names="x y z"):
    """A PLY of numbers, with types and order as given."""
    codes = {"float": "f", "double": "d"}
    form = ("<" if "little" in order else ">") + "".join(codes[each] for each in kinds)
    properties = "".join(
        f"property {kind} {name}\n" for kind, name in zip(kinds, names.split(), strict=True)
    )
    head = f"ply\nformat {order} 1.0\nelement vertex 3\n{properties}".encode()
    return head + extra + b"end_header\n" + b"".join(struct.pack(form, *row) for row in ROWS)


FOREIGN = {
    "MeshLab, float": ("ply", binary_ply("binary_little_endian", ["float"] * 3, FACE)),
    "big-endian doubles": ("ply", binary_ply("binary_big_endian", ["double"] * 3)),
    "mixed types": ("ply", binary_ply("binary_little_endian", ["double", "double", "float"])),
    "CloudCompare, text": (
        "ply",
        b"ply\nformat ascii 1.0\ncomment Created by CloudCompare\nobj_info Generated\n"
        b"element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        b"property float scalar_Intensity\nend_header\n1.5 2.5 3.5 1\n4 5 6 2\n7 8 9.25 3\n",
    ),
    "CRLF and spaces": (
        "ply",
        b"ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float64 x\r\nproperty float64 y"
        b"\r\nproperty float64 z\r\nend_header\r\n  1.5\t2.5 3.5 \r\n4 5 6\r\n7 8 9.25\r\n",
    ),
    "Leica PTS with colors": (
        "pts", b"3\n1.5 2.5 3.5 -1200 10 20 30\n4 5 6 2047 0 0 0\n7 8 9.25 1 255 255 255\n"
    ),
    "PTS in two blocks": ("pts", b"2\r\n1.5 2.5 3.5\r\n4 5 6\r\n1\r\n7 8 9.25\r\n"),
    "PTS with a blank line at its end": ("pts", b"3\n1.5 2.5 3.5 1\n4 5 6 1\n7 8 9.25 1\n\n\n"),
    "XYZ with colors": ("xyz", b"1.5 2.5 3.5 255 0 0\n4 5 6 0 0 0\n7 8 9.25 1 1 1\n"),
    "XYZ by CloudCompare": ("xyz", b"//X Y Z\n1.5 2.5 3.5\n4 5 6\n7 8 9.25\n"),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore:.*takes the first of 6 columns")
@pytest.mark.parametrize("name", FOREIGN)
def test_text_and_numbers_of_other_tools(name):
    key, content = FOREIGN[name]
    points = cl.read(content, format=key)
    assert np.column_stack([points.xy, np.asarray(points.z)]).tolist() == [
        list(each) for each in ROWS
    ]
    (found,) = cl.slices(content, "z=6", thickness=0.1, fit=False, format=key)
    assert found.curves.points.xy.tolist() == [[4, 5]]


@pytest.mark.parametrize(
    "change",
    [
        {},
        {"place": 26, "form": "<32s", "values": (b"PDAL",)},
        {"place": 90, "form": "<HH", "values": (0, 0)},  # no date
        {"place": 179, "form": "<6d", "values": (0,) * 6},  # no extent
        {"place": 111, "form": "<5I", "values": (0,) * 5},  # no points by return
        {"place": 6, "form": "<H", "values": (0,)},  # no global encoding
    ],
)
@pytest.mark.parametrize("kind", [0, 1, 2, 3])
def test_headers_of_other_tools(change, kind):
    content = clouds.las(kind, False)
    if change:
        content = patched(content, change["place"], change["form"], *change["values"])
    points = cl.read(content, format="las")
    xyz = np.column_stack([points.xy, np.asarray(points.z)])
    assert np.abs(xyz - clouds.xyz()).max() <= 0.0005 + 1e-9


# --- Refusals -------------------------------------------------------------------------------


@pytest.mark.parametrize("packed", [False, True])
def test_what_was_cut_off_is_refused_wherever_it_ends(packed):
    content = clouds.las(6, packed)
    for end in [*range(4, 400, 13), *range(400, len(content), 31), len(content) - 1]:
        said = refusal(content[:end], format="laz" if packed else "las")
        assert len(said) < 400


@pytest.mark.parametrize(
    ("place", "form", "values", "words"),
    [
        (247, "<Q", (10**12,), "says 1,000,000,000,000 points"),
        (247, "<Q", (41,), "41 points, and there is room for 40"),
        (96, "<I", (10**9,), "start at byte 1,000,000,000"),
        (94, "<H", (20,), "after a header of 20"),
        (100, "<I", (2**32 - 1,), "4,294,967,295 records"),
        (104, "<B", (50,), "format 50"),
        (105, "<H", (3,), "have 3 bytes each"),
        (131, "<d", (0.0,), "scales"),
        (131, "<d", (float("nan"),), "scales"),
        (155, "<d", (float("inf"),), "scales and offsets"),
        (25, "<B", (9,), "LAS 1.9"),
        (235, "<QI", (10**15, 3), "extended record 0 of 3"),
    ],
)
def test_a_las_header_that_lies_is_found(place, form, values, words):
    assert words in refusal(patched(clouds.las(6, False), place, form, *values), format="las")


def test_a_laz_header_that_lies_is_found():
    content = clouds.las(6, True)
    assert "chunks" in refusal(patched(content, 247, "<Q", 10**9), format="laz")
    start = struct.unpack_from("<I", content, 96)[0]
    assert "table" in refusal(patched(content, start, "<q", 10**12), format="laz")


def test_an_octree_that_lies_is_found():
    content = clouds.copc()
    page = len(content) - 9 * 32
    for place, form, value in (
        (page + 28, "<i", 10**9),  # points of the root
        (page + 28, "<i", -1),  # a page that is no page, or itself
        (page + 16, "<Q", 10**12),  # beyond the end
        (page + 24, "<i", -5),
    ):
        with pytest.raises(cl.FormatError) as caught:
            cl.slices(patched(content, place, form, value), "z=1", thickness=1, format="laz")
        assert "octree" in str(caught.value)


def test_a_page_of_an_octree_that_leads_to_itself_ends():
    content = clouds.copc()
    page = len(content) - 9 * 32
    loop = patched(content, page + 16, "<Qii", page, 9 * 32, -1)
    with pytest.raises(cl.FormatError, match="octree"):
        cl.slices(loop, "z=1", thickness=1, format="laz")


VERTICES = b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (VERTICES + b"property list float int odd\nproperty float z\nend_header\n", "hold lists"),
        (VERTICES + b"property flaot z\nend_header\n1 2 3\n4 5 6\n", "'flaot' is no type"),
        (VERTICES + b"property float z\nend_header\n1 2 3\n", "2 vertices, and 1 are there"),
        (VERTICES + b"property float z\nend_header\n1 2 3\n4 5\n", "vertex 1"),
        (VERTICES + b"property float z\nend_header\n1 2 3\n4 5 x\n", "vertex 1"),
        (VERTICES + b"property uchar z\nend_header\n1 2 3\n4 5 999\n", "vertex 1"),
        (VERTICES + b"property float x\nend_header\n1 2 3\n4 5 6\n", "twice"),
        (VERTICES, "no end"),
        (b"ply\nelement vertex 1\nproperty float x\nend_header\n1\n", "no format"),
        (b"ply\nformat ascii 1.0\nend_header\n", "no vertices"),
        (b"ply\nformat ascii 1.0\nelement vertex 99999999999999999999\nend_header\n", "no line"),
        (b"ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\n"
         b"property double x\nproperty double y\nproperty double z\nend_header\n" + b"\0" * 48,
         "999,999,999,999 vertices, and 2 are there"),
    ],
)  # fmt: skip
def test_ill_ply_is_refused(content, words):
    assert words in refusal(content, format="ply")


@pytest.mark.parametrize(
    "face",
    [
        b"property list float int vertex_indices\n",
        b"property list uchar float vertex_index\n",
        b"property list uchar int corners\n",
        b"property int vertex_indices\n",
    ],
)
def test_lists_of_faces_in_odd_types_are_refused(face):
    content = (
        VERTICES
        + b"property float z\nelement face 1\n"
        + face
        + b"end_header\n1 2 3\n4 5 6\n2 0 1\n"
    )
    with pytest.raises(cl.FormatError) as caught:
        cl.slices(content, "z=4", format="ply")
    assert "faces" in str(caught.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "empty"),
        (b"x y z\n1 2 3\n", "line 1"),
        (b"3\n1 2 3\n4 5 6\n", "says 3 points, and 2 are there"),
        (b"2\n1 2 3\n4 5\n", "line 3"),
        (b"2\n1 2 3\n4 5 nan\n", "line 3"),
        (b"1\n1 2 3 4 5\n", "5 columns"),
        (b"99999999999999999\n1 2 3\n", "1 are there"),
        (b"1\n1 2 3\nend\n", "line 3"),
    ],
)
def test_ill_pts_is_refused(content, words):
    assert words in refusal(content, format="pts")
