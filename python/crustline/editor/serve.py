"""Runs the server until its last tab is closed, or Ctrl-C."""

from __future__ import annotations

import asyncio
import socket
import webbrowser
from types import FrameType

from crustline.editor.page import built
from crustline.editor.server import Site, application
from crustline.errors import InputError, require
from crustline.points import Points


def serve(
    first: tuple[str, Points] | None, *, port: int = 0, limit: int, browser: bool = True
) -> None:
    """Serve the editor on the loopback address; print the address, and open it in a browser.

    Parameters
    ----------
    first : tuple of str and Points, or None
        The name of a file and what it holds, which pages begin with.
    port : int, default 0
        Where to listen; 0 is any that is free.
    limit : int
        The most bytes of an upload.
    browser : bool, default True
        Whether to open the address.

    Raises
    ------
    MissingExtraError
        If Starlette or uvicorn is not installed.
    CrustlineError
        If the page is not built.
    InputError
        If the port is taken.
    """
    require("editor", "starlette", "uvicorn")
    built("index.html")
    with socket.socket() as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind(("127.0.0.1", port))
            listener.listen()  # from here on a browser may come
        except OSError as error:
            raise InputError(f"port {port} cannot be used: {error.strerror}") from None
        site = Site(listener.getsockname()[1], limit, first)
        print(site.address, flush=True)
        if browser:
            webbrowser.open(site.address)
        asyncio.run(_run(site, listener))


async def _run(site: Site, listener: socket.socket) -> None:
    import uvicorn

    class Server(uvicorn.Server):
        def handle_exit(self, sig: int, frame: FrameType | None) -> None:
            self.force_exit = True  # a page that is open would be waited for
            super().handle_exit(sig, frame)

    config = uvicorn.Config(application(site), log_level="error", lifespan="off", ws="none")
    server = Server(config)

    async def end() -> None:
        await site.ended.wait()
        server.should_exit = server.force_exit = True

    ending = asyncio.create_task(end())
    await server.serve([listener])
    ending.cancel()
