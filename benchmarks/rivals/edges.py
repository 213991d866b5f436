"""Edges for the contenders that give only triangles; never timed as part of a triangulation."""

import numpy as np


def edges_of_triangles(triangles: np.ndarray) -> np.ndarray:
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return distinct_edges(sides, int(sides.max(initial=0)) + 1)


def distinct_edges(edges: np.ndarray, n: int) -> np.ndarray:
    """The rows with i < j, sorted, each once; one integer per edge sorts faster than rows."""
    low, high = np.sort(edges, axis=1).T.astype(np.int64)
    return np.column_stack(np.divmod(np.unique(low * n + high), max(n, 1)))
