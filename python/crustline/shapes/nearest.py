"""The nearest of many sites to each of many queries."""

from __future__ import annotations

import math

import numpy as np

from crustline.arrays import FloatArray, IntArray

# The search for nearest sites.
SITES_PER_BOX, QUERIES_PER_BOX = 32, 512
# Matrices of distances are made in blocks of this many entries.
BLOCK = 1 << 20


def nearest_site(queries: FloatArray, sites: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the distance from queries (k, 2) to the nearest of sites (n, 2), and its row.

    Notes
    -----
    Exact up to rounding; of equally near sites, one. Sites are put into boxes, and so are queries:
    those of one box regard only the boxes of sites that may hold the nearest one.
    """
    # Squares of distances beyond 1e154 are infinite: one site is as near as another then.
    with np.errstate(over="ignore"):
        distance, row = _nearest_site(queries, sites)
    far = np.isinf(distance)
    distance[far] = np.hypot(*(queries[far] - sites[row[far]]).T)
    return distance, row


def _nearest_site(queries: FloatArray, sites: FloatArray) -> tuple[FloatArray, IntArray]:
    boxes = _boxes(sites, SITES_PER_BOX)
    low, high = _corners(sites, boxes)
    distance, row = np.empty(len(queries)), np.empty(len(queries), dtype=np.int64)
    for group in _boxes(queries, QUERIES_PER_BOX):
        near = _boxes_in_reach(queries[group], low, high)
        few = [boxes[j] for j in near]
        step = max(1, BLOCK // len(near))
        for part in (group[start : start + step] for start in range(0, len(group), step)):
            found = _nearest_in_boxes(queries[part], sites, few, low[near], high[near])
            distance[part], row[part] = found
    return np.sqrt(distance), row


def _boxes(points: FloatArray, size: int) -> list[IntArray]:
    """Return the rows of points in boxes of about `size`: strips by x, each cut by y."""
    count = max(1, len(points) // size)
    strips = np.array_split(np.argsort(points[:, 0], kind="stable"), max(1, math.isqrt(count)))
    cuts = -(-count // len(strips))
    boxes = (
        box
        for strip in strips
        for box in np.array_split(strip[np.argsort(points[strip, 1], kind="stable")], cuts)
    )
    return [box for box in boxes if len(box)]


def _corners(points: FloatArray, boxes: list[IntArray]) -> tuple[FloatArray, FloatArray]:
    """Return the least and the largest coordinates in each box, (b, 2)."""
    starts = np.cumsum([0] + [len(box) for box in boxes[:-1]])
    ordered = points[np.concatenate(boxes)]
    return np.minimum.reduceat(ordered, starts), np.maximum.reduceat(ordered, starts)


def _boxes_in_reach(q: FloatArray, low: FloatArray, high: FloatArray) -> IntArray:
    """Return the boxes that may hold the nearest site of one of the queries."""
    least, most = q.min(axis=0), q.max(axis=0)
    gap = np.maximum(np.maximum(low - most, least - high), 0)
    reach = np.maximum(most - low, high - least)
    limit = float((reach[:, 0] ** 2 + reach[:, 1] ** 2).min()) * (1 + 1e-12)
    return np.flatnonzero(gap[:, 0] ** 2 + gap[:, 1] ** 2 <= limit)


def _nearest_in_boxes(
    q: FloatArray, sites: FloatArray, boxes: list[IntArray], low: FloatArray, high: FloatArray
) -> tuple[FloatArray, IntArray]:
    """Return squared distances and rows, with the boxes that come too late skipped."""
    x, y = q[:, 0, None], q[:, 1, None]
    below = [np.maximum(np.maximum(low[:, c] - v, v - high[:, c]), 0) for c, v in ((0, x), (1, y))]
    above = [np.maximum(v - low[:, c], high[:, c] - v) for c, v in ((0, x), (1, y))]
    nearest = below[0] ** 2 + below[1] ** 2
    best = (above[0] ** 2 + above[1] ** 2).min(axis=1)
    best *= 1 + 1e-12
    row = np.zeros(len(q), dtype=np.int64)
    for j, box in enumerate(boxes):
        k = np.flatnonzero(nearest[:, j] <= best)
        if not len(k):
            continue
        square = (x[k] - sites[box, 0]) ** 2 + (y[k] - sites[box, 1]) ** 2
        near = np.argmin(square, axis=1)
        found = square[np.arange(len(k)), near]
        better = found < best[k]
        best[k[better]], row[k[better]] = found[better], box[near[better]]
    return best, row
