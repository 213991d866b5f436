"""What a format is: a value that says its name and suffixes, how it is recognized, read, written.

To add a format:

1. Make a file here, with a function for each thing that the format can do:

   - ``read(source, *, …) -> Points`` and ``read_curves(source, *, …) -> Curves`` take a `Source`,
     which is a path, bytes or a stream to them alike: `source.content()`, `source.text()`,
     `source.open()`, `source.chunks()`, or `with source.path() as path` for a library that opens
     files itself. ``stream(source, rows, *, …)`` yields `Points` piece by piece for files larger
     than memory, ``layers(source) -> list[Layer]`` says what a file with several of them holds.
   - ``write_points(points, target, *, …)``, ``write_curves(curves, target, *, …)`` and
     ``write_splines(splines, target, *, …)`` take a `Target`, which puts files in place whole or
     not at all: `target.write(content)`, or `with target.path() as path`, whose folder may get
     several files. Other things (a medial axis, a certificate) arrive as one of these three.
     ``write_layers(things, target, *, …)`` takes a mapping of names to points and curves.
   - ``cloud(source, box, *, …)`` yields the points in space, as `Chunk`s, for slices; those outside
     of the box, its least and greatest corner, may be left out. ``mesh(source)`` returns the
     vertices (n, 3) and triangles (m, 3) of a surface, or None if the file holds points alone.

   What is wrong in a file is `raise source.error("what it is: what to do", "line 3")`; what is
   doubtful but read, `source.warn("what was understood: the option that says otherwise")`; what
   was understood, `source.note("separator", "comma")`, for `crustline info`. What a library
   raises belongs into ``with source.library("ezdxf"):``, which makes it a `FormatError`.

2. Declare its options as `Option` values, or take them from `crustline.formats.options`. Their
   names are the keyword-only parameters of the functions that take them (all of them, if it is
   ``**options``); checking them, refusing
   them where nothing takes them, and the command's help are done for you.

3. Export a `Format`, and put it into `FORMATS` in `crustline.formats.catalog`. If it needs
   packages that a plain installation lacks, say so in `extra` and `needs`, and import them inside
   the functions: where one is missing, the caller learns what to install.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from inspect import signature
from typing import TYPE_CHECKING, Any

from crustline.errors import InputError, require, shown

if TYPE_CHECKING:
    from crustline.arrays import FloatArray, IntArray
    from crustline.curves import Curves
    from crustline.formats.cloud import Chunk
    from crustline.formats.source import Source
    from crustline.formats.target import Target
    from crustline.points import Points

__all__ = ["Format", "Layer", "Option"]


@dataclass(frozen=True)
class Option:
    """A setting of a format, for callers and for the command.

    Attributes
    ----------
    name : str
        The keyword-only parameter that takes it, such as "skip_lines".
    help : str
        One sentence, as `--help` shows it.
    parse : callable
        Takes what a caller gives, or the text that the command was given; returns what the
        functions take, or raises `ValueError` with the words for what it must be.
    metavar : str
        What `--help` shows for the value; "" if the command's option takes none.
    flag : str
        The command's spelling, by default "--skip-lines".
    constant : object
        What an option without a value means where it is given, such as True.
    """

    name: str
    help: str
    parse: Callable[[Any], Any]
    metavar: str = ""
    flag: str = ""
    constant: Any = True

    @property
    def spelling(self) -> str:
        """How the command spells it."""
        return self.flag or f"--{self.name.replace('_', '-')}"

    def check(self, value: Any) -> Any:
        """Return the value as functions take it, or raise `InputError`."""
        try:
            return self.parse(value)
        except InputError:
            raise
        except ValueError as error:
            raise InputError(f"{self.name} ({self.spelling}) is {shown(value)}: {error}") from None


@dataclass(frozen=True)
class Layer:
    """One of the layers of a file: its name, what it holds, and how many of it."""

    name: str
    kind: str
    count: int | None = None


@dataclass(frozen=True, kw_only=True)
class Format:
    """A file format.

    Attributes
    ----------
    name : str
        What `format=` and the command call it, such as "csv".
    title : str
        What messages call it, such as "CSV".
    suffixes : tuple of str
        In lower case, with their points; several formats may have the same one if they `sniff`.
    sniff : callable, optional
        Whether the first bytes of a file (4096 or fewer) are of this format, beyond doubt.
    read, read_curves, stream, layers : callable, optional
        See the module's text.
    cloud, mesh : callable, optional
        See the module's text.
    write_points, write_curves, write_splines, write_layers : callable, optional
        See the module's text.
    options : tuple of Option
        All options of these functions.
    extra : str
        The extra of crustline that brings what it needs, such as "gis".
    needs : tuple of str
        The modules that it needs and that a plain installation lacks.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    sniff: Callable[[bytes], bool] | None = None
    read: Callable[..., Points] | None = None
    read_curves: Callable[..., Curves] | None = None
    stream: Callable[..., Iterator[Points]] | None = None
    layers: Callable[[Source], list[Layer]] | None = None
    cloud: Callable[..., Iterator[Chunk]] | None = None
    mesh: Callable[[Source], tuple[FloatArray, IntArray] | None] | None = None
    write_points: Callable[..., None] | None = None
    write_curves: Callable[..., None] | None = None
    write_splines: Callable[..., None] | None = None
    write_layers: Callable[[Mapping[str, Points | Curves], Target], None] | None = None
    options: tuple[Option, ...] = ()
    extra: str = ""
    needs: tuple[str, ...] = ()

    def can(self, task: str) -> bool:
        """Return whether it has a function for a task, such as "read" or "write_points"."""
        return getattr(self, task) is not None

    def options_of(self, task: str) -> tuple[Option, ...]:
        """Return the options that its function for a task takes."""
        function = getattr(self, task)
        known = signature(function).parameters if function else {}
        every = any(each.kind is each.VAR_KEYWORD for each in known.values())
        return tuple(option for option in self.options if every or option.name in known)

    def settings(self, task: str, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return the options of a task, checked; None counts as not given."""
        known = {option.name: option for option in self.options_of(task)}
        given = {name: value for name, value in given.items() if value is not None}
        for name in given:
            if name not in known:
                has = f"it has {', '.join(known)}" if known else "it has none"
                verb = task.split("_")[0]
                raise InputError(f"{self.title} has no option {shown(name)} to {verb} by: {has}")
        return {name: known[name].check(value) for name, value in given.items()}

    def require(self) -> None:
        """Raise `MissingExtraError` if a package that it needs is not installed."""
        require(self.extra, *self.needs)
