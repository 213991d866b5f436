"""Ourselves, under the same rules: NumPy array in, edges or triangulation out."""

import numpy as np

import crustline


def edges_of_delaunay(triangulation: crustline.Delaunay) -> np.ndarray:
    return triangulation.edges


METHODS = {
    "delaunay": (crustline.Delaunay, edges_of_delaunay),
    "crust": (crustline.crust, np.asarray),
}
