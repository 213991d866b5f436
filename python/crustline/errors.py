"""The exceptions that crustline raises, all of them `CrustlineError`."""

from __future__ import annotations

from importlib.util import find_spec


class CrustlineError(Exception):
    """The base of every error that crustline raises on purpose."""


class InputError(CrustlineError, ValueError):
    """Points, edges or an option that no answer can be given for; names the row and the value."""


class FormatError(CrustlineError, ValueError):
    """A file that cannot be read or written; names the file and, where there is one, the line."""


class FormatWarning(UserWarning):
    """What was read although it is doubtful; names the file and the option that says otherwise."""


class MissingExtraError(CrustlineError, ImportError):
    """A feature whose optional packages are not installed; names the extra to install."""


def shown(value: object, most: int = 60) -> str:
    """Return a value as messages show it: on one line, cut, whatever its own `repr` does."""
    try:
        text = " ".join(repr(value).split())
    except Exception:  # someone else's code
        text = object.__repr__(value)
    return text if len(text) <= most else f"{text[: most - 1]}…"


def require(extra: str, *packages: str) -> None:
    """Raise `MissingExtraError` if a package that an extra of crustline brings is not installed."""
    for package in packages:
        if not _is_here(package):
            raise MissingExtraError(
                f"this needs {package}, which is not installed: "
                f"run pip install 'crustline[{extra}]'"
            )


def _is_here(package: str) -> bool:
    try:
        return find_spec(package) is not None
    except ImportError:  # of a part of a package that is not here
        return False
