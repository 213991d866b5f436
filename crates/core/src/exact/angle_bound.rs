//! An angle that the angles opposite to an edge are compared with, exactly.
//!
//! The points that see an edge under one angle lie on a circle through its ends, so "no point is in
//! this disk" says "no point on this side sees the edge under a larger angle". β and γ fix that
//! angle by its sine.

use crate::exact::constant::{Constant, fraction};
use crate::exact::filter;
use crate::exact::sign::{self, Form, Number};
use crate::point::{Point, cross, dot, sub};
use num_bigint::BigInt;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// An angle between 0° and 180°.
#[derive(Debug, Clone)]
pub struct AngleBound {
    /// The cotangent, to a few roundings.
    cotangent: f64,
    is_obtuse: bool,
    excess: Excess,
}

impl AngleBound {
    /// The angle whose cotangent is the finite `cotangent`.
    #[must_use]
    pub fn of_cotangent(cotangent: f64) -> Self {
        let [n, d] = fraction(cotangent);
        Self { cotangent, is_obtuse: cotangent < 0.0, excess: Excess::new(&(&d * &d), &(&n * &n)) }
    }

    /// The angle of Veltkamp's parameter −1 ≤ `c` ≤ 1: its sine is 1 − |c|, and it is obtuse if c <
    /// 0.
    #[must_use]
    pub fn of_gamma(c: f64) -> Self {
        let size = c.abs();
        let cotangent = (size * (2.0 - size)).sqrt() / (1.0 - size);
        let [n, d] = fraction(size);
        Self::of_sine(&(&d - n), &d, cotangent, c < 0.0)
    }

    /// The angle of `beta` > 0: acute with sine 1 / β for β ≥ 1, obtuse with sine β for β < 1.
    #[must_use]
    pub fn of_beta(beta: f64) -> Self {
        let [n, d] = fraction(beta);
        if beta < 1.0 {
            let cotangent = ((1.0 - beta) * (1.0 + beta)).sqrt() / beta;
            Self::of_sine(&n, &d, cotangent, true)
        } else {
            let cotangent = (beta - 1.0).sqrt() * (beta + 1.0).sqrt();
            Self::of_sine(&d, &n, cotangent, false)
        }
    }

    /// The angle with the sine n / d and the size of the cotangent near `cotangent`.
    fn of_sine(n: &BigInt, d: &BigInt, cotangent: f64, is_obtuse: bool) -> Self {
        let cotangent = if is_obtuse { -cotangent } else { cotangent };
        Self { cotangent, is_obtuse, excess: Excess::new(&(n * n), &(d * d - n * n)) }
    }

    /// The cotangent, to a few roundings; infinite for 0° and 180°.
    #[must_use]
    pub fn cotangent(&self) -> f64 {
        self.cotangent
    }

    /// Is the angle p r q at most this one? `r` is not between `p` and `q`.
    #[inline]
    #[must_use]
    pub fn admits(&self, p: Point, q: Point, r: Point) -> bool {
        self.compare(p, q, r) != Less
    }

    /// The cotangent of the angle p r q, compared with that of this angle: `Greater` is a smaller
    /// angle.
    #[inline]
    #[must_use]
    pub fn compare(&self, p: Point, q: Point, r: Point) -> Ordering {
        let (u, v) = (sub(p, r), sub(q, r));
        let excess = dot(u, v) - self.cotangent * cross(u, v).abs();
        let size = (u[0].abs() + u[1].abs()) * (v[0].abs() + v[1].abs());
        // The cotangent counts for eight operations, which is more than lead to it.
        filter::sign(excess, 15, size, 1.0 + self.cotangent.abs())
            .unwrap_or_else(|| self.exact(p, q, r))
    }

    #[cold]
    fn exact(&self, p: Point, q: Point, r: Point) -> Ordering {
        match (sign::sign(&OppositeDot, p, &[q, r]), self.is_obtuse) {
            (Less, false) => Less,
            (Equal | Greater, true) => Greater,
            (_, false) => sign::sign(&self.excess, p, &[q, r]),
            (Less, true) => sign::sign(&self.excess, p, &[q, r]).reverse(),
        }
    }
}

/// The dot product of the sides of the angle at `r` opposite to the edge from the origin to `q`.
///
/// Negative exactly for the points inside the circle with that edge as diameter.
pub struct OppositeDot;

impl Form<2> for OppositeDot {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 2
    }
    fn value<T: Number>(&self, [q, r]: &[[T; 2]; 2]) -> T {
        sign::dot(r, &sign::difference(r, q))
    }
}

/// dots · dot² − crosses · cross² of the angle at `r` opposite to the edge from the origin to `q`.
///
/// Positive if the cotangent is larger in size than the root of crosses / dots.
#[derive(Debug, Clone)]
struct Excess {
    dots: Constant,
    crosses: Constant,
}

impl Excess {
    fn new(dots: &BigInt, crosses: &BigInt) -> Self {
        Self { dots: Constant::new(dots), crosses: Constant::new(crosses) }
    }
}

impl Form<2> for Excess {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 5 + self.dots.bits().max(self.crosses.bits())
    }
    fn value<T: Number>(&self, at: &[[T; 2]; 2]) -> T {
        let dot = OppositeDot.value(at);
        let cross = sign::cross(&at[0], &at[1]);
        let dots = self.dots.number::<T>().times(&dot.times(&dot));
        dots.minus(&self.crosses.number::<T>().times(&cross.times(&cross)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;

    #[test]
    fn an_angle_is_compared_right_where_that_changes() {
        let bounds =
            [AngleBound::of_beta(1.7), AngleBound::of_beta(0.3), AngleBound::of_gamma(0.2)];
        for bound in &bounds {
            let check = |p, [q, r]: [Point; 2], _| {
                if p != r && q != r {
                    assert_eq!(bound.compare(p, q, r), bound.exact(p, q, r));
                }
            };
            at_brinks(&bound.excess, false, check);
            at_brinks(&OppositeDot, false, check);
        }
    }

    #[test]
    fn the_excess_is_right_where_its_sign_changes() {
        let excess = AngleBound::of_beta(1.7).excess;
        at_brinks(&excess, false, |origin, points, expected| {
            assert_eq!(sign::sign(&excess, origin, &points), expected);
        });
    }
}
