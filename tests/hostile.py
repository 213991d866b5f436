"""Arguments for calls of the public interface: what fits, by a parameter's name, and what does not.

`calls` is a hypothesis strategy of calls, `refusal` runs one and returns the sentence in which it
was refused, or None if it was answered. Whatever else comes of it is a fault.
"""

from __future__ import annotations

import datetime
import decimal
import fractions
import inspect
import os
import tempfile
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from hypothesis import strategies as st

import crustline as cl
from crustline import shapes, theory
from crustline.errors import CrustlineError, FormatWarning

Make = Callable[[], Any]

#: No message is longer: it is one sentence for one fault.
LONGEST_MESSAGE = 400

FOLDER = tempfile.mkdtemp(prefix="crustline-hostile-")
SQUARE = np.array([(0.0, 0), (1, 0), (1, 1), (0, 1)])
RING = shapes.ellipse(2, 1).point(np.arange(24) / 24)


def unaligned(points: np.ndarray) -> np.ndarray:
    """The same points at an odd address."""
    buffer = np.zeros(points.nbytes + 1, np.uint8)
    view = buffer[1:].view(np.float64).reshape(points.shape)
    view[:] = points
    return view


def nested(depth: int) -> Any:
    deep: Any = []
    for _ in range(depth):
        deep = [deep]
    return deep


def itself() -> Any:
    loop: list[Any] = []
    loop.append(loop)
    return loop


class Liar:
    """It says that it is an array, of something else each time."""

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        raise ValueError("no")

    def __len__(self) -> int:
        return 3

    def __getitem__(self, key: Any) -> Any:
        raise IndexError(key)


class Endless:
    """A sequence that says it has an end."""

    def __len__(self) -> int:
        return 2

    def __getitem__(self, key: Any) -> Any:
        return self


POINTS: list[Make] = [
    list,
    lambda: [(1, 2)],
    lambda: [(1, 2), (1, 2), (3, 4)],
    lambda: SQUARE,
    lambda: RING,
    lambda: RING[::-1],
    lambda: np.asfortranarray(RING),
    lambda: np.repeat(RING, 2, axis=0)[::2],
    lambda: RING.astype(">f8"),
    lambda: RING.astype(np.float16),
    lambda: SQUARE.astype(np.int8),
    lambda: SQUARE.astype(np.uint64),
    lambda: unaligned(RING),
    lambda: np.column_stack([np.arange(5.0), np.zeros(5)]),
    lambda: RING * 1e-300,
    lambda: RING * 1e300,
    lambda: RING + 6e6,
    lambda: [(-5e-324, 5e-324), (-5e-324, 1.0000000000000002), (5e-324, 2.0000000000000004)],
    lambda: [(0.0, 5e-324), (1e308, -1e308), (1, 1)],
    lambda: np.vstack([RING, (RING * 3 + 1e3 - 1e3) / 3]),
    lambda: np.argwhere(np.ones((4, 4))),
    lambda: cl.Points(RING, z=np.arange(24), columns={"a": ["b"] * 24}, crs="EPSG:4326"),
    lambda: cl.Delaunay(RING),
    lambda: cl.Delaunay(SQUARE, threads=1),
    lambda: cl.r_sample(shapes.circle(), 0.5),
]
EDGES: list[Make] = [
    lambda: None,
    list,
    lambda: [(0, 1)],
    lambda: [(1, 0), (0, 1), (1, 2)],
    lambda: np.array([(0, 1), (1, 2), (0, 2)], np.uint8),
    lambda: [(i, (i + 1) % 24) for i in range(24)],
    lambda: [(0, i) for i in range(1, 24)],
    lambda: cl.crust(RING),
]
CURVES: list[Make] = [
    lambda: shapes.circle(),
    lambda: shapes.ellipse(2, 1),
    lambda: shapes.stadium(2, 1).moved(scale=1e-3, offset=(1e3, 0)),
    lambda: shapes.circle(2) + shapes.circle(1),
    lambda: shapes.blob(1),
]
TRACED: list[Make] = [lambda: cl.reconstruct(RING), lambda: cl.trace(SQUARE, [(0, 1), (1, 2)])]
NUMBERS: list[Make] = [
    partial(lambda x: x, x)
    for x in (1, 2, 0.25, 0.5, 1.5, 3, 0.05, np.float32(0.5), np.int16(2), fractions.Fraction(1, 3))
]
METHODS: list[Make] = [
    lambda: cl.crust, lambda: cl.connect, lambda: cl.gabriel, lambda: lambda points: [(0, 1)],
    lambda: cl.beta_skeleton, lambda: cl.alpha_shape,
]  # fmt: skip
PATHS: list[Make] = [
    partial(os.path.join, FOLDER, name)
    for name in (
        "a.csv",
        "a.xyz",
        "a.geojson",
        "a.wkt",
        "a.svg",
        "a.npz",
        "a.npy",
        "a.none",
        "none",
    )
]

TETRAHEDRON = SimpleNamespace(
    vertices=np.vstack([np.zeros(3), np.eye(3)]), faces=[(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
)
#: What fits a parameter, by its name; parameters with other names are numbers.
FITTING: dict[str, list[Make]] = {
    "points": POINTS, "coordinates": POINTS, "extra": POINTS, "sites": POINTS, "places": POINTS,
    "edges": EDGES, "curve": CURVES, "curves": TRACED, "method": METHODS, "path": PATHS,
    "box": [lambda: None, lambda: (0, 0, 1, 1), lambda: np.array([-1, -1, 2, 2.0])],
    "thing": [lambda: cl.Points(SQUARE), *TRACED, lambda: cl.medial_axis(RING)],
    "kind": [lambda: "circle", lambda: "lune", lambda: "arc", lambda: "chord"],
    "mode": [lambda: "sparsest", lambda: "random"],
    "ends": [lambda: "natural", lambda: "not-a-knot"],
    "z": [lambda: None, lambda: np.arange(24), lambda: [1, 2, 3, 4]],
    "columns": [lambda: None, lambda: {"a": range(24)}, lambda: {"a": list("abcd")}],
    "crs": [lambda: None, lambda: "EPSG:4326"],
    "names": [lambda: ("x", "y"), lambda: ["lon", "lat"]],
    "format": [lambda: None, lambda: "csv", lambda: "wkt", lambda: "svg"],
    "rows": [lambda: [0], list, lambda: np.ones(24, bool), lambda: [3, 2]],
    "coefficients": [lambda: [0, 1, 0.1, 0], lambda: np.array([0, 1 + 1j])],
    "offset": [lambda: (1, 2)],
    "threads": [lambda: None, lambda: 1, lambda: 2],
    "progress": [lambda: None, lambda: lambda stage, done: None],
    "seed": [lambda: None, lambda: 0, lambda: 7],
    "count": [lambda: None, lambda: 5],
    "tolerance": [lambda: None, lambda: 1e-3],
    "t": [lambda: 0.5, lambda: [0, 0.25], lambda: np.zeros((2, 2))],
    "groups": [lambda: [0, 1] * 12, lambda: list("aabb"), lambda: np.arange(24) // 5],
    "source": [lambda: "M 1 0 C 1 1 -1 1 -1 0 C -1 -1 1 -1 1 0 Z"],
    "m": [lambda: 4, lambda: None], "n": [lambda: 4], "lobes": [lambda: 3],
    "body": [lambda: TETRAHEDRON, lambda: np.c_[RING, np.full(24, 0.5)]],
    "planes": [lambda: "z=0.5", lambda: ["x=0.1", "1,1,1=0.2"]], "line": [lambda: "0,0,1,1"],
    "thickness": [lambda: None, lambda: 2.0], "scale": [lambda: None, lambda: 0.1],
    "where": [lambda: "inner", lambda: "outer"], "harmonics": [lambda: 3],
    "polygons": [lambda: True, lambda: False],
}  # fmt: skip

FILES: list[Make] = [
    lambda: b"x,y\n1,2\n3,4\n",
    lambda: b"SRID=4326;LINESTRING (0 0, 1 1)",
    lambda: [b"1 2\n3", b" 4\n"],
    lambda: b'{"type": "MultiPoint", "coordinates": [[1, 2], [3, 4]]}',
    *PATHS,
]

#: What fits nothing, or not everything.
HOSTILE: list[Make] = [
    lambda: None, lambda: True, lambda: 0, lambda: -1, lambda: 1.5, lambda: 10**400,
    lambda: 2**40, lambda: -(2**63), lambda: float("nan"), lambda: float("inf"), lambda: 1e308,
    lambda: 5e-324, lambda: 1j, lambda: "", lambda: "text", lambda: "x" * 100_000,
    lambda: "1\n2\0\ud800", lambda: b"bytes", lambda: (), list, dict, lambda: {1: 2},
    lambda: set(), lambda: object(), lambda: object, lambda: len, lambda: lambda: None,
    lambda: iter([(0, 0)]), lambda: range(3), lambda: nested(50), itself, Liar, Endless,
    lambda: np.array(5.0), lambda: np.array([]), lambda: np.zeros((0, 3)), lambda: np.zeros(7),
    lambda: np.zeros((2, 2, 2)), lambda: np.full((3, 2), np.nan), lambda: np.zeros((3, 2), complex),
    lambda: np.array([[1, 2], [3, None]], object), lambda: np.array([["a", "b"]]),
    lambda: np.zeros((3, 2), bool), lambda: np.zeros(3, [("x", "f8"), ("y", "f8")]),
    lambda: np.zeros((2, 2), "M8[s]"), lambda: np.ma.masked_array(SQUARE, SQUARE > 0),
    lambda: np.matrix([[0, 0], [1, 1]]), lambda: np.full((2, 2), 2**63, np.uint64),
    lambda: np.array([[np.longdouble(1) / 3, 0]]), lambda: np.zeros((3, 2), np.float16),
    lambda: np.zeros((3, 2), "V8"), lambda: np.broadcast_to(np.float64(1), (3, 2)),
    lambda: [(0, 0), (1,)], lambda: [(0, 0), "ab"], lambda: [(0, 0), (1, float("inf"))],
    lambda: [(0, 24)], lambda: [(-1, 0)], lambda: [(0, 0)], lambda: [(0.5, 1)],
    lambda: [(10**30, 1)], lambda: fractions.Fraction(10**400, 3), lambda: decimal.Decimal("NaN"),
    lambda: decimal.Decimal(1), lambda: datetime.datetime(2020, 1, 1), lambda: np.float32("nan"),
    lambda: np.int8(-1), lambda: np.bool_(True), lambda: np.str_("circle"), lambda: bytearray(b"a"),
    lambda: cl.Points(SQUARE), lambda: cl.Delaunay(RING), lambda: cl.crust, lambda: shapes.circle(),
    lambda: cl.reconstruct(RING), lambda: cl, lambda: NotImplemented, lambda: ..., lambda: slice(3),
]  # fmt: skip


@dataclass(frozen=True)
class Call:
    """A function and what makes its arguments, by name."""

    name: str
    function: Callable[..., Any]
    arguments: dict[str, Make]

    def __repr__(self) -> str:
        given = (f"{name}={_shown(make)}" for name, make in self.arguments.items())
        return f"{self.name}({', '.join(given)})"


def _shown(make: Make) -> str:
    try:
        return f"{make()!r:.60}".replace("\n", " ")
    except Exception as error:  # a repr that fails is one of the hostile things
        return f"<{error!r:.40}>"


#: Nouns that are made by hand, and things whose methods are called.
NOUNS: list[Make] = [
    lambda: cl.Points(RING, z=np.arange(24)),
    lambda: cl.Delaunay(RING),
    lambda: cl.reconstruct(RING),
    lambda: cl.reconstruct(RING)[0],
    lambda: cl.medial_axis(RING),
    lambda: cl.certify(RING),
    lambda: cl.Interpolant(RING),
    lambda: cl.Reconstruction(RING),
    lambda: cl.smooth(cl.reconstruct(RING)),
    lambda: cl.smooth(cl.reconstruct(RING))[0],
    lambda: shapes.circle() + shapes.circle(3),
    lambda: shapes.circle().medial_axis(),
]
#: Calls whose arguments are code, which may do anything, or have been checked by who calls them.
NOT_CALLED = {
    "along",
    "cached",
    "kept",
    "run",
    "plot",
    "picture",
    "count",
    "index",
    "select_method",
}


def functions() -> dict[str, Callable[..., Any]]:
    """Everything public that can be called, by name."""
    found: dict[str, Callable[..., Any]] = {}
    for module in (cl, shapes, theory):
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isfunction(thing):
                found[f"{module.__name__}.{name}"] = thing
    for noun in (cl.Points, cl.Delaunay, cl.Reconstruction, cl.Interpolant):
        found[noun.__name__] = noun
    for make in NOUNS:
        for name in dir(type(make())):
            method = inspect.getattr_static(type(make()), name)
            public = not name.startswith("_") and name not in NOT_CALLED
            if public and inspect.isfunction(method):
                found[f"{type(make()).__name__}.{name}"] = partial(_on, make, name)
    del found["Delaunay.select"]  # of the core's own names
    del found["crustline.shapes.union"]  # of any number of curves
    return found


def _on(make: Make, name: str, /, **arguments: Any) -> Any:
    return getattr(make(), name)(**arguments)


FUNCTIONS = functions()


def parameters(function: Callable[..., Any]) -> dict[str, inspect.Parameter]:
    """The parameters that can be given by name."""
    if isinstance(function, partial):
        make, name = function.args
        function = getattr(make(), name)
    given = inspect.signature(function).parameters
    return {
        name: each
        for name, each in given.items()
        if each.kind in (each.POSITIONAL_OR_KEYWORD, each.KEYWORD_ONLY)
    }


def fitting(name: str, parameter: str) -> list[Make]:
    """What fits a parameter of a function."""
    if name in ("crustline.read", "crustline.read_curves") and parameter == "path":
        return FILES
    return FITTING.get(parameter, NUMBERS)


@st.composite
def calls(draw: st.DrawFn) -> Call:
    """Any call: of its arguments most fit, and one or two may not."""
    name = draw(st.sampled_from(sorted(FUNCTIONS)))
    arguments = {}
    for parameter in parameters(FUNCTIONS[name]).values():
        if parameter.default is parameter.empty or draw(st.booleans()):
            fits = draw(st.integers(0, 3)) > 0
            pool = fitting(name, parameter.name) if fits else HOSTILE
            arguments[parameter.name] = draw(st.sampled_from(pool))
    return Call(name, FUNCTIONS[name], arguments)


def refusal(call: Call) -> str | None:
    """Run a call; return the sentence in which it was refused, if it was."""
    arguments = {name: make() for name, make in call.arguments.items()}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", FormatWarning)
        try:
            look_at(call.function(**arguments))
        except CrustlineError as error:
            message = str(error)
            assert message, "refused without a word"
            assert "\n" not in message, f"more than a line: {message!r}"
            assert len(message) <= LONGEST_MESSAGE, f"long: {message!r}"
            return message
    return None


def look_at(result: Any) -> None:
    """Ask a result for all that it has."""
    if inspect.isgenerator(result):
        result = list(result)
    if type(result).__module__.startswith("crustline."):
        repr(result)
        for name, each in inspect.getmembers_static(type(result)):
            if isinstance(each, property) or type(each).__name__ == "cached_property":
                getattr(result, name)
            elif name in ("_repr_html_", "_repr_svg_", "summary", "to_dict", "polygons"):
                getattr(result, name)()
