"""Assertions for tests: edges and curves that may differ in order and direction only."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from crustline.curves import Curve, Curves

T = TypeVar("T")
Path = tuple[bool, tuple[int, ...]]
_SHOWN = 10


def assert_same_edges(actual: npt.ArrayLike, expected: npt.ArrayLike) -> None:
    """Assert that two sets of edges are equal, whatever their order and direction.

    Parameters
    ----------
    actual, expected : array_like of int, shape (m, 2)
        Rows of points. Edge (i, j) is edge (j, i); a repeated edge must be repeated in both.

    Raises
    ------
    AssertionError
        If the sets differ; the message lists the edges that are missing and those that are extra.

    Examples
    --------
    >>> assert_same_edges([(0, 1), (2, 1)], [(1, 2), (0, 1)])
    >>> assert_same_edges([(0, 1)], [(1, 2)])
    Traceback (most recent call last):
    AssertionError: edges differ: missing (1, 2); extra (0, 1)
    """
    _assert_same("edges", _count_edges(actual), _count_edges(expected))


def assert_same_curves(actual: Iterable[Curve], expected: Iterable[Curve]) -> None:
    """Assert that two sequences of curves are equal, whatever their order, direction and start.

    Rings may start anywhere and run either way, polylines may run either way, and the curves may
    come in any order. Where both are `Curves`, the isolated points are compared, too.

    Parameters
    ----------
    actual, expected : Curves or iterable of Curve
        The curves, as rows of the same points.

    Raises
    ------
    AssertionError
        If they differ; the message lists the curves that are missing and those that are extra.

    Examples
    --------
    >>> import numpy as np
    >>> ring = Curve(np.array([0, 1, 2]), True, np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]))
    >>> turned = Curve(np.array([2, 1, 0]), True, ring.points[::-1])
    >>> assert_same_curves([ring], [turned])
    """
    _assert_same("curves", _count_curves(actual), _count_curves(expected))
    if isinstance(actual, Curves) and isinstance(expected, Curves):
        isolated = (Counter(curves.isolated.tolist()) for curves in (actual, expected))
        _assert_same("isolated points", *isolated)


def _count_edges(edges: npt.ArrayLike) -> Counter[tuple[int, ...]]:
    rows = np.sort(np.asarray(edges).reshape(-1, 2), axis=1)
    return Counter(map(tuple, rows.tolist()))


def _count_curves(curves: Iterable[Curve]) -> Counter[str]:
    return Counter(_describe(_canonical(curve)) for curve in curves)


def _canonical(curve: Curve) -> Path:
    """Return the curve from its smallest start, in the direction whose next index is smaller."""
    forward = curve.indices.tolist()
    backward = forward[::-1]
    if curve.closed:
        forward, backward = (_from_smallest(ring) for ring in (forward, backward))
    return curve.closed, tuple(min(forward, backward))


def _from_smallest(ring: list[int]) -> list[int]:
    start = ring.index(min(ring))
    return ring[start:] + ring[:start]


def _describe(path: Path) -> str:
    closed, indices = path
    return f"{'ring' if closed else 'polyline'} {'-'.join(map(str, indices))}"


def _assert_same(what: str, actual: Counter[T], expected: Counter[T]) -> None:
    faults = [
        f"{word} {_some(difference)}"
        for word, difference in (("missing", expected - actual), ("extra", actual - expected))
        if difference
    ]
    if faults:
        raise AssertionError(f"{what} differ: {'; '.join(faults)}")


def _some(difference: Counter[T]) -> str:
    items = sorted(difference.elements(), key=str)
    more = f" and {len(items) - _SHOWN} more" if len(items) > _SHOWN else ""
    return ", ".join(map(str, items[:_SHOWN])) + more
