"""Crowds: what falls on one spot of a picture is drawn once, so that millions take seconds."""

from __future__ import annotations

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.path import CLOSE, LINE, MOVE, Path

__all__ = ["CROWD", "is_crowd", "one_per_spot", "thinned"]

#: So many dots or vertices are a crowd.
CROWD = 100_000
#: Spots along the longer side: a dozen to a dot of a printed page, so that one may look closer.
SPOTS = 1 << 14
#: So many dots on as many spots are drawn on fewer: more than one to a pixel still.
TOO_MANY, FEWER_SPOTS = 1_000_000, 1 << 11


def is_crowd(drawn: FloatArray) -> bool:
    """Whether dots or vertices are so many that a vector format is given them as an image."""
    return len(drawn) >= CROWD


def _spots(xy: FloatArray, count: int = SPOTS) -> IntArray:
    """Return the number of the spot of each point, of so many along the longer side."""
    low = xy.min(axis=0)
    extent = float((xy.max(axis=0) - low).max()) or 1.0
    x, y = ((xy - low) * (count / extent)).astype(np.int64).T
    return np.asarray(x * (count + 1) + y)


def one_per_spot(xy: FloatArray, by: FloatArray | None = None) -> IntArray:
    """Return the rows of points (n, 2) to draw, sorted: of each spot the first, or the least `by`.

    All of them if they are no crowd.
    """
    if len(xy) < CROWD:
        return np.arange(len(xy))
    rows = _first_of(_spots(xy), by)
    return rows if len(rows) < TOO_MANY else _first_of(_spots(xy, FEWER_SPOTS), by)


def _first_of(spots: IntArray, by: FloatArray | None) -> IntArray:
    order = np.argsort(spots, kind="stable") if by is None else np.lexsort((by, spots))
    return np.sort(order[np.diff(spots[order], prepend=-1) > 0])


def thinned(path: Path) -> Path:
    """Return a path of lines without the steps that stay on their spot, and without repetition.

    A stroke of one step, or within one spot, is left out where there is one like it. The path is
    given back as it is if it is no crowd.
    """
    if len(path) < CROWD:
        return path
    spots = _spots(path.vertices)
    starts = path.codes == MOVE
    kept = starts | (spots != np.roll(spots, 1))
    # The last vertex of a stroke stays, or one within a spot would be a start that draws nothing.
    kept |= np.roll(starts, -1) & ~starts
    vertices, codes, spots = path.vertices[kept], path.codes[kept], spots[kept]
    codes = np.where(codes == CLOSE, LINE, codes).astype(np.uint8)
    first = np.flatnonzero(codes == MOVE)
    counts = np.diff(first, append=len(codes))
    short = first[counts == 2]
    pairs = np.sort(np.stack([spots[short], spots[short + 1]], axis=1), axis=1)
    again = np.ones(len(short), dtype=np.bool_)
    again[np.unique(pairs, axis=0, return_index=True)[1]] = False
    drawn = np.ones(len(codes), dtype=np.bool_)
    drawn[short[again]] = drawn[short[again] + 1] = False
    return Path(vertices[drawn], codes[drawn])
