"""What notebooks show of things that are no picture: tables, as HTML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def table(title: str, header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table with a title above; cells are shown as `str` gives them."""
    lines = [_row(header, "th"), *(_row(row, "td") for row in rows)]
    return f"<table><caption>{escape(title)}</caption>{''.join(lines)}</table>"


def paragraphs(lines: Iterable[str]) -> str:
    """Return lines of text as paragraphs."""
    return "".join(f"<p>{escape(line)}</p>" for line in lines)


def _row(cells: Sequence[object], tag: str) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(_text(cell))}</{tag}>' for cell in cells)}</tr>"


def _text(cell: object) -> str:
    return f"{cell:,}" if type(cell) is int else str(cell)
