"""`crustline completion`: what a shell needs to complete the command's words."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from crustline.cli.sections import Sectioned

SHELLS = ("bash", "zsh", "fish")


@click.command(cls=Sectioned)
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the completion of a shell, for the file that it reads at its start.

    \b
        crustline completion bash
    """
    made = get_completion_class(shell)
    assert made is not None
    root = context.find_root().command
    click.echo(made(root, {}, "crustline", "_CRUSTLINE_COMPLETE").source())
