"""GeoJSON: vertices and properties in, features by RFC 7946 out."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crustline.curves import trace
from crustline.errors import FormatError, FormatWarning, InputError
from crustline.formats import read, write
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
