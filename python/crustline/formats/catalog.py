"""The formats that there are, and which of them a file is."""

from __future__ import annotations

from crustline.errors import FormatError, InputError, shown
from crustline.formats.dxf import DXF
from crustline.formats.e57 import E57
from crustline.formats.excel import EXCEL
from crustline.formats.format import Format, Option
from crustline.formats.geojson import GEOJSON
from crustline.formats.image import IMAGE
from crustline.formats.json_points import JSON
from crustline.formats.las import LAS, LAZ
from crustline.formats.mesh import OBJ, STL
from crustline.formats.npy import NPY, NPZ
from crustline.formats.parquet import FEATHER, PARQUET
from crustline.formats.ply import PLY
from crustline.formats.pts import PTS
from crustline.formats.signatures import foreign
from crustline.formats.source import Source
from crustline.formats.svg import SVG
from crustline.formats.target import Target
from crustline.formats.text import CSV, TSV, XYZ
from crustline.formats.vector import FGB, GPKG, GPX, KML, SHP
from crustline.formats.wkt import WKT

__all__ = ["FORMATS", "able", "format_of_source", "format_of_target", "options_for", "suffixes_for"]

#: Every format by its name; where several claim a file, the first whose `sniff` says so is it.
FORMATS = {
    each.name: each
    for each in (
        CSV,
        TSV,
        XYZ,
        GEOJSON,
        JSON,
        WKT,
        NPZ,
        NPY,
        SVG,
        GPKG,
        SHP,
        FGB,
        KML,
        GPX,
        PARQUET,
        FEATHER,
        DXF,
        EXCEL,
        IMAGE,
        LAS,
        LAZ,
        PLY,
        PTS,
        E57,
        STL,
        OBJ,
    )
}


def able(task: str) -> list[Format]:
    """Return the formats that can do a task, such as "read" or "write_points"."""
    return [each for each in FORMATS.values() if each.can(task)]


def options_for(task: str) -> dict[Option, list[Format]]:
    """Return the options that any format has for a task, each with the formats that have it."""
    found: dict[Option, list[Format]] = {}
    for each in able(task):
        for option in each.options_of(task):
            found.setdefault(option, []).append(each)
    return found


def suffixes_for(task: str) -> list[str]:
    """Return the suffixes of the formats that can do a task."""
    return list(dict.fromkeys(suffix for each in able(task) for suffix in each.suffixes))


def format_of_source(source: Source, name: str | None, task: str = "read") -> Format:
    """Return the format to read: that of a name, of the suffix, or of the first bytes."""
    if name is not None:
        return _named(name, task)
    claimed = _claiming(source.suffix, task)
    seen = [each for each in claimed or able(task) if each.sniff and each.sniff(source.head)]
    if seen:
        return seen[0]
    known = [each for each in able(task) if each.sniff and each.sniff(source.head)]
    if known:
        raise FormatError(
            f"{source.name} is {known[0].title} inside: name it {known[0].suffixes[0]}"
        )
    what = foreign(source.head)
    if any(source.suffix in each.suffixes for each in able("mesh") if not each.can(task)):
        what = "a surface in space: cut it by planes (--slice z=0)"
    if what is not None:
        raise FormatError(f"{source.name} is {what}")
    if claimed or XYZ.can(task):
        return claimed[0] if claimed else XYZ
    raise InputError(f"{source.name} is in no format of curves: use one of {_names(task)}")


def format_of_target(target: Target, name: str | None, task: str) -> Format:
    """Return the format in which to write: that of a name, or of the suffix."""
    if name is not None:
        return _named(name, task)
    claimed = _claiming(target.suffix, task)
    if claimed:
        return claimed[0]
    suffixes = ", ".join(suffixes_for(task))
    raise InputError(
        f"no format is known for the output {shown(target.name)}: name it {suffixes}, "
        "or choose a format by its name"
    )


def _claiming(suffix: str, task: str) -> list[Format]:
    return [each for each in able(task) if suffix in each.suffixes]


def _named(name: str, task: str) -> Format:
    if not isinstance(name, str) or name not in FORMATS or not FORMATS[name].can(task):
        verb = task.split("_")[0]
        raise InputError(
            f"nobody knows how to {verb} the format {shown(name)}: choose one of {_names(task)}"
        )
    return FORMATS[name]


def _names(task: str) -> str:
    return ", ".join(each.name for each in able(task))
