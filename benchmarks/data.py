"""The points of the benchmarks: seeded, cached as raw float64 that every language can read."""

from collections.abc import Callable
from math import isqrt, prod
from pathlib import Path

import numpy as np

BUILD = Path(__file__).parent / "build"
CURVE_SAMPLES = 500
RADIUS = 0.38
HARMONICS = np.arange(2, 6)

Generator = np.random.Generator


def uniform(n: int, rng: Generator) -> np.ndarray:
    return rng.random((n, 2))


def gaussian(n: int, rng: Generator) -> np.ndarray:
    return rng.standard_normal((n, 2))


def lattice(n: int, rng: Generator) -> np.ndarray:
    """The largest lattice of integers with isqrt(n) columns and at most n points, rows shuffled."""
    return rng.permutation(np.argwhere(np.ones(lattice_shape(n))).astype(float))


def circle(n: int, rng: Generator) -> np.ndarray:
    angles = rng.permutation(2 * np.pi * np.arange(n) / n)
    return np.column_stack([np.cos(angles), np.sin(angles)])


def curves(n: int, rng: Generator) -> np.ndarray:
    """n / 500 smooth closed curves of 500 samples, one in each cell of a grid, rows shuffled."""
    return rng.permutation(curve_samples(n, rng)[0])


def noisy_curves(n: int, rng: Generator) -> np.ndarray:
    """The same, every sample moved by Gaussian noise of a fifth of the mean spacing."""
    points, spacing = curve_samples(n, rng)
    return rng.permutation(points + rng.normal(scale=spacing / 5, size=points.shape))


def clustered(n: int, rng: Generator) -> np.ndarray:
    """Gaussian clusters of about a thousand points with radii from 1e-6 to 1."""
    clusters = max(n // 1000, 7)
    radii = 10.0 ** -rng.permutation(np.linspace(0, 6, clusters))
    member = rng.integers(clusters, size=n)
    return rng.random((clusters, 2))[member] + radii[member, None] * rng.standard_normal((n, 2))


def line(n: int, rng: Generator) -> np.ndarray:
    """Exactly collinear: doubling rounds nothing."""
    x = rng.random(n)
    return np.column_stack([x, 2 * x])


def parabola(n: int, rng: Generator) -> np.ndarray:
    x = rng.uniform(-1, 1, n)
    return np.column_stack([x, x * x])


def sorted_rows(n: int, rng: Generator) -> np.ndarray:
    points = rng.random((n, 2))
    return points[np.lexsort(points.T[::-1])]


def all_equal(n: int, rng: Generator) -> np.ndarray:
    return np.tile(rng.random(2), (n, 1))


def all_but_one_equal(n: int, rng: Generator) -> np.ndarray:
    points = all_equal(n, rng)
    points[n // 2] += 1
    return points


def lattice_shape(n: int) -> tuple[int, int]:
    return isqrt(n), n // isqrt(n)


def curve_samples(n: int, rng: Generator) -> tuple[np.ndarray, float]:
    """Samples of star-shaped Fourier curves in the unit cells of a grid, and their mean spacing."""
    curve_count = -(-n // CURVE_SAMPLES)
    curve, sample = np.divmod(np.arange(n), CURVE_SAMPLES)
    amplitudes = rng.uniform(0, 0.6, (curve_count, len(HARMONICS))) / HARMONICS**2
    phases = rng.uniform(0, 2 * np.pi, (curve_count, len(HARMONICS)))
    angles = 2 * np.pi * sample / CURVE_SAMPLES
    radii = np.full(n, RADIUS)
    for harmonic, amplitude, phase in zip(HARMONICS, amplitudes.T, phases.T, strict=True):
        radii += RADIUS * amplitude[curve] * np.cos(harmonic * angles + phase[curve])
    cells = np.column_stack(np.divmod(curve, isqrt(curve_count - 1) + 1))
    points = cells + radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    inside = curve[1:] == curve[:-1]
    return points, float(np.hypot(*np.diff(points, axis=0)[inside].T).mean())


DISTRIBUTIONS: dict[str, Callable[[int, Generator], np.ndarray]] = {
    "uniform": uniform,
    "gaussian": gaussian,
    "lattice": lattice,
    "one circle": circle,
    "curves": curves,
    "noisy curves": noisy_curves,
    "clustered": clustered,
}
HOSTILE: dict[str, Callable[[int, Generator], np.ndarray]] = {
    "line": line,
    "parabola": parabola,
    "sorted rows": sorted_rows,
    "all equal": all_equal,
    "all but one equal": all_but_one_equal,
}

# No four points cocircular, none repeated: one Delaunay triangulation and one crust to agree on.
GENERAL_POSITION = {"uniform", "gaussian", "curves", "noisy curves", "clustered", "sorted rows"}

# Where ties abound, the definition of the crust still fixes how many edges it has.
CRUST_EDGES: dict[str, Callable[[int], int]] = {
    "lattice": lambda n: 2 * prod(lattice_shape(n)) - sum(lattice_shape(n)),
    "one circle": lambda n: n,
    "curves": lambda n: n,
    "line": lambda n: n - 1,
    "all equal": lambda n: 0,
    "all but one equal": lambda n: 1,
}


def point_file(distribution: str, n: int) -> Path:
    """Return the path of the points as raw pairs of float64, generating them at the first use."""
    path = BUILD / "data" / f"{distribution.replace(' ', '-')}-{n}.f64"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        generate = (DISTRIBUTIONS | HOSTILE)[distribution]
        seed = [n, *distribution.encode()]
        generate(n, np.random.default_rng(seed)).astype("<f8").tofile(path)
    return path
