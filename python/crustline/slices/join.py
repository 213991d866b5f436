"""A band of points to the curves that run through it: thinned, fitted, and its gaps decided."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay
from crustline.denoise import denoise
from crustline.errors import InputError
from crustline.methods import close_gaps, connect

__all__ = ["joined", "thinned"]

#: A band of thickness t is t / √12 deep in the sense of a standard deviation, if it is even.
_DEVIATION = 12**-0.5
#: Hints that hold for the points that curves are fitted along, too; the others are of the curves.
_OF_RIDGES = ("max_edge",)
#: Cells of a grid along an axis, at the most, for places in it to be exact.
_MOST_CELLS = 2**52


def joined(
    uv: FloatArray,
    scale: float | None,
    method: Callable[..., ArrayLike] = connect,
    hints: dict[str, Any] | None = None,
) -> Curves:
    """Return the curves of the points of a band, in its plane.

    Parameters
    ----------
    uv : ndarray of float64, shape (n, 2)
        Plane coordinates.
    scale : float, optional
        How wide the strokes of points are. Means of the points in cells of this size are fitted;
        None joins the points as they are.
    method : callable, default `connect`
        Joins the points.
    hints : dict, optional
        What is known of the curves, as `connect` takes it.
    """
    hints = hints or {}
    if scale is None or len(uv) < 3:
        delaunay = Delaunay(uv, threads=1)
        return trace(delaunay, method(delaunay, **hints))
    few = thinned(uv, scale)
    if len(few) < 3 or not np.ptp(few, axis=0).any():
        return trace(few, np.empty((0, 2), np.int64))
    extent = float(np.hypot(*np.ptp(few, axis=0)))
    noise = min(scale * _DEVIATION, extent / 4)
    along = partial(method, **{name: hints[name] for name in _OF_RIDGES if name in hints})
    fitted = denoise(Delaunay(few, threads=1), noise=noise, method=along).curves
    if method is not connect or not len(fitted.points):
        return fitted
    delaunay = Delaunay(fitted.points.xy, threads=1)
    return trace(delaunay, close_gaps(delaunay, fitted.edges, **hints))


def thinned(uv: FloatArray, cell: float) -> FloatArray:
    """Return the mean of the points in each cell of a grid, sorted by cells.

    The same for any order of the points: those of a cell are summed up in the order of their
    coordinates.

    Examples
    --------
    >>> thinned(np.array([(0.1, 0.1), (5.0, 5.0), (0.3, 0.1)]), 1.0)
    array([[0.2, 0.1],
           [5. , 5. ]])
    """
    with np.errstate(over="ignore"):
        cells = np.floor(uv / cell)
    if not (np.abs(cells) < _MOST_CELLS).all():
        raise InputError(
            f"the scale {cell:g} is too small for coordinates of {np.abs(uv).max():g}: "
            "give a larger one"
        )
    order = np.lexsort((uv[:, 1], uv[:, 0], cells[:, 1], cells[:, 0]))
    uv, cells = uv[order], cells[order]
    starts = np.flatnonzero(np.append(True, (cells[1:] != cells[:-1]).any(axis=1)))
    counts = np.diff(np.append(starts, len(uv)))
    # About the first point of a cell, so that large coordinates lose nothing.
    first = uv[starts]
    moved = uv - np.repeat(first, counts, axis=0)
    means: FloatArray = first + np.add.reduceat(moved, starts, axis=0) / counts[:, None]
    return means
