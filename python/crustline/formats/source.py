"""Where a reader's bytes come from: a file, standard input, bytes, a file-like object, chunks."""

from __future__ import annotations

import io
import os
import stat
import sys
import tempfile
import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO

from crustline.errors import CrustlineError, FormatError, FormatWarning, InputError, shown

__all__ = ["HEAD", "Source"]

#: How many of the first bytes `Source.head` shows.
HEAD = 4096
_CHUNK = 1 << 20


@dataclass(eq=False)
class Source:
    """The bytes that a reader reads, and what it has to say about them.

    Attributes
    ----------
    name : str
        What messages call it.
    given : path-like, bytes, file-like object or iterable of bytes
        Where the bytes are; "-" is standard input. Streams are read once.
    notes : dict of str to str
        How the bytes were understood, in a few words each, for `crustline info`.
    """

    given: Any
    name: str = ""
    notes: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if isinstance(self.given, bytearray | memoryview):
            self.given = bytes(self.given)
        if not isinstance(self.given, os.PathLike) and not hasattr(self.given, "read"):
            _check_iterable(self.given)
        self.name = short_name(self.name or _name_of(self.given))
        refuse_no_name(self.given)

    @property
    def suffix(self) -> str:
        """The end of the name, from its last point on, in lower case."""
        return Path(self.name).suffix.lower()

    @cached_property
    def size(self) -> int | None:
        """The number of bytes; None if that is not known beforehand."""
        if isinstance(self.given, bytes):
            return len(self.given)
        if not self._is_file:
            return None
        with self._named_faults():
            return os.stat(self.given).st_size

    @cached_property
    def head(self) -> bytes:
        """The first bytes, at most `HEAD`; they are not taken away."""
        with self.open() as file:
            return self._stream.peek(HEAD)[:HEAD] if self._is_stream else file.read(HEAD)

    @contextmanager
    def open(self) -> Iterator[BinaryIO]:
        """Open it for reading from its start; a stream cannot seek, and only once be opened."""
        with self._named_faults():
            if self._is_stream:
                yield self._stream
            elif isinstance(self.given, bytes):
                yield io.BytesIO(self.given)
            else:
                with open(self.given, "rb") as file:
                    _refuse_device(file)
                    yield file

    def chunks(self, size: int = _CHUNK) -> Iterator[bytes]:
        """Yield all bytes in pieces of some size."""
        with self.open() as file:
            while chunk := file.read(size):
                yield chunk

    def content(self) -> bytes:
        """Return all bytes; refuse none at all."""
        if isinstance(self.given, bytes):
            content = self.given
        else:
            with self.open() as file:
                content = file.read()
        if not content[:HEAD].strip(b"\xef\xbb\xbf \t\r\n") and not content.strip():
            raise FormatError(f"{self.name} is empty: give a file with at least one point")
        return content

    def text(self, encoding: str | None = None) -> str:
        """Return all text; by default it is UTF-8, or UTF-16 where that is plain."""
        content = self.content()
        found = encoding or likely_encoding(content)
        try:
            text = content.decode(found)
        except UnicodeDecodeError as error:
            line = content.count(b"\n", 0, error.start) + 1
            advice = "say in which encoding the text is (--encoding latin-1, or another one)"
            fault = f"byte 0x{content[error.start]:02x} is not {error.encoding.upper()} text"
            raise self.error(f"{fault}: {advice}", f"line {line}") from None
        if "\0" in text:
            raise self.error("it holds null characters, and is no text: choose its format")
        self.note("encoding", found)
        return text

    @contextmanager
    def path(self, suffix: str = "") -> Iterator[Path]:
        """Give the path of a file with these bytes, for libraries that open files themselves.

        It ends with `suffix` where the bytes come from no file.
        """
        if self._is_file:
            with self.open():
                pass
            yield Path(self.given)
            return
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, f"source{suffix or self.suffix}")
            with open(path, "wb") as file:
                file.writelines(self.chunks())
            yield path

    def error(self, fault: str, place: str = "") -> FormatError:
        """Return the error about a fault at a place, such as "line 3"."""
        return FormatError(f"{self.name}{', ' if place else ''}{place}: {fault}")

    @contextmanager
    def named(self) -> Iterator[None]:
        """Name the source in what is said of points that do not fit."""
        try:
            yield
        except InputError as error:
            raise FormatError(f"{self.name}, {error}") from None

    def warn(self, doubt: str) -> None:
        """Warn of what was read although it is doubtful; name the option that says otherwise."""
        warnings.warn(f"{self.name}: {doubt}", FormatWarning, stacklevel=2)

    def note(self, subject: str, finding: str) -> None:
        """Note how something was understood, for `crustline info`."""
        self.notes[subject] = finding

    @contextmanager
    def library(self, name: str) -> Iterator[None]:
        """Make whatever a library raises a `FormatError`, in a sentence."""
        try:
            yield
        except CrustlineError:
            raise
        except MemoryError:  # of a file that is large, or that says so and is not
            advice = "read a part of it, or repair it"
            raise self.error(f"{name} asks for more memory than there is: {advice}") from None
        except Exception as error:
            lines = str(error).split("\n")
            reason = f"{type(error).__name__}{': ' if lines[0] else ''}{lines[0][:120]}"
            raise self.error(f"{name} cannot read it ({reason}): repair or save it again") from None

    @property
    def _is_stream(self) -> bool:
        return not (isinstance(self.given, bytes) or self._is_file)

    @property
    def _is_file(self) -> bool:
        return isinstance(self.given, str | os.PathLike) and os.fspath(self.given) != "-"

    @cached_property
    def _stream(self) -> io.BufferedReader:
        return io.BufferedReader(_Chunks(_chunks_of(self.given)), HEAD)

    @contextmanager
    def _named_faults(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise FormatError(f"{self.name} cannot be read: {reason_of(error)}") from None


class _Chunks(io.RawIOBase):
    """Chunks of bytes as a file that is read once."""

    def __init__(self, chunks: Iterator[bytes]) -> None:
        self.chunks = chunks
        self.rest = memoryview(b"")

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        while not len(self.rest):
            chunk = next(self.chunks, None)
            if chunk is None:
                return 0
            self.rest = memoryview(chunk)
        count = min(len(buffer), len(self.rest))
        buffer[:count] = self.rest[:count]
        self.rest = self.rest[count:]
        return count


def _chunks_of(given: Any) -> Iterator[bytes]:
    """Yield the chunks of standard input, of a file-like object, or of an iterable."""
    if isinstance(given, str):
        given = sys.stdin.buffer
        _refuse_device(given)
    for chunk in _reads(given) if hasattr(given, "read") else given:
        if not isinstance(chunk, bytes | bytearray | memoryview | str):
            raise InputError(f"a piece to read is {shown(chunk)}, not bytes: give a path or bytes")
        yield _as_bytes(chunk)


def _as_bytes(chunk: Any) -> bytes:
    if isinstance(chunk, bytes | bytearray | memoryview):
        return bytes(chunk)
    if isinstance(chunk, str):
        return chunk.encode()
    raise InputError(f"path gives {shown(chunk)} in place of bytes: open the file in binary mode")


def _check_iterable(given: Any) -> None:
    alone = isinstance(given, Mapping) or getattr(given, "ndim", 1) == 0
    if alone or not isinstance(given, Iterable):
        raise InputError(f"path is {shown(given)}: give a path, bytes, or a file-like object")


def _reads(file: Any) -> Iterator[Any]:
    while chunk := file.read(_CHUNK):
        yield chunk


def _refuse_device(file: Any) -> None:
    """Refuse a device such as /dev/zero, which has no end; a terminal has one."""
    try:
        mode = os.fstat(file.fileno()).st_mode
    except (OSError, AttributeError):
        return  # no file of the system
    if stat.S_ISCHR(mode) and not file.isatty():
        raise OSError(None, "it is a device: give a file")


def _name_of(given: Any) -> str:
    if isinstance(given, str | os.PathLike):
        return "standard input" if os.fspath(given) == "-" else os.fspath(given)
    name = getattr(given, "name", None)
    return name if isinstance(name, str) else f"<{type(given).__name__}>"


def likely_encoding(content: bytes) -> str:
    """Return the encoding that a mark says, or that every other byte being 0 shows; else UTF-8."""
    marks = (
        (b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"),
    )  # fmt: skip
    for mark, encoding in marks:
        if content.startswith(mark):
            return encoding
    head = content[: HEAD & ~1]
    if len(head) > 1 and not any(head[1::2]) and all(head[::2]):
        return "utf-16-le"
    if len(head) > 1 and not any(head[::2]) and all(head[1::2]):
        return "utf-16-be"
    return "utf-8"


def short_name(name: str) -> str:
    """Return a name that fits into a sentence; its end tells more than its middle."""
    return name if len(name) <= 160 else f"{name[:60]}…{name[-90:]}"


def refuse_no_name(given: object) -> None:
    """Refuse a path that the system takes for no name: it holds a null, or what has no bytes."""
    if not isinstance(given, str | os.PathLike):
        return
    fault = "it holds a null character" if "\0" in os.fspath(given) else ""
    try:
        os.fsencode(given)
    except UnicodeEncodeError as error:
        fault = f"{error.encoding} has no {error.object[error.start]!a}, change the locale or it"
    if fault:
        raise FormatError(f"{shown(os.fspath(given))} is no file name: {fault}")


def reason_of(error: OSError) -> str:
    """Return why a file cannot be read or written, and what to do."""
    advice = {
        FileNotFoundError: "there is no such file or folder: check the name",
        IsADirectoryError: "it is a folder: give a file name",
        NotADirectoryError: "a part of its path is no folder: check the name",
        PermissionError: "you have no permission: change it or choose another place",
    }
    return advice.get(type(error), f"{error.strerror or error}: check the place and its free space")
