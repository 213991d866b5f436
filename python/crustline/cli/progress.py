"""The progress bar: on standard error, if that is a terminal and the work turns out to be long.

Programs that run the command set CRUSTLINE_PROGRESS=lines: they get a line for each percent.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Progress = Callable[[str, float], None]
_PATIENCE = 0.5  # seconds before a progress bar appears


@contextmanager
def progress_bar(quiet: bool) -> Iterator[Progress | None]:
    """Yield what methods report to: a bar on standard error, if that is a terminal."""
    if os.environ.get("CRUSTLINE_PROGRESS") == "lines":
        yield _Lines()
        return
    if quiet or not sys.stderr.isatty():
        yield None
        return
    bar = _Bar()
    try:
        yield bar
    finally:
        bar.stop()


class _Bar:
    """A bar that appears when the work turns out to be long; rich is imported only then."""

    def __init__(self) -> None:
        self.started = time.perf_counter()
        self.display: Any = None

    def __call__(self, stage: str, fraction: float) -> None:
        if self.display is None:
            if time.perf_counter() - self.started < _PATIENCE:
                return
            self._start()
        self.display.update(self.task, description=stage, completed=fraction)

    def _start(self) -> None:
        from rich.console import Console
        from rich.progress import Progress

        self.display = Progress(console=Console(stderr=True), transient=True)
        self.task = self.display.add_task("", total=1.0)
        self.display.start()

    def stop(self) -> None:
        if self.display is not None:
            self.display.stop()


class _Lines:
    """A line on standard error for each percent of each stage, for programs that read them."""

    def __init__(self) -> None:
        self.last = ""

    def __call__(self, stage: str, fraction: float) -> None:
        line = f"crustline: progress: {stage}: {100 * fraction:.0f}%"
        if line != self.last:
            self.last = line
            print(line, file=sys.stderr, flush=True)
