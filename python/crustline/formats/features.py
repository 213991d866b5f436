"""What a file that holds one row a curve says of it: its number, rows, length, and its columns."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import IntArray
from crustline.curves import Curves, Feature
from crustline.formats.arrow import as_arrow
from crustline.formats.attributes import attributes_of

__all__ = ["RESERVED", "curve_columns"]

RESERVED = ("curve", "closed", "length", "rows", "geometry")


def curve_columns(
    curves: Curves, features: Sequence[Feature], *, lists: bool = False
) -> dict[str, Any]:
    """Return a value per feature: curve, closed, length, rows, and the columns of the points.

    The isolated points are curve -1. With `lists`, `rows` and the columns are Arrow arrays of
    lists. Else `rows` is a JSON list; a column whose value is the same at all points of every
    feature keeps it; of others numbers become NAME_min, NAME_mean and NAME_max, and of the rest the
    different values are joined by semicolons.
    """
    rows = [feature.rows for feature in features]
    found: dict[str, Any] = {
        "curve": np.array([-1 if each.number is None else each.number for each in features]),
        "closed": np.array([feature.closed for feature in features], dtype=np.bool_),
        "length": np.array([_length(curves, feature) for feature in features]),
    }
    columns = attributes_of(curves, reserved=RESERVED).columns
    if lists:
        return found | _listed({"rows": np.arange(len(curves.points)), **columns}, rows)
    found["rows"] = _texts(each.tolist() for each in rows)
    for name, values in columns.items():
        found |= _aggregated(name, values, rows)
    return found


def _listed(columns: dict[str, npt.NDArray[Any]], rows: Sequence[IntArray]) -> dict[str, Any]:
    import pyarrow as pa

    offsets = np.concatenate([[0], np.cumsum([len(each) for each in rows])]).astype(np.int32)
    flat = np.concatenate([*rows, np.zeros(0, np.int64)]).astype(np.int64)
    lists: dict[str, Any] = {
        name: pa.ListArray.from_arrays(pa.array(offsets), as_arrow(values[flat]))
        for name, values in columns.items()
    }
    return lists


def _length(curves: Curves, feature: Feature) -> float:
    total = 0.0
    for run in () if feature.kind == "points" else feature.runs:
        steps = np.diff(curves.points.xy[run], axis=0)
        total += float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    return total


def _aggregated(
    name: str, values: npt.NDArray[Any], rows: Sequence[IntArray]
) -> dict[str, npt.NDArray[Any]]:
    groups = [values[each] for each in rows]
    if not groups:
        return {name: values[:0]}
    if all((group == group[0]).all() for group in groups):
        return {name: values[np.array([each[0] for each in rows])]}
    if values.dtype.kind in "fiu":
        kinds: dict[str, Callable[..., Any]] = {"min": np.min, "mean": np.mean, "max": np.max}
        return {f"{name}_{word}": np.array([f(g) for g in groups]) for word, f in kinds.items()}
    words = ["; ".join(dict.fromkeys(map(str, group.tolist()))) for group in groups]
    return {name: np.array(words, dtype=np.object_)}


def _texts(lists: Any) -> npt.NDArray[Any]:
    texts = [json.dumps(list(each), ensure_ascii=False) for each in lists]
    return np.array(texts, dtype=np.object_)
