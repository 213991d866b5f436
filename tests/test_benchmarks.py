"""docs/benchmarks.md is what the generator makes of the stored figures, and nothing else."""

from __future__ import annotations

from benchmarks import nearly_degenerate, results, table


def test_the_page_is_the_generators_output() -> None:
    page = table.page(results.Results(results.load()))
    assert (table.DOCS / "benchmarks.md").read_text(encoding="utf-8") == page


def test_a_family_replaces_what_was_stored_of_it_and_nothing_else(tmp_path, monkeypatch) -> None:  # type: ignore[no-untyped-def]
    monkeypatch.setattr(results, "RESULTS", tmp_path / "results.json")
    one, other = {"seconds": {"10": 1.0}}, {"seconds": {"10": 2.0}}
    results.store(results.SMALL_CALLS, one)
    results.store(results.LIMITS, one)
    results.store(results.SMALL_CALLS, other)
    assert results.load() == {results.SMALL_CALLS: other, results.LIMITS: one}


def test_nearly_degenerate_points_are_measured_for_each_kind_task_and_distance() -> None:
    ratios = nearly_degenerate.nearly_degenerate(size=300, turns=1)
    kinds, distances = len(nearly_degenerate.KINDS), len(nearly_degenerate.DISTANCES)
    assert len(ratios) == kinds * distances * len(nearly_degenerate.TASKS)
    machine = {"date": "", "load": ""}
    page = table.page(
        results.Results({results.NEARLY_DEGENERATE: {"machine": machine, "seconds": ratios}})
    )
    for kind, tasks in nearly_degenerate.worst(ratios):
        assert f"| {kind} | {tasks[0][0]:.1f} ({tasks[0][1]}) |" in page
