"""Qhull through scipy, and the two-pass crust that one writes with it in ten lines."""

import numpy as np
from scipy.spatial import Delaunay

from .edges import edges_of_triangles


def edges_of_delaunay(triangulation: Delaunay) -> np.ndarray:
    return edges_of_triangles(triangulation.simplices)


def crust(points: np.ndarray) -> np.ndarray:
    """The edges between points in the triangulation of the points and their Voronoi vertices."""
    voronoi = circumcenters(points, Delaunay(points).simplices)
    edges = edges_of_triangles(Delaunay(np.concatenate([points, voronoi])).simplices)
    return edges[edges[:, 1] < len(points)]


def circumcenters(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    p, q, r = points[triangles].transpose(1, 2, 0)
    a, b = q - p, r - p
    cross = 2 * (a[0] * b[1] - a[1] * b[0])
    a_square, b_square = (a * a).sum(axis=0), (b * b).sum(axis=0)
    x = (b[1] * a_square - a[1] * b_square) / cross
    y = (a[0] * b_square - b[0] * a_square) / cross
    return np.column_stack([p[0] + x, p[1] + y])


METHODS = {"delaunay": (Delaunay, edges_of_delaunay), "crust": (crust, np.asarray)}
