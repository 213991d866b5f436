"""Fixes hypothesis' seed, and says where the example data is."""

from __future__ import annotations

import os
from pathlib import Path

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
