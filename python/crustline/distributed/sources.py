"""What can be read: Parquet by row groups, files of any format, partitions of frames.

The input is a list of units, each read on its own, in pieces that fit in memory. Rows count through
the units, in the order of the files' paths as text.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from crustline.arrays import FloatArray, as_points
from crustline.distributed.place import Place, place_in_frame, place_in_schema
from crustline.errors import CrustlineError, InputError
from crustline.formats import Source, stream

_PARQUET = (".parquet", ".pq", ".geoparquet")
#: Bytes of a column that are read at once.
_BUFFER = 1 << 20


class Unit(Protocol):
    """A part of the input that one task reads."""

    def pieces(self, rows: int) -> Iterator[FloatArray]:
        """Yield the points (k, 2), finite, about `rows` at a time."""


@dataclass(frozen=True)
class Input:
    """All of the input.

    Attributes
    ----------
    units : list of Unit
        In the order of the rows.
    marks : list
        What tells this input from another, as JSON can hold it.
    crs : object
        The CRS of the coordinates, as GeoParquet tells it.
    """

    units: list[Any]
    marks: list[Any]
    crs: Any = None


@dataclass(frozen=True)
class File:
    """A file, with what shows whether it is still the same."""

    url: str
    size: int
    changed: str

    @contextmanager
    def unchanged(self) -> Iterator[None]:
        """Raise `InputError` if it is not the same before and after."""
        self._compare()
        yield
        self._compare()

    def _compare(self) -> None:
        if described(self.url) != self:
            raise InputError(f"{self.url} has changed since the run began: start another run")

    @contextmanager
    def open(self) -> Iterator[Any]:
        """Open it, if it is still the same, and is at the end."""
        import fsspec
        from pyarrow import ArrowInvalid

        try:
            with self.unchanged(), fsspec.open(self.url, "rb") as opened:
                yield opened
        except (OSError, ArrowInvalid) as error:
            reason = str(error).partition("\n")[0]
            raise InputError(f"{self.url} cannot be read ({reason}): copy it again") from None

    @contextmanager
    def source(self) -> Iterator[Source]:
        """Give it to a reader of its format, if it is still the same, and is at the end."""
        if "://" in self.url:
            with self.open() as opened:
                yield Source(opened, self.url)
        else:
            with self.unchanged():
                yield Source(Path(self.url), self.url)


def described(url: str) -> File:
    """Return a file as it is now, or raise `InputError` if it is not there."""
    import fsspec

    system, path = fsspec.core.url_to_fs(url)
    try:
        about = system.info(path)
    except OSError:
        raise InputError(f"{url} is not there, or cannot be read: give another path") from None
    changed = [str(about[key]) for key in ("ETag", "etag", "mtime", "created") if key in about]
    return File(url, int(about["size"] or 0), *changed[:1] or ("",))


@dataclass(frozen=True)
class RowGroups:
    """Successive row groups of a Parquet file."""

    file: File
    groups: tuple[int, ...]
    place: Place

    def pieces(self, rows: int) -> Iterator[FloatArray]:
        """Yield the points of the row groups."""
        from pyarrow import parquet

        columns = list(self.place.columns)
        with self.file.open() as opened:
            # With a buffer, or a column of a row group is read whole.
            table = parquet.ParquetFile(opened, buffer_size=_BUFFER)
            for group in self.groups:
                start = 0
                for batch in table.iter_batches(rows, row_groups=[group], columns=columns):
                    where = f"{self.file.url}, row group {group}"
                    yield _checked(self.place, batch, where, start)
                    start += batch.num_rows


@dataclass(frozen=True)
class Stream:
    """A file that is read from its start to its end, by its format."""

    file: File
    options: dict[str, Any] = field(default_factory=dict)

    def pieces(self, rows: int) -> Iterator[FloatArray]:
        """Yield the points of the file."""
        with self.file.source() as source:
            for points in stream(source, rows, **self.options):
                yield points.xy


@dataclass(frozen=True)
class Frame:
    """A partition of a Dask frame."""

    number: int
    frame: Any
    place: Place

    def pieces(self, rows: int) -> Iterator[FloatArray]:
        """Yield the points of the partition."""
        for start in range(0, len(self.frame), rows):
            part = self.frame.iloc[start : start + rows]
            yield _checked(self.place, part, f"partition {self.number}", start)


def _checked(place: Place, table: Any, where: str, first: int) -> FloatArray:
    """Return the points of a table; messages say where it is and count rows from its first one."""
    try:
        xy = place.points(table, first)
        if xy.dtype.kind == "f" and not np.isfinite(xy).all():
            row, column = np.argwhere(~np.isfinite(xy))[0].tolist()
            name = place.columns[min(column, len(place.columns) - 1)]
            fault = f"row {first + row} has {xy[row, column]} in {name}"
            raise InputError(f"{fault}: remove or repair the row")
        points: FloatArray = as_points(xy)
    except CrustlineError as error:
        raise InputError(f"{where}: {error}") from None
    return points


def open_input(source: Any, columns: Sequence[str] | None, rows: int) -> Input:
    """Return the units of what a caller gives: a path, a pattern, a list of these, or a Dask frame.

    `rows` is about how many rows a unit of a Parquet file is to have.
    """
    if hasattr(source, "to_delayed"):
        return _of_frame(source, columns)
    given = [source] if isinstance(source, (str, PathLike)) else list(source)
    files = [described(url) for url in sorted({url for each in given for url in _urls(each)})]
    tables = _Tables(columns, rows)
    units: list[Any] = []
    for file in files:
        if file.url.lower().endswith(_PARQUET):
            units += tables.units(file)
        else:
            units.append(Stream(file, {} if columns is None else {"columns": columns}))
    marks = [[file.url, file.size, file.changed] for file in files]
    return Input(units, marks, tables.crs)


def _urls(given: str | PathLike[str]) -> list[str]:
    """Return the files that a path or a pattern names, or the Parquet files of a folder."""
    import fsspec

    url = fspath(given)
    system, path = fsspec.core.url_to_fs(url)
    if system.isdir(path):
        path = f"{path.rstrip('/')}/*.parquet"
    elif not any(sign in path for sign in "*?["):
        return [url]
    found = [system.unstrip_protocol(each) for each in system.glob(path)]
    if not found:
        raise InputError(f"no file matches {url}: give another path or pattern")
    return [each.removeprefix("file://") for each in found]


class _Tables:
    """Parquet files, which must have their points in columns of the same names and types."""

    def __init__(self, columns: Sequence[str] | None, rows: int) -> None:
        self._columns, self._rows = columns, rows
        self._first: tuple[File, Place, Any] | None = None
        self.crs: Any = None

    def units(self, file: File) -> list[RowGroups]:
        """Return the row groups of a file, small ones together."""
        from pyarrow import ArrowInvalid, parquet

        with file.open() as opened:
            try:
                table = parquet.ParquetFile(opened)
            except (ArrowInvalid, OSError) as error:
                raise InputError(
                    f"{file.url} is no Parquet file, or a damaged one ({error})"
                ) from None
            place = self._agreed(file, table.schema_arrow)
            about = table.metadata
            sizes = [about.row_group(k).num_rows for k in range(about.num_row_groups)]
        runs: list[list[int]] = [[]]
        for group, size in enumerate(sizes):
            if runs[-1] and sum(sizes[k] for k in runs[-1]) + size > self._rows:
                runs.append([])
            runs[-1].append(group)
        return [RowGroups(file, tuple(run), place) for run in runs if run]

    def _agreed(self, file: File, schema: Any) -> Place:
        place, crs = place_in_schema(schema, self._columns, file.url)
        types = [schema.field(name).type for name in place.columns]
        if self._first is None:
            self._first, self.crs = (file, place, types), crs
        first, first_place, first_types = self._first
        if (place, types) != (first_place, first_types):
            mine, others = (", ".join(map(str, each)) for each in (types, first_types))
            raise InputError(
                f"{file.url} has its points in {', '.join(place.columns)} as {mine}, "
                f"but {first.url} in {', '.join(first_place.columns)} as {others}: make them alike"
            )
        return place


def _of_frame(frame: Any, columns: Sequence[str] | None) -> Input:
    from dask.base import tokenize

    place = place_in_frame(frame, columns)
    parts = frame.to_delayed()
    units = [Frame(number, part, place) for number, part in enumerate(parts)]
    crs = (
        getattr(getattr(frame, "_meta", None), "crs", None)
        if place.encoding == "geometry"
        else None
    )
    return Input(units, [["frame", tokenize(frame)]], None if crs is None else crs.to_json_dict())
