"""Smooth curves from the paths of SVG files."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterable
from typing import Any

import numpy as np

from crustline.arrays import FloatArray
from crustline.errors import FormatError, InputError, require, shown
from crustline.scalars import as_real
from crustline.shapes.bezier import bezier_loop, smoothed
from crustline.shapes.curve import SmoothCurve

#: How deep elements of an SVG file may be within one another, and how many they may come to.
_DEEPEST, _MOST = 100, 100_000


def bezier_path(source: str | os.PathLike[str], *, smooth_joins: float = 1.0) -> SmoothCurve:
    """Return the closed cubic Bézier paths of an SVG file, or of one path string.

    Parameters
    ----------
    source : str or path
        A file whose name ends in .svg, or the `d` of a path such as "M 1 0 C …". Lines, quadratic
        curves and arcs are raised to cubics; transforms are applied; the coordinates stay those
        of the file's d attributes, whatever size in pixels its viewBox has, so y grows downwards.
    smooth_joins : float
        Degrees. Joints that turn by less (files round their handles) are made smooth: both handles
        turn to the mean direction. A joint that turns by more is a corner, which no smooth curve
        has.

    Raises
    ------
    InputError
        If a subpath is open or has a corner (the message names it), or there is none; if the
        string is no path.
    FormatError
        If the file cannot be read, or is no SVG.
    MissingExtraError
        If svgelements is not installed (extra `svg`).

    Notes
    -----
    Once differentiable: the curvature may jump where two pieces meet. Arcs become
    cubics with an error of about 3 · 10⁻⁴ of their radius or less.

    Examples
    --------
    >>> loop = bezier_path("M 0 0 C 0 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z")
    >>> loop.point([0, 0.25, 0.5]).tolist()
    [[0.0, 0.0], [1.0, 1.125], [2.0, 0.0]]
    """
    tolerance = as_real("smooth_joins", smooth_joins, "in [0, 180)", lambda x: 0 <= x < 180)
    loops = []
    for i, pieces in enumerate(_svg_subpaths(source)):
        loops.append(bezier_loop(smoothed(pieces, math.radians(tolerance), f"subpath {i}")))
    if not loops:
        raise InputError(f"{shown(os.fspath(source)) if source else 'an empty text'} holds no path")
    return SmoothCurve(tuple(loops))


def _svg_subpaths(source: str | os.PathLike[str]) -> list[FloatArray]:
    """Return each subpath's cubic pieces, as control points of shape (s, 4, 2)."""
    require("svg", "svgelements")
    import svgelements  # type: ignore[import-untyped]

    if not isinstance(source, str | os.PathLike):
        raise InputError(f"source is {shown(source)}: give the name of a .svg file, or a path's d")
    name = os.fspath(source)
    if name.lower().endswith(".svg"):
        return _pieces_of_file(svgelements, name)
    try:
        return _pieces([svgelements.Path(name)], svgelements)
    except Exception:  # a dozen kinds, as they come upon a wrong letter
        raise InputError(
            f"{name[:60]!r} is neither the d of a path, such as 'M 1 0 C …', nor a .svg file"
        ) from None


def _pieces(paths: Iterable[Any], svg: Any) -> list[FloatArray]:
    """Return the cubics of each subpath that has any; refuse coordinates that are not finite."""
    pieces = []
    for path in paths:
        for subpath in path.as_subpaths():
            cubics = [c for segment in subpath for c in _cubics(svg, segment)]
            if cubics:
                pieces.append(np.array(cubics, dtype=np.float64))
    if not all(np.isfinite(each).all() for each in pieces):
        raise ValueError("a coordinate is not finite")
    return pieces


def _pieces_of_file(svg: Any, name: str) -> list[FloatArray]:
    """Return the subpaths of an SVG file, in the coordinates within its viewBox."""
    from xml.etree import ElementTree

    from crustline.formats.source import Source

    source = Source(name)
    content = source.content()
    if b"<!ENTITY" in content:
        raise source.error("it declares entities, which are not read: write them out")
    try:
        root = ElementTree.fromstring(content)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise FormatError(f"{name} is no SVG: {error}") from None
    if root.tag.rpartition("}")[2] != "svg":
        raise FormatError(f"{name} is no SVG: its outermost element is {shown(root.tag)}")
    _refuse_expansion(root, source)
    box = root.attrib.pop("viewBox", "").replace(",", " ").split()
    if len(box) == 4:
        # A drawing as large as its viewBox is neither scaled nor, from 0 on, shifted.
        root.attrib.update(width=box[2], height=box[3], viewBox=f"0 0 {box[2]} {box[3]}")
    with source.library("svgelements"):
        text = io.BytesIO(ElementTree.tostring(root))
        elements = svg.SVG.parse(text, reify=True).elements()
        # A circle that is mirrored or turned has its transform still before it: abs applies it.
        shapes = (each for each in elements if isinstance(each, svg.Shape))
        return _pieces((abs(svg.Path(each)) for each in shapes), svg)


def _refuse_expansion(root: Any, source: Any) -> None:
    """Refuse a tree that is too deep, or that `use` elements make endless or too large."""
    named = {each.get("id"): each for each in root.iter() if each.get("id")}
    waiting, count = [(root, 1)], 0
    while waiting:
        element, depth = waiting.pop()
        count += 1
        if depth > _DEEPEST or count > _MOST:
            what = f"more than {_DEEPEST} deep" if depth > _DEEPEST else f"over {_MOST:,} elements"
            raise source.error(f"its elements are {what}, uses of others included: simplify it")
        waiting.extend((child, depth + 1) for child in element)
        target = next((v for k, v in element.attrib.items() if k.rpartition("}")[2] == "href"), "")
        if element.tag.rpartition("}")[2] == "use" and target[1:] in named:
            waiting.append((named[target[1:]], depth + 1))


def _cubics(svg: Any, segment: Any) -> list[list[list[float]]]:
    """Return a path segment as control points of cubics; none for a move or an empty line."""
    if isinstance(segment, svg.Move) or segment.start is None or segment.start == segment.end:
        return []
    if isinstance(segment, svg.Arc):
        return [row for cubic in segment.as_cubic_curves() for row in _cubics(svg, cubic)]
    if isinstance(segment, svg.CubicBezier):
        corners = [segment.start, segment.control1, segment.control2, segment.end]
        return [[[float(p.x), float(p.y)] for p in corners]]
    a, z = (np.array([float(p.x), float(p.y)]) for p in (segment.start, segment.end))
    if isinstance(segment, svg.QuadraticBezier):
        middle = np.array([float(segment.control.x), float(segment.control.y)])
        return [
            [
                a.tolist(),
                ((a + 2 * middle) / 3).tolist(),
                ((z + 2 * middle) / 3).tolist(),
                z.tolist(),
            ]
        ]
    return [[a.tolist(), ((2 * a + z) / 3).tolist(), ((a + 2 * z) / 3).tolist(), z.tolist()]]
