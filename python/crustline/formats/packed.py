"""Packed files: gzip, bzip2, xz and zip archives of one file, unpacked as they are read.

What they expand to is bounded, because a megabyte can hold a gigabyte of nothing.
"""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import zipfile
from collections.abc import Callable, Collection, Iterator
from typing import Any, BinaryIO

from crustline.errors import FormatError
from crustline.formats.source import Source

__all__ = ["ENOUGH", "LARGEST_RATIO", "bounded", "member", "refuse_bomb", "unpacked"]

#: Numbers as text pack to a third or a tenth; this is far beyond, but for a small file.
LARGEST_RATIO, ENOUGH = 100, 1 << 26
_CHUNK = 1 << 20
_STREAMS: dict[bytes, Callable[[Any], Any]] = {
    b"\x1f\x8b": gzip.open,
    b"BZh": bz2.open,
    b"\xfd7zXZ\x00": lzma.open,
}


def unpacked(source: Source) -> Source:
    """Return a source of what a packed one holds, or the source itself if it is not packed."""
    opening = next(
        (open for magic, open in _STREAMS.items() if source.head.startswith(magic)), None
    )
    if opening is None:
        return source
    name = source.name.removesuffix(source.suffix) or source.name
    return Source(_streamed(source, opening), name, source.notes)


def bounded(chunks: Iterator[bytes], packed: int, name: str) -> Iterator[bytes]:
    """Yield chunks until they are more than what an honest file of the packed size can hold."""
    size = 0
    for chunk in chunks:
        size += len(chunk)
        refuse_bomb(size, packed, name)
        yield chunk


def refuse_bomb(size: int, packed: int, name: str) -> None:
    """Refuse a size that an honest file of the packed size does not unpack to."""
    most = max(ENOUGH, LARGEST_RATIO * packed)
    if size > most:
        raise FormatError(
            f"{name} unpacks to more than {most >> 20:,} MB, {LARGEST_RATIO} times its size: "
            "unpack it yourself if it is sound"
        )


def _streamed(source: Source, opening: Callable[[Any], Any]) -> Iterator[bytes]:
    content = source.content()
    with source.library("the unpacker"), opening(io.BytesIO(content)) as file:
        yield from bounded(_chunks(file), len(content), source.name)


def member(source: Source, suffixes: Collection[str]) -> Source:
    """Return the one file of a zip archive that has one of some suffixes."""
    content = source.content()
    with source.library("zipfile"):
        archive = zipfile.ZipFile(io.BytesIO(content))
        files = [each for each in archive.infolist() if not each.is_dir()]
    fitting = [each for each in files if f".{each.filename.rpartition('.')[2].lower()}" in suffixes]
    if len(fitting) != 1:
        names = ", ".join(f"{each.filename!r:.40}" for each in (fitting or files)[:5])
        found = f"{len(fitting)} files" if fitting else "no file"
        raise source.error(f"the archive has {found} of points ({names}): unpack it, and give one")
    name = f"{source.name}/{fitting[0].filename}"
    return Source(_extracted(source, archive, fitting[0]), name, source.notes)


def _extracted(source: Source, archive: zipfile.ZipFile, member: Any) -> Iterator[bytes]:
    with source.library("zipfile"), archive.open(member) as file:
        yield from bounded(_chunks(file), member.compress_size, source.name)


def _chunks(file: BinaryIO | Any) -> Iterator[bytes]:
    while chunk := file.read(_CHUNK):
        yield chunk
