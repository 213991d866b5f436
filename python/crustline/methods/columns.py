"""A method in other coordinates than x and y: two of the columns beside them."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np

from crustline.delaunay import Delaunay, points_and_how
from crustline.errors import InputError, shown


def in_columns(method: Callable[..., Any], x: str, y: str) -> Callable[..., Any]:
    """Return a method that connects points by two of their columns in place of x and y.

    Where x and y have different units, as on the axes of a plot, distances between points mean
    nothing; two other columns may be lengths, as the pixels of the plot are.

    Parameters
    ----------
    method : callable
        Takes points and returns edges, such as `connect`.
    x, y : str
        Names of columns of numbers.

    Returns
    -------
    method : callable
        Takes `Points` with these columns and returns edges: rows of the points as they were passed.

    Raises
    ------
    InputError
        By the method that is returned: if a column is missing, is no numbers or is not finite.

    Examples
    --------
    >>> from crustline import Points, crust
    >>> plot = Points([(0, 1), (1, 10), (2, 100)], columns={"u": [0, 1, 2], "v": [0, 1, 2]})
    >>> in_columns(crust, "u", "v")(plot).tolist()
    [[0, 1], [1, 2]]
    """

    @wraps(method)
    def select(points: Any, **parameters: Any) -> Any:
        carried, (threads, progress) = points_and_how(points)
        for name in (x, y):
            if name not in carried.columns:
                has = f"it has {', '.join(carried.columns) or 'none'}"
                raise InputError(f"points: there is no column {shown(name)} to connect by: {has}")
        other = np.stack([carried.columns[x], carried.columns[y]], axis=1)
        return method(Delaunay(other, threads=threads, progress=progress), **parameters)

    return select
