from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Curve",
    "Delaunay",
    "Interpolant",
    "Tree",
    "__version__",
    "candidates",
    "connect",
    "connection",
    "decide",
    "first_not_finite",
    "is_canonical",
    "join_chains",
    "medial_axis",
    "ridge",
    "select",
    "select_among",
    "select_by_group",
    "shells",
    "stars",
    "trace",
    "trace_tile",
    "z_order",
]

__version__: str

_Progress = Callable[[str, float], object]
_Floats = NDArray[np.float64]
_Integers = NDArray[np.int64]
_Flags = NDArray[np.bool_]
_Rule = tuple[str, list[float]]
_Chains = tuple[_Integers, _Floats, _Integers]
_Joined = tuple[tuple[_Integers, _Flags, _Integers], _Flags, _Chains]

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
    hints: Any = None,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def connection(
    delaunay: Delaunay,
    hints: Any = None,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> dict[str, Any]: ...
def first_not_finite(points: _Floats) -> int | None: ...
def select(
    delaunay: Delaunay,
    method: str,
    parameters: list[float],
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def select_among(points: _Floats, method: str, parameters: list[float]) -> _Integers: ...
def select_by_group(
    points: _Floats,
    rows: _Integers,
    ends: _Integers,
    method: str,
    parameters: list[float],
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...

@final
class Tree:
    def __new__(cls, starts: _Floats, ends: _Floats) -> Tree: ...
    def distances(self, places: _Floats) -> _Floats: ...

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
def z_order(points: _Floats) -> tuple[_Integers, _Integers]: ...
def decide(
    delaunay: Delaunay,
    rule: _Rule,
    own: _Flags,
    fresh: _Flags,
    pairs: _Integers,
    pieces: _Floats,
    known: _Flags,
    clear: _Floats,
    most: int,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> tuple[_Integers, _Integers, _Integers, _Floats, _Integers, _Floats]: ...
def candidates(
    delaunay: Delaunay,
    rule: _Rule,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def stars(delaunay: Delaunay, rows: _Integers) -> tuple[_Integers, _Integers]: ...
def trace_tile(
    points: _Floats, edges: _Integers, cut: _Flags, numbers: _Integers
) -> tuple[
    _Integers,
    tuple[_Integers, _Integers, _Flags, _Integers],
    tuple[_Integers, _Integers],
    _Chains,
]: ...
def join_chains(
    sites: _Integers, places: _Floats, edges: _Integers, degrees: _Integers
) -> list[_Joined]: ...
def is_canonical(edges: _Integers, points: int) -> bool: ...
def medial_axis(
    delaunay: Delaunay,
    curve: Curve,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> dict[str, NDArray[Any]]: ...

@final
class Curve:
    def __new__(
        cls,
        delaunay: Delaunay,
        edges: _Integers,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Curve: ...
    def is_of(self, edges: _Integers) -> bool: ...

@final
class Interpolant:
    def __new__(
        cls,
        delaunay: Delaunay,
        curve: Curve,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Interpolant: ...
    def sizes(self) -> _Floats: ...
    def certificate(
        self,
        theorems: tuple[float, float, float, float],
        crust: _Integers | None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> tuple[
        str | None, bool, _Floats, NDArray[np.uint8], NDArray[np.uint8], _Integers | None
    ]: ...

def ridge(
    delaunay: Delaunay,
    noise: _Floats | None,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> tuple[_Integers, _Floats, _Floats, _Integers, _Floats]: ...
