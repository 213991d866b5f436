"""Whole files: read at once, decoded with care, and replaced whole or not at all."""

from __future__ import annotations

import os
import secrets
import stat
import sys

from crustline.errors import FormatError

Path = str | os.PathLike[str]
_BYTE_ORDER_MARKS = (
    (b"\xef\xbb\xbf", "utf-8-sig"),
    (b"\xff\xfe", "utf-16"),
    (b"\xfe\xff", "utf-16"),
)


def describe_path(path: Path) -> str:
    """Return what messages call a path."""
    return "standard input" if os.fspath(path) == "-" else os.fspath(path)


def read_bytes(path: Path) -> bytes:
    """Return the content of a file, or of standard input for "-"; refuse an empty one."""
    try:
        content = _read_all(path)
    except OSError as error:
        raise FormatError(f"{describe_path(path)} cannot be read: {_reason(error)}") from None
    except ValueError:
        raise FormatError(f"{path!r} is no file name: it holds a null character") from None
    if not content.strip(b"\xef\xbb\xbf \t\r\n"):
        raise FormatError(f"{describe_path(path)} is empty: give a file with at least one point")
    return content


def _read_all(path: Path) -> bytes:
    if os.fspath(path) == "-":
        return sys.stdin.buffer.read()
    with open(path, "rb") as file:
        return file.read()


def as_text(content: bytes, name: str) -> str:
    """Return text from UTF-8, or UTF-16 with a byte order mark; lines end with a newline."""
    marks = (encoding for mark, encoding in _BYTE_ORDER_MARKS if content.startswith(mark))
    try:
        text = content.decode(next(marks, "utf-8"))
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise FormatError(
            f"{name}, line {line}: byte 0x{content[error.start]:02x} is not UTF-8 text: "
            "save the file as UTF-8, or choose its format"
        ) from None
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def replace_file(path: Path, content: bytes) -> None:
    """Write a file beside its place, then rename it there, so that it is never there in part.

    "-" is standard output. What is no regular file, such as a pipe, is written to directly.
    """
    if os.fspath(path) == "-":
        _write_standard_output(content)
        return
    try:
        _replace(os.path.realpath(path), content)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise FormatError(f"{os.fspath(path)} cannot be written: {_reason(error)}") from None
    except ValueError:
        raise FormatError(f"{path!r} is no file name: it holds a null character") from None


def _write_standard_output(content: bytes) -> None:
    buffer = getattr(sys.stdout, "buffer", None)
    if buffer is None:  # a notebook, or a test that captures text
        sys.stdout.write(content.decode())
        return
    sys.stdout.flush()
    buffer.write(content)
    buffer.flush()


def _replace(target: str, content: bytes) -> None:
    mode = os.stat(target).st_mode if os.path.exists(target) else None
    if mode is not None and not stat.S_ISREG(mode):
        with open(target, "wb") as file:
            file.write(content)
        return
    folder, name = os.path.split(target)
    beside = os.path.join(folder, f".{name[:100]}.{secrets.token_hex(4)}.part")
    try:
        with open(beside, "xb") as file:
            file.write(content)
        if mode is not None:
            os.chmod(beside, stat.S_IMODE(mode))
        os.replace(beside, target)
    except BaseException:
        if os.path.exists(beside):
            os.unlink(beside)
        raise


def check_writable(path: Path) -> None:
    """Raise `FormatError` if a file can surely not be written, before work is done for it."""
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


def _reason(error: OSError) -> str:
    advice = {
        FileNotFoundError: "there is no such file or folder: check the name",
        IsADirectoryError: "it is a folder: give a file name",
        NotADirectoryError: "a part of its path is no folder: check the name",
        PermissionError: "you have no permission: change it or choose another place",
    }
    return advice.get(type(error), f"{error.strerror or error}: check the place and its free space")
