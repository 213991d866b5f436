"""Slicing a large cloud against reading it with laspy alone: processor seconds, and peak memory.

    python -m benchmarks.clouds --count 10000000 --suffix laz --folder /tmp

The file is made in pieces, of points on the walls of a building of thirty floors, and removed at
the end. Both sides run in processes of their own, one after the other: one reads all points by
laspy in pieces of a million and looks at none, the other gives a slice of 2 cm as curves. Compare
processor seconds, of all threads, without the loading of packages; the machine may do other things.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import laspy
import numpy as np

PIECE = 1_000_000
SIDE, HEIGHT = 60.0, 90.0

READ = """
with laspy.open(path) as reader:
    count = sum(len(each) for each in reader.chunk_iterator(1_000_000))
"""
SLICE = """
(found,) = cl.slices(path, "z=45", thickness=0.02, scale=0.3, threads=1)
count = found.count
print(found, file=sys.stderr)
"""
MEASURED = """
import json, sys, time
import laspy, numpy as np
import crustline as cl
path = sys.argv[1]
circle = np.arange(300)[:, None] * [0.1, 0.2, 0.0]
cl.slices(np.c_[np.cos(circle[:, 0]), np.sin(circle[:, 0]), circle[:, 2]], "z=0", thickness=0.1)
started = time.process_time()
{program}
seconds = time.process_time() - started
with open("/proc/self/status") as file:  # the peak of this program, not of what started it
    peak = next(int(line.split()[1]) << 10 for line in file if line.startswith("VmHWM"))
print(json.dumps([count, seconds, peak]))
"""


def make(path: Path, count: int, kind: int) -> None:
    """Write a cloud in pieces: square walls with noise of 5 mm."""
    rng = np.random.default_rng(1)
    header = laspy.LasHeader(version="1.4", point_format=kind)
    header.scales, header.offsets = np.full(3, 0.001), np.array([5e5, 5.4e6, 0.0])
    corners = np.array([(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)])
    with laspy.open(path, "w", header=header) as file:
        for start in range(0, count, PIECE):
            size = min(PIECE, count - start)
            wall, along = rng.integers(0, 4, size), rng.random(size)[:, None]
            xy = corners[wall] * (1 - along) + corners[(wall + 1) % 4] * along
            record = laspy.ScaleAwarePointRecord.zeros(size, header=header)
            noise = rng.normal(0, 0.005, (2, size))
            record.x, record.y = xy.T + noise + header.offsets[:2, None]
            record.z = rng.uniform(0, HEIGHT, size)
            record.intensity = rng.integers(0, 1000, size)
            file.write_points(record)


def measured(program: str, path: Path) -> tuple[int, float, int]:
    """Return the count, the processor seconds and the peak bytes of a program in a process."""
    code = MEASURED.format(program=program)
    ran = subprocess.run(
        [sys.executable, "-c", code, str(path)], stdout=subprocess.PIPE, text=True, check=True
    )
    count, seconds, peak = json.loads(ran.stdout)
    return count, seconds, peak


def main() -> None:
    """Make the file, read and slice it, and print a row of a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000_000)
    parser.add_argument("--suffix", choices=["las", "laz"], default="laz")
    parser.add_argument("--point-format", type=int, choices=[6, 3], default=6)
    parser.add_argument("--folder", type=Path)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=given.folder) as folder:
        path = Path(folder, f"cloud.{given.suffix}")
        make(path, given.count, given.point_format)
        size = path.stat().st_size
        read, seconds, peak = measured(READ, path)
        near, own_seconds, own_peak = measured(SLICE, path)
        assert read == given.count
    print(
        f"{given.suffix} {given.point_format}: {given.count:,} points, {size >> 20:,} MB; laspy "
        f"{seconds:.1f} s, {peak >> 20} MB; slice of {near:,} points {own_seconds:.1f} s, "
        f"{own_peak >> 20} MB; ratio {own_seconds / seconds:.2f}"
    )


if __name__ == "__main__":
    main()
