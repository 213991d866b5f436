"""Frames of geopandas: `frame.crustline.reconstruct`, for the whole frame or by a column."""

from __future__ import annotations

import geopandas
import numpy as np
import pandas
import pytest
import shapely

import crustline as cl
import crustline.accessor


@pytest.fixture
def frame() -> geopandas.GeoDataFrame:
    """Two rings that lie in each other, told apart by a column, shuffled, across 180° E."""
    angle = np.arange(40) * (2 * np.pi / 40)
    lon = np.concatenate([179.5 + 3 * np.cos(angle), 179.5 + np.cos(angle)])
    lat = np.concatenate([3 * np.sin(angle), np.sin(angle)])
    order = np.random.default_rng(1).permutation(80)
    place = geopandas.points_from_xy(((lon + 180) % 360 - 180)[order], lat[order])
    kind = np.repeat(["shore", "lake"], 40)[order]
    return geopandas.GeoDataFrame({"kind": kind}, geometry=place, crs="EPSG:4326")


def test_a_frame_gives_a_frame_of_curves(frame: geopandas.GeoDataFrame) -> None:
    """geopandas #1739: the whole frame, not each geometry."""
    found = frame.crustline.reconstruct(method=cl.crust, project="auto")
    assert found.crs == frame.crs
    assert found["closed"].tolist() == [True, True]
    assert sorted(found["kind"]) == ["lake", "shore"]
    for rows, line in zip(found["rows"], found.geometry, strict=True):
        vertices = geopandas.points_from_xy(*np.array(line.coords)[:-1].T)
        assert all(vertices == frame.geometry.iloc[rows].to_numpy())


def test_by_a_column(frame: geopandas.GeoDataFrame) -> None:
    found = frame.crustline.reconstruct(by="kind", project="auto", orient="cw")
    assert sorted(found["kind"]) == ["lake", "shore"]
    # Across the meridian degrees jump, so directions are looked at on the map.
    for line in found.to_crs("+proj=stere +lon_0=179.5").geometry:
        assert not shapely.is_ccw(shapely.linearrings(line.coords))
    with pytest.raises(cl.InputError, match="no column of the frame: choose from 'kind'"):
        frame.crustline.reconstruct(by="type")


def test_a_frame_without_geometries_is_told() -> None:
    with pytest.raises(AttributeError, match="no geometries"):
        _ = pandas.DataFrame({"x": [1.0]}).crustline
