"""From what tiles decided to edges and curves of the whole.

An edge belongs to the tile of its smaller row. A tile traces its own edges, whole curves and the
runs between cut vertices, where edges of other tiles may go on; the runs are summed up as chains,
and chains are joined, level by level, into the curves that cross tiles.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.distributed.geoparquet import Ragged, write_curves
from crustline.distributed.store import (
    Arrays,
    Records,
    together,
    write,
    write_pairs,
    write_records,
)
from crustline.distributed.tile import NO_EDGES, Folder


@dataclass(frozen=True)
class _Graph:
    """The edges of a tile between its points, which come first, and ends in other tiles.

    Attributes
    ----------
    row, xy : ndarray
        Of each vertex.
    edges : ndarray of int64, shape (m, 2)
        As vertices.
    cut : ndarray of bool
        The vertices where edges across tiles end.
    degrees : ndarray of int64
        Of the tile's own points: how many edges each has, in all tiles.
    """

    row: IntArray
    xy: FloatArray
    edges: IntArray
    cut: BoolArray
    degrees: IntArray


def _graph(folder: Path, tile: int, files: Iterable[str]) -> _Graph:
    points = Folder(folder).points(tile)
    across = _edges_of(folder, tile, files)
    is_own = across["tiles"] == tile
    place = np.full(is_own.shape, -1)
    place[is_own] = _places(points["row"], across["rows"][is_own])
    inner = is_own.all(axis=1)
    decided = Records(folder / f"work/decided/{tile:06}.arrow", ["own"], mapped=True)[0]["own"]
    own = np.concatenate([decided.astype(np.int64), place[inner]])
    cut = place[is_own & ~inner[:, None]]
    count = len(points["row"])
    degrees = np.bincount(np.concatenate([own.ravel(), cut]), minlength=count)
    # Of the edges across, those whose smaller end is here.
    mine = is_own[:, 0] & ~inner
    foreign, firsts, ends = np.unique(
        across["rows"][mine, 1], return_index=True, return_inverse=True
    )
    bridges = np.stack([place[mine, 0], count + ends], axis=1)
    flags = np.arange(count + len(foreign)) >= count
    flags[cut] = True
    return _Graph(
        np.concatenate([points["row"], foreign]),
        np.concatenate([points["xy"], across["places"][mine, 2:][firsts]]),
        np.concatenate([own, bridges]),
        flags,
        degrees,
    )


def _places(rows: IntArray, wanted: IntArray) -> IntArray:
    """Return where the wanted rows, far fewer, are among all."""
    few, which = np.unique(wanted, return_inverse=True)
    found = np.searchsorted(few, rows)
    here = np.flatnonzero(few[found % max(1, len(few))] == rows) if len(few) else few
    places = np.empty(len(few), np.int64)
    places[found[here]] = here
    return places[which]


def _edges_of(folder: Path, tile: int, files: Iterable[str]) -> Arrays:
    """Return the edges across tiles, and those found late, that end in a tile, each once."""
    records = (Records(folder / path, list(NO_EDGES), mapped=True)[0] for path in files)
    ends_here = ({n: a[(r["tiles"] == tile).any(axis=1)] for n, a in r.items()} for r in records)
    edges = together(ends_here, NO_EDGES)
    _, firsts = np.unique(edges["rows"], axis=0, return_index=True)
    return {name: array[firsts] for name, array in edges.items()}


def trace(folder: Path, tile: int, files: list[str], crs: Any) -> Any:
    """Write the edges of a tile, its whole curves, and its runs with their chains.

    `files` are all that may hold edges across tiles that end in this one.
    """
    graph = _graph(folder, tile, files)
    edges, whole, (run, offsets), chains = _core.trace_tile(
        graph.xy, graph.edges, graph.cut, graph.row
    )
    record = {"rows": graph.row[run], "xy": graph.xy[run], "offsets": offsets}
    record |= dict(zip(("sites", "places", "counts"), chains, strict=True))
    record["degrees"] = _degrees(graph, run[np.concatenate([offsets[:-1], offsets[1:] - 1])])
    curves = _with_isolated(graph, *whole)
    written = [
        write(
            folder,
            f"edges/part-{tile:06}.parquet",
            lambda part: write_pairs(part, ("i", "j"), [edges]),
        ),
        write(
            folder,
            f"curves/part-{tile:06}.parquet",
            lambda part: write_curves(part, [curves], crs),
        ),
        write_records(folder, f"chains/part-{tile:06}.arrow", [record]),
    ]
    counts = {"edges": len(edges), "curves": len(whole[2]), "isolated": len(whole[3])}
    return written, counts | {"chains": len(chains[2])}


def _degrees(graph: _Graph, ends: IntArray) -> IntArray:
    """Return row and degree of the tile's own vertices where runs end, here or in other tiles."""
    count = len(graph.degrees)
    places = np.union1d(ends[ends < count], np.flatnonzero(graph.cut[:count]))
    return np.stack([graph.row[places], graph.degrees[places]], axis=1)


def _with_isolated(
    graph: _Graph, indices: IntArray, offsets: IntArray, closed: BoolArray, isolated: IntArray
) -> Ragged:
    """Return curves, and after them each isolated point as one of one row."""
    vertices = np.concatenate([indices, isolated])
    ends = offsets[-1] + 1 + np.arange(len(isolated))
    flags = np.concatenate([closed, np.zeros(len(isolated), bool)])
    offsets = np.concatenate([offsets, ends])
    return Ragged(graph.row[vertices], graph.xy[vertices], offsets, flags)


# Joining chains.

_NO_CHAINS: Arrays = {
    "sites": np.empty((0, 10), np.int64),
    "places": np.empty((0, 2)),
    "counts": np.empty(0, np.int64),
    "degrees": np.empty((0, 2), np.int64),
}
_NO_MEMBERS: Arrays = {
    "tile": np.empty(0, np.int64),
    "run": np.empty(0, np.int64),
    "backward": np.empty(0, bool),
    "sizes": np.empty(0, np.int64),
}


def join(folder: Path, level: int, number: int, parts: list[tuple[int, str]]) -> Any:
    """Join the chains of files into whole curves, and into longer chains for the next level.

    Each file comes with the number of the tile that traced it, at level 0.
    """
    chains = [_chains(folder, level, tile, path) for tile, path in parts]
    table = together(({n: c[n] for n in _NO_CHAINS} for c in chains), _NO_CHAINS)
    members = together(({n: c[n] for n in _NO_MEMBERS} for c in chains), _NO_MEMBERS)
    arrays = (table[name] for name in ("sites", "places", "counts", "degrees"))
    whole, rest = (_joined(members, *each) for each in _core.join_chains(*arrays))
    rest["degrees"] = _needed(table["degrees"], table["sites"][:, :2], rest["sites"][:, :2])
    written = [
        write(
            folder,
            f"long/part-{level:02}-{number:06}.parquet",
            lambda part: _write_long(part, whole),
        ),
        write_records(folder, f"work/joined-{level}/{number:06}.arrow", [rest]),
    ]
    counts = {"curves": len(whole["counts"]), "open": len(rest["counts"])}
    return written, counts


def _needed(degrees: IntArray, ends: IntArray, open_ends: IntArray) -> IntArray:
    """Return the degrees of vertices where chains end still, or will in other files."""
    rows, counts = np.unique(ends, return_counts=True)
    place = np.searchsorted(rows, degrees[:, 0]) % max(1, len(rows))
    met = np.zeros(len(degrees), np.int64)
    if len(rows):
        met = np.where(rows[place] == degrees[:, 0], counts[place], 0)
    return degrees[(met < degrees[:, 1]) | np.isin(degrees[:, 0], open_ends)]


def _chains(folder: Path, level: int, tile: int, path: str) -> Arrays:
    """Return the chains in a file, each with its runs: one of its own at level 0."""
    record: Arrays
    if level:
        record = Records(folder / path)[0]
        return record
    record = Records(folder / path, list(_NO_CHAINS), mapped=True)[0]
    count = len(record["counts"])
    runs = {"tile": np.full(count, tile), "run": np.arange(count), "sizes": np.ones(count, int)}
    return record | runs | {"backward": np.zeros(count, bool)}


def _joined(members: Arrays, ragged: Any, closed: BoolArray, chains: Any) -> Arrays:
    """Return joined chains as arrays, with the runs of all their members in order."""
    numbers, backward, offsets = ragged
    starts = np.concatenate([[0], np.cumsum(members["sizes"])])
    sizes = members["sizes"][numbers]
    ends = np.cumsum(sizes)
    within = np.arange(ends[-1] if len(ends) else 0) - np.repeat(ends - sizes, sizes)
    turned = np.repeat(backward, sizes)
    within = np.where(turned, np.repeat(sizes, sizes) - 1 - within, within)
    runs = np.repeat(starts[:-1][numbers], sizes) + within
    lengths = np.diff(np.concatenate([[0], ends])[offsets])
    return {
        "tile": members["tile"][runs],
        "run": members["run"][runs],
        "backward": members["backward"][runs] ^ turned,
        "sizes": lengths,
        "closed": closed,
        "sites": chains[0],
        "places": chains[1],
        "counts": chains[2],
    }


def _write_long(path: Path, whole: Arrays) -> None:
    """Write curves as references: for each its runs, by tile and number, and which are turned."""
    import pyarrow as pa
    from pyarrow import parquet

    offsets = np.concatenate([[0], np.cumsum(whole["sizes"])])
    lists = {
        name: pa.LargeListArray.from_arrays(pa.array(offsets), pa.array(whole[name]))
        for name in ("tile", "run", "backward")
    }
    first, least = whole["sites"][:, 0], whole["sites"][:, 5]
    least = np.where(least < 0, first, np.minimum(first, least))
    about = {
        "closed": pa.array(whole["closed"]),
        "first": pa.array(np.where(whole["closed"], least, first)),
        "edges": pa.array(whole["counts"]),
    }
    parquet.write_table(pa.table(about | lists), path, write_page_checksum=True)


def materialize(folder: Path, path: Path) -> Ragged:
    """Return the curves of a file of references, with all their rows."""
    from pyarrow import parquet

    rows: list[IntArray] = []
    xy: list[FloatArray] = []
    table = parquet.read_table(path, page_checksum_verification=True).to_pydict()
    records: dict[int, Arrays] = {}
    for closed, *lists in zip(
        *(table[n] for n in ("closed", "tile", "run", "backward")), strict=True
    ):
        parts = [_run(folder, records, *each) for each in zip(*lists, strict=True)]
        row = np.concatenate([part[0][:-1] for part in parts] + [parts[-1][0][-1:]])
        at = np.concatenate([part[1][:-1] for part in parts] + [parts[-1][1][-1:]])
        if closed:
            shift = -int(np.argmin(row[:-1]))
            row, at = np.roll(row[:-1], shift), np.roll(at[:-1], shift, axis=0)
        rows.append(row)
        xy.append(at)
    offsets = np.cumsum([0, *map(len, rows)])
    return Ragged(
        np.concatenate([np.empty(0, np.int64), *rows]),
        np.concatenate([np.empty((0, 2)), *xy]),
        offsets,
        np.array(table["closed"], bool),
    )


def _run(
    folder: Path, records: dict[int, Arrays], tile: int, run: int, backward: bool
) -> tuple[IntArray, FloatArray]:
    if tile not in records:
        names = ["rows", "xy", "offsets"]
        records[tile] = Records(folder / f"chains/part-{tile:06}.arrow", names)[0]
    record = records[tile]
    part = slice(record["offsets"][run], record["offsets"][run + 1])
    rows, xy = record["rows"][part], record["xy"][part]
    return (rows[::-1], xy[::-1]) if backward else (rows, xy)
