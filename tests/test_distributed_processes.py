"""Runs on processes of their own: any number of workers, killed ones, killed clients, memory."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import crustline as cl

pytest.importorskip("distributed")
pytest.importorskip("pyarrow")

from dask import config
from distributed import Client, LocalCluster, WorkerPlugin

from crustline.distributed import reconstruct
from crustline.distributed.cluster import ENGINE
from tiled import KINDS, STAGES, agrees, arcs, coast, put

pytestmark = pytest.mark.usefixtures("pieces_are_small")


def workers(number, **options):
    """Workers of one thread each, told what a run of its own tells them."""
    with config.set(ENGINE):
        return LocalCluster(
            n_workers=number, threads_per_worker=1, dashboard_address="127.0.0.1:0", **options
        )


@pytest.fixture(scope="module", params=[1, 3])
def several(request):
    with workers(request.param) as cluster, Client(cluster) as opened:
        yield opened


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_the_number_of_workers_changes_nothing(several, tmp_path, kind):
    xy = kind(800, np.random.default_rng(20))
    source = put(tmp_path / "in", xy)
    agrees(reconstruct(source, tmp_path / "out", client=several, tile_points=100, halo=0), xy)


STEPS = {
    "partition": ("partition", "scatter"),
    "gather": ("partition", "gather"),
    "tiles": ("tile", "decide"),
    "rounds": ("tile", "settle"),
    "coordinator": ("tile", "coordinate"),
    "trace": ("stitch", "trace"),
    "stitch": ("stitch", "join"),
}


@pytest.mark.slow
@pytest.mark.parametrize(("module", "step"), STEPS.values(), ids=STEPS)
def test_a_worker_is_killed_before_its_file_has_its_name(tmp_path, module, step):
    def die_once(module, step, sentinel):
        import importlib

        owner = importlib.import_module(f"crustline.distributed.{module}")
        store = importlib.import_module("crustline.distributed.store")
        original = getattr(owner, step)

        def die(path):
            os.kill(os.getpid(), signal.SIGKILL)

        def dying(*arguments, **options):
            if not sentinel.exists():
                sentinel.touch()
                setattr(store, "_digest", die)  # noqa: B010 (a module has no such attribute for mypy)
            return original(*arguments, **options)

        setattr(owner, step, dying)

    xy = arcs(1000, np.random.default_rng(21))
    source, sentinel = put(tmp_path / "in", xy), tmp_path / "killed"
    with workers(2) as cluster, Client(cluster) as opened:
        opened.run(die_once, module, step, sentinel)
        options = {"tile_points": 60, "halo": 0, "rounds": 1}
        result = reconstruct(source, tmp_path / "out", client=opened, **options)
        agrees(result, xy)
    assert sentinel.exists()
    assert not list((tmp_path / "out").rglob("*.part"))


@pytest.mark.slow
def test_a_worker_killed_for_memory_is_said_and_the_run_goes_on_later(client, tmp_path):
    """Also the workers that start anew have every tile take more memory than there is."""

    class Greedy(WorkerPlugin):  # type: ignore[misc]
        def setup(self, worker):
            from crustline.distributed import tile

            def decide(*arguments, **options):
                held = []
                while True:
                    held.append(np.ones(1_000_000))
                    time.sleep(0.01)

            tile.decide = decide

    xy = arcs(600, np.random.default_rng(35))
    source = put(tmp_path / "in", xy)
    with workers(1, memory_limit="400MB") as cluster, Client(cluster) as opened:
        opened.register_plugin(Greedy())
        with pytest.raises(cl.CrustlineError, match=r"stage 'tiles' was lost .* give more memory"):
            reconstruct(source, tmp_path / "out", client=opened, tile_points=1000)
    agrees(reconstruct(source, tmp_path / "out", client=client, tile_points=1000), xy)
    assert not list((tmp_path / "out").rglob("*.part"))


CLIENT = """
import sys
import crustline.distributed as distributed
from distributed import Client

def say(name, fraction):
    print(name, flush=True)
    if name == sys.argv[3]:
        sys.stdin.read()

if __name__ == "__main__":
    with Client(processes=False, n_workers=1, dashboard_address="127.0.0.1:0") as client:
        distributed.reconstruct(
            sys.argv[1], sys.argv[2], client=client, tile_points=60, halo=0, rounds=1, progress=say
        )
"""


@pytest.mark.slow
@pytest.mark.parametrize("stage", STAGES)
def test_the_client_is_killed_and_the_run_resumed(client, tmp_path, stage):
    random = np.random.default_rng(22)
    xy = arcs(600, random)
    source = put(tmp_path / "in", xy)
    (tmp_path / "client.py").write_text(CLIENT)
    paths = [str(tmp_path / "client.py"), source, str(tmp_path / "out")]
    with subprocess.Popen(
        [sys.executable, *paths, stage], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as running:
        assert running.stdout is not None
        assert any(line.strip() == stage for line in running.stdout)
        running.kill()
    result = reconstruct(source, tmp_path / "out", client=client, tile_points=60, halo=0, rounds=1)
    agrees(result, xy)
    assert not list((tmp_path / "out").rglob("*.part"))


def test_memory_does_not_grow_with_the_points(tmp_path, monkeypatch):
    """A worker holds at most a third of the points' bytes more than for a fifth of them."""
    monkeypatch.undo()
    random = np.random.default_rng(26)
    few, many = 300_000, 1_500_000
    xy = coast(many, random)[random.permutation(many)]
    with workers(1) as cluster, Client(cluster) as opened:
        peaks = []
        for count in (few, many):
            source = put(tmp_path / f"in-{count}", xy[:count], files=4, group=25_000)
            options = {"client": opened, "tile_points": 15_000}
            result = reconstruct(source, tmp_path / f"out-{count}", **options)
            assert result.counts["rows"] == count
            peaks += result.report["peak_memory"].values()
        assert len(peaks) == 2, "a worker was lost"
    assert peaks[1] - peaks[0] < many * 24 / 3
