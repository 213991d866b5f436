"""The method by its name, with its parameters: --method, --beta, -p; and `crustline methods`."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import click

from crustline.errors import InputError

Command = Callable[..., None]


@dataclass(frozen=True)
class Method:
    """A function from points to edges, and the parameters that were set for it."""

    name: str
    function: Callable[..., Any]
    parameters: dict[str, Any]
    project: str | None = None


def method_options(command: Command) -> Command:
    """Give a command the options that choose a method; it takes `method: Method`."""

    @click.option("--method", default="connect", show_default=True, metavar="NAME",
                  shell_complete=_matching,
                  help="The method; `crustline methods` lists them.")  # fmt: skip
    @click.option("--beta", type=float, metavar="B", help="The β of a β-skeleton.")
    @click.option(
        "-p", "--parameter", "settings", multiple=True, metavar="NAME=VALUE",
        help="Any parameter of the method, such as radius=0.5.",
    )  # fmt: skip
    @click.option(
        "--project", metavar="CRS",
        help="Connect the points in this CRS, such as EPSG:25832, or auto, a map about their "
        "middle; what is written stays in the CRS of the input. Needs pyproj.",
    )  # fmt: skip
    @functools.wraps(command)
    def run(
        method: str,
        beta: float | None,
        settings: tuple[str, ...],
        project: str | None,
        **rest: Any,
    ) -> None:
        command(method=as_method(method, beta, settings, project), **rest)

    return run


def _matching(context: click.Context, option: click.Parameter, start: str) -> list[str]:
    from crustline.methods import METHODS

    return [name for name in METHODS if name.startswith(start)]


def as_method(
    name: str, beta: float | None, settings: tuple[str, ...], project: str | None
) -> Method:
    """Return the method of a name with its parameters, or refuse what it does not have."""
    from crustline.methods import METHODS, check_parameters
    from crustline.projection import projected

    if name not in METHODS:
        raise InputError(f"no method is called {name!r}: choose one of {', '.join(METHODS)}")
    function = METHODS[name] if project is None else projected(METHODS[name], project)
    method = Method(name, function, dict(map(_setting, settings)), project)
    if beta is not None:
        method.parameters["beta"] = beta
    check_parameters(method.function, method.parameters, name, "add -p {}=VALUE")
    return method


def _setting(text: str) -> tuple[str, Any]:
    name, equals, value = text.partition("=")
    if not equals or not name:
        raise InputError(f"the parameter {text!r} has no value: write NAME=VALUE")
    try:
        return name, json.loads(value)
    except ValueError:
        return name, value


@click.command("methods")
def list_methods() -> None:
    """List the methods, each with a line, its parameters and its reference."""
    from crustline.methods import METHODS, parameters_of

    for name, method in METHODS.items():
        click.echo(f"{name}\n    {_summary(method)}")
        if own := list(parameters_of(method)):
            click.echo(f"    Parameters: {', '.join(own)}")
        if reference := _reference(method):
            click.echo(f"    {reference}")


def _summary(method: Callable[..., Any]) -> str:
    return (method.__doc__ or "").strip().split("\n")[0]


def _reference(method: Callable[..., Any]) -> str:
    """Return the first reference of a docstring, as one line."""
    _, _, references = (method.__doc__ or "").partition(".. [1] ")
    reference = references.split("\n\n")[0].split(".. [2] ")[0]
    return " ".join(reference.split())
