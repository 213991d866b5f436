"""Fixes hypothesis' seed; says where the example data is, and what runs in tiles run on."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

settings.register_profile(
    "crustline", derandomize=True, deadline=None, database=None, max_examples=80
)
# For hours, and different each time: make fuzz.
settings.register_profile(
    "fuzz", deadline=None, max_examples=int(os.environ.get("EXAMPLES", "100000"))
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "crustline"))


@pytest.fixture(scope="session")
def examples() -> Path:
    """The folder of example data."""
    return Path(__file__).resolve().parent.parent / "examples"


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """One worker of Dask in this process: what runs there is what runs on a cluster."""
    with pytest.importorskip("distributed").Client(
        processes=False, n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0"
    ) as opened:
        yield opened


@pytest.fixture
def pieces_are_small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let small files in tiles be read in more than one piece."""
    from crustline.distributed import run

    monkeypatch.setattr(run, "_PIECE", 1)
