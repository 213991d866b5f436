"""The Dask client that a run uses: the caller's own, or one for this machine within a limit."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from crustline.errors import InputError, require

#: The share of the machine's memory, or its cgroup's, that a run may take by itself.
_SHARE = 0.6
#: What a process takes before it has any points.
_BASE = 170_000_000
#: What a point of a tile takes at most: 480 bytes, and some tiles have half as many points more.
_POINT = 800
#: The least that a worker is given.
_WORKER = 400_000_000
#: Seconds to wait for a scheduler.
_PATIENCE = 10
#: What Dask's workers are told: not to keep samples of what they do, some 15 kB for each step, and
#: not to warn of ticks that a long step holds up.
ENGINE = {"distributed.worker.profile.enabled": False, "distributed.admin.tick.limit": "1h"}


@dataclass(frozen=True)
class Crew:
    """A client, and how much memory each task has."""

    client: Any
    memory: int

    def tile_points(self) -> int:
        """Return how many points a tile may have."""
        return max(1000, min(1_000_000, (self.memory - _BASE) // _POINT))


@contextmanager
def crew(client: Any, scheduler: str | None, memory_limit: int | str | None) -> Iterator[Crew]:
    """Give the client, the one of a scheduler's address, or a cluster on this machine."""
    require("distributed", "distributed")
    from distributed import Client

    if client is not None:
        yield Crew(client, _memory_of(client, memory_limit))
        return
    if scheduler is not None:
        try:
            opened = Client(scheduler, timeout=_PATIENCE)
        except (OSError, ValueError) as error:
            message = (
                f"no scheduler answers at {scheduler} ({error}): start one or give another address"
            )
            raise InputError(message) from None
        with opened:
            yield Crew(opened, _memory_of(opened, memory_limit))
        return
    limit = memory_of(memory_limit)
    with _local(limit) as cluster, Client(cluster) as opened:
        yield Crew(opened, limit // len(cluster.workers))


def _local(limit: int) -> Any:
    from dask import config
    from dask.system import CPU_COUNT
    from distributed import LocalCluster

    workers = max(1, min(CPU_COUNT, limit // _WORKER))
    with config.set(ENGINE):
        return LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            memory_limit=limit // workers,
            dashboard_address="127.0.0.1:0",
        )


def memory_of(limit: int | str | None) -> int:
    """Return a number of bytes; by default a share of what the machine or its cgroup has."""
    from dask.utils import parse_bytes
    from distributed.system import MEMORY_LIMIT

    if limit is None:
        return int(_SHARE * MEMORY_LIMIT)
    try:
        size = int(parse_bytes(limit))
    except ValueError:
        raise InputError(
            f"memory_limit is {limit!r}: give bytes, or a size such as '8GB'"
        ) from None
    if size < _WORKER:
        raise InputError(
            f"memory_limit is {limit!r}, and a worker needs {_WORKER // 10**6} MB: give more"
        )
    return size


def _memory_of(client: Any, limit: int | str | None) -> int:
    """Return the least memory that a thread of the workers has."""
    if limit is not None:
        return memory_of(limit)
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    shares = [each["memory_limit"] // each["nthreads"] for each in workers if each["memory_limit"]]
    return min(shares, default=2_000_000_000)
