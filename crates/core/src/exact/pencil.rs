//! The pencil of circles through two points, p and q, and where Voronoi vertices lie in it.
//!
//! The circle of parameter t has its center at m + t·n, m the midpoint of p and q, n the vector q − p turned
//! left by 90°. A site v to the left of p → q is strictly inside exactly for t > τ(v), one to the right exactly for
//! t < τ(v), with τ(v) = (v−p)·(v−q) / 2 (q−p)×(v−p). The paper's disks "touching s₁ and s₂" are this pencil.

use crate::exact::circumcenter::{Center, HomogeneousCenter};
use crate::exact::sign::{self, Form, Number, ROUNDING};
use crate::point::{Point, cross, dot, length, sub};
use std::cmp::Ordering::{self, Equal, Greater, Less};

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
    /// (v−p)·(v−q): negative inside the smallest circle.
    power: Estimate,
    /// (q−p)×(v−p): positive to the left.
    height: Estimate,
}

/// A value in floating point and a bound on its error.
#[derive(Debug, Clone, Copy)]
struct Estimate {
    value: f64,
    error: f64,
}

impl Vertex {
    /// The counter-clockwise triangle.
    #[must_use]
    pub fn triangle(&self) -> [Point; 3] {
        self.triangle
    }
}

impl Estimate {
    fn sign(self) -> Option<Ordering> {
        (self.value.abs() > self.error).then(|| self.value.total_cmp(&0.0))
    }

    fn times(self, other: Self) -> Self {
        let value = self.value * other.value;
        let error = self.value.abs() * other.error
            + (other.value.abs() + other.error) * self.error
            + 2.0 * ROUNDING * value.abs();
        Self { value, error }
    }

    fn minus(self, other: Self) -> Self {
        let value = self.value - other.value;
        Self { value, error: (self.error + other.error) * 1.000_001 + ROUNDING * value.abs() }
    }

    fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        let relative = other.error / other.value.abs();
        if relative.is_nan() || relative >= 0.25 {
            return Self { value, error: f64::INFINITY };
        }
        let error = 2.0 * (self.error / other.value.abs() + value.abs() * relative);
        Self { value, error: error + 2.0 * ROUNDING * value.abs() }
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
#[derive(Debug, Clone, Copy)]
pub struct Disk {
    circle: Circle,
    parameter: Estimate,
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

    /// The circumcenter of the counter-clockwise `triangle`, seen from this pencil.
    #[must_use]
    pub fn vertex(&self, triangle: [Point; 3]) -> Vertex {
        let Center { at, error } = Center::estimate(triangle, self.p);
        let from_q = sub(at, self.chord);
        let reach = at[0].abs() + at[1].abs() + from_q[0].abs() + from_q[1].abs();
        let length = self.chord[0].abs() + self.chord[1].abs();
        let error = error + 8.0 * ROUNDING * reach;
        let power = Estimate { value: dot(at, from_q), error: error * (reach + error) };
        let height = Estimate { value: cross(self.chord, at), error: length * error };
        Vertex { triangle, power, height }
    }

    /// The disk inside `circle`.
    #[must_use]
    pub fn disk(&self, circle: Circle) -> Disk {
        let twice = match circle {
            Circle::Smallest => Estimate { value: 0.0, error: 0.0 },
            Circle::Through(vertex) => vertex.power.over(vertex.height),
        };
        let parameter = Estimate { value: twice.value / 2.0, error: twice.error / 2.0 };
        let [dx, dy] = self.chord;
        let center = [dx / 2.0 - parameter.value * dy, dy / 2.0 + parameter.value * dx];
        let radius = dot(center, center).sqrt();
        let error = parameter.error * (dx.abs() + dy.abs()) + 8.0 * ROUNDING * radius;
        Disk { circle, parameter: twice, center, radius, error }
    }

    /// The center of `circle` relative to p, its radius, and a bound on the error of both.
    ///
    /// To about ten digits; a center too uncertain for floating point is solved for in integers.
    #[must_use]
    pub fn center(&self, circle: Circle) -> (Point, f64, f64) {
        let Disk { center, radius, error, .. } = self.disk(circle);
        match circle {
            Circle::Through(vertex) if error.is_nan() || error > 1e-10 * radius => {
                let points = [&[self.q][..], &vertex.triangle].concat();
                let points = points.try_into().expect("q and three corners");
                let at =
                    |axis| sign::quotient(&CenterThrough { axis }, &PlaceTwice, self.p, &points);
                let center = [at(0), at(1)];
                let radius = length(center);
                (center, radius, 8.0 * ROUNDING * radius)
            }
            _ => (center, radius, error),
        }
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
        let excess = vertex.power.minus(disk.parameter.times(vertex.height));
        excess.sign().unwrap_or_else(|| match disk.circle {
            Circle::Smallest => self.power(vertex),
            Circle::Through(other) => self.exact_excess(vertex, &other),
        }) == Less
    }

    /// The sign of (v−p)·(v−q): `Less` inside the smallest circle.
    #[must_use]
    pub fn power(&self, vertex: &Vertex) -> Ordering {
        let [a, b, c] = vertex.triangle;
        let exact = || sign::exact_sign(&Power, self.p, &[self.q, a, b, c]);
        vertex.power.sign().unwrap_or_else(exact)
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

    /// `Less` if `vertex` is strictly inside the circle through `other`, which is off the line p q.
    fn exact_excess(&self, vertex: &Vertex, other: &Vertex) -> Ordering {
        let [d, e, f] = other.triangle;
        if [[d, e, f], [e, f, d], [f, d, e]].contains(&vertex.triangle) {
            return Equal;
        }
        let [a, b, c] = vertex.triangle;
        let sign = sign::exact_sign(&Inside, self.p, &[self.q, a, b, c, d, e, f]);
        if self.side(other) == Greater { sign } else { sign.reverse() }
    }
}

/// Where the center of the triangle lies in the pencil of the origin and `q`: its power times w², its height times w, and w.
fn place<T: Number>(q: &[T; 2], [a, b, c]: [&[T; 2]; 3]) -> (T, T, T) {
    let v = HomogeneousCenter::new(a, b, c);
    let from_q = [0, 1].map(|axis| v.at[axis].minus(&q[axis].times(&v.w)));
    (sign::dot(&v.at, &from_q), sign::cross(q, &v.at), v.w)
}

struct Power;

impl Form<4> for Power {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 14
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        place(q, [a, b, c]).0
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
        let (power, height, w) = place(q, [a, b, c]);
        let along = q[self.axis].times(&height.times(&w));
        let aside = q[1 - self.axis].times(&power);
        if self.axis == 0 { along.minus(&aside) } else { along.plus(&aside) }
    }
}

/// Twice the height times w: what both coordinates are divided by.
struct PlaceTwice;

impl Form<4> for PlaceTwice {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 14
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        let (_, height, w) = place(q, [a, b, c]);
        T::integer(2).times(&height.times(&w))
    }
}

struct Side;

impl Form<4> for Side {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 10
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        place(q, [a, b, c]).1
    }
}

/// Negative if the first circumcenter is inside the circle through the second, times the latter's side.
struct Inside;

impl Form<7> for Inside {
    fn bound(&self, bits: u32) -> u32 {
        12 * bits + 30
    }
    fn value<T: Number>(&self, [q, a, b, c, d, e, f]: &[[T; 2]; 7]) -> T {
        let (power, height, w) = place(q, [a, b, c]);
        let (other_power, other_height, other_w) = place(q, [d, e, f]);
        let left = power.times(&other_height).times(&other_w);
        left.minus(&other_power.times(&height).times(&w))
    }
}
