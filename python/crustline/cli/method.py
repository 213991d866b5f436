"""The method by its name, with its parameters: --method, --beta, -p; and `crustline methods`."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable
from dataclasses import dataclass
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any

import click

from crustline.errors import InputError

if TYPE_CHECKING:
    from crustline.arrays import IntArray
    from crustline.delaunay import Delaunay

Command = Callable[..., None]


@dataclass(frozen=True)
class Method:
    """A function from points to edges, and the parameters that were set for it."""

    name: str
    function: Callable[..., Any]
    parameters: dict[str, Any]

    def edges(self, delaunay: Delaunay) -> IntArray:
        """Return the edges that it selects."""
        edges: IntArray = self.function(delaunay, **self.parameters)
        return edges


def method_options(command: Command) -> Command:
    """Give a command the options that choose a method; it takes `method: Method`."""

    @click.option("--method", default="crust", show_default=True, metavar="NAME",
                  help="The method; `crustline methods` lists them.")  # fmt: skip
    @click.option("--beta", type=float, metavar="B", help="The β of a β-skeleton.")
    @click.option(
        "-p", "--parameter", "settings", multiple=True, metavar="NAME=VALUE",
        help="Any parameter of the method, such as alpha=0.5.",
    )  # fmt: skip
    @functools.wraps(command)
    def run(method: str, beta: float | None, settings: tuple[str, ...], **rest: Any) -> None:
        command(method=_method(method, beta, settings), **rest)

    return run


def _method(name: str, beta: float | None, settings: tuple[str, ...]) -> Method:
    from crustline.methods import METHODS

    if name not in METHODS:
        raise InputError(f"no method is called {name!r}: choose one of {', '.join(METHODS)}")
    method = Method(name, METHODS[name], dict(map(_setting, settings)))
    if beta is not None:
        method.parameters["beta"] = beta
    _check_parameters(method)
    return method


def _setting(text: str) -> tuple[str, Any]:
    name, equals, value = text.partition("=")
    if not equals or not name:
        raise InputError(f"the parameter {text!r} has no value: write NAME=VALUE")
    try:
        return name, json.loads(value)
    except ValueError:
        return name, value


def _check_parameters(method: Method) -> None:
    known = dict(list(signature(method.function).parameters.items())[1:])
    own = list(known)
    given = method.parameters
    for each in given:
        if each not in own:
            has = f"it has {', '.join(own)}" if own else "it has none"
            raise InputError(f"the method {method.name} has no parameter {each!r}: {has}")
    missing = [each for each in own if known[each].default is Parameter.empty and each not in given]
    if missing:
        raise InputError(
            f"the method {method.name} needs {missing[0]!r}: add -p {missing[0]}=VALUE"
        )


@click.command("methods")
def list_methods() -> None:
    """List the methods, each with a line and its reference."""
    from crustline.methods import METHODS

    for name, method in METHODS.items():
        click.echo(f"{name}\n    {_summary(method)}")
        if reference := _reference(method):
            click.echo(f"    {reference}")


def _summary(method: Callable[..., Any]) -> str:
    return (method.__doc__ or "").strip().split("\n")[0]


def _reference(method: Callable[..., Any]) -> str:
    """Return the first reference of a docstring, as one line."""
    _, _, references = (method.__doc__ or "").partition(".. [1] ")
    reference = references.split("\n\n")[0].split(".. [2] ")[0]
    return " ".join(reference.split())
