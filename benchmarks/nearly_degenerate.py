"""Nearly degenerate points, from distances of one ulp up, against themselves in general position.

python -m benchmarks.nearly_degenerate 3000
"""

import sys
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from statistics import median
from time import process_time

import numpy as np

SIZE = 10**5
TURNS = 3
#: Relative distances; at the last one the points are in general position.
DISTANCES = (2.0**-52, *(10.0**k for k in (-15, -14, -13, -12, -11, -10, -8, -6)))
GENERAL = 1e-2
TASKS = ("crust", "medial_axis", "certify")

Generator = np.random.Generator


def noisy(points: np.ndarray, d: float | np.ndarray, rng: Generator) -> np.ndarray:
    """Return the points, each coordinate moved by up to d times itself."""
    return points * (1 + d * rng.uniform(-1, 1, points.shape))


def circle(n: int, radius: float | np.ndarray = 1.0) -> np.ndarray:
    angles = 2 * np.pi * np.arange(n) / n
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles)])


def flower(n: int) -> np.ndarray:
    return circle(n, 30 + 5 * np.sin(10 * np.pi * np.arange(n) / n))


def pairs(n: int, d: float, rng: Generator) -> np.ndarray:
    points = rng.uniform(1, 3, (n // 2, 2))
    return np.concatenate([points, noisy(points, d, rng)])


def two_exports(n: int, d: float, rng: Generator) -> np.ndarray:
    return np.concatenate([flower(n // 2), noisy(flower(n // 2), d, rng)])


def two_scales(n: int, d: float, rng: Generator) -> np.ndarray:
    return np.concatenate([flower(n // 2), (1 + d) * flower(n // 2)])


def lattice(n: int, d: float, rng: Generator) -> np.ndarray:
    side = round(n**0.5)
    return noisy(1.0 + np.argwhere(np.ones((side, side))), d, rng)


def one_circle(n: int, d: float, rng: Generator) -> np.ndarray:
    return noisy(circle(n), d, rng)


def concentric_circles(n: int, d: float, rng: Generator) -> np.ndarray:
    return np.concatenate([circle(n // 2), circle(n // 2, 1 + d)])


def clusters(n: int, d: float, rng: Generator) -> np.ndarray:
    return noisy(np.repeat(rng.uniform(1, 3, (n // 10, 2)), 10, axis=0), d, rng)


def rings(n: int, d: float, rng: Generator) -> np.ndarray:
    centers = 3.0 * np.column_stack(np.divmod(np.arange(n // 100), round((n // 100) ** 0.5)))
    return noisy((centers[:, None] + circle(100)).reshape(-1, 2), d, rng)


def one_line(n: int, d: float, rng: Generator) -> np.ndarray:
    x = rng.uniform(1, 3, n)
    return np.column_stack([x, x * (1 + d * rng.uniform(-1, 1, n))])


def few_lines(n: int, d: float, rng: Generator) -> np.ndarray:
    x = rng.uniform(1, 3, n)
    return np.column_stack([x, (x + np.arange(n) % 5) * (1 + d * rng.uniform(-1, 1, n))])


def parallel_strands(n: int, d: float, rng: Generator) -> np.ndarray:
    x = np.repeat(1 + np.arange(n // 3) / (n // 3), 3)
    return np.column_stack([x, x * (1 + d * (np.arange(len(x)) % 3))])


KINDS: tuple[Callable[[int, float, Generator], np.ndarray], ...] = (
    pairs, two_exports, two_scales, lattice, one_circle, concentric_circles, clusters, rings,
    one_line, few_lines, parallel_strands,
)  # fmt: skip


def nearly_degenerate(size: int = SIZE, turns: int = TURNS) -> dict[str, float]:
    """Return for each kind of points, task and distance the median ratio of processor times.

    Each turn measures all distances of a kind, and general position just before them, on one
    thread; a ratio is of the same turn.
    """
    if find_spec("crustline") is None:
        return {}
    ratios: dict[str, list[float]] = {}
    for kind in KINDS:
        for seed in range(turns):
            general = processor_seconds(kind(size, GENERAL, np.random.default_rng(seed)))
            for d in DISTANCES:
                times = processor_seconds(kind(size, d, np.random.default_rng(seed)))
                for task, time, usual in zip(TASKS, times, general, strict=True):
                    name = f"{kind.__name__.replace('_', ' ')}, {task}, {d:.0e}"
                    ratios.setdefault(name, []).append(time / usual)
    return {name: median(each) for name, each in ratios.items()}


def processor_seconds(points: np.ndarray) -> list[float]:
    """Return what the crust takes of a triangulation, and the axis and the certificate of both."""
    import crustline as cl

    delaunay = cl.Delaunay(points, threads=1)
    start = process_time()
    edges = cl.crust(delaunay)
    times = [process_time() - start]
    for task in (cl.medial_axis, cl.certify):
        start = process_time()
        task(delaunay, edges)
        times.append(process_time() - start)
    return times


def worst(ratios: dict[str, float]) -> Iterator[tuple[str, list[tuple[float, str]]]]:
    """Yield each kind of points, and for each task the largest ratio and where it was."""
    found: dict[str, dict[str, tuple[float, str]]] = {}
    for name, ratio in ratios.items():
        kind, task, distance = name.split(", ")
        tasks = found.setdefault(kind, dict.fromkeys(TASKS, (0.0, "")))
        tasks[task] = max(tasks[task], (ratio, distance))
    for kind, tasks in found.items():
        yield kind, [tasks[task] for task in TASKS]


if __name__ == "__main__":
    size = int(sys.argv[1]) if len(sys.argv) > 1 else SIZE
    for kind, tasks in worst(nearly_degenerate(size)):
        figures = zip(TASKS, tasks, strict=True)
        print(f"{kind}:", ", ".join(f"{task} {r:.1f} ({at})" for task, (r, at) in figures))
