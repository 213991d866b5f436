from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Delaunay",
    "Interpolant",
    "__version__",
    "connect",
    "first_not_finite",
    "is_canonical",
    "medial_axis",
    "select",
    "select_by_group",
    "shells",
    "trace",
]

__version__: str

_Progress = Callable[[str, float], object]
_Floats = NDArray[np.float64]
_Integers = NDArray[np.int64]

@final
class Delaunay:
    def __new__(
        cls, points: _Floats, threads: int | None = None, progress: _Progress | None = None
    ) -> Delaunay: ...
    def triangles(self) -> _Integers: ...
    def halfedges(self) -> _Integers: ...
    def hull(self) -> _Integers: ...
    def circumcenters(self) -> _Floats: ...
    def circumradii(self) -> _Floats: ...
    def edges(self) -> _Integers: ...
    def duplicates(self) -> _Integers: ...

def connect(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def first_not_finite(points: _Floats) -> int | None: ...
def select(
    delaunay: Delaunay,
    method: str,
    parameters: list[float],
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def select_by_group(
    points: _Floats,
    rows: _Integers,
    ends: _Integers,
    method: str,
    parameters: list[float],
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def trace(
    points: _Floats,
    edges: _Integers,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> tuple[_Integers, _Integers, NDArray[np.bool_], _Integers]: ...
def shells(
    points: _Floats,
    indices: _Integers,
    offsets: _Integers,
    closed: NDArray[np.bool_],
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def is_canonical(edges: _Integers, points: int) -> bool: ...
def medial_axis(
    delaunay: Delaunay,
    edges: _Integers,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> dict[str, NDArray[Any]]: ...

@final
class Interpolant:
    def __new__(
        cls,
        delaunay: Delaunay,
        edges: _Integers,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Interpolant: ...
    def is_of(self, edges: _Integers) -> bool: ...
    def is_beta_skeleton(
        self, beta: float, threads: int | None = None, progress: _Progress | None = None
    ) -> bool: ...
    def sizes(self) -> _Floats: ...
    def measures(
        self, threads: int | None = None, progress: _Progress | None = None
    ) -> tuple[_Floats, _Floats, _Integers]: ...
