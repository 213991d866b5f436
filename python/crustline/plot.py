"""Pictures of points, triangulations, curves, medial axes and certificates, with matplotlib.

Each `plot_…` function draws into the Axes given, or into those of a new Figure that belongs to no
window, and returns the Axes: ``plot_curves(curves).figure.savefig("curves.svg")``. The colors are
those of Okabe and Ito [1]_, which the color-blind can tell apart.

References
----------
.. [1] M. Okabe, K. Ito, "Color Universal Design", 2008, https://jfly.uni-koeln.de/color/.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.arrays import FloatArray, IntArray, as_points
from crustline.errors import InputError, missing_extra

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crustline.certify import Certificate
    from crustline.curves import Curves
    from crustline.delaunay import Delaunay
    from crustline.medial import MedialAxis

__all__ = [
    "LAYERS",
    "picture",
    "plot_certificate",
    "plot_curves",
    "plot_delaunay",
    "plot_edges",
    "plot_indices",
    "plot_local_feature_size",
    "plot_medial_axis",
    "plot_points",
    "plot_voronoi",
]

BLACK, GRAY = "#000000", "#9a9a9a"
ORANGE, SKY, GREEN = "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILLION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"

#: More labels than this hide each other, and take minutes.
MOST_LABELS = 5_000
#: From this many points on, lines are drawn above them.
CROWD = 20_000
#: Agg gives up on one path with too many crossings; many short paths cost no more.
CHUNK = 10_000
#: Reasons of a certificate, each with a marker that tells them apart without color.
MARKERS = {"undersampled": "o", "endpoint": "s", "branch": "^", "corner": "D", "isolated": "X"}


# --- Points -------------------------------------------------------------------------------------


def plot_points(
    points: ArrayLike,
    ax: Axes | None = None,
    *,
    color: str = BLACK,
    size: float | None = None,
    indices: bool = False,
) -> Axes:
    """Draw points as dots.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    size : float, optional
        Diameter of a dot in typographic points; by default smaller the more points there are.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    InputError
        If the points are not (n, 2) or not finite, or too many to be labeled.

    Examples
    --------
    >>> ax = plot_points([(0, 0), (1, 0), (1, 1)])
    >>> len(ax.lines)
    1
    """
    xy = as_points(points)
    ax = _axes(ax, xy)
    diameter = _dot_size(len(xy)) if size is None else size
    # A crowd of dots would hide the curve through them.
    order = 4 if len(xy) < CROWD else 1.5
    ax.plot(*xy.T, "o", color=color, markersize=diameter, markeredgewidth=0, zorder=order)
    return plot_indices(xy, ax) if indices else ax


def plot_indices(points: ArrayLike, ax: Axes | None = None, *, color: str = BLACK) -> Axes:
    """Write its row beside each point.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates; at most 5000.
    ax : Axes, optional
        Where to write; new Axes if not given.
    color : str
        Any color of matplotlib.

    Returns
    -------
    ax : Axes

    Raises
    ------
    InputError
        If there are more than 5000 points.

    Examples
    --------
    >>> [text.get_text() for text in plot_indices([(0, 0), (1, 0)]).texts]
    ['0', '1']
    """
    xy = as_points(points)
    if len(xy) > MOST_LABELS:
        raise InputError(
            f"the labels of {len(xy)} points would hide each other: "
            f"label at most {MOST_LABELS}, for instance a part of them"
        )
    ax = _axes(ax, xy)
    for row, place in enumerate(xy):
        ax.annotate(
            str(row), place, (2.5, 2.5), textcoords="offset points", size=6, color=color, zorder=6
        )
    return ax


def plot_local_feature_size(points: ArrayLike, sizes: ArrayLike, ax: Axes | None = None) -> Axes:
    """Draw points in colors that tell their local feature size, on a logarithmic scale.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    sizes : array_like of float, shape (n,)
        What `local_feature_size` gives. Points with none (NaN, infinite, 0) are gray.
    ax : Axes, optional
        Where to draw; new Axes if not given.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> ax = plot_local_feature_size([(0, 0), (1, 0)], [0.1, 10.0])
    """
    xy, lfs = as_points(points), np.asarray(sizes, np.float64)
    ax = _axes(ax, xy)
    from matplotlib.colors import LogNorm

    known = np.isfinite(lfs) & (lfs > 0)
    area = (1.6 * _dot_size(len(xy))) ** 2
    x, y = xy.T
    ax.scatter(x[~known], y[~known], area, GRAY, linewidths=0, zorder=3)
    if not known.any():
        return ax
    scale = LogNorm(*_open_range(lfs[known]))
    dots = ax.scatter(
        x[known], y[known], area, lfs[known], norm=scale, cmap="viridis", linewidths=0, zorder=3
    )
    figure: Any = ax.get_figure(root=True)
    bar = figure.colorbar(dots, ax=ax, shrink=0.7)
    bar.set_label("local feature size", size=8)
    for which in ("major", "minor"):
        bar.ax.tick_params(which=which, labelsize=7)
    bar.outline.set_visible(False)
    return ax


# --- Edges and curves ---------------------------------------------------------------------------


def plot_edges(
    points: ArrayLike,
    edges: ArrayLike,
    ax: Axes | None = None,
    *,
    color: str = BLUE,
    width: float = 1.8,
    label: str | None = None,
) -> Axes:
    """Draw edges as segments. A million of them take seconds.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    edges : array_like of int, shape (m, 2)
        Rows of `points`.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    width : float, default 1.8
        In typographic points.
    label : str, optional
        Name in the legend.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> ax = plot_edges([(0, 0), (1, 0), (1, 1)], [(0, 1), (1, 2)])
    """
    xy = as_points(points)
    ax = _axes(ax, xy)
    segments = xy[np.asarray(edges, np.int64).reshape(-1, 2)]
    return _draw_segments(ax, segments, color, width, label=label, zorder=3)


def plot_curves(
    curves: Curves, ax: Axes | None = None, *, points: bool = True, indices: bool = False
) -> Axes:
    """Draw curves: rings blue, polylines vermillion, points that no edge touches as open circles.

    Parameters
    ----------
    curves : Curves
        What `trace` or `reconstruct` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    points : bool, default True
        Whether to draw the points, too.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import reconstruct
    >>> ax = plot_curves(reconstruct([(0, 0), (1, 0), (1, 1), (0, 1)]))
    """
    xy = as_points(curves.points)
    ax = _axes(ax, xy)
    for closed, color, label in ((True, BLUE, "ring"), (False, VERMILLION, "polyline")):
        vertices, starts = _walks(curves, xy, closed)
        # A name is worth its place in the legend where there are both kinds.
        named = (
            label if closed not in curves.closed or not np.all(curves.closed == closed) else None
        )
        _stroke(ax, vertices, starts, color, 1.8, label=named, zorder=3)
    if points:
        plot_points(xy, ax)
    _mark(ax, xy[curves.isolated], "o", GRAY, "isolated point")
    return plot_indices(xy, ax) if indices else ax


def _walks(curves: Curves, xy: FloatArray, closed: bool) -> tuple[FloatArray, IntArray]:
    """Return the vertices of all rings (the first repeated) or all polylines, and their starts."""
    chosen = np.flatnonzero(np.asarray(curves.closed) == closed)
    first, end = curves.offsets[chosen], curves.offsets[chosen + 1]
    counts = end - first + closed
    starts = np.cumsum(counts) - counts
    steps = np.arange(counts.sum()) - np.repeat(starts, counts)
    steps %= np.repeat(end - first, counts)
    return xy[curves.indices[np.repeat(first, counts) + steps]], starts


# --- Delaunay triangulation and Voronoi diagram -------------------------------------------------


def plot_delaunay(
    delaunay: Delaunay,
    ax: Axes | None = None,
    *,
    color: str = GRAY,
    points: bool = True,
    indices: bool = False,
) -> Axes:
    """Draw the edges of a Delaunay triangulation.

    Parameters
    ----------
    delaunay : Delaunay
        The triangulation.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    points : bool, default True
        Whether to draw the points, too.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import Delaunay
    >>> ax = plot_delaunay(Delaunay([(0, 0), (1, 0), (1, 1)]))
    """
    xy = as_points(delaunay.points)
    ax = _axes(ax, xy)
    _draw_segments(ax, xy[delaunay.edges], color, 0.5, label="Delaunay", zorder=1)
    if points:
        plot_points(xy, ax)
    return plot_indices(xy, ax) if indices else ax


def plot_voronoi(
    delaunay: Delaunay, ax: Axes | None = None, *, color: str = ORANGE, points: bool = True
) -> Axes:
    """Draw the Voronoi diagram that is dual to a Delaunay triangulation.

    Parameters
    ----------
    delaunay : Delaunay
        The triangulation.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    color : str
        Any color of matplotlib.
    points : bool, default True
        Whether to draw the points, too.

    Returns
    -------
    ax : Axes

    Notes
    -----
    Cut at three times the extent of the points; the unbounded edges reach that far.

    Examples
    --------
    >>> from crustline import Delaunay
    >>> ax = plot_voronoi(Delaunay([(0, 0), (1, 0), (1, 1)]))
    """
    xy = as_points(delaunay.points)
    ax = _axes(ax, xy)
    box = _box(xy)
    _draw_segments(ax, _clipped(_voronoi(delaunay, xy, box), box), color, 0.7, label="Voronoi")
    return plot_points(xy, ax) if points else ax


def _voronoi(delaunay: Delaunay, xy: FloatArray, box: FloatArray) -> FloatArray:
    """Return the Voronoi edges as segments, the unbounded ones long enough to leave the box."""
    if not len(delaunay.triangles):
        p, q = xy[delaunay.edges].transpose(1, 0, 2)
        middle, across = (p + q) / 2, np.stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0]], 1)
        return np.concatenate([_rays(middle, across, box), _rays(middle, -across, box)])
    twins = np.asarray(delaunay.halfedges)
    centers = np.asarray(delaunay.circumcenters)
    e = np.arange(len(twins))
    inner = np.flatnonzero(e < twins)
    finite = centers[np.stack([inner // 3, twins[inner] // 3], 1)]
    outer = np.flatnonzero(twins < 0)
    p = xy[delaunay.triangles.ravel()[outer]]
    q = xy[delaunay.triangles[outer // 3, (outer + 1) % 3]]
    outward = np.stack([q[:, 1] - p[:, 1], p[:, 0] - q[:, 0]], 1)
    return np.concatenate([finite, _rays(centers[outer // 3], outward, box)])


# --- Medial axis --------------------------------------------------------------------------------


def plot_medial_axis(
    medial_axis: MedialAxis, ax: Axes | None = None, *, outer: bool = True, width: float = 1.2
) -> Axes:
    """Draw a medial axis: inner edges green, outer edges and rays purple and thinner.

    Parameters
    ----------
    medial_axis : MedialAxis
        What `medial_axis` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    outer : bool, default True
        Whether to draw the part outside of the rings.
    width : float, default 1.2
        Of the inner edges, in typographic points.

    Returns
    -------
    ax : Axes

    Notes
    -----
    New Axes show the vertices between the 2nd and the 98th percentile; Axes given keep their view.

    Examples
    --------
    >>> from crustline import medial_axis
    >>> ax = plot_medial_axis(medial_axis([(0, 0), (2, 0), (2, 1), (0, 1)]))
    """
    vertices = np.asarray(medial_axis.vertices, np.float64)
    edges, inner = np.asarray(medial_axis.edges), np.asarray(medial_axis.inner, bool)
    core = _core(vertices)
    ax = _axes(ax, core if ax is None else vertices[:0])
    seen = ax.dataLim.get_points()
    box = _box(seen if np.isfinite(seen).all() else core)
    _draw_segments(ax, _clipped(vertices[edges[inner]], box), GREEN, width, label="medial axis")
    if outer:
        origins = vertices[medial_axis.ray_origins]
        rays = _rays(origins, np.asarray(medial_axis.ray_directions), box)
        outside = np.concatenate([vertices[edges[~inner]], rays])
        _draw_segments(ax, _clipped(outside, box), PURPLE, 0.7 * width, label="outer medial axis")
    return ax


def _core(vertices: FloatArray) -> FloatArray:
    """Return two corners that most vertices lie between: a few can be very far away."""
    finite = vertices[np.isfinite(vertices).all(axis=1)]
    return np.percentile(finite, [2, 98], axis=0) if len(finite) else finite


# --- Certificate --------------------------------------------------------------------------------


def plot_certificate(
    certificate: Certificate, ax: Axes | None = None, *, points: bool = True, indices: bool = False
) -> Axes:
    """Draw a certificate: edges that keep the guarantee blue, those that break it vermillion.

    Points that break it are marked, with one shape for each reason.

    Parameters
    ----------
    certificate : Certificate
        What `certify` gives.
    ax : Axes, optional
        Where to draw; new Axes if not given.
    points : bool, default True
        Whether to draw the other points, too.
    indices : bool, default False
        Whether to write its row beside each point.

    Returns
    -------
    ax : Axes

    Examples
    --------
    >>> from crustline import certify, crust
    >>> points = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> ax = plot_certificate(certify(points, crust(points)))
    """
    xy = as_points(certificate.points)
    ax = _axes(ax, xy)
    edges = np.asarray(certificate.edges).reshape(-1, 2)
    weak = np.zeros(len(edges), bool)
    weak[np.asarray(certificate.weak, np.int64)] = True
    _draw_segments(ax, xy[edges[~weak]], BLUE, 1.5, label="keeps the guarantee", zorder=3)
    _draw_segments(ax, xy[edges[weak]], VERMILLION, 2.5, label="breaks it", zorder=3)
    if points:
        plot_points(xy, ax)
    reasons = np.asarray(certificate.point_reason)
    for reason, marker in MARKERS.items():
        _mark(ax, xy[reasons == reason], marker, VERMILLION, reason)
    ax.set_title("guaranteed" if certificate.guaranteed else "not guaranteed", size=9, loc="left")
    return plot_indices(xy, ax) if indices else ax


# --- One picture in a file ----------------------------------------------------------------------


@dataclass(frozen=True)
class _Scene:
    """What there is to draw of some points, each part computed when it is first drawn."""

    points: FloatArray
    method: Callable[..., Any]

    @cached_property
    def delaunay(self) -> Delaunay:
        from crustline.delaunay import Delaunay

        return Delaunay(self.points)

    @cached_property
    def edges(self) -> IntArray:
        edges: IntArray = self.method(self.delaunay)
        return edges

    @cached_property
    def curves(self) -> Curves:
        from crustline.curves import trace

        return trace(self.points, self.edges)

    @cached_property
    def medial_axis(self) -> MedialAxis:
        from crustline.medial import medial_axis

        return medial_axis(self.points, self.edges)

    @cached_property
    def feature_sizes(self) -> FloatArray:
        from crustline.medial import local_feature_size

        return np.asarray(local_feature_size(self.points, self.edges))

    @cached_property
    def certificate(self) -> Certificate:
        from crustline.certify import certify

        return certify(self.points, self.edges)


#: What `picture` can show, drawn in this order.
LAYERS: dict[str, Callable[[_Scene, Axes], Axes]] = {
    "delaunay": lambda scene, ax: plot_delaunay(scene.delaunay, ax, points=False),
    "voronoi": lambda scene, ax: plot_voronoi(scene.delaunay, ax, points=False),
    "medial-axis": lambda scene, ax: plot_medial_axis(scene.medial_axis, ax),
    "crust": lambda scene, ax: plot_curves(scene.curves, ax, points=False),
    "certificate": lambda scene, ax: plot_certificate(scene.certificate, ax, points=False),
    "lfs": lambda scene, ax: plot_local_feature_size(scene.points, scene.feature_sizes, ax),
    "points": lambda scene, ax: plot_points(scene.points, ax),
    "indices": lambda scene, ax: plot_indices(scene.points, ax),
}
SUFFIXES = (".png", ".svg", ".pdf")


def picture(
    points: ArrayLike,
    path: str | os.PathLike[str],
    *,
    show: Sequence[str] = ("points", "crust"),
    method: Callable[..., Any] | None = None,
) -> None:
    """Write a picture of points and of what is computed from them to a file.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Coordinates.
    path : str or path-like
        Where to write; the suffix .png, .svg or .pdf decides the format.
    show : sequence of str
        What to draw, any of "points", "delaunay", "voronoi", "crust" (the curves that the method
        finds), "medial-axis", "lfs", "certificate", "indices", in any order.
    method : callable, optional
        From points to edges; `crustline.crust` if not given.

    Raises
    ------
    InputError
        If the suffix or a word of `show` is none of these, or the points are not finite (n, 2).
    MissingExtraError
        If matplotlib is not installed.

    Notes
    -----
    The same call writes the same bytes again: no date, no random identifier, and none of the user's
    settings of matplotlib.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     picture([(0, 0), (1, 0), (1, 1), (0, 1)], folder + "/square.svg")
    """
    path = Path(path)
    _check_choice("suffix", path.suffix.lower(), SUFFIXES)
    for layer in show:
        _check_choice("layer", layer, tuple(LAYERS))
    _require_matplotlib()
    from matplotlib import rc_context, rcdefaults

    from crustline.methods import crust

    scene = _Scene(as_points(points), crust if method is None else method)
    with rc_context():
        rcdefaults()
        ax = _axes(None, scene.points)
        for name, draw in LAYERS.items():
            if name in show:
                draw(scene, ax)
        _save(ax, path)


def _save(ax: Axes, path: Path) -> None:
    """Write the figure of the Axes without the date and the random names that tell runs apart."""
    from matplotlib import rc_context

    kind = path.suffix.lower()[1:]
    dates: dict[str, dict[str, Any]] = {
        "svg": {"Date": None},
        "pdf": {"CreationDate": None, "ModDate": None},
        "png": {},
    }
    with rc_context({"svg.hashsalt": "crustline", "svg.fonttype": "none", "pdf.fonttype": 42}):
        figure: Any = ax.get_figure(root=True)
        figure.savefig(path, format=kind, dpi=200, metadata=dates[kind])


def _check_choice(what: str, given: str, choices: tuple[str, ...]) -> None:
    if given not in choices:
        raise InputError(f"unknown {what} of a picture {given!r}: use one of {', '.join(choices)}")


# --- Axes and strokes ---------------------------------------------------------------------------


def _require_matplotlib() -> None:
    try:
        import matplotlib  # noqa: F401  # whether it is there is the question
    except ImportError as error:
        raise missing_extra("plot", "matplotlib") from error


def _axes(ax: Axes | None, xy: FloatArray) -> Axes:
    """Return the Axes given, or new ones, of equal aspect, that show at least the points `xy`."""
    _require_matplotlib()
    if ax is None:
        ax = _new_axes(xy)
    elif ax.get_aspect() == "auto":
        ax.set_aspect("equal")
    if len(xy):
        ax.update_datalim([xy.min(axis=0), xy.max(axis=0)])
        ax.autoscale_view()
    return ax


def _new_axes(xy: FloatArray) -> Axes:
    """Return quiet Axes of equal aspect in a figure of about the proportions of the points."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = np.ptp(xy, axis=0) if len(xy) else (1.0, 1.0)
    ratio = float(np.clip(height / width if width > 0 else 1.0, 0.3, 1.6))
    figure = Figure(figsize=(6.4, 6.4 * ratio + 0.6), layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot()
    ax.set_aspect("equal", adjustable="datalim")
    ax.margins(0.05)
    ax.spines[["top", "right"]].set_visible(False)
    ax.spines[["left", "bottom"]].set_color(GRAY)
    ax.tick_params(color=GRAY, labelcolor="#555555", labelsize=7, length=2)
    ax.locator_params(nbins=6)
    for axis in (ax.xaxis, ax.yaxis):
        axis.get_offset_text().set_fontsize(7)
    return ax


def _draw_segments(
    ax: Axes,
    segments: FloatArray,
    color: str,
    width: float,
    *,
    label: str | None = None,
    zorder: float = 2,
) -> Axes:
    """Draw segments (m, 2, 2)."""
    starts = np.arange(0, 2 * len(segments), 2)
    return _stroke(ax, segments.reshape(-1, 2), starts, color, width, label=label, zorder=zorder)


def _stroke(
    ax: Axes,
    vertices: FloatArray,
    starts: IntArray,
    color: str,
    width: float,
    *,
    label: str | None = None,
    zorder: float = 2,
) -> Axes:
    """Draw lines through vertices (k, 2), a new one at each of the positions `starts`."""
    if not len(vertices):
        return ax
    from matplotlib.collections import PathCollection
    from matplotlib.path import Path as Outline

    codes = np.full(len(vertices), Outline.LINETO, np.uint8)
    codes[starts] = Outline.MOVETO
    outlines = []
    for k in range(0, len(vertices), CHUNK):
        part = codes[k : k + CHUNK + 1].copy()
        part[0] = Outline.MOVETO
        outlines.append(Outline(vertices[k : k + CHUNK + 1], part))
    lines = PathCollection(
        outlines,
        facecolors="none",
        edgecolors=color,
        linewidths=width,
        capstyle="round",
        joinstyle="round",
        zorder=zorder,
    )
    ax.add_collection(lines, autolim=False)
    if label:
        ax.plot([], [], color=color, linewidth=width, label=label)
        _legend(ax)
    return ax


def _mark(ax: Axes, xy: FloatArray, marker: str, color: str, label: str) -> None:
    """Draw open markers, and name them in the legend."""
    if len(xy):
        style = {"markerfacecolor": "none", "markeredgecolor": color, "markeredgewidth": 1.3}
        ax.plot(*xy.T, marker, linestyle="none", markersize=7, zorder=5, label=label, **style)  # type: ignore[arg-type]
        _legend(ax)


def _legend(ax: Axes) -> None:
    """Name what is drawn below the Axes, where it hides nothing."""
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=3, frameon=False, fontsize=8)


def _dot_size(n: int) -> float:
    """Return a diameter for each of n dots: 3.5 points for a few, 0.5 for a million."""
    return float(np.clip(40 / math.sqrt(n + 1), 0.5, 3.5))


def _open_range(values: FloatArray) -> tuple[float, float]:
    """Return least and largest value, apart if they are equal, for a scale of colors."""
    low, high = float(values.min()), float(values.max())
    return (low, high) if low < high else (low / 2, high * 2)


def _box(xy: FloatArray) -> FloatArray:
    """Return the lower left and the upper right corner of three times the extent of the points."""
    if not len(xy):
        return np.array([[-1.0, -1.0], [1.0, 1.0]])
    low, high = xy.min(axis=0), xy.max(axis=0)
    margin = math.hypot(*(high - low)) or 1.0
    return np.stack([low - margin, high + margin])


def _rays(origins: FloatArray, directions: FloatArray, box: FloatArray) -> FloatArray:
    """Return rays as segments that are long enough to leave the box."""
    lengths = np.hypot(*directions.T)
    reach = np.hypot(*(origins - box.mean(axis=0)).T) + math.dist(*box)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.stack([origins, origins + directions * (reach / lengths)[:, None]], 1)


def _clipped(segments: FloatArray, box: FloatArray) -> FloatArray:
    """Return the parts of segments (m, 2, 2) that lie in a box: Liang and Barsky's clipping."""
    segments = segments[np.isfinite(segments).all(axis=(1, 2))]
    start, step = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        crossings = (box[:, None] - start) / step
    # Parallel to a side: inside of it all along, or nowhere.
    inside = (start >= box[0]) & (start <= box[1])
    enter = np.where(step == 0, np.where(inside, -np.inf, np.inf), crossings.min(axis=0))
    leave = np.where(step == 0, np.where(inside, np.inf, -np.inf), crossings.max(axis=0))
    t = np.stack([enter.max(axis=1).clip(min=0), leave.min(axis=1).clip(max=1)], 1)
    seen = t[:, 0] <= t[:, 1]
    return start[seen, None] + t[seen, :, None] * step[seen, None]
