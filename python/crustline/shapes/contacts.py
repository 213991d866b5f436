"""Where the largest empty disks that touch a smooth curve touch it again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.errors import InputError
from crustline.shapes.curve import SmoothCurve
from crustline.shapes.nearest import BLOCK

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
MOST_ROUNDS = 40
TERNARY_ROUNDS = 45
POLISH_ROUNDS = 4


@dataclass(frozen=True, eq=False)
class Nodes:
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
IsWide = Callable[[Nodes, FloatArray], BoolArray]


def _nodes(curve: SmoothCurve, t: FloatArray) -> Nodes:
    c = len(curve.loops)
    loop = np.minimum((t * c).astype(np.int64), c - 1)
    following = np.arange(1, len(t) + 1)
    last = np.flatnonzero(np.append(loop[1:] != loop[:-1], True))
    following[last] = np.concatenate([[0], last[:-1] + 1])
    normal = curve.normal(t)
    return Nodes(curve, t, loop, curve.point(t), normal, curve.curvature(t), following)


def contact_grid(curve: SmoothCurve) -> tuple[Nodes, FloatArray]:
    """Return nodes so close that no contact of an empty disk is missed between them, and disks."""
    grid = _nodes(curve, _first_nodes(curve))
    _refuse_crossings(grid)
    grid, _ = refined(grid, _empty_disks(grid, grid), _may_hide_contacts)
    grid = _nodes(curve, np.union1d(grid.t, _curvature_peaks(grid)))
    while True:
        # A finer grid may show tighter disks at the nodes that it was refined from.
        finer, disks = refined(grid, _empty_disks(grid, grid), _may_hide_contacts)
        if len(finer.t) == len(grid.t):
            return finer, disks
        grid = finer


def refined(
    nodes: Nodes, disks: FloatArray, is_wide: IsWide, grid: Nodes | None = None
) -> tuple[Nodes, FloatArray]:
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


def _may_hide_contacts(grid: Nodes, disks: FloatArray) -> BoolArray:
    """Return whether a contact may be missed between a node and the following one."""
    tight = disks.max(axis=0)
    step = np.hypot(*(grid.point[grid.following] - grid.point).T)
    return np.asarray(step * np.maximum(tight, tight[grid.following]) > RESOLUTION)


def _with_disks(disks: FloatArray, t: FloatArray, grid: Nodes) -> FloatArray:
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


def _curvature_peaks(grid: Nodes) -> FloatArray:
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


def _empty_disks(nodes: Nodes, grid: Nodes) -> FloatArray:
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


def _touching(nodes: Nodes, x: FloatArray, rows: slice, size: tuple[float, float]) -> FloatArray:
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
    nodes: Nodes,
    grid: Nodes,
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
    nodes: Nodes,
    grid: Nodes,
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


def _refuse_crossings(grid: Nodes) -> None:
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
