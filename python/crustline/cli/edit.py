"""`crustline edit`: the editor in a browser."""

from __future__ import annotations

import click

from crustline.cli.sections import Sectioned


@click.command(cls=Sectioned)
@click.argument("file", required=False, type=click.Path(allow_dash=True))
@click.option("--port", type=click.IntRange(0, 65535), default=0, metavar="N", help="The port.")
@click.option("--no-browser", is_flag=True, help="Print the address only.")
@click.option(
    "--limit",
    type=click.FloatRange(0, 4096, min_open=True),
    default=200,
    show_default=True,
    metavar="MB",
    help="The largest file that a page may send.",
)
def edit(file: str | None, port: int, no_browser: bool, limit: float) -> None:
    """Draw and drag points in a browser, and see their curves.

    FILE is what to begin with; - is standard input. The page is served to this machine alone, and
    the command ends when its last tab is closed.

    \b
        crustline edit goose.csv
    """
    from crustline.editor.serve import serve
    from crustline.formats import read
    from crustline.formats.source import Source

    first = None
    if file is not None:
        source = Source(file)
        first = (source.name, read(source))
    serve(first, port=port, limit=int(limit * 2**20), browser=not no_browser)
