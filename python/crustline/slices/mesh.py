"""Surfaces of triangles, and the outlines in which planes cut them.

A corner that lies in the plane counts as above it. So a plane crosses none or two sides of a
triangle, whatever lies in it, and the outline of a closed surface is closed. A plane in which faces
lie cuts what is just below it.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay
from crustline.errors import FormatWarning, InputError
from crustline.merge import merge, near_tolerance
from crustline.methods import close_gaps
from crustline.scalars import as_length
from crustline.slices.plane import Plane
from crustline.slices.slice import Slice

__all__ = ["Mesh", "cut_mesh"]


#: Longer than any edge.
_FAR = 1e150


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in space.

    Attributes
    ----------
    name : str
        What messages call it.
    vertices : ndarray of float64, shape (n, 3)
        Different places.
    triangles : ndarray of int64, shape (m, 3)
        Rows of the vertices, three different ones each.
    crs : str or None
        The coordinate reference system.
    """

    name: str
    vertices: FloatArray
    triangles: IntArray
    crs: str | None = None

    @classmethod
    def of(cls, name: str, vertices: FloatArray, faces: IntArray, crs: str | None) -> Mesh:
        """Return triangles whose equal corners are one vertex; those without area are left out."""
        places, rows = np.unique(vertices + 0.0, axis=0, return_inverse=True)
        triangles = rows.ravel()[faces]
        turned = np.roll(triangles, 1, axis=1)
        return cls(name, places, triangles[(triangles != turned).all(axis=1)], crs)

    @property
    def is_closed(self) -> bool:
        """Whether each side of a triangle belongs to an even number of them."""
        sides = np.sort(self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        _, counts = np.unique(sides, axis=0, return_counts=True)
        return bool((counts % 2 == 0).all())


def cut_mesh(
    mesh: Mesh,
    planes: Sequence[Plane],
    *,
    tolerance: float | None,
    threads: int,
    hints: dict[str, Any],
) -> list[Slice]:
    """Return for each plane the outlines of a mesh in it; gaps where it is not closed are decided.

    Parameters
    ----------
    mesh : Mesh
        The surface.
    planes : sequence of Plane
        The planes.
    tolerance : float, optional
        How far ends of lines may be apart to be one; by default those are that are a million times
        nearer to each other than to any other.
    threads : int
        How many slices are made at once.
    hints : dict
        What `close_gaps` takes.
    """

    def cut(plane: Plane) -> tuple[Slice, int]:
        uv, edges = _within_ends(*section_of(mesh, plane), plane)
        uv, edges = _with_ends_merged(uv, edges, tolerance)
        loose = int((np.bincount(edges.ravel(), minlength=len(uv)) == 1).sum())
        if loose and plane.ends is None:
            edges = _with_gaps_closed(uv, edges, hints)
        return Slice(plane, trace(uv, edges), len(edges), mesh.crs), loose

    with ThreadPoolExecutor(threads) as pool:
        made = list(pool.map(cut, planes))
    slices, loose = [each for each, _ in made], sum(count for _, count in made)
    if not any(each.count for each in slices):
        raise InputError(_said_of_nothing(mesh, planes))
    _say_of_gaps(mesh, [each for each in slices if each.plane.ends is None], loose, hints)
    return slices


def _with_gaps_closed(uv: FloatArray, edges: IntArray, hints: dict[str, Any]) -> IntArray:
    """Return edges and those that `connect` adds; `max_edge` is a bound on these alone."""
    longest = hints.get("max_edge", _FAR)
    if isinstance(longest, str):
        raise InputError(f"max_edge is {longest!r}: give a length for the gaps of a mesh")
    others = {name: value for name, value in hints.items() if name != "max_edge"}
    closed = close_gaps(Delaunay(uv, threads=1), edges, **others)
    is_known = np.isin(closed @ [len(uv), 1], edges @ [len(uv), 1])
    lengths = np.hypot(*(uv[closed[:, 0]] - uv[closed[:, 1]]).T)
    kept: IntArray = closed[is_known | (lengths <= as_length("max_edge", longest))]
    return kept


def _say_of_gaps(mesh: Mesh, slices: list[Slice], loose: int, hints: dict[str, Any]) -> None:
    """Warn of a surface that is not closed, or refuse it where closed curves were asked for."""
    still = [each.name for each in slices if not _is_closed(each.curves)]
    if still and hints.get("closed"):
        raise InputError(
            f"{mesh.name} is not closed, nor are its outlines at {still[0]}: repair it"
        )
    if loose and slices:
        end = (
            f"at {still[0]} lines stay open: add --closed"
            if still
            else "the gaps were closed by connect"
        )
        warnings.warn(
            f"{mesh.name} is not closed: its slices have {loose:,} loose ends, and {end}",
            FormatWarning,
            stacklevel=4,
        )


def _is_closed(curves: Curves) -> bool:
    return not len(curves.endpoints)


def _said_of_nothing(mesh: Mesh, planes: Sequence[Plane]) -> str:
    which = planes[0].name if len(planes) == 1 else f"any of the {len(planes)} planes"
    place = mesh.vertices @ planes[0].normal
    return (
        f"{mesh.name} is not cut by {which}: it reaches from {place.min():.6g} to "
        f"{place.max():.6g} along the normal of {planes[0].name}, and what lies in a plane counts "
        "as above it: choose another plane"
    )


def section_of(mesh: Mesh, plane: Plane) -> tuple[FloatArray, IntArray]:
    """Return the places where a plane crosses sides of triangles, and the edges between them.

    Each side is crossed at one place, whichever triangle asks. Edges of no length are contracted.
    """
    height = _heights(mesh.vertices, plane)
    above = height >= 0
    high = above[mesh.triangles].sum(axis=1)
    crossed = (high == 1) | (high == 2)
    cut = mesh.triangles[crossed]
    # The corner that is alone on its side, and the two sides that lead from it.
    lonely = high[crossed] == 1
    alone = np.argmax(above[cut] == lonely[:, None], axis=1)
    rows = np.arange(len(cut))
    corner, left, right = (cut[rows, (alone + k) % 3] for k in range(3))
    sides = np.sort(np.stack([[corner, left], [corner, right]]), axis=1)  # (2 sides, 2 ends, k)
    pairs = sides.transpose(2, 0, 1).reshape(-1, 2)
    unique, numbers = np.unique(pairs, axis=0, return_inverse=True)
    uv = plane.project(_crossings(mesh.vertices, height, unique))
    return _contracted(uv, numbers.reshape(-1, 2))


def _heights(vertices: FloatArray, plane: Plane) -> FloatArray:
    """Return how far vertices are above a plane; exact in sign along axes."""
    used = np.flatnonzero(plane.normal)
    if len(used) == 1:
        above: FloatArray = (vertices[:, used[0]] - plane.origin[used[0]]) * plane.normal[used[0]]
        return above
    return vertices @ plane.normal - plane.offset


def _crossings(vertices: FloatArray, height: FloatArray, sides: IntArray) -> FloatArray:
    """Return where sides cross the plane, from the end that is nearer: exactly there, if on it."""
    nearer = np.abs(height[sides[:, 0]]) <= np.abs(height[sides[:, 1]])
    near, far = np.where(nearer[:, None], sides, sides[:, ::-1]).T
    share = height[near] / (height[near] - height[far])
    there: FloatArray = vertices[near] + share[:, None] * (vertices[far] - vertices[near])
    return there


def _contracted(uv: FloatArray, edges: IntArray) -> tuple[FloatArray, IntArray]:
    """Return places and edges without those of no length; places that only meet stay two."""
    same = (uv[edges[:, 0]] == uv[edges[:, 1]]).all(axis=1)
    return _identified(uv, edges[~same], edges[same])


def _identified(uv: FloatArray, edges: IntArray, pairs: IntArray) -> tuple[FloatArray, IntArray]:
    """Return places and edges where the places of pairs are one."""
    stands = np.arange(len(uv))
    while len(pairs):  # the smaller row stands; a few rounds, as chains are short
        low, high = np.sort(stands[pairs], axis=1).T
        pairs = pairs[low != high]
        np.minimum.at(stands, high, low)
        stands = stands[stands]
    kept, rows = np.unique(stands, return_inverse=True)
    joined = np.sort(rows[edges], axis=1)
    joined = np.unique(joined[joined[:, 0] != joined[:, 1]], axis=0)
    return uv[kept], joined


def _with_ends_merged(
    uv: FloatArray, edges: IntArray, tolerance: float | None
) -> tuple[FloatArray, IntArray]:
    """Return places and edges where ends of lines that differ by rounding are one."""
    ends = np.flatnonzero(np.bincount(edges.ravel(), minlength=len(uv)) == 1)
    if len(ends) < 2:
        return uv, edges
    near = Delaunay(uv[ends], threads=1)
    size = near_tolerance(near) if tolerance is None else tolerance
    if size is None and not len(near.duplicates):
        return uv, edges
    return _identified(uv, edges, ends[merge(near, size or 0.0).merged])


def _within_ends(uv: FloatArray, edges: IntArray, plane: Plane) -> tuple[FloatArray, IntArray]:
    """Return what is between the ends of a section; what crosses one is cut there."""
    if plane.ends is None:
        return uv, edges
    for end, sign in zip(plane.ends, (1, -1), strict=True):
        place = (uv[:, 0] - end) * sign
        inside = place >= 0
        edges = edges[inside[edges].any(axis=1)]
        crossing = ~inside[edges].all(axis=1)
        ahead = inside[edges[crossing][:, :1]]
        near, far = np.where(ahead, edges[crossing], edges[crossing][:, ::-1]).T
        share = place[near] / (place[near] - place[far])
        new = uv[near] + share[:, None] * (uv[far] - uv[near])
        new[:, 0] = end
        cut = np.stack([near, len(uv) + np.arange(len(new))], axis=1)
        uv, edges = np.vstack([uv, new]), np.vstack([edges[~crossing], cut])
    kept, rows = np.unique(edges, return_inverse=True)
    return uv[kept], rows.reshape(-1, 2)
