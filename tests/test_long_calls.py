"""Long calls: they report progress, stop at Ctrl-C, and give the same on any number of threads."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import crustline as cl
from crustline.errors import InputError

#: So many that a call takes several times as long as it waits before it reports.
POINTS = np.random.default_rng(5).random((2_000_000, 2))


def test_progress_names_stages_in_order_and_fractions_between_0_and_1() -> None:
    seen: list[tuple[str, float]] = []
    cl.crust(cl.Delaunay(POINTS, threads=1, progress=lambda *state: seen.append(state)))
    stages = list(dict.fromkeys(stage for stage, _ in seen))
    order = ["sort", "triangulate", "stars", "select"]
    assert stages == [stage for stage in order if stage in stages]
    assert "triangulate" in stages
    assert all(0.0 <= fraction <= 1.0 for _, fraction in seen)


def test_an_error_in_the_progress_callback_stops_the_call_and_arrives() -> None:
    def refuse(stage: str, fraction: float) -> None:
        raise LookupError(stage)

    with pytest.raises(LookupError):
        cl.Delaunay(POINTS, progress=refuse)


SCRIPT = """
import os, signal, sys, threading, time
import numpy as np
import crustline as cl
points = np.random.default_rng(1).random((400_000, 2))
def call():
    cl.crust(cl.Delaunay(points))
def heard(number, frame):
    global start
    start = time.process_time()
    raise KeyboardInterrupt
signal.signal(signal.SIGINT, heard)
before, begin = time.process_time(), time.perf_counter()
call()
whole, length = time.process_time() - before, time.perf_counter() - begin
timer = threading.Timer(float(sys.argv[1]) * length, os.kill, (os.getpid(), signal.SIGINT))
timer.start()
try:
    while True:
        call()
except KeyboardInterrupt:
    print((time.process_time() - start) / whole)
"""


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_ctrl_c_stops_a_long_call_after_little_more_work(share: float) -> None:
    """Work is processor time, as a part of the whole call's: load changes neither."""
    command = [sys.executable, "-c", SCRIPT, str(share)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert float(done.stdout) < 0.5


@pytest.mark.parametrize("kind", ["uniform", "lattice", "circle"])
def test_the_number_of_threads_changes_nothing(kind: str) -> None:
    angles = np.arange(50_000) * 2 * np.pi / 50_000
    points = {
        "uniform": POINTS[:50_000],
        "lattice": np.argwhere(np.ones((200, 250))).astype(float),
        "circle": np.column_stack([np.cos(angles), np.sin(angles)]),
    }[kind]
    one, three = (cl.Delaunay(points, threads=threads) for threads in (1, 3))
    for name in ("triangles", "halfedges", "hull", "circumcenters", "edges"):
        assert np.array_equal(getattr(one, name), getattr(three, name)), name
    assert np.array_equal(cl.crust(one), cl.crust(three))


@pytest.mark.parametrize("threads", [0, -1, 1.5, "2", True])
def test_a_number_of_threads_that_cannot_be_had_is_refused(threads: object) -> None:
    with pytest.raises(InputError, match="threads must be a whole number from 1 to"):
        cl.Delaunay(POINTS[:10], threads=threads)  # type: ignore[arg-type]
