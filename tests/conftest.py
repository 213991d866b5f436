"""Lets the tests import their own modules (`oracle`, `generators`) and fixes hypothesis' seed."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from hypothesis import settings

TESTS = Path(__file__).resolve().parent
sys.path.insert(0, str(TESTS))

settings.register_profile(
    "crustline", derandomize=True, deadline=None, database=None, max_examples=80
)
settings.load_profile("crustline")


@pytest.fixture(scope="session")
def examples() -> Path:
    """The folder of example data."""
    return TESTS.parent / "examples"
