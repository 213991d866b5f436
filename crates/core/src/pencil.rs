//! The pencil of circles through two points, p and q, and where Voronoi vertices lie in it.
//!
//! The circle of parameter t has its center at m + t·n, m the midpoint of p and q, n the vector q − p turned
//! left by 90°. A site v to the left of p → q is strictly inside exactly for t > τ(v), one to the right exactly for
//! t < τ(v), with τ(v) = (v−p)·(v−q) / 2 (q−p)×(v−p). The paper's disks "touching s₁ and s₂" are this pencil.

use crate::point::{Point, cross, dot, sub};
use crate::sign::{self, Form, Number};
use crate::voronoi::{Center, HomogeneousCenter};
use std::cmp::Ordering::{self, Equal, Greater, Less};

const ROUNDING: f64 = f64::EPSILON / 2.0;

/// The circles through `p` and `q`.
#[derive(Debug, Clone, Copy)]
pub struct Pencil {
    /// The first point.
    pub p: Point,
    /// The second point.
    pub q: Point,
    chord: Point,
}

/// A triangle, counter-clockwise; it stands for its circumcenter, a Voronoi vertex.
pub type Triangle = [Point; 3];

/// A circle of a pencil: the smallest, or the one through a Voronoi vertex off the line p q.
#[derive(Debug, Clone, Copy)]
pub enum Circle {
    /// t = 0: the circle with diameter p q.
    Smallest,
    /// t = τ of the circumcenter of a triangle.
    Through(Triangle),
}

/// A circle of a pencil in floating point, with bounds on its errors.
#[derive(Debug, Clone, Copy)]
pub struct Disk {
    circle: Circle,
    parameter: f64,
    parameter_error: f64,
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

    /// The disk inside `circle`.
    #[must_use]
    pub fn disk(&self, circle: Circle) -> Disk {
        let (parameter, parameter_error) = match circle {
            Circle::Smallest => (0.0, 0.0),
            Circle::Through(triangle) => self.parameter(triangle),
        };
        let [dx, dy] = self.chord;
        let center = [dx / 2.0 - parameter * dy, dy / 2.0 + parameter * dx];
        let radius = dot(center, center).sqrt();
        let error = parameter_error * (dx.abs() + dy.abs()) + 8.0 * ROUNDING * radius;
        Disk { circle, parameter, parameter_error, center, radius, error }
    }

    /// τ of the circumcenter of `triangle`, and a bound on the error.
    fn parameter(&self, triangle: Triangle) -> (f64, f64) {
        let place = self.place(triangle);
        let height = 2.0 * place.height;
        let value = place.power / height;
        let relative = place.height_error / place.height.abs();
        if !(relative < 0.25) {
            return (value, f64::INFINITY);
        }
        let error = 2.0 * (place.power_error / height.abs() + value.abs() * relative);
        (value, error + 4.0 * ROUNDING * value.abs())
    }

    fn place(&self, triangle: Triangle) -> Place {
        let Center { at, error } = Center::estimate(triangle, self.p);
        let from_q = sub(at, self.chord);
        let reach = at[0].abs() + at[1].abs() + from_q[0].abs() + from_q[1].abs();
        let length = self.chord[0].abs() + self.chord[1].abs();
        Place {
            power: dot(at, from_q),
            power_error: (error + 8.0 * ROUNDING * reach) * (reach + error),
            height: cross(self.chord, at),
            height_error: length * (error + 8.0 * ROUNDING * reach),
        }
    }

    /// Is the circumcenter of `triangle` strictly inside `disk`?
    #[must_use]
    pub fn holds(&self, disk: &Disk, triangle: Triangle) -> bool {
        let place = self.place(triangle);
        let t = 2.0 * disk.parameter;
        let excess = place.power - t * place.height;
        let error = place.power_error
            + t.abs() * place.height_error
            + 2.0 * disk.parameter_error * (place.height.abs() + place.height_error)
            + 8.0 * ROUNDING * (place.power.abs() + (t * place.height).abs());
        if excess.abs() > error {
            return excess < 0.0;
        }
        match disk.circle {
            Circle::Smallest => self.power(triangle) == Less,
            Circle::Through(other) => self.is_inside(triangle, other),
        }
    }

    /// The sign of (v−p)·(v−q) for the circumcenter v: `Less` inside the smallest circle.
    #[must_use]
    pub fn power(&self, [a, b, c]: Triangle) -> Ordering {
        sign::sign(&Power, self.p, &[self.q, a, b, c])
    }

    /// The side of p → q that the circumcenter of `triangle` is on: `Greater` is left.
    #[must_use]
    pub fn side(&self, [a, b, c]: Triangle) -> Ordering {
        sign::sign(&Side, self.p, &[self.q, a, b, c])
    }

    /// Is the circumcenter of `triangle` strictly inside the circle through that of `other`?
    #[must_use]
    pub fn is_inside(&self, [a, b, c]: Triangle, other: Triangle) -> bool {
        let [d, e, f] = other;
        let sign = sign::sign(&Inside, self.p, &[self.q, a, b, c, d, e, f]);
        match self.side(other) {
            Greater => sign == Less,
            Less => sign == Greater,
            Equal => false,
        }
    }

    /// Of the empty circles between `low` and `high`, the Voronoi vertices that bound them from the right and the left of
    /// p → q, the smallest. `None` if there are none.
    #[must_use]
    pub fn smallest_between(&self, low: Option<Triangle>, high: Option<Triangle>) -> Option<Circle> {
        if let (Some(low), Some(high)) = (low, high)
            && self.is_inside(low, high)
        {
            return None;
        }
        match (low, high) {
            (_, Some(high)) if self.power(high) == Less => Some(Circle::Through(high)),
            (Some(low), _) if self.power(low) == Less => Some(Circle::Through(low)),
            _ => Some(Circle::Smallest),
        }
    }
}

/// A circumcenter v seen from the chord p q, with error bounds.
struct Place {
    /// (v−p)·(v−q): negative inside the smallest circle.
    power: f64,
    power_error: f64,
    /// (q−p)×(v−p): positive to the left.
    height: f64,
    height_error: f64,
}

/// The exact counterpart of [`Place`]: power times w², and height times w.
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
