"""What crustline promises with NumPy alone: each wheel must pass ``python tests/test_minimal.py``.

As a script it needs no pytest, and refuses to import anything but NumPy and the standard library.
In the suite the last test runs the script.
"""

from __future__ import annotations

import math
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from inspect import signature
from pathlib import Path
from types import ModuleType

ALLOWED = {"numpy", "crustline", *sys.stdlib_module_names}


class OnlyNumPy(MetaPathFinder):
    """Finds nothing, and refuses what is not allowed."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname.partition(".")[0] not in ALLOWED:
            raise ImportError(f"{fullname} is neither NumPy nor in the standard library")
        return None


if __name__ == "__main__":
    sys.meta_path.insert(0, OnlyNumPy())

# What these import is refused, too.
import numpy as np  # noqa: E402

import crustline as cl  # noqa: E402

SQUARE = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]
RING = [[0, 2], [0, 3], [1, 2], [1, 3]]


def circle(n: int) -> np.ndarray:
    angle = np.arange(n) * (2 * math.pi / n)
    return np.column_stack([np.cos(angle), np.sin(angle)])


def refused(error: type[Exception], call: Callable[[], object]) -> str:
    """The message with which a call ends."""
    try:
        call()
    except error as caught:
        return str(caught)
    raise AssertionError(f"no {error.__name__}")


def test_the_extension_and_the_package_are_of_one_version() -> None:
    assert cl.__version__.count(".") == 2


def test_a_square_is_a_ring_without_diagonals() -> None:
    for points in (SQUARE, np.array(SQUARE), cl.Points(SQUARE), cl.Delaunay(SQUARE, threads=2)):
        assert cl.crust(points).tolist() == RING
    curves = cl.reconstruct(SQUARE)
    assert [(curve.closed, curve.indices.tolist()) for curve in curves] == [(True, [0, 2, 1, 3])]


def test_every_method_gives_edges() -> None:
    points = circle(24)
    given: dict[str, object] = {
        "angle": 2.0,
        "radius": 0.5,
        "extra": [(0, 0)],
        "c0": 0.5,
        "c1": 0.5,
    }
    for method in cl.METHODS.values():
        needed = [
            given[each.name]
            for each in list(signature(method).parameters.values())[1:]
            if each.default is each.empty
        ]
        edges = method(points, *needed)
        assert edges.dtype == np.int64
        assert edges.shape[1] == 2


def test_what_follows_from_edges() -> None:
    made = cl.Reconstruction(circle(40))
    assert made.certificate.guaranteed
    assert abs(made.medial_axis.vertices).max() < 1e-6
    assert np.allclose(cl.local_feature_size(made.delaunay, made.edges), 1, atol=1e-6)
    assert len(cl.thin(made.delaunay, made.edges, r=0.25)) <= 20
    assert [len(polygon.holes) for polygon in made.curves.polygons()] == [0]


def test_known_curves_are_sampled() -> None:
    sample = cl.r_sample(cl.shapes.ellipse(2, 1), 0.25)
    assert cl.is_r_sample(cl.shapes.ellipse(2, 1), sample, 0.25)
    assert np.array_equal(cl.crust(sample), sample.edges)
    assert round(cl.guaranteed_r("crust"), 4) == 0.2534


def test_files_come_back() -> None:
    points = cl.Points(SQUARE, z=[1, 2, 3, 4], columns={"name": ["a", "b", "c", "d"]})
    with tempfile.TemporaryDirectory() as folder:
        for suffix in (".csv", ".geojson", ".npz"):
            cl.write(points, path := Path(folder, f"points{suffix}"))
            assert cl.read(path) == points, suffix
        for suffix in (".csv", ".geojson", ".wkt", ".npz", ".svg"):
            cl.write(cl.reconstruct(points), path := Path(folder, f"curves{suffix}"))
            assert path.stat().st_size > 30, suffix


def test_pickles_and_notebooks() -> None:
    delaunay = pickle.loads(pickle.dumps(cl.Delaunay(SQUARE)))
    assert np.array_equal(delaunay.edges, cl.Delaunay(SQUARE).edges)
    assert "<svg" in cl.reconstruct(SQUARE)._repr_svg_()


def test_bad_input_is_one_sentence() -> None:
    message = refused(cl.InputError, lambda: cl.crust([(0, 0), (1, math.nan)]))
    assert "row 1" in message
    assert "\n" not in message


def test_extras_are_named_where_they_are_needed() -> None:
    if __name__ == "__main__":
        curves = cl.reconstruct(circle(9))
        assert "crustline[plot]" in refused(cl.MissingExtraError, curves.plot)
        assert "crustline[smooth]" in refused(cl.MissingExtraError, lambda: cl.smooth(curves))


def test_with_numpy_alone() -> None:
    if __name__ != "__main__":
        done = subprocess.run([sys.executable, __file__], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert "passed" in done.stdout


if __name__ == "__main__":
    tests = [test for name, test in list(globals().items()) if name.startswith("test_")]
    for test in tests:
        test()
    print(f"{len(tests)} passed with NumPy {np.__version__} alone")
