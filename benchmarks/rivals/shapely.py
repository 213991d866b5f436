"""GEOS through shapely: it gives edges as lines, whose ends are looked up among the points."""

import numpy as np
import shapely

Answer = tuple[np.ndarray, shapely.Geometry]


def delaunay(points: np.ndarray) -> Answer:
    return points, shapely.delaunay_triangles(shapely.multipoints(points), only_edges=True)


def edges_of_delaunay(answer: Answer) -> np.ndarray:
    points, lines = answer
    row = {point: i for i, point in enumerate(map(tuple, points.tolist()))}
    ends = shapely.get_coordinates(shapely.get_parts(lines)).tolist()
    return np.array([row[x, y] for x, y in ends], dtype=np.int64).reshape(-1, 2)


METHODS = {"delaunay": (delaunay, edges_of_delaunay)}
