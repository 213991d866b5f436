"""What a run took: by stage and by worker."""

from __future__ import annotations

import json
from typing import Any

from crustline.distributed.ledger import Done
from crustline.distributed.run import Run
from crustline.distributed.store import write


def write_report(run: Run, counts: dict[str, Any], crs: Any) -> None:
    """Write report.json."""
    done = run.ledger.all()
    stages: dict[str, list[Done]] = {}
    for each in done:
        stages.setdefault(each.stage, []).append(each)
    workers: dict[str, int] = {}
    for each in done:
        process = each.cost["process"]
        workers[process] = max(workers.get(process, 0), each.cost["peak"])
    report = {
        "counts": counts,
        "crs": crs,
        "stages": {name: _summed(steps) for name, steps in stages.items()},
        "peak_memory": workers,
    }
    content = json.dumps(report, indent=1)
    write(run.folder, "report.json", lambda part: part.write_text(content + "\n", encoding="utf-8"))


def _summed(steps: list[Done]) -> dict[str, Any]:
    """Return the sums of a stage's steps."""
    sums: dict[str, Any] = {
        "steps": len(steps),
        "wall": round(sum(each.cost["wall"] for each in steps), 3),
        "cpu": round(sum(each.cost["cpu"] for each in steps), 3),
        "bytes": sum(file.size for each in steps for file in each.files),
    }
    for each in steps:
        for name, value in each.counts.items():
            if isinstance(value, int):
                sums[name] = sums.get(name, 0) + value
            elif name == "open":
                held = sums.setdefault(name, [])
                held += [0] * (len(value) - len(held))
                for k, count in enumerate(value):
                    held[k] += count
    return sums
