"""Points of pictures are where the edges, boundaries and strokes that were rendered are."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from PIL import Image, ImageDraw

import crustline as cl
from crustline.images import Axes, boundary_points, edge_points, stroke_points
from crustline.images.picture import MOST_PIXELS
from pictures import covered, disk, far_from_circle, painted, ring

CIRCLE = (61.3, 66.7, 40.2)
RED, WHITE, BLACK = (221, 0, 0), (255, 255, 255), (0, 0, 0)


def assert_one_ring(points) -> None:
    curves = cl.reconstruct(points)
    assert curves.closed.tolist() == [True]
    assert len(curves.isolated) == 0


# Edges


@pytest.mark.parametrize(("blur", "most"), [(0.7, 0.09), (1.0, 0.07), (2.0, 0.08)])
def test_edges_of_a_disk_are_on_its_circle(blur, most):
    points = edge_points(disk(128, *CIRCLE), blur=blur)
    assert np.abs(far_from_circle(points, *CIRCLE)).max() < most
    assert_one_ring(points)


@pytest.mark.parametrize("quarters", range(4))
@pytest.mark.parametrize("place", [10.0, 10.25, 10.5, 10.9])
def test_a_straight_step_is_found_to_a_few_hundredths_of_a_pixel(quarters, place):
    step = covered(20, 20, lambda right, down: right < place)
    points = edge_points(np.rot90(step, quarters), blur=1.5)
    where = [points[:, 0], -points[:, 1], 20 - points[:, 0], 20 + points[:, 1]]
    # np.rot90 turns counter-clockwise: what was at the left is below, then at the right.
    assert np.abs(where[[0, 3, 2, 1][quarters]] - place).max() < 0.025
    assert len(points) == 18


def test_edges_are_found_in_noise_and_uneven_light():
    rng = np.random.default_rng(5)
    light = np.linspace(0.6, 1.0, 128)
    image = disk(128, *CIRCLE) * light + rng.normal(0, 0.03, (128, 128))
    points = edge_points(image, blur=1.5, contrast=0.3)
    far = np.abs(far_from_circle(points, *CIRCLE))
    assert far.max() < 0.3
    assert np.sqrt((far**2).mean()) < 0.06
    assert_one_ring(points)


def test_edges_between_colors_of_one_brightness_are_found():
    image = painted(disk(128, *CIRCLE), (200, 0, 0), (0, 102, 0))
    assert_one_ring(edge_points(image))


def test_a_step_of_less_contrast_is_no_edge():
    image = disk(128, *CIRCLE) * 0.15 + disk(128, 15.0, 15.0, 8.0)
    assert len(edge_points(image)) < 60
    assert len(edge_points(image, contrast=0.1)) > 200


@pytest.mark.parametrize("axis", [0, 1])
def test_edges_of_a_mirrored_picture_are_mirrored(axis):
    image = disk(128, *CIRCLE)
    mirrored = edge_points(np.flip(image, axis))
    back = mirrored * [(1, -1), (-1, 1)][axis] + [(0, -128), (128, 0)][axis]
    order = [np.lexsort(np.round(points, 3).T) for points in (edge_points(image), back)]
    assert np.allclose(edge_points(image)[order[0]], back[order[1]], atol=1e-3)


# Boundaries


def test_boundary_of_a_smooth_mask_is_its_circle():
    points = boundary_points(disk(128, *CIRCLE))
    assert np.abs(far_from_circle(points, *CIRCLE)).max() < 0.12
    assert_one_ring(points)


def test_boundary_of_a_mask_of_two_values_is_within_half_a_pixel():
    points = boundary_points(disk(128, *CIRCLE) > 0.5)
    far = np.abs(far_from_circle(points, *CIRCLE))
    assert far.max() < 0.5
    assert np.sqrt((far**2).mean()) < 0.2
    assert_one_ring(points)


def test_boundary_is_the_same_of_a_mask_and_its_negative():
    mask = disk(64, 30.0, 33.0, 20.0)
    here, there = boundary_points(mask), boundary_points(1 - mask)
    assert np.allclose(here, there, atol=1e-6)


def test_boundary_of_alpha():
    image = np.zeros((128, 128, 4), np.uint8)
    image[..., 3] = np.round(255 * disk(128, *CIRCLE))
    assert np.abs(far_from_circle(boundary_points(image), *CIRCLE)).max() < 0.12


def test_boundary_of_what_the_picture_cuts_off_ends_at_its_border():
    mask = np.zeros((30, 30))
    mask[10:20, :8] = 1
    points = boundary_points(mask)
    assert points[:, 0].min() == 0
    assert_one_ring(points)


def test_boundary_of_a_color_ignores_others():
    image = painted(disk(128, *CIRCLE), RED, WHITE)
    image[4:10, 4:90] = BLACK
    image[4:90, 118:124] = (255, 136, 0)
    points = boundary_points(image, color="#d00")
    assert np.abs(far_from_circle(points, *CIRCLE)).max() < 0.15
    assert_one_ring(points)


# Strokes


@pytest.mark.parametrize("width", [1, 2, 3, 4, 6, 10])
def test_middle_of_a_stroke_is_its_circle(width):
    points = stroke_points(1 - ring(128, *CIRCLE, width))
    assert np.abs(far_from_circle(points, *CIRCLE)).max() < 0.15
    assert_one_ring(points)


@pytest.mark.parametrize("width", [2, 5])
def test_middle_of_a_stroke_of_a_color(width):
    image = painted(ring(128, *CIRCLE, width), RED, WHITE)
    image[:, 5:8] = BLACK
    points = stroke_points(image, color=RED)
    assert np.abs(far_from_circle(points, *CIRCLE)).max() < 0.12
    assert_one_ring(points)


def drawn(corners, width: int, joint: str | None = None):
    """A line through corners (column, row), drawn in black."""
    canvas = Image.new("L", (4 * 300, 4 * 200), 255)
    line = [(4 * x, 4 * y) for x, y in corners]
    ImageDraw.Draw(canvas).line(line, fill=0, width=4 * width, joint=joint)
    return np.asarray(canvas.resize((300, 200), Image.Resampling.BOX))


@pytest.mark.parametrize("joint", [None, "curve"])
@pytest.mark.parametrize("width", [2, 5, 9])
@pytest.mark.parametrize("tilt", [0, 20, 45])
def test_a_zigzag_with_sharp_corners_is_one_line(width, joint, tilt):
    corners = [(30, 40 + tilt), (110, 150), (190, 40), (270, 150 - tilt)]
    curves = cl.reconstruct(stroke_points(drawn(corners, width, joint)))
    assert len(curves) == 1
    assert curves.closed.tolist() == [False]
    assert len(curves.isolated) == 0
    ends = curves.points.xy[curves.endpoints]
    for corner in (corners[0], corners[-1]):
        assert np.hypot(*(ends - corner * np.array([1, -1])).T).min() < 1.5 * width + 1


def test_ink_is_found_on_paper_with_shadows_and_grain():
    rng = np.random.default_rng(8)
    paper = np.linspace(0.5, 1.0, 128)[:, None] * np.ones(128)
    image = paper * (1 - 0.8 * ring(128, *CIRCLE, 3)) + rng.normal(0, 0.02, (128, 128))
    points = stroke_points(image)
    assert np.abs(far_from_circle(points, *CIRCLE)).max() < 0.3
    assert_one_ring(points)


def test_bright_ink_on_dark_paper_is_ink():
    stroke = ring(128, *CIRCLE, 3)
    assert np.allclose(stroke_points(stroke), stroke_points(1 - stroke), atol=0.02)


# Any picture


@settings(deadline=None, max_examples=60)
@given(
    hnp.arrays(
        st.sampled_from([np.uint8, np.uint16, np.bool_]),
        hnp.array_shapes(min_dims=2, max_dims=3, min_side=1, max_side=9).filter(
            lambda shape: len(shape) == 2 or shape[2] <= 4
        ),
    )
)
def test_any_picture_has_points_within_it(image):
    height, width = image.shape[:2]
    for find in (edge_points, boundary_points, stroke_points):
        points = find(image)
        assert points.shape[1] == 2
        assert np.isfinite(points).all()
        if len(points):
            assert (points >= [-1, -height - 1]).all()
            assert (points <= [width + 1, 1]).all()


@pytest.mark.parametrize(
    ("image", "words"),
    [
        (np.zeros(4), r"the shape is \(4,\)"),
        (np.zeros((3, 0)), "no pixels"),
        (np.zeros((2, 2, 5)), "b from 1 to 4"),
        (np.array([[0.0, np.nan]]), r"pixel \(0, 1\) .* not finite"),
        (np.array([["a"]]), "give whole numbers"),
        (np.broadcast_to(np.uint8(0), (1 << 16, 1 << 14)), f"more than {MOST_PIXELS:,}"),
    ],
)
def test_what_is_no_picture_is_refused(image, words):
    for find in (edge_points, boundary_points, stroke_points):
        with pytest.raises(cl.InputError, match=words):
            find(image)


@pytest.mark.parametrize("image", [np.zeros((1, 1)), np.ones((1, 3)), np.zeros((7, 7))])
def test_nothing_is_found_in_nothing(image):
    for find in (edge_points, boundary_points, stroke_points):
        assert find(image).shape == (0, 2)


@pytest.mark.parametrize("color", ["red", "#12", (1, 2), (1, 2, 300), "#ggg", None, object()])
def test_what_is_no_color_is_refused(color):
    if color is not None:
        with pytest.raises(cl.InputError, match="color is"):
            boundary_points(np.zeros((3, 3)), color=color)


# Axes

PIXELS = np.array([(60.5, -430.5), (560.5, -30.5), (310.5, -230.5)])


def test_two_places_tell_upright_axes():
    axes = Axes.parse("60,430=0,1 560,30=10,1e4 log=y")
    assert axes.place(PIXELS) == pytest.approx(np.array([(0, 1), (10, 1e4), (5, 100)]))


def test_each_axis_may_have_places_of_its_own():
    axes = Axes.parse("60,430=0,;560,430=10,  60,430=,1 60,30=,5")
    assert axes.place(PIXELS) == pytest.approx(np.array([(0, 1), (10, 5), (5, 3)]))


def test_both_axes_may_be_logarithmic():
    axes = Axes.parse("60,430=1,1 560,30=100,1e4 log=xy")
    assert axes.place(PIXELS[2:]) == pytest.approx(np.array([(10, 100)]))


def test_three_places_tell_a_turned_scan():
    angle = np.radians(3)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    plot = np.array([(0.0, 0.0), (10.0, 0.0), (0.0, 5.0), (7.0, 3.0)])
    spots = plot * 40 @ turn.T + (100.5, -300.5)
    words = [
        f"{x - 0.5!r},{-y - 0.5!r}={a},{b}"
        for (x, y), (a, b) in zip(spots.tolist(), plot.tolist(), strict=True)
    ]
    axes = Axes.parse(" ".join(words[:3]))
    assert axes.place(spots) == pytest.approx(plot, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "'' is no place"),
        ("1,2=3", "'1,2=3' is no place"),
        ("1,2=3,4", "X is told by less than two"),
        ("1,2=3,4 1,5=4,5", "X has two values at one column"),
        ("1,2=3,4 3,2=4,5", "Y has two values at one row"),
        ("1,2=0,4 3,4=4,5 log=x", "X is logarithmic and 0"),
        ("1,2=0,4 3,4=4,5 log=z", "'log=z' is no place"),
        ("1,2=3,nan 3,4=4,5", "is no place"),
    ],
)
def test_axes_that_tell_nothing_are_refused(text, words):
    with pytest.raises(cl.InputError, match=words):
        Axes.parse(text)


def test_axes_beyond_all_numbers_are_refused():
    with pytest.raises(cl.InputError, match="beyond all numbers"):
        Axes.parse("0,0=1e-300,1 1,1=1e300,2 log=x").place(PIXELS)
