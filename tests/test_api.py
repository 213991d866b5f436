"""The public interface as a whole: its names, and one convention for its arguments."""

from __future__ import annotations

import ast
import importlib
import inspect
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import crustline as cl

# A parameter with a default can be passed by position if it is what the call works on, or the
# number that it is about. Options are keywords.
POSITIONAL = {
    "edges", "method", "orient", "ax", "box", "crs",
    "beta", "angle", "ratio", "at_least", "count", "tolerance",
    "r", "m", "lobes", "depth", "radius",
}  # fmt: skip


def public_callables() -> Iterator[tuple[str, Callable[..., Any]]]:
    for module in (cl, cl.shapes, cl.theory, pytest.importorskip("crustline.plot")):
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing) and not issubclass(thing, Exception):
                yield from methods_of(thing)
            elif callable(thing) and not inspect.isclass(thing):
                yield f"{module.__name__}.{name}", thing


def methods_of(noun: type) -> Iterator[tuple[str, Callable[..., Any]]]:
    for name, method in vars(noun).items():
        if inspect.isfunction(method) and (name == "__init__" or not name.startswith("_")):
            yield f"{noun.__name__}.{name}", method


CALLABLES = dict(public_callables())


@pytest.mark.parametrize("name", CALLABLES)
def test_options_are_keywords(name: str) -> None:
    for parameter in inspect.signature(CALLABLES[name]).parameters.values():
        if parameter.kind is parameter.POSITIONAL_OR_KEYWORD and not is_field(name):
            assert parameter.default is parameter.empty or parameter.name in POSITIONAL


def is_field(name: str) -> bool:
    """Whether the arguments are the fields of a dataclass."""
    return name.endswith("__init__") and "<string>" in CALLABLES[name].__code__.co_filename


@pytest.mark.parametrize("name", CALLABLES)
def test_every_public_function_says_what_it_returns(name: str) -> None:
    doc = inspect.getdoc(CALLABLES[name]) or ""
    assert name.endswith("__init__") or doc.split()[0] in {
        "Return", "Yield", "Write", "Draw", "Read", "Refuse", "Show",
    }, doc[:60]  # fmt: skip


def test_completion_shows_the_public_names_only() -> None:
    assert dir(cl) == sorted(cl.__all__)
    assert not [name for name in dir(cl) if inspect.ismodule(getattr(cl, name))
                and name not in ("distributed", "shapes", "theory")]  # fmt: skip


def test_every_public_name_is_there_once() -> None:
    assert len(set(cl.__all__)) == len(cl.__all__)
    for name in cl.__all__:
        assert getattr(cl, name) is not None


# Importing


def loaded_by(code: str) -> set[str]:
    """The modules that a process has loaded after some code, but for those of NumPy alone."""
    show = (
        f"import sys, numpy; before = set(sys.modules); {code}; print(*sys.modules.keys()-before)"
    )
    run = subprocess.run([sys.executable, "-c", show], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_importing_loads_nothing_but_the_package() -> None:
    assert loaded_by("import crustline") == {"crustline"}


def test_reconstructing_loads_no_format_shape_or_foreign_package() -> None:
    found = loaded_by("import crustline; crustline.reconstruct([(0, 0), (1, 1), (1, 0), (0, 1)])")
    own = {name.split(".")[1] for name in found if name.startswith("crustline.")}
    assert not own & {"formats", "shapes", "smooth", "plot", "cli"}
    tops = {name.partition(".")[0] for name in found}
    assert tops <= {"crustline", "numpy", *sys.stdlib_module_names}
    assert len(found) < 100


def test_functions_win_over_the_modules_of_their_names() -> None:
    names = ("certify", "denoise", "medial_axis", "merge", "smooth")
    for name in names:
        importlib.import_module(f"crustline.{name}")
        assert inspect.isfunction(getattr(cl, name))
    code = "import crustline.smooth, crustline as cl; assert callable(cl.smooth)"
    assert loaded_by(code)


def test_type_checkers_are_told_where_names_are() -> None:
    tree = ast.parse(inspect.getsource(cl))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    told = {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom) and node.module != "crustline"
        for alias in node.names
    }
    assert told == cl._HOMES
    assert sorted([*told, "distributed", "shapes", "theory"]) == sorted(cl.__all__)


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'cruts'"):
        _ = cl.cruts  # type: ignore[attr-defined]
