"""DXF by ezdxf: the vertices and edges of drawings are read; rings, holes and lines are written."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import chain
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves, trace
from crustline.formats.format import Format, Layer
from crustline.formats.geometries import joined
from crustline.formats.options import LAYER, TOLERANCE, UNIT
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.formats.vertices import edges_along
from crustline.points import Points
from crustline.smooth import Splines

#: Entities that blocks within blocks may unfold to.
_MOST_ENTITIES = 1_000_000
#: How far a chord is from an arc or spline that it stands for, as a part of the curve's extent.
_FLATNESS = 1 / 1000
#: The same as a part of the largest coordinate, whose rounding a flatness must exceed.
_RESOLUTION = 1e-12
#: No coordinate of a curve may be as large, so that its halves are numbers.
_FARTHEST = 1e150
_UNITS = {"mm": 4, "cm": 5, "m": 6, "km": 7, "in": 1, "ft": 2, "": 0}
_REFUSED = '<>/\\":;?*|=,`'
_LAYERS = {"RINGS": 5, "HOLES": 1, "OPEN": 3, "POINTS": 7}


def read(source: Source, *, layer: str | None = None) -> Points:
    """Return the vertices of points, lines, polylines, arcs and splines, blocks included.

    Beside them are the columns layer and entity, and heights if there are any but 0.
    """
    return _points(list(_parts(source, layer)))


def read_curves(source: Source, *, layer: str | None = None) -> Curves:
    """Return the lines of a drawing, joined where their ends are equal."""
    parts = list(_parts(source, layer))
    points = _points(parts)
    sizes = np.array([len(part[2]) for part in parts], np.int64)
    closed = np.array([part[3] for part in parts], np.bool_)
    edges = edges_along(sizes, np.ones_like(closed), closed)
    return trace(points, joined(points.xy, edges))


def layers(source: Source) -> list[Layer]:
    """Return the layers that entities with vertices are on."""
    counts = Counter(part[0] for part in _parts(source, None))
    return [Layer(name, "entities", count) for name, count in counts.items()]


# A layer, the type of an entity, its vertices (k, 3), and whether it is closed.
_Part = tuple[str, str, FloatArray, bool]


def _points(parts: list[_Part]) -> Points:
    xyz = np.concatenate([np.zeros((0, 3)), *(part[2] for part in parts)])
    counts = [len(part[2]) for part in parts]
    columns = {
        name: np.repeat(np.array([part[k] for part in parts], dtype=np.object_), counts)
        for k, name in enumerate(("layer", "entity"))
    }
    return Points(xyz[:, :2], z=xyz[:, 2] if xyz[:, 2].any() else None, columns=columns)


def _parts(source: Source, layer: str | None) -> Iterator[_Part]:
    with source.path(".dxf") as path, source.library("ezdxf"):
        import ezdxf
        from ezdxf import recover
        from ezdxf.disassemble import recursive_decompose

        with _without_repairs(source):
            try:
                drawing: Any = ezdxf.readfile(path)
            except ezdxf.DXFStructureError:
                drawing, _ = recover.readfile(path)
        _refuse_explosions(drawing, source)
        known = {each.dxf.name for each in drawing.layers}
        found = False
        for entity in recursive_decompose(drawing.modelspace()):
            on = entity.dxf.get("layer", "0")
            known.add(on)
            if layer in (None, on):
                found = True
                for vertices, closed in _vertices(entity, source):
                    yield on, entity.dxftype(), vertices, closed
    if layer is not None and not found:
        raise source.error(f"nothing is on a layer {layer!r:.60}: choose from {sorted(known)[:20]}")
    source.note("unit", str(drawing.header.get("$INSUNITS", 0)))


@contextmanager
def _without_repairs(source: Source) -> Iterator[None]:
    """Refuse a number that ezdxf guesses from a damaged one, and warn of what else it repairs."""
    logger, repairs = logging.getLogger("ezdxf"), _Remarks()
    propagates, logger.propagate = logger.propagate, False
    logger.addHandler(repairs)
    try:
        yield
    finally:
        logger.removeHandler(repairs)
        logger.propagate = propagates
    for remark in repairs.found:
        if "floating point value" in remark:
            value, near = remark.split('"')[1][:40], remark.partition(" near line ")[2]
            place = f"near line {near.partition(' ')[0]}"
            raise source.error(f"{value!r} is not a number: correct it", place)
    if repairs.found:
        source.warn(f"it was damaged, and read without what was: {repairs.found[0][:120]}")


class _Remarks(logging.Handler):
    """What is logged, in lines."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.found: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.found.append(" ".join(record.getMessage().split()))


def _refuse_explosions(drawing: Any, source: Source) -> None:
    """Refuse blocks that hold themselves, or unfold to more entities than can be meant."""
    inside = {
        block.name: [each.dxf.name for each in block.query("INSERT")] for block in drawing.blocks
    }
    sizes = {block.name: len(block) for block in drawing.blocks}
    done: dict[str, int] = {}

    def size(name: str, around: tuple[str, ...]) -> int:
        if name in around:
            raise source.error(f"the block {name!r:.40} holds itself: repair the drawing")
        if name not in done:
            below = (size(each, (*around, name)) for each in inside.get(name, ()))
            done[name] = sizes.get(name, 0) + sum(below)
        return done[name]

    total = sum(size(each.dxf.name, ()) for each in drawing.modelspace().query("INSERT"))
    if total > _MOST_ENTITIES:
        raise source.error(f"its blocks unfold to {total:,} entities: explode fewer of them")


def _vertices(entity: Any, source: Source) -> Iterator[tuple[FloatArray, bool]]:
    """Yield the vertices of an entity, and whether they are a ring; nothing for other entities."""
    kind = entity.dxftype()
    if kind == "POINT":
        yield _array([entity.dxf.location]), False
    elif kind == "LINE":
        yield _array([entity.dxf.start, entity.dxf.end]), False
    elif kind == "SPLINE" and len(entity.fit_points):
        yield _ring_or_line(_array(entity.fit_points), bool(entity.closed))
    elif kind in ("LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"):
        yield from _flattened(entity, source)


def _flattened(entity: Any, source: Source) -> Iterator[tuple[FloatArray, bool]]:
    from ezdxf import path

    for part in path.make_path(entity).sub_paths():
        corners = _array(part.control_vertices())
        largest = float(np.abs(corners).max(initial=0.0))
        if not largest < _FARTHEST:
            what = f"{entity.dxftype()} on layer {entity.dxf.get('layer', '0')!r:.40}"
            raise source.error(f"the {what} reaches beyond {_FARTHEST:g}: correct its numbers")
        if part.has_curves:
            # Below what numbers of this size can tell, halving a curve would have no end.
            extent = float(np.ptp(corners, axis=0).max()) or 1.0
            flatness = max(extent * _FLATNESS, largest * _RESOLUTION)
            corners = _array(part.flattening(flatness, segments=4))
        yield _ring_or_line(corners, bool(part.is_closed))


def _ring_or_line(vertices: FloatArray, closed: bool) -> tuple[FloatArray, bool]:
    if len(vertices) > 3 and (vertices[0] == vertices[-1]).all():
        return vertices[:-1], True
    return vertices, closed and len(vertices) > 2


def _array(vertices: Iterable[Any]) -> FloatArray:
    rows = [(float(each[0]), float(each[1]), float(each[2])) for each in vertices]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


# Writing


def write_points(points: Points, target: Target, *, unit: str = "") -> None:
    """Write a POINT a row, on the layer POINTS."""
    drawing = _drawing(unit)
    _add_points(drawing.modelspace(), points, np.arange(len(points)))
    _save(drawing, target)


def write_curves(curves: Curves, target: Target, *, unit: str = "") -> None:
    """Write a polyline a curve, on the layers RINGS, HOLES and OPEN; isolated points on POINTS."""
    drawing = _drawing(unit)
    _add_curves(drawing.modelspace(), curves)
    _save(drawing, target)


def write_layers(things: Mapping[str, Points | Curves], target: Target, *, unit: str = "") -> None:
    """Write each thing on a layer of its own; rings, holes and open lines by their colors."""
    drawing = _drawing(unit)
    for name, thing in zip(_layer_names(things), things.values(), strict=True):
        drawing.layers.add(name)
        if isinstance(thing, Points):
            _add_points(drawing.modelspace(), thing, np.arange(len(thing)), name)
        else:
            _add_curves(drawing.modelspace(), thing, name)
    _save(drawing, target)


def _layer_names(things: Mapping[str, Any]) -> list[str]:
    """Return names that DXF allows, each once."""
    names: list[str] = []
    for name in things:
        allowed = "".join("_" if each in _REFUSED or each < " " else each for each in name)
        while allowed.lower() in {*map(str.lower, names), *map(str.lower, _LAYERS), "0", ""}:
            allowed += "_"
        names.append(allowed)
    return names


def _add_curves(space: Any, curves: Curves, layer: str = "") -> None:
    for feature in curves.features(polygons=True):
        if feature.kind == "points":
            _add_points(space, curves.points, feature.parts[0], layer)
            continue
        for number, rows in enumerate(feature.parts):
            kind = "OPEN" if feature.kind == "line" else "HOLES" if number else "RINGS"
            style = {"layer": layer, "color": _LAYERS[kind]} if layer else {"layer": kind}
            _add_polyline(space, curves.points, rows, feature.closed, style)


def write_splines(
    splines: Splines, target: Target, *, tolerance: float | None = None, unit: str = ""
) -> None:
    """Write a SPLINE a curve, on the layers RINGS and OPEN."""
    drawing = _drawing(unit)
    space = drawing.modelspace()
    for spline, pieces in zip(splines, splines.beziers(tolerance), strict=True):
        if len(pieces):
            _add_spline(space, pieces, "RINGS" if spline.closed else "OPEN")
    _save(drawing, target)


def _drawing(unit: str) -> Any:
    import ezdxf

    drawing: Any = ezdxf.new("R2010", setup=False, units=_UNITS[unit])
    for name, color in _LAYERS.items():
        drawing.layers.add(name, color=color)
    return drawing


def _add_points(space: Any, points: Points, rows: IntArray, layer: str = "") -> None:
    for place in _xyz(points, rows).tolist():
        space.add_point(place, dxfattribs={"layer": layer or "POINTS"})


def _add_polyline(
    space: Any, points: Points, rows: IntArray, closed: bool, style: dict[str, Any]
) -> None:
    """Add a polyline of the plane, at its elevation if it is level, or else one in space."""
    z = np.zeros(1) if points.z is None else points.z[rows]
    if (z == z[0]).all():
        level = style if points.z is None else {**style, "elevation": float(z[0])}
        space.add_lwpolyline(points.xy[rows].tolist(), close=closed, dxfattribs=level)
    else:
        space.add_polyline3d(_xyz(points, rows).tolist(), close=closed, dxfattribs=style)


def _add_spline(space: Any, pieces: FloatArray, layer: str) -> None:
    """Add cubic Béziers (k, 4, 2) as one B-spline: knots inside are threefold."""
    control = [pieces[0, 0].tolist(), *chain.from_iterable(piece[1:].tolist() for piece in pieces)]
    inner = chain.from_iterable([k] * 3 for k in range(1, len(pieces)))
    knots = [0.0] * 4 + [float(k) for k in inner] + [float(len(pieces))] * 4
    space.add_open_spline(
        [(x, y, 0.0) for x, y in control], degree=3, knots=knots, dxfattribs={"layer": layer}
    )


def _xyz(points: Points, rows: IntArray) -> FloatArray:
    heights = np.zeros(len(rows)) if points.z is None else points.z[rows]
    return np.column_stack([points.xy[rows], heights])


def _save(drawing: Any, target: Target) -> None:
    with target.path(".dxf") as path:
        drawing.saveas(path)


def _is_dxf(head: bytes) -> bool:
    lines = [line.strip() for line in head[:200].split(b"\n")]
    binary = head.startswith(b"AutoCAD Binary DXF\r\n")
    return binary or (lines[:2] == [b"0", b"SECTION"] or lines[:1] == [b"999"])


DXF = Format(
    name="dxf",
    title="DXF",
    suffixes=(".dxf",),
    sniff=_is_dxf,
    read=read,
    read_curves=read_curves,
    layers=layers,
    write_points=write_points,
    write_curves=write_curves,
    write_layers=write_layers,
    write_splines=write_splines,
    options=(LAYER, TOLERANCE, UNIT),
    extra="cad",
    needs=("ezdxf",),
)
