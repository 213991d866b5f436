"""Run numbered trials in a process of their own, and go on after one that ends it.

A trial returns what is wrong, or None. One that crashes the process, takes more than `seconds` of
processor time, waits for ever, or needs more than `room` bytes beside what was there before, is a
fault like any other: the process is made anew, and the next number has its turn.
"""

from __future__ import annotations

import mmap
import os
import resource
import signal
import struct
import tempfile
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import BinaryIO, NoReturn

Trial = Callable[[int], str | None]

SECONDS, ROOM = 5.0, 1 << 30
#: Seconds of no work at all after which a trial is taken to wait for ever, on a busy machine too.
DEADLOCK = 600.0
_PAUSE = 0.05


@dataclass
class Watch:
    """Trials from 0 to `count`, each under the limits.

    Attributes
    ----------
    slowest : float
        Processor seconds of the longest trial that ended.
    resident : list of int
        Bytes in memory after each twentieth of the trials, in the process that ran them.
    """

    trial: Trial
    count: int
    seconds: float = SECONDS
    room: int = ROOM
    slowest: float = 0.0

    def __post_init__(self) -> None:
        self.resident: list[int] = []
        self._shared = mmap.mmap(-1, 16)  # the number of the running trial, the longest time

    def faults(self) -> Iterator[tuple[int, str]]:
        """Run all trials; yield the number of each that is wrong, and what is wrong."""
        first = 0
        while first < self.count:
            with tempfile.TemporaryFile() as told:
                child = os.fork()
                if child == 0:
                    self._run(first, told.fileno())
                try:
                    ended = yield from self._wait(child, told)
                finally:
                    _end(child)
            number, self.slowest = struct.unpack("qd", self._shared[:])
            if ended:
                yield number, ended
            first = number + 1

    def _run(self, first: int, told: int) -> NoReturn:
        """Be the child: run the trials and say what is wrong with each."""
        resource.setrlimit(resource.RLIMIT_DATA, (_memory("VmData") + self.room, -1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        slowest, every = self.slowest, max(1, self.count // 20)
        for number in range(first, self.count):
            self._shared[:] = struct.pack("qd", number, slowest)
            begin = time.process_time()
            fault = self.trial(number)
            slowest = max(slowest, time.process_time() - begin)
            if fault is not None:
                os.pwrite(told, f"{number} {fault!r:.400}\n".encode(), os.fstat(told).st_size)
            if number % every == every - 1:
                line = f"resident {_memory('VmRSS')}\n".encode()
                os.pwrite(told, line, os.fstat(told).st_size)
        self._shared[:] = struct.pack("qd", self.count, slowest)
        os._exit(0)

    def _wait(self, child: int, told: BinaryIO) -> Generator[tuple[int, str], None, str | None]:
        """Wait for the child and yield what it tells; return how it ended, if not as it should."""
        number, work, change = -1, 0.0, time.monotonic()
        while True:
            ended, status = os.waitpid(child, os.WNOHANG)
            yield from self._faults_in(told)
            if ended:
                return None if status == 0 else f"ended the process, status {status}"
            now = struct.unpack("q", self._shared[:8])[0]
            if now != number:
                number, work, change = now, _work(child), time.monotonic()
            elif _work(child) - work > self.seconds or time.monotonic() - change > DEADLOCK:
                return f"over {self.seconds:g} s"
            time.sleep(_PAUSE)

    def _faults_in(self, told: BinaryIO) -> Iterator[tuple[int, str]]:
        for line in told.readlines():
            number, _, fault = line.decode().rstrip().partition(" ")
            if number == "resident":
                self.resident.append(int(fault))
            else:
                yield int(number), fault


def _end(child: int) -> None:
    """End a child that has not ended."""
    with suppress(ChildProcessError):
        if os.waitpid(child, os.WNOHANG)[0] == 0:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


def _work(process: int) -> float:
    """Return the processor seconds of a process."""
    with open(f"/proc/{process}/stat") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _memory(kind: str) -> int:
    """Return the bytes of a kind of memory that this process has."""
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith(kind))
