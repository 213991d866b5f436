"""Lines cut at the 180th meridian, as RFC 7946 (3.1.9) asks for, and put together again."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["crosses", "cut", "uncut"]

Position = list[float]


def crosses(line: list[Position]) -> bool:
    """Return whether two neighbors along a line are nearer across the 180th meridian."""
    longitudes = np.array([position[0] for position in line])
    return bool((np.abs(np.diff(longitudes)) > 180).any())


def cut(line: list[Position]) -> tuple[list[list[Position]], list[int]]:
    """Return the pieces of a line, and which of their positions, counted through, are not its own.

    Examples
    --------
    >>> cut([[179.0, 1.0], [-179.0, 3.0]])
    ([[[179.0, 1.0], [180.0, 2.0]], [[-180.0, 2.0], [-179.0, 3.0]]], [1, 2])
    """
    pieces: list[list[Position]] = [[]]
    added: list[int] = []

    def add(position: Position, own: bool) -> None:
        if not own:
            added.append(sum(map(len, pieces)))
        pieces[-1].append(position)

    for position, after in zip(line, [*line[1:], line[-1]], strict=True):
        add(position, True)
        if abs(after[0] - position[0]) > 180:
            leave, enter = _crossing(position, after)
            if leave != position or len(pieces[-1]) < 2:
                add(leave, False)
            pieces.append([])
            if enter != after:
                add(enter, False)
    if len(pieces[-1]) < 2:  # no line has one position
        add(pieces[-1][0], False)
    return pieces, added


def _crossing(a: Position, b: Position) -> tuple[Position, Position]:
    """Return the place where two positions are joined across the meridian, on either side of it."""
    side = 180.0 if a[0] > b[0] else -180.0
    before, behind = abs(side - a[0]), abs(-side - b[0])
    share = before / (before + behind) if before + behind else 0.0
    rest = [p + share * (q - p) if 0 < share < 1 else (q if share else p)
            for p, q in zip(a[1:], b[1:], strict=True)]  # fmt: skip
    return [side, *rest], [-side, *rest]


def uncut(geometry: Any, added: Any) -> Any:
    """Return the line that was cut, without the positions added there; None if that is not so."""
    sound = isinstance(geometry, dict) and geometry.get("type") == "MultiLineString"
    if not sound or not isinstance(added, list) or not all(type(each) is int for each in added):
        return None
    try:
        line = [position for piece in geometry["coordinates"] for position in piece]
        there = all(0 <= each < len(line) and abs(line[each][0]) == 180 for each in added)
    except (KeyError, TypeError, IndexError):
        return None
    if not there:
        return None
    left = set(added)
    kept = [position for k, position in enumerate(line) if k not in left]
    return {"type": "LineString", "coordinates": kept}
