"""Files that once broke a reader: each ends in an answer or one sentence."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from crustline import CrustlineError
from fuzz.readers import CORPUS, fault_of, file_of, readings_of
from fuzz.seeds import seeds


@pytest.mark.parametrize("path", sorted(CORPUS.iterdir()), ids=lambda path: path.name)
def test_what_once_broke_a_reader(path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert fault_of(path.name.split("-")[0], path.read_bytes()) is None


@pytest.mark.parametrize("key", seeds())
def test_a_few_mutated_files(key: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for number in range(60):
            assert fault_of(key, file_of(key, number, 0)) is None, number


@pytest.mark.parametrize("key", seeds())
def test_what_is_sound_is_read(key: str) -> None:
    """Else the files above prove nothing."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for content in seeds()[key]:
            assert any(_is_read(reading, content) for reading in readings_of(key))


def _is_read(reading: Callable[[bytes], Any], content: bytes) -> bool:
    try:
        return reading(content) is not None
    except CrustlineError:
        return False
