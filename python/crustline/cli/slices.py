"""`crustline reconstruct --slice`, `--section`: curves in planes through clouds and meshes."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from crustline.cli.hints import Command
from crustline.cli.method import Method
from crustline.cli.orientation import Orientation
from crustline.cli.output import Output, counted, write_with
from crustline.cli.progress import progress_bar
from crustline.cli.sections import headed
from crustline.cli.source import Source
from crustline.errors import InputError

if TYPE_CHECKING:
    from crustline.curves import Curves
    from crustline.slices import Plane, Slices


@dataclass(frozen=True)
class _Cuts:
    """The planes to cut by, how thick slices are, and how they are fitted and written."""

    planes: tuple[str, ...]
    sections: tuple[str, ...]
    thickness: float | None
    width: float | None
    scale: float | None
    as_they_are: bool
    flat: bool

    def all_planes(self) -> tuple[list[Plane], list[float | None]]:
        """Return the planes, and the thickness of the slice about each."""
        from crustline.slices import section
        from crustline.slices.plane import as_planes

        level = as_planes(self.planes) if self.planes else []
        upright = [section(line) for line in self.sections]
        width = self.thickness if self.width is None else self.width
        thick = [self.thickness] * len(level) + [width] * len(upright)
        return as_planes([*level, *upright]), thick


@headed("Slices of clouds and meshes")
def slice_options(command: Command) -> Command:
    """Give a command --slice and what goes with it; such runs do not reach the command."""

    @click.option("--slice", "planes", multiple=True, metavar="PLANE",
                  help="Cut a cloud or mesh: z=12.5, z=0:30:0.5 (from, to, step), or 1,0,2=5 for "
                  "x + 2z = 5. Give it again for more.")  # fmt: skip
    @click.option("--section", "sections", multiple=True, metavar="X0,Y0,X1,Y1",
                  help="Cut upright along a line.")  # fmt: skip
    @click.option("--thickness", type=float, metavar="T",
                  help="How thick slices of clouds are; also how wide strokes are when they are "
                  "fitted.")  # fmt: skip
    @click.option("--width", type=float, metavar="W", help="The same for sections.")
    @click.option("--scale", type=float, metavar="S",
                  help="How wide strokes are in slices, if not as wide as slices are "
                  "thick.")  # fmt: skip
    @click.option("--no-fit", "as_they_are", is_flag=True,
                  help="Join the points of slices as they are.")  # fmt: skip
    @click.option("--flat", is_flag=True,
                  help="Write coordinates in the planes of slices, not in space.")  # fmt: skip
    @functools.wraps(command)
    def run(**options: Any) -> None:
        given = {name: options.pop(name) for name in _Cuts.__annotations__}
        if given["planes"] or given["sections"]:
            _slice(_Cuts(**given), **options)
            return
        named = [name for name, value in given.items() if value not in (None, False, ())]
        if named:
            word = "no-fit" if named[0] == "as_they_are" else named[0]
            raise InputError(f"--{word} is for slices: add --slice PLANE or --section LINE")
        command(**options)

    return run


def _slice(  # noqa: PLR0913 - what the command is given
    cuts: _Cuts,
    source: Source,
    output: Output,
    orientation: Orientation,
    by: str | None,
    edges_from_file: bool,
    confidence: bool,
    method: Method,
) -> None:
    from crustline.slices import slices
    from crustline.slices.body import as_body

    refused = {
        "--by": by, "--edges-from-file": edges_from_file, "--confidence": confidence,
        "--fit": method.fit, "--noise": method.noise, "--project": method.project,
    }  # fmt: skip
    for option, value in refused.items():
        if value:
            raise InputError(f"{option} is not for slices: leave it away")
    planes, thickness = cuts.all_planes()
    with progress_bar(output.quiet):
        found = slices(
            as_body(source.name, source.format, source.crs, **source.settings),
            planes, thickness=thickness, fit=not cuts.as_they_are, scale=cuts.scale,
            merge=method.merge, method=method.function, threads=source.threads, **method.parameters,
        )  # fmt: skip
    curves = found.curves(flat=cuts.flat)
    _write({name: orientation.of(each, None) for name, each in curves.items()}, output)
    _say(source, found, output)


def _write(curves: Mapping[str, Curves], output: Output) -> None:
    from crustline.formats import FORMATS
    from crustline.slices.slice import layered

    for file, form in output.files.items() if not output.dry_run else ():
        thing, task = layered(curves, FORMATS[form])
        write_with(thing, file, form, task, output.settings)


def _say(source: Source, found: Slices, output: Output) -> None:
    counts = {
        "slices": len(found),
        "empty": len(found.empty),
        "points": sum(each.count for each in found),
        "rings": sum(int(each.curves.closed.sum()) for each in found),
        "open_curves": sum(int((~each.curves.closed).sum()) for each in found),
    }
    words = {"slices": "slice", "empty": "empty plane", "points": "point",
             "rings": "ring", "open_curves": "open curve"}  # fmt: skip
    said = [counted(counts[key], word) for key, word in words.items()
            if counts[key] or key != "empty"]  # fmt: skip
    output.report(f"{source.name}: {', '.join(said)}", {"input": source.name, **counts})
