"""Curves from the columns that `write_curves` gives: curve, order, row and closed."""

from __future__ import annotations

import numpy as np

from crustline.curves import Curves, trace
from crustline.formats.names import quote_all
from crustline.formats.source import Source
from crustline.formats.vertices import edges_along
from crustline.points import Points

__all__ = ["curves_of"]

_COLUMNS = ("curve", "order", "row", "closed")


def curves_of(points: Points, source: Source) -> Curves:
    """Return points that stand curve by curve, in the order of their rows, and joined."""
    columns = {name: points.columns.get(name) for name in _COLUMNS}
    numbers = all(column is not None and column.dtype == np.int64 for column in columns.values())
    if not numbers:
        raise source.error(
            f"curves need whole numbers {', '.join(_COLUMNS)} in columns, and there are "
            f"{quote_all(list(points.columns))}: read its points"
        )
    number, row, closed = (np.asarray(columns[name]) for name in ("curve", "row", "closed"))
    _, first, where = np.unique(row, return_index=True, return_inverse=True)
    starts = np.flatnonzero(np.diff(number, prepend=number[:1] - 1))
    sizes = np.diff(starts, append=len(number))
    edges = edges_along(sizes, number[starts] >= 0, closed[starts] == 1)
    rest = {name: column for name, column in points.columns.items() if name not in _COLUMNS}
    return trace(points.replace(columns=rest).select(first), where.reshape(-1)[edges])
