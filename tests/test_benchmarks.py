"""docs/benchmarks.md is what the generator makes of the stored figures, and nothing else."""

from __future__ import annotations

import json

import pytest
from benchmarks import table


def test_the_page_is_the_generators_output() -> None:
    if not table.RESULTS.exists():
        pytest.skip("benchmarks/results.json is stored by the next `make bench`")
    figures = json.loads(table.RESULTS.read_text(encoding="utf-8"))
    assert (table.DOCS / "benchmarks.md").read_text(encoding="utf-8") == table.page(figures)
