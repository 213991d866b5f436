"""Files of a run: each is whole or not there, and is told from a damaged one by its digest.

A file of records is an Arrow IPC file. Each record holds named arrays, and is read without the
others.
"""

from __future__ import annotations

import hashlib
import itertools
import os
import threading
import time
import uuid
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import IntArray
from crustline.errors import CrustlineError, InputError

Array = npt.NDArray[Any]
Arrays = dict[str, Array]

#: Ends the names of files that are being written.
PART = ".part"


class _Meter(threading.local):
    """What this thread's work on files has taken."""

    seconds = 0.0


_meter = _Meter()


@contextmanager
def on_files() -> Iterator[None]:
    """Count what is done here as work on files."""
    start = time.process_time()
    try:
        yield
    finally:
        _meter.seconds += time.process_time() - start


def file_seconds() -> float:
    """Return how many seconds of processors this thread has spent in reading and writing files."""
    return _meter.seconds


@dataclass(frozen=True)
class Written:
    """A file that was written whole: where in the folder of the run, its size, its digest."""

    path: str
    size: int
    digest: str

    def is_in(self, folder: Path) -> bool:
        """Return whether the file is there as it was written."""
        path = folder / self.path
        try:
            return path.stat().st_size == self.size and _digest(path) == self.digest
        except OSError:
            return False


def write(folder: Path, path: str, make: Callable[[Path], object]) -> Written:
    """Have `make` write a file under another name, and give it its own once it is whole."""
    target = folder / path
    part = target.with_name(f"{target.name}.{uuid.uuid4().hex}{PART}")
    with named_faults(target):
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            make(part)
            written = Written(path, part.stat().st_size, _digest(part))
            os.replace(part, target)
        finally:
            part.unlink(missing_ok=True)
    return written


@contextmanager
def named_faults(path: Path) -> Iterator[None]:
    """Say of a file that cannot be written that it is so, and why."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        message = f"{path} cannot be written ({reason}): make room or give another folder"
        raise CrustlineError(message) from error


def damaged(path: Path, reason: str) -> CrustlineError:
    """Return what to say of a file that is not as it was written."""
    return CrustlineError(f"{path} is damaged or gone ({reason}): run again with resume")


def clean(folder: Path) -> None:
    """Remove what writers that were killed have left."""
    for part in folder.rglob(f"*{PART}"):
        part.unlink(missing_ok=True)


def _digest(path: Path) -> str:
    with on_files(), path.open("rb") as file:
        return hashlib.file_digest(file, lambda: hashlib.blake2b(digest_size=16)).hexdigest()


def write_records(folder: Path, path: str, records: Iterable[Arrays]) -> Written:
    """Write records, at least one, that have the same names and types of arrays."""
    return write(folder, path, lambda part: _write_records(part, iter(records)))


def _write_records(path: Path, records: Iterator[Arrays]) -> None:
    import pyarrow as pa

    first = next(records)
    schema = pa.schema([_field(name, array) for name, array in first.items()])
    with pa.OSFile(str(path), "wb") as file, pa.ipc.new_file(file, schema) as writer:
        for record in itertools.chain([first], records):
            with on_files():
                writer.write_batch(_batch(record, schema))


def _field(name: str, array: Array) -> Any:
    import pyarrow as pa

    kind = np.uint8 if array.dtype == bool else array.dtype
    about = {"dtype": array.dtype.str, "width": str(array.shape[1] if array.ndim == 2 else 0)}
    return pa.field(name, pa.large_list(pa.from_numpy_dtype(kind)), metadata=about)


def _batch(record: Arrays, schema: Any) -> Any:
    import pyarrow as pa

    columns = []
    for field in schema:
        array = np.ascontiguousarray(
            record[field.name], np.dtype(field.metadata[b"dtype"].decode())
        )
        flat = array.view(np.uint8).ravel() if array.dtype == bool else array.ravel()
        offsets = pa.array([0, len(flat)], pa.int64())
        columns.append(pa.LargeListArray.from_arrays(offsets, pa.array(flat)))
    return pa.record_batch(columns, schema=schema)


class Records(Sequence[Arrays]):
    """The records of a file; each is read when it is asked for, only the `names` if given.

    Of a `mapped` file only what is used of a record is read.
    """

    def __init__(
        self, path: Path, names: Sequence[str] | None = None, mapped: bool = False
    ) -> None:
        import pyarrow as pa

        try:
            with on_files():
                source = pa.memory_map(str(path)) if mapped else pa.OSFile(str(path))
                schema = pa.ipc.open_file(source).schema
                wanted = range(len(schema)) if names is None else map(schema.get_field_index, names)
                options = pa.ipc.IpcReadOptions(included_fields=list(wanted))
                self._file = pa.ipc.open_file(source, options=options)
        except (OSError, pa.ArrowInvalid) as error:
            raise damaged(path, str(error)) from None

    def __len__(self) -> int:
        return int(self._file.num_record_batches)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, slice):
            return [self[k] for k in range(len(self))[key]]
        with on_files():
            batch = self._file.get_batch(range(len(self))[key])
            return {field.name: _array(batch[field.name], field) for field in batch.schema}


def _array(column: Any, field: Any) -> Array:
    flat = column.values.to_numpy(zero_copy_only=False)
    flat = flat.view(np.dtype(field.metadata[b"dtype"].decode()))
    width = int(field.metadata[b"width"])
    array: Array = flat.reshape(-1, width) if width else flat
    return array


def together(records: Iterable[Arrays], empty: Arrays) -> Arrays:
    """Join the arrays of records of equal names end to end; `empty` has their types."""
    parts = [empty, *records]
    return {name: np.concatenate([part[name] for part in parts]) for name in empty}


def write_batches(path: Path, schema: Any, batches: Iterable[Any]) -> None:
    """Write a Parquet file, a row group for each record batch."""
    from pyarrow import parquet

    # Without dictionaries, as hardly any value comes twice.
    options = {"use_dictionary": False, "write_page_checksum": True}
    with parquet.ParquetWriter(path, schema, **options) as writer:
        for batch in batches:
            with on_files():
                writer.write_batch(batch)


def write_pairs(path: Path, names: tuple[str, str], parts: Iterable[IntArray]) -> None:
    """Write a Parquet file of two columns of int64, a row group for each part (k, 2)."""
    import pyarrow as pa

    schema = pa.schema([(name, pa.int64()) for name in names])
    columns = ([pa.array(np.ascontiguousarray(part[:, k])) for k in (0, 1)] for part in parts)
    write_batches(path, schema, (pa.record_batch(each, schema=schema) for each in columns))


def check_room(folder: Path, needed: int) -> None:
    """Refuse a folder whose file system has not so many bytes left."""
    import shutil

    free = shutil.disk_usage(folder).free
    if free < needed:
        raise InputError(
            f"{folder} has {free / 1e9:.1f} GB left, and about {needed / 1e9:.1f} GB are needed: "
            "make room or give another folder"
        )
