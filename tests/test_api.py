"""The public interface as a whole: its names, and one convention for its arguments."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import crustline as cl

# A parameter with a default can be passed by position if it is what the call works on, or the
# number that it is about. Options are keywords.
POSITIONAL = {
    "edges", "method", "ax", "box", "crs",
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
                and name not in ("shapes", "theory")]  # fmt: skip


def test_every_public_name_is_there_once() -> None:
    assert len(set(cl.__all__)) == len(cl.__all__)
    for name in cl.__all__:
        assert getattr(cl, name) is not None
