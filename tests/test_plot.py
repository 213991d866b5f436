"""Pictures, read back from the artists: what is drawn is what was asked for, in the right place."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from numpy.typing import NDArray

pytest.importorskip("matplotlib", reason="the extra crustline[plot] is not installed")

from matplotlib.collections import PathCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from crustline import plot
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay
from crustline.errors import InputError, MissingExtraError
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.methods import crust
from crustline.path import Path as Path_
from crustline.plot.axes import CHUNK
from crustline.plot.certificate import MARKERS
from crustline.plot.crowd import one_per_spot, thinned
from crustline.plot.picture import SUFFIXES
from crustline.points import Points
from crustline.reconstruction import Reconstruction

Floats = NDArray[np.float64]
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def ring(n: int, radius: float = 1.0) -> Floats:
    t = np.arange(n) * (2 * math.pi / n)
    return radius * np.column_stack([np.cos(t), np.sin(t)])


def figures() -> Floats:
    """Return a ring of 30, a polyline of 10 and a single point."""
    x = np.linspace(2, 3, 10)
    return np.concatenate([ring(30), np.column_stack([x, 0.1 * x]), [[2.5, 3.0]]])


def drawn(ax: Any, color: str) -> Floats:
    """Return the segments of one color, shape (m, 2, 2)."""
    found = [np.zeros((0, 2, 2))]
    for lines in ax.collections:
        if (
            not isinstance(lines, PathCollection)
            or to_hex(lines.get_edgecolor()[0]) != color.lower()
        ):
            continue
        for outline in cast(list[Any], lines.get_paths()):
            joined = np.flatnonzero(outline.codes[1:] == outline.LINETO)
            found.append(np.stack([outline.vertices[joined], outline.vertices[joined + 1]], axis=1))
    return np.concatenate(found)


def as_rows(segments: Floats, points: Floats) -> set[tuple[int, ...]]:
    """Return segments as sorted pairs of rows of the points."""
    distance = np.linalg.norm(segments[:, :, None] - points, axis=3)
    assert np.all(distance.min(axis=2) == 0)
    return {tuple(sorted(pair)) for pair in distance.argmin(axis=2).tolist()}


def medial_axis_of_a_cross() -> MedialAxis:
    vertices = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 3.0], [50.0, 0.0]])
    return replace(
        medial_axis([]),
        vertices=vertices,
        edges=np.array([[0, 1], [0, 2]]),
        inner=np.array([True, False]),
        ray_origins=np.array([1]),
        ray_directions=np.array([[1.0, 1.0]]),
    )


def certificate_of_a_square(reason: str) -> Any:
    return SimpleNamespace(
        points=SQUARE,
        edges=np.array([[0, 1], [1, 2], [2, 3]]),
        weak=np.array([1]),
        guaranteed=False,
        point_reason=np.array(["", reason, "", ""]),
    )


DRAWINGS: dict[str, Callable[..., Any]] = {
    "points": lambda **given: plot.plot_points(SQUARE, **given),
    "indices": lambda **given: plot.plot_indices(SQUARE, **given),
    "edges": lambda **given: plot.plot_edges(SQUARE, [(0, 1)], **given),
    "curves": lambda **given: plot.plot_curves(trace(SQUARE, crust(SQUARE)), **given),
    "delaunay": lambda **given: plot.plot_delaunay(Delaunay(SQUARE), **given),
    "voronoi": lambda **given: plot.plot_voronoi(Delaunay(SQUARE), **given),
    "medial axis": lambda **given: plot.plot_medial_axis(medial_axis_of_a_cross(), **given),
    "certificate": lambda **given: plot.plot_certificate(
        certificate_of_a_square("corner"), **given
    ),
    "lfs": lambda **given: plot.plot_local_feature_size(SQUARE, [1, 2, 3, 4], **given),
}


@pytest.mark.parametrize("draw", DRAWINGS.values(), ids=DRAWINGS.keys())
def test_drawings_return_the_axes_given_or_new_ones_of_equal_aspect(
    draw: Callable[..., Any],
) -> None:
    one, other = Figure().subplots(1, 2, sharex=True, sharey=True)
    assert draw(ax=one) is one
    new = draw()
    assert new is not one
    assert one.get_aspect() == new.get_aspect() == 1
    for ax in (one, new):
        ax.figure.canvas.draw()
    other.set_aspect(3)
    assert draw(ax=other).get_aspect() == 3


def test_no_window_and_no_global_figure_is_made() -> None:
    code = (
        "import sys; from crustline import plot; plot.plot_points([(0, 0)]).figure.canvas.draw();"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_curves_draw_every_edge_once_in_the_color_of_its_kind() -> None:
    points = figures()
    edges = np.array([[k, (k + 1) % 30] for k in range(30)] + [[k, k + 1] for k in range(30, 39)])
    edges = np.sort(edges, axis=1)
    edges = edges[np.lexsort(edges.T[::-1])]
    ax = plot.plot_curves(trace(points, edges))
    rings, polylines = drawn(ax, plot.BLUE), drawn(ax, plot.VERMILLION)
    assert (len(rings), len(polylines)) == (30, 9)
    both = as_rows(rings, points) | as_rows(polylines, points)
    assert both == {tuple(edge) for edge in edges.tolist()}
    assert ax.get_legend_handles_labels()[1] == ["ring", "polyline", "isolated point"]
    assert ax.lines[-1].get_xydata().tolist() == [[2.5, 3.0]]


def test_long_curves_are_drawn_in_pieces_without_a_gap() -> None:
    n = 2 * CHUNK + 7
    points = ring(n)
    curves = Curves(
        Points(points), np.arange(n), np.array([0, n]), np.array([True]), np.zeros(0, np.int64)
    )
    segments = drawn(plot.plot_curves(curves, points=False), plot.BLUE)
    np.testing.assert_array_equal(segments[:, 0], points)
    np.testing.assert_array_equal(segments[:, 1], np.roll(points, -1, axis=0))


def test_a_million_edges_are_a_hundred_paths() -> None:
    m = 1_000_000
    points = np.random.default_rng(5).random((m, 2))
    edges = np.stack([np.arange(m), np.roll(np.arange(m), 1)], axis=1)
    ax = plot.plot_edges(points, edges)
    assert len(ax.collections[0].get_paths()) == 2 * m / CHUNK
    assert len(drawn(ax, plot.BLUE)) == m


def test_delaunay_draws_its_edges() -> None:
    points = np.random.default_rng(1).random((40, 2))
    delaunay = Delaunay(points)
    segments = drawn(plot.plot_delaunay(delaunay), plot.GRAY)
    assert len(segments) == len(delaunay.edges)
    assert as_rows(segments, points) == {tuple(edge) for edge in delaunay.edges.tolist()}


@pytest.mark.parametrize(
    "points",
    [np.random.default_rng(2).random((40, 2)), np.array([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]])],
    ids=["general", "collinear"],
)
def test_voronoi_edges_have_two_nearest_points(points: Floats) -> None:
    segments = drawn(plot.plot_voronoi(Delaunay(points)), plot.ORANGE)
    assert len(segments) > 0
    for t in (0.01, 0.3, 0.7, 0.99):
        places = (1 - t) * segments[:, 0] + t * segments[:, 1]
        distance = np.sort(np.linalg.norm(places[:, None] - points, axis=2), axis=1)
        np.testing.assert_allclose(distance[:, 0], distance[:, 1], rtol=1e-9)


def test_far_away_voronoi_vertices_do_not_change_the_view() -> None:
    points = np.array([[0.0, 0.0], [1.0, 1e-12], [2.0, 0.0], [1.0, 0.5]])
    ax = plot.plot_voronoi(Delaunay(points))
    assert np.abs(drawn(ax, plot.ORANGE)).max() < 10
    assert -1 < ax.get_xlim()[0] < ax.get_xlim()[1] < 3


def test_medial_axis_tells_inner_from_outer_and_cuts_its_rays() -> None:
    ax = Figure().add_subplot()
    plot.plot_points([(-1, -1), (3, 3)], ax)
    view = ax.get_xlim()
    plot.plot_medial_axis(medial_axis_of_a_cross(), ax)
    assert ax.get_xlim() == view
    assert drawn(ax, plot.GREEN).tolist() == [[[0, 0], [1, 0]]]
    outside = drawn(ax, plot.PURPLE)
    assert outside[0].tolist() == [[0, 0], [0, 3]]
    start, end = outside[1]
    assert start.tolist() == [1, 0]
    np.testing.assert_allclose(end[0] - 1, end[1])
    assert end[0] > view[1]
    inner = plot.plot_medial_axis(medial_axis_of_a_cross(), outer=False)
    assert len(drawn(inner, plot.PURPLE)) == 0


@pytest.mark.parametrize("reason", MARKERS)
def test_certificate_shows_weak_edges_and_reasons(reason: str) -> None:
    ax = plot.plot_certificate(certificate_of_a_square(reason))
    assert as_rows(drawn(ax, plot.BLUE), SQUARE) == {(0, 1), (2, 3)}
    assert as_rows(drawn(ax, plot.VERMILLION), SQUARE) == {(1, 2)}
    mark = next(line for line in ax.lines if line.get_label() == reason)
    assert mark.get_marker() == MARKERS[reason]
    assert mark.get_xydata().tolist() == [[1, 0]]
    assert ax.get_title("left") == "not guaranteed"


def test_local_feature_size_is_gray_where_there_is_none() -> None:
    ax = plot.plot_local_feature_size(SQUARE, [1.0, math.nan, math.inf, 100.0])
    unknown, known = ax.collections[:2]
    assert unknown.get_offsets().tolist() == SQUARE[[1, 2]].tolist()
    assert known.get_array().tolist() == [1, 100]
    plot.plot_local_feature_size(SQUARE, [2.0] * 4).figure.canvas.draw()
    plot.plot_local_feature_size(SQUARE, [math.nan] * 4).figure.canvas.draw()


def test_indices_are_rows_beside_their_points() -> None:
    ax: Any = plot.plot_points(SQUARE, indices=True)
    assert [(text.get_text(), list(text.xy)) for text in ax.texts] == [
        (str(row), place) for row, place in enumerate(SQUARE.tolist())
    ]


def test_of_many_indices_only_those_with_room_are_written() -> None:
    """Thousands of labels took half a minute, and were a smear."""
    points = np.random.default_rng(0).random((5000, 2))
    ax: Any = plot.plot_indices(points)
    *labels, note = ax.texts
    assert 300 < len(labels) <= 23 * 51
    places = np.array([label.xy for label in labels]) * (22, 50)
    apart = np.abs(places[:, None] - places).max(axis=2) + 9 * np.eye(len(places))
    assert apart.min() > 0.99
    assert note.get_text() == f"{len(labels):,} of 5,000 rows are written"
    rows = [int(label.get_text()) for label in labels]
    assert np.array_equal([label.xy for label in labels], points[rows])


def test_feature_sizes_are_above_the_black_points() -> None:
    ax: Any = plot.plot_local_feature_size(
        SQUARE, [1.0, 2.0, 3.0, math.nan], plot.plot_points(SQUARE)
    )
    assert min(dots.get_zorder() for dots in ax.collections) > ax.lines[0].get_zorder()


def test_coordinates_far_from_the_origin_are_written_in_full() -> None:
    ax: Any = plot.plot_points(SQUARE + np.array([500_000, 6_000_000]))
    ax.figure.canvas.draw()
    assert ax.yaxis.get_offset_text().get_text() == ""
    assert any(text.get_text().startswith("60000") for text in ax.get_yticklabels())


# --- Crowds -------------------------------------------------------------------------------------


def wave(n: int) -> Floats:
    x = np.linspace(0, 10, n)
    return np.column_stack([x, np.sin(x)])


def test_a_crowd_is_drawn_once_on_each_spot() -> None:
    points = wave(1_000_000)
    ax: Any = plot.plot_points(points)
    dots = np.column_stack(ax.lines[0].get_data())
    assert len(dots) < 40_000
    path = thinned(Path_.through(points))
    assert len(path) < 40_000
    assert np.array_equal(path.vertices[[0, -1]], points[[0, -1]])
    spot = 10 / 2**14
    for near in (dots, path.vertices):
        rows = np.searchsorted(near[:, 0], points[:, 0]).clip(max=len(near) - 1)
        assert np.abs(near[rows] - points).max() < 2 * spot


@pytest.mark.parametrize("suffix", [".svg", ".pdf"])
def test_a_crowd_is_an_image_in_vector_formats(tmp_path, suffix) -> None:
    points = np.random.default_rng(6).random((120_000, 2))
    plot.picture(points, tmp_path / f"crowd{suffix}", show=["points"])
    plot.picture(points[:1000], tmp_path / f"few{suffix}", show=["points"])
    crowd, few = ((tmp_path / f"{name}{suffix}").read_bytes() for name in ("crowd", "few"))
    assert len(crowd) < 2_000_000
    mark = {".svg": b"<image", ".pdf": b"/Subtype /Image"}[suffix]
    assert mark in crowd
    assert mark not in few


def test_too_many_dots_are_drawn_on_fewer_spots() -> None:
    points = np.random.default_rng(6).random((2_000_000, 2))
    kept = one_per_spot(points)
    assert 1_000_000 < len(kept) < 1_800_000
    # Of a picture of 1,000 pixels hardly one is lost that has a point.
    pixels = [np.unique((each * 1000).astype(int) @ (1000, 1)) for each in (points, points[kept])]
    assert len(pixels[1]) > 0.97 * len(pixels[0])


def test_a_crowd_of_segments_keeps_one_of_a_kind() -> None:
    grid = np.random.default_rng(1).integers(0, 100, (200_000, 2, 2)).astype(float)
    path = thinned(Path_.through_all(grid.reshape(-1, 2), np.arange(0, 400_000, 2)))
    kinds = {tuple(sorted(map(tuple, pair))) for pair in grid.tolist()}
    drawn = path.vertices.reshape(-1, 2, 2).tolist()
    assert {tuple(sorted(map(tuple, pair))) for pair in drawn} == kinds
    assert len(drawn) == len(kinds)


def test_no_crowd_is_drawn_as_it_is() -> None:
    path = Path_.through(wave(9000), closed=True)
    assert thinned(path) is path
    assert np.array_equal(one_per_spot(np.zeros((9, 2))), np.arange(9))


def test_the_least_feature_size_of_a_spot_is_shown() -> None:
    points, sizes = np.repeat(wave(1000), 200, axis=0), np.tile(np.arange(200.0, 0, -1), 1000)
    ax: Any = plot.plot_local_feature_size(points, sizes)
    assert set(ax.collections[1].get_array()) == {1.0}


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_picture_writes_the_same_bytes_again(suffix: str, tmp_path: Path) -> None:
    first, again = tmp_path / f"first{suffix}", tmp_path / f"again{suffix}"
    for path in (first, again):
        plot.picture(figures(), path, show=["points", "curves", "voronoi"])
    assert first.read_bytes() == again.read_bytes()
    assert len(first.read_bytes()) > 1000


def test_picture_ignores_the_order_of_show_and_the_settings_of_the_user(tmp_path: Path) -> None:
    from matplotlib import rc_context

    first, again = tmp_path / "first.svg", tmp_path / "again.svg"
    plot.picture(figures(), first, show=["points", "delaunay"])
    with rc_context({"axes.facecolor": "red", "lines.linewidth": 9, "figure.figsize": (1, 1)}):
        plot.picture(figures(), again, show=["delaunay", "points"])
    assert first.read_text("utf-8") == again.read_text("utf-8")


@pytest.mark.parametrize("layer", plot.LAYERS)
def test_picture_shows_each_layer(layer: str, tmp_path: Path) -> None:
    empty, path = tmp_path / "empty.svg", tmp_path / "layer.svg"
    plot.picture(figures(), empty, show=[])
    plot.picture(figures(), path, show=[layer])
    assert len(path.read_text("utf-8")) > len(empty.read_text("utf-8")) + 500


@pytest.mark.parametrize("n", [0, 1, 2])
def test_picture_of_hardly_any_points(n: int, tmp_path: Path) -> None:
    plot.picture(SQUARE[:n], tmp_path / "few.svg", show=["points", "curves", "delaunay", "voronoi"])
    assert (tmp_path / "few.svg").exists()


def test_picture_uses_the_method_given(tmp_path: Path) -> None:
    seen = []

    def method(points: Any) -> Any:
        seen.append(points)
        return crust(points)

    plot.picture(Reconstruction(SQUARE, method), tmp_path / "square.svg")
    assert len(seen) == 1


def test_picture_names_what_it_does_not_know(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"unknown suffix of a picture '\.gif': use one of \.png"):
        plot.picture(SQUARE, tmp_path / "square.gif")
    with pytest.raises(InputError, match="unknown layer of a picture 'hull': use one of delaunay"):
        plot.picture(SQUARE, tmp_path / "square.png", show=["hull"])
    assert not list(tmp_path.iterdir())


def test_missing_matplotlib_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'crustline\[plot\]'"):
        plot.plot_points(SQUARE)
