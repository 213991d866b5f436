"""The local feature size LFS (paper, §5): the distance from a point of a curve to the medial axis.

For a smooth curve it is computed here, from the definition. The medial axis is the closure of the
centers of the maximal empty disks; each of them touches the curve at some q. So the axis is traced
by walking q along the curve, and on each side of it the largest empty disk that touches the curve
at q has the curvature

    max over x on the curve of  2 n·(x − q) / |x − q|²,

where n is the unit normal at q to that side; as x → q the fraction tends to the curve's own
curvature, which gives the osculating disks. For samples of an unknown curve `crustline.medial`
estimates it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt

from crustline.errors import InputError
from crustline.scalars import as_rtol
from crustline.shapes import SmoothCurve, refuse_extent

__all__ = ["CurveMedialAxis", "local_feature_size", "medial_axis_of_curve", "nearest_site"]

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]

# The grid on which contacts are sought: its spacing over the radius of the smallest empty disk that
# touches there, the smallest number of its nodes in a loop, and the largest number in all.
RESOLUTION = 0.15
NODES_PER_LOOP = 240
MOST_NODES = 200_000
# A loop of many pieces is looked at this often in each. Of these places it needs as nodes those
# that cut it into turns of so many radians, and those where the curvature jumps or is extreme by
# more than this share.
NODES_PER_PIECE = 24
NODE_TURN = 0.05
# How far in t beside a place the curvature of either side is taken.
BESIDE = 1e-10
BEND_SHARE = 1e-6
# Where contacts no farther apart than this share of the radii have centers far apart, the axis
# between the centers lies along the normal that they share.
SAME_CONTACT = 1e-6
MOST_ROUNDS = 40
TERNARY_ROUNDS = 45
POLISH_ROUNDS = 4
# The search for nearest sites.
SITES_PER_BOX, QUERIES_PER_BOX = 32, 512
# Matrices of distances are made in blocks of this many entries.
BLOCK = 1 << 20


@dataclass(frozen=True, eq=False)
class CurveMedialAxis:
    """The medial axis of a smooth curve, as far as its local feature size depends on it.

    Attributes
    ----------
    vertices : ndarray of float64, shape (v, 2)
        Points of the axis: centers of maximal empty disks.
    radii : ndarray of float64, shape (v,)
        The radii of those disks.
    segments : ndarray of int64, shape (s, 2)
        Rows of `vertices` that follow one another along the axis. The axis between them is near the
        segment.
    error : float
        Bound for the relative error of a distance from the curve to the vertices and segments; 0 if
        the axis is known in closed form.

    Notes
    -----
    Parts of the axis whose disks are larger than half the extent of the curve are left
    out: no point of the curve has its nearest point of the axis there. An interior disk gives each
    point a nearer one.
    """

    vertices: FloatArray
    radii: FloatArray
    segments: IntArray
    error: float

    def distance(self, points: npt.ArrayLike) -> FloatArray:
        """Return the distance from each of points (k, 2) to the axis, shape (k,)."""
        p = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        distance, vertex = nearest_site(p, self.vertices)
        for column in range(2):
            # A vertex begins at most one segment and ends at most one: the two that its walk along
            # the curve links.
            link = np.full(len(self.vertices), -1)
            link[self.segments[:, column]] = self.segments[:, 1 - column]
            other = link[vertex]
            k = np.flatnonzero(other >= 0)
            foot = _distance_to_segments(p[k], self.vertices[vertex[k]], self.vertices[other[k]])
            distance[k] = np.minimum(distance[k], foot)
        return distance


def local_feature_size(
    curve_or_points: SmoothCurve | npt.ArrayLike,
    t_or_edges: npt.ArrayLike,
    *,
    rtol: float = 1e-4,
) -> FloatArray:
    """Return the local feature size: the distance from points of a curve to its medial axis.

    Parameters
    ----------
    curve_or_points : SmoothCurve, or array_like of float, shape (n, 2)
        A known smooth curve, or samples of an unknown one.
    t_or_edges : array_like of float, any shape, or array_like of int, shape (m, 2)
        For a curve: where on it, t in [0, 1). For samples: the edges that reconstruct it.
    rtol : float
        For a curve: the relative error asked for. Not used for samples.

    Returns
    -------
    sizes : ndarray of float64
        For a curve: one for each t, of the shape of t. For samples: one for each point, shape (n,).

    Raises
    ------
    InputError
        If the curve crosses or touches itself.

    Notes
    -----
    For a curve: exact up to rounding for one circle, ellipse or stadium, whose medial
    axes are known; otherwise within `rtol`, see `medial_axis_of_curve`. It is 1-Lipschitz in the
    distance (but not differentiable), never larger than the radius of curvature, and scales with
    the curve. For samples: an estimate, see `crustline.medial.feature_size_of_samples`.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125–135. Sections 4 and 5.

    Examples
    --------
    >>> from crustline.shapes import ellipse
    >>> local_feature_size(ellipse(2, 1), [0, 0.25]).tolist()
    [0.5, 1.0]
    """
    if isinstance(curve_or_points, SmoothCurve):
        t = np.asarray(t_or_edges, dtype=np.float64)
        axis = medial_axis_of_curve(curve_or_points, rtol=rtol)
        return axis.distance(curve_or_points.point(t)).reshape(t.shape)
    from crustline.medial import feature_size_of_samples

    return feature_size_of_samples(curve_or_points, t_or_edges)


def medial_axis_of_curve(curve: SmoothCurve, *, rtol: float = 1e-4) -> CurveMedialAxis:
    """Return the medial axis of a smooth curve, for its local feature size within rtol.

    Parameters
    ----------
    curve : SmoothCurve
        All its components count: the axis runs between them, too.
    rtol : float
        In [1e-6, 0.1]. Bound for the relative error of the distance from the curve to the axis.

    Raises
    ------
    InputError
        If the curve crosses or touches itself, so that its medial axis meets it; if it is not
        finite, or its extent is not between 1e-65 and 1e+65.

    Notes
    -----
    A single circle, ellipse or stadium has its axis in closed form. Otherwise the axis
    is traced by vertices no farther apart than √(8 rtol) times the radii of their disks. The
    nearest point of the axis to a point of the curve is at least that radius away and the line to
    it is perpendicular to the axis (or it is an end of the axis, where vertices crowd), so the
    nearest vertex is within a factor 1 + rtol as long as the axis between two vertices stays within
    the disk on the segment between them; the segments make the error smaller still, in general by
    more than ten times. Features narrower than about 10⁻⁵ of the length of their loop may be
    missed.

    The axis is kept for the next call with the same curve.
    """
    return _axis(curve, as_rtol(rtol))


@lru_cache(maxsize=128)
def _axis(curve: SmoothCurve, rtol: float) -> CurveMedialAxis:
    _refuse_extremes(curve)
    if len(curve.loops) == 1 and curve.loops[0].axis is not None:
        return _known_axis(curve, curve.loops[0].axis)
    return _linked(_traced(*_contact_grid(curve), math.sqrt(8 * rtol)), rtol)


def _refuse_extremes(curve: SmoothCurve) -> None:
    t = np.arange(256 * len(curve.loops)) / (256 * len(curve.loops))
    with np.errstate(all="ignore"):
        points = curve.point(t)
    finite = np.isfinite(points).all(axis=1)
    if not finite.all():
        raise InputError(
            f"the curve's point at t = {t[np.argmin(finite)]:g} is not finite: correct the loop"
        )
    for part in np.split(points, len(curve.loops)):
        refuse_extent(part)


def _known_axis(curve: SmoothCurve, ends: FloatArray) -> CurveMedialAxis:
    radii, _ = nearest_site(ends, curve.point(np.arange(4096) / 4096))
    rows = np.arange(len(ends))
    return CurveMedialAxis(ends, radii, np.stack([rows[:-1], rows[1:]], -1), 0.0)


@dataclass(frozen=True, eq=False)
class _Nodes:
    """Points along the curve in the order of t, for the search for empty disks."""

    curve: SmoothCurve
    t: FloatArray
    loop: IntArray
    point: FloatArray
    normal: FloatArray
    curvature: FloatArray
    following: IntArray  # the row of the next node along the loop

    @cached_property
    def preceding(self) -> IntArray:
        """The row of the node before."""
        preceding = np.empty_like(self.following)
        preceding[self.following] = np.arange(len(preceding))
        return preceding

    def middles(self, rows: IntArray) -> FloatArray:
        """Return t halfway between these nodes and those that follow them."""
        return self.t[rows] + self.steps()[rows] / 2

    def steps(self) -> FloatArray:
        """Return how far on in t the following node is."""
        step = self.t[self.following] - self.t
        return np.where(step > 0, step, step + 1 / len(self.curve.loops))

    def near(self, rows: IntArray, offsets: FloatArray) -> FloatArray:
        """Return t of these nodes plus offsets, within the node's own loop."""
        c, loop = len(self.curve.loops), self.loop[rows].reshape(-1, *[1] * (offsets.ndim - 1))
        local = (self.t[rows].reshape(loop.shape) + offsets) * c - loop
        return np.asarray((loop + local % 1.0) / c)

    def extent(self) -> float:
        """Return the diagonal of the bounding box."""
        return float(np.hypot(*np.ptp(self.point, axis=0)))

    def grain(self) -> float:
        """Return the square of a distance, times a curvature, at which rounding spoils circles."""
        return max(4e-9 * self.extent(), 8e-12 * float(np.abs(self.point).max()))


#: Tells after which nodes, of these disks, another one is needed.
IsWide = Callable[[_Nodes, FloatArray], BoolArray]


def _nodes(curve: SmoothCurve, t: FloatArray) -> _Nodes:
    c = len(curve.loops)
    loop = np.minimum((t * c).astype(np.int64), c - 1)
    following = np.arange(1, len(t) + 1)
    last = np.flatnonzero(np.append(loop[1:] != loop[:-1], True))
    following[last] = np.concatenate([[0], last[:-1] + 1])
    normal = curve.normal(t)
    return _Nodes(curve, t, loop, curve.point(t), normal, curve.curvature(t), following)


def _contact_grid(curve: SmoothCurve) -> tuple[_Nodes, FloatArray]:
    """Return nodes so close that no contact of an empty disk is missed between them, and disks."""
    grid = _nodes(curve, _first_nodes(curve))
    _refuse_crossings(grid)
    grid, _ = _refined(grid, _empty_disks(grid, grid), _may_hide_contacts)
    grid = _nodes(curve, np.union1d(grid.t, _curvature_peaks(grid)))
    while True:
        # A finer grid may show tighter disks at the nodes that it was refined from.
        refined, disks = _refined(grid, _empty_disks(grid, grid), _may_hide_contacts)
        if len(refined.t) == len(grid.t):
            return refined, disks
        grid = refined


def _refined(
    nodes: _Nodes, disks: FloatArray, is_wide: IsWide, grid: _Nodes | None = None
) -> tuple[_Nodes, FloatArray]:
    """Return nodes with more of them wherever they are too wide apart, and the disks of all.

    Contacts of the disks are sought on the grid; if there is none, on the nodes themselves.
    """
    for _ in range(MOST_ROUNDS):
        wide = np.flatnonzero(is_wide(nodes, disks))
        if not len(wide):
            return nodes, disks
        if len(nodes.t) + len(wide) > MOST_NODES:
            break
        t = np.concatenate([nodes.t, nodes.middles(wide)])
        nodes = _nodes(nodes.curve, np.sort(t))
        disks = _with_disks(disks, t, grid or nodes)
    raise _too_fine(nodes.point[int(np.argmax(disks.max(axis=0)))])


def _may_hide_contacts(grid: _Nodes, disks: FloatArray) -> BoolArray:
    """Return whether a contact may be missed between a node and the following one."""
    tight = disks.max(axis=0)
    step = np.hypot(*(grid.point[grid.following] - grid.point).T)
    return np.asarray(step * np.maximum(tight, tight[grid.following]) > RESOLUTION)


def _with_disks(disks: FloatArray, t: FloatArray, grid: _Nodes) -> FloatArray:
    """Return the disks at all of t in its order, (2, k): those given are the first ones'."""
    more = _empty_disks(_nodes(grid.curve, t[disks.shape[1] :]), grid)
    return np.concatenate([disks, more], axis=1)[:, np.argsort(t)]


def _first_nodes(curve: SmoothCurve) -> FloatArray:
    c = len(curve.loops)
    loops = (_first_of_loop(part) for part in curve.components)
    return np.concatenate([(i + u) / c for i, u in enumerate(loops)])


def _first_of_loop(loop: SmoothCurve) -> FloatArray:
    """Return u of the first nodes of a loop."""
    k = max(NODES_PER_LOOP, NODES_PER_PIECE * loop.loops[0].pieces)
    u = np.arange(k) / k
    return u if k == NODES_PER_LOOP else u[_is_node(loop, u)]


def _is_node(loop: SmoothCurve, u: FloatArray) -> BoolArray:
    """Return which of many places along a loop show its length, turns, jumps and bends."""
    _, velocity, _ = loop.derivatives(u)
    ahead = np.roll(velocity, -1, axis=0)
    cross = velocity[:, 0] * ahead[:, 1] - velocity[:, 1] * ahead[:, 0]
    turn = np.abs(np.arctan2(cross, np.sum(velocity * ahead, axis=1)))
    length = np.hypot(*velocity.T) / len(u)
    weight = turn / NODE_TURN + NODES_PER_LOOP * length / length.sum()
    # The step from each place to the next one, and what has gone before it.
    before = np.concatenate([[0.0], np.cumsum(weight)])
    crossed = np.diff(np.floor(before), prepend=-1.0)[:-1] > 0
    wide = weight > 1
    bends = _bends(loop, u, float(length.sum()))
    return np.asarray(crossed | wide | np.roll(wide, 1) | bends)


def _bends(loop: SmoothCurve, u: FloatArray, length: float) -> BoolArray:
    """Return at which places the curvature jumps or is extreme, but for small shares."""
    # Beside the places, for at a joint of pieces the curvature is that of one of the two.
    left, right = loop.curvature(u - BESIDE), loop.curvature(u + BESIDE)
    small = BEND_SHARE * (np.abs(left) + np.abs(right) + 1 / length)
    rise, fall = left - np.roll(right, 1), np.roll(left, -1) - right
    extreme = (rise * fall <= 0) & (np.maximum(np.abs(rise), np.abs(fall)) > small)
    return np.asarray(extreme | (np.abs(right - left) > small))


def _curvature_peaks(grid: _Nodes) -> FloatArray:
    """Return t of the local extrema of the curvature, where the axis ends and turns back."""
    rows, signs = [], []
    for sign in (1.0, -1.0):
        k = sign * grid.curvature
        top = np.flatnonzero((k >= k[grid.preceding]) & (k > k[grid.following]))
        rows.append(top)
        signs.append(np.full(len(top), sign))
    j, sign_of = np.concatenate(rows), np.concatenate(signs)
    steps = grid.steps()
    low, high = -steps[grid.preceding[j]], steps[j]
    for _ in range(TERNARY_ROUNDS):
        third = (high - low) / 3
        bend = [
            sign_of * grid.curve.curvature(grid.near(j, x)) for x in (low + third, high - third)
        ]
        rising = bend[0] < bend[1]
        low, high = np.where(rising, low + third, low), np.where(rising, high, high - third)
    return grid.near(j, (low + high) / 2)


def _traced(grid: _Nodes, disks: FloatArray, gap: float) -> tuple[_Nodes, FloatArray]:
    """Return nodes and curvatures (2, k) of their disks, centers at most gap radii apart."""

    def are_far_apart(nodes: _Nodes, disks: FloatArray) -> BoolArray:
        left, right = (_far_apart(nodes, disks[k], sign, gap) for k, sign in ((0, 1), (1, -1)))
        return left | right

    return _refined(grid, disks, are_far_apart, grid)


def _far_apart(nodes: _Nodes, disks: FloatArray, side: int, gap: float) -> BoolArray:
    """Return whether the axis between a center and the following one needs a vertex."""
    center, radius = _centers(nodes, disks, side)
    step = np.hypot(*(center[nodes.following] - center).T)
    least = np.minimum(radius, radius[nodes.following])
    apart = np.hypot(*(nodes.point[nodes.following] - nodes.point).T) > SAME_CONTACT * least
    one = np.isfinite(radius) ^ np.isfinite(radius[nodes.following])
    both = np.isfinite(radius + radius[nodes.following])
    # A disk beyond half the extent matters to no point, so where the axis runs off its end may stay
    # rough.
    wide = both & apart & (step > gap * least)
    return np.asarray(wide | (one & (least < 0.6 * nodes.extent())))


def _centers(nodes: _Nodes, disks: FloatArray, side: int) -> tuple[FloatArray, FloatArray]:
    """Return centers on one side and radii, infinite where a disk is too large to matter."""
    matters = disks * nodes.extent() > 1
    radius = np.where(matters, 1 / np.where(matters, disks, 1.0), np.inf)
    reach = np.where(matters, side * radius, 0.0)
    return nodes.point + reach[:, None] * nodes.normal, radius


def _linked(traced: tuple[_Nodes, FloatArray], rtol: float) -> CurveMedialAxis:
    """Return the axis with one vertex for each disk, linked along the curve."""
    nodes, disks = traced
    vertices, radii, segments, count = [], [], [], 0
    for side, curvature in zip((1, -1), disks, strict=True):
        center, radius = _centers(nodes, curvature, side)
        kept = np.isfinite(radius)
        row = count + np.cumsum(kept) - 1
        linked = kept & kept[nodes.following]
        segments.append(np.stack([row[linked], row[nodes.following[linked]]], -1))
        vertices.append(center[kept])
        radii.append(radius[kept])
        count += int(kept.sum())
    joined = np.concatenate(vertices), np.concatenate(radii), np.concatenate(segments)
    return CurveMedialAxis(*joined, error=rtol)


def _empty_disks(nodes: _Nodes, grid: _Nodes) -> FloatArray:
    """Return the curvature of the largest empty disk at each node, left and right, (2, k)."""
    # Where the curvature jumps, the osculating disks of both sides count.
    every = np.arange(len(nodes.t))
    beside = [
        nodes.curve.curvature(nodes.near(every, np.full(len(every), e))) for e in (-BESIDE, BESIDE)
    ]
    either = np.stack([nodes.curvature, *beside])
    out = np.stack([either.max(axis=0), -either.min(axis=0)])
    # Just beside a jump the tightest circle passes a point at some small distance, of any order of
    # magnitude.
    scales = 0.5 ** np.arange(6, 26) / len(nodes.curve.loops)
    offsets = np.concatenate([-scales, scales])
    size = grid.extent(), grid.grain()
    rows = max(1, BLOCK // len(grid.t))
    for start in range(0, len(nodes.t), rows):
        block = slice(start, start + rows)
        own = np.arange(len(nodes.t))[block]
        around = nodes.curve.point(nodes.near(own, np.tile(offsets, (len(own), 1))))
        g, close = (_touching(nodes, x, block, size) for x in (grid.point[None], around))
        for side, sign in enumerate((1.0, -1.0)):
            best = _best_contacts(nodes, grid, sign * g, sign, block, size)
            best = np.maximum(best, (sign * close).max(axis=1))
            out[side, block] = np.maximum(out[side, block], best)
    return out


def _touching(nodes: _Nodes, x: FloatArray, rows: slice, size: tuple[float, float]) -> FloatArray:
    """Return the signed curvature of the circles that touch at nodes and pass x (r, k, 2).

    `size` is the extent and the grain of the whole curve: a single node has none.
    """
    extent, grain = size
    p = nodes.point[rows, None]
    dx, dy = x[..., 0] - p[..., 0], x[..., 1] - p[..., 1]
    square = dx * dx + dy * dy
    normal, curvature = nodes.normal[rows, None], nodes.curvature[rows, None]
    # Nearer to the node than this, rounding spoils the fraction; its limit is the curvature.
    near = square < grain / np.maximum(np.abs(curvature), 1 / extent)
    height = normal[..., 0] * dx + normal[..., 1] * dy
    return np.where(near, curvature, 2 * height / np.where(near, 1.0, square))


def _best_contacts(
    nodes: _Nodes,
    grid: _Nodes,
    g: FloatArray,
    sign: float,
    rows: slice,
    size: tuple[float, float],
) -> FloatArray:
    """Return the largest touching curvature, from its signed values g at the grid."""
    peaks = np.where(_is_peak(g, grid.following), g, -np.inf)
    best = np.full(len(g), -np.inf)
    every = np.arange(len(g))
    # The two highest peaks between grid nodes: which one is higher may be decided only there.
    for _ in range(2):
        j = np.argmax(peaks, axis=1)
        best = np.maximum(best, _polished(nodes, grid, j, sign, rows, size))
        peaks[every, j] = -np.inf
    return best


def _is_peak(g: FloatArray, following: IntArray) -> BoolArray:
    """Return where rows of g are no lower than at the nodes before and after, along each loop."""
    ahead, back = np.empty(g.shape, dtype=np.bool_), np.empty(g.shape, dtype=np.bool_)
    ahead[:, :-1], back[:, 1:] = g[:, :-1] >= g[:, 1:], g[:, 1:] >= g[:, :-1]
    last = np.flatnonzero(following != np.arange(1, len(following) + 1))
    first = following[last]
    ahead[:, last], back[:, first] = g[:, last] >= g[:, first], g[:, first] >= g[:, last]
    return ahead & back


def _polished(
    nodes: _Nodes,
    grid: _Nodes,
    j: IntArray,
    sign: float,
    rows: slice,
    size: tuple[float, float],
) -> FloatArray:
    """Return the top of the peak at grid nodes j.

    Each round tries the top of the parabola through three points, and closes in on the best of the
    four. Where the curvature jumps the peak is a kink, which no parabola finds: so there are
    several rounds.
    """
    steps, best_at = grid.steps(), np.zeros(len(j))
    low, high = -steps[grid.preceding[j]], steps[j]
    best = np.full(len(j), -np.inf)
    every = np.arange(len(j))
    for _ in range(POLISH_ROUNDS):
        x = best_at[:, None] + np.stack([low, 0 * low, high], -1)
        f = sign * _touching(nodes, grid.curve.point(grid.near(j, x)), rows, size)
        top = best_at + np.clip(_parabola_top(low, high, f), low, high)
        g = sign * _touching(nodes, grid.curve.point(grid.near(j, top[:, None])), rows, size)
        x, f = np.column_stack([x, top]), np.column_stack([f, g])
        highest = np.argmax(f, axis=1)
        best_at, best = x[every, highest], np.maximum(best, f[every, highest])
        low, high = low / 4, high / 4
    return best


def _parabola_top(low: FloatArray, high: FloatArray, f: FloatArray) -> FloatArray:
    """Return where the parabola through (low, f0), (0, f1), (high, f2) is highest, or 0."""
    left, right = (f[:, 0] - f[:, 1]) / low, (f[:, 2] - f[:, 1]) / high
    bend = (right - left) / (high - low)
    down = bend < 0
    top = (left * high - right * low) / (high - low)
    return np.where(down, -top / np.where(down, 2 * bend, 1.0), 0.0)


def _refuse_crossings(grid: _Nodes) -> None:
    """Refuse a curve whose polygon of nodes crosses itself."""
    a, b = grid.point, grid.point[grid.following]
    every = np.arange(len(a))
    rows = max(1, BLOCK // len(a))
    for start in range(0, len(a), rows):
        p, q = a[start : start + rows, None], b[start : start + rows, None]
        across = (_side(p, q, a) > 0) != (_side(p, q, b) > 0)
        across &= (_side(a, b, p) > 0) != (_side(a, b, q) > 0)
        # A segment does not cross itself, the one that follows it or the one before it.
        here = np.arange(start, start + len(p))
        across &= (grid.following[here][:, None] != every) & (here[:, None] != grid.following)
        across &= here[:, None] != every
        if across.any():
            raise _touches_itself(p[int(np.argmax(across.any(axis=1))), 0])


def _side(p: FloatArray, q: FloatArray, x: FloatArray) -> FloatArray:
    d, e = q - p, x - p
    return np.asarray(d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0])


def _touches_itself(point: FloatArray) -> InputError:
    return InputError(
        f"the curve crosses or touches itself near ({point[0]:g}, {point[1]:g}): "
        "a smooth curve has no crossings, so its local feature size is not defined there"
    )


def _too_fine(point: FloatArray) -> InputError:
    return InputError(
        f"the curve crosses or touches itself near ({point[0]:g}, {point[1]:g}), or nearly: "
        "give a curve whose features are larger beside its length"
    )


def nearest_site(queries: FloatArray, sites: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the distance from queries (k, 2) to the nearest of sites (n, 2), and its row.

    Notes
    -----
    Exact up to rounding; of equally near sites, one. Sites are put into boxes, and so are queries:
    those of one box regard only the boxes of sites that may hold the nearest one.
    """
    boxes = _boxes(sites, SITES_PER_BOX)
    low, high = _corners(sites, boxes)
    distance, row = np.empty(len(queries)), np.empty(len(queries), dtype=np.int64)
    for group in _boxes(queries, QUERIES_PER_BOX):
        near = _boxes_in_reach(queries[group], low, high)
        few = [boxes[j] for j in near]
        step = max(1, BLOCK // len(near))
        for part in (group[start : start + step] for start in range(0, len(group), step)):
            found = _nearest_in_boxes(queries[part], sites, few, low[near], high[near])
            distance[part], row[part] = found
    return np.sqrt(distance), row


def _boxes(points: FloatArray, size: int) -> list[IntArray]:
    """Return the rows of points in boxes of about `size`: strips by x, each cut by y."""
    count = max(1, len(points) // size)
    strips = np.array_split(np.argsort(points[:, 0], kind="stable"), max(1, math.isqrt(count)))
    cuts = -(-count // len(strips))
    boxes = (
        box
        for strip in strips
        for box in np.array_split(strip[np.argsort(points[strip, 1], kind="stable")], cuts)
    )
    return [box for box in boxes if len(box)]


def _corners(points: FloatArray, boxes: list[IntArray]) -> tuple[FloatArray, FloatArray]:
    """Return the least and the largest coordinates in each box, (b, 2)."""
    starts = np.cumsum([0] + [len(box) for box in boxes[:-1]])
    ordered = points[np.concatenate(boxes)]
    return np.minimum.reduceat(ordered, starts), np.maximum.reduceat(ordered, starts)


def _boxes_in_reach(q: FloatArray, low: FloatArray, high: FloatArray) -> IntArray:
    """Return the boxes that may hold the nearest site of one of the queries."""
    least, most = q.min(axis=0), q.max(axis=0)
    gap = np.maximum(np.maximum(low - most, least - high), 0)
    reach = np.maximum(most - low, high - least)
    limit = float((reach[:, 0] ** 2 + reach[:, 1] ** 2).min()) * (1 + 1e-12)
    return np.flatnonzero(gap[:, 0] ** 2 + gap[:, 1] ** 2 <= limit)


def _nearest_in_boxes(
    q: FloatArray, sites: FloatArray, boxes: list[IntArray], low: FloatArray, high: FloatArray
) -> tuple[FloatArray, IntArray]:
    """Return squared distances and rows, with the boxes that come too late skipped."""
    x, y = q[:, 0, None], q[:, 1, None]
    below = [np.maximum(np.maximum(low[:, c] - v, v - high[:, c]), 0) for c, v in ((0, x), (1, y))]
    above = [np.maximum(v - low[:, c], high[:, c] - v) for c, v in ((0, x), (1, y))]
    nearest = below[0] ** 2 + below[1] ** 2
    best = (above[0] ** 2 + above[1] ** 2).min(axis=1)
    best *= 1 + 1e-12
    row = np.zeros(len(q), dtype=np.int64)
    for j, box in enumerate(boxes):
        k = np.flatnonzero(nearest[:, j] <= best)
        if not len(k):
            continue
        square = (x[k] - sites[box, 0]) ** 2 + (y[k] - sites[box, 1]) ** 2
        near = np.argmin(square, axis=1)
        found = square[np.arange(len(k)), near]
        better = found < best[k]
        best[k[better]], row[k[better]] = found[better], box[near[better]]
    return best, row


def _distance_to_segments(p: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    d, e = b - a, p - a
    square = d[:, 0] ** 2 + d[:, 1] ** 2
    along = (d[:, 0] * e[:, 0] + d[:, 1] * e[:, 1]) / np.where(square > 0, square, 1.0)
    foot = a + np.clip(along, 0.0, 1.0)[:, None] * d
    return np.hypot(p[:, 0] - foot[:, 0], p[:, 1] - foot[:, 1])
