"""The one door for input: what a caller gives becomes plain arrays, or an `InputError`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from numbers import Real
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.errors import InputError, shown

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]

#: Rows that NumPy works on at a time in long calls: Ctrl-C is heard between two of its calls only.
PART = 1 << 17


def in_parts(count: int) -> Iterator[slice]:
    """Yield successive ranges of about the same length, at most `PART`, that cover `count` rows."""
    bounds = np.linspace(0, count, max(1, -(-count // PART)) + 1).astype(int).tolist()
    return (slice(a, b) for a, b in pairwise(bounds))


def as_points(points: npt.ArrayLike) -> FloatArray:
    """Return points as a plain, finite, C-contiguous float64 array of shape (n, 2).

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates, in any one unit. An empty sequence is no points at all.

    Returns
    -------
    points : ndarray of float64, shape (n, 2)
        The same rows in the same order; the caller's own memory where it already fits.

    Raises
    ------
    InputError
        If `points` is not (n, 2); if it holds text, complex numbers, Python objects or masked rows;
        if a coordinate is not finite, or is no float64 exactly. The message names the first row at
        fault.

    Notes
    -----
    Nothing is rounded: an integer or long double that float64 cannot hold is refused. O(n) time,
    and no copy for a C-contiguous float64 array.

    Examples
    --------
    >>> as_points([(0, 0), (3, 4)])
    array([[0., 0.],
           [3., 4.]])
    """
    array = _as_array(points)
    if array.ndim == 0:
        raise InputError(_name_bad_row(points))
    if array.ndim == 1 and array.size == 0:
        array = np.empty((0, 2))
    _check_dtype(array, points)
    _check_shape(array)
    coordinates = _as_float64(array)
    row = _core.first_not_finite(coordinates)
    if row is not None:
        column = int(np.isfinite(coordinates[row, 0]))
        raise InputError(
            f"points: row {row} has {coordinates[row, column]} in column {column}, "
            "which is not finite: remove or repair the row"
        )
    return coordinates


def as_floats(name: str, values: npt.ArrayLike) -> FloatArray:
    """Return real numbers of any shape as float64, or an `InputError` that names them.

    Examples
    --------
    >>> as_floats("t", [0, 1])
    array([0., 1.])
    """
    try:
        array = np.asarray(not_too_deep(values, most=8))
        if array.dtype.kind == "O" and all(_is_real(each) for each in array.flat):
            array = array.astype(np.float64)
    except (ValueError, TypeError, OverflowError):
        array = np.array("")
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name} must be a number or an array of numbers, not {shown(values)}")
    return array.astype(np.float64)


def _is_real(value: object) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool | np.bool_)


def not_too_deep(values: Any, most: int) -> Any:
    """Return sequences of sequences if they are not nested more than so often.

    What holds itself is nested without end, and NumPy would look for it.
    """
    inner = values
    for _ in range(most + 1):
        if isinstance(inner, np.ndarray | np.generic | str | bytes) or hasattr(inner, "__array__"):
            return values
        if not (hasattr(inner, "__len__") and hasattr(inner, "__getitem__")):
            return values
        try:
            inner = inner[0]
        except Exception:  # someone else's code; an empty sequence, or a mapping
            return values
    raise ValueError("too deep")


def _as_array(points: npt.ArrayLike) -> npt.NDArray[Any]:
    if type(points) is np.ndarray:
        return points
    if isinstance(points, np.ma.MaskedArray) and np.ma.is_masked(points):
        row = int(np.argwhere(np.ma.getmaskarray(points))[0][0])
        raise InputError(f"points: row {row} is masked: remove the masked rows first")
    try:
        return np.asarray(not_too_deep(points, most=3))
    except (ValueError, TypeError, OverflowError):
        raise InputError(_name_bad_row(points)) from None


def _check_dtype(array: npt.NDArray[Any], points: npt.ArrayLike) -> None:
    if array.dtype.kind in "fiu":
        return
    if array.dtype.kind == "c":
        raise InputError(
            f"points: row 0 is complex, {array.flat[0] if array.size else array.dtype}: "
            "pass the real and imaginary parts as two columns"
        )
    raise InputError(_name_bad_row(points))


def _check_shape(array: npt.NDArray[Any]) -> None:
    if array.ndim != 2 or array.shape[1] != 2:
        advice = (
            "pass points[:, :2]" if array.ndim == 2 and array.shape[1] > 2 else "pass rows of x, y"
        )
        raise InputError(f"points: the shape is {array.shape}, not (n, 2): {advice}")


def _as_float64(array: npt.NDArray[Any]) -> FloatArray:
    if array.dtype == np.float64 and array.flags.c_contiguous and array.flags.aligned:
        return array
    with np.errstate(over="ignore"):
        coordinates = np.require(array, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    wide = array.dtype.itemsize > 8 or (array.dtype.kind in "iu" and array.dtype.itemsize == 8)
    if wide:
        _check_exact(array, coordinates)
    return coordinates


def _check_exact(array: npt.NDArray[Any], coordinates: FloatArray) -> None:
    """Refuse values that float64 rounds; beyond 2**53 only some integers have a float64."""
    if array.dtype.kind in "iu":
        suspects = np.abs(coordinates) >= 2.0**53
    else:
        suspects = (coordinates != array) & ~np.isnan(coordinates)
    for row, column in np.argwhere(suspects):
        value = array[row, column]
        if array.dtype.kind == "f" or int(value) != int(coordinates[row, column]):
            raise InputError(
                f"points: row {row} has {value}, which float64 cannot hold exactly: "
                "subtract an offset or round it yourself"
            )


def _name_bad_row(points: Any) -> str:
    """Return the sentence about the first row that is not a pair of numbers."""
    scalar = isinstance(points, str | bytes | np.generic) or getattr(points, "ndim", 1) == 0
    if scalar or not isinstance(points, Iterable):
        return f"points: {shown(points)} is not an array of shape (n, 2): pass rows of x, y"
    if iter(points) is points:
        return f"points: {type(points).__name__} is not an array: pass a list of rows of x, y"
    for number, row in enumerate(points):
        fault = _fault_of_row(row)
        if fault:
            return f"points: row {number} {fault}: pass rows of two numbers x, y"
    return "points: the values are Python objects, not numbers: convert them to float64"


def _fault_of_row(row: Any) -> str | None:
    if isinstance(row, str | bytes) or not hasattr(row, "__len__"):
        return f"is {shown(row)}"
    if len(row) != 2:
        return f"has {len(row)} values"
    for value in row:
        if not _is_real(value):
            return f"has {shown(value)}, which is not a real number"
    return None


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return the array, which can be written no more."""
    array.flags.writeable = False
    return array


def equal(one: object, other: object) -> bool:
    """Return whether two values are equal: arrays by shape and elements, NaN to NaN.

    Numbers of different types are compared by value, as NumPy does.
    """
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        floats = one.dtype.kind in "fc" and other.dtype.kind in "fc"
        return np.array_equal(one, other, equal_nan=floats)
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return list(one) == list(other) and all(equal(one[name], other[name]) for name in one)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(equal, one, other))
    return type(one) is type(other) and bool(one == other)


def as_rows(rows: npt.ArrayLike, n: int) -> IntArray:
    """Return some rows of n, given by their numbers, or by whether each is one of them.

    Examples
    --------
    >>> as_rows([True, False, True], 3).tolist(), as_rows([2, 0], 3).tolist()
    ([0, 2], [2, 0])
    """
    try:
        array = np.asarray(not_too_deep(rows, most=2))
    except (ValueError, TypeError, OverflowError):
        raise InputError("rows: they are not all integers: pass a flat list of rows") from None
    if array.dtype.kind == "b" and array.shape == (n,):
        return np.flatnonzero(array)
    if array.size == 0 and array.ndim == 1:
        return np.empty(0, np.int64)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise InputError(
            f"rows: {array.dtype} of the shape {array.shape} are no rows of {n} points: "
            "pass a flat list of integers, or of a bool for each"
        )
    wrong = (array < 0) | (array >= n)
    if wrong.any():
        raise InputError(
            f"rows: {array[np.argmax(wrong)]} is none of the {n} points, 0 to {n - 1}: "
            "pass rows of these points"
        )
    return array.astype(np.int64)


def as_edges(edges: npt.ArrayLike, n: int, *, kept: bool = True) -> IntArray:
    """Return edges between n points as int64 rows i < j, sorted and unique.

    Parameters
    ----------
    edges : array_like of int, shape (m, 2)
        Rows of points, in any order and direction; a repeated edge counts once.
    n : int
        The number of points.
    kept : bool, default True
        Whether they are kept, so that the caller must not be able to change them: then an array
        that can be written is copied, and else it serves as it is if its edges are like this.

    Returns
    -------
    edges : ndarray of int64, shape (m, 2)
        i < j in each row, rows sorted, unique. Read-only if they are kept.

    Raises
    ------
    InputError
        If `edges` is not (m, 2), holds anything but integers from 0 to n - 1, or joins a point to
        itself. The message names the first row at fault.

    Examples
    --------
    >>> as_edges([(2, 1), (0, 1), (1, 2)], 3).tolist()
    [[0, 1], [1, 2]]
    """
    try:
        array = np.asarray(not_too_deep(edges, most=3))
    except (ValueError, TypeError, OverflowError):
        raise InputError(
            "edges: the rows are not all pairs of integers: pass rows of i, j"
        ) from None
    if array.size == 0 and array.shape in ((0,), (0, 2)):
        return np.empty((0, 2), dtype=np.int64)
    if array.ndim != 2 or array.shape[1] != 2:
        raise InputError(f"edges: the shape is {array.shape}, not (m, 2): pass rows of i, j")
    if array.dtype.kind not in "iu":
        raise InputError(
            f"edges: row 0 is {array[0].tolist()}, not two integers: pass rows of i, j"
        )
    if array.dtype == np.int64 and array.flags.c_contiguous and _core.is_canonical(array, n):
        return read_only(array.copy()) if kept and array.flags.writeable else array
    _check_ends(array, n)
    return read_only(_canonical(np.ascontiguousarray(array, dtype=np.int64), n))


def _check_ends(edges: npt.NDArray[Any], n: int) -> None:
    if edges.min() < 0 or edges.max() >= n:
        row = int(np.argmax(((edges < 0) | (edges >= n)).any(axis=1)))
        raise InputError(
            f"edges: row {row} is {edges[row].tolist()}, but there are {n} points, 0 to {n - 1}: "
            "pass edges of these points"
        )
    loops = edges[:, 0] == edges[:, 1]
    if loops.any():
        row = int(np.argmax(loops))
        raise InputError(f"edges: row {row} joins point {edges[row, 0]} to itself: remove it")


def _canonical(edges: IntArray, n: int) -> IntArray:
    """Sort edges by one int64 key each."""
    # Not by np.unique, which hashes integers first and on millions takes many times as long.
    keys = np.sort(edges.min(axis=1) * n + edges.max(axis=1))
    keys = keys[np.append(True, keys[1:] != keys[:-1])]
    return np.stack(np.divmod(keys, n), axis=1)
