"""The medial axis of samples (paper, §11: the anti-crust).

For a known smooth curve see `SmoothCurve.local_feature_size` in `crustline.shapes`.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.arrays import BoolArray, FloatArray, IntArray, as_floats
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay, as_delaunay
from crustline.errors import InputError, shown
from crustline.methods import as_selected
from crustline.points import Points
from crustline.records import Record
from crustline.scalars import as_choice, as_flag, as_length

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["MedialAxis", "medial_axis"]

#: How far `write` follows the axis beyond the points' bounding box, as a part of its longer side.
MARGIN = 0.25

Residual = Literal["arc", "chord"]


@dataclass(frozen=True, eq=False)
class MedialAxis(Record):
    """The medial axis of samples: Voronoi edges whose dual Delaunay edge is not selected.

    Attributes
    ----------
    vertices : ndarray of float64, shape (k, 2)
        The Voronoi vertices on it. Triangles on exactly one circle share one.
    edges : ndarray of int64, shape (m, 2)
        Rows of `vertices`: those to the left and to the right of the step from the first to the
        second of the samples that the edge separates.
    radii : ndarray of float64, shape (k,)
        The distance from each vertex to its nearest points, in their unit.
    samples : ndarray of int64, shape (m, 2)
        The two rows of the points that each edge separates, i < j, rows sorted.
    inner : ndarray of bool, shape (m,)
        Whether the edge is inside an odd number of rings.
    ray_origins : ndarray of int64, shape (s,)
        Rows of `vertices`: where each unbounded edge starts.
    ray_directions : ndarray of float64, shape (s, 2)
        Its unit direction.
    ray_samples : ndarray of int64, shape (s, 2)
        The two rows of the points that it separates, i < j, rows sorted. Rays are outside of all
        rings.
    points : Points
        The points, with all that they carry.
    selected : ndarray of int64, shape (e, 2)
        The edges of the curves: i < j in each row, rows sorted.
    """

    vertices: FloatArray
    edges: IntArray
    radii: FloatArray
    samples: IntArray
    inner: BoolArray
    ray_origins: IntArray
    ray_directions: FloatArray
    ray_samples: IntArray
    points: Points = field(repr=False)
    selected: IntArray = field(repr=False)

    def clipped(self, box: npt.ArrayLike, *, inner: bool | None = None) -> FloatArray:
        """Return the part in a box as segments, unbounded edges included.

        Parameters
        ----------
        box : array_like of float, shape (4,)
            Least x, least y, largest x, largest y.
        inner : bool, optional
            Only what is inside of the rings, or only what is outside; both by default.

        Returns
        -------
        segments : ndarray of float64, shape (s, 2, 2)
            Two ends each: edges in their order, then rays in theirs; those that miss the box are
            left out.

        Raises
        ------
        InputError
            If the box is not four finite numbers in this order.

        Examples
        --------
        >>> medial_axis([(0, 0), (2, 0), (0, 1), (2, 1)], []).clipped((0, 0, 1, 1)).tolist()
        [[[1.0, 0.5], [1.0, 0.0]], [[1.0, 0.5], [0.0, 0.5]], [[1.0, 0.5], [1.0, 1.0]]]
        """
        whole = np.concatenate([self.inner, np.zeros(len(self.ray_origins), bool)])
        wanted = np.ones(len(whole), bool) if inner is None else whole == as_flag("inner", inner)
        vertices, edges = self._clipped(_as_box(box), wanted)
        return vertices[edges]

    def _clipped(
        self, box: FloatArray, wanted: BoolArray | Literal[True] = True
    ) -> tuple[FloatArray, IntArray]:
        """Return the part in a box as vertices and edges; where it is cut, vertices are new."""
        first = np.concatenate([self.edges[:, 0], self.ray_origins])
        last = np.concatenate([self.edges[:, 1], np.full(len(self.ray_origins), -1)])
        start = self.vertices[first]
        step = np.concatenate(
            [self.vertices[self.edges[:, 1]] - start[: len(self.edges)], self.ray_directions]
        )
        enters, leaves = _passage(start, step, np.where(last < 0, np.inf, 1.0), box)
        seen = np.flatnonzero((enters < leaves) & wanted)
        ends = []
        vertices = [self.vertices]
        for t, own, whole in ((enters, first, 0.0), (leaves, last, 1.0)):
            cut = seen[(t[seen] != whole) | (own[seen] < 0)]
            row = own.copy()
            row[cut] = sum(map(len, vertices)) + np.arange(len(cut))
            vertices.append(np.clip(start[cut] + t[cut, None] * step[cut], box[:2], box[2:]))
            ends.append(row[seen])
        return _compact(np.concatenate(vertices), np.stack(ends, axis=1))

    def residuals(self, *, kind: Residual = "chord") -> tuple[FloatArray, FloatArray]:
        """Return what each edge and each ray stands for, in the unit of the points.

        Parameters
        ----------
        kind : {"chord", "arc"}
            "arc": the length of the curve between the two samples, the shorter way around a ring
            (Ogniewicz's potential residual [1]_). "chord": that less the distance of the two
            samples (his chord residual).

        Returns
        -------
        of_edges : ndarray of float64, shape (m,)
        of_rays : ndarray of float64, shape (s,)
            At least 0; infinite between samples of different curves.

        References
        ----------
        .. [1] R. L. Ogniewicz, O. Kübler, "Hierarchic Voronoi Skeletons", Pattern Recognition 28
           (1995), 343-359.
        """
        as_choice("kind", kind, ("arc", "chord"))
        return self._residual(self.samples, kind), self._residual(self.ray_samples, kind)

    def _residual(self, samples: IntArray, kind: Residual) -> FloatArray:
        number, position, around = self._along
        i, j = samples.T
        arc = np.abs(position[j] - position[i])
        arc = np.minimum(arc, np.abs(around[i] - arc))
        if kind == "chord":
            step = self.points[j] - self.points[i]
            arc = np.maximum(arc - np.hypot(step[:, 0], step[:, 1]), 0.0)
        same = (number[i] == number[j]) & (number[i] >= 0)
        return np.where(same, arc, np.inf)

    @cached_property
    def _along(self) -> tuple[IntArray, FloatArray, FloatArray]:
        """Return for each point its curve (or -1), its place along it, and the length around it."""
        curves = trace(self.points, self.selected)
        xy = self.points[curves.indices]
        step = np.diff(xy, axis=0, prepend=xy[:1])
        run = np.cumsum(np.hypot(step[:, 0], step[:, 1]))
        counts = np.diff(curves.offsets)
        run -= np.repeat(run[curves.offsets[:-1]], counts)
        number = np.full(len(self.points), -1)
        position, around = np.zeros(len(self.points)), np.full(len(self.points), np.inf)
        number[curves.indices] = np.repeat(np.arange(len(curves)), counts)
        position[curves.indices] = run
        around[curves.indices] = np.repeat(np.where(curves.closed, curves.lengths, np.inf), counts)
        # A branch is on several curves, so it stands for none of them.
        number[curves.branches] = -1
        return number, position, around

    def prune(self, at_least: float = 0.0, *, kind: Residual = "chord") -> MedialAxis:
        """Return the axis without the edges and rays that stand for little of the curve.

        Parameters
        ----------
        at_least : float, default 0
            Keep what has a residual of at least this, in the unit of the points. The default
            removes nothing, at any scale.
        kind : {"chord", "arc"}
            See `residuals`.

        Returns
        -------
        medial_axis : MedialAxis
            Vertices that no edge or ray touches any more are gone; the order is kept.

        Notes
        -----
        Edges between different curves are never removed. On a tree-like axis the residual grows
        from the tips inwards, so what remains stays connected.

        Examples
        --------
        >>> axis = medial_axis([(0, 0), (4, 0), (4, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (0, 3)])
        >>> axis.prune() is not axis, len(axis.prune().edges), len(axis.prune(100.0).edges)
        (True, 0, 0)
        """
        at_least = as_length("at_least", at_least)
        of_edges, of_rays = self.residuals(kind=kind)
        kept, rays = of_edges >= at_least, of_rays >= at_least
        used = np.zeros(len(self.vertices), bool)
        used[self.edges[kept].ravel()] = True
        used[self.ray_origins[rays]] = True
        row = np.cumsum(used) - 1
        return replace(
            self,
            vertices=self.vertices[used],
            radii=self.radii[used],
            edges=row[self.edges[kept]],
            samples=self.samples[kept],
            inner=self.inner[kept],
            ray_origins=row[self.ray_origins[rays]],
            ray_directions=self.ray_directions[rays],
            ray_samples=self.ray_samples[rays],
        )

    def part(self, where: Literal["inner", "outer"]) -> MedialAxis:
        """Return only the edges within the rings, or only those, and the rays, without.

        Parameters
        ----------
        where : {"inner", "outer"}

        Returns
        -------
        medial_axis : MedialAxis
            The vertices are all kept.

        Examples
        --------
        >>> axis = medial_axis([(0, 0), (2, 0), (0, 1), (2, 1)], [])
        >>> len(axis.part("outer").ray_origins), len(axis.part("inner").ray_origins)
        (4, 0)
        """
        inner = as_choice("where", where, ("inner", "outer")) == "inner"
        kept = self.inner == inner
        chosen: dict[str, Any] = {
            name: getattr(self, name)[kept] for name in ("edges", "samples", "inner")
        }
        if inner:
            rays = ("ray_origins", "ray_directions", "ray_samples")
            chosen |= {name: getattr(self, name)[:0] for name in rays}
        return replace(self, **chosen)

    def curves(self, box: npt.ArrayLike | None = None) -> Curves:
        """Return the axis in a box, traced: polylines between its ends and branches, and rings.

        Parameters
        ----------
        box : array_like of float, shape (4,), optional
            Least x, least y, largest x, largest y. By default that of the points and a quarter of
            its longer side beyond.

        Returns
        -------
        curves : Curves
            Of points of their own: the vertices, and where the box cuts the axis.
        """
        vertices, edges = self._clipped(self._box() if box is None else _as_box(box))
        return trace(Points(vertices, crs=self.points.crs), edges)

    def write(
        self,
        path: str | os.PathLike[str],
        *,
        format: str | None = None,
        box: npt.ArrayLike | None = None,
    ) -> None:
        """Write the axis to a file as polylines, in any format that curves can be written in.

        Parameters
        ----------
        path : path-like
            The file: see `crustline.write`.
        format : str, optional
            By default the suffix decides.
        box : array_like of float, shape (4,), optional
            See `curves`. The part beyond is cut off: unbounded edges end there.
        """
        from crustline.formats import write

        write(self.curves(box), path, format=format)

    def _box(self) -> FloatArray:
        if not len(self.points):
            return np.array([0.0, 0.0, 1.0, 1.0])
        low, high = self.points.xy.min(axis=0), self.points.xy.max(axis=0)
        margin = MARGIN * float((high - low).max()) or 1.0
        return np.concatenate([low - margin, high + margin])

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the axis with matplotlib; see `crustline.plot.plot_medial_axis`."""
        from crustline.plot import plot_medial_axis

        return plot_medial_axis(self, ax, **options)

    def _repr_svg_(self) -> str:
        """Return the picture that notebooks show: the axis in its box."""
        return self.curves()._repr_svg_()

    def __repr__(self) -> str:
        inner = int(np.count_nonzero(self.inner))
        return (
            f"<MedialAxis: {len(self.vertices)} vertices; "
            f"{inner} inner and {len(self.edges) - inner} outer edges, "
            f"{len(self.ray_origins)} rays>"
        )


def medial_axis(points: npt.ArrayLike | Delaunay, edges: npt.ArrayLike | None = None) -> MedialAxis:
    """Return the medial axis of samples: Voronoi edges whose dual Delaunay edge is not selected.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    edges : array_like of int, shape (m, 2), optional
        The curves' edges, as rows of the points; by default the crust.

    Returns
    -------
    medial_axis : MedialAxis
        Edges sorted by the samples that they separate.

    Raises
    ------
    InputError
        If the points or edges do not fit; the message names the first row at fault.

    Notes
    -----
    Which edges there are is exact. Voronoi edges of length zero, between triangles on exactly one
    circle, are left out, and those triangles have one vertex. `inner` is decided without
    coordinates: by a flood over the triangles that starts outside and flips where it crosses a
    ring. Rings are the closed curves of `crustline.trace`; polylines do not separate, not even
    where several of them enclose a region between branches, nor does a ring with an edge that is
    not in the triangulation. Vertices are good to 1e-7 of their distance from the nearest points.
    Where all points lie on one line, an edge that is not selected is separated
    by two opposite rays from its midpoint.

    For an r-sample the axis tends to that of the curve; its inner ends stop short of the tips by
    about the distance of samples squared. O(n log n) time, O(n) after the triangulation but for the
    sort of the edges.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135. Section 11, Figure
       15.

    Examples
    --------
    >>> points = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (2, 1), (1, 1), (0, 1)]
    >>> axis = medial_axis(points, [(i, (i + 1) % 8) for i in range(8)])
    >>> axis
    <MedialAxis: 3 vertices; 2 inner and 0 outer edges, 0 rays>
    >>> axis.vertices[axis.edges].tolist()
    [[[0.5, 0.5], [1.5, 0.5]], [[1.5, 0.5], [2.5, 0.5]]]
    """
    delaunay = as_delaunay(points)
    selected = as_selected(delaunay, edges)
    fields = delaunay.run(_core.medial_axis, delaunay.along(selected))
    return MedialAxis(**fields, points=delaunay.points, selected=selected)


def _as_box(box: npt.ArrayLike) -> FloatArray:
    array = as_floats("box", box)
    if array.shape != (4,) or not np.isfinite(array).all() or (array[:2] > array[2:]).any():
        raise InputError(
            f"box: {shown(box)} is not least x, least y, largest x, largest y: "
            "pass four finite numbers"
        )
    return array


def _passage(
    start: FloatArray, step: FloatArray, end: FloatArray, box: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the t in [0, end] at which start + t·step enters and leaves a box (Liang, Barsky)."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        one, other = (box[:2] - start) / step, (box[2:] - start) / step
    within = (box[:2] <= start) & (start <= box[2:])
    still = step == 0
    low = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(one, other))
    high = np.where(still, np.inf, np.maximum(one, other))
    return np.maximum(low.max(axis=1), 0.0), np.minimum(high.min(axis=1), end)


def _compact(vertices: FloatArray, edges: IntArray) -> tuple[FloatArray, IntArray]:
    """Return the vertices that edges use, and the edges as rows of these."""
    used, rows = np.unique(edges, return_inverse=True)
    return vertices[used], rows.reshape(edges.shape)
