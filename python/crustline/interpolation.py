"""C2 cubics through many runs of places at once, with a middle between each two places.

A cubic through the places alone cannot show a curvature that rises and falls within two intervals.
So first the middle of every interval is estimated: on the quintic spline by arc length, whose error
is of the sixth order; where the curvature jumps, as from a line to an arc, on the circle through
three places of one side. A cubic spline through places and middles then has half the step.

No loop runs over places, runs or curves: the equations of all are solved at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from crustline.arrays import BoolArray, FloatArray, IntArray

__all__ = ["Runs", "arc_lengths", "cubics", "middles"]

_DEGREE = 5
#: How nearly curvatures must agree with a jump between two constants, as a share of the jump.
_JUMP_TOLERANCE = 0.05
#: Arcs longer by a sixth than their chords are no longer believed: those of half circles.
_MOST_BEND = 4.0
#: Intervals as shares of the longest near by: shorter ones would make the equations singular.
_SHORTEST = 2.0**-16


@dataclass(frozen=True, eq=False)
class Runs:
    """Nodes in runs; an interval is named by the node it starts at.

    Attributes
    ----------
    starts : ndarray of int64, shape (r + 1,)
        Run number i has the nodes starts[i] to starts[i + 1] - 1. None is empty.
    closed : ndarray of bool, shape (r,)
        Whether the last node of a run is followed by its first.
    """

    starts: IntArray
    closed: BoolArray

    @cached_property
    def counts(self) -> IntArray:
        return np.diff(self.starts)

    @cached_property
    def run(self) -> IntArray:
        """The run of each node."""
        return np.repeat(np.arange(len(self.counts)), self.counts)

    @cached_property
    def position(self) -> IntArray:
        """The number of each node within its run."""
        return np.arange(len(self.run)) - self.starts[self.run]

    def shifted(self, steps: int) -> IntArray:
        """Return the node so many steps on, going round; `reaches` tells if it is there."""
        return self.starts[self.run] + (self.position + steps) % self.counts[self.run]

    def reaches(self, steps: int) -> BoolArray:
        """Return whether a run has a node so many steps on."""
        place = self.position + steps
        return self.closed[self.run] | ((place >= 0) & (place < self.counts[self.run]))

    @cached_property
    def leads(self) -> BoolArray:
        """Whether an interval starts at each node: not at the last ones of open runs."""
        return self.reaches(1)

    def halved(self) -> tuple[Runs, IntArray]:
        """Return runs with another node in every interval, and which of (2 n) nodes those are.

        The nodes are numbered as if each were followed by a middle, the last ones too.
        """
        kept = np.flatnonzero(np.column_stack([np.ones(len(self.leads), bool), self.leads]))
        starts = np.append(0, np.cumsum(2 * self.counts - ~self.closed))
        return Runs(starts, self.closed), kept

    def cut(self, intervals: BoolArray) -> tuple[Runs, IntArray]:
        """Return the runs without some intervals, and the nodes in their new order."""
        cut = np.flatnonzero(intervals)
        broken, number = np.unique(self.run[cut], return_index=True)
        first = np.zeros(len(self.counts), np.int64)  # a ring starts anew behind its first cut
        first[broken] = np.where(self.closed[broken], self.position[cut[number]] + 1, 0)
        order = self.starts[self.run] + (self.position + first[self.run]) % self.counts[self.run]
        starts = np.unique(np.concatenate([self.starts, np.flatnonzero(intervals[order]) + 1]))
        closed = self.closed.copy()
        closed[broken] = False
        return Runs(starts, closed[self.run[order[starts[:-1]]]]), order

    def chosen(self, which: BoolArray) -> tuple[Runs, IntArray]:
        """Return some of the runs, and the nodes of them."""
        starts = np.append(0, np.cumsum(self.counts[which]))
        return Runs(starts, self.closed[which]), np.flatnonzero(which[self.run])


# --- Arc lengths and jumps of the curvature -----------------------------------------------------


def arc_lengths(runs: Runs, places: FloatArray) -> FloatArray:
    """Return an estimate of the arc length of each interval, shape (n,); 0 where there is none.

    As if the curvature changed linearly from node to node; of the sixth order in the chord then.
    """
    chords = np.where(runs.leads, _size(places[runs.shifted(1)] - places), 0.0)
    here = _curvatures(runs, places)
    there = here[runs.shifted(1)]
    bend = (here * here + here * there + there * there) * (chords * chords / 3)
    return chords * (1 + np.minimum(bend, _MOST_BEND) / 24)


def _curvatures(runs: Runs, places: FloatArray) -> FloatArray:
    """Return that of the circle through each node and its neighbors; ends have their neighbor's."""
    inner = runs.reaches(-1) & runs.reaches(1)
    source = np.arange(len(places))
    for steps in (-1, 1):
        source = np.where(runs.reaches(-steps), source, runs.shifted(steps))
    curvature = _circles(places[runs.shifted(-1)], places, places[runs.shifted(1)])
    return np.where(inner, curvature, 0.0)[source]


def _circles(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Return the signed curvature of the circles through three points each."""
    one, other, whole = b - a, c - b, c - a
    product = _size(one) * _size(other) * _size(whole)
    twice = 2 * (one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
    with np.errstate(all="ignore"):
        curvature: FloatArray = np.where(product > 0, twice / product, 0.0)
    return curvature


def _jumps(runs: Runs, places: FloatArray, widths: FloatArray) -> BoolArray:
    """Return the intervals within which the curvature jumps from one constant to another.

    The circle through three nodes has the curvature's mean, weighted by a hat over them. Of a jump
    of height d, a share of the square of how far it lies inside of the hat is seen by the circles
    about both ends of its interval: both tell where in the interval it is. Four more circles, two
    on each side, tell if the curvature is constant there.
    """
    mean = _curvatures(runs, places)
    before, after = widths[runs.shifted(-1)], widths[runs.shifted(1)]
    far, left, first, last, right, beyond = (mean[runs.shifted(k)] for k in range(-2, 4))
    jump = right - left
    with np.errstate(all="ignore"):
        ahead = np.sqrt((first - left) / jump * widths * (before + widths))
        behind = np.sqrt((right - last) / jump * widths * (widths + after))
        fits = np.abs(ahead + behind - widths) < _JUMP_TOLERANCE * widths
    constant = np.maximum(np.abs(far - left), np.abs(right - beyond)) < _JUMP_TOLERANCE * np.abs(
        jump
    )
    enough = (runs.counts >= 8)[runs.run] & runs.reaches(-3) & runs.reaches(4)
    return fits & constant & enough


def _one_sided(
    runs: Runs, places: FloatArray, widths: FloatArray, intervals: IntArray
) -> FloatArray:
    """Return the middles of intervals on the circle through three nodes on one side of each.

    The circle of the other side misses the near end by more: the joint is nearer to that end.
    """
    nodes = [places[runs.shifted(k)[intervals]] for k in range(-2, 4)]
    half = widths[intervals] / 2
    sides = (nodes[:3], nodes[:2:-1])
    misses = [
        _size(_along(side, 2 * half) - other[2])
        for side, other in zip(sides, sides[::-1], strict=True)
    ]
    nearer = misses[0] < misses[1]
    return np.where(nearer[:, None], _along(sides[0], half), _along(sides[1], half))


def _along(three: list[FloatArray], length: FloatArray) -> FloatArray:
    """Return the points on circles through three points each, so far beyond the last of them."""
    _, before, last = three
    step = last - before
    chord = _size(step)
    curvature = _circles(*three)
    angle = np.arcsin(np.clip(chord * curvature / 2, -1, 1)) + curvature * length / 2
    reach = length * np.sinc(curvature * length / (2 * np.pi)) / chord
    ahead, aside = reach * np.cos(angle), reach * np.sin(angle)
    turned = np.column_stack([-step[:, 1], step[:, 0]])
    return last + ahead[:, None] * step + aside[:, None] * turned


# --- Middles ------------------------------------------------------------------------------------


def middles(runs: Runs, places: FloatArray, widths: FloatArray) -> FloatArray:
    """Return a place half-way along each interval, shape (n, 2).

    Parameters
    ----------
    runs : Runs
        Of n nodes.
    places : ndarray of float64, shape (n, 2)
        The nodes; none equals the one before it in its run.
    widths : ndarray of float64, shape (n,)
        The arc lengths of the intervals.

    Notes
    -----
    On the quintic spline ("not a knot" at ends), of the sixth order in the widths; runs of fewer
    than six nodes have one polynomial. Where the curvature jumps, see `_jumps`, the runs are cut.
    No middle is farther from the chord's than twice that of the circles near by. What is returned
    for nodes that start no interval has no meaning.
    """
    jumps = _jumps(runs, places, widths)
    longest = np.max([widths[runs.shifted(k)] * runs.reaches(k) for k in range(-3, 4)], axis=0)
    widths = np.where(runs.leads, np.maximum(widths, _SHORTEST * longest), 0.0)
    pieces, order = runs.cut(jumps)
    middle = np.empty_like(places)
    middle[order] = _on_polynomials(pieces, places[order], widths[order])
    long, nodes = pieces.chosen(pieces.closed | (pieces.counts > _DEGREE))
    if len(nodes):
        nodes = order[nodes]
        middle[nodes] = _on_splines(long, places[nodes], widths[nodes])
    cut = np.flatnonzero(jumps)
    middle[cut] = _one_sided(runs, places, widths, cut)
    return _limited(runs, places, middle)


def _limited(runs: Runs, places: FloatArray, middle: FloatArray) -> FloatArray:
    """Return the middles drawn towards their chord's if they are farther than any circle tells.

    On samples of smooth curves none are. On very uneven ones polynomials overshoot.
    """
    after = places[runs.shifted(1)]
    center = (places + after) / 2
    curvature = np.abs(_curvatures(runs, places))
    most = np.max([curvature[runs.shifted(k)] * runs.reaches(k) for k in range(-1, 3)], axis=0)
    chord = _size(after - places)
    limit = chord * np.minimum(chord * most / 4, 0.5)
    offset = np.nan_to_num(middle - center, posinf=0.0, neginf=0.0)
    share = np.minimum(1, limit / np.maximum(_size(offset), 1e-300))
    limited: FloatArray = center + share[:, None] * offset
    return limited


def _on_polynomials(runs: Runs, places: FloatArray, widths: FloatArray) -> FloatArray:
    """Return the middles of open runs of up to five nodes: on their polynomial by arc length."""
    middle = (places + places[runs.shifted(1)]) / 2  # of two nodes, exactly
    for size in range(3, _DEGREE + 1):
        chosen = ~runs.closed & (runs.counts == size)
        nodes = runs.starts[:-1][chosen, None] + np.arange(size)
        t = np.cumsum(widths[nodes[:, :-1]], axis=1)
        t = np.column_stack([np.zeros(len(t)), t])
        half = (t[:, 1:] + t[:, :-1]) / 2
        same = np.eye(size, dtype=bool)
        gaps = np.where(same, 1.0, t[:, :, None] - t[:, None, :])
        shares = np.where(same, 1.0, (half[..., None, None] - t[:, None, None]) / gaps[:, None])
        middle[nodes[:, :-1]] = np.prod(shares, axis=-1) @ places[nodes]
    return middle


def _on_splines(runs: Runs, places: FloatArray, widths: FloatArray) -> FloatArray:
    """Return the middles of rings, and open runs of six nodes or more: on quintic splines."""
    from scipy.interpolate import BSpline
    from scipy.sparse import csr_array
    from scipy.sparse.linalg import splu

    x, half, knots, unknown = _knots(runs, widths)
    matrices = []
    for t in (x, half):
        design = BSpline.design_matrix(t, knots, _DEGREE)
        folded: Any = csr_array(
            (design.data, unknown[design.indices], design.indptr), shape=(len(x), len(x))
        )
        folded.sum_duplicates()
        matrices.append(folded)
    factors = splu(matrices[0].tocsc(), permc_spec="NATURAL").solve(places)
    middle: FloatArray = matrices[1] @ factors
    return middle


def _knots(runs: Runs, widths: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, IntArray]:
    """Return the parameters of nodes and middles, all knots, and the unknown of each B-spline.

    The runs lie one behind the other on one axis. At the ends of open ones so many knots are equal
    that no B-spline leaves a run. Rings are unrolled, and their B-splines one round apart the same.
    """
    steps = np.where(runs.leads, widths, 0.0)
    intervals = runs.counts - ~runs.closed
    steps *= (intervals / np.add.reduceat(steps, runs.starts[:-1]))[runs.run]
    x = np.cumsum(steps) - steps
    x -= x[runs.starts[:-1]][runs.run]

    sizes = runs.counts + np.where(runs.closed, 2 * _DEGREE + 1, _DEGREE + 1)
    axis = Runs(np.append(0, np.cumsum(sizes)), np.zeros(len(sizes), bool))
    run, j, count = axis.run, axis.position, runs.counts[axis.run]
    open_ = np.where(j <= _DEGREE, 0, np.where(j >= count, count - 1, j - _DEGREE // 2 - 1))
    node = np.where(runs.closed[run], j - _DEGREE, open_)
    knots = x[runs.starts[run] + node % count] + node // count * intervals[run]
    first, last = knots[axis.starts[:-1]], knots[axis.starts[1:] - 1]
    shift = np.cumsum(last - first + 1) - last
    x += shift[runs.run]
    middle = x + steps / 2
    # A B-spline's interval does not contain its right end.
    x[~runs.leads] = middle[~runs.leads] = np.nextafter(x[~runs.leads], -np.inf)
    return x, middle, knots + shift[run], runs.starts[run] + j % count


# --- Cubics -------------------------------------------------------------------------------------


def cubics(
    runs: Runs, places: FloatArray, middles: FloatArray, widths: FloatArray, natural: bool
) -> FloatArray:
    """Return C2 cubics through nodes and middles, as coefficients of powers, shape (n, 2, 4, 2).

    Parameters
    ----------
    runs : Runs
        Of n nodes.
    places, middles : ndarray of float64, shape (n, 2)
        The nodes, and what lies between each and the next one.
    widths : ndarray of float64, shape (n, 2)
        The parameter intervals from a node to the middle, and from there to the next node.
    natural : bool
        Whether the curvature is zero at ends of runs; else the first two and the last two cubics
        are one ("not a knot").

    Returns
    -------
    coefficients : ndarray of float64, shape (n, 2, 4, 2)
        Of both halves of the intervals, highest power first. They have no meaning for nodes that
        start no interval.
    """
    fine, kept = runs.halved()
    values = np.stack([places, middles], axis=1).reshape(-1, 2)[kept]
    h = widths.ravel()[kept, None]
    h[~fine.leads] = 1.0
    after = fine.shifted(1)
    slopes = (values[after] - values) / h
    speeds = _speeds(fine, slopes, h[:, 0], natural)
    square = (3 * slopes - 2 * speeds - speeds[after]) / h
    cube = (speeds + speeds[after] - 2 * slopes) / h**2
    coefficients = np.zeros((2 * len(places), 4, 2))
    coefficients[kept] = np.stack([cube, square, speeds, values], axis=1)
    return coefficients.reshape(-1, 2, 4, 2)


def _speeds(runs: Runs, slopes: FloatArray, widths: FloatArray, natural: bool) -> FloatArray:
    """Return the derivatives at the nodes that make the second ones continuous."""
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    node, before, after = np.arange(len(widths)), runs.shifted(-1), runs.shifted(1)
    h, g = widths[before], widths
    values = [g.copy(), 2 * (h + g), h]  # of the speeds before, here, after
    right = 3 * (g[:, None] * slopes[before] + h[:, None] * slopes)
    for there in (1, -1):  # the ends at which runs start, and those at which they end
        ends = np.flatnonzero(~runs.reaches(-there))
        near, far = runs.shifted(there), runs.shifted(2 * there)
        first, second = (ends, near[ends]) if there > 0 else (near[ends], far[ends])
        a, b = widths[first], widths[second]
        own, other, size = values[1], values[1 + there], a + b
        # Three nodes have one common parabola at both ends, and two cubics are one anyway.
        few = (runs.counts == 3)[runs.run[ends]]
        own[ends] = np.where(natural, 2, np.where(few, 1, b))
        other[ends] = np.where(natural, 1, np.where(few, 1, size))
        values[1 - there][ends] = 0.0
        s, z = slopes[first], slopes[second]
        knotless = ((b * (3 * a + 2 * b))[:, None] * s + (a * a)[:, None] * z) / size[:, None]
        straight = (3 if natural else 2) * s
        right[ends] = np.where((few | natural)[:, None], straight, knotless)
    matrix: Any = csc_array(
        (np.concatenate(values), (np.tile(node, 3), np.concatenate([before, node, after])))
    )
    speeds: FloatArray = splu(matrix, permc_spec="NATURAL").solve(right)
    return speeds


def _size(vectors: FloatArray) -> FloatArray:
    size: FloatArray = np.hypot(vectors[:, 0], vectors[:, 1])
    return size
