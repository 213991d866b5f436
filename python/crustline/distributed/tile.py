"""What a tile decides: all of its points with a halo first, then only what is open, in rounds.

What is left after that goes to one task, the coordinator, which sees little of every tile: the
open vertices and their neighbors. An edge that no tile saw joins two open vertices of different
tiles, and more points never bring an edge back; so it is among the edges of that small set.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.distributed.rules import Rule
from crustline.distributed.sight import Atlas, Sight, common, grown, meets
from crustline.distributed.store import Arrays, Records, together, write_records

#: Pieces that one edge or vertex may ask for in a round.
MOST = 8
#: The share of a tile's points that a halo may add by a guess.
MOST_HALO = 0.2

_NO_PAIRS = np.empty((0, 2), np.int64)
_NOWHERE = np.array([[np.inf, np.inf, -np.inf, -np.inf]])


@dataclass(frozen=True)
class Folder:
    """The points of a run, as tasks find them."""

    path: Path

    def atlas(self) -> Atlas:
        """Return where all points are."""
        return Atlas(_tiles(self.path / "work/atlas.arrow"), self.bounds)

    def bounds(self, tile: int) -> tuple[FloatArray, IntArray]:
        """Return what the groups of a tile span, and how many points each has."""
        about = Records(self.path / f"work/tiles/{tile:06}.bounds")[0]
        return about["bounds"], about["counts"]

    def groups(self, tile: int, numbers: list[int]) -> list[Arrays]:
        """Return some of the groups of a tile."""
        records = Records(self.path / f"work/tiles/{tile:06}.arrow")
        return [records[number] for number in numbers]

    def points(self, tile: int) -> Arrays:
        """Return all points of a tile, along the Z-order curve: in memory, near is near."""
        records = Records(self.path / f"work/tiles/{tile:06}.arrow")
        return together(records, {"xy": np.empty((0, 2)), "row": np.empty(0, np.int64)})


@lru_cache(maxsize=4)
def _tiles(path: Path) -> FloatArray:
    tiles: FloatArray = Records(path)[0]["tiles"]
    return tiles


@dataclass(frozen=True)
class Answer:
    """What the core decides: see `_core.decide`."""

    edges: IntArray
    open_edges: IntArray
    open_vertices: IntArray
    reach: FloatArray
    pieces: IntArray
    parts: FloatArray

    @property
    def is_final(self) -> bool:
        """Whether nothing is open."""
        return not (len(self.open_edges) or len(self.open_vertices))


def _decide(
    delaunay: _core.Delaunay,
    rule: Rule,
    flags: tuple[BoolArray, BoolArray],
    pairs: IntArray,
    sight: Sight,
    clear: FloatArray = _NOWHERE,
    most: int = MOST,
) -> Answer:
    own, fresh = flags
    where = (sight.bounds, sight.known, clear)
    return Answer(*_core.decide(delaunay, rule, own, fresh, pairs, *where, most, 1))


# First the whole tile.


def decide(folder: Path, tile: int, rule: Rule, halo: float | None) -> Any:
    """Decide the edges of a tile's points by these and those near by."""
    store = Folder(folder)
    own, atlas = store.points(tile), store.atlas()
    width = _guess(store, tile, len(own["row"])) if halo is None else halo
    clear = grown(atlas.tiles[tile], width)
    sight = Sight(atlas, store.groups, tile)
    near = sight.see(*sight.within(clear))
    xy = np.concatenate([own["xy"], near["xy"]])
    count = len(own["row"])
    is_own = np.arange(len(xy)) < count
    delaunay = _core.Delaunay(xy, 1)
    answer = _decide(
        delaunay, rule, (is_own, np.ones(len(xy), bool)), _NO_PAIRS, sight, clear[None]
    )
    rows = np.concatenate([own["row"], near["row"]])
    tiles = np.concatenate([np.full(count, tile), near["tile"]])
    points = {"xy": xy, "row": rows, "tile": tiles}
    inside = (answer.edges < count).all(axis=1)
    record: Arrays = {"own": answer.edges[inside].astype(np.uint32), "clear": clear}
    record |= _across(points, answer.edges[~inside]) | _open(delaunay, points, answer)
    written = write_records(folder, f"work/decided/{tile:06}.arrow", [record])
    counts = {"points": count, "halo": len(near["row"]), "edges": len(answer.edges)}
    return [written], counts | _counts(record, tile)


def _guess(store: Folder, tile: int, count: int) -> float:
    """Return a guess at how wide a halo decides most: four times the spacing of nearly all points.

    A wrong guess costs rounds, or points that were not needed; never an edge.
    """
    _, counts = store.bounds(tile)
    numbers = np.linspace(0, len(counts) - 1, 8).astype(int)
    records = store.groups(tile, np.unique(numbers).tolist())
    spacings = np.concatenate([second_distances(record["xy"]) for record in records])
    width = 4 * float(np.quantile(spacings, 0.95)) if len(spacings) else 0.0
    while width > 0 and _points_beside(store.atlas(), tile, width) > MOST_HALO * count:
        width = width / 2 if width > 1e-300 else 0.0
    return width


def second_distances(xy: FloatArray) -> FloatArray:
    """Return the distance from each point to its second neighbor, of those that have two."""
    delaunay = _core.Delaunay(xy, 1)
    edges = np.concatenate([delaunay.edges(), delaunay.edges()[:, ::-1]])
    lengths = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T)
    order = np.lexsort((lengths, edges[:, 0]))
    start = edges[order, 0]
    second = np.flatnonzero(start[1:] == start[:-1]) + 1
    first_again = np.append(False, start[second][1:] == start[second][:-1])
    found: FloatArray = lengths[order][second[~first_again[: len(second)]]]
    return found


def _points_beside(atlas: Atlas, tile: int, width: float) -> float:
    """Return about how many points of other tiles are in a tile's halo."""
    clear = grown(atlas.tiles[tile], width)
    near = np.setdiff1d(np.flatnonzero(meets(atlas.tiles, clear)), [tile])
    return sum(_points_within(*atlas.groups(int(other)), clear) for other in near)


def _points_within(bounds: FloatArray, counts: IntArray, clear: FloatArray) -> float:
    """Return about how many points of groups are in a rectangle."""
    near = meets(bounds, clear)
    part = common(bounds[near], clear)
    with np.errstate(all="ignore"):
        shares = (part[:, 2:] - part[:, :2]) / (bounds[near][:, 2:] - bounds[near][:, :2])
    # A group on a line parallel to an axis is all in, or not.
    return float((counts[near] * np.where(np.isfinite(shares), shares, 1.0).prod(axis=1)).sum())


# Records of edges and of what is open.


def _across(points: Arrays, edges: IntArray) -> Arrays:
    """Return edges as rows, places and tiles of both ends, the smaller row first."""
    flipped = points["row"][edges[:, 0]] > points["row"][edges[:, 1]]
    ends = np.where(flipped[:, None], edges[:, ::-1], edges)
    return {
        "rows": points["row"][ends],
        "places": points["xy"][ends].reshape(-1, 4),
        "tiles": points["tile"][ends],
    }


#: No edges across tiles.
NO_EDGES: Arrays = {"rows": _NO_PAIRS, "places": np.empty((0, 4)), "tiles": _NO_PAIRS}


def _open(delaunay: _core.Delaunay, points: Arrays, answer: Answer) -> Arrays:
    """Return what is open: vertices and edges, with all their neighbors."""
    ends = np.unique(np.concatenate([answer.open_edges.ravel(), answer.open_vertices]))
    neighbors, _ = _core.stars(delaunay, ends)
    needed = np.unique(np.concatenate([ends, neighbors]))
    return {
        "xy": points["xy"][needed],
        "row": points["row"][needed],
        "tile": points["tile"][needed],
        "open_vertices": np.searchsorted(needed, answer.open_vertices),
        "reach": answer.reach,
        "open_edges": np.searchsorted(needed, answer.open_edges),
    }


def _counts(record: Arrays, tile: int) -> dict[str, Any]:
    others = np.setdiff1d(record["tiles"], [tile])
    return {
        "open_vertices": len(record["open_vertices"]),
        "open_edges": len(record["open_edges"]),
        "across": others.tolist(),
    }


# Then what is open.


def settle(folder: Path, tile: int, rule: Rule, rounds: int, budget: int) -> Any:
    """Read what is asked for, and decide the open edges and vertices of a tile again, in rounds."""
    store = Folder(folder)
    before = Records(folder / f"work/decided/{tile:06}.arrow")[0]
    sight = Sight(store.atlas(), store.groups)
    sight.know_tile(tile)
    sight.know(before["clear"])
    points = {name: before[name] for name in ("xy", "row", "tile")}
    state = _State(rule, points, before["open_vertices"], before["open_edges"], sight)
    state.settle(lambda done, size: done < rounds and size < budget)
    record = _across(state.points, state.edges) | state.open()
    written = write_records(folder, f"work/settled/{tile:06}.arrow", [record])
    return [written], _counts(record, tile) | {"open": state.history, "seen": len(state.fresh)}


class _State:
    """Some points, and what of them is open."""

    def __init__(
        self, rule: Rule, points: Arrays, vertices: IntArray, edges: IntArray, sight: Sight
    ) -> None:
        self.rule, self.points, self.sight = rule, points, sight
        self.vertices, self.pairs = vertices, edges
        self.fresh = np.zeros(len(points["row"]), bool)
        self.found: list[IntArray] = []
        self.history: list[int] = []

    @property
    def edges(self) -> IntArray:
        """The edges that were found, as pairs of the points."""
        return np.unique(np.concatenate([_NO_PAIRS, *self.found]), axis=0)

    def settle(self, goes_on: Callable[[int, int], bool], most: int = MOST) -> None:
        """Decide, and see what is asked for, as long as something is open."""
        done = 0
        while True:
            self._decide(most)
            size = len(self.fresh)
            if self._answer.is_final or not goes_on(done, size):
                return
            self._see()
            done, most = done + 1, most if done < MOST else 2 * most

    def _decide(self, most: int) -> None:
        own = np.zeros(len(self.fresh), bool)
        own[self.vertices] = True
        self._delaunay = _core.Delaunay(self.points["xy"], 1)
        flags = (own, self.fresh)
        answer = _decide(self._delaunay, self.rule, flags, self.pairs, self.sight, most=most)
        self.vertices, self.pairs, self._answer = answer.open_vertices, answer.open_edges, answer
        self.found.append(answer.edges)
        self.history.append(len(np.unique(np.append(answer.open_edges, answer.open_vertices))))
        self.fresh[:] = False

    def _see(self) -> None:
        seen = self.sight.see(self._answer.pieces, self._answer.parts)
        new = ~np.isin(seen["row"], self.points["row"])
        self.fresh = np.append(self.fresh, ~seen["known"][new])
        self.points = {
            name: np.concatenate([array, seen[name][new]]) for name, array in self.points.items()
        }

    def open(self) -> Arrays:
        """Return what is open, as a record."""
        return _open(self._delaunay, self.points, self._answer)


# Then all that is left, in one place.


def coordinate(folder: Path, files: list[str], rule: Rule) -> Any:
    """Find the edges between open vertices of different tiles, and decide all that is open."""
    store = Folder(folder)
    points, vertices, pairs = _candidates(rule, [Records(folder / path)[0] for path in files])
    sight = Sight(store.atlas(), store.groups)
    state = _State(rule, points, np.empty(0, np.int64), pairs, sight)
    if len(pairs):
        state.settle(lambda done, size: True)
    record = _across(state.points, state.edges)
    written = write_records(folder, "work/coordinated.arrow", [record])
    counts = {"vertices": vertices, "pairs": len(pairs), "edges": len(state.edges)}
    return [written], counts | {
        "points": len(state.fresh),
        "open": state.history,
        "across": np.unique(record["tiles"]).tolist(),
    }


def _candidates(rule: Rule, records: list[Arrays]) -> tuple[Arrays, int, IntArray]:
    """Return the points of all records, how many of them are open, and the pairs to decide."""
    none = {"xy": np.empty((0, 2)), "row": np.empty(0, np.int64), "tile": np.empty(0, np.int64)}
    parts = [{name: record[name] for name in none} for record in records]
    together_all = together(parts, none)
    rows, firsts = np.unique(together_all["row"], return_index=True)
    points = {name: array[firsts] for name, array in together_all.items()}
    reach = np.full(len(rows), -1.0)
    pairs = [_NO_PAIRS]
    for record in records:
        here = np.searchsorted(rows, record["row"])
        open_here = here[record["open_vertices"]]
        reach[open_here] = np.maximum(reach[open_here], record["reach"] * (1 + 1e-9))
        pairs.append(np.sort(here[record["open_edges"]], axis=1))
    edges = _core.candidates(_core.Delaunay(points["xy"], 1), rule)
    lengths = np.hypot(*(points["xy"][edges[:, 0]] - points["xy"][edges[:, 1]]).T)
    unseen = (reach[edges] >= lengths[:, None]).all(axis=1)
    unseen &= points["tile"][edges[:, 0]] != points["tile"][edges[:, 1]]
    found = np.unique(np.concatenate([*pairs, edges[unseen]]), axis=0)
    return points, int(np.count_nonzero(reach >= 0)), found
