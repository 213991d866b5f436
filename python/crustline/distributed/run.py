"""A run: its stages in order, each a set of steps that read files and write some.

The engine only schedules: a step that is lost with its worker is done again, and a run that was
killed goes on from the files that are whole.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from math import isqrt
from pathlib import Path
from typing import Any

import numpy as np

from crustline._core import __version__
from crustline.distributed import partition, stitch, tile
from crustline.distributed.cluster import Crew
from crustline.distributed.ledger import Done, Ledger, Step, is_intact, perform
from crustline.distributed.rules import Rule
from crustline.distributed.sources import Frame, Input
from crustline.distributed.store import check_room, clean, write
from crustline.errors import CrustlineError, InputError

Progress = Callable[[str, float], object]
Arguments = dict[str, Any]

#: The least points of a piece: each tile takes its part of every piece, however small it is.
_PIECE = 50_000
#: The most tiles of which each is gathered from all pieces itself.
_DIRECT = 64
#: How many files of chains one step joins.
_FAN_IN = 16
#: What the files of a run take at most beside the copy of the coordinates, for each point: while
#: tiles are gathered three times 24 bytes, at the end some 35 of the result and 33 of the tiles.
_BYTES = 75


@dataclass(frozen=True)
class Settings:
    """What a run was asked for.

    Attributes
    ----------
    rule : tuple of str and list of float
        The method.
    tile_points : int
        About how many points a tile has.
    halo : float, optional
        How wide a tile's halo is; by default a guess for each tile.
    rounds : int
        How often a tile reads what its open edges ask for, before the coordinator decides.
    """

    rule: Rule
    tile_points: int
    halo: float | None
    rounds: int


class Run:
    """A run in its folder: it does the steps of a stage on any worker, and keeps the ledger."""

    def __init__(self, folder: Path, crew: Crew, progress: Progress | None) -> None:
        self.folder, self.client = folder, crew.client
        self.ledger = Ledger(folder / "work/ledger.jsonl")
        self._progress = progress

    def stage(self, name: str, step: Step, arguments: dict[int, Arguments]) -> list[Done]:
        """Do a step for each number; return what was done in the order of the numbers."""
        from distributed import KilledWorker, as_completed

        futures = {self._submit(name, n, step, each): n for n, each in arguments.items()}
        done: dict[int, Done] = {}
        try:
            for future in as_completed(list(futures)):
                done[futures[future]] = future.result()
                self.ledger.add(done[futures[future]])
                if self._progress is not None:
                    self._progress(name, len(done) / len(futures))
        except (KilledWorker, MemoryError) as error:
            lost = "was lost with its worker several times, most likely for want of memory"
            what = "found no memory" if isinstance(error, MemoryError) else lost
            raise CrustlineError(
                f"a step of the stage {name!r} {what}: give more memory or fewer tile_points"
            ) from None
        finally:
            self.client.cancel(list(futures))
        return [done[number] for number in sorted(done)]

    def _submit(self, name: str, number: int, step: Step, arguments: Arguments) -> Any:
        before = self.ledger.before(name, number)
        where = (str(self.folder), name, number)
        return self.client.submit(perform, *where, step, arguments, before, pure=False)

    def one(self, name: str, step: Step, **arguments: Any) -> Done:
        """Do a stage of a single step."""
        return self.stage(name, step, {0: arguments})[0]

    def are_intact(self, name: str) -> bool:
        """Return whether all files of a stage are there as they were written."""
        done = [each for each in self.ledger.all() if each.stage == name]
        found = self.client.map(is_intact, done, folder=str(self.folder), pure=False)
        return bool(done) and all(self.client.gather(found))

    def remove_work(self) -> None:
        """Remove what no one needs once the run has ended."""
        shutil.rmtree(self.folder / "work", ignore_errors=True)
        clean(self.folder)


def execute(run: Run, given: Input, settings: Settings) -> dict[str, Any]:
    """Go through all stages; return the counts of the whole."""
    tiles, counts = _partition(run, given, settings)
    decided = run.stage(
        "tiles",
        tile.decide,
        {t: {"tile": t, "rule": settings.rule, "halo": settings.halo} for t in range(tiles)},
    )
    settled = _settle(run, decided, settings)
    coordinated = _coordinate(run, decided, settled, settings)
    traced = _trace(run, [*decided, *settled, *coordinated], tiles, given.crs)
    joined = _join(run, traced)
    sums = {name: _sum(traced, name) for name in ("edges", "curves", "isolated")}
    sums["curves"] += _sum(joined, "curves")
    return counts | sums | {"tiles": tiles}


def _sum(done: list[Done], name: str) -> int:
    return sum(each.counts[name] for each in done)


def _partition(run: Run, given: Input, settings: Settings) -> tuple[int, dict[str, int]]:
    """Bring the input into tiles; return how many there are, and counts."""
    if not (run.ledger.before("atlas", 0) and run.are_intact("gather") and run.are_intact("atlas")):
        _scatter_and_gather(run, given, settings)
    gathered = [each for each in run.ledger.all() if each.stage == "gather"]
    sums = {name: _sum(gathered, name) for name in ("points", "duplicates")}
    return len(gathered), {"rows": sum(sums.values()), "duplicates": sums["duplicates"]}


def _scatter_and_gather(run: Run, given: Input, settings: Settings) -> None:
    size = settings.tile_points
    read = run.stage("read", partition.read, _units(run, given, size))
    files, samples = ([each.files[k].path for each in read] for k in (0, 1))
    first_rows = np.cumsum([0, *(each.counts["count"] for each in read)]).tolist()
    check_room(run.folder, _BYTES * first_rows[-1])
    planned = run.one("plan", partition.plan, samples=samples, tile_points=size)
    generation, cuts, tiles = 0, planned.files[0].path, planned.counts["tiles"]
    while True:
        scattered = run.stage(
            f"scatter {generation}",
            partition.scatter,
            {
                n: {"number": n, "unit": file, "cuts": cuts, "first_row": first}
                for n, (file, first) in enumerate(zip(files, first_rows, strict=False))
            },
        )
        paths = [_stem(each) for each in scattered]
        balanced = run.one(
            f"balance {generation}", partition.balance, scattered=paths, cuts=cuts, tile_points=size
        )
        if balanced.counts["tiles"] == tiles:
            break
        generation, cuts, tiles = generation + 1, balanced.files[0].path, balanced.counts["tiles"]
    about = _regroup(run, paths, tiles, max(size, _PIECE))
    arguments = {t: {"tile": t, "tile_points": size} | about[t] for t in range(tiles)}
    run.stage("gather", partition.gather, arguments)
    run.one("atlas", partition.atlas, tiles=tiles)
    for folder in run.folder.glob("work/*"):
        if folder.name.startswith(("read", "scatter-", "regrouped")):
            shutil.rmtree(folder)


def _stem(done: Done) -> str:
    """Return the name that the files of a step's pieces share."""
    return done.files[0].path.rpartition(".")[0]


def _regroup(run: Run, scattered: list[str], tiles: int, piece: int) -> list[Arguments]:
    """Return for each tile the files that hold it, and the first tile in these."""
    if tiles <= _DIRECT:
        return [{"scattered": scattered, "first_tile": 0}] * tiles
    width = isqrt(tiles)
    runs = [range(first, min(first + width, tiles)) for first in range(0, tiles, width)]
    about = {"scattered": scattered, "piece": piece}
    done = run.stage(
        "regroup",
        partition.regroup,
        {n: {"number": n, "tiles": each} | about for n, each in enumerate(runs)},
    )
    return [
        {"scattered": [_stem(each)], "first_tile": run_of.start}
        for each, run_of in zip(done, runs, strict=True)
        for _ in run_of
    ]


def _units(run: Run, given: Input, size: int) -> dict[int, Arguments]:
    """Return what each unit is read with; the partition of a frame comes as a future."""
    arguments: dict[int, Arguments] = {}
    for number, unit in enumerate(given.units):
        arguments[number] = {"number": number, "unit": unit, "tile_points": size}
        arguments[number]["piece"] = max(size, _PIECE)
        if isinstance(unit, Frame):
            arguments[number] |= {
                "unit": replace(unit, frame=None),
                "frame": run.client.compute(unit.frame),
            }
    return arguments


def _settle(run: Run, decided: list[Done], settings: Settings) -> list[Done]:
    """Decide in rounds what is open."""
    about = {"rule": settings.rule, "rounds": settings.rounds, "budget": settings.tile_points}
    tiles = [each.number for each in decided if _is_open(each)] if settings.rounds else []
    return run.stage("rounds", tile.settle, {t: {"tile": t} | about for t in tiles})


def _is_open(done: Done) -> bool:
    return bool(done.counts["open_vertices"] or done.counts["open_edges"])


def _coordinate(
    run: Run, decided: list[Done], settled: list[Done], settings: Settings
) -> list[Done]:
    """Decide in one place what is open still."""
    files = [
        each.files[0].path for each in (settled if settings.rounds else decided) if _is_open(each)
    ]
    if not files:
        return []
    return [run.one("coordinator", tile.coordinate, files=files, rule=settings.rule)]


def _trace(run: Run, found: list[Done], tiles: int, crs: Any) -> list[Done]:
    """Trace each tile with all that was found across its border."""
    files: list[list[str]] = [[] for _ in range(tiles)]
    for done in found:
        own = [done.number] if done.stage != "coordinator" else []
        for other in {*own, *done.counts["across"]}:
            files[other].append(done.files[0].path)
    about = {t: {"tile": t, "files": sorted(files[t]), "crs": crs} for t in range(tiles)}
    return run.stage("trace", stitch.trace, about)


def _join(run: Run, traced: list[Done]) -> list[Done]:
    """Join the chains of all tiles, level by level."""
    parts = [(each.number, each.files[-1].path) for each in traced]
    joined: list[Done] = []
    level = 0
    while level == 0 or len(parts) > 1:
        groups = [parts[k : k + _FAN_IN] for k in range(0, len(parts), _FAN_IN)]
        done = run.stage(
            f"join {level}",
            stitch.join,
            {n: {"level": level, "number": n, "parts": group} for n, group in enumerate(groups)},
        )
        parts = [(each.number, each.files[-1].path) for each in done]
        joined, level = joined + done, level + 1
    if done[0].counts["open"]:
        raise CrustlineError(
            "curves were left open: this is a fault of crustline, please report it"
        )
    return joined


def describe(given: Input, settings: Settings) -> dict[str, Any]:
    """Return what tells this run from another, as JSON holds it."""
    about = {"version": __version__, "input": given.marks} | asdict(settings)
    described: dict[str, Any] = json.loads(json.dumps(about))
    return described


def open_folder(folder: Path, about: dict[str, Any], resume: bool) -> dict[str, Any] | None:
    """Make the folder of a run, or go on in it; return the counts if the run has ended.

    A folder that holds anything else, or a run of other input or settings, is refused.
    """
    record = folder / "crustline.json"
    if not record.exists():
        if folder.exists() and any(folder.iterdir()):
            raise InputError(f"{folder} holds other files: give a new folder, or an empty one")
        folder.mkdir(parents=True, exist_ok=True)
        save(folder, about, None)
        return None
    try:
        held = json.loads(record.read_text(encoding="utf-8"))
    except ValueError:
        raise InputError(f"{record} is damaged: give another folder") from None
    different = [key for key, value in about.items() if held["run"].get(key) != value]
    if different or not resume:
        what = (
            f"another {' and '.join(different)}"
            if different
            else "a run already, and resume is off"
        )
        raise InputError(
            f"{folder} holds {what}: give another folder, or the same input and settings"
        )
    clean(folder)
    counts: dict[str, Any] | None = held["counts"]
    return counts


def save(folder: Path, about: dict[str, Any], counts: dict[str, Any] | None) -> None:
    """Write what the folder holds; `counts` once the run has ended."""
    content = json.dumps({"run": about, "counts": counts}, indent=1)
    write(folder, "crustline.json", lambda part: part.write_text(content + "\n", encoding="utf-8"))
