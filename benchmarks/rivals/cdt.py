"""CDT through its Python package; without constraints it is a Delaunay triangulation."""

import numpy as np
import pythoncdt

from .edges import edges_of_triangles


def delaunay(points: np.ndarray) -> pythoncdt.Triangulation:
    triangulation = pythoncdt.Triangulation(
        pythoncdt.VertexInsertionOrder.AUTO, pythoncdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0
    )
    triangulation.insert_vertices(points)
    triangulation.erase_super_triangle()
    return triangulation


def edges_of_delaunay(triangulation: pythoncdt.Triangulation) -> np.ndarray:
    return edges_of_triangles(triangulation.triangles_array()["vertices"])


METHODS = {"delaunay": (delaunay, edges_of_delaunay)}
