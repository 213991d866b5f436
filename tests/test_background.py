"""Outlines of a map below the curves: those around the points, in their CRS."""

from __future__ import annotations

import numpy as np
import pytest

import crustline as cl

pytest.importorskip("matplotlib")
pytest.importorskip("pyproj")

from crustline import plot


def segments_of(ax):
    """The segments of the background of Axes, (m, 2, 2)."""
    lines = [each for each in ax.collections if each.get_zorder() == 0.5]
    paths = [path for each in lines for path in each.get_paths()]
    return np.concatenate(
        [np.empty((0, 2, 2)), *(each.vertices.reshape(-1, 2, 2) for each in paths)]
    )


def test_the_coasts_around_points_are_drawn_in_their_crs():
    lonlat = cl.Points([(8, 54), (12, 57)], crs="EPSG:4326")  # Denmark
    ax = plot.plot_background(lonlat)
    there = segments_of(ax)
    assert 20 < len(there) < 2000
    assert there[..., 0].min() > -20
    assert there[..., 0].max() < 60
    assert ax.get_xlim()[0] > 5  # not of the coasts
    meters = cl.project(lonlat, "EPSG:25832")
    projected = segments_of(plot.plot_background(meters))
    back = cl.project(cl.Points(projected.reshape(-1, 2), crs="EPSG:25832"), "EPSG:4326").xy
    known = {tuple(row) for row in there.reshape(-1, 2).round(6)}
    assert {tuple(row) for row in back.round(6)} <= known
    assert len(projected) > 20


def test_no_coast_leads_around_the_world():
    for points in ([(179, -18), (-179, -17)], [(170, -20), (180, -10)], [(-180, -90), (180, 90)]):
        there = segments_of(plot.plot_background(cl.Points(points, crs="EPSG:4326")))
        assert np.abs(np.diff(there[..., 0], axis=1)).max() < 90


def test_the_background_may_be_a_file_in_another_crs(tmp_path):
    square = cl.reconstruct(cl.Points([(8, 54), (9, 54), (9, 55), (8, 55)], crs="EPSG:4326"))
    square.write(tmp_path / "coast.gpkg")
    meters = cl.project(cl.Points([(8.2, 54.2), (8.8, 54.8)], crs="EPSG:4326"), "EPSG:25832")
    plot.picture(meters, tmp_path / "a.png", background=tmp_path / "coast.gpkg")
    there = segments_of(plot.plot_background(meters, outlines=tmp_path / "coast.gpkg"))
    assert len(there) == 4


def test_a_background_needs_the_same_kind_of_crs(tmp_path):
    with pytest.raises(cl.InputError, match="the points have no CRS"):
        plot.plot_background(cl.Points([(8, 54), (9, 55)]))
    cl.reconstruct([(0, 0), (1, 0), (0, 1)]).write(tmp_path / "a.geojson")
    with pytest.raises(cl.InputError, match="outlines of the background"):
        plot.plot_background(cl.Points([(8, 54)], crs="EPSG:4326"), outlines=tmp_path / "a.geojson")
    assert not len(
        segments_of(plot.plot_background(cl.Points([(8, 5)]), outlines=tmp_path / "a.geojson"))
    )
    with pytest.raises(cl.CrustlineError):
        plot.plot_background(cl.Points([(8, 54)], crs="EPSG:4326"), outlines=tmp_path / "none.gpkg")
