"""CDT through its Python package; without constraints it is a Delaunay triangulation."""

from typing import Any

import numpy as np
import pythoncdt

from .edges import edges_of_triangles


def delaunay(points: np.ndarray) -> pythoncdt.Triangulation:
    triangulation = pythoncdt.Triangulation(
        pythoncdt.VertexInsertionOrder.AUTO, pythoncdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0
    )
    insert: Any = triangulation.insert_vertices  # takes arrays, though its types do not say so
    insert(points)
    triangulation.erase_super_triangle()
    return triangulation


def edges_of_delaunay(triangulation: pythoncdt.Triangulation) -> np.ndarray:
    return edges_of_triangles(triangulation.triangles_array()["vertices"])


METHODS = {"delaunay": (delaunay, edges_of_delaunay)}
