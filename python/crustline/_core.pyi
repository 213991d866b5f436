from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Delaunay",
    "Interpolant",
    "__version__",
    "a_shape",
    "alpha_shape",
    "beta_skeleton",
    "connect",
    "crossing_angle_graph",
    "crust",
    "gabriel",
    "gamma_graph",
    "is_canonical",
    "medial_axis",
    "minimum_spanning_tree",
    "nn_crust",
    "one_step_crust",
    "rcgh",
    "relative_neighborhood",
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
def crust(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def beta_skeleton(
    delaunay: Delaunay,
    beta: float,
    lune: bool,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def gabriel(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def relative_neighborhood(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def one_step_crust(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def gamma_graph(
    delaunay: Delaunay,
    c0: float,
    c1: float,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def crossing_angle_graph(
    delaunay: Delaunay,
    cotangent: float,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def alpha_shape(
    delaunay: Delaunay,
    radius: float,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def a_shape(
    delaunay: Delaunay,
    own: int,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def rcgh(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def nn_crust(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def hnn_crust(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def compatible_crust(
    delaunay: Delaunay,
    cotangent: float,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def conservative_crust(
    delaunay: Delaunay,
    ratio: float,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def gathan(
    delaunay: Delaunay,
    sine: float,
    ratio: float,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def crawl(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def peel(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def sig_delaunay(
    delaunay: Delaunay,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> _Integers: ...
def minimum_spanning_tree(
    delaunay: Delaunay,
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
