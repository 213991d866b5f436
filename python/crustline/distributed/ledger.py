"""What a run has done: a line for each step, appended as it ends, so that a run can go on later."""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import platform
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from crustline.distributed.store import Written, file_seconds, named_faults

Step = Callable[..., tuple[list[Written], dict[str, Any]]]
"""Reads files of the run's folder and writes one or a few; returns them, and some counts."""


@dataclass(frozen=True)
class Done:
    """A step that was done.

    Attributes
    ----------
    stage, number : str, int
        Which step.
    files : list of Written
        What it wrote.
    counts : dict
        What it counted, as JSON can hold it.
    cost : dict
        Seconds (`wall`, `cpu`, and of these in reading and writing `files`), bytes of memory of its
        process at most (`peak`), and where it ran (`process`).
    """

    stage: str
    number: int
    files: list[Written]
    counts: dict[str, Any]
    cost: dict[str, Any] = field(default_factory=dict)


def perform(
    folder: str, stage: str, number: int, step: Step, arguments: dict[str, Any], before: Done | None
) -> Done:
    """Do a step, unless what it wrote before is there, undamaged."""
    if before is not None and is_intact(before, folder):
        return before
    wall, cpu, on_files = time.perf_counter(), time.process_time(), file_seconds()
    files, counts = step(Path(folder), **arguments)
    _give_back()
    cost = {
        "wall": time.perf_counter() - wall,
        "cpu": time.process_time() - cpu,
        "files": file_seconds() - on_files,
        "peak": _peak_memory(),
        "process": f"{platform.node()}:{os.getpid()}",
    }
    return Done(stage, number, files, counts, cost)


def _give_back() -> None:
    """Give memory that was freed back to the system, where malloc is asked to."""
    # Else small blocks that stay keep glibc's heap from shrinking, a little more with each step.
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)


def _peak_memory() -> int:
    """Return how many bytes this process has held at most; where no one tells, holds now."""
    with contextlib.suppress(OSError):
        # Of this process alone: getrusage also tells of the one that it was forked from.
        status = Path("/proc/self/status").read_text(encoding="ascii")
        return int(status.partition("VmHWM:")[2].split()[0]) * 1024
    import psutil

    held = psutil.Process().memory_info()
    return int(getattr(held, "peak_wset", held.rss))


def is_intact(done: Done, folder: str) -> bool:
    """Return whether the files of a step are there as they were written."""
    return all(file.is_in(Path(folder)) for file in done.files)


class Ledger:
    """The steps that have been done, in a file that only grows."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._done: dict[tuple[str, int], Done] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                self._take(line)

    def _take(self, line: str) -> None:
        try:
            entry = json.loads(line)
        except ValueError:
            # The line at which the run was killed.
            return
        entry["files"] = [Written(**each) for each in entry["files"]]
        done = Done(**entry)
        self._done[done.stage, done.number] = done

    def before(self, stage: str, number: int) -> Done | None:
        """Return what a step did before, if it was done."""
        return self._done.get((stage, number))

    def add(self, done: Done) -> None:
        """Note that a step was done."""
        if self.before(done.stage, done.number) is done:
            return
        self._done[done.stage, done.number] = done
        line = json.dumps(asdict(done)) + "\n"
        with named_faults(self._path):
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with self._path.open("a", encoding="utf-8") as file:
                file.write(line)

    def all(self) -> list[Done]:
        """Return all steps that were done."""
        return list(self._done.values())
