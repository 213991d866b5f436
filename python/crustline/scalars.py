"""The door for single numbers: what a caller gives becomes a float or int, or an `InputError`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from numbers import Integral, Real

import numpy as np

from crustline.errors import InputError, shown

__all__ = [
    "LARGEST",
    "MOST_POINTS",
    "SMALLEST",
    "as_choice",
    "as_degrees",
    "as_flag",
    "as_length",
    "as_positive",
    "as_real",
    "as_rtol",
    "as_share",
    "as_size",
    "as_whole",
]

#: Sizes of smooth curves: for others the cubes of speeds, and more, leave the range of float64.
SMALLEST, LARGEST = 1e-60, 1e60
#: Points that a function makes on demand, at the most: they need a few gigabytes.
MOST_POINTS = 10**8


def as_real(
    name: str,
    value: object,
    wanted: str = "a finite number",
    fits: Callable[[float], bool] = math.isfinite,
) -> float:
    """Return a finite number that fits as float; `wanted` is what the message says it must be."""
    number = _as_float(value)
    if not (math.isfinite(number) and fits(number)):
        raise _refusal(name, wanted, value)
    return number


def as_positive(name: str, value: object) -> float:
    """Return a finite number above 0 as float."""
    return as_real(name, value, "positive and finite", lambda x: x > 0)


def as_length(name: str, value: object) -> float:
    """Return a finite number of at least 0 as float."""
    return as_real(name, value, "a length of at least 0", lambda x: x >= 0)


def as_size(name: str, value: object) -> float:
    """Return a positive number that is a size of a smooth curve."""
    wanted = f"between {SMALLEST:g} and {LARGEST:g}"
    as_positive(name, value)
    return as_real(name, value, wanted, lambda x: SMALLEST <= x <= LARGEST)


def as_share(name: str, value: object) -> float:
    """Return a number above 0, and 1 at the most."""
    return as_real(name, value, "in (0, 1]", lambda x: 0 < x <= 1)


def as_degrees(name: str, value: object) -> float:
    """Return the least turn of a corner, in degrees."""
    return as_real(name, value, "in degrees, in (0, 180]", lambda x: 0 < x <= 180)


def as_rtol(value: object) -> float:
    """Return a relative error that computations with smooth curves can be asked for."""
    return as_real("rtol", value, "in [1e-6, 0.1]", lambda x: 1e-6 <= x <= 0.1)


def as_whole(name: str, value: object, low: int, high: int | None = None) -> int:
    """Return a whole number in a range, both ends included, as int."""
    whole = isinstance(value, Integral) or _as_float(value).is_integer()
    if whole and not isinstance(value, bool | np.bool_):
        number = int(value)  # type: ignore[call-overload]
        if low <= number and (high is None or number <= high):
            return int(number)
    span = f"of at least {low}" if high is None else f"from {low} to {high}"
    raise _refusal(name, f"a whole number {span}", value)


def as_flag(name: str, value: object) -> bool:
    """Return True or False."""
    if isinstance(value, bool | np.bool_):
        return bool(value)
    raise _refusal(name, "True or False", value)


def as_choice(name: str, value: object, choices: Sequence[str]) -> str:
    """Return a word that is one of the choices."""
    if isinstance(value, str) and value in choices:
        return value
    raise InputError(f"{name} must be {' or '.join(map(repr, choices))}, not {shown(value)}")


def _as_float(value: object) -> float:
    """Return a real number as float, and NaN for anything else; infinity if it is too large."""
    if not isinstance(value, Real) or isinstance(value, bool | np.bool_):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _refusal(name: str, wanted: str, value: object) -> InputError:
    # NumPy's numbers are shown as Python's.
    plain = value.item() if isinstance(value, np.generic) else value
    return InputError(f"{name} must be {wanted}, not {shown(plain)}")
