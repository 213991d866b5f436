"""The notebook's widget, in a real marimo notebook and in Python alone."""

from __future__ import annotations

import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser

import crustline as cl
from crustline.editor import widget

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
NOTEBOOK = f"""
import marimo
app = marimo.App(width="full")

@app.cell
def _():
    import marimo as mo
    import crustline as cl
    from crustline.editor import widget
    editor = mo.ui.anywidget(widget({SQUARE}, height=420))
    editor
    return cl, editor, mo

@app.cell
def _(editor, mo):
    editor.value
    mo.md(f"Python has {{len(editor.widget.points)}} points and {{editor.widget.curves!r}}")
    return

if __name__ == "__main__":
    app.run()
"""


@pytest.fixture
def notebook(tmp_path: Path) -> Iterator[str]:
    """The address of a marimo server that runs the notebook."""
    path = tmp_path / "notebook.py"
    path.write_text(NOTEBOOK)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "marimo", "-q", "run", str(path), "--headless", "--no-token"]
    server = subprocess.Popen([*command, "--host", "127.0.0.1", "--port", str(port)])
    address = f"http://127.0.0.1:{port}/"
    wait_for(address)
    yield address
    server.terminate()
    server.wait(20)


def wait_for(address: str) -> None:
    for _ in range(600):
        try:
            urllib.request.urlopen(address, timeout=5).close()
            return
        except OSError:
            time.sleep(0.1)
    raise TimeoutError(f"{address} does not answer")


def test_edits_in_a_notebook_come_back_as_points_and_curves(
    browser: Browser, notebook: str
) -> None:
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.goto(notebook)
    page.wait_for_selector(".crustline .stage", timeout=60_000)
    page.wait_for_selector("text=Python has 4 points", timeout=60_000)
    page.click("[data-tool=draw]")
    box = page.locator(".stage").bounding_box()
    assert box
    page.mouse.click(box["x"] + 30, box["y"] + 60)
    page.wait_for_selector("text=Python has 5 points", timeout=60_000)
    page.close()


def test_points_go_in_and_come_back_with_what_lies_beside_them() -> None:
    points = cl.Points(SQUARE, z=[1, 2, 3, 4], columns={"name": list("abcd")}, crs="EPSG:2056")
    editor = widget(points, method="crust")
    assert editor.points == points
    assert editor.curves == cl.reconstruct(points, method=cl.crust)
    moved = np.array([(0, 0), (2, 0), (2, 3)], "<f8")
    editor._xy, editor._rows = moved.tobytes(), np.array([0, 1, 2], "<i4").tobytes()
    assert editor.points.xy.tolist() == moved.tolist()
    assert editor.points.columns["name"].tolist() == list("abc")
    assert editor.points.crs == "EPSG:2056"


def test_parameters_of_the_page_are_those_of_the_curves() -> None:
    editor = widget(SQUARE, method="beta-skeleton")
    editor.parameters = [3, 0]
    assert editor.curves == cl.reconstruct(SQUARE, method=cl.beta_skeleton, beta=3)


def test_curves_have_an_editor() -> None:
    editor = cl.reconstruct(SQUARE).edit(height=300)
    assert editor.height == 300
    assert len(editor.curves) == 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"points": [(0, float("nan"))]}, "row 0"),
        ({"method": "nonsense"}, "method"),
        ({"height": 3}, "height"),
    ],
)
def test_what_cannot_be_is_refused(arguments: dict[str, object], words: str) -> None:
    with pytest.raises(cl.InputError, match=words):
        widget(**arguments)
