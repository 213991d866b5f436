"""Files that once broke a reader: each ends in an answer or one sentence."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

from fuzz.readers import CORPUS, SEEDS, fault_of, fuzz


@pytest.mark.parametrize("path", sorted(CORPUS.iterdir()), ids=lambda path: path.name)
def test_what_once_broke_a_reader(path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert fault_of(path.name.split("-")[0], path.read_bytes()) is None


@pytest.mark.parametrize("key", SEEDS)
def test_a_few_mutated_files(key: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fuzz.readers.CORPUS", tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert fuzz(key, 150, 0) == []
