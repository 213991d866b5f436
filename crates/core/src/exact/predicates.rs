//! Orientation and in-circle tests: a static filter in line, adaptive expansions behind it.
//!
//! The filters and their constants are those of J. R. Shewchuk, "Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates", Discrete & Computational Geometry 18 (1997),
//! sections 4.3 and 4.4; the expansions are the crate `robust`'s. These are exact unless a product
//! underflows, so coordinates that small take the integers of `sign` instead.

use crate::exact::angle::{Angle, mixed_sign};
use crate::exact::filter::{ROUNDING, UNDERFLOW, sign_of};
use crate::exact::integer::small_differences;
use crate::exact::sign::{Form, Number, exact_sign};
use crate::point::{Point, dot, sub};
use ethnum::I256;
use std::cmp::Ordering::{self, Greater};

const ORIENT_BOUND: f64 = (3.0 + 16.0 * ROUNDING) * ROUNDING;
const IN_CIRCLE_BOUND: f64 = (10.0 + 96.0 * ROUNDING) * ROUNDING;

/// On which side of the line from `a` to `b` does `c` lie? `Greater` is left.
#[inline]
#[must_use]
pub fn orientation(a: Point, b: Point, c: Point) -> Ordering {
    let (ca, cb) = (sub(a, c), sub(b, c));
    let (left, right) = (ca[0] * cb[1], ca[1] * cb[0]);
    let determinant = left - right;
    if determinant.abs() > ORIENT_BOUND * (left.abs() + right.abs()) + UNDERFLOW {
        return sign_of(determinant);
    }
    exact_orientation(a, b, c)
}

/// Does `c` lie strictly to the left of the line from `a` to `b`?
#[inline]
#[must_use]
pub fn is_left(a: Point, b: Point, c: Point) -> bool {
    orientation(a, b, c) == Greater
}

/// Does `d` lie strictly inside the circle through the counter-clockwise `a`, `b`, `c`?
#[inline]
#[must_use]
pub fn in_circle(a: Point, b: Point, c: Point, d: Point) -> bool {
    let (da, db, dc) = (sub(a, d), sub(b, d), sub(c, d));
    let minors = [(db, dc), (dc, da), (da, db)].map(|(u, v)| (u[0] * v[1], u[1] * v[0]));
    let lifts = [dot(da, da), dot(db, db), dot(dc, dc)];
    let term = |k: usize| lifts[k] * (minors[k].0 - minors[k].1);
    let size = |k: usize| lifts[k] * (minors[k].0.abs() + minors[k].1.abs());
    let determinant = term(0) + term(1) + term(2);
    let bound = IN_CIRCLE_BOUND * (size(0) + size(1) + size(2)) + UNDERFLOW;
    if determinant.abs() > bound {
        return determinant > 0.0;
    }
    exact_in_circle(a, b, c, d)
}

/// The tests of many points against one directed base, a → b, each point looked at once.
///
/// The circles through a and b are a pencil, and the angle that a point sees the base under tells which of them it is on.
#[derive(Debug, Clone, Copy)]
pub struct Base {
    /// Where the base starts.
    pub a: Point,
    /// Where it ends.
    pub b: Point,
}

impl Base {
    /// The angle that `point` sees the base under.
    #[inline]
    #[must_use]
    pub fn sight(&self, point: Point) -> Angle {
        Angle::at(point, self.a, self.b)
    }

    /// Is `c`, which sees the base under `angle`, strictly to its left?
    #[inline]
    #[must_use]
    pub fn is_left(&self, c: Point, angle: &Angle) -> bool {
        angle.turn().unwrap_or_else(|| exact_orientation(self.a, self.b, c)) == Greater
    }

    /// Is `d` strictly inside the circle through the base and `c`, which is to its left?
    ///
    /// On the left a larger angle, so a smaller cotangent, is farther inside; times the cross product of c's angle, which is
    /// positive, the difference of cotangents is the in-circle determinant, whichever side d is on.
    #[inline]
    #[must_use]
    pub fn in_circle(&self, [c, d]: [Point; 2], [at_c, at_d]: [&Angle; 2]) -> bool {
        let determinant = at_c.dot * at_d.cross - at_d.dot * at_c.cross;
        match mixed_sign(determinant, at_c, at_d) {
            Some(sign) => sign == Greater,
            None => exact_in_circle(self.a, self.b, c, d),
        }
    }
}

/// Are the products of this coordinate safe from underflow and overflow in expansions?
fn is_moderate(x: f64) -> bool {
    x == 0.0 || (1e-55..1e55).contains(&x.abs())
}

#[cold]
#[inline(never)]
fn exact_orientation(a: Point, b: Point, c: Point) -> Ordering {
    if [a, b, c].iter().flatten().copied().all(is_moderate) {
        let sign = robust::orient2d(coord(a), coord(b), coord(c));
        // Zero may come with a minus sign, which `total_cmp` would take for less.
        return sign.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
    }
    exact_sign(&Orientation, c, &[a, b])
}

#[cold]
#[inline(never)]
fn exact_in_circle(a: Point, b: Point, c: Point, d: Point) -> bool {
    // Ties come in crowds, on lattices and circles, where integers are quicker than expansions.
    if let Some((at, bits)) = small_differences(d, &[a, b, c]) {
        return if bits < 15 { InCircle.value(&at) > 0 } else { wide_in_circle(at) };
    }
    if [a, b, c, d].iter().flatten().copied().all(is_moderate) {
        return robust::incircle(coord(a), coord(b), coord(c), coord(d)) > 0.0;
    }
    exact_sign(&InCircle, d, &[a, b, c]) == Greater
}

/// The in-circle test on differences of up to 62 bits: products of two in 128, of four in 256.
fn wide_in_circle(at: [[i64; 2]; 3]) -> bool {
    let [a, b, c] = at.map(|vector| vector.map(i128::from));
    let term = |u: [i128; 2], v: [i128; 2], w: [i128; 2]| {
        let lift = u[0] * u[0] + u[1] * u[1];
        I256::from(lift) * I256::from(v[0] * w[1] - v[1] * w[0])
    };
    term(a, b, c) + term(b, c, a) + term(c, a, b) > 0
}

fn coord(p: Point) -> robust::Coord<f64> {
    robust::Coord { x: p[0], y: p[1] }
}

/// Twice the signed area of the triangle of the origin and two points.
struct Orientation;

impl Form<2> for Orientation {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 1
    }
    fn value<T: Number>(&self, [a, b]: &[[T; 2]; 2]) -> T {
        crate::exact::sign::cross(a, b)
    }
}

/// Positive if the origin is inside the circle through three counter-clockwise points.
struct InCircle;

impl Form<3> for InCircle {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 4
    }
    fn value<T: Number>(&self, [a, b, c]: &[[T; 2]; 3]) -> T {
        let term = |u: &[T; 2], v: &[T; 2], w: &[T; 2]| {
            crate::exact::sign::dot(u, u).times(&crate::exact::sign::cross(v, w))
        };
        term(a, b, c).plus(&term(b, c, a)).plus(&term(c, a, b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        assert_bounded(&Orientation);
        assert_bounded(&InCircle);
    }

    #[test]
    fn orientation_is_right_where_it_changes() {
        at_brinks(&Orientation, false, |c, [a, b], sign| {
            assert_eq!(orientation(a, b, c), sign);
            let (base, seen) = (Base { a, b }, Base { a, b }.sight(c));
            assert_eq!(base.is_left(c, &seen), sign == Greater);
        });
    }

    #[test]
    fn a_point_in_a_circle_is_told_where_that_changes() {
        at_brinks(&InCircle, false, |d, [a, b, c], sign| {
            if !is_left(a, b, c) {
                return;
            }
            assert_eq!(in_circle(a, b, c, d), sign == Greater);
            let base = Base { a, b };
            let seen = [base.sight(c), base.sight(d)];
            assert_eq!(base.in_circle([c, d], seen.each_ref()), sign == Greater);
        });
    }

    #[test]
    fn exact_branches_agree_with_each_other_on_a_lattice_a_few_ulps_off() {
        let near = |x: f64, k: i32| (0..k).fold(x, |x, _| x.next_up());
        for k in 0..4 {
            let (a, b, c) = ([0.0, 0.0], [1.0, 0.0], [1.0, near(1.0, k)]);
            let d = [0.0, near(1.0, (k * 7) % 4)];
            let by_integers = exact_sign(&InCircle, d, &[a, b, c]) == Greater;
            assert_eq!(exact_in_circle(a, b, c, d), by_integers);
            let e = [0.5, near(0.5, k)];
            assert_eq!(orientation(a, c, e), exact_sign(&Orientation, e, &[a, c]));
        }
    }

    #[test]
    fn points_in_line_turn_neither_way_where_zero_is_negative() {
        for (x, y) in [(-1.0, 0.0), (0.0, -1.0), (-1.0, -1.0), (1.0, -1.0), (0.1, -0.3)] {
            let at = |t: f64| [t * x, t * y];
            assert_eq!(orientation(at(1.0), at(2.0), at(4.0)), Ordering::Equal);
            assert_eq!(orientation(at(4.0), at(-2.0), at(1.0)), Ordering::Equal);
        }
    }

    #[test]
    fn underflow_does_not_hide_a_turn() {
        let tiny = 2f64.powi(-600);
        assert!(is_left([0.0, 0.0], [tiny, 0.0], [tiny, tiny]));
        assert!(in_circle([0.0, 0.0], [tiny, 0.0], [0.0, tiny], [tiny / 2.0, tiny / 2.0]));
    }
}
