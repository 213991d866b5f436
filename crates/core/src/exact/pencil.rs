//! The pencil of circles through two points, p and q, and where Voronoi vertices lie in it.
//!
//! The circle of parameter t has its center at m + t·n, m the midpoint of p and q, n the vector q − p turned
//! left by 90°. A site v to the left of p → q is strictly inside exactly for t > τ(v), one to the right exactly for
//! t < τ(v), with τ(v) = (v−p)·(v−q) / 2 (q−p)×(v−p). The paper's disks "touching s₁ and s₂" are this pencil.

use crate::exact::angle::Angle;
use crate::exact::circumcenter::{Center, HomogeneousCenter};
use crate::exact::double_double::DoubleDouble;
use crate::exact::filter::{Approximate, ROUNDING, UNDERFLOW};
use crate::exact::predicates::in_circle;
use crate::exact::sign::{self, Form, Number};
use crate::point::{Point, cross, dot, length, sub};
use std::cell::OnceCell;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// A disk is solved for where floating point leaves its center uncertain by more than this part of its radius.
const UNCERTAIN: f64 = 1e-6;

/// What rounding adds to the error of a radius; unknown where its square may underflow.
fn of_radius(radius: f64) -> f64 {
    if radius > 1e-140 { 8.0 * ROUNDING * radius } else { f64::INFINITY }
}

/// The circles through `p` and `q`.
#[derive(Debug, Clone, Copy)]
pub struct Pencil {
    /// The first point.
    pub p: Point,
    /// The second point.
    pub q: Point,
    chord: Point,
}

/// A Voronoi vertex seen from the chord p q: the circumcenter v of a counter-clockwise triangle.
#[derive(Debug, Clone, Copy)]
pub struct Vertex {
    triangle: [Point; 3],
    /// (v−p)·(v−q), up to a positive factor: negative inside the smallest circle.
    power: Approximate,
    /// (q−p)×(v−p), times the same: positive to the left.
    height: Approximate,
}

impl Vertex {
    /// The triangle that it is the circumcenter of.
    #[must_use]
    pub fn triangle(&self) -> [Point; 3] {
        self.triangle
    }
}

/// A circle of a pencil: the smallest, or the one through a Voronoi vertex off the line p q.
#[derive(Debug, Clone, Copy)]
pub enum Circle {
    /// t = 0: the circle with diameter p q.
    Smallest,
    /// t = τ of a Voronoi vertex.
    Through(Vertex),
}

/// A circle of a pencil in floating point, with bounds on its errors.
#[derive(Debug, Clone)]
pub struct Disk {
    circle: Circle,
    /// Twice the parameter.
    parameter: Approximate,
    /// Where the vertex on the circle is, more precisely, if that was asked for.
    place: OnceCell<Place<DoubleDouble>>,
    /// The center relative to p.
    pub center: Point,
    /// The radius.
    pub radius: f64,
    /// A bound on the error of the center, and of the radius.
    pub error: f64,
}

impl Pencil {
    /// The pencil of the circles through `p` and `q`.
    #[must_use]
    pub fn new(p: Point, q: Point) -> Self {
        Self { p, q, chord: sub(q, p) }
    }

    /// The vector from p to q.
    #[inline]
    #[must_use]
    pub fn chord(&self) -> Point {
        self.chord
    }

    /// The circumcenter of the counter-clockwise `triangle`, seen from this pencil.
    #[must_use]
    pub fn vertex(&self, triangle: [Point; 3]) -> Vertex {
        let Center { at, error } = Center::estimate(triangle, self.p);
        let from_q = sub(at, self.chord);
        let reach = at[0].abs() + at[1].abs() + from_q[0].abs() + from_q[1].abs();
        let length = self.chord[0].abs() + self.chord[1].abs();
        let error = error + 8.0 * ROUNDING * reach;
        let power = Approximate::of(dot(at, from_q), error * (reach + error));
        let height = Approximate::of(cross(self.chord, at), length * error);
        Vertex { triangle, power, height }
    }

    /// The circumcenter of a counter-clockwise `triangle` whose first corners are p and q, or q and p.
    ///
    /// Its height is half the cotangent of the third corner's angle, times |q − p|² and to its own side; times four squares of the sine
    /// no quotient is left. However flat the triangle, this is as certain as the angle.
    #[inline]
    #[must_use]
    pub fn own(&self, triangle: [Point; 3]) -> Vertex {
        let [first, second, apex] = triangle;
        let Angle { dot, cross, size } = Angle::at(apex, first, second);
        let side = if first == self.p { 2.0 } else { -2.0 };
        let error = 14.0 * ROUNDING * size * size + UNDERFLOW;
        let power = Approximate::of(dot * dot - cross * cross, error);
        Vertex { triangle, power, height: Approximate::of(side * (dot * cross), error) }
    }

    /// The disk inside `circle`.
    #[must_use]
    pub fn disk(&self, circle: Circle) -> Disk {
        let twice = match circle {
            Circle::Smallest => Approximate::ZERO,
            Circle::Through(vertex) => vertex.power.over(&vertex.height),
        };
        let [dx, dy] = self.chord;
        let t = twice.value / 2.0;
        let center = [dx / 2.0 - t * dy, dy / 2.0 + t * dx];
        let radius = dot(center, center).sqrt();
        let error = twice.error / 2.0 * (dx.abs() + dy.abs()) + of_radius(radius);
        match circle {
            // An unknown error (not a number) is too large.
            Circle::Through(vertex) if error.is_nan() || error > UNCERTAIN * radius => {
                self.solve(vertex)
            }
            _ => Disk { circle, parameter: twice, place: OnceCell::new(), center, radius, error },
        }
    }

    /// The disk inside the circle through a vertex whose place is too uncertain in floating point.
    #[cold]
    fn solve(&self, vertex: Vertex) -> Disk {
        let [a, b, c] = vertex.triangle;
        let points = [self.q, a, b, c];
        #[cfg(test)]
        crate::progress::work_tests::count(
            crate::progress::work_tests::BIT * PlaceTwice.bound(53) as usize,
        );
        let (at, unit) = DoubleDouble::differences(self.p, &points);
        let known = place(&at[0], [&at[1], &at[2], &at[3]]);
        let center = [0, 1].map(|axis| {
            let quick =
                center_through(axis, &at[0], &known).over(&known.twice_height(), sign::ACCURACY);
            quick.map_or_else(
                || sign::quotient(&CenterThrough { axis }, &PlaceTwice, self.p, &points),
                |x| x * unit,
            )
        });
        let radius = length(center);
        let error = 2.0 * sign::ACCURACY * radius + of_radius(radius.min(length(self.chord)));
        // The center is at (q − p) / 2 + t n.
        let [dx, dy] = self.chord;
        let from_middle = [center[0] - dx / 2.0, center[1] - dy / 2.0];
        let square = dot(self.chord, self.chord);
        let parameter = Approximate {
            value: 2.0 * dot(from_middle, [-dy, dx]) / square,
            error: 4.0 * error / length(self.chord),
        };
        let circle = Circle::Through(vertex);
        Disk { circle, parameter, place: OnceCell::from(known), center, radius, error }
    }

    /// The third corner of the triangle whose center the circle of `disk` goes through, if p and q are the other two.
    #[must_use]
    pub fn own_apex(&self, disk: &Disk) -> Option<Point> {
        match disk.circle {
            Circle::Through(Vertex { triangle: [p, q, apex], .. })
                if [p, q] == [self.p, self.q] || [p, q] == [self.q, self.p] =>
            {
                Some(apex)
            }
            _ => None,
        }
    }

    /// Is `vertex` strictly inside `disk`?
    #[must_use]
    pub fn holds(&self, disk: &Disk, vertex: &Vertex) -> bool {
        let excess = vertex.power.minus(&disk.parameter.times(&vertex.height));
        excess.sign().unwrap_or_else(|| match disk.circle {
            Circle::Smallest => self.power(vertex),
            Circle::Through(other) => self.exact_excess(vertex, &other, &disk.place),
        }) == Less
    }

    /// The sign of (v−p)·(v−q): `Less` inside the smallest circle.
    #[must_use]
    pub fn power(&self, vertex: &Vertex) -> Ordering {
        vertex.power.sign().unwrap_or_else(|| self.exact_power(vertex))
    }

    #[cold]
    fn exact_power(&self, vertex: &Vertex) -> Ordering {
        let ends = [self.p, self.q];
        let apex = vertex.triangle.into_iter().find(|corner| !ends.contains(corner));
        if let Some(apex) = apex.filter(|_| is_one_circle(vertex.triangle, &ends)) {
            // p q is a chord of the triangle's circle, seen under between 45° and 135° if dot² < cross².
            let [one, other] =
                [1, -1].map(|side| sign::sign(&Turned { side }, self.p, &[self.q, apex]));
            return match (one, other) {
                (Equal, _) | (_, Equal) => Equal,
                _ if one == other => Greater,
                _ => Less,
            };
        }
        let [a, b, c] = vertex.triangle;
        sign::exact_sign(&Power, self.p, &[self.q, a, b, c])
    }

    /// The side of p → q that `vertex` is on: `Greater` is left.
    #[must_use]
    pub fn side(&self, vertex: &Vertex) -> Ordering {
        let [a, b, c] = vertex.triangle;
        let exact = || sign::exact_sign(&Side, self.p, &[self.q, a, b, c]);
        vertex.height.sign().unwrap_or_else(exact)
    }

    /// The smallest of the circles that have no Voronoi vertex `low` of the right side inside, nor one `high` of the left.
    /// `None` if there is no such circle.
    #[must_use]
    pub fn smallest_between(&self, low: Option<Vertex>, high: Option<Vertex>) -> Option<Circle> {
        if let (Some(low), Some(high)) = (low, high)
            && self.holds(&self.disk(Circle::Through(high)), &low)
        {
            return None;
        }
        match (low, high) {
            (_, Some(high)) if self.power(&high) == Less => Some(Circle::Through(high)),
            (Some(low), _) if self.power(&low) == Less => Some(Circle::Through(low)),
            _ => Some(Circle::Smallest),
        }
    }

    /// `Less` if `vertex` is strictly inside the circle through `other`, which is off the line p q; `known` is the place of that.
    #[cold]
    fn exact_excess(
        &self,
        vertex: &Vertex,
        other: &Vertex,
        known: &OnceCell<Place<DoubleDouble>>,
    ) -> Ordering {
        let ([a, b, c], [d, e, f]) = (vertex.triangle, other.triangle);
        if [[d, e, f], [e, f, d], [f, d, e]].contains(&vertex.triangle) {
            return Equal;
        }
        let place = |triangle| self.precise_place(triangle);
        let precise = || {
            let excess = place([a, b, c]).excess(known.get_or_init(|| place([d, e, f])));
            excess.sign().or_else(|| is_one_circle([a, b, c], &[d, e, f]).then_some(Equal))
        };
        let points = [self.q, a, b, c, d, e, f];
        let sign = sign::exact_sign_by(&Inside, self.p, &points, precise);
        if self.side(other) == Greater { sign } else { sign.reverse() }
    }

    fn precise_place(&self, [a, b, c]: [Point; 3]) -> Place<DoubleDouble> {
        let ([q, a, b, c], _) = DoubleDouble::differences(self.p, &[self.q, a, b, c]);
        place(&q, [&a, &b, &c])
    }
}

/// Do all `others` lie on the circle through the corners of the triangle?
fn is_one_circle([a, b, c]: [Point; 3], others: &[Point]) -> bool {
    others
        .iter()
        .all(|&d| [a, b, c].contains(&d) || !in_circle(a, b, c, d) && !in_circle(c, b, a, d))
}

/// Where the center of a triangle lies in the pencil of the origin and a point.
#[derive(Debug, Clone)]
struct Place<T> {
    /// Its power times w², w the common denominator of its coordinates.
    power: T,
    /// Its height times w².
    height: T,
}

impl<T: Number> Place<T> {
    fn twice_height(&self) -> T {
        self.height.plus(&self.height)
    }

    /// Negative if this center is inside the circle through the other, times the latter's side.
    fn excess(&self, other: &Self) -> T {
        self.power.times(&other.height).minus(&other.power.times(&self.height))
    }
}

/// The place of the center of the triangle in the pencil of the origin and `q`.
fn place<T: Number>(q: &[T; 2], [a, b, c]: [&[T; 2]; 3]) -> Place<T> {
    let v = HomogeneousCenter::new(a, b, c);
    let from_q = [0, 1].map(|axis| v.at[axis].minus(&q[axis].times(&v.w)));
    let height = sign::cross(q, &v.at).times(&v.w);
    Place { power: sign::dot(&v.at, &from_q), height }
}

/// The dot product of the sides of the angle at `r` opposite to the edge from the origin to `q`, and their cross product, added or
/// taken off.
struct Turned {
    side: i64,
}

impl Form<2> for Turned {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 3
    }
    fn value<T: Number>(&self, [q, r]: &[[T; 2]; 2]) -> T {
        let dot = sign::dot(r, &sign::difference(r, q));
        dot.plus(&T::integer(self.side).times(&sign::cross(q, r)))
    }
}

struct Power;

impl Form<4> for Power {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 14
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        place(q, [a, b, c]).power
    }
}

/// A coordinate of the center of the circle through p, q and a circumcenter, relative to p, times [`PlaceTwice`].
struct CenterThrough {
    axis: usize,
}

impl Form<4> for CenterThrough {
    fn bound(&self, bits: u32) -> u32 {
        7 * bits + 16
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        center_through(self.axis, q, &place(q, [a, b, c]))
    }
}

fn center_through<T: Number>(axis: usize, q: &[T; 2], place: &Place<T>) -> T {
    let along = q[axis].times(&place.height);
    let aside = q[1 - axis].times(&place.power);
    if axis == 0 { along.minus(&aside) } else { along.plus(&aside) }
}

/// Twice the height: what both coordinates are divided by.
struct PlaceTwice;

impl Form<4> for PlaceTwice {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 14
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        place(q, [a, b, c]).twice_height()
    }
}

struct Side;

impl Form<4> for Side {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 10
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        sign::cross(q, &HomogeneousCenter::new(a, b, c).at)
    }
}

/// Negative if the first circumcenter is inside the circle through the second, times the latter's side.
struct Inside;

impl Form<7> for Inside {
    fn bound(&self, bits: u32) -> u32 {
        12 * bits + 30
    }
    fn value<T: Number>(&self, [q, a, b, c, d, e, f]: &[[T; 2]; 7]) -> T {
        place(q, [a, b, c]).excess(&place(q, [d, e, f]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        for side in [1, -1] {
            assert_bounded(&Turned { side });
        }
        for axis in [0, 1] {
            assert_bounded(&CenterThrough { axis });
        }
        assert_bounded(&Power);
        assert_bounded(&PlaceTwice);
        assert_bounded(&Side);
        assert_bounded(&Inside);
    }
}
