"""SVG: the text of the picture."""

from __future__ import annotations

import io
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from crustline.curves import trace
from crustline.errors import InputError
from crustline.formats import read, write

SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]
INNER = [(3, 3), (6, 3), (6, 6), (3, 6)]
EDGES = [(0, 1), (1, 2), (2, 3), (0, 3), (4, 5), (5, 6), (6, 7), (4, 7), (8, 9)]


def lake(scale=1.0, offset=0.0):
    points = np.array([*SQUARE, *INNER, (12, 0.5), (13, 2), (15, 15)]) * scale + offset
    return trace(points, EDGES)


def draw(curves, tmp_path, **options):
    path = tmp_path / "curves.svg"
    write(curves, path, **options)
    return ElementTree.parse(path).getroot()


def paths(root):
    return [element.attrib for element in root.iter("{http://www.w3.org/2000/svg}path")]


def test_one_path_for_each_curve(tmp_path):
    ring, inner, line, dots = paths(draw(lake(), tmp_path))
    assert ring["d"] == "M0 0L9 0L9 9L0 9Z"
    assert inner["d"] == "M3 3L6 3L6 6L3 6Z"
    assert line["d"] == "M12 0.5L13 2"
    assert dots["d"] == "M15 15h0"


def test_y_points_upwards_and_all_is_in_view(tmp_path):
    root = draw(lake(), tmp_path)
    x, y, width, height = map(float, root.attrib["viewBox"].split())
    assert x < 0
    assert x + width > 15
    assert y < -15
    assert y + height > 0
    (group,) = root.iter("{http://www.w3.org/2000/svg}g")
    assert group.attrib["transform"] == "scale(1 -1)"


def test_polygons_hold_their_holes(tmp_path):
    polygon, line, _ = paths(draw(lake(), tmp_path, polygons=True))
    assert polygon["d"] == "M0 0L9 0L9 9L0 9ZM3 3L3 6L6 6L6 3Z"
    assert "fill" in polygon
    assert "fill" not in line


@pytest.mark.parametrize("scale", [2.0**-300, 2.0**-60, 2.0**60, 2.0**300])
def test_any_scale_gives_a_picture_of_moderate_numbers(tmp_path, scale):
    root = draw(lake(scale), tmp_path)
    factor = float(root.attrib["data-scale"])
    numbers = [float(each) for each in re.findall(r"[-\d.e]+", paths(root)[0]["d"])]
    assert (np.array(numbers) / factor).tolist() == (np.array(SQUARE) * scale).ravel().tolist()
    assert 1 < max(numbers) < 1e6


def test_a_far_offset_is_subtracted_exactly(tmp_path):
    root = draw(lake(offset=6e6 + 0.1), tmp_path)
    origin = np.array([float(each) for each in root.attrib["data-origin"].split()])
    numbers = [float(each) for each in re.findall(r"[-\d.e]+", paths(root)[0]["d"])]
    assert max(numbers) < 20
    expected = np.array(SQUARE) + (6e6 + 0.1)
    assert np.array_equal(np.array(numbers).reshape(-1, 2) + origin, expected)


@pytest.mark.parametrize("points", [[], [(3, 4)], [(3, 4), (3, 4)], [(1, 1), (2, 1)]])
def test_degenerate_pictures(tmp_path, points):
    root = draw(trace(points, []), tmp_path)
    numbers = [float(each) for each in root.attrib["viewBox"].split()]
    assert np.isfinite(numbers).all()
    assert min(numbers[2:]) > 0


def test_the_whole_double_range(tmp_path):
    points = [(-1.7e308, -1.7e308), (1.7e308, 1.7e308)]
    numbers = [float(each) for each in draw(trace(points, []), tmp_path).attrib["viewBox"].split()]
    assert np.isfinite(numbers).all()


def test_the_same_curves_give_the_same_text(tmp_path):
    write(lake(), tmp_path / "a.svg")
    write(lake(), tmp_path / "b.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_a_picture_is_not_read(tmp_path):
    (tmp_path / "a.svg").write_text("<svg/>")
    with pytest.raises(InputError, match="svg"):
        read(tmp_path / "a.svg", format="svg")


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e7])
@pytest.mark.parametrize("stretch", [(1, 1), (1, 0.01), (0.01, 1)])
def test_strokes_are_thin_in_a_viewer_of_its_own(scale, stretch):
    """They rested on vector-effect, so some viewers drew solid blots."""
    resvg_py = pytest.importorskip("resvg_py")
    matplotlib_image = pytest.importorskip("matplotlib.image")
    angles = np.arange(60) * np.pi / 30
    ring = np.column_stack([np.cos(angles), np.sin(angles)]) * stretch * scale
    stream = io.BytesIO()
    write(trace(ring, [(i, (i + 1) % 60) for i in range(60)]), stream, format="svg")
    picture = resvg_py.svg_to_bytes(svg_string=stream.getvalue().decode(), background="white")
    ink = 1 - matplotlib_image.imread(io.BytesIO(bytes(picture)))[..., 0]
    extent = max(ink.shape) / 1.06
    length = extent * (np.pi if stretch == (1, 1) else 2)
    # The color is as dark as 0.88 of black.
    assert ink.sum() == pytest.approx(1.5 * 0.88 * length, rel=0.05)
