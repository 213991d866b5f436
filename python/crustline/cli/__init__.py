"""The command `crustline`: what goes wrong ends in one line and exit code 2, never in a traceback.

A new command is a file here, or a function in one, and a line in `commands.add_command`s below. Its
input, method and output are the options of `source`, `method` and `output`; errors, Ctrl-C and
pipes are `main`'s.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from typing import Any, NoReturn

import click

from crustline.cli.batch import batch
from crustline.cli.certify import certify
from crustline.cli.completion import completion
from crustline.cli.edit import edit
from crustline.cli.encoding import spell_out
from crustline.cli.info import convert, info
from crustline.cli.medial_axis import medial_axis
from crustline.cli.method import list_methods
from crustline.cli.pictures import plot, smooth
from crustline.cli.reconstruct import reconstruct
from crustline.cli.sampling import sample, thin
from crustline.errors import CrustlineError, FormatWarning


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command with some arguments, by default those of the process, and exit."""
    spell_out()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("always", FormatWarning)
            warnings.showwarning = _warn  # type: ignore[assignment]  # needs the words alone
            code = commands.main(args=arguments, prog_name="crustline", standalone_mode=False)
        sys.stdout.flush()
    except (click.Abort, KeyboardInterrupt):
        _exit(130, "interrupted")
    except click.ClickException as error:
        _exit(2, _advise(error))
    except BrokenPipeError:
        # The reader has gone: nothing to say, and nothing to flush at the end either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        sys.exit(1)
    except MemoryError:
        _exit(2, "there is not enough memory: reconstruct fewer points at once")
    except CrustlineError as error:
        _exit(2, str(error))
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # where nothing is flushed in vain at the end
        _exit(2, f"standard output cannot be written: {error.strerror or error}")
    sys.exit(code or 0)  # what a command gave to `click.exceptions.Exit`


def _exit(code: int, message: str) -> NoReturn:
    line = " ".join(message.split())
    click.echo(f"crustline: {'error: ' if code == 2 else ''}{line}", err=True)
    sys.exit(code)


def _warn(message: Warning | str, *about: Any) -> None:
    """Say a warning in a line; only its words are for users."""
    click.echo(f"crustline: warning: {' '.join(str(message).split())}", err=True)


def _advise(error: click.ClickException) -> str:
    context = error.ctx if isinstance(error, click.UsageError) else None
    advice = f"see {context.command_path} --help" if context else "see crustline --help"
    return f"{error.format_message().rstrip('.')}: {advice}"


def _show_version(context: click.Context, option: click.Parameter, value: bool) -> None:
    if value and not context.resilient_parsing:
        from crustline import __version__

        click.echo(f"crustline {__version__}")
        context.exit()


class _InOrder(click.Group):
    """Lists the commands in the order in which they are added."""

    def list_commands(self, context: click.Context) -> list[str]:
        return list(self.commands)


@click.group(
    cls=_InOrder,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_version,
    help="Show the version and exit.",
)
@click.pass_context
def commands(context: click.Context) -> None:
    """Turn unordered points into the curves that they were sampled from."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


for _command in (
    reconstruct, batch, info, certify, smooth, plot, medial_axis, thin, sample, convert,
    list_methods, edit, completion,
):  # fmt: skip
    commands.add_command(_command)
