"""Help in sections: the options of a command under the headings of what they are about."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar, cast

import click

__all__ = ["HEADINGS", "Sectioned", "headed", "sections_of"]

#: The headings in the order of the help; what a command has of its own comes first.
_OWN, *_HEADINGS = HEADINGS = (
    "Options", "Input", "Input of text", "Input of images", "Output", "Method",
    "What is known of the curves", "Noise", "Slices of clouds and meshes",
    "Data larger than memory",
)  # fmt: skip

Decorator = TypeVar("Decorator", bound=Callable[..., Any])


def headed(heading: str) -> Callable[[Decorator], Decorator]:
    """Let a decorator that gives a command options put them under a heading.

    Options that a decorator within has put under another one stay there; those that the command had
    before are its own.
    """
    assert heading in _HEADINGS

    def decorate(decorator: Decorator) -> Decorator:
        @functools.wraps(decorator)
        def give(command: Any) -> Any:
            for option in getattr(command, "__click_params__", ()):
                option.heading = getattr(option, "heading", _OWN)
            given = decorator(command)
            for option in given.__click_params__:
                option.heading = getattr(option, "heading", heading)
            return given

        return cast(Decorator, give)

    return decorate


class Sectioned(click.Command):
    """A command whose help has its options in sections."""

    def format_options(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the sections."""
        for heading, records in sections_of(self, context):
            with formatter.section(heading):
                formatter.write_dl(records)


def sections_of(
    command: click.Command, context: click.Context
) -> list[tuple[str, list[tuple[str, str]]]]:
    """Return the headings of a command's help, each with its options and what they do."""
    found: dict[str, list[tuple[str, str]]] = {heading: [] for heading in HEADINGS}
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context)
        if isinstance(parameter, click.Option) and record is not None:
            found[getattr(parameter, "heading", _OWN)].append(record)
    return [(heading, records) for heading, records in found.items() if records]
