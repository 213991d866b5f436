"""The method by its name, with its parameters: --method, --beta, -p; and `crustline methods`."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import click

from crustline.cli.hints import Command, hint_options
from crustline.cli.sections import Sectioned, headed
from crustline.errors import InputError
from crustline.formats.names import quote_all

if TYPE_CHECKING:
    from crustline.delaunay import Delaunay
    from crustline.points import Points
    from crustline.reconstruction import Reconstruction


@dataclass(frozen=True)
class Method:
    """A method by its name, the parameters that were set for it, and whether curves are fitted.

    With `columns` it connects by them in place of x and y.
    """

    name: str
    parameters: dict[str, Any]
    project: str | None = None
    fit: bool = False
    noise: str | None = None
    merge: float | None = None
    columns: tuple[str, str] | None = None

    @property
    def function(self) -> Callable[..., Any]:
        """The function from points to edges."""
        from crustline.methods import METHODS, in_columns
        from crustline.projection import projected

        function = METHODS[self.name]
        if self.columns is not None:
            return in_columns(function, *self.columns)
        return function if self.project is None else projected(function, self.project)

    def reconstruction(self, delaunay: Delaunay) -> Reconstruction:
        """Return what the method makes of points."""
        from crustline.methods import METHODS
        from crustline.reconstruction import Reconstruction

        if not self.fit:
            return Reconstruction(delaunay, self.function, merge=self.merge, **self.parameters)
        noise = as_noise(self.noise, delaunay.points)
        return Reconstruction(
            delaunay, METHODS[self.name], fit=True, noise=noise, crs=self.project,
            merge=self.merge, **self.parameters,
        )  # fmt: skip


@headed("Method")
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
    @click.option("--merge", type=float, metavar="TOL",
                  help="Take points within this distance of each other for one.")  # fmt: skip
    @hint_options
    @functools.wraps(command)
    def run(
        method: str,
        beta: float | None,
        settings: tuple[str, ...],
        project: str | None,
        merge: float | None,
        hints: dict[str, Any],
        **rest: Any,
    ) -> None:
        chosen = as_method(method, beta, settings, project, hints)
        command(method=replace(chosen, merge=merge), **rest)

    return run


@headed("Noise")
def fit_options(command: Command) -> Command:
    """Give a command that takes `method: Method` --fit and --noise."""

    @click.option("--fit", is_flag=True,
                  help="Fit curves to noisy points, with new vertices: their rows, uncertainty and "
                  "the outliers are written, too. Needs scipy.")  # fmt: skip
    @click.option("--noise", metavar="N",
                  help="With --fit, the standard deviation of the noise, or the column that has "
                  "it, in the unit of the input or of --project; by default it is "
                  "estimated.")  # fmt: skip
    @functools.wraps(command)
    def run(method: Method, fit: bool, noise: str | None, **rest: Any) -> None:
        if noise is not None and not fit:
            raise InputError("--noise is for --fit: add that")
        command(method=replace(method, fit=fit, noise=noise), **rest)

    return run


def as_noise(text: str | None, points: Points) -> Any:
    """Return the noise that an option gives: a number, or the column of that name."""
    if text is None:
        return None
    if text in points.columns:
        return points.columns[text]
    try:
        return float(text)
    except ValueError:
        has = f"choose from {quote_all(list(points.columns))}" if points.columns else "it has none"
        raise InputError(
            f"--noise {text!r:.40} is neither a number nor a column beside x and y: {has}"
        ) from None


def _matching(context: click.Context, option: click.Parameter, start: str) -> list[str]:
    from crustline.methods import METHODS

    return [name for name in METHODS if name.startswith(start)]


def as_method(
    name: str,
    beta: float | None,
    settings: tuple[str, ...],
    project: str | None,
    hints: dict[str, Any] | None = None,
) -> Method:
    """Return the method of a name with its parameters, or refuse what it does not have."""
    from crustline.methods import METHODS, check_parameters

    if name not in METHODS:
        raise InputError(f"no method is called {name!r}: choose one of {', '.join(METHODS)}")
    method = Method(name, dict(map(_setting, settings)) | (hints or {}), project)
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


@click.command("methods", cls=Sectioned)
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
