"""What a run took: by stage and by worker, as JSON and in a few lines."""

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
        "files": round(sum(each.cost["files"] for each in steps), 3),
        "peak": max(each.cost["peak"] for each in steps),
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


def in_lines(report: dict[str, Any]) -> list[str]:
    """Return a report in a few lines: what was seen and left open, time, files, memory."""
    counts, stages = report["counts"], report["stages"]
    rows = counts["rows"] - counts["duplicates"]
    tiles, rounds = stages["tiles"], stages.get("rounds", {})
    seconds = {name: stage["cpu"] for name, stage in stages.items()}
    on_files = sum(stage["files"] for stage in stages.values())
    slowest = sorted(seconds, key=seconds.__getitem__, reverse=True)[:3]
    peak = max(report["peak_memory"].values())
    return [
        f"tiles: {tiles['steps']:,} of {rows:,} points; "
        f"{tiles['halo']:,} more seen around them ({tiles['halo'] / max(1, rows):.2%})",
        f"open: {_open(tiles):,} after the tiles, {_open(rounds):,} after "
        f"{len(rounds.get('open', []))} rounds; {_coordinated(stages)} in one place",
        f"processors: {sum(seconds.values()):.1f} s, of it {on_files:.1f} s for files; "
        f"most in {', '.join(f'{name} ({seconds[name]:.1f} s)' for name in slowest)}",
        f"files: {sum(stage['bytes'] for stage in stages.values()) / 1e6:,.1f} MB written; "
        f"memory: {peak / 1e6:,.0f} MB at most in each of {len(report['peak_memory'])} processes",
    ]


def _open(stage: dict[str, Any]) -> int:
    return int(stage.get("open_vertices", 0)) + int(stage.get("open_edges", 0))


def _coordinated(stages: dict[str, Any]) -> str:
    points = stages.get("coordinator", {}).get("points", 0)
    return f"{points:,} points"
