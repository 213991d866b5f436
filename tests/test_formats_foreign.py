"""Files as other programs write them: each is read as it is meant, or refused in one sentence.

Ten or more of each format, made here as those programs would; none takes over five seconds.
"""

from __future__ import annotations

import io
import struct
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import openpyxl
import pyarrow as pa
import pyarrow.parquet as pq
import pyogrio
import pytest
import shapely

import crustline as cl

SECONDS = 5.0
XY = [(1.5, 2.5), (3.5, 4.5), (5.5, 2.5)]


def read(path: Path, **options: Any) -> cl.Points | str:
    """The points of a file, or the sentence it is refused with."""
    started = time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found: cl.Points | str = cl.read(path, **options)
        except cl.CrustlineError as error:
            found = str(error)
            assert "\n" not in found
            assert len(found) < 500
    assert time.perf_counter() - started < 10 * SECONDS  # of a machine that does other things, too
    return found


def check(path: Path, expected: Any, **options: Any) -> None:
    """Assert that a file gives these points, or a sentence with this word."""
    found = read(path, **options)
    if isinstance(expected, str):
        assert isinstance(found, str)
        assert expected in found
    else:
        assert isinstance(found, cl.Points), found
        assert found.xy.tolist() == [list(row) for row in expected]


# GPX

GPX11 = '<gpx version="1.1" creator="x" xmlns="http://www.topografix.com/GPX/1/1">{}</gpx>'
GPX10 = '<gpx version="1.0" creator="x" xmlns="http://www.topografix.com/GPX/1/0">{}</gpx>'
WPT = "".join(f'<wpt lon="{x}" lat="{y}"/>' for x, y in XY)
NAMED = "".join(f'<wpt lon="{x}" lat="{y}"><ele>7</ele><name>é</name></wpt>' for x, y in XY)
TRKPT = "".join(
    f'<trkpt lon="{x}" lat="{y}"><ele>4</ele><time>2024-01-02T03:04:05Z</time></trkpt>'
    for x, y in XY
)
RTEPT = "".join(f'<rtept lon="{x}" lat="{y}"/>' for x, y in XY)
GPX = {
    "waypoints, 1.1": (GPX11.format(WPT), XY),
    "waypoints, 1.0": (GPX10.format(WPT), XY),
    "names and heights": (GPX11.format(NAMED), XY),
    "a track": (GPX11.format(f"<trk><trkseg>{TRKPT}</trkseg></trk>"), XY),
    "a track of two segments": (
        GPX11.format(f"<trk><trkseg>{TRKPT}</trkseg><trkseg>{TRKPT}</trkseg></trk>"), XY + XY,
    ),
    "a route": (GPX11.format(f"<rte>{RTEPT}</rte>"), XY),
    "a route, 1.0": (GPX10.format(f"<rte>{RTEPT}</rte>"), XY),
    "waypoints and a track": (GPX11.format(f"{WPT}<trk><trkseg>{TRKPT}</trkseg></trk>"), "--layer"),
    "a declaration and a comment": ("<?xml version='1.0'?><!-- x -->" + GPX11.format(WPT), XY),
    "extensions": (
        GPX11.format(WPT.replace("/>", "><extensions><hr>90</hr></extensions></wpt>")), XY,
    ),
    "nothing in it": (GPX11.format(""), "no layer"),
    "cut off": (GPX11.format(WPT)[:-60], "GDAL"),
}  # fmt: skip


@pytest.mark.parametrize("name", GPX)
def test_gpx(tmp_path: Path, name: str) -> None:
    text, expected = GPX[name]
    path = tmp_path / "a.gpx"
    path.write_text(text, encoding="utf-8")
    check(path, expected)


# KML

KML = (
    '<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>{}</Document></kml>'
)
PLACE = "<Placemark><name>a</name>{}</Placemark>"
POINT = "<Point><coordinates>{},{}</coordinates></Point>"
PLACES = "".join(PLACE.format(POINT.format(*each)) for each in XY)
LINE = "<LineString><coordinates>1.5,2.5,0 3.5,4.5,0 5.5,2.5,0</coordinates></LineString>"
RING = "<coordinates>1.5,2.5 3.5,4.5 5.5,2.5 1.5,2.5</coordinates>"
POLYGON = f"<Polygon><outerBoundaryIs><LinearRing>{RING}</LinearRing></outerBoundaryIs></Polygon>"
KMLS = {
    "placemarks": (KML.format(PLACES), XY),
    "in a folder": (KML.format(f"<Folder><name>f</name>{PLACES}</Folder>"), XY),
    "in folders of folders": (
        KML.format(f"<Folder><name>f</name><Folder><name>g</name>{PLACES}</Folder></Folder>"), XY,
    ),
    "in two folders": (
        KML.format(f"<Folder><name>f</name>{PLACES}</Folder><Folder><name>g</name>{PLACES}</Folder>"),
        "--layer",
    ),
    "a line": (KML.format(PLACE.format(LINE)), XY),
    "a polygon": (KML.format(PLACE.format(POLYGON)), XY),
    "a MultiGeometry": (
        KML.format(PLACE.format(
            "<MultiGeometry>" + "".join(POINT.format(*each) for each in XY) + "</MultiGeometry>"
        )), XY,
    ),
    "mixed geometries": (
        KML.format(PLACE.format(f"<MultiGeometry>{POINT.format(1.5, 2.5)}{LINE}</MultiGeometry>")),
        [XY[0], *XY],
    ),
    "line breaks between numbers": (
        KML.format(PLACE.format(LINE.replace(" 3.5", "\n   3.5"))), XY,
    ),
    "without a name space": (
        KML.format(PLACES).replace(' xmlns="http://www.opengis.net/kml/2.2"', ""), XY,
    ),
    "styles and data": (
        KML.format("<Style id='s'/>" + PLACES.replace(
            "<name>a</name>",
            "<name>a</name><ExtendedData><Data name='k'><value>1</value></Data></ExtendedData>",
        )), XY,
    ),
    "a pole that is none": (KML.format(PLACE.format("<Point/>")), None),
}  # fmt: skip


@pytest.mark.parametrize("name", KMLS)
def test_kml(tmp_path: Path, name: str) -> None:
    text, expected = KMLS[name]
    path = tmp_path / "a.kml"
    path.write_text(text, encoding="utf-8")
    if expected is None:
        assert isinstance(read(path), str) or not len(read(path))
    else:
        check(path, expected)


# DXF


def drawn(draw: Callable[[Any], None], version: str = "R2010", form: str = "asc") -> bytes:
    drawing = ezdxf.new(version)
    draw(drawing.modelspace())
    if form == "bin":
        stream = io.BytesIO()
        drawing.write(stream, fmt="bin")
        return stream.getvalue()
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode()


def three_points(space: Any) -> None:
    for each in XY:
        space.add_point(each)


def with_decoration(space: Any) -> None:
    three_points(space)
    space.add_text("x")
    space.add_hatch()


BARE = "0\nSECTION\n2\nENTITIES\n" + "".join(
    f"0\nPOINT\n8\n0\n10\n{x}\n20\n{y}\n30\n0.0\n" for x, y in XY
)
DXF: dict[str, tuple[Callable[[], bytes], Any]] = {
    **{f"points, {version}": (lambda version=version: drawn(three_points, version), XY)  # type: ignore[misc]
       for version in ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018")},
    "binary": (lambda: drawn(three_points, "R2010", "bin"), XY),
    "entities alone": (lambda: (BARE + "0\nENDSEC\n0\nEOF\n").encode(), XY),
    "line ends of Windows": (
        lambda: (BARE + "0\nENDSEC\n0\nEOF\n").replace("\n", "\r\n").encode(), XY,
    ),
    "an old polyline": (
        lambda: drawn(lambda space: space.add_polyline2d(XY, close=True), "R12"), XY,
    ),
    "a light polyline": (lambda: drawn(lambda space: space.add_lwpolyline(XY)), XY),
    "a polyline in space": (
        lambda: drawn(lambda space: space.add_polyline3d([(*each, 7) for each in XY])), XY,
    ),
    "texts and hatches beside": (lambda: drawn(with_decoration), XY),
    "cut off": (lambda: drawn(three_points)[:-900], None),
    "no drawing": (lambda: b"0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n", []),
}  # fmt: skip


@pytest.mark.parametrize("name", DXF)
def test_dxf(tmp_path: Path, name: str) -> None:
    make, expected = DXF[name]
    path = tmp_path / "a.dxf"
    path.write_bytes(make())
    if expected is None:
        read(path)
    else:
        check(path, expected)


# Excel


def book(rows: list[list[Any]], change: Callable[[Any], None] = lambda sheet: None) -> bytes:
    made = openpyxl.Workbook()
    for row in rows:
        made.active.append(row)
    change(made.active)
    stream = io.BytesIO()
    made.save(stream)
    return stream.getvalue()


def _date() -> Any:
    import datetime

    return datetime.datetime(2024, 1, 2, 3, 4)


HEAD: list[Any] = [["x", "y"], *map(list, XY)]
EXCEL: dict[str, tuple[bytes, Any]] = {
    "a header": (book(HEAD), XY),
    "no header": (book([list(each) for each in XY]), XY),
    "rows above are empty": (book([[], [], *HEAD]), XY),
    "columns before are empty": (book([[None, *row] for row in HEAD]), XY),
    "dates beside": (book([["when", "x", "y"], *([_date(), *each] for each in XY)]), XY),
    "truths and texts beside": (book([["x", "y", "ok"], *([*each, True] for each in XY)]), XY),
    "empty rows between": (book([HEAD[0], HEAD[1], [], *HEAD[2:]]), XY),
    "merged cells in the header": (
        book([["x", "y", "note"], *([*each, "a"] for each in XY)],
             lambda sheet: sheet.merge_cells("C2:C4")), XY,
    ),
    "a title that is merged": (
        book([["Survey of 2024", None], *HEAD], lambda sheet: sheet.merge_cells("A1:B1")),
        "Survey of 2024",
    ),
    "a formula without its value": (book([*HEAD, ["=A2+1", 3]]), "row 5"),
    "text among the numbers": (book([*HEAD, ["1,5", 3]]), "row 5"),
    "an error": (book([*HEAD, ["#DIV/0!", 3]]), "row 5"),
    "nothing": (book([]), "empty"),
}  # fmt: skip


@pytest.mark.parametrize("name", EXCEL)
def test_excel(tmp_path: Path, name: str) -> None:
    content, expected = EXCEL[name]
    path = tmp_path / "a.xlsx"
    path.write_bytes(content)
    check(path, expected)


# Parquet

PLAIN = {"x": [1.5, 3.5, 5.5], "y": [2.5, 4.5, 2.5]}
WKB = shapely.to_wkb(shapely.points(XY))


def geo(column: Any, encoding: str = "WKB", **more: Any) -> Any:
    import json

    about = {"version": "1.0.0", "primary_column": "geom",
             "columns": {"geom": {"encoding": encoding, "geometry_types": [], **more}}}  # fmt: skip
    table = pa.table({"geom": column, "n": [1, 2, 3]})
    return table.replace_schema_metadata({"geo": json.dumps(about)})


def _points_of_arrow() -> Any:
    x, y = pa.array(PLAIN["x"]), pa.array(PLAIN["y"])
    return pa.StructArray.from_arrays([x, y], ["x", "y"])


PARQUET: dict[str, tuple[Any, Any]] = {
    "plain": (pa.table(PLAIN), XY),
    "float32": (pa.table({k: pa.array(v, pa.float32()) for k, v in PLAIN.items()}), XY),
    "lists beside": (pa.table({**PLAIN, "tags": [["a"], [], None]}), XY),
    "a dictionary beside": (
        pa.table({**PLAIN, "kind": pa.array(["a", "b", "a"]).dictionary_encode()}), XY,
    ),
    "coordinates as a dictionary": (
        pa.table({k: pa.array(v).dictionary_encode() for k, v in PLAIN.items()}), XY,
    ),
    "times and decimals beside": (
        pa.table({**PLAIN, "t": pa.array([0, 1, 2], pa.timestamp("ns", "UTC")),
                  "d": pa.array([1, 2, 3]).cast(pa.decimal128(21, 2))}), XY,
    ),
    "missing numbers beside": (pa.table({**PLAIN, "n": [1, None, 3]}), XY),
    "a missing coordinate": (pa.table({"x": [1.5, None, 5.5], "y": PLAIN["y"]}), "row 1"),
    "geometries": (geo(list(WKB)), XY),
    "large geometries": (geo(pa.array(list(WKB), pa.large_binary())), XY),
    "geometries without a CRS": (geo(list(WKB), crs=None), XY),
    "geometries of the other byte order": (
        geo(list(shapely.to_wkb(shapely.points(XY), byte_order=0))), XY,
    ),
    "GeoArrow": (geo(_points_of_arrow(), "point"), XY),
    "no rows": (pa.table({"x": pa.array([], pa.float64()), "y": pa.array([], pa.float64())}), []),
    "other columns": (pa.table({"a": [1], "b": [2], "c": [3]}), "x"),
}  # fmt: skip


@pytest.mark.parametrize("name", PARQUET)
def test_parquet(tmp_path: Path, name: str) -> None:
    table, expected = PARQUET[name]
    path = tmp_path / "a.parquet"
    pq.write_table(table, path)
    check(path, expected)


# Shapefile and GeoPackage


def by_gdal(path: Path, geometries: Any, **options: Any) -> Path:
    names, fields = np.array(["n"], dtype=object), [np.arange(len(geometries))]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pyogrio.raw.write(path, shapely.to_wkb(geometries), fields, names, **options)
    return path


def _points() -> Any:
    return shapely.points(XY)


def _lines() -> Any:
    return np.array([shapely.linestrings(XY)])


def _rings() -> Any:
    return np.array([shapely.polygons([*XY, XY[0]])])


KINDS: dict[str, tuple[Callable[[], Any], str, list[tuple[float, float]]]] = {
    "points": (_points, "Point", XY),
    "points in space": (lambda: shapely.points([(*each, 7) for each in XY]), "Point Z", XY),
    "many points": (lambda: np.array([shapely.multipoints(XY)]), "MultiPoint", XY),
    "lines": (_lines, "LineString", XY),
    "lines in space": (
        lambda: np.array([shapely.linestrings([(*each, 7) for each in XY])]), "LineString Z", XY,
    ),
    "many lines": (
        lambda: np.array([shapely.multilinestrings([XY, XY])]), "MultiLineString", XY + XY,
    ),
    "polygons": (_rings, "Polygon", XY),
    "many polygons": (
        lambda: np.array([shapely.multipolygons(list(_rings()))]), "MultiPolygon", XY,
    ),
    "one point": (lambda: shapely.points(XY[:1]), "Point", XY[:1]),
    "a collection": (
        lambda: np.array([shapely.geometrycollections([*_points()])]), "GeometryCollection", XY,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("suffix", ["shp", "gpkg", "fgb"])
def test_files_of_gdal(tmp_path: Path, suffix: str, name: str) -> None:
    make, kind, expected = KINDS[name]
    if (suffix, kind) == ("shp", "GeometryCollection"):
        pytest.skip("Shapefiles hold no collections")
    options: dict[str, Any] = {"geometry_type": kind, "crs": "EPSG:25832"}
    if suffix == "fgb":
        options["SPATIAL_INDEX"] = "NO"
    path = by_gdal(tmp_path / f"a.{suffix}", make(), **options)
    found = cl.read(path)
    assert sorted(map(tuple, found.xy.tolist())) == sorted(expected)
    assert found.crs == "EPSG:25832"
    assert (found.z is not None) == kind.endswith((" Z", " ZM"))


def measured(kind: int, numbers: int) -> bytes:
    """A Shapefile of points with measures, as arcs of road surveys are: one GDAL does not write."""
    size = 4 + 8 * numbers
    head = struct.pack(">7i", 9994, 0, 0, 0, 0, 0, (100 + 3 * (8 + size)) // 2)
    head += struct.pack("<2i8d", 1000, kind, 1.5, 2.5, 5.5, 4.5, 0, 0, 0, 9)
    for number, (x, y) in enumerate(XY, 1):
        head += struct.pack(">2i", number, size // 2)
        head += struct.pack(f"<i{numbers}d", kind, x, y, *[7.0] * (numbers - 3), 9.0)
    return head


@pytest.mark.parametrize(("kind", "numbers"), [(21, 3), (11, 4)])
def test_shapefiles_with_measures(tmp_path: Path, kind: int, numbers: int) -> None:
    path = tmp_path / "a.shp"
    path.write_bytes(measured(kind, numbers))
    half = (4 + 8 * numbers) // 2
    index = b"".join(struct.pack(">2i", 50 + k * (4 + half), half) for k in range(3))
    path.with_suffix(".shx").write_bytes(
        path.read_bytes()[:24] + struct.pack(">i", 62) + path.read_bytes()[28:100] + index
    )
    check(path, XY)


@pytest.mark.parametrize("missing", ["prj", "shx", "dbf", "cpg"])
def test_shapefiles_without_a_part(tmp_path: Path, missing: str) -> None:
    path = by_gdal(tmp_path / "a.shp", _points(), geometry_type="Point", crs="EPSG:25832",
                   encoding="UTF-8")  # fmt: skip
    path.with_suffix(f".{missing}").unlink()
    found = read(path)
    if missing == "shx":
        assert isinstance(found, str) or len(found) == 3
        assert not path.with_suffix(".shx").exists(), "reading writes nothing"
    else:
        assert isinstance(found, cl.Points), found
        assert found.xy.tolist() == [list(each) for each in XY]
        assert (found.crs is None) == (missing == "prj")
