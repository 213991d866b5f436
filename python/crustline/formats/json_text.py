"""JSON as text: one document, or one a line; what is none is named by its place."""

from __future__ import annotations

import json
import re
from typing import Any, NoReturn

from crustline.errors import FormatError
from crustline.formats.source import Source

__all__ = ["dump", "parse"]

_SURROGATE = re.compile("[\ud800-\udfff]")


def parse(source: Source, encoding: str | None = None) -> Any:
    """Return the document of a source; of several, one a line, their list."""
    text = source.text(encoding).replace("\x1e", "")
    try:
        return _loaded(text, source)
    except json.JSONDecodeError as error:
        lines = text.split("\n")
        if error.msg != "Extra data" or "\n" not in text[: error.pos].strip() + text[error.pos :]:
            raise _fault(error, error.lineno, source) from None
    source.note("documents", "one a line")
    return [_line(line, number, source) for number, line in enumerate(lines, 1) if line.strip()]


def _line(line: str, number: int, source: Source) -> Any:
    try:
        return _loaded(line, source)
    except json.JSONDecodeError as error:
        raise _fault(error, number, source) from None


def _fault(error: json.JSONDecodeError, line: int, source: Source) -> FormatError:
    return source.error(f"{error.msg}: correct the JSON", f"line {line}, column {error.colno}")


def _loaded(text: str, source: Source) -> Any:
    def refuse(constant: str) -> NoReturn:
        raise FormatError(
            f"{source.name} holds {constant}, which JSON does not know: correct the value"
        )

    try:
        return json.loads(text, parse_constant=refuse)
    except (json.JSONDecodeError, FormatError):
        raise
    except RecursionError:
        raise FormatError(f"{source.name} is JSON that is nested too deep: flatten it") from None
    except ValueError as error:  # an integer of more digits than Python takes
        reason = str(error).split(";")[0]
        raise FormatError(f"{source.name} is no JSON that can be read: {reason}") from None


def dump(value: Any) -> str:
    """Return a value as JSON in one line."""
    text = json.dumps(value, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    if _SURROGATE.search(text):  # which UTF-8 does not hold, but an escape does
        text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return text
