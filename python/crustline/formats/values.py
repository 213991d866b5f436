"""Values of columns between JSON and arrays."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.errors import InputError

__all__ = ["as_column", "as_json"]


def as_column(values: list[Any]) -> npt.NDArray[Any]:
    """Return bools, integers, floats (null is NaN) or text (null is empty, objects are JSON)."""
    kinds = set(map(type, values))
    if kinds == {bool}:
        return np.array(values, dtype=np.bool_)
    types: tuple[Any, ...] = (np.int64, np.uint64) if kinds == {int} else (np.float64,)
    numeric = kinds and kinds <= {int, float, type(None)}
    for kind in types if numeric else ():
        try:
            return np.array(values, dtype=kind)
        except OverflowError:
            continue
    return np.array([_as_word(value) for value in values], dtype=np.object_)


def _as_word(value: Any) -> str:
    if value is None:
        return ""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def as_json(name: str, values: npt.NDArray[Any]) -> list[Any]:
    """Return a column as values of JSON: NaN is null, dates and all else are text."""
    if values.dtype.kind == "f":
        if np.isinf(values).any():
            raise InputError(
                f"column {name!r:.60} holds an infinite value, which JSON does not know: replace it"
            )
        return [None if value != value else value for value in values.astype(float).tolist()]
    if values.dtype.kind == "S":
        values = np.char.decode(values, "utf-8", "replace")
    return values.tolist() if values.dtype.kind in "biuUO" else list(map(str, values))
