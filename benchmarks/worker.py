"""A contender at work: one process that holds the points and runs when it is told to."""

import json
import os
import select
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from .data import BUILD
from .rivals import Contender


class ContenderFailedError(Exception):
    """A contender crashed, refused its input, or took too long; the message is for the table."""


class Worker:
    """A process of its own, so that its peak memory and processor time are its own."""

    def __init__(self, contender: Contender, path: Path, timeout: float) -> None:
        self.contender = contender
        self.timeout = timeout
        self.errors = tempfile.TemporaryFile("w+")  # noqa: SIM115 (close ends it)
        self.process = subprocess.Popen(
            (*contender.command, str(path)),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self.errors,
            env=os.environ | {"RAYON_NUM_THREADS": str(contender.threads)},
            text=True,
        )
        assert self.process.stdout is not None
        self.answers = self.process.stdout

    def wait_for_points(self) -> None:
        """Wait until the points are loaded, which is what the first answer says."""
        self.read()

    def run(self, repeats: int) -> dict[str, float]:
        """Run some times, and return the mean seconds of `wall` and `cpu`."""
        return self.ask(f"run {repeats}")

    def first_run(self) -> tuple[dict[str, float], int]:
        """Run for the first time; return the seconds, and the peak bytes over the points."""
        self.process_file("clear_refs").write_text("5")  # resets the peak, says proc(5)
        before = self.memory("VmRSS")
        seconds = self.run(1)
        return seconds, self.memory("VmHWM") - before

    def edges(self) -> np.ndarray:
        """Return the edges, rows in any order."""
        path = BUILD / "edges.i32"
        self.ask(f"edges {path}")
        return np.fromfile(path, "<i4").reshape(-1, 2)

    def close(self) -> None:
        self.process.kill()
        self.process.communicate()
        self.errors.close()

    def ask(self, request: str) -> dict[str, float]:
        try:
            print(request, file=self.process.stdin, flush=True)
        except BrokenPipeError:
            raise ContenderFailedError(self.last_words()) from None
        return self.read()

    def read(self) -> dict[str, float]:
        ready, _, _ = select.select([self.answers], [], [], self.timeout)
        if not ready:
            raise ContenderFailedError(f"too slow: more than {self.timeout:.0f} s")
        line = self.answers.readline()
        if not line:
            raise ContenderFailedError(self.last_words())
        answer: dict[str, float] = json.loads(line)
        return answer

    def last_words(self) -> str:
        status = self.process.wait()
        self.errors.seek(0)
        lines = self.errors.read().splitlines()
        errors = [line for line in lines if "Error: " in line or "panicked" in line] or lines
        return f"fails: {errors[-1][:100]}" if errors else f"crashes with status {status}"

    def memory(self, field: str) -> int:
        for line in self.process_file("status").read_text().splitlines():
            if line.startswith(f"{field}:"):
                return int(line.split()[1]) * 1024
        raise ContenderFailedError(f"the system does not tell {field}")

    def process_file(self, name: str) -> Path:
        return Path("/proc", str(self.process.pid), name)
