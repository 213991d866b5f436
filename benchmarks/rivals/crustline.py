"""Ourselves, under the same rules: NumPy array in, edges or triangulation out."""

from functools import partial

import numpy as np

import crustline


def delaunay(points: np.ndarray, *, threads: int) -> crustline.Delaunay:
    return crustline.Delaunay(points, threads=threads)


def crust(points: np.ndarray, *, threads: int) -> np.ndarray:
    return crustline.crust(crustline.Delaunay(points, threads=threads))


def edges_of_delaunay(triangulation: crustline.Delaunay) -> np.ndarray:
    return triangulation.edges


METHODS = {
    f"{name}-{threads}": (partial(work, threads=threads), edges_of)
    for threads in (1, 2)
    for name, work, edges_of in (
        ("delaunay", delaunay, edges_of_delaunay),
        ("crust", crust, np.asarray),
    )
}
