"""Options that several formats share, and what makes an `Option` of a kind."""

from __future__ import annotations

import os
from numbers import Integral
from typing import Any

from crustline.formats.format import Option
from crustline.scalars import as_positive

__all__ = [
    "COLUMNS",
    "ENCODING",
    "LAYER",
    "OVER",
    "POLYGONS",
    "TOLERANCE",
    "UNIT",
    "WHERE",
    "choice",
    "flag",
    "length",
    "text",
    "whole",
]


def text(name: str, help: str, metavar: str, *, flag: str = "") -> Option:
    """Return an option whose value is text."""
    return Option(name, help, _as_text, metavar, flag)


def whole(name: str, help: str, metavar: str = "N", *, least: int = 0) -> Option:
    """Return an option whose value is a whole number."""

    def parse(value: Any) -> int:
        number = int(value) if isinstance(value, str) and value.strip().isdecimal() else value
        if not isinstance(number, Integral) or isinstance(number, bool) or number < least:
            raise ValueError(f"give a whole number of at least {least}")
        return int(number)

    return Option(name, help, parse, metavar)


def length(name: str, help: str, metavar: str) -> Option:
    """Return an option whose value is a positive number."""

    def parse(value: Any) -> float:
        try:
            return as_positive(name, float(value) if isinstance(value, str) else value)
        except ValueError:
            raise ValueError("give a number above 0") from None

    return Option(name, help, parse, metavar)


def choice(name: str, help: str, *words: str) -> Option:
    """Return an option whose value is one of some words."""

    def parse(value: Any) -> str:
        if value not in words:
            raise ValueError(f"choose one of {', '.join(words)}")
        return str(value)

    return Option(name, help, parse, "|".join(words))


def flag(name: str, help: str, *, spelling: str = "", constant: bool = True) -> Option:
    """Return an option that is given or not; the command's `spelling` gives it `constant`."""

    def parse(value: Any) -> bool:
        if not isinstance(value, bool):
            raise ValueError("give True or False")
        return value

    return Option(name, help, parse, "", spelling, constant)


def _as_text(value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise ValueError("give text")
    return value


def _as_columns(value: Any) -> tuple[str | int, ...]:
    """Return two or three names or positions of columns, from a sequence or from "X,Y"."""
    columns = [name.strip() for name in value.split(",")] if isinstance(value, str) else value
    advice = "choose two for x and y, or three with z, by name or position"
    try:
        chosen = tuple(columns)
    except TypeError:
        raise ValueError(advice) from None
    sound = all(isinstance(each, str | Integral) and not isinstance(each, bool) for each in chosen)
    if not sound or len(chosen) not in (2, 3):
        raise ValueError(advice)
    if len(set(chosen)) < len(chosen):
        raise ValueError("it has a column twice: choose different ones")
    return tuple(each if isinstance(each, str) else int(each) for each in chosen)


COLUMNS = Option(
    "columns",
    "The columns of x and y (and z): names, or positions from 0.",
    _as_columns,
    "X,Y",
)
LAYER = text("layer", "The layer to read, of a file with several.", "NAME")
WHERE = text("where", "Read only the rows that fit, in SQL, such as \"kind = 'coast'\".", "SQL")


def _as_path(value: Any) -> str:
    if not isinstance(value, str | os.PathLike) or not os.fspath(value):
        raise ValueError("give the name of a picture")
    return os.fspath(value)


OVER = Option("over", "Draw over this picture, which the curves are of.", _as_path, "PICTURE")
POLYGONS = flag("polygons", "Write rings as polygons with holes.")
TOLERANCE = length(
    "tolerance", "How far splines may be from what is written, in the unit of the points.", "T"
)
UNIT = choice(
    "unit", "The unit of the coordinates, for drawings.", "mm", "cm", "m", "km", "in", "ft"
)


def _as_encoding(value: Any) -> str:
    try:
        "".encode(value)  # which refuses codecs that are none of text
        return str(value)
    except (LookupError, TypeError, ValueError):
        raise ValueError("give the name of an encoding, such as latin-1") from None


ENCODING = Option(
    "encoding",
    "The encoding of the text. By default UTF-8, or UTF-16 where it is plain.",
    _as_encoding,
    "NAME",
)
