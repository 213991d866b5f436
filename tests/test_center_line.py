"""The center line of polygons: near the medial axis of their sides, which is known for some."""

from __future__ import annotations

import numpy as np
import pytest

import crustline as cl
from crustline import Curves, InputError

WIDTH, LENGTH = 1.0, 10.0
#: The medial axis of a rectangle: a line in the middle, and an arm to each corner.
MIDDLE = [(0.5, 0.5), (9.5, 0.5)]
ARMS = [[(x, y), (abs(x - 0.5), 0.5)] for x in (0, 10) for y in (0, 1)]


def polygons(text: str) -> Curves:
    return cl.read_curves(text.encode(), format="wkt")


def distances(points: np.ndarray, ends: list[tuple[float, float]]) -> np.ndarray:
    start, end = np.array(ends, dtype=float)
    step = end - start
    t = np.clip((points - start) @ step / (step @ step), 0, 1)
    return np.linalg.norm(points - start - t[:, None] * step, axis=1)


@pytest.mark.parametrize("accuracy", [0.1, 0.01, 0.001])
def test_of_a_rectangle(accuracy: float) -> None:
    """It had 0 inner edges: four corners on one circle have one Voronoi vertex."""
    rectangle = polygons("POLYGON((0 0,10 0,10 1,0 1,0 0))")
    axis = cl.center_line(rectangle, accuracy=accuracy)
    arms = [[(x, y), (abs(x - 0.5) if x == 0 else 9.5, 0.5)] for x in (0, 10) for y in (0, 1)]
    off = np.min([distances(axis.vertices, each) for each in (MIDDLE, *arms)], axis=0)
    assert off.max() <= accuracy * WIDTH
    assert axis.inner.all()
    assert len(axis.ray_origins) == 0
    ends = axis.vertices[axis.edges]
    for along in np.linspace(0.5, 9.5, 50):  # and all of the line is there
        covers = (ends[:, :, 0].min(axis=1) <= along) & (along <= ends[:, :, 0].max(axis=1))
        assert covers.any()
    for x, y in [(0, 0), (10, 0), (10, 1), (0, 1)]:
        assert np.linalg.norm(axis.vertices - (x, y), axis=1).min() <= 2 * accuracy * WIDTH


def test_of_an_annulus_is_one_ring() -> None:
    ring = polygons("POLYGON((0 0,10 0,10 10,0 10,0 0),(1 1,9 1,9 9,1 9,1 1))")
    curves = cl.center_line(ring).prune(1).curves()
    assert curves.closed.tolist() == [True]
    x, y = curves.points.xy[curves.indices].T
    square = np.maximum(abs(x - 5), abs(y - 5))
    assert abs(square - 4.5).max() <= 0.25  # at the corners of the hole it runs along parabolas
    straight = np.minimum(abs(x - 5), abs(y - 5)) < 3.5
    assert abs(square - 4.5)[straight].max() <= 0.01


def test_a_neck_is_followed() -> None:
    """A corner that nearly touches the side across is no end of the axis."""
    curves = cl.center_line(polygons("POLYGON((0 0,100 0,100 10,50 0.1,0 10,0 0))")).prune(15)
    (line,) = curves.curves()
    assert line.points[:, 0].min() < 10
    assert line.points[:, 0].max() > 90
    neck = abs(line.points[:, 0] - 50) < 0.02
    assert abs(line.points[neck, 1] - 0.05).max() < 0.002


def test_holes_and_several_polygons_have_axes_of_their_own() -> None:
    two = polygons("MULTIPOLYGON(((0 0,5 0,5 1,0 1,0 0)),((0 9,5 9,5 10,0 10,0 9)))")
    axis = cl.center_line(two).prune(1).curves()
    assert sorted(round(float(curve.points[:, 1].mean()), 1) for curve in axis) == [0.5, 9.5]


def test_a_line_within_bounds_too() -> None:
    lines = "POLYGON((0 0,10 0,10 2,0 2,0 0))\nLINESTRING(0.5 1,9.5 1)"
    axis = cl.center_line(polygons(lines)).prune(3)
    x, y = axis.vertices[np.unique(axis.edges)].T
    inside = (x > 1.5) & (x < 8.5)
    assert set(np.round(y[inside], 1)) == {0.5, 1.5}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("LINESTRING(0 0,1 1,2 0)", "no curve is a ring"),
        ("POLYGON((0 0,10 0,0 1,10 1,0 0))", "cross"),
    ],
)
def test_what_bounds_nothing_is_refused(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        cl.center_line(polygons(text))
