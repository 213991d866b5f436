"""Orientation: in which direction rings run, and where curves start.

Which rings are holes depends on all of them, so rules for shells and holes need the nesting. The
ring's direction before is known: `trace` gives counter-clockwise ones, exactly.
"""

from __future__ import annotations

from numbers import Integral
from typing import cast

import numpy as np
import numpy.typing as npt

from crustline.arrays import BoolArray, FloatArray, IntArray, as_floats
from crustline.errors import InputError, shown
from crustline.scalars import as_choice

__all__ = ["COMPASS", "ORIENTATIONS", "arranged", "starts_of", "turns_of"]

#: For each rule whether shells, and whether holes run counter-clockwise.
ORIENTATIONS = {
    "ccw": (True, True),
    "cw": (False, False),
    "rfc7946": (True, False),
    "gis": (False, True),
}
#: For each direction the coordinate, and its sign, that is least where a curve starts.
COMPASS = {"west": (0, 1.0), "east": (0, -1.0), "south": (1, 1.0), "north": (1, -1.0)}


def turns_of(rule: str | None, shells: IntArray) -> BoolArray:
    """Return which rings run counter-clockwise by a rule; all of them by none.

    `shells` has for each ring its shell (itself, if it is one), and -1 for a polyline.
    """
    if rule is None:
        return np.ones(len(shells), dtype=np.bool_)
    of_shells, of_holes = ORIENTATIONS[as_choice("orient", rule, tuple(ORIENTATIONS))]
    is_hole = (shells >= 0) & (shells != np.arange(len(shells)))
    return np.where(is_hole, of_holes, of_shells)


def arranged(
    indices: IntArray, offsets: IntArray, starts: IntArray, backwards: BoolArray
) -> IntArray:
    """Return the rows of curves from other starts on, some of them backwards.

    Parameters
    ----------
    indices, offsets : ndarray of int64
        The curves, as `Curves` holds them.
    starts : ndarray of int64, shape (c,)
        The place in each curve at which it is to start; an end, if it is a polyline.
    backwards : ndarray of bool, shape (c,)
        Whether each is run through against its present direction.

    Examples
    --------
    >>> ring = np.array([5, 6, 7, 8])
    >>> arranged(ring, np.array([0, 4]), np.array([1]), np.array([True])).tolist()
    [6, 5, 8, 7]
    """
    sizes = np.diff(offsets)
    curve = np.repeat(np.arange(len(sizes)), sizes)
    steps = (np.arange(len(indices)) - offsets[curve]) * np.where(backwards, -1, 1)[curve]
    found: IntArray = indices[offsets[curve] + (starts[curve] + steps) % sizes[curve]]
    return found


def starts_of(
    start: object, xy: FloatArray, indices: IntArray, offsets: IntArray, closed: BoolArray
) -> IntArray:
    """Return the place in each curve at which it is to start; polylines start at an end.

    Ties go to the smallest row.
    """
    sizes = np.diff(offsets)
    if isinstance(start, Integral) and not isinstance(start, bool):
        return _places_of_row(int(start), indices, offsets, closed)
    cost = _cost(start, xy[indices])
    curve = np.repeat(np.arange(len(sizes)), sizes)
    place = np.arange(len(indices)) - offsets[curve]
    inside = ~closed[curve] & (place > 0) & (place < sizes[curve] - 1)
    best = np.lexsort((indices, cost, inside, curve))[offsets[:-1]]
    found: IntArray = best - offsets[:-1]
    return found


def _places_of_row(row: int, indices: IntArray, offsets: IntArray, closed: BoolArray) -> IntArray:
    places = np.zeros(len(closed), dtype=np.int64)
    found = False
    for position in np.flatnonzero(indices == row).tolist():
        curve = int(np.searchsorted(offsets, position, "right")) - 1
        place, last = position - int(offsets[curve]), int(offsets[curve + 1] - offsets[curve]) - 1
        if closed[curve] or place in (0, last):
            places[curve], found = place, True
    if not found:
        given = shown(row, 30)
        raise InputError(f"start is row {given}, on no ring and at no end: give another row")
    return places


def _cost(start: object, xy: FloatArray) -> FloatArray:
    """Return how far each point is from being the start."""
    if isinstance(start, str) and start in COMPASS:
        axis, sign = COMPASS[start]
        return xy[:, axis] * sign
    try:
        place = as_floats("start", cast("npt.ArrayLike", start))
    except InputError:
        place = np.zeros(0)
    if place.shape != (2,) or not np.isfinite(place).all():
        words = ", ".join(COMPASS)
        raise InputError(f"start is {shown(start)}: give x and y, a row, or one of {words}")
    steps = xy - place
    return np.hypot(steps[:, 0], steps[:, 1])
