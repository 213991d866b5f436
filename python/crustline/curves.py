"""Curves: edges traced into ordered rings and polylines, and rings nested into polygons."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray, as_edges, read_only
from crustline.delaunay import Delaunay, points_and_how
from crustline.orientation import arranged, starts_of, turns_of
from crustline.points import Points
from crustline.projection import is_geographic, project, stereographic
from crustline.records import Record
from crustline.scalars import as_flag

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class Curve(Record):
    """One ring or polyline, as rows of the points.

    Attributes
    ----------
    indices : ndarray of int64, shape (k,)
        Rows of the points, in order along the curve. A ring does not repeat its first index.
    closed : bool
        Whether the last point is joined to the first.
    points : ndarray of float64, shape (k, 2)
        The coordinates of these rows.
    """

    indices: IntArray
    closed: bool
    points: FloatArray

    @property
    def length(self) -> float:
        """The sum of the lengths of the edges, in the unit of the points; float64 accuracy."""
        steps = np.diff(self.points, axis=0)
        if self.closed:
            steps = np.concatenate([steps, self.points[:1] - self.points[-1:]])
        return float(np.hypot(steps[:, 0], steps[:, 1]).sum())

    def __len__(self) -> int:
        return len(self.indices)

    def __repr__(self) -> str:
        return f"<Curve: {'ring' if self.closed else 'polyline'} of {len(self)} points>"


@dataclass(frozen=True, eq=False)
class Polygon(Record):
    """A ring and the rings that are holes in it.

    Attributes
    ----------
    shell : ndarray of int64, shape (k,)
        Rows of the points around the outside, counter-clockwise; the first is not repeated.
    holes : tuple of ndarray of int64
        Rows around each hole, counter-clockwise, too, as `Curves` holds them.
    """

    shell: IntArray
    holes: tuple[IntArray, ...] = ()

    def __repr__(self) -> str:
        return f"<Polygon: {len(self.shell)} points, {len(self.holes)} holes>"


@dataclass(frozen=True, eq=False)
class Feature(Record):
    """What a file or a picture holds of curves as one thing: see `Curves.features`.

    Attributes
    ----------
    number : int or None
        The features of curves are counted from 0; None for the isolated points.
    kind : {"polygon", "line", "points"}
        Whether `parts` are the rings of a polygon, one ring or polyline, or isolated points.
    parts : tuple of ndarray of int64
        Rows of the points. A polygon's first part is its outside, counter-clockwise; the others are
        its holes, clockwise; unless curves were `oriented` otherwise.
    closed : bool
        Whether the last row of each part is joined to its first.
    """

    number: int | None
    kind: Literal["polygon", "line", "points"]
    parts: tuple[IntArray, ...]
    closed: bool

    @property
    def runs(self) -> list[IntArray]:
        """The rows of each part, with its first row once more at the end if it is closed."""
        return [np.append(part, part[:1]) if self.closed else part for part in self.parts]

    @property
    def rows(self) -> IntArray:
        """The rows of all parts, one after another."""
        return np.concatenate(self.parts)


@dataclass(frozen=True, eq=False)
class Curves(Record, Sequence[Curve]):
    """Rings and polylines as ragged rows of points; a sequence of `Curve`.

    Rings start at their smallest index and run counter-clockwise, polylines start at their end of
    smaller index, and curves are sorted by their first index, until `oriented` says otherwise.
    Every edge is in exactly one curve.

    Attributes
    ----------
    points : Points
        The points that were traced, with all that they carry.
    indices : ndarray of int64, shape (k,)
        Rows of the points, curve after curve.
    offsets : ndarray of int64, shape (c + 1,)
        Curve number i is ``indices[offsets[i]:offsets[i + 1]]``.
    closed : ndarray of bool, shape (c,)
        Whether each curve is a ring.
    isolated : ndarray of int64, shape (s,)
        Rows of the points that no edge touches, sorted.
    orient : {"ccw", "cw", "rfc7946", "gis"}, optional
        The rule that rings were oriented by; None is as `trace` left them.
    confidence : ndarray of float64, shape (m,), optional
        How likely each of `edges` is right, if that is known: see `Connection.curves`.
    shells : ndarray of int64, shape (c,), optional
        For each ring its shell, itself if it is one, and -1 for a polyline, where that was decided
        elsewhere than in x and y: in the plane of a slice. By default the points decide.

    Examples
    --------
    >>> curves = trace([(0, 0), (1, 0), (1, 1), (0, 1), (5, 5)], [(0, 1), (1, 2), (2, 3), (0, 3)])
    >>> curves
    <Curves: 1 ring, 0 polylines, 1 isolated point; 5 points>
    >>> curves[0].indices.tolist(), curves[0].length
    ([0, 1, 2, 3], 4.0)
    """

    points: Points
    indices: IntArray
    offsets: IntArray
    closed: BoolArray
    isolated: IntArray
    orient: str | None = None
    confidence: FloatArray | None = None
    shells: IntArray | None = None

    def __len__(self) -> int:
        return len(self.closed)

    @overload
    def __getitem__(self, key: int) -> Curve: ...
    @overload
    def __getitem__(self, key: slice) -> list[Curve]: ...
    def __getitem__(self, key: int | slice) -> Curve | list[Curve]:
        if isinstance(key, slice):
            return [self._curve(number) for number in range(len(self))[key]]
        return self._curve(range(len(self))[key])

    def __iter__(self) -> Iterator[Curve]:
        return map(self._curve, range(len(self)))

    def _curve(self, number: int) -> Curve:
        indices = self.indices[self.offsets[number] : self.offsets[number + 1]]
        return Curve(indices, bool(self.closed[number]), self.points.xy[indices])

    @cached_property
    def _steps(self) -> tuple[IntArray, IntArray, IntArray]:
        """Return for every edge the positions in `indices` of its ends, and its curve."""
        ends = np.arange(1, len(self.indices) + 1)
        ends[self.offsets[1:] - 1] = np.where(self.closed, self.offsets[:-1], -1)
        starts = np.flatnonzero(ends >= 0)
        numbers = np.repeat(np.arange(len(self)), np.diff(self.offsets))
        return starts, ends[starts], numbers[starts]

    @cached_property
    def edges(self) -> IntArray:
        """The edges that were traced, shape (m, 2): i < j in each row, rows sorted."""
        starts, ends, _ = self._steps
        pairs = np.stack([self.indices[starts], self.indices[ends]], axis=1)
        return read_only(as_edges(pairs, len(self.points)))

    @cached_property
    def lengths(self) -> FloatArray:
        """The length of every curve, shape (c,), in the unit of the points; float64 accuracy."""
        starts, ends, numbers = self._steps
        steps = self.points.xy[self.indices[ends]] - self.points.xy[self.indices[starts]]
        lengths = np.hypot(steps[:, 0], steps[:, 1])
        return read_only(np.bincount(numbers, weights=lengths, minlength=len(self)))

    @cached_property
    def _degrees(self) -> IntArray:
        return np.bincount(self.edges.ravel(), minlength=len(self.points))

    @property
    def endpoints(self) -> IntArray:
        """Rows of the points with exactly one edge, sorted."""
        return np.flatnonzero(self._degrees == 1)

    @property
    def branches(self) -> IntArray:
        """Rows of the points with three or more edges, sorted."""
        return np.flatnonzero(self._degrees >= 3)

    def polygons(self) -> list[Polygon]:
        """Return the rings as polygons, nested by even-odd containment.

        A ring inside an even number of other rings is a shell, one inside an odd number is a hole
        of the innermost shell around it; an island in a lake is a shell again. Polylines are left
        out.

        Returns
        -------
        polygons : list of Polygon
            In the order of their shells in the curves; holes, too, are in the order of the curves.

        Notes
        -----
        Exact where edges meet at points only, as those of every method do: a ring lies in another
        if a point of its own does, which is decided by signs without rounding. Rings that cross
        each other have no nesting: there a ring counts as inside if its first point off the others
        is, and a hole without a shell around it becomes a shell. If the CRS of the points is one of
        longitudes and latitudes and an edge crosses the 180th meridian, rings are nested on the
        stereographic map about the middle of the points, in floating point. Linear time, and that
        of the edges that a ray from each ring crosses.
        """
        shells = self._shells.tolist()
        holes: dict[int, list[IntArray]] = {k: [] for k, shell in enumerate(shells) if shell == k}
        for number, shell in enumerate(shells):
            if shell not in (-1, number):
                holes[shell].append(self._curve(number).indices)
        return [Polygon(self._curve(k).indices, tuple(each)) for k, each in holes.items()]

    @cached_property
    def _shells(self) -> IntArray:
        """For each ring its shell, itself if it is one; -1 for a polyline."""
        if self.shells is not None:
            return self.shells
        xy = self.points.xy
        across = np.abs(np.diff(xy[self.edges, 0], axis=1)) > 180
        if across.any() and is_geographic(self.points):
            xy = np.ascontiguousarray(stereographic(xy))
        shells: IntArray = _core.shells(xy, self.indices, self.offsets, self.closed)
        return shells

    def oriented(
        self, orient: str | None = None, *, start: Any = None, crs: str | None = None
    ) -> Curves:
        """Return the same curves in other directions, or from other points on.

        Parameters
        ----------
        orient : {"ccw", "cw", "rfc7946", "gis"}, optional
            "ccw" and "cw": all rings counter-clockwise, or clockwise. "rfc7946": as GeoJSON and
            Simple Features ask for, shells counter-clockwise and holes clockwise. "gis": as in
            Shapefiles, the other way round. By default directions are left as they are.
        start : pair of float, int, or {"west", "east", "south", "north"}, optional
            Each ring starts at its point that is nearest to a place (x, y), or farthest in a
            direction, and each polyline at such an end; or the ring of a row starts there, and a
            polyline that ends there. Of equal points the smallest row is taken. By default starts
            are left as they are.
        crs : str, optional
            Where directions are decided, as for `crustline.project`, such as "auto": longitudes
            and latitudes across the 180th meridian, or around a pole, have none of their own.

        Returns
        -------
        curves : Curves
            In the same order. Every writer writes them as they run.

        Raises
        ------
        InputError
            If the rule or the start is none of these, or no ring or end has the row.

        Notes
        -----
        Exact, as `trace` and `polygons` are. Linear time, and that of the nesting if the rule tells
        holes from shells.

        Examples
        --------
        >>> curves = trace([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (0, 3)])
        >>> curves.oriented("cw", start=(1, 1))[0].indices.tolist()
        [2, 1, 0, 3]
        """
        if crs is not None:
            on_map = trace(project(self.points, crs), self.edges).oriented(orient)
            kept = replace(on_map, points=self.points, isolated=self.isolated)
            return kept.oriented(start=start)
        rule = self.orient if orient is None else orient
        turned = turns_of(rule, self._shells) != turns_of(self.orient, self._shells)
        starts = np.zeros(len(self), dtype=np.int64)
        if start is not None:
            starts = starts_of(start, self.points.xy, self.indices, self.offsets, self.closed)
        backwards = np.where(self.closed, turned, starts > 0)
        indices = arranged(self.indices, self.offsets, starts, backwards)
        return replace(self, indices=indices, orient=rule)

    def features(self, *, polygons: bool = False) -> Iterator[Feature]:
        """Yield polygons, if they are asked for, then the other curves, then the isolated points.

        Parameters
        ----------
        polygons : bool, default False
            Whether rings are joined to polygons with holes; else each is a line of its own.

        Yields
        ------
        feature : Feature
            Each curve is in one of them, and so is each isolated point.

        Examples
        --------
        >>> curves = trace([(0, 0), (1, 0), (0, 1), (5, 5)], [(0, 1), (1, 2), (0, 2)])
        >>> [(each.number, each.kind, each.closed) for each in curves.features(polygons=True)]
        [(0, 'polygon', True), (None, 'points', False)]
        """
        number, polygons = 0, as_flag("polygons", polygons)
        for polygon in self.polygons() if polygons else []:
            holes = polygon.holes
            if self.orient is None:
                holes = tuple(np.append(hole[:1], hole[:0:-1]) for hole in holes)
            yield Feature(number, "polygon", (polygon.shell, *holes), True)
            number += 1
        for curve in self:
            if not (polygons and curve.closed):
                yield Feature(number, "line", (curve.indices,), curve.closed)
                number += 1
        if len(self.isolated):
            yield Feature(None, "points", (self.isolated,), False)

    def normals(self) -> FloatArray:
        """Return the outward normal at each sample.

        Returns
        -------
        normals : ndarray of float64, shape (n, 2)
            Of length 1. Along a ring away from the polygon that it bounds: out of a shell, into a
            hole. Along a polyline to the right of its direction. NaN at isolated points, at
            branches, and where neighbors coincide.

        Notes
        -----
        That of the circle through a sample and its two neighbors; at the end of a polyline through
        the last three. Exact on circles and lines but for rounding. O(n) time.

        Examples
        --------
        >>> square = trace([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (0, 3)])
        >>> (square.normals()[0] * 2**0.5).round(6).tolist()
        [-1.0, -1.0]
        """
        normals = np.full((len(self.points), 2), np.nan)
        holes = {int(hole[0]) for polygon in self.polygons() for hole in polygon.holes}
        branches = self.branches
        for curve in self:
            tangents = _tangents(curve.points, curve.closed)
            right = np.stack([tangents[:, 1], -tangents[:, 0]], axis=1)
            is_hole = curve.closed and int(curve.indices[0]) in holes
            normals[curve.indices] = -right if is_hole else right
        normals[branches] = np.nan
        return read_only(normals)

    def write(
        self, path: str | PathLike[str], *, format: str | None = None, **options: Any
    ) -> None:
        """Write the curves to a file: see `crustline.write`, which says what each format holds."""
        from crustline.formats import write

        write(self, path, format=format, **options)

    def to_shapely(self, *, polygons: bool = False) -> list[Any]:
        """Return shapely geometries: lines and rings, or polygons, then the isolated points.

        Parameters
        ----------
        polygons : bool, default False
            Whether rings are joined to polygons with holes; else each is a closed LineString.

        Returns
        -------
        geometries : list of shapely geometries
            In the order of `features`; with heights if the points have them. Isolated points are
            one MultiPoint at the end.

        Examples
        --------
        >>> curves = trace([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (0, 2)])
        >>> curves.to_shapely(polygons=True)[0].area
        0.5
        """
        from crustline.formats.objects import to_shapely

        return to_shapely(self, polygons)

    def to_geopandas(self, *, polygons: bool = False) -> Any:
        """Return a GeoDataFrame: a row a feature, with curve, closed, length, rows and geometry.

        Parameters
        ----------
        polygons : bool, default False
            As for `to_shapely`.

        Notes
        -----
        `rows` are those of the points. A column of the points that is the same all along each curve
        is kept; of others numbers become NAME_min, NAME_mean and NAME_max, and texts are joined.
        The CRS is that of the points.
        """
        from crustline.formats.objects import to_geopandas

        return to_geopandas(self, polygons)

    def to_networkx(self) -> Any:
        """Return a networkx Graph: a node a row of the points, and the edges with their length."""
        from crustline.formats.objects import to_networkx

        return to_networkx(self)

    def to_scipy(self) -> Any:
        """Return the adjacency as a symmetric scipy sparse array (n, n) of the edges' lengths."""
        from crustline.formats.objects import to_scipy

        return to_scipy(self)

    def to_pyvista(self) -> Any:
        """Return a pyvista PolyData of the points, with a line a curve."""
        from crustline.formats.objects import to_pyvista

        return to_pyvista(self)

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The curves as a GeoJSON FeatureCollection, for libraries that take such objects."""
        from crustline.formats.objects import geo_interface

        return geo_interface(self)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the curves with matplotlib; see `crustline.plot.plot_curves`."""
        from crustline.plot import plot_curves

        return plot_curves(self, ax, **options)

    def edit(self, **options: Any) -> Any:
        """Return a widget that shows the points and their curves, to draw and drag in a notebook.

        See `crustline.editor.widget`, which takes the options.
        """
        from crustline.editor import widget

        return widget(self.points, **options)

    def _repr_svg_(self) -> str:
        """Return the picture that notebooks show."""
        from crustline.formats.svg import picture_of_curves

        return picture_of_curves(self)

    def __repr__(self) -> str:
        rings = int(np.count_nonzero(self.closed))
        counts = [(rings, "ring"), (len(self) - rings, "polyline")]
        counts.append((len(self.isolated), "isolated point"))
        words = ", ".join(f"{count} {word}{'s' * (count != 1)}" for count, word in counts)
        return f"<Curves: {words}; {len(self.points)} points>"


def _tangents(xy: FloatArray, closed: bool) -> FloatArray:
    """Return the unit tangents of the circles through successive points."""
    ends = np.roll(xy, -1, axis=0) - xy if closed else np.diff(xy, axis=0)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        lengths = np.hypot(ends[:, 0], ends[:, 1])[:, None]
        units = ends / lengths
        # Each chord turns from the tangent by an angle that grows with its length.
        before, after = (np.roll(units, 1, axis=0), units) if closed else (units[:-1], units[1:])
        first, last = (
            (np.roll(lengths, 1, axis=0), lengths) if closed else (lengths[:-1], lengths[1:])
        )
        inner = before * last + after * first
        inner /= np.hypot(inner[:, 0], inner[:, 1])[:, None]
        if closed:
            return inner
        if not len(inner):
            return np.concatenate([units, units])
        # At an end, the tangent at the next point mirrored in the chord.
        start, stop = (2 * (inner[k] @ units[k]) * units[k] - inner[k] for k in (0, -1))
        return np.concatenate([[start], inner, [stop]])


def trace(points: npt.ArrayLike | Delaunay, edges: npt.ArrayLike) -> Curves:
    """Return edges traced into curves: rings and polylines, split at branches.

    A curve runs through points of degree 2 and ends at points of any other degree; a loop based at
    one branch, and a cycle without branches, are rings.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. What points carry is kept.
    edges : array_like of int, shape (m, 2)
        Rows of `points`, in any order and direction; a repeated edge counts once.

    Returns
    -------
    curves : Curves
        Every edge is in exactly one curve. Rings start at their smallest index and run
        counter-clockwise, polylines start at their end of smaller index; sorted by first index.

    Raises
    ------
    InputError
        If points or edges do not fit; the message names the first row at fault.

    Notes
    -----
    Exact: the direction of a ring is the sign of its area without rounding. O(n + m log m) time.

    Examples
    --------
    >>> curves = trace([(0, 0), (1, 0), (2, 0), (9, 9)], [(2, 1), (0, 1)])
    >>> curves[0].indices.tolist(), curves[0].closed, curves.isolated.tolist()
    ([0, 1, 2], False, [3])
    """
    kept, how = points_and_how(points)
    return Curves(kept, *_core.trace(kept.xy, as_edges(edges, len(kept), kept=False), *how))
