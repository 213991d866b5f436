"""Where a writer's bytes go: a file, replaced whole or not at all, standard output, an object."""

from __future__ import annotations

import os
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from crustline.errors import FormatError, InputError, shown
from crustline.formats.source import reason_of, refuse_no_name, short_name

__all__ = ["Target", "check_writable"]

Content = bytes | str | Iterable[bytes | str]


@dataclass(eq=False)
class Target:
    """A place for what is written.

    Attributes
    ----------
    given : path-like or file-like object
        "-" is standard output. What is no regular file, such as a pipe, is written to directly.
    """

    given: Any

    def __post_init__(self) -> None:
        is_file = hasattr(self.given, "write") and hasattr(self.given, "flush")
        if not (is_file or isinstance(self.given, str | os.PathLike)):
            raise InputError(f"path is {shown(self.given)}: give a file name, or an open file")
        refuse_no_name(self.given)

    @property
    def name(self) -> str:
        """What messages call it."""
        if self._is_path:
            return short_name(str(os.fspath(self.given)))
        return "standard output" if self.given == "-" else f"<{type(self.given).__name__}>"

    @property
    def suffix(self) -> str:
        """The end of the name, from its last point on, in lower case; "" if there is no name."""
        return Path(os.fspath(self.given)).suffix.lower() if self._is_path else ""

    def write(self, content: Content) -> None:
        """Write the content, whole or in pieces."""
        pieces = [content] if isinstance(content, bytes | str) else content
        with self._named_faults():
            if not self._is_path:
                _send(pieces, sys.stdout if self.given == "-" else self.given)
            elif _is_special(os.path.realpath(self.given)):
                with open(self.given, "wb") as file:
                    file.writelines(map(_as_bytes, pieces))
            else:
                with self._beside() as path, open(path, "xb") as file:
                    file.writelines(map(_as_bytes, pieces))

    @contextmanager
    def path(self, suffix: str = "") -> Iterator[Path]:
        """Give a path for a library to write to; all files of its folder are put in place after.

        It ends with `suffix` where the target has no name. A stream takes one file only.
        Nothing is left behind if the block raises an exception.
        """
        with self._named_faults():
            if self._is_path and not _is_special(os.path.realpath(self.given)):
                with self._beside() as path:
                    yield path
                return
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, f"target{suffix or self.suffix}")
                yield path
                if len(os.listdir(folder)) > 1:
                    raise FormatError(f"{self.name} has no room for several files: give a name")
                self.write(path.read_bytes())

    @contextmanager
    def _beside(self) -> Iterator[Path]:
        """Give a path in a new folder beside the target; rename what is in it to its place."""
        target = Path(os.path.realpath(self.given))
        mode = target.stat().st_mode if target.exists() else None
        if target.is_dir():
            raise IsADirectoryError
        folder = Path(tempfile.mkdtemp(".part", f".{target.name[:80]}.", target.parent))
        try:
            yield folder / target.name
            if mode is not None:
                os.chmod(folder / target.name, stat.S_IMODE(mode))
            for path in sorted(folder.iterdir(), key=lambda path: path.name == target.name):
                os.replace(path, target.parent / path.name)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    @property
    def _is_path(self) -> bool:
        return isinstance(self.given, str | os.PathLike) and os.fspath(self.given) != "-"

    @contextmanager
    def _named_faults(self) -> Iterator[None]:
        try:
            yield
        except BrokenPipeError:
            raise
        except OSError as error:
            raise FormatError(f"{self.name} cannot be written: {reason_of(error)}") from None
        except UnicodeEncodeError as error:
            word = error.object[max(0, error.start - 20) : error.end]
            raise FormatError(
                f"{self.name} cannot be written: {word!r} ends with a lone surrogate, which UTF-8 "
                "does not hold: correct the text"
            ) from None


def _as_bytes(piece: bytes | str) -> bytes:
    return piece.encode() if isinstance(piece, str) else piece


def _send(pieces: Iterable[bytes | str], stream: Any) -> None:
    """Write to a stream of bytes; to one of text where there is nothing else, as in a notebook."""
    buffer = getattr(stream, "buffer", stream)
    stream.flush()
    for piece in map(_as_bytes, pieces):
        try:
            buffer.write(piece)
        except TypeError:
            buffer.write(piece.decode())
    buffer.flush()


def _is_special(path: str) -> bool:
    return os.path.exists(path) and not (os.path.isfile(path) or os.path.isdir(path))


def check_writable(path: str | os.PathLike[str]) -> None:
    """Raise `FormatError` if a file can surely not be written, before work is done for it."""
    refuse_no_name(path)
    target = os.path.realpath(path)
    folder = os.path.dirname(target)
    reason = None
    if os.fspath(path) == "-":
        return
    if os.path.isdir(target):
        reason = "it is a folder: give a file name"
    elif not os.path.isdir(folder):
        reason = f"there is no folder {folder}: make it first"
    elif not os.access(target if os.path.exists(target) else folder, os.W_OK):
        reason = "you have no permission: choose another place"
    if reason:
        raise FormatError(f"{os.fspath(path)} cannot be written: {reason}")
