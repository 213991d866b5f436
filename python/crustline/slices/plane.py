"""Planes that things in space are cut by, as a caller or the command writes them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from itertools import islice
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, not_too_deep
from crustline.errors import InputError, shown
from crustline.records import Record
from crustline.scalars import as_real

__all__ = ["Plane", "as_planes", "section"]

#: Slices that one run makes at the most.
_MOST = 100_000
_LARGEST = 1e60
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_WRITE = "write z=12.5, z=0:30:0.5 (from, to, step), or A,B,C=D for the plane Ax + By + Cz = D"


@dataclass(frozen=True, eq=False)
class Plane(Record):
    """A plane in space with axes of its own; a section is the strip of a vertical one.

    Attributes
    ----------
    name : str
        What a layer of its slice is called, such as "z=12.5".
    normal, across, up : ndarray of float64, shape (3,)
        Unit vectors, right-handed: across × up = normal. In a horizontal plane across and up are x
        and y; in others across is level, and up is the steepest way up.
    origin : ndarray of float64, shape (3,)
        The point with the plane coordinates (0, 0).
    offset : float
        normal · origin.
    ends : tuple of float, optional
        The least and greatest coordinate across, of a section.
    """

    name: str
    normal: FloatArray
    across: FloatArray
    up: FloatArray
    origin: FloatArray
    offset: float
    ends: tuple[float, float] | None = None

    @property
    def is_horizontal(self) -> bool:
        """Whether plane coordinates are x and y."""
        return bool(self.normal[2] == 1)

    def project(self, xyz: FloatArray) -> FloatArray:
        """Return the plane coordinates of points in space, shape (n, 2); exact along axes."""
        moved = xyz - self.origin
        return np.stack([_along(moved, self.across), _along(moved, self.up)], axis=1)

    def lift(self, uv: FloatArray) -> FloatArray:
        """Return the points in space of plane coordinates, shape (n, 3)."""
        xyz: FloatArray = self.origin + uv[:, :1] * self.across + uv[:, 1:] * self.up
        return xyz

    def __repr__(self) -> str:
        return f"<Plane {self.name}>"


def _along(xyz: FloatArray, axis: FloatArray) -> FloatArray:
    """Return how far points are along an axis; no product with 0 is summed up."""
    used = np.flatnonzero(axis)
    total: FloatArray = xyz[:, used[0]] * axis[used[0]]
    for k in used[1:]:
        total = total + xyz[:, k] * axis[k]
    return total


def as_planes(planes: Any) -> list[Plane]:
    """Return planes of what a caller gives: planes, texts, or a sequence of these."""
    each = [planes] if isinstance(planes, str | Plane) else planes
    try:
        every = list(islice(each, _MOST + 1))
    except TypeError:  # an array of no dimension, too, has no elements
        raise InputError(f"planes is {shown(planes)}: {_WRITE}") from None
    if len(every) > _MOST:
        raise InputError(f"there are more than {_MOST:,} planes: slice by fewer at once")
    found: list[Plane] = []
    for one in every:
        found += [one] if isinstance(one, Plane) else _of_text(one)
    if not found:
        raise InputError(f"there is no plane to slice by: {_WRITE}")
    return _named_once(found)


def _named_once(planes: Sequence[Plane]) -> list[Plane]:
    names = [plane.name for plane in planes]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"the plane {name} is given more than once: give each once")
    return list(planes)


def _of_text(text: Any) -> list[Plane]:
    """Return the planes of "z=12.5", of a range, or of any normal."""
    if not isinstance(text, str) or text.count("=") != 1:
        raise InputError(f"the plane {shown(text)} is not understood: {_WRITE}")
    left, _, right = (part.strip() for part in text.partition("="))
    normal = _AXES.get(left.lower()) or _numbers(left, 3, text)
    word = left.lower() if left.lower() in _AXES else left.replace(" ", "")
    return [_plane(f"{word}={_shortest(at)}", normal, float(at)) for at in _offsets(right, text)]


def _numbers(text: str, count: int, whole: str) -> tuple[float, ...]:
    try:
        numbers = tuple(map(float, text.split(",")))
    except ValueError:
        numbers = ()
    if len(numbers) != count or not all(abs(each) < _LARGEST for each in numbers):
        raise InputError(f"the plane {shown(whole)} is not understood: {_WRITE}")
    return numbers


def _offsets(text: str, whole: str) -> list[Decimal]:
    """Return the offsets of D, or of START:STOP:STEP, both ends included; decimal, as written."""
    try:
        parts = [Decimal(part) for part in text.split(":")]
    except InvalidOperation:
        parts = []
    if len(parts) not in (1, 3) or not all(
        each.is_finite() and abs(each) < _LARGEST for each in parts
    ):
        raise InputError(f"the plane {shown(whole)} is not understood: {_WRITE}")
    if len(parts) == 1:
        return parts
    start, stop, step = parts
    if step <= 0 or stop < start:
        raise InputError(
            f"the planes {shown(whole)} go nowhere: write START:STOP:STEP, all upwards"
        )
    count = int((stop - start) / step) + 1
    if count > _MOST:
        raise InputError(f"{shown(whole)} are {count:,} planes: {_MOST:,} are the most")
    return [start + k * step for k in range(count)]


def _shortest(number: Decimal) -> str:
    text = f"{number + 0:f}"  # no -0
    return (text.rstrip("0").rstrip(".") if "." in text else text) or "0"


def _plane(name: str, normal: Sequence[float], at: float) -> Plane:
    """Return the plane normal · x = at; of its two sides, the one from which across leads right."""
    length = math.hypot(*normal)
    if length == 0:
        raise InputError(f"the plane {name} has the normal 0,0,0: give another one")
    unit, offset = np.array(normal) / length, at / length
    level = np.array([-unit[1], unit[0], 0.0]) if unit[:2].any() else np.array([unit[2], 0, 0])
    across = level / math.hypot(*level)
    if tuple(across[:2]) < (0.0, 0.0):
        unit, across, offset = -unit, -across, -offset
    unit, across = unit + 0.0, across + 0.0  # no -0
    return Plane(name, unit, across, np.cross(unit, across) + 0.0, unit * offset + 0.0, offset)


def section(line: Any, *, name: str = "") -> Plane:
    """Return the vertical strip above and below a line from (x0, y0) to (x1, y1).

    Across is the distance from the first end, up is z.
    """
    if not isinstance(name, str):
        raise InputError(f"the name {shown(name)} of a section is not text: give text")
    numbers = _line_of(line)
    x0, y0, x1, y1 = (as_real("section", each) for each in numbers)
    length = math.hypot(x1 - x0, y1 - y0)
    if not 0 < length < _LARGEST:
        raise InputError(f"the section {shown(line)} has the length {length:g}: give two places")
    across = np.array([(x1 - x0) / length, (y1 - y0) / length, 0.0])
    normal = np.array([across[1], -across[0], 0.0])
    origin = np.array([x0, y0, 0.0])
    label = name or "section " + ",".join(f"{each:g}" for each in numbers)
    return Plane(
        label, normal, across, np.array([0.0, 0.0, 1.0]), origin, float(normal @ origin),
        (0.0, length),
    )  # fmt: skip


def _line_of(line: Any) -> list[float]:
    try:
        is_text = isinstance(line, str)
        parts = line.split(",") if is_text else np.ravel(not_too_deep(line, most=2)).tolist()
        numbers = list(map(float, parts))
    except (TypeError, ValueError, OverflowError):
        numbers = []
    if len(numbers) != 4:
        raise InputError(f"the section {shown(line)} is no line: write x0,y0,x1,y1")
    return numbers
