"""Triangle through its Python package; Q is quiet."""

from typing import Any

import numpy as np
import triangle

from .edges import edges_of_triangles


def edges_of_delaunay(answer: Any) -> np.ndarray:
    return edges_of_triangles(answer["triangles"])


def delaunay(points: np.ndarray) -> Any:
    return triangle.triangulate({"vertices": points}, "Q")


METHODS = {"delaunay": (delaunay, edges_of_delaunay)}
