"""Smooth curves: derivatives, curvature, medial axis and local feature size, by definition."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from crustline import shapes
from crustline.errors import FormatError, InputError
from crustline.shapes import Loop, SmoothCurve, contacts
from crustline.shapes.bezier import bezier_loop

FloatArray = npt.NDArray[np.float64]

CURVES = {
    "circle": shapes.circle(2),
    "ellipse": shapes.ellipse(3, 1),
    "stadium": shapes.stadium(3, 0.5),
    "trefoil": shapes.trefoil(3, 0.4),
    "blob": shapes.blob(4),
    "superformula": shapes.superformula(6, 3, 4, 4),
    "fourier": shapes.fourier([0, 2, 0.1, 0.2j, 0, 0, -0.2, 0.3]),
    "nested": shapes.ellipse(3, 2) + shapes.blob(5).moved(scale=0.7, angle=1.0, offset=(0.2, 0.1)),
    "side by side": shapes.circle() + shapes.circle().moved(offset=(2.3, 0)),
    "figure 6, separate": shapes.two_octagons_separate(),
    "figure 6, joined": shapes.two_octagons_joined(),
}
SMOOTH = ["circle", "ellipse", "trefoil", "blob", "superformula", "fourier", "nested"]


@pytest.fixture(params=list(CURVES), ids=lambda name: str(name).replace(" ", "-"))
def curve(request: pytest.FixtureRequest) -> SmoothCurve:
    return CURVES[request.param]


def forgotten(curve: SmoothCurve) -> SmoothCurve:
    """Return the curve without what is known of its medial axis, so that it is computed."""
    return SmoothCurve(tuple(Loop(loop.derivatives, loop.pieces) for loop in curve.loops))


def places(curve: SmoothCurve, k: int) -> FloatArray:
    return (np.arange(k) + 0.37) / k


def test_velocity_and_acceleration_are_the_derivatives(curve: SmoothCurve) -> None:
    c, h = len(curve.loops), 1e-6
    t = places(curve, 501)
    _, velocity, acceleration = curve.derivatives(t)
    ahead, behind = curve.derivatives(t + h / c), curve.derivatives(t - h / c)
    assert np.allclose((ahead[0] - behind[0]) / (2 * h), velocity, atol=1e-6, rtol=1e-6)
    assert np.allclose((ahead[1] - behind[1]) / (2 * h), acceleration, atol=1e-4, rtol=1e-5)


def test_each_loop_closes(curve: SmoothCurve) -> None:
    for part in curve.components:
        assert np.allclose(part.point(0.0), part.point(np.nextafter(1, 0)), atol=1e-9)
        assert np.allclose(part.tangent(0.0), part.tangent(np.nextafter(1, 0)), atol=1e-6)


def test_components_are_the_curve(curve: SmoothCurve) -> None:
    u = places(curve, 7)
    for i, part in enumerate(curve.components):
        assert np.allclose(part.point(u), curve.point((i + u) / len(curve.loops)), atol=1e-12)


def test_curvature_is_the_turn_of_the_tangent_and_counter_clockwise_positive() -> None:
    assert np.allclose(shapes.circle(2).curvature(places(shapes.circle(), 9)), 0.5)
    for name in SMOOTH:
        for part in CURVES[name].components:
            t = np.arange(4000) / 4000
            speed = np.hypot(*part.derivatives(t)[1].T)
            assert np.mean(part.curvature(t) * speed) == pytest.approx(2 * np.pi)


def test_tangent_and_normal_are_unit_and_at_right_angles(curve: SmoothCurve) -> None:
    t = places(curve, 50).reshape(5, 10)
    tangent, normal = curve.tangent(t), curve.normal(t)
    assert tangent.shape == (5, 10, 2)
    assert np.allclose(np.sum(tangent**2, -1), 1)
    assert np.allclose(tangent[..., 0] * normal[..., 1] - tangent[..., 1] * normal[..., 0], 1)


# The medial axis.


@pytest.mark.parametrize("a", [1.1, 1.5, 2.0, 3.0, 4.0, 6.0])
def test_ellipse_axis_computed_is_the_segment_known(a: float) -> None:
    known = shapes.ellipse(a, 1)
    t = np.linspace(0, 1, 2001)
    computed = forgotten(known).local_feature_size(t)
    assert np.max(np.abs(computed / known.local_feature_size(t) - 1)) < 1e-6
    axis = forgotten(known).medial_axis()
    assert np.abs(axis.vertices[:, 1]).max() < 1e-6
    assert axis.vertices[:, 0].max() == pytest.approx((a * a - 1) / a, rel=1e-6)


@pytest.mark.parametrize("length", [0.1, 1.0, 5.0])
def test_stadium_axis_computed_is_the_segment_known(length: float) -> None:
    known = shapes.stadium(length, 0.7)
    t = np.linspace(0, 1, 2001)
    computed = forgotten(known).local_feature_size(t)
    assert np.max(np.abs(computed / known.local_feature_size(t) - 1)) < 1e-4
    assert np.all(known.local_feature_size(t) <= 0.7 * (1 + 1e-12))


def test_local_feature_size_is_within_a_thousandth_of_brute_force() -> None:
    """The Voronoi vertices of dense samples tend to the medial axis (Brandt and Algazi)."""
    spatial = pytest.importorskip("scipy.spatial")
    for name in ("trefoil", "blob", "fourier", "nested"):
        curve = CURVES[name]
        dense = curve.point((np.arange(12_000) + 0.5) / 12_000)
        vertices = spatial.Voronoi(dense).vertices
        t = places(curve, 500)
        truth = spatial.cKDTree(vertices).query(curve.point(t))[0]
        assert np.max(np.abs(curve.local_feature_size(t) / truth - 1)) < 3e-4, name


def test_axis_vertices_are_centers_of_empty_disks_that_touch(curve: SmoothCurve) -> None:
    axis = curve.medial_axis()
    if axis.error == 0:
        return
    dense = curve.point(np.arange(20_000) / 20_000)
    nearest = np.array([np.hypot(*(dense - vertex).T).min() for vertex in axis.vertices])
    assert np.all(nearest > axis.radii * (1 - 1e-4))
    assert np.all(nearest < axis.radii * (1 + 1e-3))


def test_local_feature_size_is_1_lipschitz_and_at_most_the_radius_of_curvature() -> None:
    for name in SMOOTH:
        for part in CURVES[name].components:
            t = np.arange(5000) / 5000
            lfs, p = part.local_feature_size(t), part.point(t)
            step = np.hypot(*(np.roll(p, -1, axis=0) - p).T)
            assert np.all(np.abs(np.roll(lfs, -1) - lfs) <= step + 1e-4 * lfs)
            assert np.all(lfs * np.abs(part.curvature(t)) <= 1 + 1e-4)


def test_rtol_is_kept() -> None:
    curve = shapes.trefoil(3, 0.5)
    t = places(curve, 500)
    fine = curve.local_feature_size(t, rtol=1e-5)
    for rtol in (1e-2, 1e-3):
        error = np.max(np.abs(curve.local_feature_size(t, rtol=rtol) / fine - 1))
        assert error <= rtol


def test_local_feature_size_between_two_circles_is_half_the_gap() -> None:
    curve = CURVES["side by side"]
    assert curve.local_feature_size(0.0) == pytest.approx(0.15, rel=1e-6)


def test_local_feature_size_scales_and_turns_with_the_curve() -> None:
    curve = shapes.blob(11)
    moved = curve.moved(scale=2.0**20, angle=0.7, offset=(3, -4))
    t = places(curve, 300)
    assert np.allclose(
        moved.local_feature_size(t), 2.0**20 * curve.local_feature_size(t), rtol=1e-4
    )


def test_local_feature_size_is_the_same_far_from_the_origin() -> None:
    """Cartographic offsets: rounding of coordinates is not taken for contacts of tight disks."""
    curve, t = shapes.blob(1), places(shapes.circle(), 200)
    far = curve.moved(offset=(6_000_000, -5_000_000))
    assert np.allclose(far.local_feature_size(t), curve.local_feature_size(t), rtol=1e-3)


def test_pieces_that_are_small_beside_the_features_need_few_nodes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pytest.importorskip("scipy")
    points = shapes.trefoil(3, 0.4).point(np.arange(150) / 150)
    few, all_ = shapes.spline(points), shapes.spline(points)
    t = places(few, 300)
    sizes = few.local_feature_size(t)
    count = len(contacts._first_nodes(few))
    monkeypatch.setattr(contacts, "NODE_TURN", 1e-9)
    assert 4 * count < len(contacts._first_nodes(all_)) == 24 * 150
    assert np.allclose(sizes, all_.local_feature_size(t), rtol=1e-5)


def test_first_nodes_of_many_pieces_hold_jumps_and_extremes_of_the_curvature() -> None:
    """A rounded square of twelve pieces, each of whose joints the axis ends at or runs past."""
    handle = 0.2 * 4 / 3 * (np.sqrt(2) - 1)
    corner = np.array([[1, 0.8], [1, 0.8 + handle], [0.8 + handle, 1], [0.8, 1]])
    side = np.linspace([0.8, 1], [-0.8, 1], 7)[[0, 1, 2, 3, 3, 4, 5, 6]].reshape(2, 4, 2)
    quarter = np.concatenate([corner[None], side])
    turned = [quarter]
    for _ in range(3):
        turned.append(np.stack([-turned[-1][..., 1], turned[-1][..., 0]], -1))
    pieces = np.concatenate(turned)
    loop = SmoothCurve((bezier_loop(pieces),))
    joints = np.delete(np.arange(12), [2, 5, 8, 11]) / 12  # but those amid the straight sides
    assert np.isin(joints, contacts._first_nodes(loop).u).all()
    assert loop.local_feature_size(0.5 / 12) == pytest.approx(0.2, rel=2e-2)
    assert loop.local_feature_size(2 / 12) == pytest.approx(np.sqrt(0.5), rel=1e-3)


def test_the_axis_is_computed_once_whatever_way_the_tolerance_is_given() -> None:
    curve = shapes.blob(21)
    assert curve.medial_axis() is curve.medial_axis(rtol=1e-4)


@pytest.mark.parametrize("size", [1e-60, 1e60])
def test_the_extreme_sizes_that_are_admitted_work(size: float) -> None:
    """Every square, cube and quotient stays within float64: sizes only scale the answer."""
    makers: list[Callable[[float], SmoothCurve]] = [
        shapes.circle,
        lambda x: shapes.ellipse(x, x / 2 if x > 1 else 2 * x),
        lambda x: shapes.stadium(x, x),
        lambda x: shapes.trefoil(3, 0.3, x),
        lambda x: shapes.blob(1, radius=x),
        lambda x: shapes.superformula(4, 2, 2, 2, a=x, b=x / 2 if x > 1 else 2 * x),
        lambda x: shapes.fourier([0, x, 0.1 * x]),
        lambda x: shapes.circle().moved(scale=x),
    ]
    for make in makers:
        curve = make(size)
        lfs = curve.local_feature_size(places(curve, 20)) / size
        assert np.all((lfs > 0.05) & (lfs < 3))
        assert np.all(np.isfinite(curve.curvature(places(curve, 20)) * size))


def test_local_feature_size_keeps_the_shape_of_t() -> None:
    assert shapes.circle().local_feature_size(np.zeros((2, 3))).shape == (2, 3)
    assert float(shapes.circle().local_feature_size(0.25)) == pytest.approx(1.0)


def test_a_curve_that_crosses_itself_is_refused() -> None:
    figure_eight = shapes.fourier([0, 1, 0.9, 0, 0])
    with pytest.raises(InputError, match="crosses or touches itself near"):
        figure_eight.local_feature_size(0.0)
    with pytest.raises(InputError, match="crosses or touches itself near"):
        (shapes.circle() + shapes.circle().moved(offset=(0.5, 0))).local_feature_size(0.0)


# The shapes' own input.


def test_superformula_with_squares_is_the_ellipse() -> None:
    curve = shapes.superformula(4, 2, 2, 2, a=2, b=1)
    x, y = curve.point(places(curve, 100)).T
    assert np.allclose((x / 2) ** 2 + y**2, 1)


def test_fourier_descriptors_of_points_give_back_the_points() -> None:
    points = shapes.regular_polygon(9, 2.0) + np.array([1, -1])
    z = points @ [1, 1j]
    curve = shapes.fourier(np.fft.fft(z) / len(z))
    assert np.allclose(curve.point(np.arange(9) / 9), points)


def test_blobs_are_seeded() -> None:
    t = places(shapes.circle(), 20)
    assert np.array_equal(shapes.blob(3).point(t), shapes.blob(3).point(t))
    assert not np.allclose(shapes.blob(3).point(t), shapes.blob(4).point(t))


def test_spline_goes_through_its_points() -> None:
    pytest.importorskip("scipy")
    points = CURVES["trefoil"].point(np.arange(40) / 40)
    curve = shapes.spline(points)
    chords = np.hypot(*np.diff(np.vstack([points, points[:1]]), axis=0).T)
    t = np.concatenate([[0], np.cumsum(chords)[:-1]]) / chords.sum()
    assert np.allclose(curve.point(t), points)
    with pytest.raises(InputError, match="point 1 equals"):
        shapes.spline([(0, 0), (1, 0), (1, 0), (0, 1)])


def test_bezier_path_from_file_and_string(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    d = "M 0 0 C 0 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z"
    file = tmp_path / "loop.svg"
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{d}" transform="translate(5 0)"/>'
        '<circle cx="0" cy="9" r="2"/></svg>'
    )
    curve, alone = shapes.bezier_path(file), shapes.bezier_path(d)
    assert len(curve.loops) == 2
    u = places(alone, 11)
    assert np.allclose(curve.components[0].point(u), alone.point(u) + np.array([5, 0]))
    assert np.allclose(np.hypot(*(curve.components[1].point(u) - [0, 9]).T), 2, rtol=1e-3)


LOOP = "M 0 0 C 0 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z"


@pytest.mark.parametrize(
    "head",
    [
        "",
        'viewBox="0 0 10 10"',
        'viewBox="0 0 10 10" width="800" height="600"',
        'viewBox="-3,-2,17.3,7.9" width="210mm" height="100%"',
        'viewBox="5 5 1 2" preserveAspectRatio="none" width="800" height="800"',
    ],
)
def test_bezier_path_of_a_file_is_in_the_coordinates_of_its_view_box(
    tmp_path: Path, head: str
) -> None:
    pytest.importorskip("svgelements")
    file = tmp_path / "loop.svg"
    file.write_text(
        f'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" {head}>'
        f'<g transform="scale(1 -1)"><path d="{LOOP}"/></g></svg>'
    )
    u = places(shapes.circle(), 11)
    truth = shapes.bezier_path(LOOP).point(u) * [1, -1]
    assert np.array_equal(shapes.bezier_path(file).point(u), truth)


def test_bezier_path_takes_percentages_of_the_view_box(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    file = tmp_path / "circle.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20" width="900" height="900">'
        '<circle cx="50%" cy="50%" r="3"/></svg>'
    )
    p = shapes.bezier_path(file).point(places(shapes.circle(), 50))
    assert np.allclose(np.hypot(*(p - [20, 10]).T), 3, rtol=1e-3)


def test_what_is_no_svg_and_no_path_is_named(tmp_path: Path) -> None:
    pytest.importorskip("svgelements")
    cut, page = tmp_path / "cut.svg", tmp_path / "page.svg"
    cut.write_text("<svg>")
    page.write_text("<html/>")
    for file, words in ((cut, "is no SVG"), (page, "outermost element is 'html'")):
        with pytest.raises(FormatError, match=words):
            shapes.bezier_path(file)
    with pytest.raises(FormatError, match="no such file"):
        shapes.bezier_path(tmp_path / "none.svg")
    for text in ("hello", "M 0 0 C 1 x", "curve.txt", "M 0 0 C nan 1 2 1 2 0 Z"):
        with pytest.raises(InputError, match="is neither the d of a path"):
            shapes.bezier_path(text)
    with pytest.raises(InputError, match="source is 5: give"):
        shapes.bezier_path(5)  # type: ignore[arg-type]


def test_bezier_path_makes_rounded_joints_smooth_and_refuses_corners() -> None:
    pytest.importorskip("svgelements")
    rounded = shapes.bezier_path("M 0 0 C 0.001 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z")
    assert np.allclose(rounded.tangent(0.0), rounded.tangent(np.nextafter(1, 0)))
    with pytest.raises(InputError, match="subpath 0 has a corner of 90"):
        shapes.bezier_path("M 0 0 H 1 V 1 H 0 Z")
    with pytest.raises(InputError, match="subpath 0 is open at"):
        shapes.bezier_path("M 0 0 C 0 1 1 1 2 0")
    with pytest.raises(InputError, match="holds no path"):
        shapes.bezier_path("M 0 0")


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: shapes.circle(0), "r must be positive"),
        (lambda: shapes.ellipse(1, float("nan")), "b must be positive"),
        (lambda: shapes.stadium(1, -1), "radius must be positive"),
        (lambda: shapes.trefoil(3, 1.0), "depth must be in"),
        (lambda: shapes.superformula(5, 2, 2, 2), "m must be an even"),
        (lambda: shapes.superformula(4, 2, 1, 2), "n2 must be at least 2"),
        (lambda: shapes.fourier([1.0]), "one besides the first"),
        (lambda: shapes.union(), "at least one loop"),
        (lambda: shapes.union(shapes.circle(), 3), "curve is 3, not a SmoothCurve"),
        (lambda: shapes.circle(1e300), r"r must be between 1e-60 and 1e\+60, not 1e\+300"),
        (lambda: shapes.circle(1e-300), r"r must be between .*, not 1e-300"),
        (lambda: shapes.circle(10**400), "r must be positive and finite, not 1000"),
        (lambda: shapes.circle("1"), "r must be positive and finite, not '1'"),
        (lambda: shapes.circle(True), "r must be positive and finite, not True"),
        (lambda: shapes.circle(None), "r must be positive and finite, not None"),
        (lambda: shapes.ellipse(np.inf, 1), "a must be positive and finite, not inf"),
        (lambda: shapes.stadium(1e-300, 1), "length must be between"),
        (lambda: shapes.trefoil(0), "lobes must be a whole number from 1 to 1000, not 0"),
        (lambda: shapes.trefoil(2.5), "lobes must be .*, not 2.5"),
        (lambda: shapes.trefoil(np.nan), "lobes must be .*, not nan"),
        (lambda: shapes.trefoil(10**9), "lobes must be .*, not 1000000000"),
        (lambda: shapes.trefoil(3, np.nan), "depth must be in .*, not nan"),
        (lambda: shapes.trefoil(3, 0.3, 1e300), "radius must be between"),
        (lambda: shapes.blob(1.5), "seed must be a whole number of at least 0, not 1.5"),
        (lambda: shapes.blob(-1), "seed must be a whole number of at least 0, not -1"),
        (lambda: shapes.blob("a"), "seed must be a whole number of at least 0, not 'a'"),
        (lambda: shapes.blob(True), "seed must be .*, not True"),
        (lambda: shapes.blob(1, harmonics=0), "harmonics must be .* from 1 to 1000, not 0"),
        (lambda: shapes.blob(1, roughness=np.nan), "roughness must be from 0 to 3, not nan"),
        (lambda: shapes.blob(1, roughness=1000), "roughness must be from 0 to 3, not 1000"),
        (lambda: shapes.blob(1, radius=1e300), "radius must be between"),
        (lambda: shapes.superformula(-4, 2, 2, 2), "m must be a whole number from 0"),
        (lambda: shapes.superformula(4, 0, 2, 2), "n1 must be positive"),
        (lambda: shapes.superformula(4, 2, np.inf, 2), "n2 must be at least 2"),
        (lambda: shapes.superformula(4, 2, 2, 2, a=1e-300), "a must be between"),
        (lambda: shapes.superformula(2, 1, 2000, 2000), "radius of this superformula is"),
        (lambda: shapes.fourier("ab"), "finite complex numbers"),
        (lambda: shapes.fourier([0, 1e300]), "largest coefficient must be between"),
        (lambda: shapes.fourier([1, 1e-300]), "besides the first must be between"),
        (lambda: shapes.spline([(0, 0), (1, np.nan), (1, 1)]), "row 1 has nan"),
        (lambda: shapes.spline([(0, 0), (1e300, 0), (0, 1e300)]), r"is 1e\+300 across"),
        (lambda: shapes.spline("abc"), "is not an array"),
        (lambda: shapes.bezier_path("M 0 0", smooth_joins=np.nan), "smooth_joins must be in"),
        (lambda: shapes.regular_polygon(2.5), "n must be a whole number from 0 to 100000000"),
        (lambda: shapes.regular_polygon(3, np.inf), "radius must be positive and finite"),
        (lambda: shapes.lattice(-1), "n must be a whole number from 0 to 100000000, not -1"),
        (lambda: shapes.lattice(2, 1.5), "m must be a whole number from 0 to 100000000, not 1.5"),
        (lambda: shapes.circle().moved(scale=1e300), "scale must be between"),
        (lambda: shapes.circle().moved(angle=np.inf), "angle must be a finite number, not inf"),
        (lambda: shapes.circle().moved(offset=3), "offset must be a pair of numbers"),
        (lambda: shapes.circle().moved(offset=(0, np.nan)), "offset must be a pair of numbers"),
        (lambda: shapes.circle().point(np.nan), "t must be finite, not nan"),
        (lambda: shapes.circle().medial_axis(rtol=0), "rtol must be in"),
    ],
)
def test_bad_input_is_named(make: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        make()  # type: ignore[operator]


def test_a_curve_moved_out_of_the_range_of_sizes_is_refused() -> None:
    huge = shapes.blob(1, radius=1e60).moved(scale=1e60)
    tiny = shapes.circle(1e-60).moved(scale=1e-60)
    lost = shapes.circle().moved(offset=(1e12, 0))
    for curve, words in ((huge, r"e\+120 across"), (tiny, "2e-120 across"), (lost, "shift it")):
        with pytest.raises(InputError, match=words):
            curve.local_feature_size(0.0)


def test_a_loop_that_is_not_finite_is_refused() -> None:
    def derivatives(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        point = np.full((len(u), 2), np.nan)
        return point, point, point

    with pytest.raises(InputError, match="point at u = 0 is not finite"):
        SmoothCurve((Loop(derivatives),)).medial_axis()


# Point sets.


def test_two_octagons_are_regular_and_two_pairs_make_a_square() -> None:
    points = shapes.two_octagons()
    side = 2 * np.sin(np.pi / 8)
    for octagon in (points[:8], points[8:]):
        assert np.allclose(np.hypot(*(octagon - np.roll(octagon, -1, axis=0)).T), side)
    square = points[[0, 7, 8, 15]]
    assert np.allclose(np.hypot(*(square - np.roll(square, -1, axis=0)).T), side)


def test_lattice_and_regular_polygon() -> None:
    assert shapes.lattice(4).shape == (16, 2)
    assert np.array_equal(shapes.lattice(3, 2), [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]])
    assert np.allclose(np.hypot(*shapes.regular_polygon(7, 3).T), 3)
