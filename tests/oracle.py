"""The definitions of the graphs by brute force in exact integers: what tests compare with.

Nothing here is fast or clever. Every double is a rational, so a set of points is scaled to
integers; a Voronoi vertex is the center of a triple's circle with no point inside, in homogeneous
integers (X, Y, W), W > 0; and a pair p, q is judged by the interval of circles through both that
hold no site.

The circles through p and q have their centers at m + t * perp(q - p), m the midpoint. A site on
the left of pq is inside the circle of t exactly when t > tau, one on the right exactly when t <
tau, with tau = (p - v).(q - v) / (2 (q - p)x(v - p)). So the disks with no site inside have lo <=
t <= hi. A fraction is a pair of integers (numerator, denominator >= 0); a denominator 0 is
infinity.

Every function takes the rows as a caller has them, duplicates and all, and returns a sorted list
of pairs (i, j), i < j, of first rows. Hand it a `PointSet` to share the work between several
graphs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any

Point = tuple[int, int]
Site = tuple[int, int, int]
Ratio = tuple[int, int]
Span = tuple[Ratio, Ratio]
Edges = list[tuple[int, int]]

NO_BOUND_BELOW: Ratio = (-1, 0)
NO_BOUND_ABOVE: Ratio = (1, 0)


class PointSet:
    """Distinct points in integers: (x, y) = (input - origin) * scale, the first of equal rows
    kept."""

    def __init__(self, points: Any) -> None:
        exact = [(Fraction(float(x)), Fraction(float(y))) for x, y in points]
        first: dict[tuple[Fraction, Fraction], int] = {}
        for row, point in enumerate(exact):
            first.setdefault(point, row)
        self.rows = list(first.values())
        self.origin = next(iter(first), (Fraction(0), Fraction(0)))
        self.scale = _integer_scale(first, self.origin)
        self.points: list[Point] = [self._to_integer(point) for point in first]

    def _to_integer(self, point: tuple[Fraction, Fraction]) -> Point:
        x, y = ((a - o) * self.scale for a, o in zip(point, self.origin, strict=True))
        assert x.denominator == y.denominator == 1
        return (x.numerator, y.numerator)

    @cached_property
    def sites(self) -> list[Site]:
        """The points themselves, as homogeneous sites."""
        return [(x, y, 1) for x, y in self.points]

    @cached_property
    def vertices(self) -> list[Site]:
        """The Voronoi vertices: the centers of the circles of three points with no point inside."""
        found: set[Site] = set()
        for triple in combinations(self.points, 3):
            center = circumcenter(*triple)
            if center is not None and center not in found and self._is_empty(center, triple[0]):
                found.add(center)
        return sorted(found)

    def _is_empty(self, center: Site, on_circle: Point) -> bool:
        limit = _power(center, on_circle)
        return all(_power(center, r) >= limit for r in self.points)

    @cached_property
    def spans(self) -> dict[tuple[int, int], Span]:
        """The pairs that some disk touches with no point inside, each with its interval of t."""
        pairs = combinations(range(len(self.points)), 2)
        spans = {(i, j): span(self.points[i], self.points[j], self.sites) for i, j in pairs}
        return {pair: found for pair, found in spans.items() if found is not None}

    def edges(self, pairs: Iterable[tuple[int, int]]) -> Edges:
        """Pairs of distinct points as sorted pairs of input rows."""
        rows = self.rows
        return sorted((min(rows[i], rows[j]), max(rows[i], rows[j])) for i, j in pairs)


def _integer_scale(
    points: Iterable[tuple[Fraction, Fraction]], origin: tuple[Fraction, Fraction]
) -> Fraction:
    differences = [a - o for point in points for a, o in zip(point, origin, strict=True)]
    denominator = math.lcm(1, *(d.denominator for d in differences))
    divisor = math.gcd(*((d * denominator).numerator for d in differences))
    return Fraction(denominator, divisor or 1)


def point_set(points: Any) -> PointSet:
    """`points` as a `PointSet`, which it may be already."""
    return points if isinstance(points, PointSet) else PointSet(points)


def circumcenter(a: Point, b: Point, c: Point) -> Site | None:
    """The center of the circle through three points, or None if they are collinear."""
    bx, by, cx, cy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    w = 2 * (bx * cy - by * cx)
    if w == 0:
        return None
    bb, cc = bx * bx + by * by, cx * cx + cy * cy
    x, y = cy * bb - by * cc + a[0] * w, bx * cc - cx * bb + a[1] * w
    divisor = math.gcd(x, y, w) * (1 if w > 0 else -1)
    return (x // divisor, y // divisor, w // divisor)


def _power(center: Site, r: Point) -> int:
    """The squared distance of r from the center, times W, less a constant of the center."""
    x, y, w = center
    return w * (r[0] * r[0] + r[1] * r[1]) - 2 * (x * r[0] + y * r[1])


def span(p: Point, q: Point, sites: Iterable[Site]) -> Span | None:
    """The interval of t whose disks hold no site inside, or None if there is no such disk."""
    (px, py), (qx, qy) = p, q
    dx, dy = qx - px, qy - py
    (lo_n, lo_d), (hi_n, hi_d) = NO_BOUND_BELOW, NO_BOUND_ABOVE
    for x, y, w in sites:
        ax, ay = x - px * w, y - py * w
        cross = dx * ay - dy * ax
        dot = ax * (x - qx * w) + ay * (y - qy * w)
        if cross > 0:
            den = 2 * w * cross
            if dot * hi_d < hi_n * den:
                hi_n, hi_d = dot, den
        elif cross < 0:
            den = -2 * w * cross
            if -dot * lo_d > lo_n * den:
                lo_n, lo_d = -dot, den
        elif dot < 0:  # strictly between p and q: inside every disk
            return None
    return ((lo_n, lo_d), (hi_n, hi_d)) if lo_n * hi_d <= hi_n * lo_d else None


def center_at(p: Point, q: Point, t: Ratio) -> Site:
    """The center of the circle of t through p and q."""
    (px, py), (qx, qy), (n, d) = p, q, t
    return ((px + qx) * d - 2 * n * (qy - py), (py + qy) * d + 2 * n * (qx - px), 2 * d)


def voronoi_vertices(points: Any) -> list[tuple[Fraction, Fraction]]:
    """The Voronoi vertices in the coordinates of the input, sorted."""
    s = point_set(points)
    return sorted(
        (Fraction(x, w) / s.scale + s.origin[0], Fraction(y, w) / s.scale + s.origin[1])
        for x, y, w in s.vertices
    )


def delaunay_graph(points: Any) -> Edges:
    """Some disk touches both and holds no point: all diagonals of cocircular points, too."""
    s = point_set(points)
    return s.edges(s.spans)


def every_delaunay_triangulation(points: Any) -> Edges:
    """The edges that no tie can move: two different disks touch the pair and hold no point."""
    s = point_set(points)
    return s.edges(pair for pair, (lo, hi) in s.spans.items() if lo[0] * hi[1] < hi[0] * lo[1])


def crust(points: Any) -> Edges:
    """Some disk touches both and holds no point and no Voronoi vertex inside."""
    s = point_set(points)
    sites = s.sites + s.vertices
    return s.edges((i, j) for i, j in s.spans if span(s.points[i], s.points[j], sites))


def a_shape(points: Any, extra: Any) -> Edges:
    """Some disk touches both and holds no point and no extra point inside."""
    rows = [tuple(row) for row in points]
    together = PointSet(rows + [tuple(row) for row in extra])
    own = [k for k, row in enumerate(together.rows) if row < len(rows)]
    pairs = combinations(own, 2)
    return together.edges(pair for pair in pairs if pair in together.spans)


def one_step_crust(points: Any) -> Edges:
    """Some disk touches both and holds no point inside, nor either end of the dual Voronoi edge."""
    s = point_set(points)

    def is_kept(i: int, j: int, ends: Span) -> bool:
        p, q = s.points[i], s.points[j]
        return span(p, q, s.sites + [center_at(p, q, t) for t in ends if t[1]]) is not None

    return s.edges((i, j) for (i, j), ends in s.spans.items() if is_kept(i, j, ends))


def crossing_angle_graph(points: Any, cot: Fraction) -> Edges:
    """Two disks touch both, hold no point inside, and cross at arccot(cot), in (0, pi), or more.

    They are the disks of the two ends of the dual Voronoi edge, which is seen from the points under
    that angle. An end at infinity has no disk, so that its angle must be exceeded.
    """
    s = point_set(points)

    def sees(lo: Ratio, hi: Ratio) -> bool:
        if lo[1] == hi[1] == 0:  # a whole line: every angle below the straight one
            return True
        # The directions to the two ends, the edge along the first axis and its length 2.
        (ux, uy), (vx, vy) = (lo[1], 2 * lo[0]), (hi[1], 2 * hi[0])
        cross, dot = ux * vy - uy * vx, ux * vx + uy * vy
        is_open = lo[1] == 0 or hi[1] == 0
        return cross > 0 and (dot < cot * cross if is_open else dot <= cot * cross)

    return s.edges(pair for pair, ends in s.spans.items() if sees(*ends))


def gamma_graph(points: Any, c0: float, c1: float) -> Edges:
    """One of two mirror images of Veltkamp's neighborhood of both points holds no point inside.

    The two disks touch both and have the radii d / 2 (1 - |c|), their centers on different sides if
    c0 and c1 have one sign, else on one side. The neighborhood is their union if the one of c0, c1
    that is larger in size is positive, else their intersection.
    """
    larger = max(c0, c1, key=abs)
    side = -1 if c0 * c1 > 0 else 1
    combine = any if larger > 0 else all

    def is_free(s: PointSet, i: int, j: int, turn: int) -> bool:
        p, q = s.points[i], s.points[j]
        others = [r for k, r in enumerate(s.points) if k not in (i, j)]
        disks = ((turn, c0), (turn * side, c1))
        return not any(combine(_in_disk(p, q, r, *disk) for disk in disks) for r in others)

    s = point_set(points)
    pairs = combinations(range(len(s.points)), 2)
    return s.edges((i, j) for i, j in pairs if is_free(s, i, j, 1) or is_free(s, i, j, -1))


def _in_disk(p: Point, q: Point, r: Point, side: int, c: float) -> bool:
    """Whether r is inside the disk of radius d / 2 (1 - |c|) centered on the side, or between."""
    dot, cross = _dot(r, p, q), _cross(p, q, r)
    if cross == 0:
        return dot < 0
    left = 1 if cross > 0 else -1
    if abs(c) == 1:  # a half plane
        return side == left
    t_squared = (1 / (1 - abs(Fraction(c))) ** 2 - 1) / 4
    return _compare_root(side, t_squared, (left * dot, 2 * abs(cross))) * left > 0


def rcgh(points: Any) -> Edges:
    """The dual Voronoi edge is at least as long as the edge."""
    s = point_set(points)

    def is_long(lo: Ratio, hi: Ratio) -> bool:
        return lo[1] == 0 or hi[1] == 0 or hi[0] * lo[1] - lo[0] * hi[1] >= lo[1] * hi[1]

    return s.edges(pair for pair, ends in s.spans.items() if is_long(*ends))


def alpha_shape(points: Any, radius: float) -> Edges:
    """Some disk of exactly this radius touches both and holds no point inside."""
    s = point_set(points)
    squared = (Fraction(radius) * s.scale) ** 2

    def touches(i: int, j: int, lo: Ratio, hi: Ratio) -> bool:
        t_squared = squared / _squared_length(s, i, j) - Fraction(1, 4)
        if t_squared < 0:
            return False
        return any(
            _compare_root(sign, t_squared, lo) >= 0 >= _compare_root(sign, t_squared, hi)
            for sign in (-1, 1)
        )

    return s.edges((i, j) for (i, j), (lo, hi) in s.spans.items() if touches(i, j, lo, hi))


def _compare_root(sign: int, square: Fraction, bound: Ratio) -> int:
    """The sign of sign * sqrt(square) - bound."""
    n, d = bound
    if d == 0:
        return -n
    left, right = sign * square, Fraction(n, d) * abs(Fraction(n, d))
    return (left > right) - (left < right)


def _squared_length(s: PointSet, i: int, j: int) -> int:
    (px, py), (qx, qy) = s.points[i], s.points[j]
    return (qx - px) ** 2 + (qy - py) ** 2


def _pairs_free_of(points: Any, is_forbidden: Callable[[Point, Point, Point], bool]) -> Edges:
    """All pairs whose forbidden region holds none of the other points."""
    s = point_set(points)
    return s.edges(
        (i, j)
        for i, j in combinations(range(len(s.points)), 2)
        if not any(
            is_forbidden(s.points[i], s.points[j], r)
            for k, r in enumerate(s.points)
            if k not in (i, j)
        )
    )


def _dot(o: Point, a: Point, b: Point) -> int:
    return (a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1])


def _cross(o: Point, a: Point, b: Point) -> int:
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def beta_skeleton(points: Any, beta: float, kind: str = "circle") -> Edges:
    """The forbidden region of both points holds no point.

    Of kind "circle" and beta >= 1 it is the union of the two open disks of radius beta d / 2 that
    touch both; for beta < 1 the intersection of those of radius d / (2 beta). Of kind "lune" and
    beta >= 1 it is the intersection of the open disks of radius beta d / 2 about
    p + (q - p) beta / 2 and q + (p - q) beta / 2.
    """
    b = Fraction(beta)
    if b < 1:
        return _pairs_free_of(points, lambda p, q, r: _in_lens(p, q, r, b))
    if kind == "lune":
        return _pairs_free_of(points, lambda p, q, r: _in_lune(p, q, r, b))
    return _pairs_free_of(points, lambda p, q, r: _in_union(p, q, r, b))


def _in_union(p: Point, q: Point, r: Point, beta: Fraction) -> bool:
    """Whether 2 tau < sqrt(beta^2 - 1) on the side of r, where 2 tau = dot / |cross|."""
    dot, cross, n, d = _dot(r, p, q), _cross(p, q, r), beta.numerator, beta.denominator
    return dot < 0 or (n * n - d * d) * cross * cross > d * d * dot * dot


def _in_lens(p: Point, q: Point, r: Point, beta: Fraction) -> bool:
    """Whether 2 tau < -sqrt(1 / beta^2 - 1) on the side of r."""
    dot, cross, n, d = _dot(r, p, q), _cross(p, q, r), beta.numerator, beta.denominator
    return dot < 0 and n * n * dot * dot > (d * d - n * n) * cross * cross


def _in_lune(p: Point, q: Point, r: Point, beta: Fraction) -> bool:
    n, d = beta.numerator, beta.denominator
    return d * _dot(p, r, r) < n * _dot(p, r, q) and d * _dot(q, r, r) < n * _dot(q, r, p)


def gabriel(points: Any) -> Edges:
    """The disk on pq as a diameter holds no point inside."""
    return _pairs_free_of(points, lambda p, q, r: _dot(r, p, q) < 0)


def relative_neighborhood(points: Any) -> Edges:
    """No point is nearer to both p and q than they are to each other."""
    return _pairs_free_of(points, lambda p, q, r: max(_dot(p, r, r), _dot(q, r, r)) < _dot(p, q, q))


def nn_crust(points: Any) -> Edges:
    """Every nearest neighbor q of p, and the shortest edges from p at 90 degrees or more to pq."""
    s = point_set(points)
    neighbors: list[list[int]] = [[] for _ in s.points]
    for i, j in s.spans:
        neighbors[i].append(j)
        neighbors[j].append(i)
    pairs: set[tuple[int, int]] = set()
    for i, p in enumerate(s.points):
        for j in _nearest(s, i, [k for k in range(len(s.points)) if k != i]):
            behind = [k for k in neighbors[i] if _dot(p, s.points[j], s.points[k]) <= 0]
            pairs.update((min(i, k), max(i, k)) for k in [j, *_nearest(s, i, behind)])
    return s.edges(pairs)


def _neighbors(s: PointSet) -> list[list[int]]:
    """The neighbors of each point in the closed Delaunay graph."""
    neighbors: list[list[int]] = [[] for _ in s.points]
    for i, j in s.spans:
        neighbors[i].append(j)
        neighbors[j].append(i)
    return neighbors


def _mutual(s: PointSet, asked_for: Sequence[set[int]]) -> Edges:
    """The pairs that ask for each other."""
    return s.edges((i, j) for i, asked in enumerate(asked_for) for j in asked if i in asked_for[j])


def _twice_nearest(s: PointSet, second: Callable[[int, int, int], bool]) -> list[set[int]]:
    """For each point its nearest q, and the nearest of its neighbors that go with q."""
    neighbors = _neighbors(s)
    asked_for = []
    for i in range(len(s.points)):
        nearest = _nearest(s, i, [k for k in range(len(s.points)) if k != i])
        also = (_nearest(s, i, [k for k in neighbors[i] if second(i, j, k)]) for j in nearest)
        asked_for.append({*nearest, *(k for found in also for k in found)})
    return asked_for


def hnn_crust(points: Any) -> Edges:
    """Mutual: every nearest q of p, and the nearest of those not nearer to q than to p."""
    s = point_set(points)
    return _unique(
        _mutual(
            s,
            _twice_nearest(
                s,
                lambda p, q, r: r != q and _squared_length(s, r, p) <= _squared_length(s, r, q),
            ),
        )
    )


def compatible_crust(points: Any, cot: Fraction) -> Edges:
    """Mutual: every nearest q of p, and the nearest of those at arccot(cot) to q or more."""
    s = point_set(points)

    def is_compatible(p: int, q: int, r: int) -> bool:
        origin, a, b = s.points[p], s.points[q], s.points[r]
        cross, dot = abs(_cross(origin, a, b)), _dot(origin, a, b)
        return r != q and (dot < 0 if cross == 0 else dot <= cot * cross)

    return _unique(_mutual(s, _twice_nearest(s, is_compatible)))


def _unique(edges: Edges) -> Edges:
    return sorted(set(edges))


def sig_delaunay(points: Any) -> Edges:
    """The spheres about the points, each out to the nearest other, meet; closed Delaunay edges."""
    s = point_set(points)
    others = [[k for k in range(len(s.points)) if k != i] for i in range(len(s.points))]
    squares = [min((_squared_length(s, i, k) for k in o), default=0) for i, o in enumerate(others)]

    def meet(i: int, j: int) -> bool:
        # d <= a + b, and so d^2 - a^2 - b^2 <= 2 a b.
        excess = _squared_length(s, i, j) - squares[i] - squares[j]
        return excess <= 0 or excess * excess <= 4 * squares[i] * squares[j]

    return s.edges(pair for pair in s.spans if meet(*pair))


def _rank(s: PointSet, i: int, j: int) -> tuple[int, Point, Point]:
    a, b = sorted((s.points[i], s.points[j]))
    return _squared_length(s, i, j), a, b


def _triangles(s: PointSet) -> list[tuple[int, int, int]]:
    """All triples on an empty circle."""
    triples = combinations(range(len(s.points)), 3)
    centers = ((t, circumcenter(*(s.points[k] for k in t))) for t in triples)
    return [t for t, c in centers if c is not None and s._is_empty(c, s.points[t[0]])]


def peel(points: Any) -> Edges:
    """Closed Delaunay edges, each triangle's longest off, then from the longest at degree > 2."""
    s = point_set(points)
    kept = set(s.spans)
    for i, j, k in _triangles(s):
        *_, second, longest = sorted(
            ((i, j), (i, k), (j, k)), key=lambda pair: _squared_length(s, *pair)
        )
        if _squared_length(s, *longest) > _squared_length(s, *second):
            kept.discard(longest)
    for pair in sorted(kept, key=lambda pair: _rank(s, *pair), reverse=True):
        if any(sum(end in other for other in kept) > 2 for end in pair):
            kept.discard(pair)
    return s.edges(kept)


def crawl(points: Any) -> Edges:
    """Curves from the shortest edges to a nearest point on, at both ends, the shorter first."""
    s = point_set(points)
    neighbors = _neighbors(s)
    joined: list[list[int]] = [[] for _ in s.points]

    def step(v: int) -> tuple[Any, int, int] | None:
        behind = joined[v][0]
        ahead = [w for w in neighbors[v] if w != behind and w not in joined[behind]]
        w = min(ahead, key=lambda w: _rank(s, v, w), default=None)
        return None if w is None or len(joined[w]) > 1 else (_rank(s, v, w), v, w)

    def join(v: int, w: int) -> None:
        joined[v].append(w)
        joined[w].append(v)

    for i, j in sorted(s.spans, key=lambda pair: _rank(s, *pair)):
        others = [[k for k in range(len(s.points)) if k != end] for end in (i, j)]
        is_near = j in _nearest(s, i, others[0]) or i in _nearest(s, j, others[1])
        if joined[i] or joined[j] or not is_near:
            continue
        join(i, j)
        ends = [i, j]
        while found := min(filter(None, map(step, ends)), default=None):
            _, v, w = found
            reached = bool(joined[w])
            join(v, w)
            ends = [end for end in ends if end not in (v, w)] + ([] if reached else [w])
    return s.edges({(min(i, j), max(i, j)) for i, ends in enumerate(joined) for j in ends})


def _dual_ends(s: PointSet) -> dict[tuple[int, int], tuple[Site | None, Site | None]]:
    """The pairs whose dual Voronoi edge has a length, each with its ends; None at infinity."""
    return {
        (i, j): tuple(center_at(s.points[i], s.points[j], t) if t[1] else None for t in ends)  # type: ignore[misc]
        for (i, j), ends in s.spans.items()
        if ends[0][1] == 0 == ends[1][1] or ends[0][0] * ends[1][1] < ends[1][0] * ends[0][1]
    }


def gathan(points: Any, sine: float, ratio: float) -> Edges:
    """Mutual: the shortest on each side of the normal, near the tangent, short beside the cell."""
    s = point_set(points)
    dual = _dual_ends(s)
    hull = _hull_neighbors(s)
    neighbors: list[list[int]] = [[] for _ in s.points]
    for i, j in dual:
        neighbors[i].append(j)
        neighbors[j].append(i)
    squared_sine, squared_ratio = Fraction(sine) ** 2, Fraction(ratio) ** 2

    def normals(i: int) -> list[tuple[Any, Any]]:
        """Vectors, and their squared length where they lead to a pole."""
        x, y = s.points[i]
        if i in hull:
            (ax, ay), (bx, by) = hull[i]
            return [((ay - by, bx - ax), None)]
        corners = {c for pair, ends in dual.items() if i in pair for c in ends if c is not None}
        vectors = [(Fraction(cx, w) - x, Fraction(cy, w) - y) for cx, cy, w in corners]
        far = max(vx * vx + vy * vy for vx, vy in vectors)
        return [(v, far) for v in vectors if v[0] ** 2 + v[1] ** 2 == far]

    def asked_for(i: int) -> set[int]:
        asked: set[int] = set()
        for (nx, ny), far in normals(i) if neighbors[i] else []:
            sides: dict[bool, list[int]] = {False: [], True: []}
            for j in neighbors[i]:
                ex, ey = s.points[j][0] - s.points[i][0], s.points[j][1] - s.points[i][1]
                along, across, square = nx * ex + ny * ey, nx * ey - ny * ex, ex * ex + ey * ey
                is_flat = along**2 <= squared_sine * (nx * nx + ny * ny) * square
                is_short = far is None or far >= squared_ratio * square
                if across and is_flat and is_short:
                    sides[across > 0].append(j)
            for side in sides.values():
                asked.update(_nearest(s, i, side))
        return asked

    return _unique(_mutual(s, [asked_for(i) for i in range(len(s.points))]))


def _hull_neighbors(s: PointSet) -> dict[int, tuple[Point, Point]]:
    """The points of the hull, each with those before and after it, counter-clockwise.

    Two points are successive on the hull if none is right of them or between them. At the end of a
    line the two are the point itself and its neighbor, in an order that decides only a sign.
    """
    after: dict[int, int] = {}
    count = range(len(s.points))
    for i in count:
        for j in count:
            p, q = s.points[i], s.points[j]
            if i != j and all(
                _cross(p, q, s.points[k]) > 0
                or (_cross(p, q, s.points[k]) == 0 and _dot(s.points[k], p, q) > 0)
                for k in count
                if k not in (i, j)
            ):
                after[i] = j
    before = {j: i for i, j in after.items()}
    is_line = all(_cross(*(s.points[k] for k in t)) == 0 for t in combinations(count, 3))
    if is_line:
        ends: dict[int, tuple[Point, Point]] = {}
        order = sorted(s.points)
        for i, p in enumerate(s.points):
            k = order.index(p)
            ends[i] = (order[max(k - 1, 0)], order[min(k + 1, len(order) - 1)])
        return ends
    return {i: (s.points[before[i]], s.points[after[i]]) for i in after if i in before}


def conservative_crust(points: Any, ratio: float) -> Edges:
    """The largest set of Gabriel edges whose disks meet no vertex and no edge of the medial axis.

    Disks are about the middles, `ratio` times as large as the smallest. The medial axis is what the
    Voronoi edges make whose points are not joined.
    """
    s = point_set(points)
    dual = _dual_ends(s)
    gabriel_pairs = set(gabriel(s))
    row = {r: k for k, r in enumerate(s.rows)}
    kept = {tuple(sorted((row[i], row[j]))) for i, j in gabriel_pairs} & set(dual)

    def meets(e: tuple[int, int], f: tuple[int, int]) -> bool:
        """Whether the disk of e meets the dual of f."""
        (px, py), (qx, qy) = (s.points[k] for k in e)
        mx, my = Fraction(px + qx, 2), Fraction(py + qy, 2)
        square = Fraction(ratio) ** 2 * _squared_length(s, *e) / 4
        (ax, ay), (bx, by) = (s.points[k] for k in f)
        # The dual as middle + t * normal.
        nx, ny = ay - by, bx - ax
        cx, cy = Fraction(ax + bx, 2), Fraction(ay + by, 2)
        t = ((mx - cx) * nx + (my - cy) * ny) / (nx * nx + ny * ny)
        (lo_n, lo_d), (hi_n, hi_d) = s.spans[f]
        t = max(t, Fraction(lo_n, lo_d)) if lo_d else t
        t = min(t, Fraction(hi_n, hi_d)) if hi_d else t
        return (cx + t * nx - mx) ** 2 + (cy + t * ny - my) ** 2 < square

    def holds_vertex(e: tuple[int, int]) -> bool:
        (px, py), (qx, qy) = (s.points[k] for k in e)
        square = Fraction(ratio) ** 2 * _squared_length(s, *e) / 4
        return any(
            (Fraction(x, w) - Fraction(px + qx, 2)) ** 2
            + (Fraction(y, w) - Fraction(py + qy, 2)) ** 2
            < square
            for x, y, w in s.vertices
        )

    kept = {e for e in kept if not holds_vertex(e)}
    while True:
        gone = {e for e in kept if any(meets(e, f) for f in set(dual) - kept)}
        if not gone:
            return s.edges(kept)
        kept -= gone


def _nearest(s: PointSet, i: int, among: Sequence[int]) -> list[int]:
    """All those at the least distance from point i."""
    least = min((_squared_length(s, i, k) for k in among), default=0)
    return [k for k in among if _squared_length(s, i, k) == least]


def minimum_spanning_tree(points: Any) -> Edges:
    """Prim's tree, ties broken by the coordinates of the smaller end, then of the other."""
    s = point_set(points)

    def key(pair: tuple[int, int]) -> tuple[int, Point, Point]:
        a, b = sorted(s.points[k] for k in pair)
        return _squared_length(s, *pair), a, b

    inside, outside = set(range(len(s.points))[:1]), set(range(1, len(s.points)))
    pairs = []
    while outside:
        pair = min(((i, j) for i in inside for j in outside), key=key)
        pairs.append(pair)
        inside.add(pair[1])
        outside.remove(pair[1])
    return s.edges(pairs)
