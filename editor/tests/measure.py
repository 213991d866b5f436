"""How long it takes from a drag to its picture, and how many frames pan and zoom have.

`python editor/tests/measure.py` prints the table of docs/editor.md.
"""

from __future__ import annotations

import functools
import http.server
import math
import os
import shutil
import threading

import numpy as np
from pages import BUILT, Editor
from playwright.sync_api import Browser, sync_playwright

STEPS = 10
FILL = """(count) => {
    const app = document.querySelector('.crustline').app;
    const xy = new Float64Array(2 * count);
    for (let k = 0; k < count; k += 1) {
        const t = (2 * Math.PI * k) / count;
        const r = 1 + 0.3 * Math.cos(7 * t) + 0.02 * Math.cos(200 * t);
        xy[2 * k] = r * Math.cos(t);
        xy[2 * k + 1] = r * Math.sin(t);
    }
    app.take({ xy, rows: new Int32Array(count).fill(-1) });
}"""
FRAMES = """() => new Promise((settle) => {
    const app = document.querySelector('.crustline').app;
    const gaps = [];
    let last = performance.now();
    const step = (now) => {
        gaps.push(now - last);
        last = now;
        if (gaps.length > 60) return settle(gaps.slice(1));
        if (gaps.length % 2) app.pan(3, 2);
        else app.zoom(1.01, 300, 300);
        requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
})"""


def drags(editor: Editor, method: str) -> tuple[float, float, float]:
    """The median time from a move to its picture; the least of the engine and of drawing, in ms."""
    editor.page.select_option("[name=method]", method)
    editor.settle()
    editor.app("app.timings.splice(0)")
    x, y = editor.place(*editor.points()[:2])
    mouse = editor.page.mouse
    mouse.move(x, y)
    mouse.down()
    engine, drawing = [], []
    for step in range(STEPS):
        before = editor.app("app.timings.length")
        mouse.move(x + 3 * math.cos(step), y + 3 * math.sin(step))
        editor.wait(f"app.timings.length > {before}")
        engine.append(editor.app("app.answer.milliseconds"))
        drawing.append(editor.app("app.stage.cost"))
    mouse.up()
    editor.settle()
    return float(np.median(editor.app("app.timings"))), min(engine), min(drawing)


def measure(browser: Browser, address: str, count: int) -> str:
    """A row of the table."""
    editor = Editor(browser.new_page(viewport={"width": 1280, "height": 720})).open(address)
    editor.page.evaluate(FILL, count)
    editor.settle()
    gaps = editor.page.evaluate(FRAMES)
    editor.app("app.fit()")
    cells = [f"{count:,}"]
    for method in ("crust", "connect"):
        picture, engine, drawing = drags(editor, method)
        cells.append(f"{picture:.0f} ms ({engine:.0f} + {drawing:.0f})")
    editor.page.close()
    cells.append(f"{1000 / float(np.mean(gaps)):.0f} frames/s")
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Print the table."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=BUILT / "page")
    handler.log_message = lambda *about: None  # type: ignore[attr-defined]
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        print(f"Chromium {browser.version}, headless, drawing in software")
        print("| points | a drag, crust | a drag, connect | pan and zoom |\n|---|---|---|---|")
        for count in (1_000, 10_000, 200_000):
            print(measure(browser, f"http://127.0.0.1:{server.server_port}/", count), flush=True)
        browser.close()
    server.shutdown()


if __name__ == "__main__":
    main()
