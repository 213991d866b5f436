"""GIS, CAD and tables: what is written reads back and opens elsewhere; bad files are refused."""

from __future__ import annotations

import io
import subprocess
import sys
import warnings
from pathlib import Path

import ezdxf
import geopandas
import numpy as np
import openpyxl
import pandas
import polars
import pyarrow
import pyarrow.parquet
import pyogrio
import pytest
import shapely
from hypothesis import assume, given, settings

import crustline as cl
from crustline.errors import FormatWarning, InputError
from crustline.formats import layers
from test_formats_round_trip import again, plain
from test_formats_round_trip import points as any_points

EXACT = ["gpkg", "shp", "fgb", "parquet"]  # files that keep every bit of a coordinate and the CRS
LONLAT = ["kml", "gpx"]  # files that know longitude and latitude only, in decimal digits
ALL = [*EXACT, *LONLAT, "dxf", "feather"]


def ring(n: int = 24, radius: float = 1.0, center: tuple[float, float] = (0, 0)) -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return np.c_[np.cos(t), np.sin(t)] * radius + center


@pytest.fixture(scope="module")
def curves() -> cl.Curves:
    """A ring with a hole, a line, and an isolated point, with heights, columns and a CRS."""
    line = np.c_[np.linspace(5, 7, 9), np.zeros(9)]
    xy = np.concatenate([ring(radius=3), ring(), line, [[60, 60]]])
    z = np.arange(len(xy), dtype=float) + 1
    kind = np.repeat(np.array(["ring", "hole", "line", "dot"], dtype=object), [24, 24, 9, 1])
    points = cl.Points(xy, z=z, columns={"kind": kind, "n": np.arange(len(xy))}, crs="EPSG:4326")
    return cl.reconstruct(points, method=cl.crust)


@pytest.mark.parametrize("key", ["gpkg", "fgb", "parquet", "feather"])
@settings(max_examples=15)
@given(points=any_points())
def test_any_points_come_back(key: str, points: cl.Points) -> None:
    assume(len(points))
    assume(key == "feather" or points.crs != "local grid")  # which only Feather takes as it is
    try:
        back = again(points, key)
    except InputError as error:
        assume("beyond what" not in str(error))
        raise
    assert back.xy.tobytes() == points.xy.tobytes()
    assert (back.z is None) == (points.z is None)
    assert points.z is None or back.z.tobytes() == points.z.tobytes()
    assert back.crs == points.crs
    assert len(back.columns) == len(points.columns)
    for name, found in zip(points.columns, back.columns, strict=True):
        assert found in (name, f"input_{name}")
        expected, values = points.columns[name], back.columns[found]
        if values.dtype == np.object_ and expected.dtype.kind in "mMu":  # which GDAL cannot hold
            kind = "m8[s]" if expected.dtype.kind == "m" else expected.dtype
            words = [each.removesuffix(" seconds") for each in values]
            assert np.array(words).astype(kind).tolist() == expected.astype(kind).tolist(), name
        elif expected.dtype.kind in "mM":
            assert np.array_equal(values, expected, equal_nan=True), name
        else:
            assert plain(values) == plain(expected), name


@pytest.mark.parametrize("suffix", [*EXACT, "feather"])
def test_points_keep_heights_columns_and_crs(
    tmp_path: Path, suffix: str, curves: cl.Curves
) -> None:
    path = tmp_path / f"points.{suffix}"
    cl.write(curves.points, path)
    again = cl.read(path)
    np.testing.assert_array_equal(again.xy, curves.points.xy)
    np.testing.assert_array_equal(again.z, curves.points.z)
    assert again.crs == "EPSG:4326"
    assert again.columns["kind"].tolist() == curves.points.columns["kind"].tolist()


@pytest.mark.parametrize("suffix", LONLAT)
def test_longitude_and_latitude_keep_fifteen_digits(
    tmp_path: Path, suffix: str, curves: cl.Curves
) -> None:
    path = tmp_path / f"points.{suffix}"
    cl.write(curves.points, path)
    again = cl.read(path)
    np.testing.assert_allclose(again.xy, curves.points.xy, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(again.z, curves.points.z)
    assert again.columns["n"].tolist() == list(range(58))


@pytest.mark.parametrize("suffix", LONLAT)
def test_other_systems_are_projected_for_files_of_longitude_and_latitude(
    tmp_path: Path, suffix: str
) -> None:
    path = tmp_path / f"points.{suffix}"
    cl.write(cl.Points([(500_000, 5_400_000), (500_100, 5_400_000)], crs="EPSG:25832"), path)
    again = cl.read(path)
    assert again.crs == "EPSG:4326"
    np.testing.assert_allclose(again.xy[0], [9, 48.75], atol=0.01)


@pytest.mark.parametrize("suffix", ["gpkg", "shp", "fgb", "parquet"])
def test_polygons_and_lines_open_in_geopandas(
    tmp_path: Path, suffix: str, curves: cl.Curves
) -> None:
    path = tmp_path / f"curves.{suffix}"
    cl.write(curves, path, polygons=True)
    if suffix == "parquet":
        frame = geopandas.read_parquet(path)
    else:
        frame = geopandas.read_file(path, layer="curves")
    polygon = frame.geometry.iloc[0]
    assert polygon.geom_type == "Polygon"
    assert polygon.is_valid
    assert polygon.has_z
    assert len(polygon.interiors) == 1
    # Shapefiles run around the outside clockwise, unlike all others.
    assert polygon.exterior.is_ccw == (suffix != "shp")
    assert polygon.interiors[0].is_ccw == (suffix == "shp")
    assert frame.crs.to_epsg() == 4326
    assert frame["closed"].iloc[0]


@pytest.mark.parametrize("suffix", ["gpkg", "kml"])
def test_what_is_of_another_type_is_a_layer(tmp_path: Path, suffix: str, curves: cl.Curves) -> None:
    path = tmp_path / f"curves.{suffix}"
    cl.write(curves, path, polygons=True)
    counts = {each.name: each.count for each in layers(path)}
    assert counts == {"curves": 1, "curves_lines": 1, "curves_isolated": 1}
    with pytest.raises(cl.FormatError, match="choose one \\(--layer NAME\\)"):
        cl.read(path)
    assert len(cl.read(path, layer="curves_isolated")) == 1


def test_shapefiles_of_another_type_stand_beside(tmp_path: Path, curves: cl.Curves) -> None:
    long = cl.reconstruct(ring(200), method=cl.crust)
    with pytest.warns(FormatWarning, match="'rows' is left out: write a GeoPackage"):
        cl.write(long, tmp_path / "long.shp")
    (tmp_path / "long.shp").unlink()
    cl.write(curves, tmp_path / "curves.shp", polygons=True)
    kinds = {path.stem for path in tmp_path.glob("*.shp")}
    assert kinds == {"curves", "curves_lines", "curves_isolated"}
    assert not list(tmp_path.glob(".*"))


@pytest.mark.parametrize("suffix", [*EXACT, "dxf", "kml"])
def test_read_curves_gives_the_lines_back(tmp_path: Path, suffix: str) -> None:
    curves = cl.reconstruct(cl.Points(ring(), crs="EPSG:4326"))
    path = tmp_path / f"curves.{suffix}"
    cl.write(curves, path)
    again = cl.read_curves(path)
    assert again.closed.tolist() == [True]
    np.testing.assert_allclose(again[0].points, curves[0].points, rtol=1e-14)


@pytest.mark.parametrize("suffix", ["gpkg", "fgb", "parquet", "kml", "gpx", "dxf"])
def test_points_go_through_streams(suffix: str) -> None:
    stream = io.BytesIO()
    points = cl.Points(ring(5), crs="EPSG:4326")
    cl.write(points, stream, format=suffix)
    again = cl.read(stream.getvalue(), format=suffix)
    np.testing.assert_allclose(again.xy, points.xy, rtol=1e-14, atol=1e-15)


def test_rows_that_do_not_fit_are_left_out(tmp_path: Path, curves: cl.Curves) -> None:
    path = tmp_path / "points.gpkg"
    cl.write(curves.points, path)
    assert len(cl.read(path, where="kind = 'line'")) == 9
    with pytest.raises(cl.InputError, match="--where"):
        cl.read(path, where="kind = = 3")


def test_lists_of_geoparquet_are_spread_over_the_vertices(
    tmp_path: Path, curves: cl.Curves
) -> None:
    path = tmp_path / "curves.parquet"
    cl.write(curves, path, polygons=True)
    again = cl.read(path)
    rows = again.columns["rows"]
    np.testing.assert_array_equal(again.xy, curves.points.xy[rows])
    assert again.columns["n"].tolist() == rows.tolist()


def test_columns_of_curves_are_kept_where_they_are_the_same(curves: cl.Curves) -> None:
    frame = curves.to_geopandas()
    assert frame["kind"].tolist() == ["ring", "hole", "line", "dot"]
    assert frame["n_max"].tolist() == [23, 47, 56, 57]
    assert [len(rows) for rows in frame["rows"]] == [24, 24, 9, 1]


# CAD


def test_dxf_has_closed_polylines_by_layer_and_units(tmp_path: Path, curves: cl.Curves) -> None:
    path = tmp_path / "curves.dxf"
    flat = cl.reconstruct(curves.points.xy, method=cl.crust)
    cl.write(flat, path, unit="mm")
    drawing = ezdxf.readfile(path)
    assert not drawing.audit().errors
    assert drawing.units == ezdxf.units.MM
    found = [(e.dxf.layer, e.dxftype()) for e in drawing.modelspace()]
    assert sorted(found) == [
        ("HOLES", "LWPOLYLINE"),
        ("OPEN", "LWPOLYLINE"),
        ("POINTS", "POINT"),
        ("RINGS", "LWPOLYLINE"),
    ]
    assert [e.closed for e in drawing.modelspace().query("LWPOLYLINE")] == [True, True, False]


def test_dxf_of_heights_is_of_polylines_in_space(tmp_path: Path, curves: cl.Curves) -> None:
    path = tmp_path / "curves.dxf"
    cl.write(curves, path)
    assert {e.dxftype() for e in ezdxf.readfile(path).modelspace()} == {"POLYLINE", "POINT"}
    np.testing.assert_array_equal(np.sort(cl.read(path).z), np.sort(curves.points.z))


def test_dxf_of_splines_is_a_spline_a_curve(tmp_path: Path) -> None:
    path = tmp_path / "splines.dxf"
    cl.write(cl.smooth(cl.reconstruct(ring())), path)
    drawing = ezdxf.readfile(path)
    assert not drawing.audit().errors
    assert [e.dxftype() for e in drawing.modelspace()] == ["SPLINE"]
    radii = np.hypot(*cl.read(path).xy.T)
    np.testing.assert_allclose(radii, 1, atol=1e-3)


def test_loose_segments_of_a_drawing_are_joined(tmp_path: Path) -> None:
    drawing = ezdxf.new()
    corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    for start, end in [(0, 1), (3, 2), (1, 2), (0, 3)]:
        drawing.modelspace().add_line(corners[start], corners[end])
    drawing.saveas(tmp_path / "box.dxf")
    curves = cl.read_curves(tmp_path / "box.dxf")
    assert curves.closed.tolist() == [True]
    assert len(curves[0]) == 4


def test_blocks_arcs_and_bulges_are_unfolded(tmp_path: Path) -> None:
    drawing = ezdxf.new()
    block = drawing.blocks.new("HOLE")
    block.add_circle((0, 0), 1, dxfattribs={"layer": "CUT"})
    for x in (0, 5):
        drawing.modelspace().add_blockref("HOLE", (x, 0))
    drawing.modelspace().add_lwpolyline([(10, 0, 0, 0, 1), (12, 0, 0, 0, 1)], close=True)
    drawing.saveas(tmp_path / "holes.dxf")
    curves = cl.read_curves(tmp_path / "holes.dxf")
    assert curves.closed.tolist() == [True] * 3
    assert len(cl.read_curves(tmp_path / "holes.dxf", layer="CUT")) == 2
    np.testing.assert_allclose(np.hypot(*(curves[2].points - [11, 0]).T), 1, atol=1e-3)


def test_blocks_that_hold_themselves_or_unfold_without_end_are_refused(tmp_path: Path) -> None:
    drawing = ezdxf.new()
    names = [f"B{k}" for k in range(9)]
    blocks = [drawing.blocks.new(name) for name in names]
    blocks[0].add_line((0, 0), (1, 1))
    for block, inner in zip(blocks[1:], names, strict=False):
        for x in range(10):
            block.add_blockref(inner, (x, 0))
    drawing.modelspace().add_blockref(names[-1], (0, 0))
    drawing.saveas(tmp_path / "bomb.dxf")
    with pytest.raises(cl.FormatError, match="explode fewer"):
        cl.read(tmp_path / "bomb.dxf")
    blocks[0].add_blockref(names[-1], (0, 0))
    drawing.saveas(tmp_path / "cycle.dxf")
    with pytest.raises(cl.FormatError, match="holds itself"):
        cl.read(tmp_path / "cycle.dxf")


@pytest.mark.parametrize("x", ["0", "1e-300", "1e17", "1e100", "1e160", "1e400"])
@pytest.mark.parametrize("radius", ["2", "1e17", "1e100", "1e160"])
def test_a_circle_whose_numbers_tell_no_halves_apart_ends(x: str, radius: str) -> None:
    """Halved until its chords are near, such a circle of a damaged file would have no end."""
    lines = ["0", "SECTION", "2", "ENTITIES", "0", "CIRCLE", "8", "a", "10", x, "20", "3"]
    content = "\n".join([*lines, "40", radius, "0", "ENDSEC", "0", "EOF", ""]).encode()
    if float(x) < 1e150 and float(radius) < 1e150:
        assert 4 <= len(cl.read(content, format="dxf")) < 1000
    else:
        with pytest.raises(cl.FormatError, match="CIRCLE on layer 'a' reaches beyond 1e\\+150"):
            cl.read(content, format="dxf")


# Tables and objects


FRAMES = {
    "geodataframe": lambda xy: geopandas.GeoDataFrame(
        {"n": range(len(xy))}, geometry=geopandas.points_from_xy(*xy.T), crs=25832
    ),
    "geoseries": lambda xy: geopandas.GeoSeries(geopandas.points_from_xy(*xy.T), crs=25832),
    "pandas": lambda xy: pandas.DataFrame({"n": range(len(xy)), "x": xy[:, 0], "y": xy[:, 1]}),
    "pandas without names": lambda xy: pandas.DataFrame(xy),
    "polars": lambda xy: polars.DataFrame({"lon": xy[:, 0], "lat": xy[:, 1]}),
    "arrow": lambda xy: pyarrow.table({"X": xy[:, 0], "Y": xy[:, 1]}),
}


@pytest.mark.parametrize("kind", FRAMES)
def test_frames_and_tables_serve_as_points(kind: str) -> None:
    xy = ring()
    frame = FRAMES[kind](xy)
    curves = cl.reconstruct(frame)
    np.testing.assert_array_equal(curves.points.xy, xy)
    assert curves.closed.tolist() == [True]
    np.testing.assert_array_equal(cl.crust(frame), cl.crust(xy))
    if kind.startswith("geo"):
        assert curves.points.crs == "EPSG:25832"


def test_a_frame_without_coordinates_is_refused() -> None:
    with pytest.raises(cl.FormatError, match="no columns x and y"):
        cl.reconstruct(pandas.DataFrame({"a": [1.0], "b": [2.0], "c": [3.0]}))


def test_missing_values_of_tables_name_the_row() -> None:
    with pytest.raises(cl.FormatError, match="row 1"):
        cl.crust(polars.DataFrame({"x": [1.0, None], "y": [2.0, 3.0]}))


def test_excel_sheets(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    book.active.append(["name", "Easting", "Northing", "n"])
    book.active.append(["a", 1.5, 2, 7])
    book.active.append(["b", 3, 4.25, 8])
    book.create_sheet("bare").append([1, 2])
    book.save(tmp_path / "points.xlsx")
    points = cl.read(tmp_path / "points.xlsx")
    assert points.xy.tolist() == [[1.5, 2], [3, 4.25]]
    assert points.names == ("Easting", "Northing")
    assert points.columns["n"].tolist() == [7, 8]
    assert cl.read(tmp_path / "points.xlsx", layer="bare").xy.tolist() == [[1, 2]]
    book.active["B3"] = "x"
    book.save(tmp_path / "points.xlsx")
    with pytest.raises(cl.FormatError, match="row 3, column 'Easting'"):
        cl.read(tmp_path / "points.xlsx")


def test_curves_become_graphs(curves: cl.Curves) -> None:
    graph = curves.to_networkx()
    assert {tuple(sorted(edge)) for edge in graph.edges} == set(map(tuple, curves.edges.tolist()))
    assert graph.nodes[0]["kind"] == "ring"
    adjacency = curves.to_scipy()
    assert (adjacency != adjacency.T).nnz == 0
    assert adjacency.nnz == 2 * len(curves.edges)
    total = sum(length for _, _, length in graph.edges(data="length"))
    assert total == pytest.approx(curves.lengths.sum())


def test_curves_have_a_geo_interface(curves: cl.Curves) -> None:
    frame = geopandas.GeoDataFrame.from_features(curves)
    assert frame.geometry.geom_type.tolist() == ["LineString"] * 3 + ["MultiPoint"]
    assert [each.geom_type for each in curves.to_shapely(polygons=True)] == [
        "Polygon", "LineString", "MultiPoint",
    ]  # fmt: skip


# Projections


def test_a_ring_across_the_180th_meridian_is_one_ring() -> None:
    around = ring(40, 3.0, (179.5, -17))
    around[:, 0] = (around[:, 0] + 180) % 360 - 180
    fiji = cl.Points(around, crs="EPSG:4326")
    assert len(cl.reconstruct(fiji, method=cl.crust)) != 1
    curves = cl.trace(fiji, cl.crust(cl.project(fiji)))
    assert curves.closed.tolist() == [True]
    assert len(curves[0]) == 40


def test_the_command_projects_and_warns_where_it_does_not(tmp_path: Path) -> None:
    around = ring(40, 3.0, (179.5, -17))
    around[:, 0] = (around[:, 0] + 180) % 360 - 180
    cl.write(cl.Points(around, crs="EPSG:4326"), tmp_path / "fiji.gpkg")
    command = [sys.executable, "-m", "crustline", "reconstruct", str(tmp_path / "fiji.gpkg")]
    plane, globe = (
        subprocess.run([*command, *more], capture_output=True, text=True, check=True).stderr
        for more in ([], ["--project", "auto", "-o", str(tmp_path / "fiji.geojson")])
    )
    assert "add --project auto" in plane
    assert "1 ring, 0 open curves" in globe
    assert "warning" not in globe
    again = cl.read(tmp_path / "fiji.geojson")
    assert set(map(tuple, again.xy.tolist())) == set(map(tuple, around.tolist()))


def test_a_ring_around_the_pole_is_one_ring() -> None:
    longitude = np.linspace(-180, 180, 60, endpoint=False)
    coast = cl.Points(np.c_[longitude, -70 + 3 * np.sin(longitude / 30)], crs="EPSG:4326")
    curves = cl.trace(coast, cl.crust(cl.project(coast)))
    assert curves.closed.tolist() == [True]
    assert len(curves[0]) == 60


def test_projecting_there_and_back_changes_nothing_that_matters() -> None:
    points = cl.Points([(8.5, 47.4), (7.4, 46.9)], z=[1, 2], crs="EPSG:4326")
    there = cl.project(points, "EPSG:2056")
    assert there.crs == "EPSG:2056"
    assert there.z is not None
    np.testing.assert_allclose(cl.project(there, "EPSG:4326").xy, points.xy, atol=1e-9)
    assert cl.project(there) is there
    with pytest.raises(cl.InputError, match="no CRS"):
        cl.project(cl.Points([(0, 0)]))
    with pytest.raises(cl.InputError, match="EPSG:25832"):
        cl.project(points, "nowhere")


# Bad files


def mutated(content: bytes, random: np.random.Generator) -> bytes:
    """A file with some bytes changed, cut off, or repeated."""
    bytes_ = bytearray(content)
    for _ in range(random.integers(1, 6)):
        place, kind = int(random.integers(len(bytes_))), random.integers(4)
        if kind == 0:
            bytes_[place] = int(random.integers(256))
        elif kind == 1:
            del bytes_[place : place + int(random.integers(1, 40))]
        elif kind == 2:
            bytes_[place:place] = bytes_[place : place + int(random.integers(1, 40))]
        else:
            del bytes_[max(place, 1) :]
        bytes_ = bytes_ or bytearray(b"x")
    return bytes(bytes_)


def refusal_of(path: Path) -> str:
    """Read a file; return what its refusal says, or nothing."""
    try:
        cl.read(path)
    except (cl.FormatError, cl.InputError) as error:
        return str(error)
    return ""


@pytest.mark.parametrize("suffix", ALL)
def test_mutated_files_end_in_points_or_a_sentence(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"points.{suffix}"
    cl.write(cl.Points(ring(6), columns={"n": np.arange(6)}, crs="EPSG:4326"), path)
    content, random = path.read_bytes(), np.random.default_rng(7)
    for _ in range(60):
        path.write_bytes(mutated(content, random))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FormatWarning)
            sentence = refusal_of(path)
        assert "\n" not in sentence
        assert len(sentence) < 700


@pytest.mark.parametrize("suffix", [*ALL, "xlsx"])
@pytest.mark.parametrize("content", [b"", b"\n", b"hello", b"\0" * 100])
def test_files_that_are_something_else_are_refused(
    tmp_path: Path, suffix: str, content: bytes
) -> None:
    path = tmp_path / f"points.{suffix}"
    path.write_bytes(content)
    with pytest.raises(cl.FormatError, match=f"points.{suffix}"):
        cl.read(path)


def test_a_missing_package_is_named_with_its_extra(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("crustline.errors.find_spec", lambda name: None)
    with pytest.raises(cl.MissingExtraError, match=r"crustline\[gis\]"):
        cl.write(cl.Points([(0, 0)]), tmp_path / "points.gpkg")
    assert not list(tmp_path.iterdir())


def test_gdal_reads_what_shapely_gave_it(tmp_path: Path) -> None:
    path = tmp_path / "mixed.gpkg"
    shapes = [shapely.box(0, 0, 1, 1), shapely.MultiPoint([(5, 5), (6, 6)])]
    frame = geopandas.GeoDataFrame({"name": ["a", "b"]}, geometry=shapes, crs=25832)
    pyogrio.write_dataframe(frame, path)
    points = cl.read(path)
    assert len(points) == 6  # the vertex that closes the box is none
    assert points.columns["name"].tolist() == ["a"] * 4 + ["b"] * 2


def test_a_damaged_number_in_a_drawing_is_refused(tmp_path: Path) -> None:
    """It was guessed, and told to nobody but the log."""
    path = tmp_path / "a.dxf"
    cl.write([(1.25, 2.5), (3, 4)], path)
    path.write_bytes(path.read_bytes().replace(b"1.25", b"1.2,5"))
    with pytest.raises(cl.FormatError, match=r"a\.dxf, near line \d+: '1.2,5' is not a number"):
        cl.read(path)


@pytest.mark.parametrize("suffix", LONLAT)
def test_what_is_no_longitude_and_latitude_is_refused(tmp_path: Path, suffix: str) -> None:
    """Eastings without a CRS were written to GPX as they were, or as others."""
    with pytest.raises(InputError, match=r"row 1, \[500000.0, 5.0\], is no longitude"):
        cl.write([(1, 2), (500_000, 5)], tmp_path / f"a.{suffix}")
    assert not list(tmp_path.iterdir())


def test_a_cell_far_from_the_others_is_refused(tmp_path: Path) -> None:
    """Room for all between was asked for, and the process ended."""
    book = openpyxl.Workbook()
    for row in [["x", "y"], [1, 2], [3, 4]]:
        book.active.append(row)
    book.active["XFD1048576"] = 1
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(cl.FormatError, match="spans 1,048,576 rows and 16,384 columns"):
        cl.read(tmp_path / "a.xlsx")


def test_a_column_without_a_name_is_no_height() -> None:
    points = cl.Points([(1, 2)], columns={"": [7], "none": [np.nan]})
    back = again(points, "gpkg")
    assert back.z is None
    assert list(back.columns) == ["", "none"]


@pytest.mark.parametrize("suffix", ["gpkg", "fgb", "parquet", "feather"])
def test_columns_of_taken_names_are_kept(tmp_path: Path, suffix: str) -> None:
    """A column called geometry was lost; two that differ by case were refused."""
    columns = {"geometry": ["a"], "fid": [7.5], "n": [1], "N": [2], "bbox": ["b"]}
    cl.write(cl.Points([(1, 2)], columns=columns), tmp_path / f"a.{suffix}")
    back = cl.read(tmp_path / f"a.{suffix}").columns
    assert [each.tolist() for each in back.values()] == list(columns.values())


def test_what_gdal_cannot_hold_is_text(tmp_path: Path) -> None:
    """Whole numbers beyond 63 bits were rounded, and the year 32140 became 1970."""
    columns = {"id": np.array([2**64 - 1], np.uint64), "t": np.array(["32140-01-02"], "M8[s]")}
    cl.write(cl.Points([(1, 2)], columns=columns), tmp_path / "a.gpkg")
    back = cl.read(tmp_path / "a.gpkg").columns
    assert back["id"].tolist() == ["18446744073709551615"]
    assert back["t"][0].startswith("32140-01-02")


SHAPES = {
    "point": ["POINT Z (1 2 3)", None, "POINT EMPTY", "POINT Z (4 5 6)"],
    "linestring": ["LINESTRING (0 0, 1 0, 2 1)", None, "LINESTRING (5 5, 6 5, 6 6, 5 5)"],
    "multipoint": ["MULTIPOINT ((0 0), (1 0))", "MULTIPOINT EMPTY", "MULTIPOINT ((5 5))"],
    "polygon": ["POLYGON ((0 0, 9 0, 9 9, 0 0), (2 1, 3 1, 3 2, 2 1))", None],
    "multilinestring": ["MULTILINESTRING ((0 0, 1 0), (5 5, 6 5, 6 6))"],
    "multipolygon": ["MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((5 5, 6 5, 6 6, 5 5)))", None],
}


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("interleaved", [False, True])
@pytest.mark.parametrize("by", ["GeoParquet", "GeoArrow"])
def test_geoarrow_is_read_as_wkb_is(tmp_path: Path, kind: str, interleaved: bool, by: str) -> None:
    """GeoPandas writes the same geometries in both ways; with the encoding of GeoArrow, refused."""
    frame = geopandas.GeoDataFrame(
        {"n": range(len(SHAPES[kind]))}, geometry=shapely.from_wkt(SHAPES[kind]), crs=25832
    )
    frame.to_parquet(tmp_path / "wkb.parquet")
    if by == "GeoArrow" or interleaved:
        table = pyarrow.table(frame.to_arrow(geometry_encoding="geoarrow", interleaved=interleaved))
        pyarrow.parquet.write_table(table, tmp_path / "nested.parquet")
    else:
        frame.to_parquet(tmp_path / "nested.parquet", geometry_encoding="geoarrow")
    plain, nested = (cl.read(tmp_path / f"{name}.parquet") for name in ("wkb", "nested"))
    assert nested == plain
    assert nested.crs == "EPSG:25832"
    one, other = (cl.read_curves(tmp_path / f"{name}.parquet") for name in ("wkb", "nested"))
    assert one == other


def test_an_unknown_encoding_of_geometries_is_refused(tmp_path: Path) -> None:
    field = pyarrow.field(
        "geometry", pyarrow.binary(), metadata={"ARROW:extension:name": "geoarrow.box"}
    )
    table = pyarrow.table([pyarrow.array([b"a"])], schema=pyarrow.schema([field]))
    pyarrow.parquet.write_table(table, tmp_path / "a.parquet")
    with pytest.raises(cl.FormatError, match="geometries are box"):
        cl.read(tmp_path / "a.parquet")


@pytest.mark.parametrize(
    ("name", "values", "kept"),
    [
        ("a b", [1, 2], "a_b"),
        ("<x>", ["a", "b"], "_x_"),
        ("x/y", [1.5, 2.5], "x_y"),
        ("time", ["noon", "night"], "input_time"),
        ("sat", [1.5, 2.5], "input_sat"),
        ("hdop", ["good", "bad"], "input_hdop"),
        ("name", [1, 2], "input_name"),
        ("ele", [7.5, 8.5], "input_ele"),
        ("ogr_a", [1, 2], "input_ogr_a"),
        ("track_fid", [1, 2], "input_track_fid"),
        ("large", [2**40, 1], "large"),
    ],
)
@pytest.mark.parametrize("z", [None, [3.5, 4.5]])
def test_gpx_keeps_odd_columns(
    tmp_path: Path, name: str, values: list[str] | list[float], kept: str, z: list[float] | None
) -> None:
    """No XML came of odd names; what GPX has of its own took no other type, and lost it."""
    points = cl.Points([(8, 47), (9, 48)], z=z, columns={name: values}, crs="EPSG:4326")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        cl.write(points, tmp_path / "a.gpx")
    assert bool(caught) == ("_" in kept and not kept.startswith("input"))
    back = cl.read(tmp_path / "a.gpx")
    assert {key: column.tolist() for key, column in back.columns.items()} == {kept: values}
    assert (back.z is None) if z is None else back.z.tolist() == z


def test_whole_numbers_that_gpx_loses_are_refused(tmp_path: Path) -> None:
    points = cl.Points([(8, 47)], columns={"id": [2**60 + 1]}, crs="EPSG:4326")
    with pytest.raises(InputError, match="beyond 2⁵³"):
        cl.write(points, tmp_path / "a.gpx")
