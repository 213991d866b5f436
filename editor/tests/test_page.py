"""The static page in a headless Chromium: drawing, dragging, comparing, files, reloads, faults."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pages import EXAMPLES, Editor

import crustline as cl

New = Callable[..., Editor]

CIRCLE = [(2 * math.cos(t), 2 * math.sin(t)) for t in np.arange(20) * math.pi / 10]


def draw(editor: Editor, points: list[tuple[float, float]] = CIRCLE) -> None:
    editor.use("draw")
    for x, y in points:
        editor.page.mouse.click(*editor.place(x, y))
    editor.settle()


def test_a_circle_of_points_is_one_ring(editor: Editor) -> None:
    draw(editor)
    assert editor.status.startswith("1 ring, 0 lines · 20 points")
    assert np.allclose(np.reshape(editor.points(), (-1, 2)), CIRCLE, atol=0.02)


def test_a_brushed_stroke_is_sampled_as_it_is_drawn(editor: Editor) -> None:
    editor.use("brush")
    editor.drag(editor.place(-3, 0), editor.place(3, 0.5))
    assert "0 rings, 1 line" in editor.status
    steps = np.linalg.norm(np.diff(np.reshape(editor.points(), (-1, 2)), axis=0), axis=1)
    assert len(steps) > 20
    assert np.allclose(steps, 0.14, rtol=1e-6)


def test_drag_undo_redo(editor: Editor) -> None:
    draw(editor)
    before = editor.points()
    editor.use("select")
    editor.drag(editor.place(2, 0), editor.place(3, 0.4))
    after = editor.points()
    assert np.flatnonzero(np.subtract(after, before)).tolist() == [0, 1]
    assert np.allclose(after[:2], [3, 0.4], atol=0.03)
    editor.act("undo")
    assert editor.points() == before
    editor.page.keyboard.press("Control+y")
    assert editor.points() == after
    for _ in range(21):
        editor.page.keyboard.press("Control+z")
    assert editor.points() == []


def test_a_box_selects_points_that_are_dragged_or_deleted_together(editor: Editor) -> None:
    draw(editor)
    editor.use("select")
    editor.drag(editor.place(0.1, -2.5), editor.place(2.5, 2.5))
    chosen = editor.app("[...app.chosen].sort((a, b) => a - b)")
    assert chosen == [0, 1, 2, 3, 4, 16, 17, 18, 19]
    editor.drag(editor.place(2, 0), editor.place(2.5, 0))
    assert np.allclose(editor.points()[:2], [2.5, 0], atol=0.03)
    editor.page.keyboard.press("Delete")
    editor.settle()
    assert "11 points" in editor.status


def test_jitter_thin_and_erase(editor: Editor) -> None:
    draw(editor)
    before = np.array(editor.points())
    editor.act("jitter")
    moved = np.abs(editor.points() - before)
    assert 0 < moved.max() <= 0.04
    editor.act("thin")
    assert "1 ring, 0 lines · 10 points" in editor.status
    editor.use("erase")
    editor.drag(editor.place(-2.5, 0), editor.place(2.5, 0))
    assert "8 points" in editor.status


def test_a_larger_beta_leaves_out_edges(editor: Editor) -> None:
    draw(editor)
    editor.page.select_option("[name=method]", "beta-skeleton")
    editor.settle()
    assert len(editor.edges()) == 40
    editor.page.get_by_label("β, as a number").fill("3")
    editor.page.keyboard.press("Tab")
    editor.wait("app.document.choice.parameters[0] === 3")
    editor.wait("app.answer.edges.length === 40")
    points = np.reshape(editor.points(), (-1, 2))
    assert editor.edges() == cl.beta_skeleton(points, 3).ravel().tolist()
    editor.page.click(".mark")
    assert editor.app("app.document.choice.parameters[0]") == cl.theory.BETA


def test_two_methods_are_compared(editor: Editor) -> None:
    editor.page.click(".menu:has-text('Examples') summary")
    editor.page.click("button:text('Two octagons')")
    editor.page.select_option("[name=method]", "crust")
    editor.page.select_option("[name=other]", "beta-skeleton")
    editor.wait_for_status("only here")
    assert "4 edges only here, 0 only in beta-skeleton" in editor.status
    octagons = cl.read(EXAMPLES / "two_octagons.csv")
    both = [set(map(tuple, method(octagons).tolist())) for method in (cl.crust, cl.beta_skeleton)]
    extra = editor.app("Array.from(app.answer.extra)")
    assert {tuple(edge) for edge in np.reshape(extra, (-1, 2)).tolist()} == both[0] - both[1]


def test_a_file_in_and_geojson_out_as_the_library_has_it(editor: Editor, tmp_path: Path) -> None:
    editor.load(EXAMPLES / "goose.csv")
    editor.wait_for_status("187 points")
    editor.settle()
    saved = json.loads(editor.save("Curves as GeoJSON"))
    cl.reconstruct(cl.read(EXAMPLES / "goose.csv")).write(tmp_path / "goose.geojson")
    assert saved == json.loads((tmp_path / "goose.geojson").read_text())
    csv = csv_of(cl.read(EXAMPLES / "goose.csv"), tmp_path)
    assert editor.save("Points as CSV").decode() == csv


def csv_of(points: cl.Points, folder: Path) -> str:
    points.write(folder / "points.csv")
    return (folder / "points.csv").read_text()


def test_python_lines_give_the_same_curves(editor: Editor) -> None:
    draw(editor)
    names: dict[str, cl.Curves] = {}
    exec(editor.save("Python lines").decode().replace("curves.plot()", ""), names)
    assert [curve.tolist() for curve in map(np.asarray, [names["curves"].indices])] == [
        editor.app("Array.from(app.answer.curves.indices)")
    ]


def test_pictures_are_files_of_their_kind(editor: Editor) -> None:
    draw(editor)
    assert editor.save("PNG").startswith(b"\x89PNG")
    svg = editor.save("SVG").decode()
    assert svg.startswith("<svg")
    assert svg.count("<circle") == 20
    state = json.loads(editor.save("Picture to edit again (.crustline)"))
    assert state["points"] == editor.points()


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("x,y\n1,2\n3,apple\n", "bad.csv, line 3: “apple” is no number."),
        ("x,y\n1,2\n3,inf\n", "bad.csv, line 3: “inf” is no number."),
        ("a,b\n1,2\n", "bad.csv has the columns a, b: name two of them x and y."),
        ("", "bad.csv holds no points."),
        ("\x00\x01\x02", "bad.csv is in no format that the page reads by itself"),
        ('{"type": "Banana"}', "bad.csv is JSON, but neither GeoJSON nor a list of points."),
        ('{"type":', "bad.csv is no JSON"),
        ("[[1, 2], [null, 3]]", "bad.csv: position 1 is [null,3], which is no pair of numbers."),
    ],
)
def test_bad_files_are_refused_in_a_sentence_and_nothing_is_lost(
    editor: Editor, tmp_path: Path, content: str, sentence: str
) -> None:
    draw(editor, CIRCLE[:3])
    before = editor.points()
    (tmp_path / "bad.csv").write_bytes(content.encode())
    editor.load(tmp_path / "bad.csv")
    assert sentence in editor.message
    assert editor.points() == before


def test_pasted_coordinates(editor: Editor) -> None:
    editor.act("paste")
    editor.page.fill("dialog textarea", "lat lon\n47.4 8.5\n46.9 7.4\n")
    editor.page.click("text=Take these points")
    editor.page.wait_for_selector("dialog", state="detached")
    assert editor.points() == [8.5, 47.4, 7.4, 46.9]


def test_work_survives_a_reload_and_tabs_do_not_mix(editor: Editor, static: str) -> None:
    draw(editor)
    editor.page.check("input[name=axis]")
    before = editor.ready().points()
    other = Editor(editor.page.context.new_page()).open(static)
    assert other.points() != before
    editor.page.reload()
    assert editor.ready().points() == before
    assert editor.page.is_checked("input[name=axis]")


def test_a_picture_can_be_shared_by_its_address(editor: Editor, new_editor: New) -> None:
    draw(editor)
    editor.page.select_option("[name=method]", "beta-skeleton")
    address = editor.page.evaluate("() => document.querySelector('.crustline').files.share()")
    other = new_editor().open(address)
    assert other.points() == editor.points()
    assert other.app("app.document.choice.method") == "beta-skeleton"


@pytest.mark.parametrize("fragment", ["#picture=AAAA", "#picture=%%%", "#picture="])
def test_a_damaged_address_is_said(new_editor: New, static: str, fragment: str) -> None:
    editor = new_editor()
    editor.page.goto(static + fragment)
    assert "damaged picture" in editor.message


def test_the_keyboard_draws_moves_and_deletes(editor: Editor) -> None:
    editor.page.focus(".stage")
    press = editor.page.keyboard.press
    press("a")
    press("Enter")
    for _ in range(5):
        press("ArrowRight")
    press("Enter")
    editor.settle()
    assert np.allclose(editor.points(), [0, 0, 0.6, 0])
    press("v")
    press("Enter")
    press("ArrowUp")
    assert np.allclose(editor.points(), [0, 0, 0.6, 0.02])
    press("Delete")
    assert np.allclose(editor.points(), [0, 0])


def test_touch_draws_and_two_fingers_zoom(new_editor: New, static: str) -> None:
    phone = {"width": 390, "height": 780}
    editor = new_editor(viewport=phone, has_touch=True, is_mobile=True).open(static)
    editor.act("new")
    editor.page.tap("[data-tool=draw]")
    box = editor.page.locator(".stage").bounding_box()
    assert box
    editor.page.touchscreen.tap(box["x"] + 100, box["y"] + 200)
    editor.settle()
    assert len(editor.points()) == 2
    before = editor.app("app.view.scale")
    pinch(editor, box["x"] + 190, box["y"] + 300)
    assert editor.app("app.view.scale") > 1.5 * before
    assert len(editor.points()) <= 4


def pinch(editor: Editor, x: float, y: float) -> None:
    session = editor.page.context.new_cdp_session(editor.page)
    for kind, spread in (("Start", 40), ("Move", 60), ("Move", 100), ("End", 0)):
        sides = (-spread, spread) if spread else ()
        fingers = [{"x": x + side, "y": y, "id": 1 + (side > 0)} for side in sides]
        event = {"type": f"touch{kind}", "touchPoints": fingers}
        session.send("Input.dispatchTouchEvent", event)


def test_an_edge_under_the_pointer_is_proven(editor: Editor) -> None:
    draw(editor)
    editor.use("select")
    editor.page.select_option("[name=method]", "crust")
    editor.settle()
    (ax, ay), (bx, by) = CIRCLE[0], CIRCLE[1]
    editor.page.mouse.move(*editor.place((ax + bx) / 2, (ay + by) / 2))
    editor.wait_for_status("Edge 0–1")
    assert "is in the crust: this disk holds no point and no Voronoi vertex" in editor.status
    editor.page.select_option("[name=method]", "beta-skeleton")
    editor.settle()
    editor.page.mouse.move(*editor.place(0, 0))
    editor.page.mouse.move(*editor.place((ax + bx) / 2, (ay + by) / 2))
    editor.wait_for_status("forbidden region")


def test_weak_places_are_listed_and_gone_to(editor: Editor) -> None:
    draw(editor, CIRCLE[:12])
    editor.page.check("input[name=weak]")
    editor.page.wait_for_selector(".finding h2")
    assert editor.page.inner_text(".finding h2").endswith("Not guaranteed")
    assert "2 endpoint" in editor.page.inner_text(".finding")
    editor.page.click("text=Go to the next weak place")
    assert len(editor.app("[...app.chosen]")) == 1


def test_dense_samples_are_guaranteed(editor: Editor) -> None:
    editor.page.fill("[name=r]", "0")
    editor.page.click("text=Take the sample")
    editor.page.check("input[name=weak]")
    editor.page.wait_for_selector(".finding h2")
    assert editor.page.inner_text(".finding h2").endswith("Guaranteed")
    assert "Not" not in editor.page.inner_text(".finding h2")


@pytest.mark.parametrize("figure", ["3", "6", "8", "11", "14"])
def test_figures_are_live_without_tools(new_editor: New, static: str, figure: str) -> None:
    editor = new_editor().open(f"{static}?figure={figure}")
    assert editor.page.inner_text("figcaption").startswith(f"Figure {figure}")
    assert not editor.page.query_selector(".tools")
    before = editor.edges()
    if figure != "6":
        value = "2.5" if figure in ("3", "11") else "15"
        editor.page.locator("figcaption input[type=range]").fill(value)
    else:
        x, y = editor.points()[:2]
        editor.drag(editor.place(x, y), editor.place(0, 0))
    editor.page.wait_for_timeout(300)
    editor.settle()
    assert editor.edges() != before


def test_an_unknown_figure_is_said(new_editor: New, static: str) -> None:
    editor = new_editor()
    editor.page.goto(f"{static}?figure=99")
    assert "There is no live figure “99”" in editor.page.inner_text("[role=alert]")


def test_a_browser_without_webassembly_is_told(new_editor: New, static: str) -> None:
    editor = new_editor()
    editor.page.add_init_script("delete window.WebAssembly")
    editor.page.goto(static)
    assert "has no WebAssembly" in editor.message


def test_collinear_repeated_and_single_points_are_no_trouble(editor: Editor) -> None:
    far, near = "1e300,0 -1e300,0 0,1e300", "1e-300,0 0,1e-300 0,0"
    for text in ("0,0", "0,0 0,0", "0,0 1,1 2,2", far, near):
        editor.act("paste")
        editor.page.fill("dialog textarea", text.replace(" ", "\n"))
        editor.page.click("text=Take these points")
        editor.page.wait_for_selector("dialog", state="detached")
        editor.settle()
        assert not editor.page.query_selector(".message")
