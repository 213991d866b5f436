"""Manual pages, made of what `--help` says: `python -m crustline.cli.manual FOLDER`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from crustline._core import __version__
from crustline.cli import commands
from crustline.cli.sections import sections_of


def page(command: click.Command, name: str) -> str:
    """Return the manual page of a command, as roff."""
    context = click.Context(command, info_name=name)
    short, _, rest = (command.help or "").partition("\n\n")
    lines = [
        f'.TH "{name.upper().replace(" ", "-")}" 1 "" "crustline {__version__}"',
        ".SH NAME",
        f"{_text(name.replace(' ', '-'))} \\- {_text(short)}",
        ".SH SYNOPSIS",
        _text(" ".join([name, *command.collect_usage_pieces(context)])),
        ".SH DESCRIPTION",
        *_paragraphs(rest or short),
    ]
    for heading, records in sections_of(command, context):
        lines.append(f".SH {_text(heading.upper())}")
        for record in records:
            lines += [".TP", f"\\fB{_text(record[0])}\\fR", _text(record[1])]
    if isinstance(command, click.Group):
        lines.append(".SH COMMANDS")
        for each, below in command.commands.items():
            lines += [
                ".TP",
                f"\\fB{_text(name)}\\-{_text(each)}\\fR(1)",
                _text(below.get_short_help_str(99)),
            ]
    return "\n".join(lines) + "\n"


def _paragraphs(text: str) -> list[str]:
    lines: list[str] = []
    for paragraph in text.split("\n\n"):
        if paragraph.startswith("\b"):  # an example, line by line
            body = map(_text, paragraph.removeprefix("\b\n").split("\n"))
            lines += [".PP", ".nf", *body, ".fi"]
        else:
            lines += [".PP", _text(" ".join(paragraph.split()))]
    return lines


def _text(text: str) -> str:
    """Return text that roff takes as it is."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return f"\\&{escaped}" if escaped.startswith((".", "'")) else escaped


def write_pages(folder: Path) -> list[Path]:
    """Write the manual pages of the command and of all its commands."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = {"crustline": commands, **{f"crustline {k}": v for k, v in commands.commands.items()}}
    written = []
    for name, command in pages.items():
        written.append(folder / f"{name.replace(' ', '-')}.1")
        written[-1].write_text(page(command, name), encoding="utf-8")
    return written


if __name__ == "__main__":
    write_pages(Path(sys.argv[1]))
