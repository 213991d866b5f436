//! Questions about the two angles opposite to an edge, as polynomials in their cotangents.

use crate::exact::angle::Angle;
use crate::exact::constant::{Constant, fraction};
use crate::exact::filter;
use crate::exact::sign::{self, Form, Number};
use crate::point::Point;
use num_bigint::BigInt;
use std::cmp::Ordering::Less;

/// x cot·cot + y (cot + cot) + z of the angles at two points on different sides of an edge.
///
/// Both are multiplied by the sines, and so by positive numbers, to be polynomials in the
/// coordinates.
#[derive(Debug, Clone)]
pub struct AnglePair {
    rounded: [f64; 3],
    exact: [Constant; 3],
}

impl AnglePair {
    /// cot + cot − 2: the dual Voronoi edge, measured in edges, less one, doubled.
    #[must_use]
    pub fn dual_length() -> Self {
        Self::new([0.0, 1.0, -2.0], [0.into(), 1.into(), (-2).into()])
    }

    /// cot · cot − 1 + `cotangent` (cot + cot): the sign tells whether the angles sum to at most
    /// 180° less the angle of that cotangent.
    #[must_use]
    pub fn sum(cotangent: f64) -> Self {
        let [n, d] = fraction(cotangent);
        Self::new([1.0, cotangent, -1.0], [d.clone(), n, -d])
    }

    fn new(rounded: [f64; 3], exact: [BigInt; 3]) -> Self {
        Self { rounded, exact: exact.map(|value| Constant::new(&value)) }
    }

    /// Is the value 0 or more for the angles at `left` and `right` of p → q?
    #[inline]
    #[must_use]
    pub fn admits(&self, p: Point, q: Point, left: Point, right: Point) -> bool {
        let [x, y, z] = self.rounded;
        let (a, b) = (Angle::at(left, p, q), Angle::at(right, q, p));
        let mixed = a.dot * b.cross + a.cross * b.dot;
        let value = x * (a.dot * b.dot) + y * mixed + z * (a.cross * b.cross);
        let weight = x.abs() + 2.0 * y.abs() + z.abs();
        let size = a.size * b.size;
        // Four operations lead to each product of an angle and four to their sum; sizes are off by nine more.
        let sign = filter::sign(value, 24, size, weight);
        sign.unwrap_or_else(|| sign::sign(self, p, &[q, left, right])) != Less
    }
}

impl Form<3> for AnglePair {
    fn bound(&self, bits: u32) -> u32 {
        let coefficient = self.exact.iter().map(Constant::bits).max().unwrap_or(0);
        4 * bits + 7 + coefficient
    }
    fn value<T: Number>(&self, [q, left, right]: &[[T; 2]; 3]) -> T {
        let dot = |apex| sign::dot(apex, &sign::difference(apex, q));
        let (a, c) = (dot(left), sign::cross(q, left));
        let (b, d) = (dot(right), sign::cross(right, q));
        let [x, y, z] = self.exact.each_ref().map(Constant::number::<T>);
        let mixed = a.times(&d).plus(&b.times(&c));
        x.times(&a.times(&b)).plus(&y.times(&mixed)).plus(&z.times(&c.times(&d)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn a_pair_of_angles_is_judged_right_where_that_changes() {
        for pair in [AnglePair::dual_length(), AnglePair::sum(0.0), AnglePair::sum(-3.7)] {
            assert_bounded(&pair);
            at_brinks(&pair, false, |p, [q, left, right], sign| {
                assert_eq!(pair.admits(p, q, left, right), sign != Less);
            });
        }
    }
}
