"""What a caller can say about columns of text, in place of what is found in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from crustline.formats.format import Option
from crustline.formats.options import COLUMNS, ENCODING, choice, flag, text, whole

__all__ = ["OPTIONS", "Settings"]

_SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t", "bar": "|", "space": " "}


@dataclass(frozen=True)
class Settings:
    """The options of the reader; None is for what is to be found."""

    columns: Sequence[str | int] | None = None
    fields: tuple[tuple[int, int], ...] | None = None
    skip_lines: int | None = None
    comment: str | None = None
    header: bool | None = None
    separator: str | None = None
    decimal: str | None = None
    missing: tuple[float, ...] | None = None
    on_bad_row: str = "error"
    encoding: str | None = None


def _as_separator(value: Any) -> str:
    known = {**_SEPARATORS, **{each: each for each in _SEPARATORS.values()}}
    if value not in known:
        raise ValueError(f"choose one of {', '.join(_SEPARATORS)}")
    return known[value]


def _as_missing(value: Any) -> tuple[float, ...]:
    if value == "none":
        return ()
    try:
        parts = value.split(",") if isinstance(value, str) else value
        return tuple(map(float, parts if isinstance(parts, list | tuple) else [parts]))
    except (TypeError, ValueError):
        raise ValueError("give numbers, such as -9999, or none") from None


def _as_fields(value: Any) -> tuple[tuple[int, int], ...]:
    advice = "give the first and last character of each column, such as 1-8,9-16"
    try:
        parts = value.split(",") if isinstance(value, str) else value
        pairs = [part.split("-") if isinstance(part, str) else part for part in parts]
        fields = tuple((int(first), int(last)) for first, last in pairs)
    except (TypeError, ValueError):
        raise ValueError(advice) from None
    if len(fields) < 2 or not all(1 <= first <= last for first, last in fields):
        raise ValueError(advice)
    return fields


OPTIONS = (
    COLUMNS,
    Option(
        "fields",
        "Columns of fixed width: the first and last character of each, from 1, such as 1-8,9-16.",
        _as_fields,
        "A-B,C-D",
    ),
    whole(
        "skip_lines",
        "How many lines to leave out at the top; then nothing else is left out there.",
    ),
    flag("header", "The first row is a point: no names.", spelling="--no-header", constant=False),
    text("comment", "What starts a comment, in place of # % ! * and //.", "MARK"),
    Option("separator", "What is between columns.", _as_separator, "|".join(_SEPARATORS)),
    choice("decimal", "The decimal mark; the other one marks thousands.", ".", ","),
    Option(
        "missing",
        "Numbers that mean that there is no value: rows whose x or y is one are left out.",
        _as_missing,
        "NUMBERS",
    ),
    choice("on_bad_row", "What to do about a row that is no point.", "error", "skip"),
    ENCODING,
)
