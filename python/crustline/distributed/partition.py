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
from typing import Any, Protocol, TypeVar

import numpy as np

from crustline import _core
from crustline.arrays import FloatArray, IntArray
from crustline.distributed.cuts import Cuts, cut
from crustline.distributed.pieces import (
    POINT,
    Part,
    Points,
    parts_in,
    points_of,
    sizes_in,
    write_pieces,
)
from crustline.distributed.sight import around
from crustline.distributed.store import Arrays, Records, write, write_pairs, write_records

#: Points of the sample for each tile that there will be.
SAMPLE = 500

_NOWHERE = np.empty((0, 2))


def read(
    folder: Path, number: int, unit: Any, piece: int, tile_points: int, frame: Any = None
) -> Any:
    """Copy the coordinates of a unit of the input, in pieces, and a sample of them beside."""
    if frame is not None:
        unit = replace(unit, frame=frame)
    random = np.random.default_rng(number)
    step = max(1, tile_points // SAMPLE)
    samples = [_NOWHERE]
    count = 0

    def records() -> Iterator[Arrays]:
        nonlocal count
        for waiting in batched(unit.pieces(piece), piece):
            # Adding 0.0 makes one of the two zeros.
            xy = np.concatenate([_NOWHERE, *waiting]) + 0.0
            samples.append(xy[_sample(len(xy), step, random)])
            count += len(xy)
            yield {"xy": xy}

    path = f"work/read/{number:06}"
    written = write_records(folder, f"{path}.arrow", records())
    sample = write_records(folder, f"{path}.sample", [{"xy": np.concatenate(samples)}])
    return [written, sample], {"count": count}


def _sample(count: int, step: int, random: np.random.Generator) -> IntArray:
    """Return one row of each `step`, at a random place among them."""
    starts = np.arange(0, count, step)
    rows: IntArray = np.minimum(starts + random.integers(0, step, len(starts)), count - 1)
    return rows


def plan(folder: Path, samples: list[str], tile_points: int) -> Any:
    """Cut the plane by the samples of all units."""
    sample = np.concatenate([_NOWHERE, *(Records(folder / path)[0]["xy"] for path in samples)])
    step = max(1, tile_points // SAMPLE)
    cuts = cut(sample, np.full(len(sample), float(step)), tile_points)
    return [write_records(folder, "work/cuts-0.arrow", [cuts.arrays()])], {"tiles": cuts.leaves}


def cuts_in(folder: Path, path: str) -> Cuts:
    """Return the cuts in a file."""
    return Cuts(**Records(folder / path)[0])


def scatter(folder: Path, number: int, unit: str, cuts: str, first_row: int) -> Any:
    """Sort the rows of each piece of a unit by tile, and note where each tile's end."""
    tree = cuts_in(folder, cuts)

    def pieces() -> Iterator[tuple[Points, IntArray]]:
        row = first_row
        for record in Records(folder / unit):
            xy = record["xy"]
            yield points_of(xy, row + np.arange(len(xy))), tree.leaf_of(xy)
            row += len(xy)

    path = f"work/scatter-{Path(cuts).stem}/{number:06}"
    return write_pieces(folder, path, tree.leaves, pieces()), {}


def balance(folder: Path, scattered: list[str], cuts: str, tile_points: int) -> Any:
    """Count the points of all tiles, and cut those again that hold far more than wanted."""
    tree = cuts_in(folder, cuts)
    counts = np.zeros(tree.leaves, np.int64)
    for path in scattered:
        counts += sizes_in(folder, path)
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
        found = _parts(folder, scattered, range(leaf, leaf + 1))
        sample = np.concatenate([part.points["xy"][::step] for part in found])
        weights = np.full(len(sample), counts[leaf] / len(sample))
        tree = tree.grafted(leaf, cut(sample, weights, tile_points))
    return tree


def _parts(folder: Path, scattered: list[str], tiles: range) -> Iterator[Part]:
    return (part for path in scattered for part in parts_in(folder, path, tiles))


def regroup(folder: Path, number: int, scattered: list[str], tiles: range, piece: int) -> Any:
    """Bring together what a run of tiles has in all pieces, in pieces again."""

    def pieces() -> Iterator[tuple[Points, IntArray]]:
        for waiting in batched(_parts(folder, scattered, tiles), piece):
            numbers = [np.arange(len(tiles)).repeat(part.sizes) for part in waiting]
            yield np.concatenate([part.points for part in waiting]), np.concatenate(numbers)

    return write_pieces(folder, f"work/regrouped/{number:06}", len(tiles), pieces()), {}


class _Sized(Protocol):
    def __len__(self) -> int: ...


_Batch = TypeVar("_Batch", bound=_Sized)


def batched(parts: Iterable[_Batch], points: int) -> Iterator[list[_Batch]]:
    """Yield parts in lists that hold about so many points, at least one list."""
    waiting: list[_Batch] = []
    count = 0
    for part in parts:
        if count >= points:
            yield waiting
            waiting, count = [], 0
        waiting.append(part)
        count += len(part)
    yield waiting


def gather(folder: Path, tile: int, scattered: list[str], first_tile: int, tile_points: int) -> Any:
    """Collect a tile: its distinct points in groups along the Z-order curve, and its duplicates.

    The first tile in the files is given.
    """
    found = _Distinct()
    place = range(tile - first_tile, tile - first_tile + 1)

    def duplicates() -> Iterator[IntArray]:
        for waiting in batched(_parts(folder, scattered, place), tile_points):
            yield found.add(waiting)

    path = f"duplicates/part-{tile:06}.parquet"
    repeated = write(folder, path, lambda part: write_pairs(part, ("row", "first"), duplicates()))
    size = max(32, tile_points // 256)
    starts = range(0, max(1, len(found.points)), size)
    groups = [found.points[start : start + size] for start in starts]
    about = {
        "bounds": np.array([around(group["xy"]) for group in groups]),
        "counts": np.array([len(group) for group in groups]),
    }
    records = ({name: group[name] for name in ("xy", "row")} for group in groups)
    written = write_records(folder, f"work/tiles/{tile:06}.arrow", records)
    bounds = write_records(folder, f"work/tiles/{tile:06}.bounds", [about])
    count = {"points": len(found.points), "duplicates": found.repeated}
    return [repeated, written, bounds], count


class _Distinct:
    """Distinct points along the Z-order curve, to which more are added."""

    def __init__(self) -> None:
        self.points = np.empty(0, POINT)
        self.repeated = 0

    def add(self, parts: list[Part]) -> IntArray:
        """Add points of larger rows; return those that were there, each with its first row."""
        points = np.concatenate([self.points, *(part.points for part in parts)])
        first, duplicates = _core.z_order(np.ascontiguousarray(points["xy"]))
        self.points = points[first]
        self.repeated += len(duplicates)
        rows: IntArray = points["row"][duplicates]
        return rows


def atlas(folder: Path, tiles: int) -> Any:
    """Put what each tile spans into one file."""
    spans = np.array([_span(folder, tile) for tile in range(tiles)])
    return [write_records(folder, "work/atlas.arrow", [{"tiles": spans}])], {}


def _span(folder: Path, tile: int) -> FloatArray:
    bounds = Records(folder / f"work/tiles/{tile:06}.bounds")[0]["bounds"]
    return np.concatenate([bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)])
