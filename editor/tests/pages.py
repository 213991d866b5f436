"""A page with the editor, and `crustline edit` as a process of its own, as tests use them."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import Page

ROOT = Path(__file__).parents[2]
BUILT = ROOT / "editor" / "build"
EXAMPLES = ROOT / "examples"

PATIENCE_SECONDS = 30

_WITH_APP = """(() => {
    const element = document.querySelector('.crustline');
    const app = element?.app;
    return %s;
})()"""


class Editor:
    """A page with the editor, and what tests do to it."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.faults: list[str] = []
        self.hosts: set[str] = set()
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        page.on("request", lambda request: self.hosts.add(urlsplit(request.url).netloc))

    def open(self, url: str) -> Editor:
        self.page.goto(url)
        return self.ready()

    def ready(self) -> Editor:
        """Wait until the picture is of the points as they are, and kept."""
        self.page.wait_for_selector(".crustline[data-busy=false]")
        self.wait("element.dataset.kept !== 'false'")
        return self

    def app(self, expression: str) -> Any:
        """Evaluate JavaScript with `app`, and its `element`."""
        return self.page.evaluate(_WITH_APP % expression)

    def wait(self, condition: str) -> None:
        """Wait until JavaScript with `app`, and its `element`, is true."""
        # Playwright's own waiting needs eval, which the served page forbids.
        end = time.monotonic() + PATIENCE_SECONDS
        while not self.app(condition):
            assert time.monotonic() < end, f"still not so: {condition}"
            time.sleep(0.02)

    def wait_for_status(self, words: str) -> None:
        self.wait(f"document.querySelector('.status').textContent.includes({words!r})")

    @property
    def status(self) -> str:
        return self.ready().page.inner_text(".status")

    @property
    def message(self) -> str:
        self.page.wait_for_selector(".message")
        return self.page.inner_text(".message span")

    def points(self) -> list[float]:
        return self.app("Array.from(app.cloud.xy)")

    def edges(self) -> list[int]:
        self.ready()
        return self.app("Array.from(app.answer.edges)")

    def use(self, tool: str) -> None:
        self.page.click(f"[data-tool={tool}]")

    def act(self, action: str) -> None:
        self.page.click(f"[data-action={action}]")
        self.settle()

    def settle(self) -> None:
        """Wait until what was just done has been asked and answered."""
        self.wait(
            "element.dataset.busy === 'false' && Number(element.dataset.version) === app.version"
        )

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a place of the plane is on the page."""
        box = self.page.locator(".stage").bounding_box()
        assert box
        view = self.app("app.view")
        return (
            box["x"] + (x - view["x"]) * view["scale"] + view["width"] / 2,
            box["y"] + (view["y"] - y) * view["scale"] + view["height"] / 2,
        )

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        mouse.move(*end)
        mouse.up()
        self.settle()

    def load(self, path: Path) -> None:
        with self.page.expect_file_chooser() as chooser:
            self.page.click("[data-action=open]")
        chooser.value.set_files(path)

    def save(self, title: str) -> bytes:
        self.page.click(".menu:has-text('Save') summary")
        with self.page.expect_download() as download:
            self.page.click(f".menu button:text-is('{title}')")
        return Path(download.value.path()).read_bytes()


class Served:
    """`crustline edit` as a process."""

    def __init__(self, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "crustline", "edit", "--no-browser", *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        assert self.process.stdout
        self.address = self.process.stdout.readline().strip()

    @property
    def base(self) -> str:
        return self.address.partition("?")[0]

    @property
    def token(self) -> str:
        return self.address.partition("token=")[2]

    def stop(self) -> None:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.process.communicate(timeout=20)
