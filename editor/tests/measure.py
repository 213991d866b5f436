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

STEPS = 24
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


def drags(editor: Editor, method: str) -> float:
    """The median time from a move of the pointer to its picture, in milliseconds."""
    editor.page.select_option("[name=method]", method)
    editor.settle()
    editor.app("app.timings.splice(0)")
    x, y = editor.place(*editor.points()[:2])
    mouse = editor.page.mouse
    mouse.move(x, y)
    mouse.down()
    for step in range(STEPS):
        before = editor.app("app.timings.length")
        mouse.move(x + 3 * math.cos(step), y + 3 * math.sin(step))
        editor.wait(f"app.timings.length > {before}")
    mouse.up()
    editor.settle()
    timings: list[float] = editor.app("app.timings")
    return float(np.median(timings))


def measure(browser: Browser, address: str, count: int) -> tuple[float, float, float]:
    """Drags with the crust and with connect, in milliseconds, and frames a second."""
    editor = Editor(browser.new_page(viewport={"width": 1280, "height": 720})).open(address)
    editor.page.evaluate(FILL, count)
    editor.settle()
    gaps = editor.page.evaluate(FRAMES)
    editor.app("app.fit()")
    times = drags(editor, "crust"), drags(editor, "connect")
    editor.page.close()
    return *times, 1000 / float(np.mean(gaps))


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
        for count in (100, 1_000, 10_000, 200_000):
            crust, connect, frames = measure(
                browser, f"http://127.0.0.1:{server.server_port}/", count
            )
            print(f"| {count:,} | {crust:.0f} ms | {connect:.0f} ms | {frames:.0f} frames/s |")
        browser.close()
    server.shutdown()


if __name__ == "__main__":
    main()
