"""Fixes hypothesis' seed, and says where the example data is."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile(
    "crustline", derandomize=True, deadline=None, database=None, max_examples=80
)
settings.load_profile("crustline")


@pytest.fixture(scope="session")
def examples() -> Path:
    """The folder of example data."""
    return Path(__file__).resolve().parent.parent / "examples"
