"""A headless Chromium, the static page, and the served one."""

from __future__ import annotations

import functools
import http.server
import os
import shutil
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from pages import BUILT, Editor, Served
from playwright.sync_api import Browser, sync_playwright


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    assert path, "install chromium, or set CHROMIUM to where it is"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield browser
        browser.close()


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *about: object) -> None:
        pass


@pytest.fixture(scope="session")
def static() -> Iterator[str]:
    """The address of the static page, as `python -m http.server` serves it."""
    handler = functools.partial(Quiet, directory=BUILT / "page")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def new_editor(browser: Browser) -> Iterator[Callable[..., Editor]]:
    """Makes pages, each in a profile of its own; at the end none may have thrown anything."""
    made: list[Editor] = []

    def make(**options: Any) -> Editor:
        settings: dict[str, Any] = {"viewport": {"width": 1280, "height": 720}}
        editor = Editor(browser.new_context(**(settings | options)).new_page())
        editor.page.set_default_timeout(30_000)
        made.append(editor)
        return editor

    yield make
    for editor in made:
        editor.page.context.close()
        assert not editor.faults
        assert all(host.startswith("127.0.0.1:") or not host for host in editor.hosts)


@pytest.fixture
def editor(new_editor: Callable[..., Editor], static: str) -> Editor:
    """The static page, without points."""
    editor = new_editor().open(static)
    editor.act("new")
    editor.app("app.stage.look({...app.view, x: 0, y: 0, scale: 100})")
    return editor


@pytest.fixture
def serve() -> Iterator[Callable[..., Served]]:
    started: list[Served] = []

    def start(*arguments: str) -> Served:
        served = Served(*arguments)
        started.append(served)
        return served

    yield start
    for served in started:
        served.stop()
