"""Results are values: equal if their arrays are, never changed, copied and pickled as a whole."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import crustline as cl

RING = np.array([(0.0, 0), (2, 0), (3, 1), (2, 2), (0, 2), (9, 9)])
EDGES = [(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)]

RESULTS: dict[str, Callable[[Any], Any]] = {
    "Points": lambda points: cl.Points(points, z=np.arange(6), columns={"a": list("abcdef")}),
    "Delaunay": cl.Delaunay,
    "Curves": lambda points: cl.trace(points, EDGES),
    "Curve": lambda points: cl.trace(points, EDGES)[0],
    "Polygon": lambda points: cl.trace(points, EDGES).polygons()[0],
    "MedialAxis": lambda points: cl.medial_axis(points, EDGES),
    "Certificate": lambda points: cl.certify(points, EDGES),
}


@pytest.mark.parametrize("name", RESULTS)
def test_equal_results_are_equal_and_others_are_not(name: str) -> None:
    make = RESULTS[name]
    assert make(RING) == make(RING.copy())
    assert make(RING) != make(RING[[1, 2, 3, 4, 0, 5]] * 2) or name == "Polygon"
    assert make(RING) != RING.tolist()
    with pytest.raises(TypeError, match="hash"):
        hash(make(RING))


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_pickled_and_copied(name: str) -> None:
    result = RESULTS[name](RING)
    for duplicate in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
        assert duplicate == result
        assert repr(duplicate) == repr(result)


def arrays_of(thing: Any) -> dict[str, np.ndarray]:
    public = (name for name in dir(thing) if not name.startswith("_"))
    values = {name: getattr(thing, name) for name in public}
    return {name: value for name, value in values.items() if isinstance(value, np.ndarray)}


@pytest.mark.parametrize("name", RESULTS)
def test_no_array_of_a_result_can_be_written_or_is_the_callers(name: str) -> None:
    points = RING.copy()
    for result in (RESULTS[name](points), pickle.loads(pickle.dumps(RESULTS[name](points)))):
        for field, array in arrays_of(result).items():
            assert not array.flags.writeable or not _is_field(result, field), field
            assert not np.shares_memory(array, points), field


def _is_field(result: Any, name: str) -> bool:
    """What a property computes anew each time may be written: it is no part of the result."""
    return getattr(result, name) is getattr(result, name)


def test_the_triangulation_keeps_its_points_as_they_were() -> None:
    points = RING.copy()
    delaunay = cl.Delaunay(points)
    points[0] = 99
    assert delaunay.points[0].tolist() == [0, 0]


def test_what_points_carry_survives_the_triangulation() -> None:
    points = cl.Points(RING, z=np.arange(6), crs="EPSG:25832")
    delaunay = cl.Delaunay(points)
    assert delaunay.points is points
    for result in (
        cl.reconstruct(delaunay),
        cl.trace(delaunay, EDGES),
        cl.medial_axis(delaunay),
        cl.certify(delaunay),
    ):
        assert result.points is points


def test_every_function_of_points_takes_a_triangulation() -> None:
    delaunay = cl.Delaunay(RING)
    assert np.array_equal(cl.crust(delaunay), cl.crust(RING))
    assert np.array_equal(cl.thin(delaunay, EDGES, r=0.5), cl.thin(RING, EDGES, r=0.5))
    sizes = cl.local_feature_size(delaunay), cl.local_feature_size(RING, cl.crust(RING))
    assert np.array_equal(*sizes, equal_nan=True)
    circle = cl.shapes.circle()
    ratios = [cl.sampling_ratio(circle, points) for points in (RING, delaunay, delaunay.points)]
    assert len(set(ratios)) == 1
    assert cl.is_r_sample(circle, delaunay, 9.0) == cl.is_r_sample(circle, RING, 9.0)
    assert cl.Points(delaunay) == cl.Points(RING)


def test_a_pickled_triangulation_is_the_same_without_its_progress() -> None:
    delaunay = cl.Delaunay(RING, threads=2, progress=lambda stage, done: None)
    again = pickle.loads(pickle.dumps(delaunay))
    assert np.array_equal(again.triangles, delaunay.triangles)
    assert again == delaunay


@pytest.mark.parametrize("name", ["Points", "Delaunay", "Certificate"])
def test_notebooks_show_a_table(name: str) -> None:
    html = RESULTS[name](RING)._repr_html_()
    assert html.count("<") == html.count(">")
    assert "table" in html or "<p>" in html


def test_a_notebooks_table_is_escaped_and_short() -> None:
    points = cl.Points(np.arange(2e6).reshape(-1, 2), columns={"<b>": ["&"] * 1_000_000})
    html = points._repr_html_()
    assert "<b>" not in html
    assert "&amp;" in html
    assert len(html) < 2000
    assert "999,999" in html


@pytest.mark.parametrize("name", ["Curves", "MedialAxis"])
def test_notebooks_show_a_picture(name: str) -> None:
    assert RESULTS[name](RING)._repr_svg_().startswith("<svg")


CURVES = {
    "circle": cl.shapes.circle(2),
    "ellipse": cl.shapes.ellipse(2, 1),
    "stadium": cl.shapes.stadium(2, 1),
    "trefoil": cl.shapes.trefoil(),
    "blob": cl.shapes.blob(3),
    "superformula": cl.shapes.superformula(4, 2, 4, 4),
    "fourier": cl.shapes.fourier([0, 1, 0.1, 0]),
    "spline": cl.shapes.spline(RING[:5]),
    "beziers": cl.shapes.two_octagons_joined(),
    "moved": cl.shapes.circle().moved(scale=2, angle=1, offset=(3, 4)) + cl.shapes.circle(),
}


@pytest.mark.parametrize("name", CURVES)
def test_smooth_curves_are_pickled_and_copied(name: str) -> None:
    curve, t = CURVES[name], np.arange(24) / 24
    for duplicate in (pickle.loads(pickle.dumps(curve)), copy.deepcopy(curve)):
        for own, other in zip(curve.derivatives(t), duplicate.derivatives(t), strict=True):
            assert np.array_equal(own, other)


def test_splines_are_pickled_and_copied() -> None:
    splines = cl.smooth(cl.trace(RING, EDGES))
    for duplicate in (pickle.loads(pickle.dumps(splines)), copy.deepcopy(splines)):
        assert np.array_equal(duplicate.beziers()[0], splines.beziers()[0])
