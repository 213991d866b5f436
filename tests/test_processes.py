"""Processes: forked ones work as their parents do; threads and memory have an end."""

from __future__ import annotations

import operator
import os
import signal
import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork")

#: Longer than any of these takes; only a deadlock is stopped by it.
DEADLOCK = 600

PARENT = """
import concurrent.futures, multiprocessing, os, sys
import numpy as np
import crustline as cl
points = np.random.default_rng(1).random((20_000, 2))
few = points[:3_000]
def work(threads=None):
    delaunay = cl.Delaunay(points, threads=threads)
    edges = cl.crust(delaunay)
    cl.medial_axis(delaunay, edges)
    cl.certify(few)
    return len(delaunay.triangles), len(edges)
expected = work()
fork = multiprocessing.get_context("fork")
"""

FORKS = {
    "multiprocessing": """
with fork.Pool(2) as pool:
    found = pool.map(work, [None, 1, 2])
""",
    "concurrent_futures": """
with concurrent.futures.ProcessPoolExecutor(2, mp_context=fork) as pool:
    found = list(pool.map(work, [None, 1, 2]))
""",
    "a_child_of_a_child": """
def below(_):
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=fork) as pool:
        return pool.submit(work).result()
with concurrent.futures.ProcessPoolExecutor(1, mp_context=fork) as pool:
    found = [pool.submit(below, 0).result(), work()]
""",
    "a_pre_forking_server": """
found = []
children = []
for _ in range(3):
    reader, writer = os.pipe()
    if os.fork() == 0:
        for _ in range(2):
            answer = work()
        os.write(writer, repr(answer).encode())
        os._exit(0)
    os.close(writer)
    children.append(reader)
found = [eval(os.read(reader, 100).decode()) for reader in children]
""",
    "joblib": """
import joblib
found = joblib.Parallel(2, backend="multiprocessing")(joblib.delayed(work)(k) for k in (None, 1))
found += joblib.Parallel(2)(joblib.delayed(work)(k) for k in (None, 1))
""",
}


def run(script: str, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a script in a session of its own, so that no process of it outlives a deadlock."""
    with subprocess.Popen(
        [sys.executable, "-c", script, *arguments],
        env=os.environ | environment,
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            out, err = process.communicate(timeout=DEADLOCK)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            pytest.fail("a deadlock")
    return subprocess.CompletedProcess([], process.returncode, out, err)


@pytest.mark.parametrize("how", FORKS)
@pytest.mark.parametrize("threads", ["", "1"])
def test_a_forked_process_works_as_its_parent_does(how: str, threads: str) -> None:
    environment = {"RAYON_NUM_THREADS": threads} if threads else {}
    done = run(f"{PARENT}{FORKS[how]}\nassert set(found) == {{expected}}, found", **environment)
    assert done.returncode == 0, done.stderr


def test_a_process_that_forks_before_it_works() -> None:
    script = PARENT.replace("expected = work()", "") + FORKS["a_pre_forking_server"]
    done = run(f"{script}\nassert set(found) == {{work()}}, found")
    assert done.returncode == 0, done.stderr


COUNT = """
import crustline as cl, numpy as np
cl.Delaunay, cl.InputError  # are imported here, while there is memory
points = np.random.default_rng(1).random((20_000, 2))
"""


@pytest.mark.parametrize("asked", ["RAYON_NUM_THREADS", "threads"])
def test_threads_are_capped(asked: str) -> None:
    threads = "1000" if asked == "threads" else "None"
    script = (
        f"{COUNT}delaunay = cl.Delaunay(points, threads={threads})\n"
        "status = open('/proc/self/status').read()\n"
        "print(int(status.split('Threads:')[1].split()[0]))"
    )
    if not os.path.exists("/proc/self/status"):
        pytest.skip("threads are counted in /proc")
    environment = {"RAYON_NUM_THREADS": "100000"} if asked == "RAYON_NUM_THREADS" else {}
    done = run(script, **environment)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) <= 2 + 4 * max(4, os.cpu_count() or 1) + 64


def test_threads_that_the_system_does_not_give_are_told_in_a_line() -> None:
    """`--threads 3000` where memory is limited was a traceback of a panic."""
    script = (
        "import resource\n"
        f"{COUNT}cl.Delaunay, cl.InputError  # which loads them while there is room\n"
        "size = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
        "resource.setrlimit(resource.RLIMIT_AS, (size + (1 << 21), -1))\n"
        "try:\n"
        "    cl.Delaunay(points, threads=7)\n"
        "except (cl.InputError, MemoryError) as error:\n"
        "    print(error)\n"
    )
    if not os.path.exists("/proc/self/statm"):
        pytest.skip("memory is measured in /proc")
    done = run(script)
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.splitlines()) == 1, done.stdout


# The room left is just above and just below what a call needs, and far from either.
MEMORY = """
import resource, sys
import numpy as np
import crustline as cl
many = np.random.default_rng(1).random((600_000, 2))  # more than what comes first has given back
points, few = many[:200_000], many[:20_000]
cl.certify(few)
cl.medial_axis(few)
delaunay = cl.Delaunay(points)
edges = cl.crust(delaunay)
calls = {
    "crust": lambda: cl.crust(many),
    "medial_axis": lambda: cl.medial_axis(delaunay, edges),
    "certify": lambda: cl.certify(delaunay, edges),
    "trace": lambda: cl.trace(delaunay, edges),
}
size = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (size + (int(sys.argv[1]) << 20), -1))
for name, call in calls.items():
    try:
        call()
        print(name, "done")
    except MemoryError as error:
        print(name, error)
print(len(cl.crust(few[:2_000])))
"""


@pytest.mark.parametrize("room", [1, 30, 60, 90, 400])
def test_memory_that_is_not_there_is_an_error_and_not_the_end_of_the_process(room: int) -> None:
    """Three million points under `ulimit -v 400000` aborted the interpreter."""
    if not os.path.exists("/proc/self/statm"):
        pytest.skip("memory is measured in /proc")
    done = run(MEMORY, str(room))
    assert done.returncode == 0, done.stderr
    *told, last = done.stdout.splitlines()
    assert int(last) > 1000
    assert len(told) == 4
    refused = ["MB of memory are needed" in line or "allocate" in line for line in told]
    finished = [line.endswith(" done") for line in told]
    assert all(map(operator.xor, refused, finished))
    if room == 1:
        assert all(refused[:3])  # a trace may fit into what they have given back
    if room == 400:
        assert all(finished)


# The skeleton of a circle's points for β < 1 is quadratic; how large is not known before.
GROWING = """
import resource
import numpy as np
import crustline as cl
angles = np.arange(3_000) * 2 * np.pi / 3_000
circle = cl.Delaunay(np.column_stack([np.cos(angles), np.sin(angles)]), threads=1)
lattice = cl.Delaunay(np.argwhere(np.ones((100, 100))), threads=1)
calls = {
    "beta_skeleton": lambda: cl.beta_skeleton(circle, 0.5),
    "alpha_shape": lambda: cl.alpha_shape(lattice, 1e6),
    "crust": lambda: cl.crust(circle),
}
for delaunay in (circle, lattice):
    cl.one_step_crust(delaunay)
size = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (size + (16 << 20), -1))
for name, call in calls.items():
    try:
        print(name, len(call()))
    except MemoryError as error:
        print(name, error)
"""


def test_results_that_outgrow_memory_are_an_error_and_not_the_end_of_the_process() -> None:
    if not os.path.exists("/proc/self/statm"):
        pytest.skip("memory is measured in /proc")
    done = run(GROWING)
    assert done.returncode == 0, done.stderr
    beta, alpha, crust = done.stdout.splitlines()
    assert "MB of memory are needed" in beta
    assert alpha == "alpha_shape 396"
    assert crust == "crust 3000"


# Eight of each at once, on sets of many sizes; every answer is that of a call by itself.
CROWD = """
import concurrent.futures, multiprocessing, sys
import numpy as np
import crustline as cl
rng = np.random.default_rng(1)
sets = [rng.random((n, 2)) for n in (3, 10, 100, 1_000, 3_000, 10_000)] * 4
def work(points):
    delaunay = cl.Delaunay(points)
    edges = cl.crust(delaunay)
    return cl.medial_axis(delaunay, edges).vertices.sum(), edges.sum(), len(cl.certify(few).edges)
few = sets[2]
expected = [work(points) for points in sets]
if sys.argv[1] == "threads":
    crowd = concurrent.futures.ThreadPoolExecutor(8)
else:
    fork = multiprocessing.get_context("fork")
    crowd = concurrent.futures.ProcessPoolExecutor(8, mp_context=fork)
with crowd:
    assert list(crowd.map(work, sets)) == expected
"""


@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_eight_at_once_answer_as_one_does(kind: str) -> None:
    done = run(CROWD, kind)
    assert done.returncode == 0, done.stderr


THREADS = """
import os
import numpy as np
import crustline as cl
points = np.random.default_rng(1).random((20_000, 2))
before = len(os.listdir("/proc/self/task"))
delaunay = cl.Delaunay(points, threads=1)
for name in ("triangles", "halfedges", "hull", "circumcenters", "circumradii", "edges"):
    getattr(delaunay, name)
edges = cl.crust(delaunay)
cl.trace(delaunay, edges)
cl.medial_axis(delaunay, edges)
cl.certify(delaunay, edges)
cl.local_feature_size(delaunay, edges)
assert len(os.listdir("/proc/self/task")) == before + 1
"""


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="the system lists no threads")
def test_one_thread_is_one_thread_for_all_that_a_triangulation_is_asked_for() -> None:
    subprocess.run([sys.executable, "-c", THREADS], check=True, timeout=DEADLOCK)
