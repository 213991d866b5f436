"""Redraw the paper's figures and the README's picture: python -m docs.figures

Writes docs/gallery/*.png and docs/gallery/README.md, whose captions are the first paragraphs of the
docstrings below. Everything drawn is computed by crustline; the point sets are our own. The same
versions of matplotlib and NumPy write the same bytes again.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib import rc_context, rcdefaults
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon

import crustline as cl
from crustline import plot, shapes, theory
from crustline.plot import BLACK, BLUE, GRAY, GREEN, ORANGE, PURPLE, SKY, VERMILLION

Rows = npt.NDArray[np.float64]
Edges = npt.NDArray[np.int64]
Box = tuple[float, float, float, float]

ROOT = Path(__file__).resolve().parent.parent
GALLERY = ROOT / "docs" / "gallery"
DPI = 110
TEXT = 11

#: A curve with a narrow neck and one with a bay, as control points of splines.
PEAR = [(0, 0), (1.1, 0.25), (1.5, 1.1), (1.05, 1.9), (0.75, 2.7), (0.35, 3.4), (-0.25, 3.35),
        (-0.55, 2.65), (-0.75, 1.85), (-1.25, 1.1), (-1.0, 0.3)]  # fmt: skip
HOOK = [(0, 0), (1.6, -0.55), (3.2, -0.35), (4.2, 0.9), (4.1, 2.5), (3.0, 3.3), (1.7, 3.0),
        (1.75, 2.1), (2.65, 1.95), (2.9, 1.35), (2.3, 0.85), (1.0, 1.05), (0.1, 1.0)]  # fmt: skip
LEAF = [(0, 0), (1.4, 0.35), (2.6, 1.3), (3.7, 1.2), (4.9, 1.75), (4.2, 2.5), (3.1, 2.55),
        (2.5, 3.2), (2.55, 4.2), (1.7, 4.3), (1.35, 3.3), (0.5, 2.9), (-0.7, 3.1), (-0.8, 2.2),
        (0.05, 1.75), (-0.1, 0.9)]  # fmt: skip


# --- The README's picture -----------------------------------------------------------------------


@cache
def goose_points() -> Rows:
    """Return the shuffled points of examples/goose.csv."""
    return np.asarray(cl.read(ROOT / "examples" / "goose.csv"))


def goose() -> Figure:
    """Points without an order, and the curves that they were sampled from: the outline and the eye
    are rings (blue), the wing is an open line (vermillion).

    Made by `cl.read`, `cl.crust`, `cl.trace`, `Curves.plot`."""
    points = goose_points()
    box = _box(points, 0.03)
    figure, (left, right) = _panels(2, box, width=8.6)
    plot.plot_points(points, left, size=3.2)
    plot.plot_curves(cl.reconstruct(points), right, points=False)
    plot.plot_points(points, right, size=2.2)
    for ax in (left, right):
        _view(ax, box)
    return figure


# --- §1 and §2: crust and β-skeleton ------------------------------------------------------------


def figure_1() -> Figure:
    """A point set and its crust. Fewer samples are needed on the goose's back than on its head and
    feet.

    Made by `cl.crust`."""
    points = goose_points()
    box = _box(points, 0.03)
    figure, (ax,) = _panels(1, box, width=4.6)
    plot.plot_edges(points, cl.crust(points), ax, width=1.6)
    plot.plot_points(points, ax, size=3.4)
    _view(ax, box)
    return figure


def figure_2() -> Figure:
    """Left: the Voronoi diagram (orange) of a point set S (black) and its vertices V (orange dots).
    Right: the Delaunay triangulation of S ∪ V; its edges between two points of S are the crust
    (blue).

    Made by `cl.Delaunay`, `cl.crust`."""
    points = cl.r_sample(shapes.spline(PEAR), 0.45, seed=3).points
    delaunay = cl.Delaunay(points)
    vertices = np.unique(delaunay.circumcenters, axis=0)
    both = cl.Delaunay(np.concatenate([points, vertices]))
    box = _box(points, 0.12)
    figure, (left, right) = _panels(2, box, width=7.6)
    plot.plot_voronoi(delaunay, left, points=False)
    plot.plot_delaunay(both, right, points=False)
    plot.plot_edges(points, cl.crust(delaunay), right, width=2.4)
    for ax in (left, right):
        ax.plot(*vertices.T, "o", color=ORANGE, markersize=3.6, markeredgewidth=0, zorder=4)
        plot.plot_points(points, ax, size=5)
        _view(ax, box)
    return figure


def figure_3() -> Figure:
    """Forbidden regions of two points for β = 1, 3/2 and 2: an edge belongs to the β-skeleton if no
    other point is inside.

    Made by `cl.beta_skeleton`'s definition; `theory.phi` gives the angle at which the circles
    cross."""
    box = (-1.2, -2.6, 16.2, 2.1)
    figure, (ax,) = _panels(1, box, width=8.2)
    for x, beta, name in ((0, 1.0, "β = 1"), (4.4, 1.5, "β = 3/2"), (11.8, 2.0, "β = 2")):
        s = _forbidden_region(ax, beta, x)
        ax.plot(*s.T, "o-", color=BLACK, markersize=5, linewidth=1.2, zorder=4)
        ax.text(x, -2.5, name, size=TEXT, ha="center")
    _view(ax, box)
    return figure


def _forbidden_region(ax: Axes, beta: float, at: float = 0.0) -> Rows:
    """Draw the forbidden region of the points (at, ±1), which are returned."""
    offset = math.sqrt(beta * beta - 1)
    for x in sorted({at - offset, at + offset}):
        ax.add_patch(Circle((x, 0), beta, facecolor=SKY, alpha=0.35, edgecolor="none"))
        ax.add_patch(Circle((x, 0), beta, facecolor="none", edgecolor=BLUE, linewidth=1.4))
    return np.array([(at, -1.0), (at, 1.0)])


# --- §4 and §5: medial axis, local feature size, sampling ---------------------------------------


def figure_4() -> Figure:
    """The medial axis of three smooth curves (black): green inside, purple outside, where parts of
    it extend to infinity.

    Made by `cl.r_sample` with r = 0.03 and `cl.medial_axis`."""
    curve = shapes.union(
        shapes.spline(HOOK),
        shapes.spline(PEAR).moved(scale=0.95, angle=0.15, offset=(6.3, -0.2)),
        shapes.ellipse(0.62, 0.3).moved(angle=-0.5, offset=(0.35, 2.6)),
    )
    box = _box(_dense(curve), 0.08)
    figure, (ax,) = _panels(1, box, width=7.6)
    _draw_curve(ax, curve)
    _draw_axis(ax, curve, 0.03, box)
    _view(ax, box)
    return figure


def figure_5() -> Figure:
    """The local feature size of p is the distance to m, the nearest point of the medial axis
    (green), not to m′, the center of the largest empty disk that is tangent at p: here 0.57
    and not 0.74.

    Made by `SmoothCurve.medial_axis`, `SmoothCurve.normal`, `SmoothCurve.local_feature_size`."""
    curve, t = shapes.trefoil(4, 0.1).moved(angle=math.pi / 4), 0.6437
    p, far = curve.point(t), _tangent_center(curve, t)
    near = _nearest_on_axis(curve, p)
    box = (-1.08, -1.14, 1.08, 1.08)
    figure, (ax,) = _panels(1, box, width=4.6)
    _draw_curve(ax, curve)
    _draw_axis(ax, curve, 0.03, box, outer=False)
    radius = math.dist(p, far)
    ax.add_patch(Circle(far, radius, facecolor=SKY, alpha=0.18, edgecolor="none"))
    ax.add_patch(Circle(far, radius, facecolor="none", edgecolor=SKY, linewidth=1.2))
    _line(ax, p, far, BLUE, "--")
    _line(ax, p, near, VERMILLION, "-", width=2.2)
    _dots(ax, [p, far, near])
    _write(ax, "p", p, (-4, -16))
    _write(ax, "m′", far, (-24, -6))
    _write(ax, "m", near, (7, -2))
    lfs = float(curve.local_feature_size(t))
    _write(ax, f"{lfs:.2f}", (p + near) / 2, (8, -10), VERMILLION)
    _write(ax, f"{radius:.2f}", (p + far) / 2, (-32, 0), BLUE)
    _view(ax, box)
    return figure


def figure_6() -> Figure:
    """The 16 points 1-sample both heavy curves, so that no method can be right on both. The light
    lines are the medial axes.

    Made by `shapes.two_octagons`, `shapes.two_octagons_separate`, `shapes.two_octagons_joined`,
    `cl.sampling_ratio`."""
    points = shapes.two_octagons()
    box = _box(points, 0.06)
    figure, axes = _panels(2, box, width=8.6, titled=True)
    both = (shapes.two_octagons_separate(), shapes.two_octagons_joined())
    for ax, curve, count in zip(axes, both, ("two components", "one component"), strict=True):
        _draw_curve(ax, curve)
        _draw_axis(ax, curve, 0.02, box)
        plot.plot_points(points, ax, size=6.5, color=VERMILLION)
        ratio = cl.sampling_ratio(curve, points)
        ax.set_title(f"{count}: a {ratio:.3f}-sample", size=TEXT)
        _view(ax, box)
    return figure


# --- §6 and §8: the constructions of the proofs -------------------------------------------------


def figure_7() -> Figure:
    """Observation 8: the line L is tangent to the unit circle at p, d(s, p) = r, and x is the foot
    of s on the radius of p.

    Made by `theory.central_angle` (γ) and `theory.tangent_angle` (α)."""
    r = 0.8
    gamma, alpha = theory.central_angle(r), theory.tangent_angle(r)
    p, c = np.zeros(2), np.array([0.0, 1.0])
    s = np.array([math.sin(gamma), 1 - math.cos(gamma)])
    x = np.array([0.0, s[1]])
    box = (-1.2, -0.16, 1.4, 1.14)
    figure, (ax,) = _panels(1, box, width=5.2)
    ax.add_patch(Arc(c, 2, 2, theta1=195, theta2=345, color=BLUE, linewidth=2))
    _line(ax, (-1.15, 0), (1.35, 0), GRAY)
    for q, color in ((s, VERMILLION), (c, BLACK)):
        _line(ax, p, q, color)
    _line(ax, c, s, BLACK)
    _line(ax, s, x, GREEN)
    _angle(ax, c, -90, -90 + math.degrees(gamma), 0.3, "γ", 0.38)
    _angle(ax, p, 0, math.degrees(alpha), 0.5)
    _dots(ax, [p, c, s, x])
    for name, q, offset in (
        ("p", p, (-5, -16)), ("c", c, (-4, 7)), ("s", s, (8, -4)), ("x", x, (-15, -3)),
        ("L", (1.27, 0), (0, 5)), ("1", (p + c) / 2, (-12, 8)), ("1", (c + s) / 2, (6, 4)),
        ("r", (p + s) / 2, (-8, 4)), ("α", (0.53, 0.03), (0, 0)),
    ):  # fmt: skip
        _write(ax, name, q, offset)
    _write(ax, "sin γ", (s + x) / 2, (-16, 5), GREEN)
    _view(ax, box)
    return figure


def figure_8() -> Figure:
    """Theorem 14 where it is tight, r = 0.39265: samples s₁ and s₂ at the distance r from p on the
    unit tangent circle, a Voronoi vertex v on the border of the curve Voronoi disk B. Its Voronoi
    disk V just reaches the border of B′, of radius LFS(p) = 1: no smaller r lets V hold a point of
    the medial axis.

    Made by `theory.containing_r("crust")`, `theory.tangent_angle`."""
    r = theory.containing_r("crust")
    alpha = theory.tangent_angle(r)
    s2 = r * np.array([math.cos(alpha), -math.sin(alpha)])
    s1, v, p = s2 * [-1, 1], np.array([0.0, r]), np.zeros(2)
    box = (-1.03, -1.03, 1.03, 1.03)
    figure, (ax,) = _panels(1, box, width=5.2)
    ax.add_patch(Circle(p, 1, facecolor="none", edgecolor=GRAY, linewidth=1.3))
    ax.add_patch(Circle(v, math.dist(v, s2), facecolor=SKY, alpha=0.25, edgecolor="none"))
    ax.add_patch(Circle(v, math.dist(v, s2), facecolor="none", edgecolor=BLUE, linewidth=1.3))
    ax.add_patch(Circle(p, r, facecolor="none", edgecolor=VERMILLION, linewidth=1.3))
    # The curve at its most curved: the tangent circle of radius one below.
    ax.add_patch(Arc((0, -1), 2, 2, theta1=52, theta2=128, color=BLACK, linewidth=2.4))
    for q in (s1, s2, v):
        _line(ax, p, q, VERMILLION, width=1.1)
    _line(ax, v, s2, BLUE, width=1.1)
    _angle(ax, p, -math.degrees(alpha), 90, 0.11, "ψ", 0.17)
    _dots(ax, [s1, s2, p, v])
    for name, q, offset, color in (
        ("s₁", s1, (-25, 5), BLACK), ("s₂", s2, (13, 5), BLACK), ("p", p, (-4, -16), BLACK),
        ("v", v, (-4, 7), BLACK), ("r", v / 2, (-11, -2), VERMILLION),
        ("R", (v + s2) / 2, (5, 4), BLUE), ("V", (-0.46, 0.62), (0, 0), BLUE),
        ("B", (-0.06, -0.36), (0, 0), VERMILLION), ("B′", (-0.78, 0.42), (0, 0), "#666666"),
        ("F", (-0.58, -0.27), (0, 0), BLACK),
    ):  # fmt: skip
        _write(ax, name, q, offset, color)
    _view(ax, box)
    return figure


# --- §9: the angle φ and Figure 14 --------------------------------------------------------------


def figure_11() -> Figure:
    """Forbidden regions can be defined by β or by φ = arcsin(1/β): the tangents to the two circles
    cross at the angle 2φ. Here β = 1.70.

    Made by `theory.phi`."""
    beta = 1.7
    half = theory.phi(beta)
    box = (-3.15, -1.75, 3.15, 1.75)
    figure, (ax,) = _panels(1, box, width=5.6)
    s = _forbidden_region(ax, beta)
    center = np.array([math.sqrt(beta * beta - 1), 0.0])
    ax.plot(*s.T, "-", color=BLACK, linewidth=1.2)
    for sign in (-1, 1):
        along = 1.5 * np.array([sign * math.sin(half), -math.cos(half)])
        _line(ax, s[1], s[1] + along, VERMILLION)
    _angle(ax, s[1], -90 - math.degrees(half), -90 + math.degrees(half), 0.75)
    _write(ax, "2φ", s[1] + (-0.9, -0.6), (0, 0), VERMILLION)
    _line(ax, center, s[1], BLUE)
    _dots(ax, [*s, center])
    _write(ax, "β d/2", (center + s[1]) / 2, (4, 4), BLUE)
    _write(ax, "d", (s[0] + s[1]) / 2, (4, -24))
    _write(ax, "s₁", s[1], (-5, 8))
    _write(ax, "s₂", s[0], (-5, -17))
    _view(ax, box)
    return figure


def figure_14() -> Figure:
    """The three conditions of Theorem 20: the β-skeleton is the reconstruction in the shaded
    region, below (1) and above (2) and (3). Its tip is at r = 0.2985, β = 1.694; at β = 1.70 it
    ends at r = 0.2974.

    Made by `theory.phi_below_nonadjacent` (1), `theory.phi_above_neighbors` (2),
    `theory.phi_above_medial_axis` (3), `cl.guaranteed_r`, `theory.best_beta`."""
    figure = _figure(6.4, 4.6)
    ax = figure.add_subplot()
    r = np.linspace(0, 0.36, 361)
    above, neighbors = theory.phi_above_medial_axis(r), theory.phi_above_neighbors(r)
    below = theory.phi_below_nonadjacent(r)
    holds = np.maximum(above, neighbors) <= below
    ax.fill_between(r, np.maximum(above, neighbors), below, where=holds, color=SKY, alpha=0.3, lw=0)
    for values, color, style, name, at, offset in (
        (below, BLUE, "-", "(1)", 60, (6, 4)),
        (above, VERMILLION, "--", "(3)", 340, (-12, 6)),
        (neighbors, GREEN, "-.", "(2)", 340, (-2, -18)),
    ):
        ax.plot(r, values, style, color=color, linewidth=1.8)
        _write(ax, name, (r[at], values[at]), offset, color)
    _mark_best(ax)
    ax.set(xlim=(0, 0.36), ylim=(0, math.pi / 2), xlabel="r", ylabel="φ (radians)")
    _frame(ax)
    return figure


def _mark_best(ax: Axes) -> None:
    """Mark the tip of the shaded region, and the line of β = 1.70."""
    beta, r = theory.best_beta()
    tip = theory.phi(beta)
    ax.plot([r], [tip], "o", color=BLACK, markersize=5)
    ax.annotate(
        f"r = {r:.4f}\nβ = {beta:.3f}, φ = {tip:.3f}", (r, tip), (-30, 60),
        textcoords="offset points", size=9, arrowprops={"arrowstyle": "-", "color": GRAY},
    )  # fmt: skip
    phi, end = theory.phi(1.7), cl.guaranteed_r("beta_skeleton", 1.7)
    ax.plot([0, end], [phi, phi], ":", color=BLACK, linewidth=1.3)
    ax.annotate("β = 1.70", (0.01, phi), (0, 4), textcoords="offset points", size=9)


# --- §10 and §11: examples, and the anti-crust --------------------------------------------------


def example_1() -> Figure:
    """First example of §10: points (left), crust (center) and β-skeleton (right) are equal far
    beyond the proven r. The title says how sparse the samples are.

    Made by `cl.r_sample`, `cl.sampling_ratio`, `cl.crust`, `cl.beta_skeleton`."""
    curve = shapes.union(
        shapes.spline(HOOK), shapes.ellipse(0.62, 0.3).moved(angle=-0.5, offset=(0.3, 2.5))
    )
    sample = cl.r_sample(curve, 0.55, seed=5)
    ratio = cl.sampling_ratio(curve, sample.points)
    return _three_graphs(sample.points, f"{len(sample)} points, r = {ratio:.2f}")


def example_2() -> Figure:
    """Second example of §10: on samples too sparse for their curve the crust adds edges that the
    β-skeleton does not have (vermillion).

    Made by `cl.crust`, `cl.beta_skeleton`."""
    r = 0.75
    points = cl.r_sample(shapes.spline(LEAF), r, seed=1).points
    return _three_graphs(points, f"{len(points)} points, r = {r}")


def example_3() -> Figure:
    """Third example of §10: a curve in sparse noise is found fairly well. An edge of the β-skeleton
    that is not in the crust (purple) is unusual: six points were placed so as to have one.

    Made by `cl.crust`, `cl.beta_skeleton`."""
    points = noisy_points()
    return _three_graphs(points, f"{len(points)} points, {NOISE + 6} of them noise")


#: How many points of noise are uniform, and its seed.
NOISE, NOISE_SEED = 14, 335


def noisy_points(seed: int = NOISE_SEED) -> Rows:
    """Return samples of a curve among uniform noise, and six more points that were placed."""
    sample = cl.r_sample(shapes.spline(LEAF), 0.3, seed=1).points
    low, high = sample.min(axis=0) - 0.5, sample.max(axis=0) + 0.5
    noise = np.random.default_rng(seed).uniform(low, high, (NOISE, 2))
    return np.concatenate([sample, noise, _outside_of_crust((3.4, -0.7), 1.1)])


def _outside_of_crust(at: tuple[float, float], length: float) -> Rows:
    """Return six points: the edge between the first two is in the β-skeleton, not in the crust.

    Close to each end, on opposite sides, two points in the wedge that the forbidden region leaves
    free make a Voronoi vertex inside of the smallest disk on the edge, so that no disk is empty."""
    distance, angle = np.array([0.104, 0.15]), np.radians([150.0, 145.5])
    fan = distance[:, None] * np.stack([np.cos(angle), np.sin(angle)], -1)
    return np.array(at) + length * np.concatenate([[(0, 0), (1, 0)], fan, (1, 0) - fan])


def _three_graphs(points: Rows, title: str) -> Figure:
    """Draw points, crust and β-skeleton side by side, with the edges that only one of them has."""
    crust, skeleton = cl.crust(points), cl.beta_skeleton(points)
    box = _box(points, 0.05)
    figure, axes = _panels(3, box, width=9.2, titled=True)
    for ax, edges, other, color, name in (
        (axes[0], crust[:0], crust[:0], BLACK, title),
        (axes[1], crust, skeleton, VERMILLION, "crust"),
        (axes[2], skeleton, crust, PURPLE, "β-skeleton, β = 1.70"),
    ):
        own = ~_contained(edges, other)
        plot.plot_edges(points, edges[~own], ax, width=1.6)
        plot.plot_edges(points, edges[own], ax, width=2.2, color=color)
        plot.plot_points(points, ax, size=3.6)
        ax.set_title(name, size=TEXT)
        _view(ax, box)
    return figure


def figure_15() -> Figure:
    """A point set, its crust (blue), and the corresponding polygonal analog of the medial axis:
    green inside, purple outside.

    Made by `cl.crust`, `cl.medial_axis`."""
    points = cl.r_sample(shapes.spline(LEAF), 0.35, seed=4).points
    edges = cl.crust(points)
    box = _box(points, 0.06)
    figure, (ax,) = _panels(1, box, width=5.6)
    plot.plot_edges(points, edges, ax, width=1.8)
    plot.plot_points(points, ax, size=4.2)
    plot.plot_medial_axis(cl.medial_axis(points, edges), ax)
    _view(ax, box)
    return figure


# --- Pieces of figures --------------------------------------------------------------------------


def _contained(edges: Edges, others: Edges) -> npt.NDArray[np.bool_]:
    known = {(i, j) for i, j in others.tolist()}
    return np.array([(i, j) in known for i, j in edges.tolist()], bool)


def _dense(curve: shapes.SmoothCurve) -> Rows:
    return curve.point(np.linspace(0, 1, 400 * len(curve.loops), endpoint=False))


def _draw_curve(ax: Axes, curve: shapes.SmoothCurve) -> None:
    for loop in curve.components:
        ax.add_patch(
            Polygon(_dense(loop), facecolor="none", edgecolor=BLACK, linewidth=2.4, zorder=3)
        )


def _draw_axis(ax: Axes, curve: shapes.SmoothCurve, r: float, box: Box, outer: bool = True) -> None:
    """Draw the medial axis of dense samples, which is near the curve's own."""
    sample = cl.r_sample(curve, r)
    ax.update_datalim(np.reshape(box, (2, 2)))
    plot.plot_medial_axis(cl.medial_axis(sample.points, sample.edges), ax, outer=outer, width=1.8)


def _tangent_center(curve: shapes.SmoothCurve, t: float) -> Rows:
    """Return the center of the largest empty disk inside that is tangent at t."""
    p, n = curve.point(t), curve.normal(t)
    apart = curve.point(np.linspace(0, 1, 20_000, endpoint=False) + 1e-5) - p
    bend = 2 * apart @ n / np.sum(apart**2, axis=1)
    return p + n / bend.max()


def _nearest_on_axis(curve: shapes.SmoothCurve, p: Rows) -> Rows:
    vertices = curve.medial_axis().vertices
    return vertices[np.argmin(np.hypot(*(vertices - p).T))]


def _line(
    ax: Axes,
    a: Sequence[float],
    b: Sequence[float],
    color: str,
    style: str = "-",
    width: float = 1.4,
) -> None:
    ax.plot([a[0], b[0]], [a[1], b[1]], style, color=color, linewidth=width, zorder=3)


def _dots(ax: Axes, places: Iterable[Any]) -> None:
    ax.plot(*np.array(list(places)).T, "o", color=BLACK, markersize=5, zorder=5)


def _write(ax: Axes, text: str, at: Any, offset: tuple[float, float], color: str = BLACK) -> None:
    ax.annotate(text, at, offset, textcoords="offset points", size=TEXT, color=color, zorder=6)


def _angle(
    ax: Axes, at: Any, start: float, end: float, size: float, name: str = "", away: float = 0.0
) -> None:
    """Mark an angle (degrees) by an arc, with its name on the bisector, `away` from the corner."""
    arc = Arc(at, 2 * size, 2 * size, theta1=start, theta2=end, color=VERMILLION, linewidth=1.2)
    ax.add_patch(arc)
    middle = math.radians((start + end) / 2)
    x, y = at[0] + away * math.cos(middle), at[1] + away * math.sin(middle)
    ax.text(x, y, name, size=TEXT, color=VERMILLION, ha="center", va="center")


def _figure(width: float, height: float) -> Figure:
    """Return an empty figure of this size in inches, in no window."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _panels(
    count: int, box: Box, *, width: float, titled: bool = False
) -> tuple[Figure, list[Axes]]:
    """Return a figure of this width in inches: bare Axes side by side that show the box."""
    ratio = (box[3] - box[1]) / (box[2] - box[0])
    figure = _figure(width, width / count * ratio + 0.35 * titled)
    axes = [figure.add_subplot(1, count, k + 1) for k in range(count)]
    for ax in axes:
        ax.set_aspect("equal")
        ax.axis("off")
    return figure, axes


def _box(points: Rows, margin: float) -> Box:
    """Return least and largest coordinates, with a margin that is a share of the extent."""
    low, high = points.min(axis=0), points.max(axis=0)
    pad = margin * float((high - low).max())
    return (low[0] - pad, low[1] - pad, high[0] + pad, high[1] + pad)


def _view(ax: Axes, box: Box) -> None:
    """Show just this box, without a legend: captions say what is drawn."""
    if legend := ax.get_legend():
        legend.remove()
    ax.set(xlim=(box[0], box[2]), ylim=(box[1], box[3]))


def _frame(ax: Axes) -> None:
    ax.spines[["top", "right"]].set_visible(False)
    ax.tick_params(labelsize=9)


# --- Files --------------------------------------------------------------------------------------

FIGURES: dict[str, Callable[[], Figure]] = {
    draw.__name__: draw
    for draw in (
        goose, figure_1, figure_2, figure_3, figure_4, figure_5, figure_6, figure_7, figure_8,
        figure_11, figure_14, example_1, example_2, example_3, figure_15,
    )
}  # fmt: skip
"""The name of each picture, and the function that draws it, in the order of the paper."""

HEAD = """# Gallery

The figures of the paper, redrawn by `make figures` from [`docs/figures.py`](../figures.py).
Everything is computed by crustline; the point sets are our own. Figures 9, 10, 12 and 13, steps of
proofs, are not drawn: [`tests/test_theory.py`](../../tests/test_theory.py) measures them.
"""


def caption(draw: Callable[[], Figure]) -> tuple[str, str]:
    """Return what a figure shows, and what made it, from its docstring."""
    shows, made = (draw.__doc__ or "").split("\n\n")
    return " ".join(shows.split()), " ".join(made.split())


def readme() -> str:
    """Return the page that lists all figures."""
    parts = [HEAD]
    for name, draw in FIGURES.items():
        shows, made = caption(draw)
        title = name.replace("_", " ").capitalize()
        parts.append(f"## {title}\n\n![{title}]({name}.png)\n\n{shows} *{made}*\n")
    return "\n".join(parts)


def main(names: Sequence[str]) -> None:
    """Write the figures of these names, or all, and the page that lists them."""
    GALLERY.mkdir(exist_ok=True)
    for name in names or FIGURES:
        # Matplotlib's own settings, not the user's.
        with rc_context():
            rcdefaults()
            figure = FIGURES[name]()
            figure.savefig(GALLERY / f"{name}.png", dpi=DPI, metadata={"Software": None})
    (GALLERY / "README.md").write_text(readme(), encoding="utf-8")
    print(f"{GALLERY.relative_to(ROOT)}: {len(list(GALLERY.glob('*.png')))} pictures")


if __name__ == "__main__":
    main(sys.argv[1:])
