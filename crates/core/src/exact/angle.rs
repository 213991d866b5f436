//! The angle that a point sees a segment under, in floating point, with a bound on its error.
//!
//! An angle is kept as the dot product and the cross product of its sides; the cotangent is their quotient, so angles at two
//! points are compared, and added, without a division.
//!
//! # The error
//!
//! Let u be the rounding unit, 2⁻⁵³, and let the sides be (x, y) and (x′, y′), exactly. Each computed coordinate is one
//! rounding off, each product one more, their sum one more: every term of the dot product xx′ + yy′ gets a factor of at most
//! (1 + u)⁴, so the product is off by at most e = 4.01 u (|xx′| + |yy′|), which by Cauchy's inequality is at most 4.01 u r with r
//! the product of the two lengths. So is the cross product, by the same words. By Lagrange's identity r² = dot² + cross², so
//! r ≤ |dot| + |cross|: the sizes of the results alone bound their errors. Computed, that sum is at least (1 − 9 u) r. In short:
//!
//! 1. *dot* and *cross* are each off by at most 4.1 u · `size`.
//!
//! For two angles with products (d, c) and (d′, c′), the value d c′ − d′ c is off by |d| e′ + |c′| e + |d′| e + |c| e′ and products of errors,
//! where |d| + |c| ≤ √2 r: by at most 2 √2 · 4.01 u r r′ + O(u²) < 11.4 u r r′. Two products and a difference are rounded, which adds
//! at most u (|d c′| + |d′ c|) + u |d c′ − d′ c| ≤ 2 u r r′, by Cauchy's inequality again. So are d d′ − c c′ and their like. In short:
//!
//! 2. a sum or difference of two products of one number each of two angles is off by at most 13.5 u · `size` · `size′`.

use crate::exact::filter::{ROUNDING, UNDERFLOW, sign_of};
use crate::point::{Point, cross, dot, sub};
use std::cmp::Ordering;

/// An angle as the dot and cross product of its sides.
#[derive(Debug, Clone, Copy)]
pub struct Angle {
    /// The dot product.
    pub dot: f64,
    /// The cross product: positive if the second side is to the left of the first.
    pub cross: f64,
    /// The sum of their sizes, which their errors are relative to.
    pub size: f64,
}

impl Angle {
    /// The angle at `apex` from `p` to `q`.
    #[inline]
    #[must_use]
    pub fn at(apex: Point, p: Point, q: Point) -> Self {
        let (to_p, to_q) = (sub(p, apex), sub(q, apex));
        let (dot, cross) = (dot(to_p, to_q), cross(to_p, to_q));
        Self { dot, cross, size: dot.abs() + cross.abs() }
    }

    /// The sign of the cross product, if its error leaves no doubt.
    #[inline]
    #[must_use]
    pub fn turn(&self) -> Option<Ordering> {
        self.sign(self.cross)
    }

    /// The sign of the dot product, if its error leaves no doubt: greater where the angle is acute.
    #[inline]
    #[must_use]
    pub fn acuteness(&self) -> Option<Ordering> {
        self.sign(self.dot)
    }

    /// The sign of one of the products.
    #[inline]
    fn sign(&self, product: f64) -> Option<Ordering> {
        let is_sure = product.abs() > 5.0 * ROUNDING * self.size + UNDERFLOW;
        is_sure.then(|| sign_of(product))
    }
}

/// The sign of `value`, made of two products of a number of `a` and one of `b`, if its error leaves no doubt.
#[inline]
#[must_use]
pub fn mixed_sign(value: f64, a: &Angle, b: &Angle) -> Option<Ordering> {
    let is_sure = value.abs() > 14.0 * ROUNDING * (a.size * b.size) + UNDERFLOW;
    is_sure.then(|| sign_of(value))
}
