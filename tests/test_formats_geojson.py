"""GeoJSON: vertices and properties in, features by RFC 7946 out."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crustline.curves import Curves, trace
from crustline.errors import FormatError, FormatWarning, InputError
from crustline.formats import read, read_curves, write
from crustline.points import Points

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


@pytest.fixture
def read_json(tmp_path):
    """Read a document, or text, as GeoJSON."""

    def read_json(document, **options):
        path = tmp_path / "points.geojson"
        path.write_text(document if isinstance(document, str) else json.dumps(document))
        return read(path, **options)

    return read_json


def feature(kind, coordinates, **properties):
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": properties or None, "geometry": geometry}


def collection(*features):
    return {"type": "FeatureCollection", "features": list(features)}


RING = [[0, 0], [4, 0], [4, 4], [0, 0]]


@pytest.mark.parametrize(
    ("kind", "coordinates", "expected"),
    [
        ("Point", [1, 2], [[1, 2]]),
        ("Point", [], []),
        ("MultiPoint", [[1, 2], [3, 4]], [[1, 2], [3, 4]]),
        ("LineString", [[1, 2], [3, 4]], [[1, 2], [3, 4]]),
        ("LineString", RING, RING[:-1]),
        ("MultiPoint", RING, RING),
        ("MultiLineString", [[[1, 2], [3, 4]], RING], [[1, 2], [3, 4], *RING[:-1]]),
        ("Polygon", [RING, RING], RING[:-1] * 2),
        ("MultiPolygon", [[RING], [RING]], RING[:-1] * 2),
    ],
)
def test_vertices_of_every_geometry(read_json, kind, coordinates, expected):
    part = feature(kind, coordinates)
    nested = {"type": "GeometryCollection", "geometries": [part["geometry"]]}
    whole = {"type": "Feature", "properties": {}, "geometry": nested}
    for document in (collection(part), part, part["geometry"], nested, collection(whole)):
        assert read_json(document).xy.tolist() == expected


def test_properties_become_columns(read_json):
    points = read_json(
        collection(
            feature("Point", [0, 0, 5], name="a", id=1, tall=True, share=0.5, tags={"k": 1}),
            feature("MultiPoint", [[1, 0, 6], [2, 0, 7]], name=None, id=2, tall=False, share=None),
            {"type": "Feature", "properties": {"name": "nowhere"}, "geometry": None},
        )
    )
    columns = points.columns
    assert points.z.tolist() == [5, 6, 7]
    assert columns["name"].tolist() == ["a", "", ""]
    assert columns["id"].tolist() == [1, 2, 2]
    assert columns["tall"].tolist() == [True, False, False]
    assert np.array_equal(columns["share"], [0.5, np.nan, np.nan], equal_nan=True)
    assert columns["tags"].tolist() == ['{"k": 1}', "", ""]


def test_a_list_with_a_value_per_vertex_is_spread(read_json):
    points = read_json(feature("MultiPoint", [[0, 0], [1, 1]], depth=[3, 4], other=[1, 2, 3]))
    assert points.columns["depth"].tolist() == [3, 4]
    assert points.columns["other"].tolist() == ["[1, 2, 3]"] * 2


@pytest.mark.parametrize(
    ("name", "crs"),
    [("urn:ogc:def:crs:EPSG::25832", "EPSG:25832"), ("urn:ogc:def:crs:OGC:1.3:CRS84", "OGC:CRS84")],
)
def test_the_crs_is_kept(read_json, name, crs):
    member = {"type": "name", "properties": {"name": name}}
    assert read_json(collection() | {"crs": member}).crs == crs
    assert read_json(collection() | {"crs": member}, crs="EPSG:3857").crs == "EPSG:3857"


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ("{", ["line 1", "column"]),
        ('{"type": "Point",\n "coordinates": [1 2]}', ["line 2"]),
        ('{"type": "Point", "coordinates": [NaN, 2]}', ["NaN"]),
        ('{"type": "Point", "coordinates": [1e999, 2]}', ["row 0", "inf"]),
        ("{}", ["type"]),
        ("[1, 2]", ["type"]),
        ("[" * 100_000, ["points.geojson"]),
        ({"type": "Sphere"}, ["feature 0", "'Sphere'"]),
        ({"type": "FeatureCollection"}, ["features"]),
        (collection(7), ["feature 0"]),
        (collection(feature("Point", [1, 2]), feature("Point", [1])), ["feature 1", "[1]"]),
        (collection(feature("Point", [1, "2"])), ["feature 0", "'2'"]),
        (collection(feature("Point", [1, True])), ["feature 0", "True"]),
        (collection(feature("LineString", [1, 2])), ["feature 0", "1"]),
        (collection(feature("Polygon", [1, 2])), ["feature 0", "1"]),
        (collection(feature("Point", {"x": 1})), ["feature 0"]),
        (collection(feature("Point", [10**400, 2])), ["too large"]),
        (collection({"type": "Feature", "geometry": 5}), ["feature 0", "5"]),
    ],
)
def test_what_does_not_fit_is_named(read_json, document, words):
    with pytest.raises(FormatError) as caught:
        read_json(document)
    for word in ["points.geojson", *words]:
        assert word in str(caught.value)
    assert "\n" not in str(caught.value)


def test_heights_that_some_positions_lack_are_left_out(read_json):
    document = collection(feature("Point", [1, 2]), feature("Point", [3, 4, 5]))
    with pytest.warns(FormatWarning, match="no height"):
        points = read_json(document)
    assert (points.xy.tolist(), points.z) == ([[1, 2], [3, 4]], None)


def test_measures_are_left_out(read_json):
    with pytest.warns(FormatWarning, match="beyond x, y and z"):
        points = read_json(feature("LineString", [[1, 2, 3, 4], [5, 6, 7, 8]]))
    assert (points.xy.tolist(), points.z.tolist()) == ([[1, 2], [5, 6]], [3, 7])


def test_columns_cannot_be_chosen(read_json):
    with pytest.raises(InputError, match="columns"):
        read_json(collection(), columns=("x", "y"))


# Writing


def lake():
    outline = [
        (0, 0),
        (9, 0),
        (9, 9),
        (0, 9),
        (3, 3),
        (6, 3),
        (6, 6),
        (3, 6),
        (20, 0),
        (21, 1),
        (30, 0),
    ]
    edges = [(0, 1), (1, 2), (2, 3), (0, 3), (4, 5), (5, 6), (6, 7), (4, 7), (8, 9)]
    columns = {"name": list("abcdefghijk"), "rows": np.arange(11) / 2}
    return trace(Points(outline, z=np.arange(11), columns=columns, crs="EPSG:25832"), edges)


def load(curves, tmp_path, **options):
    write(curves, tmp_path / "curves.geojson", **options)
    return json.loads((tmp_path / "curves.geojson").read_text())


def area(ring):
    points = np.array(ring)[:, :2]
    (x, y), (u, v) = points[:-1].T, points[1:].T
    return float(np.sum(x * v - u * y)) / 2


def test_each_curve_is_a_feature(tmp_path):
    document = load(lake(), tmp_path)
    kinds = [each["geometry"]["type"] for each in document["features"]]
    assert kinds == ["LineString", "LineString", "LineString", "MultiPoint"]
    ring = document["features"][0]
    assert ring["geometry"]["coordinates"][0] == ring["geometry"]["coordinates"][-1] == [0, 0, 0]
    assert ring["properties"] == {
        "curve": 0,
        "closed": True,
        "rows": [0, 1, 2, 3],
        "name": ["a", "b", "c", "d"],
        "input_rows": [0, 0.5, 1, 1.5],
    }
    assert document["features"][2]["properties"]["closed"] is False
    assert document["features"][3]["properties"]["rows"] == [10]
    assert document["crs"]["properties"]["name"] == "urn:ogc:def:crs:EPSG::25832"


def test_polygons_follow_the_right_hand_rule(tmp_path):
    document = load(lake(), tmp_path, polygons=True)
    polygon, line, _ = document["features"]
    shell, hole = polygon["geometry"]["coordinates"]
    assert polygon["geometry"]["type"] == "Polygon"
    assert (area(shell), area(hole)) == (81, -9)
    assert shell[0] == shell[-1]
    assert hole[0] == hole[-1]
    positions = shell[:-1] + hole[:-1]
    assert [position[2] for position in positions] == polygon["properties"]["rows"]
    assert line["geometry"]["type"] == "LineString"


@pytest.mark.parametrize("crs", [None, "EPSG:4326", "OGC:CRS84"])
def test_no_crs_member_where_the_rfc_implies_it(tmp_path, crs):
    assert "crs" not in load(trace(Points([(1, 2)], crs=crs), []), tmp_path)


def test_what_json_does_not_know_is_null(tmp_path):
    points = Points(
        [(1, 2), (3, 4)],
        columns={"share": [np.nan, 1], "day": np.array(["2020-01-01"] * 2, "M8[D]")},
    )
    properties = load(trace(points, []), tmp_path)["features"][0]["properties"]
    assert properties["share"] == [None, 1]
    assert properties["day"] == ["2020-01-01"] * 2


def test_no_curves_are_a_collection_without_features(tmp_path):
    assert load(trace([], []), tmp_path) == {"type": "FeatureCollection", "features": []}


def test_reading_a_result_gives_each_vertex_once(tmp_path):
    curves = lake()
    for polygons in (False, True):
        write(curves, tmp_path / "curves.geojson", polygons=polygons)
        points = read(tmp_path / "curves.geojson")
        rows = points.columns["rows"]
        assert sorted(rows.tolist()) == list(range(11))
        assert np.array_equal(points, np.asarray(curves.points)[rows])
        assert np.array_equal(points.z, rows)
        assert np.array_equal(points.columns["name"], curves.points.columns["name"][rows])
        assert points.crs == "EPSG:25832"


@given(st.lists(st.tuples(FLOATS, FLOATS, FLOATS, st.text())))
def test_reading_gives_back_what_was_written(tmp_path_factory, rows):
    texts = np.array([row[3] for row in rows], dtype=str)
    points = Points([row[:2] for row in rows], z=[row[2] for row in rows], columns={"text": texts})
    path = tmp_path_factory.mktemp("geojson") / "points.geojson"
    points.write(path)
    again = read(path)
    assert again.xy.tobytes() == points.xy.tobytes()
    if rows:
        assert again.z.tobytes() == points.z.tobytes()
        assert again.columns["text"].tolist() == texts.tolist()


# Across the 180th meridian


def across(shift: float = 0.0) -> Curves:
    """A ring of 40 places around 180 degrees east, and a line across, with heights and names."""
    t = np.arange(40) * (2 * np.pi / 40)
    ring = np.c_[179.5 + shift + 3 * np.cos(t), -17 + 3 * np.sin(t)]
    line = np.c_[np.linspace(170, 190, 9), np.linspace(0, 4, 9)]
    xy = np.concatenate([ring, line])
    xy[:, 0] = (xy[:, 0] + 180) % 360 - 180
    edges = [*((k, (k + 1) % 40) for k in range(40)), *((k, k + 1) for k in range(40, 48))]
    names = np.array([f"p{k}" for k in range(49)], dtype=object)
    points = Points(xy, z=np.arange(49.0), columns={"name": names, "n": np.arange(49)},
                    crs="EPSG:4326")  # fmt: skip
    return trace(points, edges)


@pytest.mark.parametrize("shift", [0.0, 0.5, -0.5, 3.5, -2.5])
def test_lines_across_the_180th_meridian_are_cut_and_read_back_whole(tmp_path, shift):
    curves = across(shift)
    write(curves, tmp_path / "fiji.geojson")
    for each in json.loads((tmp_path / "fiji.geojson").read_text())["features"]:
        kind, pieces = each["geometry"]["type"], each["geometry"]["coordinates"]
        for piece in pieces if kind == "MultiLineString" else [pieces]:
            assert len(piece) > 1
            assert np.abs(np.diff([position[0] for position in piece])).max() <= 180
    back = read_curves(tmp_path / "fiji.geojson")
    assert back.closed.tolist() == [True, False]
    assert [len(each) for each in back] == [40, 9]
    rows = np.concatenate([each.indices for each in curves])
    again = np.concatenate([each.indices for each in back])
    order = np.argsort(curves.points.columns["n"][rows])
    found = np.argsort(back.points.columns["n"][again])
    for ours, theirs in (
        (curves.points.xy, back.points.xy), (curves.points.z, back.points.z),
        (curves.points.columns["name"], back.points.columns["name"]),
    ):  # fmt: skip
        assert (ours[rows][order] == theirs[again][found]).all()


def test_a_line_along_the_180th_meridian_is_cut_where_it_changes_sides(tmp_path):
    xy = [(178, 0), (180, 1), (180, 2), (-180, 2), (-180, 3), (-178, 4), (179, 5), (180, 6)]
    points = Points(xy, crs="EPSG:4326")
    write(trace(points, [(k, k + 1) for k in range(7)]), tmp_path / "a.geojson")
    back = read_curves(tmp_path / "a.geojson")
    assert back.points.xy[back.indices].tolist() == [list(map(float, each)) for each in xy]


def test_what_is_no_longitude_is_not_cut(tmp_path):
    points = Points([(500, 0), (-500, 0)], crs="EPSG:25832")
    write(trace(points, [(0, 1)]), tmp_path / "a.geojson")
    assert "MultiLineString" not in (tmp_path / "a.geojson").read_text()


@pytest.mark.parametrize("added", ["[0]", "[9]", '"no"', "[true]", "[1.5]", "{}"])
def test_a_column_called_cut_is_a_column(tmp_path, added):
    """It says which positions were added only where these are on the 180th meridian."""
    text = (
        '{"type":"Feature","properties":{"cut":%s},"geometry":'
        '{"type":"MultiLineString","coordinates":[[[1,2],[3,4]],[[5,6],[7,8]]]}}'
    )
    (tmp_path / "a.geojson").write_text(text % added)
    assert len(read(tmp_path / "a.geojson")) == 4


def test_polygons_across_the_180th_meridian_are_whole_and_it_is_said(tmp_path):
    with pytest.warns(FormatWarning, match="180th meridian"):
        write(across(), tmp_path / "a.geojson", polygons=True)
