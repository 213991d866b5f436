"""The door for single numbers: what a caller gives becomes a float or int, or an `InputError`."""

from __future__ import annotations

import math
from numbers import Integral, Real

import numpy as np

from crustline.errors import InputError

__all__ = ["LARGEST", "SMALLEST", "as_positive", "as_real", "as_size", "as_whole"]

#: Sizes of smooth curves: for others the cubes of speeds, and more, leave the range of float64.
SMALLEST, LARGEST = 1e-60, 1e60


def as_real(name: str, value: object, wanted: str = "a finite number") -> float:
    """Return a finite number as float; `wanted` is what the message says that it must be."""
    number = _as_float(value)
    if not math.isfinite(number):
        raise _refusal(name, wanted, value)
    return number


def as_positive(name: str, value: object) -> float:
    """Return a finite number above 0 as float."""
    number = _as_float(value)
    if not (number > 0 and math.isfinite(number)):
        raise _refusal(name, "positive and finite", value)
    return number


def as_size(name: str, value: object) -> float:
    """Return a positive number that is a size of a smooth curve."""
    number = as_positive(name, value)
    if not SMALLEST <= number <= LARGEST:
        raise _refusal(name, f"between {SMALLEST:g} and {LARGEST:g}", value)
    return number


def as_whole(name: str, value: object, low: int, high: int | None = None) -> int:
    """Return a whole number in a range, both ends included, as int."""
    whole = isinstance(value, Integral) or _as_float(value).is_integer()
    if whole and not isinstance(value, bool | np.bool_):
        number = int(value)  # type: ignore[call-overload]
        if low <= number and (high is None or number <= high):
            return int(number)
    span = f"of at least {low}" if high is None else f"from {low} to {high}"
    raise _refusal(name, f"a whole number {span}", value)


def _as_float(value: object) -> float:
    """Return a real number as float, and NaN for anything else; infinity if it is too large."""
    if not isinstance(value, Real) or isinstance(value, bool | np.bool_):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _refusal(name: str, wanted: str, value: object) -> InputError:
    shown = str(value) if isinstance(value, Real) else repr(value)
    return InputError(f"{name} must be {wanted}, not {shown[:60]}")
