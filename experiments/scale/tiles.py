"""One tile of an endless field, decided as a distributed run does it."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from crustline import _core
from crustline.arrays import FloatArray
from crustline.distributed.sight import around, grown, holds, meets, without
from crustline.distributed.tile import MOST, MOST_HALO, second_distances
from experiments.scale.fields import Field, cells

#: Cells around a tile that are made, too.
MARGIN = 2


@dataclass(frozen=True)
class Tile:
    """What one tile took.

    Attributes
    ----------
    points, halo, open, asked : int
        Its own points, those seen around it, its open edges and vertices after that, and the points
        in the pieces that these ask for.
    seconds : float
        Of one processor, to decide.
    """

    points: int
    halo: int
    open: int
    asked: int
    seconds: float


def decided(field: Field, corner: tuple[float, float], side: int) -> Tile:
    """Decide the edges of the square tile of a `side`, in cells, at a corner, by the crust."""
    low = (int(corner[0]) - MARGIN, int(corner[1]) - MARGIN)
    blocks = cells(field, low, side + 2 * MARGIN + 1)
    xy = np.concatenate(blocks)
    inside = holds(np.array([*corner, corner[0] + side, corner[1] + side]), xy)
    own, others = xy[inside], xy[~inside]
    clear = halo(own, others)
    near = others[holds(clear, others)]
    pieces, counts = unseen(blocks, clear)
    start = time.process_time()
    seen = np.concatenate([own, near])
    flags = np.arange(len(seen)) < len(own)
    answer = _core.decide(
        _core.Delaunay(seen, 1), ("crust", []), flags, np.ones(len(seen), bool),
        np.empty((0, 2), np.int64), pieces, np.zeros(len(pieces), bool), clear[None], MOST, 1,
    )  # fmt: skip
    seconds = time.process_time() - start
    _, open_edges, open_vertices, _, asked, _ = answer
    left = len(open_edges) + len(open_vertices)
    return Tile(len(own), len(near), left, int(counts[asked].sum()), seconds)


def halo(own: FloatArray, others: FloatArray) -> FloatArray:
    """Return the tile's rectangle with a halo as wide as a run guesses it."""
    width = 4 * spacing(own)
    while np.count_nonzero(holds(grown(around(own), width), others)) > MOST_HALO * len(own):
        width /= 2
    return grown(around(own), width)


def spacing(xy: FloatArray) -> float:
    """Return the distance to the second neighbor that 95 % of a sample of the points stay below."""
    part = xy[np.argsort(xy[:, 0], kind="stable")[: max(2000, len(xy) // 50)]]
    return float(np.quantile(second_distances(part), 0.95))


def unseen(blocks: list[FloatArray], clear: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rectangles around what of each cell is not in `clear`, and how many points each has.

    Where a cell is cut, its pieces share its points evenly: more than there are.
    """
    bounds = np.array([around(block) for block in blocks])
    counts = np.array([len(block) for block in blocks])
    cut = meets(bounds, clear)
    shared = np.concatenate(
        [np.maximum(bounds[cut, :2], clear[:2]), np.minimum(bounds[cut, 2:], clear[2:])], axis=1
    )
    left, owner = without(bounds[cut], shared)
    parts = np.bincount(owner, minlength=int(cut.sum()))
    pieces = np.concatenate([bounds[~cut], left])
    return pieces, np.concatenate([counts[~cut], counts[cut][owner] / parts[owner]])
