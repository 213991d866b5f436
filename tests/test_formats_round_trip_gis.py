"""What KML, GPX, Shapefile and DXF hold comes back from them: heights, columns, CRS, curves."""

from __future__ import annotations

import tempfile
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import crustline as cl
from crustline.formats import read_curves

for needed in ("pyogrio", "shapely", "pyproj", "pyarrow", "ezdxf"):
    pytest.importorskip(needed)

SUFFIXES = ["kml", "gpx", "shp", "dxf"]
#: Those that hold columns and a CRS; DXF has neither, KML and GPX one CRS.
TABLES = ["kml", "gpx", "shp"]
TEXT = st.text(st.characters(categories=["L", "N", "P", "S"]), min_size=1, max_size=6)
#: Degrees, as receivers give them: seven digits behind the point.
LONGITUDES = st.integers(-1_800_000_000, 1_800_000_000).map(lambda k: k / 1e7)
LATITUDES = st.integers(-900_000_000, 900_000_000).map(lambda k: k / 1e7)
HEIGHTS = st.integers(-10_000_000, 10_000_000).map(lambda k: k / 1000)


def listed(draw: st.DrawFn, each: Any, n: int) -> list[Any]:
    return draw(st.lists(each, min_size=n, max_size=n))


@st.composite
def points(draw: st.DrawFn, least: int = 1) -> cl.Points:
    n = draw(st.integers(least, 6))
    columns: dict[str, Any] = {
        "label": np.array(listed(draw, TEXT, n), object),
        "count": np.array(listed(draw, st.integers(-(2**31) + 1, 2**31 - 1), n), np.int64),
        "weight": np.array(listed(draw, HEIGHTS, n), float),
    }
    kept = draw(st.sets(st.sampled_from(sorted(columns))))
    return cl.Points(
        np.c_[listed(draw, LONGITUDES, n), listed(draw, LATITUDES, n)],
        z=draw(st.none() | st.just(listed(draw, HEIGHTS, n))),
        columns={name: columns[name] for name in sorted(kept)},
        crs="EPSG:4326",
    )


def again(written: Any, suffix: str, reading: Any = cl.read) -> Any:
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = Path(folder, f"a.{suffix}")
        cl.write(written, path)
        return reading(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
@settings(max_examples=25, deadline=None)
@given(points=points())
def test_points_come_back(suffix: str, points: cl.Points) -> None:
    back = again(points, suffix)
    np.testing.assert_allclose(back.xy, points.xy, rtol=0, atol=1e-12)
    if points.z is not None:
        np.testing.assert_allclose(back.z, points.z, rtol=0, atol=1e-9)
    elif suffix == "kml":  # GDAL gives places without a height one of 0
        assert back.z is None or not back.z.any()
    elif suffix != "dxf":
        assert back.z is None
    if suffix in TABLES:
        assert back.crs == "EPSG:4326"
        for name, values in points.columns.items():
            if values.dtype.kind == "f":
                np.testing.assert_allclose(back.columns[name].astype(float), values, atol=1e-9)
            else:
                assert list(map(str, back.columns[name])) == list(map(str, values)), name


@pytest.mark.parametrize("suffix", SUFFIXES)
@settings(max_examples=25, deadline=None)
@given(points=points(least=4), closed=st.booleans())
def test_curves_come_back(suffix: str, points: cl.Points, closed: bool) -> None:
    points = cl.Points(np.unique(points.xy, axis=0), crs=points.crs)
    n = len(points)
    if n < 4:
        return
    edges = [(k, (k + 1) % n) for k in range(n - 1 + closed)]
    back = again(cl.trace(points, edges), suffix, read_curves)
    assert back.closed.tolist() == [closed]
    np.testing.assert_allclose(back[0].points, cl.trace(points, edges)[0].points, atol=1e-12)


@pytest.mark.parametrize("crs", ["EPSG:25832", "EPSG:2056", "EPSG:3857", "EPSG:32719", None])
def test_a_shapefile_keeps_its_crs(crs: str | None) -> None:
    assert again(cl.Points([(500_000, 5_000_000)], crs=crs), "shp").crs == crs


@pytest.mark.parametrize("suffix", ["kml", "gpx"])
@pytest.mark.parametrize("crs", ["EPSG:25832", "EPSG:2056", "EPSG:3857"])
def test_degrees_lead_back_to_the_place(suffix: str, crs: str) -> None:
    there = cl.project(cl.Points([(8.5, 47.25), (8.6, 47.3)], z=[1.5, 2], crs="EPSG:4326"), crs)
    back = cl.project(again(there, suffix), crs)
    np.testing.assert_allclose(back.xy, there.xy, atol=0.02)  # a centimeter or two
    np.testing.assert_allclose(back.z, [1.5, 2], atol=1e-6)
