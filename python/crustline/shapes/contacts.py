"""The largest empty disks that touch a smooth curve at places along it, and what they touch there.

A disk that touches the curve at one node and meets another, with no node inside, is an empty disk
of all nodes: so the two are neighbors in their Delaunay triangulation, and only neighbors, and
theirs, are looked at. Between two nodes the contact is found by parabolas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray
from crustline.delaunay import Delaunay
from crustline.errors import InputError
from crustline.shapes.curve import SmoothCurve
from crustline.shapes.nodes import Nodes, nodes_at, refuse_crossings
from crustline.shapes.progress import tell

# The grid on which contacts are sought: its spacing over the radius of the smallest empty disk that
# touches there, the smallest number of its nodes in a loop, and the largest number in all, for each
# piece of a loop and besides.
RESOLUTION = 0.15
NODES_PER_LOOP = 240
MOST_NODES_PER_PIECE, MOST_NODES = 20_000, 200_000
# A loop of many pieces is looked at this often in each. Of these places it needs as nodes those
# that cut it into turns of so many radians, and those where the curvature jumps or is extreme by
# more than this share.
NODES_PER_PIECE = 24
NODE_TURN = 0.05
# How far in u beside a place the curvature of either side is taken.
BESIDE = 1e-10
BEND_SHARE = 1e-6
# Just beside a jump of the curvature the tightest circle passes a point at some small distance in
# u, of any order of magnitude.
SMALL = 0.5 ** np.arange(6, 26)
MOST_ROUNDS = 40
TERNARY_ROUNDS = 45
POLISH_ROUNDS = 4
# Nodes whose neighbors are looked at together.
BLOCK = 1 << 13

#: Tells after which nodes, of these disks, another one is needed.
IsWide = Callable[[Nodes, FloatArray], BoolArray]


def contact_grid(curve: SmoothCurve) -> tuple[Nodes, FloatArray]:
    """Return nodes so close that no contact of an empty disk is missed between them, and disks."""
    grid = _first_nodes(curve)
    refuse_crossings(grid)
    grid, _ = refined(grid, _all_disks(grid), _may_hide_contacts)
    grid, _ = grid.joined(*_curvature_peaks(grid))
    while True:
        # A finer grid may show tighter disks at the nodes that it was refined from.
        finer, disks = refined(grid, _all_disks(grid), _may_hide_contacts)
        if len(finer) == len(grid):
            return finer, disks
        grid = finer


def _all_disks(nodes: Nodes) -> FloatArray:
    return _empty_disks(nodes, np.arange(len(nodes)))


def refined(nodes: Nodes, disks: FloatArray, is_wide: IsWide) -> tuple[Nodes, FloatArray]:
    """Return nodes with more of them wherever they are too wide apart, and the disks of all."""
    pieces = sum(loop.pieces for loop in nodes.curve.loops)
    for _ in range(MOST_ROUNDS):
        wide = np.flatnonzero(is_wide(nodes, disks))
        tell("axis", 1 - len(wide) / len(nodes))
        if not len(wide):
            return nodes, disks
        if len(nodes) + len(wide) > MOST_NODES + pieces * MOST_NODES_PER_PIECE:
            break
        known = disks
        nodes, new = nodes.halved(wide)
        disks = np.empty((2, len(nodes)))
        disks[:, np.delete(np.arange(len(nodes)), new)] = known
        disks[:, new] = _empty_disks(nodes, new)
    raise _too_fine(nodes.point[int(np.argmax(disks.max(axis=0)))])


def _may_hide_contacts(grid: Nodes, disks: FloatArray) -> BoolArray:
    """Return whether a contact may be missed between a node and the following one."""
    tight = disks.max(axis=0)
    step = np.hypot(*(grid.point[grid.following] - grid.point).T)
    return np.asarray(step * np.maximum(tight, tight[grid.following]) > RESOLUTION)


# --- The first nodes ----------------------------------------------------------------------------


def _first_nodes(curve: SmoothCurve) -> Nodes:
    places = [_first_of_loop(part) for part in curve.components]
    loop = np.repeat(np.arange(len(places)), [len(u) for u in places])
    return nodes_at(curve, loop, np.concatenate(places))


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


def _curvature_peaks(grid: Nodes) -> tuple[IntArray, FloatArray]:
    """Return the loop and u of the extrema of the curvature, where the axis ends and turns back."""
    rows, signs = [], []
    for sign in (1.0, -1.0):
        k = sign * grid.curvature
        top = np.flatnonzero((k >= k[grid.preceding]) & (k > k[grid.following]))
        rows.append(top)
        signs.append(np.full(len(top), sign))
    j, sign_of = np.concatenate(rows), np.concatenate(signs)
    low, high = -grid.steps[grid.preceding[j]], grid.steps[j]
    for _ in range(TERNARY_ROUNDS):
        third = (high - low) / 3
        inner = np.stack([low + third, high - third], -1)
        left, right = sign_of * grid.curvatures_near(j, inner).T
        rising = left < right
        low, high = np.where(rising, inner[:, 0], low), np.where(rising, high, inner[:, 1])
    return grid.loop[j], (grid.u[j] + (low + high) / 2) % 1.0


# --- Empty disks --------------------------------------------------------------------------------


def _empty_disks(nodes: Nodes, rows: IntArray) -> FloatArray:
    """Return the curvature of the largest empty disks at nodes, left and right, (2, k)."""
    out = np.empty((2, len(rows)))
    near = _Neighbors(nodes)
    for start in range(0, len(rows), BLOCK):
        part = slice(start, start + BLOCK)
        out[:, part] = np.maximum(
            _small_disks(nodes, rows[part]), _large_disks(nodes, near, rows[part])
        )
    return out


def _small_disks(nodes: Nodes, rows: IntArray) -> FloatArray:
    """Return the curvature of the tightest disks that the curve beside nodes allows, (2, k)."""
    # Where the curvature jumps, the osculating disks of both sides count.
    beside = nodes.curvatures_near(rows, np.tile([-BESIDE, BESIDE], (len(rows), 1)))
    around = nodes.points_near(rows, np.tile(np.append(-SMALL, SMALL), (len(rows), 1)))
    g = _touching(nodes, np.repeat(rows, around.shape[1]), around.reshape(-1, 2))
    every = np.column_stack([nodes.curvature[rows], beside, g.reshape(len(rows), -1)])
    return np.stack([every.max(axis=1), -every.min(axis=1)])


def _large_disks(nodes: Nodes, near: _Neighbors, rows: IntArray) -> FloatArray:
    """Return the curvature of the disks that touch at nodes and at another place, (2, k)."""
    owner, other = near.two_rings(rows)
    touching = [
        _touching(nodes, rows[owner], nodes.point[j])
        for j in (other, nodes.preceding[other], nodes.following[other])
    ]
    out = np.full((2, len(rows)), -np.inf)
    for side, sign in enumerate((1.0, -1.0)):
        g, before, after = (sign * each for each in touching)
        peaks = np.flatnonzero((g >= before) & (g >= after))
        # The two highest peaks between nodes: which one is higher may be decided only there.
        for k in _two_highest(owner[peaks], g[peaks]):
            at = peaks[k]
            top = _polished(nodes, rows[owner[at]], other[at], sign)
            out[side, owner[at]] = np.maximum(out[side, owner[at]], top)
    return out


def _two_highest(owner: IntArray, g: FloatArray) -> Iterator[IntArray]:
    """Yield where each owner has its highest value, then where it has the next."""
    order = np.lexsort((-g, owner))
    first = np.diff(owner[order], prepend=-1) > 0
    yield order[first]
    yield order[1:][first[:-1] & ~first[1:]]


class _Neighbors:
    """The neighbors of nodes in their Delaunay triangulation."""

    def __init__(self, nodes: Nodes) -> None:
        delaunay = Delaunay(nodes.point)
        # A repeated point is the neighbor of the first of its kind.
        pairs = np.concatenate([delaunay.edges, np.sort(delaunay.duplicates, axis=1)])
        both = np.concatenate([pairs, pairs[:, ::-1]])
        self._others = both[np.argsort(both[:, 0], kind="stable"), 1]
        self._starts = np.searchsorted(np.sort(both[:, 0]), np.arange(len(nodes) + 1))

    def two_rings(self, rows: IntArray) -> tuple[IntArray, IntArray]:
        """Return pairs of positions in `rows` and nodes: their neighbors, and theirs in turn."""
        first, ring = self._of(np.arange(len(rows)), rows)
        second, outer = self._of(first, ring)
        owner, other = np.append(first, second), np.append(ring, outer)
        away = other != rows[owner]
        count = len(self._starts)
        pairs = np.sort(owner[away] * count + other[away])
        pairs = pairs[np.diff(pairs, prepend=-1) > 0]
        return pairs // count, pairs % count

    def _of(self, owner: IntArray, rows: IntArray) -> tuple[IntArray, IntArray]:
        """Return the neighbors of each row, and its owner once for each."""
        counts = self._starts[rows + 1] - self._starts[rows]
        firsts = np.repeat(self._starts[rows] - (np.cumsum(counts) - counts), counts)
        return np.repeat(owner, counts), self._others[firsts + np.arange(len(firsts))]


def _touching(nodes: Nodes, rows: IntArray, x: FloatArray) -> FloatArray:
    """Return the signed curvature of the circles that touch at nodes (k,) and pass x (k, 2)."""
    d = x - nodes.point[rows]
    square = d[:, 0] ** 2 + d[:, 1] ** 2
    normal, curvature = nodes.normal[rows], nodes.curvature[rows]
    # Nearer to the node than this, rounding spoils the fraction; its limit is the curvature.
    near = square < nodes.grain / np.maximum(np.abs(curvature), 1 / nodes.extent)
    height = normal[:, 0] * d[:, 0] + normal[:, 1] * d[:, 1]
    return np.where(near, curvature, 2 * height / np.where(near, 1.0, square))


def _polished(nodes: Nodes, rows: IntArray, j: IntArray, sign: float) -> FloatArray:
    """Return the tops of the peaks at nodes j of the curvature of circles that touch at others.

    Each round tries the top of the parabola through three points, and closes in on the best of the
    four. Where the curvature jumps the peak is a kink, which no parabola finds: so there are
    several rounds.
    """

    def touching(offsets: FloatArray) -> FloatArray:
        points = nodes.points_near(j, offsets).reshape(-1, 2)
        values = _touching(nodes, np.repeat(rows, offsets.shape[1]), points)
        return sign * values.reshape(offsets.shape)

    low, high, best_at = -nodes.steps[nodes.preceding[j]], nodes.steps[j], np.zeros(len(j))
    best, every = np.full(len(j), -np.inf), np.arange(len(j))
    for _ in range(POLISH_ROUNDS):
        x = best_at[:, None] + np.stack([low, 0 * low, high], -1)
        f = touching(x)
        top = best_at + np.clip(_parabola_top(low, high, f), low, high)
        x, f = np.column_stack([x, top]), np.column_stack([f, touching(top[:, None])])
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


def _too_fine(point: FloatArray) -> InputError:
    return InputError(
        f"the curve crosses or touches itself near ({point[0]:g}, {point[1]:g}), or nearly: "
        "give a curve whose features are larger beside its length"
    )
