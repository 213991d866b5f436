"""The result of a run, in files; nothing is read before it is asked for."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from crustline.arrays import IntArray
from crustline.distributed.geoparquet import Ragged, table_of
from crustline.distributed.report import in_lines
from crustline.distributed.stitch import materialize
from crustline.errors import InputError


class Result:
    """Edges and curves in a folder.

    Parameters
    ----------
    folder : path-like
        Where a run has ended.

    Attributes
    ----------
    folder : Path
        Where everything is.
    counts : dict
        Rows, duplicates, edges, curves and isolated points, and tiles.
    report : dict
        What the run took: see `report.json`.
    edges : dask.dataframe.DataFrame
        Columns i and j of int64, i < j; sorted within each partition.
    curves : dask.dataframe.DataFrame
        Columns geometry (well-known binary), bbox, closed, first, length and rows: curves within
        tiles first, each partition with the isolated points of its tile; then those across tiles.
    duplicates : dask.dataframe.DataFrame
        Columns row and first: repeated rows, and the first with the same coordinates.
    """

    def __init__(self, folder: Any) -> None:
        self.folder = Path(folder)
        try:
            held = json.loads((self.folder / "crustline.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            raise InputError(f"{folder} holds no run: give the folder that one wrote") from None
        if held["counts"] is None:
            raise InputError(f"the run in {folder} has not ended: resume it first")
        self.counts: dict[str, int] = held["counts"]

    @cached_property
    def report(self) -> dict[str, Any]:
        """What the run took."""
        report: dict[str, Any] = json.loads(
            (self.folder / "report.json").read_text(encoding="utf-8")
        )
        return report

    @property
    def edges(self) -> Any:
        """All edges (i, j), lazy."""
        return _lazy(_read, self._files("edges"))

    @property
    def duplicates(self) -> Any:
        """All repeated rows (row, first), lazy."""
        return _lazy(_read, self._files("duplicates"))

    @property
    def curves(self) -> Any:
        """All curves, lazy: those across tiles are put together from their parts when asked for."""
        return _lazy(_read_curves, self._files("curves") + self._files("long"))

    def _files(self, name: str) -> list[Path]:
        return sorted((self.folder / name).glob("*.parquet"))

    def traced(self) -> list[tuple[IntArray, bool]]:
        """Return the rows of all curves in memory, each with whether it is a ring, sorted.

        Curves that lie within tiles and across them alike, as `crustline.trace` gives them;
        isolated points are no curves. For results that fit in memory.
        """

        found = [
            (rows, bool(closed))
            for path in self._files("curves") + self._files("long")
            for rows, closed in _rows(_curves_in(path))
            if len(rows) > 1
        ]
        return sorted(found, key=lambda each: each[0].tolist())

    def summary(self) -> str:
        """Return what the run took in a few lines: points seen, open, time, files, memory."""
        return "\n".join(in_lines(self.report))

    def __repr__(self) -> str:
        edges, curves, rows = (f"{self.counts[name]:,}" for name in ("edges", "curves", "rows"))
        return f"<Result in {self.folder}: {edges} edges, {curves} curves; {rows} rows>"


def _lazy(read: Callable[[Path], Any], files: list[Path]) -> Any:
    import dask.dataframe as dd

    return dd.from_map(read, files, meta=read(files[0]).iloc[:0])


def _read(path: Path) -> Any:
    return _table(path).to_pandas()


def _read_curves(path: Path) -> Any:
    import pandas as pd

    is_long = path.parent.name == "long"
    table = table_of(materialize(path.parents[1], path), None) if is_long else _table(path)
    # With Arrow's own types, as Dask takes bytes in objects for text.
    return table.to_pandas(types_mapper=pd.ArrowDtype)


def _table(path: Path, columns: list[str] | None = None) -> Any:
    from pyarrow import parquet

    return parquet.read_table(path, columns=columns, page_checksum_verification=True)


def _curves_in(path: Path) -> Ragged:
    """Return the curves in a file of curves, or of references to their parts."""
    if path.parent.name == "long":
        return materialize(path.parents[1], path)
    table = _table(path, ["rows", "closed"]).combine_chunks()
    rows = table["rows"].combine_chunks()
    flat, offsets = rows.values.to_numpy(), rows.offsets.to_numpy()
    closed = table["closed"].to_numpy()
    return Ragged(flat, np.empty((0, 2)), offsets, closed)


def _rows(curves: Ragged) -> Iterator[tuple[IntArray, bool]]:
    for k, closed in enumerate(curves.closed):
        yield curves.rows[curves.offsets[k] : curves.offsets[k + 1]], closed
