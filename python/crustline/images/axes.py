"""The axes of a digitized plot: from pixels to the numbers that the plot shows."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from crustline.arrays import FloatArray
from crustline.errors import InputError, shown

__all__ = ["Axes"]

_ADVICE = (
    "give places as COLUMN,ROW=X,Y, such as '60,430=0,0 560,30=10,100', and log=x, log=y or log=xy "
    "where an axis is logarithmic; X or Y may be left away"
)
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_PLACE = re.compile(rf"({_NUMBER}),({_NUMBER})=({_NUMBER})?,({_NUMBER})?")


@dataclass(frozen=True)
class Axes:
    """What the axes of a plot say of its pixels.

    `Axes.parse` makes them of text such as ``"60,430=0,1 560,30=10,1e4 log=y"``: at the left of
    each sign a place in the picture, column and row as viewers show them, from 0 at the upper left
    and downwards (the middle of a pixel is meant; fractions are allowed), at its right what the
    axes show there. A place may tell one axis only (``"60,430=0,"``, ``"60,30=,1e4"``).

    Two places that tell an axis are enough if the plot is not turned; with three or more that are
    not on a line a scan may be turned and skew, and more are fitted by least squares.

    Attributes
    ----------
    across, up : ndarray of float64, shape (3,)
        X is across[0] + across[1] · x + across[2] · y in pixel coordinates, or ten to that power;
        Y likewise by up.
    logarithmic : pair of bool
        Whether X, and whether Y, is on a logarithmic axis.

    Examples
    --------
    >>> axes = Axes.parse("0,100=0,1 100,0=10,100 log=y")
    >>> axes.place(np.array([(50.5, -50.5)])).round(9).tolist()
    [[5.0, 10.0]]
    """

    across: FloatArray
    up: FloatArray
    logarithmic: tuple[bool, bool]

    @classmethod
    def parse(cls, text: str) -> Axes:
        """Return the axes that a text says; an `InputError` says what is wrong with it."""
        places: list[list[float]] = []
        logarithmic = (False, False)
        for word in re.split(r"[\s;]+", text.strip()):
            if log := re.fullmatch(r"log=(x|y|xy|yx)", word):
                logarithmic = ("x" in log[1], "y" in log[1])
            elif match := _PLACE.fullmatch(word):
                places.append([np.nan if each is None else float(each) for each in match.groups()])
            else:
                raise InputError(f"axes: {shown(word)} is no place: {_ADVICE}")
        known = np.array(places, np.float64).reshape(-1, 4)
        spots = np.column_stack([known[:, 0] + 0.5, -0.5 - known[:, 1]])
        across, up = (_fitted(spots, known[:, 2 + k], k, logarithmic[k]) for k in range(2))
        return cls(across, up, logarithmic)

    def place(self, points: FloatArray) -> FloatArray:
        """Return what the axes show at points in pixel coordinates (k, 2)."""
        ones = np.column_stack([np.ones(len(points)), points])
        shown_at = ones @ np.column_stack([self.across, self.up])
        with np.errstate(over="ignore"):
            values: FloatArray = np.where(self.logarithmic, 10.0**shown_at, shown_at)
        if not np.isfinite(values).all():
            raise InputError("axes: they lead beyond all numbers within the picture: correct them")
        return values


def _fitted(spots: FloatArray, values: FloatArray, k: int, logarithmic: bool) -> FloatArray:
    """Return offset and slopes of an axis, from the places that tell it."""
    name = "XY"[k]
    told = ~np.isnan(values)
    spots, values = spots[told], values[told]
    if logarithmic and not (values > 0).all():
        raise InputError(f"axes: {name} is logarithmic and {values.min():g} at a place: correct it")
    values = np.log10(values) if logarithmic else values
    if len(np.unique(values)) < 2:
        raise InputError(f"axes: {name} is told by less than two different values: {_ADVICE}")
    free = [0, 1, 2] if _is_spread(spots) else [0, 1 + k]
    system = np.column_stack([np.ones(len(spots)), spots])[:, free]
    if np.linalg.matrix_rank(system) < len(free):
        raise InputError(f"axes: {name} has two values at one {'column' if k == 0 else 'row'}: "
                         "give other places")  # fmt: skip
    found = np.zeros(3)
    found[free] = np.linalg.lstsq(system, values, rcond=None)[0]
    return found


def _is_spread(spots: FloatArray) -> bool:
    """Whether places are so far off a line that they tell how a plot is turned."""
    if len(spots) < 3:
        return False
    sizes = np.linalg.svd(spots - spots.mean(axis=0), compute_uv=False)
    return bool(sizes[1] > 0.05 * sizes[0])
