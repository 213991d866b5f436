"""Columns that GPX takes: its own, each of one type, and extensions by names that XML takes."""

from __future__ import annotations

import re
import warnings
from typing import Any

from crustline.errors import FormatWarning, InputError
from crustline.formats.names import apart, quote_all

__all__ = ["as_extensions"]

# What a point has of its own (GPX 1.1, wptType), as GDAL calls it.
_TEXTS = {
    "name", "cmt", "desc", "src", "sym", "type", "fix",
    *(f"link{k}_{part}" for k in (1, 2) for part in ("href", "text", "type")),
}  # fmt: skip
_NUMBERS = {"ele", "magvar", "geoidheight", "hdop", "vdop", "pdop", "ageofdgpsdata"}
_WHOLE = {"sat", "dgpsid", "number"}
#: What GDAL counts tracks and routes by, and what stands before the names of extensions.
_RESERVED = re.compile(r"(track|route)_\w+|ogr_.*")
_UNFIT = re.compile(r"[^\w.-]")


def as_extensions(table: Any, height: str) -> Any:
    """Return a table whose columns GPX takes: input_NAME is what its own NAME has no room for.

    A character that no name of XML has becomes an underscore, with a warning. Whole numbers beyond
    32 bits become floats, for GDAL reads none of them. The first column may be that of the heights.
    """
    for k, column in enumerate(table.columns):
        table = table.set_column(k, table.column_names[k], _without_long_numbers(column))
    names = [
        name
        if (name == height and k == 0) or _fits(name, table.column(k).type)
        else f"input_{name}"
        for k, name in enumerate(table.column_names)
    ]
    spelled = [_UNFIT.sub("_", name) for name in names]
    changed = [name for name, other in zip(names, spelled, strict=True) if name != other]
    if changed:
        warnings.warn(
            f"names in GPX are of letters, digits, -, . and _: {quote_all(changed)} "
            "is spelled with _ for all else",
            FormatWarning,
            stacklevel=2,
        )
    return table.rename_columns(apart(spelled))


def _without_long_numbers(column: Any) -> Any:
    import pyarrow as pa

    if not pa.types.is_integer(column.type):
        return column
    extremes = pa.compute.min_max(column).as_py()
    if all(value is None or abs(value) < 2**31 for value in extremes.values()):
        return column
    try:
        return column.cast(pa.float64())
    except pa.ArrowInvalid:
        raise InputError(
            "a column holds whole numbers beyond 2⁵³, which GPX loses: write a GeoPackage"
        ) from None


def _fits(name: str, kind: Any) -> bool:
    """Return whether a column is no one that GPX has of its own, or of the type that it has."""
    import pyarrow as pa

    if name in _TEXTS:
        return bool(pa.types.is_string(kind))
    if name == "time":
        return bool(pa.types.is_timestamp(kind) or pa.types.is_date(kind))
    if name in _WHOLE:
        return bool(pa.types.is_integer(kind))
    if name in _NUMBERS:
        return name != "ele" and bool(pa.types.is_floating(kind) or pa.types.is_integer(kind))
    return _RESERVED.fullmatch(name) is None
