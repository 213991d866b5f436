"""The figures of the paper, and the README's picture: each function draws one.

The first paragraph of a docstring is the caption, the second what made it.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle

import crustline as cl
from crustline import plot, shapes, theory
from crustline.plot import BLACK, BLUE, GRAY, GREEN, ORANGE, PURPLE, SKY, VERMILLION
from figures.curves import HOOK, LEAF, PEAR
from figures.drawing import (
    TEXT,
    Rows,
    bare_panels,
    box_of,
    contained,
    dense_points,
    draw_axis,
    draw_curve,
    draw_disk,
    draw_dots,
    draw_line,
    mark_angle,
    nearest_on_axis,
    new_figure,
    open_frame,
    show_just,
    tangent_center,
    write_at,
)

ROOT = Path(__file__).resolve().parent.parent


@cache
def goose_points() -> Rows:
    """Return the shuffled points of examples/goose.csv."""
    return np.asarray(cl.read(ROOT / "examples" / "goose.csv"))


def goose() -> Figure:
    """Points without an order, and the curves that they were sampled from: the outline and the eye
    are rings (blue), the wing is an open line (vermillion).

    Made by `cl.read`, `cl.crust`, `cl.trace`, `Curves.plot`."""
    points = goose_points()
    box = box_of(points, 0.03)
    figure, (left, right) = bare_panels(2, box, width=8.6)
    plot.plot_points(points, left, size=3.2)
    plot.plot_curves(cl.reconstruct(points), right, points=False)
    plot.plot_points(points, right, size=2.2)
    for ax in (left, right):
        show_just(ax, box)
    return figure


def figure_1() -> Figure:
    """A point set and its crust. Fewer samples are needed on the goose's back than on its head and
    feet.

    Made by `cl.crust`."""
    points = goose_points()
    box = box_of(points, 0.03)
    figure, (ax,) = bare_panels(1, box, width=4.6)
    plot.plot_edges(points, cl.crust(points), ax, width=1.6)
    plot.plot_points(points, ax, size=3.4)
    show_just(ax, box)
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
    box = box_of(points, 0.12)
    figure, (left, right) = bare_panels(2, box, width=7.6)
    plot.plot_voronoi(delaunay, left, points=False)
    plot.plot_delaunay(both, right, points=False)
    plot.plot_edges(points, cl.crust(delaunay), right, width=2.4)
    for ax in (left, right):
        ax.plot(*vertices.T, "o", color=ORANGE, markersize=3.6, markeredgewidth=0, zorder=4)
        plot.plot_points(points, ax, size=5)
        show_just(ax, box)
    return figure


def figure_3() -> Figure:
    """Forbidden regions of two points for β = 1, 3/2 and 2: an edge belongs to the β-skeleton if no
    other point is inside.

    Made by `cl.beta_skeleton`'s definition; `theory.phi` gives the angle at which the circles
    cross."""
    box = (-1.2, -2.6, 16.2, 2.1)
    figure, (ax,) = bare_panels(1, box, width=8.2)
    for x, beta, name in ((0, 1.0, "β = 1"), (4.4, 1.5, "β = 3/2"), (11.8, 2.0, "β = 2")):
        s = _forbidden_region(ax, beta, x)
        ax.plot(*s.T, "o-", color=BLACK, markersize=5, linewidth=1.2, zorder=4)
        ax.text(x, -2.5, name, size=TEXT, ha="center")
    show_just(ax, box)
    return figure


def _forbidden_region(ax: Axes, beta: float, at: float = 0.0) -> Rows:
    """Draw the forbidden region of the points (at, ±1), which are returned."""
    offset = math.sqrt(beta * beta - 1)
    for x in sorted({at - offset, at + offset}):
        ax.add_patch(Circle((x, 0), beta, facecolor=SKY, alpha=0.35, edgecolor="none"))
        ax.add_patch(Circle((x, 0), beta, facecolor="none", edgecolor=BLUE, linewidth=1.4))
    return np.array([(at, -1.0), (at, 1.0)])


def figure_4() -> Figure:
    """The medial axis of three smooth curves (black): green inside, purple outside, where parts of
    it extend to infinity.

    Made by `cl.r_sample` with r = 0.03 and `cl.medial_axis`."""
    curve = shapes.union(
        shapes.spline(HOOK),
        shapes.spline(PEAR).moved(scale=0.95, angle=0.15, offset=(6.3, -0.2)),
        shapes.ellipse(0.62, 0.3).moved(angle=-0.5, offset=(0.35, 2.6)),
    )
    box = box_of(dense_points(curve), 0.08)
    figure, (ax,) = bare_panels(1, box, width=7.6)
    draw_curve(ax, curve)
    draw_axis(ax, curve, 0.03, box)
    show_just(ax, box)
    return figure


def figure_5() -> Figure:
    """The local feature size of p is the distance to m, the nearest point of the medial axis
    (green), not to m′, the center of the largest empty disk that is tangent at p: here 0.57
    and not 0.74.

    Made by `SmoothCurve.medial_axis`, `SmoothCurve.normal`, `SmoothCurve.local_feature_size`."""
    curve, t = shapes.trefoil(4, 0.1).moved(angle=math.pi / 4), 0.6437
    p, far = curve.point(t), tangent_center(curve, t)
    near = nearest_on_axis(curve, p)
    box = (-1.08, -1.14, 1.08, 1.08)
    figure, (ax,) = bare_panels(1, box, width=4.6)
    draw_curve(ax, curve)
    draw_axis(ax, curve, 0.03, box, outer=False)
    radius = math.dist(p, far)
    draw_disk(ax, far, radius, fill=SKY, alpha=0.18)
    draw_disk(ax, far, radius, edge=SKY)
    draw_line(ax, p, far, BLUE, "--")
    draw_line(ax, p, near, VERMILLION, "-", width=2.2)
    draw_dots(ax, [p, far, near])
    write_at(ax, "p", p, (-4, -16))
    write_at(ax, "m′", far, (-24, -6))
    write_at(ax, "m", near, (7, -2))
    lfs = float(curve.local_feature_size(t))
    write_at(ax, f"{lfs:.2f}", (p + near) / 2, (8, -10), VERMILLION)
    write_at(ax, f"{radius:.2f}", (p + far) / 2, (-32, 0), BLUE)
    show_just(ax, box)
    return figure


def figure_6() -> Figure:
    """The 16 points 1-sample both heavy curves, so that no method can be right on both. The light
    lines are the medial axes.

    Made by `shapes.two_octagons`, `shapes.two_octagons_separate`, `shapes.two_octagons_joined`,
    `cl.sampling_ratio`."""
    points = shapes.two_octagons()
    box = box_of(points, 0.06)
    figure, axes = bare_panels(2, box, width=8.6, titled=True)
    both = (shapes.two_octagons_separate(), shapes.two_octagons_joined())
    for ax, curve, count in zip(axes, both, ("two components", "one component"), strict=True):
        draw_curve(ax, curve)
        draw_axis(ax, curve, 0.02, box)
        plot.plot_points(points, ax, size=6.5, color=VERMILLION)
        ratio = cl.sampling_ratio(curve, points)
        ax.set_title(f"{count}: a {ratio:.3f}-sample", size=TEXT)
        show_just(ax, box)
    return figure


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
    figure, (ax,) = bare_panels(1, box, width=5.2)
    ax.add_patch(Arc((0, 1), 2, 2, theta1=195, theta2=345, color=BLUE, linewidth=2))
    draw_line(ax, (-1.15, 0), (1.35, 0), GRAY)
    for q, color in ((s, VERMILLION), (c, BLACK)):
        draw_line(ax, p, q, color)
    draw_line(ax, c, s, BLACK)
    draw_line(ax, s, x, GREEN)
    mark_angle(ax, c, -90, -90 + math.degrees(gamma), 0.3, "γ", 0.38)
    mark_angle(ax, p, 0, math.degrees(alpha), 0.5)
    draw_dots(ax, [p, c, s, x])
    for name, at, offset in (
        ("p", p, (-5, -16)), ("c", c, (-4, 7)), ("s", s, (8, -4)), ("x", x, (-15, -3)),
        ("L", (1.27, 0), (0, 5)), ("1", (p + c) / 2, (-12, 8)), ("1", (c + s) / 2, (6, 4)),
        ("r", (p + s) / 2, (-8, 4)), ("α", (0.53, 0.03), (0, 0)),
    ):  # fmt: skip
        write_at(ax, name, at, offset)
    write_at(ax, "sin γ", (s + x) / 2, (-16, 5), GREEN)
    show_just(ax, box)
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
    figure, (ax,) = bare_panels(1, box, width=5.2)
    draw_disk(ax, p, 1, edge=GRAY)
    draw_disk(ax, v, math.dist(v, s2), fill=SKY, alpha=0.25)
    draw_disk(ax, v, math.dist(v, s2), edge=BLUE)
    draw_disk(ax, p, r, edge=VERMILLION)
    # The curve at its most curved: the tangent circle of radius one below.
    ax.add_patch(Arc((0, -1), 2, 2, theta1=52, theta2=128, color=BLACK, linewidth=2.4))
    for q in (s1, s2, v):
        draw_line(ax, p, q, VERMILLION, width=1.1)
    draw_line(ax, v, s2, BLUE, width=1.1)
    mark_angle(ax, p, -math.degrees(alpha), 90, 0.11, "ψ", 0.17)
    draw_dots(ax, [s1, s2, p, v])
    for name, at, offset, color in (
        ("s₁", s1, (-25, 5), BLACK), ("s₂", s2, (13, 5), BLACK), ("p", p, (-4, -16), BLACK),
        ("v", v, (-4, 7), BLACK), ("r", v / 2, (-11, -2), VERMILLION),
        ("R", (v + s2) / 2, (5, 4), BLUE), ("V", (-0.46, 0.62), (0, 0), BLUE),
        ("B", (-0.06, -0.36), (0, 0), VERMILLION), ("B′", (-0.78, 0.42), (0, 0), "#666666"),
        ("F", (-0.58, -0.27), (0, 0), BLACK),
    ):  # fmt: skip
        write_at(ax, name, at, offset, color)
    show_just(ax, box)
    return figure


def figure_11() -> Figure:
    """Forbidden regions can be defined by β or by φ = arcsin(1/β): the tangents to the two circles
    cross at the angle 2φ. Here β = 1.70.

    Made by `theory.phi`."""
    beta = 1.7
    half = theory.phi(beta)
    box = (-3.15, -1.75, 3.15, 1.75)
    figure, (ax,) = bare_panels(1, box, width=5.6)
    s = _forbidden_region(ax, beta)
    center = np.array([math.sqrt(beta * beta - 1), 0.0])
    ax.plot(*s.T, "-", color=BLACK, linewidth=1.2)
    for sign in (-1, 1):
        along = 1.5 * np.array([sign * math.sin(half), -math.cos(half)])
        draw_line(ax, s[1], s[1] + along, VERMILLION)
    mark_angle(ax, s[1], -90 - math.degrees(half), -90 + math.degrees(half), 0.75)
    write_at(ax, "2φ", s[1] + (-0.9, -0.6), (0, 0), VERMILLION)
    draw_line(ax, center, s[1], BLUE)
    draw_dots(ax, [*s, center])
    write_at(ax, "β d/2", (center + s[1]) / 2, (4, 4), BLUE)
    write_at(ax, "d", (s[0] + s[1]) / 2, (4, -24))
    write_at(ax, "s₁", s[1], (-5, 8))
    write_at(ax, "s₂", s[0], (-5, -17))
    show_just(ax, box)
    return figure


def figure_14() -> Figure:
    """The three conditions of Theorem 20: the β-skeleton is the reconstruction in the shaded
    region, below (1) and above (2) and (3). Its tip is at r = 0.2985, β = 1.694; at β = 1.70 it
    ends at r = 0.2974.

    Made by `theory.phi_below_nonadjacent` (1), `theory.phi_above_neighbors` (2),
    `theory.phi_above_medial_axis` (3), `cl.guaranteed_r`, `theory.best_beta`."""
    figure = new_figure(6.4, 4.6)
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
        write_at(ax, name, (r[at], values[at]), offset, color)
    _mark_best(ax)
    ax.set(xlim=(0, 0.36), ylim=(0, math.pi / 2), xlabel="r", ylabel="φ (radians)")
    open_frame(ax)
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
    box = box_of(points, 0.05)
    figure, axes = bare_panels(3, box, width=9.2, titled=True)
    for ax, edges, other, color, name in (
        (axes[0], crust[:0], crust[:0], BLACK, title),
        (axes[1], crust, skeleton, VERMILLION, "crust"),
        (axes[2], skeleton, crust, PURPLE, "β-skeleton, β = 1.70"),
    ):
        own = ~contained(edges, other)
        plot.plot_edges(points, edges[~own], ax, width=1.6)
        plot.plot_edges(points, edges[own], ax, width=2.2, color=color)
        plot.plot_points(points, ax, size=3.6)
        ax.set_title(name, size=TEXT)
        show_just(ax, box)
    return figure


def figure_15() -> Figure:
    """A point set, its crust (blue), and the corresponding polygonal analog of the medial axis:
    green inside, purple outside.

    Made by `cl.crust`, `cl.medial_axis`."""
    points = cl.r_sample(shapes.spline(LEAF), 0.35, seed=4).points
    edges = cl.crust(points)
    box = box_of(points, 0.06)
    figure, (ax,) = bare_panels(1, box, width=5.6)
    plot.plot_edges(points, edges, ax, width=1.8)
    plot.plot_points(points, ax, size=4.2)
    plot.plot_medial_axis(cl.medial_axis(points, edges), ax)
    show_just(ax, box)
    return figure
