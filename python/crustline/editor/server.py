"""The server of `crustline edit`: the page, files in and out, and whether a tab is still there.

It listens on the loopback address alone. Every request needs the token of the address that the
command prints, a Host that is this server, and an Origin, if there is one, that is this server; no
path that a page sends is ever opened.
"""

from __future__ import annotations

import asyncio
import hmac
import json
import secrets
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from pathlib import PurePath
from typing import TYPE_CHECKING
from urllib.parse import quote

from crustline.editor.desk import Desk, as_order, formats_for
from crustline.editor.page import built
from crustline.errors import CrustlineError
from crustline.formats.catalog import suffixes_for
from crustline.points import Points

if TYPE_CHECKING:
    from starlette.applications import Starlette
    from starlette.requests import Request
    from starlette.responses import Response

#: How long the server waits for a tab to come back, as it does when it is loaded again.
GRACE_SECONDS = 2.5
#: How often a tab is sent something, so that its end is noticed.
BEAT_SECONDS = 10.0

HEADERS = {
    "content-security-policy": "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; "
    "worker-src blob:; style-src 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}


@dataclass
class Site:
    """What the server is and has.

    Attributes
    ----------
    port : int
        Where it listens.
    limit : int
        The most bytes of an upload.
    first : tuple of str and Points, optional
        The name of the file that pages begin with, and what it holds.
    token : str
        What every request must carry.
    ended : asyncio.Event
        Set when the last tab has been closed.
    """

    port: int
    limit: int
    first: tuple[str, Points] | None = None
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    desk: Desk = field(default_factory=Desk)
    ended: asyncio.Event = field(default_factory=asyncio.Event)
    tabs: int = 0

    @property
    def address(self) -> str:
        """What to open in a browser."""
        return f"http://127.0.0.1:{self.port}/?token={self.token}"

    def refusal(self, request: Request) -> str | None:
        """Return why a request is not answered, or None."""
        hosts = [f"{name}:{self.port}" for name in ("127.0.0.1", "localhost")]
        if request.headers.get("host") not in hosts:
            return "This is not the host that crustline edit serves: open the address it printed."
        origin = request.headers.get("origin")
        if origin is not None and origin not in [f"http://{host}" for host in hosts]:
            return "Another page may not use crustline edit: open the address it printed."
        given = request.headers.get("x-token") or request.query_params.get("token", "")
        if not hmac.compare_digest(given.encode(), self.token.encode()):
            return "The token is missing or wrong: open the address that crustline edit printed."
        return None

    async def tab(self) -> AsyncIterator[bytes]:
        """Send a beat as long as a tab is there; when the last one has gone, end."""
        self.tabs += 1
        try:
            while True:
                yield b"\n"
                await asyncio.sleep(BEAT_SECONDS)
        finally:
            self.tabs -= 1
            asyncio.get_running_loop().call_later(GRACE_SECONDS, self._end_if_empty)

    def _end_if_empty(self) -> None:
        if self.tabs == 0:
            self.ended.set()


class Pages:
    """The answers of a site."""

    def __init__(self, site: Site) -> None:
        self.site = site

    async def page(self, request: Request) -> Response:
        """The page, whose script has the token in its address, too."""
        html = built("index.html").read_text(encoding="utf-8")
        html = html.replace('src="editor.js"', f'src="editor.js?token={self.site.token}"')
        return _response(html, "text/html")

    async def script(self, request: Request) -> Response:
        """The front end."""
        return _response(built("editor.js").read_bytes(), "text/javascript")

    async def configuration(self, request: Request) -> Response:
        """What the library reads and writes, and what the page begins with."""
        about = {
            "read": suffixes_for("read"),
            "write": {what: formats_for(what) for what in ("points", "curves")},
            "limit": self.site.limit,
            "first": self.site.first and self.site.first[0],
        }
        return _response(json.dumps(about), "application/json")

    async def open_file(self, request: Request) -> Response:
        """The points of an upload; its name tells the format, and is no path."""
        from starlette.concurrency import run_in_threadpool

        name = PurePath(request.query_params.get("name", "")).name or "the file"
        content = await _content(request, self.site.limit)
        return _points(*await run_in_threadpool(self.site.desk.open, content, name))

    async def first(self, request: Request) -> Response:
        """The points of the file that the command was given."""
        if self.site.first is None:
            raise CrustlineError("crustline edit was started without a file")
        return _points(*self.site.desk.keep(self.site.first[1]))

    async def save(self, request: Request) -> Response:
        """A file of points or curves."""
        from starlette.concurrency import run_in_threadpool

        order = as_order(await _content(request, self.site.limit))
        name, content, warning = await run_in_threadpool(self.site.desk.save, order)
        about = {"x-name": name, "x-warning": quote(warning)}
        return _response(content, "application/octet-stream", about)

    async def tab(self, request: Request) -> Response:
        """An answer that does not end before the tab does."""
        from starlette.responses import StreamingResponse

        return StreamingResponse(self.site.tab(), 200, HEADERS, "text/plain")


def application(site: Site) -> Starlette:
    """Return the ASGI application of a site."""
    from starlette.applications import Starlette
    from starlette.routing import Route

    pages = Pages(site)
    answers = {
        "/": pages.page,
        "/editor.js": pages.script,
        "/api/configuration": pages.configuration,
        "/api/first": pages.first,
        "/api/tab": pages.tab,
    }
    posts = {"/api/open": pages.open_file, "/api/save": pages.save}
    routes = [Route(path, _guarded(site, answer)) for path, answer in answers.items()]
    routes += [
        Route(path, _guarded(site, answer), methods=["POST"]) for path, answer in posts.items()
    ]
    return Starlette(routes=routes)


Answer = Callable[["Request"], Awaitable["Response"]]


def _guarded(site: Site, answer: Answer) -> Answer:
    """Return what refuses strangers, and answers faults with a sentence."""

    async def endpoint(request: Request) -> Response:
        refusal = site.refusal(request)
        if refusal:
            return _response(refusal, "text/plain", status=403)
        try:
            return await answer(request)
        except _TooLargeError as error:
            return _response(str(error), "text/plain", {"connection": "close"}, 413)
        except (CrustlineError, MemoryError) as error:
            return _response(f"{error}.", "text/plain", status=422)

    return endpoint


def _response(
    content: bytes | str, kind: str, about: Mapping[str, str] | None = None, status: int = 200
) -> Response:
    from starlette.responses import Response

    return Response(content, status, HEADERS | dict(about or {}), kind)


class _TooLargeError(Exception):
    """An upload is larger than allowed."""


async def _content(request: Request, limit: int) -> bytes:
    """Return the body of a request, and stop reading when it is too large."""
    message = (
        f"The file is larger than the {limit / 2**20:g} MB allowed: "
        "start crustline edit with --limit."
    )
    if int(request.headers.get("content-length") or 0) > limit:
        raise _TooLargeError(message)
    parts, size = [], 0
    async for part in request.stream():
        size += len(part)
        if size > limit:
            raise _TooLargeError(message)
        parts.append(part)
    return b"".join(parts)


def _points(document: str, points: Points) -> Response:
    """Return coordinates, and say what is kept beside them."""
    beside = [*(["z"] if points.z is not None else []), *points.columns]
    says = "; ".join(filter(None, [", ".join(beside), points.crs or ""]))
    about = {"x-document": document, "x-says": quote(says)}
    return _response(points.xy.astype("<f8").tobytes(), "application/octet-stream", about)
