"""Small inputs for runs in tiles, and what one piece gives of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
from pyarrow import parquet

import crustline as cl
from crustline.distributed import Result


def circles(count, random):
    t = random.random(count) * 2 * np.pi
    center = random.integers(0, 4, (count, 2)) * 3.0
    return center + np.stack([np.cos(t), np.sin(t)], axis=1)


def curves(n, random):
    return circles(n, random)


def coast(n, random):
    t = np.arange(n) * 2 * np.pi / n
    r = 5 + sum(np.sin(k * t + random.random() * 6) / k for k in range(1, 12))
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=1)


def one_circle(n, random):
    t = np.arange(n) * 2 * np.pi / n
    return np.stack([np.cos(t), np.sin(t)], axis=1)


def lattice(n, random):
    side = int(np.sqrt(n))
    return np.stack(np.divmod(np.arange(side * side), side), axis=1).astype(float)


def uniform(n, random):
    return random.random((n, 2))


def noisy(n, random):
    return coast(n, random) + random.normal(0, 0.02, (n, 2))


def clustered(n, random):
    return random.normal(0, 1, (n, 2)) * random.choice([1, 0.01, 1e-4], (n, 1)) + random.integers(
        0, 3, (n, 2)
    )


def arcs(n, random):
    t = random.random(n - 20) * np.pi / 2
    center = random.integers(0, 4, (n - 20, 2)) * 2.5
    drawn = center + np.stack([np.cos(t), np.sin(t)], axis=1)
    return np.concatenate([drawn, random.random((20, 2)) * 10])


def far_islands(n, random):
    return circles(n, random) + random.choice([0, 1e4, 1e7], (n, 1))


def half_repeated(n, random):
    half = circles(n // 2, random)
    return np.concatenate([half, half[random.permutation(len(half))]])


def dashes(n, random):
    along = np.arange(n) * 0.01
    return np.stack([along + 2.0 * (np.arange(n) // 25), np.zeros(n)], axis=1)


def sparse(n, random):
    return random.random((60, 2)) * 1000


def one_cluster(n, random):
    return np.concatenate([random.random((n - 50, 2)) * 1e-9, random.random((50, 2))])


def line(n, random):
    return np.stack([np.arange(n) * 3.0, np.arange(n) * 1.0], axis=1)


KINDS = [
    curves, coast, one_circle, lattice, uniform, noisy, clustered, arcs, far_islands,
    half_repeated, dashes, sparse, one_cluster, line,
]  # fmt: skip


def put(folder: Path, xy: np.ndarray, files: int = 2, group: int = 90) -> str:
    """Write points to Parquet files, and return the pattern of their names."""
    folder.mkdir()
    for k, part in enumerate(np.array_split(xy, files)):
        table = pa.table({"x": part[:, 0], "y": part[:, 1]})
        parquet.write_table(table, folder / f"{k:02}.parquet", row_group_size=group)
    return str(folder / "*.parquet")


def table(frame) -> np.ndarray:
    rows = frame.compute().to_numpy()
    return rows[np.lexsort(rows.T[::-1])]


def agrees(result: Result, xy, method=cl.crust, **parameters) -> None:
    """Assert that edges, curves, isolated points and duplicates are those of one piece."""
    delaunay = cl.Delaunay(xy)
    edges = method(delaunay, **parameters)
    assert np.array_equal(table(result.edges), edges)
    assert np.array_equal(table(result.duplicates), delaunay.duplicates)
    expected = cl.trace(xy, edges)
    found = result.traced()
    assert [rows.tolist() for rows, _ in found] == [each.indices.tolist() for each in expected]
    assert [closed for _, closed in found] == [each.closed for each in expected]
    assert result.counts["isolated"] == len(expected.isolated)
    assert result.counts["curves"] == len(expected)
    assert result.counts["rows"] == len(xy)


#: Where a run may be stopped.
STAGES = ["read", "scatter 0", "gather", "tiles", "rounds", "coordinator", "trace", "join 0"]
