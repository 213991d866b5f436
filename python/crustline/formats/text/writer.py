"""Points and curves as columns of text."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.curves import Curves
from crustline.formats.attributes import attributes_of, table_of, texts
from crustline.formats.target import Target
from crustline.points import Points

__all__ = ["write_curves", "write_points", "write_xyz"]

Column = npt.NDArray[Any]


def write_curves(curves: Curves, target: Target, delimiter: str) -> None:
    """Write curve, order, row, x, y, z, closed, then the other columns."""
    rows = np.concatenate([curves.indices, curves.isolated])
    columns = _result_columns(curves)
    attributes = attributes_of(curves, reserved=columns)
    if attributes.z is None:
        del columns["z"]
    else:
        columns["z"] = attributes.z[rows]
    columns |= {name: values[rows] for name, values in attributes.columns.items()}
    target.write(_table(columns, delimiter))


def write_points(points: Points, target: Target, delimiter: str) -> None:
    """Write the coordinates, z, the other columns, so that reading finds the same coordinates."""
    target.write(_table(table_of(points), delimiter))


def write_xyz(points: Points, target: Target) -> None:
    """Write lines of x, y and z if there is one; names only where there are no points."""
    heights = [] if points.z is None else [points.z]
    cells = [texts(values) for values in (*points.xy.T, *heights)]
    lines = [" ".join(row) for row in zip(*cells, strict=True)] or ["x y"]
    target.write("\n".join([*lines, ""]))


def _table(columns: dict[str, Column], separator: str) -> str:
    header = separator.join(_quoted(list(columns), separator, names=True))
    cells = [_cells(values, separator) for values in columns.values()]
    return "\n".join([header, *map(separator.join, zip(*cells, strict=True)), ""])


def _result_columns(curves: Curves) -> dict[str, Column]:
    sizes, alone = np.diff(curves.offsets), len(curves.isolated)
    rows = np.concatenate([curves.indices, curves.isolated])
    order = np.arange(len(curves.indices)) - np.repeat(curves.offsets[:-1], sizes)
    closed = np.concatenate([np.repeat(curves.closed, sizes), np.zeros(alone, bool)])
    return {
        "curve": np.concatenate([np.repeat(np.arange(len(curves)), sizes), np.full(alone, -1)]),
        "order": np.concatenate([order, np.arange(alone)]),
        "row": rows,
        "x": curves.points.xy[rows, 0],
        "y": curves.points.xy[rows, 1],
        "z": rows,
        "closed": closed.astype(int),
    }


def _cells(values: Column, separator: str) -> list[str]:
    cells = texts(values)
    return _quoted(cells, separator) if values.dtype.kind in "USO" else cells


def _quoted(cells: Collection[str], separator: str, names: bool = False) -> list[str]:
    """Return cells in quotes where the text holds what would end a cell, or be left out of one."""
    special = re.compile(f'[{separator}"\r\n]|^[\\s#]' + (r"|\s$|^$|^[%!*;/>&]" if names else ""))
    return [f'"{c.replace(chr(34), 2 * chr(34))}"' if special.search(c) else c for c in cells]
