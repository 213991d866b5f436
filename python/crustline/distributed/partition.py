"""From any input to tiles: each step reads files and writes one.

Read copies coordinates, scatter sorts the rows of each piece by tile, regroup brings together what
runs of successive tiles have in all pieces, gather collects a tile, sets its repeated points aside
and writes it in groups along the Z-order curve. So a worker that dies costs its step and nothing
else, where a shuffle between workers would start again.

Each tile has a part in each piece, and there are about as many pieces as tiles, T: T² reads, each
the smaller the more there are. By way of √T runs of √T tiles it is 2 T^1.5 reads, √T times as long.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from crustline import _core
from crustline.arrays import IntArray
from crustline.distributed.cuts import Cuts, cut
from crustline.distributed.sight import around
from crustline.distributed.store import (
    Arrays,
    Records,
    together,
    write,
    write_pairs,
    write_records,
)

#: Points of the sample for each tile that there will be.
SAMPLE = 500

_POINTS: Arrays = {"xy": np.empty((0, 2)), "row": np.empty(0, np.int64)}


def read(
    folder: Path, number: int, unit: Any, piece: int, tile_points: int, frame: Any = None
) -> Any:
    """Copy the coordinates of a unit of the input, in pieces, each with a sample of it."""
    if frame is not None:
        unit = replace(unit, frame=frame)
    random = np.random.default_rng(number)
    step = max(1, tile_points // SAMPLE)
    count = 0

    def records() -> Iterator[Arrays]:
        nonlocal count
        pieces = ({"xy": xy} for xy in unit.pieces(piece))
        for waiting in batched(pieces, piece):
            # Adding 0.0 makes one of the two zeros.
            xy = together(waiting, {"xy": np.empty((0, 2))})["xy"] + 0.0
            count += len(xy)
            yield {"xy": xy, "sample": xy[_sample(len(xy), step, random)]}

    written = write_records(folder, f"work/read/{number:06}.arrow", records())
    return [written], {"count": count}


def _sample(count: int, step: int, random: np.random.Generator) -> IntArray:
    """Return one row of each `step`, at a random place among them."""
    starts = np.arange(0, count, step)
    rows: IntArray = np.minimum(starts + random.integers(0, step, len(starts)), count - 1)
    return rows


def plan(folder: Path, units: list[str], tile_points: int) -> Any:
    """Cut the plane by the samples of all units."""
    # Mapped and copied, or the coordinates beside the samples would be held in memory, too.
    files = (Records(folder / path, ["sample"], mapped=True) for path in units)
    samples = (record["sample"].copy() for records in files for record in records)
    sample = np.concatenate([np.empty((0, 2)), *samples])
    step = max(1, tile_points // SAMPLE)
    cuts = cut(sample, np.full(len(sample), float(step)), tile_points)
    return [write_records(folder, "work/cuts-0.arrow", [cuts.arrays()])], {"tiles": cuts.leaves}


def cuts_in(folder: Path, path: str) -> Cuts:
    """Return the cuts in a file."""
    return Cuts(**Records(folder / path)[0])


def scatter(folder: Path, number: int, unit: str, cuts: str, first_row: int) -> Any:
    """Sort the rows of each piece of a unit by tile, and note where each tile's end."""
    tree = cuts_in(folder, cuts)
    counts = np.zeros(tree.leaves, np.int64)

    def records() -> Iterator[Arrays]:
        row = first_row
        for record in Records(folder / unit, ["xy"]):
            xy = record["xy"]
            points = {"xy": xy, "row": row + np.arange(len(xy))}
            piece = _by_tile(points, tree.leaf_of(xy), tree.leaves)
            yield piece
            counts[:] += np.diff(piece["ends"], prepend=0)
            row += len(xy)

    generation = Path(cuts).stem
    path = f"work/scatter-{generation}/{number:06}.arrow"
    written = write_records(folder, path, records())
    count = write_records(folder, f"{path}.counts", [{"counts": counts}])
    return [written, count], {}


def _by_tile(points: Arrays, tile: IntArray, tiles: int) -> Arrays:
    """Return a piece sorted by tile, with where each tile's part ends."""
    # Of so few bits that NumPy sorts by digits, as a rule.
    order = np.argsort(tile.astype(np.min_scalar_type(tiles)), kind="stable")
    ends = np.cumsum(np.bincount(tile, minlength=tiles))
    return {name: array[order] for name, array in points.items()} | {"ends": ends}


def balance(folder: Path, scattered: list[str], cuts: str, tile_points: int) -> Any:
    """Count the points of all tiles, and cut those again that hold far more than wanted."""
    tree = cuts_in(folder, cuts)
    counts = np.zeros(tree.leaves, np.int64)
    for path in scattered:
        counts += Records(folder / f"{path}.counts")[0]["counts"]
    full = np.flatnonzero(counts > 1.5 * tile_points)
    finer = _cut_again(folder, scattered, tree, full, counts, tile_points)
    generation = int(Path(cuts).stem.split("-")[1]) + 1
    path = f"work/cuts-{generation}.arrow"
    written = write_records(folder, path, [finer.arrays()])
    return [written], {"tiles": finer.leaves, "was": tree.leaves, "counts": counts.tolist()}


def _cut_again(
    folder: Path,
    scattered: list[str],
    tree: Cuts,
    full: IntArray,
    counts: IntArray,
    tile_points: int,
) -> Cuts:
    for leaf in full[::-1].tolist():
        step = max(1, tile_points // SAMPLE)
        found = fragments(folder, scattered, range(leaf, leaf + 1))
        parts = [fragment["xy"][::step] for fragment in found]
        sample = np.concatenate(parts)
        weights = np.full(len(sample), counts[leaf] / len(sample))
        tree = tree.grafted(leaf, cut(sample, weights, tile_points))
    return tree


def fragments(folder: Path, scattered: list[str], tiles: range) -> Iterator[Arrays]:
    """Return the points of successive tiles, piece by piece, each with which tile it is in."""
    for path in scattered:
        # Mapped, as of each piece only a part is read, and copied, to let go of the rest.
        for record in Records(folder / path, mapped=True):
            start = int(record["ends"][tiles.start - 1]) if tiles.start else 0
            ends = record["ends"][tiles.start : tiles.stop]
            points = {name: record[name][start : ends[-1]].copy() for name in _POINTS}
            number = np.arange(len(tiles), dtype=np.min_scalar_type(len(tiles)))
            yield points | {"tile": number.repeat(np.diff(ends, prepend=start))}


def regroup(folder: Path, number: int, scattered: list[str], tiles: range, piece: int) -> Any:
    """Bring together what a run of tiles has in all pieces, sorted by tile, in pieces again."""

    def records() -> Iterator[Arrays]:
        for waiting in batched(fragments(folder, scattered, tiles), piece):
            tile = np.concatenate([np.empty(0, np.uint8), *(part["tile"] for part in waiting)])
            yield _by_tile(together(waiting, _POINTS), tile, len(tiles))

    return [write_records(folder, f"work/regrouped/{number:06}.arrow", records())], {}


def batched(records: Iterable[Arrays], points: int) -> Iterator[list[Arrays]]:
    """Yield records in lists that hold about so many points, at least one list."""
    waiting: list[Arrays] = []
    count = 0
    for record in records:
        if count >= points:
            yield waiting
            waiting, count = [], 0
        waiting.append(record)
        count += len(record["xy"])
    yield waiting


def gather(folder: Path, tile: int, scattered: list[str], first_tile: int, tile_points: int) -> Any:
    """Collect a tile: its distinct points in groups along the Z-order curve, and its duplicates.

    The first tile in the files is given.
    """
    found = _Distinct()
    place = range(tile - first_tile, tile - first_tile + 1)

    def duplicates() -> Iterator[IntArray]:
        for waiting in batched(fragments(folder, scattered, place), tile_points):
            yield found.add(waiting)

    path = f"duplicates/part-{tile:06}.parquet"
    repeated = write(folder, path, lambda part: write_pairs(part, ("row", "first"), duplicates()))
    size = max(32, tile_points // 256)
    starts = range(0, max(1, len(found.points["row"])), size)
    groups = [{n: a[start : start + size] for n, a in found.points.items()} for start in starts]
    about = {
        "bounds": np.array([around(group["xy"]) for group in groups]),
        "counts": np.array([len(group["row"]) for group in groups]),
    }
    written = write_records(folder, f"work/tiles/{tile:06}.arrow", groups)
    bounds = write_records(folder, f"work/tiles/{tile:06}.bounds", [about])
    count = {"points": len(found.points["row"]), "duplicates": found.repeated}
    return [repeated, written, bounds], count


class _Distinct:
    """Distinct points along the Z-order curve, to which more are added."""

    def __init__(self) -> None:
        self.points = _POINTS
        self.repeated = 0

    def add(self, records: list[Arrays]) -> IntArray:
        """Add points of larger rows; return those that were there, each with its first row."""
        points = together([self.points, *records], _POINTS)
        first, duplicates = _core.z_order(points["xy"])
        self.points = {name: array[first] for name, array in points.items()}
        self.repeated += len(duplicates)
        return points["row"][duplicates]


def atlas(folder: Path, tiles: int) -> Any:
    """Put what the groups of all tiles span into one file."""
    abouts = [Records(folder / f"work/tiles/{tile:06}.bounds")[0] for tile in range(tiles)]
    bounds = np.concatenate([about["bounds"] for about in abouts])
    first = np.cumsum([0, *(len(about["counts"]) for about in abouts)])
    whole = [
        np.concatenate([about["bounds"][:, :2].min(axis=0), about["bounds"][:, 2:].max(axis=0)])
        for about in abouts
    ]
    record = {
        "first": first,
        "bounds": bounds,
        "counts": np.concatenate([about["counts"] for about in abouts]),
        "tiles": np.array(whole),
    }
    return [write_records(folder, "work/atlas.arrow", [record])], {}
