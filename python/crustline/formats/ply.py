"""PLY: vertices read in pieces and written, without a library; what has faces is a mesh, too."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray
from crustline.formats.cloud import CHUNK, Chunk
from crustline.formats.format import Format
from crustline.formats.mesh import Triangles, triangles_of
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points, own_points

__all__ = ["PLY"]

Table = npt.NDArray[Any]

_KINDS = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2",
    "ushort": "u2", "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
_WRITTEN = {
    "i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint",
    "f4": "float", "f8": "double",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_LONGEST_HEADER = 1 << 16


@dataclass(frozen=True)
class _Element:
    """One table of a file: its name, rows, and columns; a list has the kinds of count and items."""

    name: str
    count: int
    columns: list[tuple[str, str]]
    lists: list[tuple[str, str, str]]


@dataclass(frozen=True)
class _Head:
    """What the header says, and the byte after it."""

    order: str
    elements: list[_Element]
    length: int

    def element(self, name: str) -> _Element | None:
        """Return an element of a name."""
        return next((each for each in self.elements if each.name == name), None)


def cloud(source: Source, box: FloatArray) -> Iterator[Chunk]:
    """Yield the vertices in space."""
    for table in _tables(source, CHUNK):
        yield Chunk(tuple(_column(table, axis, source) for axis in "xyz"))  # type: ignore[arg-type]


def stream(source: Source, rows: int) -> Iterator[Points]:
    """Yield the vertices, seen from above, with heights and all other properties."""
    for table in _tables(source, rows):
        yield _points(table, source)


def read(source: Source) -> Points:
    """Return the vertices, seen from above, with heights and all other properties."""
    return _points(np.concatenate(list(_tables(source, CHUNK))), source)


def mesh(source: Source) -> Triangles | None:
    """Return the vertices and triangles; None if there is no face."""
    faces = _head(source).element("face")
    if faces is None or not faces.count:
        return None
    wrong = [each for each in faces.lists if each[1][0] == "f"]
    if wrong:
        name, count, _ = wrong[0]
        raise source.error(
            f"the list {name!r:.40} of faces is counted in {_WRITTEN[count]}: save it with counts "
            "of type uchar"
        )
    indices = [each for each in faces.lists if each[0].startswith("vertex_ind")]
    if len(indices) != 1 or indices[0][2][0] == "f":
        raise source.error("its faces have no list of whole numbers vertex_indices: save it again")
    return triangles_of(source, "ply")


def _points(table: Table, source: Source) -> Points:
    x, y = (_column(table, axis, source) for axis in "xy")
    names = table.dtype.names or ()
    z = np.array(table["z"], np.float64) if "z" in names else None
    columns = {
        name: np.array(table[name], table.dtype[name].newbyteorder("="))
        for name in names
        if name not in ("x", "y", "z")
    }
    with source.named():
        return own_points(np.stack([x, y], axis=1), z=z, columns=columns)


def _column(table: Table, name: str, source: Source) -> FloatArray:
    if name not in (table.dtype.names or ()):
        raise source.error(f"its vertices have no {name}: save them with x, y and z")
    return np.asarray(table[name], np.float64)


def _head(source: Source) -> _Head:
    with source.open() as file:
        return _read_head(file, source)


def _read_head(file: BinaryIO, source: Source) -> _Head:
    """Read the header of a file up to its end."""
    order, elements, length, number = "", list[_Element](), 0, 0
    while True:
        line = file.readline(_LONGEST_HEADER)
        length, number = length + len(line), number + 1
        if not line or length > _LONGEST_HEADER:
            raise source.error("its header has no end: it was cut off, or is no PLY")
        words = line.decode("latin-1").split()
        if words == ["end_header"]:
            break
        if len(words) == 3 and words[0] == "format" and words[1] in _ORDERS:
            order = words[1]
        elif not _is_declared(words, elements, source, number):
            raise source.error(f"{' '.join(words)!r:.60} is no line of PLY", f"line {number}")
    if not order:
        raise source.error("its header names no format: write ascii or binary_little_endian")
    return _Head(order, elements, length)


def _is_declared(words: list[str], elements: list[_Element], source: Source, line: int) -> bool:
    """Add what a line of the header declares to the elements; return whether it is sound."""
    match words:
        case ["element", name, count] if count.isdecimal() and len(count) < 19:
            elements.append(_Element(name, int(count), [], []))
        case ["property", "list", count, item, name] if elements:
            of_count, of_item = _kind(count, line, source), _kind(item, line, source)
            elements[-1].lists.append((name, of_count, of_item))
        case ["property", kind, name] if elements:
            elements[-1].columns.append((name, _kind(kind, line, source)))
        case _:
            return not words or words[0] in ("ply", "comment", "obj_info")
    return True


def _kind(word: str, line: int, source: Source) -> str:
    if word not in _KINDS:
        raise source.error(f"{word!r:.40} is no type: use float, double or int", f"line {line}")
    return _KINDS[word]


def _tables(source: Source, rows: int) -> Iterator[Table]:
    """Yield the vertices as tables of at most some rows; as many as the header says."""
    with source.open() as file:
        head = _read_head(file, source)
        vertices = _leading(head, source)
        kind = np.dtype([(name, _ORDERS[head.order] + each) for name, each in vertices.columns])
        there = 0
        pieces = _text_tables if head.order == "ascii" else _binary_tables
        for table in pieces(file, kind, vertices.count, rows, source):
            there += len(table)
            yield table
    if there < vertices.count:
        raise source.error(
            f"the header says {vertices.count:,} vertices, and {there:,} are there: it was cut off"
        )


def _leading(head: _Head, source: Source) -> _Element:
    """Return the element of the vertices, which must be the first, of numbers alone."""
    first = next((each for each in head.elements if each.count), None)
    found = head.element("vertex")
    if found is None:
        raise source.error("it has no vertices: give a file with at least one point")
    names = [name for name, _ in found.columns]
    if found.lists or (first is not None and first is not found):
        raise source.error("its vertices do not come first, or hold lists: save them alone")
    if len(set(names)) < len(names) or not names:
        raise source.error("its vertices have a property twice, or none: name each once")
    return found


def _binary_tables(
    file: BinaryIO, kind: np.dtype[Any], count: int, rows: int, source: Source
) -> Iterator[Table]:
    left = count
    while left:
        content = file.read(min(left, rows) * kind.itemsize)
        table = np.frombuffer(content, kind, len(content) // kind.itemsize)
        if not len(table):
            return
        left -= len(table)
        yield table
    if not count:
        yield np.empty(0, kind)


def _text_tables(
    file: BinaryIO, kind: np.dtype[Any], count: int, rows: int, source: Source
) -> Iterator[Table]:
    done = 0
    while done < count:
        lines = [line for _ in range(min(count - done, rows)) if (line := file.readline(1 << 20))]
        if not lines:
            return
        table = np.empty(len(lines), kind)
        for number, line in enumerate(lines):
            table[number] = _numbers(line, kind, done + number, source)
        done += len(lines)
        yield table
    if not count:
        yield np.empty(0, kind)


def _numbers(line: bytes, kind: np.dtype[Any], row: int, source: Source) -> tuple[Any, ...]:
    """Return the values of a line, as the properties say."""
    words = line.split()
    try:
        values = tuple(map(float, words))
        if len(values) == len(kind.names or ()) and _fits(values, kind):
            return values
    except (ValueError, OverflowError):
        pass
    raise source.error(
        f"{line[:60]!r} are not the {len(kind.names or ())} numbers of a vertex", f"vertex {row}"
    )


def _fits(values: tuple[float, ...], kind: np.dtype[Any]) -> bool:
    """Return whether whole numbers are in the range of their types."""
    return all(
        kind[k].kind == "f" or (value == int(value) and np.can_cast(np.min_scalar_type(int(value)),
                                                                    kind[k]))
        for k, value in enumerate(values)
    )  # fmt: skip


def write_points(points: Points, target: Target) -> None:
    """Write binary PLY: x, y, z and the columns of numbers, to the bit."""
    columns: dict[str, Table] = {"x": points.xy[:, 0], "y": points.xy[:, 1]}
    if points.z is not None:
        columns["z"] = points.z
    for name, column in points.columns.items():
        if column.dtype.kind in "iufb" and name not in columns and name.split() == [name]:
            columns[name] = _writable(column)
    kinds = {name: column.dtype.str[1:] for name, column in columns.items()}
    table = np.empty(len(points), [(name, f"<{kind}") for name, kind in kinds.items()])
    for name, column in columns.items():
        table[name] = column
    properties = "".join(f"property {_WRITTEN[kind]} {name}\n" for name, kind in kinds.items())
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
        f"{properties}end_header\n"
    )
    target.write([header, table.tobytes()])


def _writable(column: Table) -> Table:
    """Return a column in a type that PLY has; whole numbers of 64 bits as doubles if they fit."""
    if column.dtype.str[1:] in _WRITTEN:
        return column
    return column.astype(np.uint8 if column.dtype.kind == "b" else np.float64)


PLY = Format(
    name="ply",
    title="PLY",
    suffixes=(".ply",),
    sniff=lambda head: head.startswith((b"ply\n", b"ply\r")),
    read=read,
    stream=stream,
    cloud=cloud,
    mesh=mesh,
    write_points=write_points,
)
