//! Filters: when the sign of a number computed in floating point can be believed.
//!
//! # What rounding does
//!
//! Let u be the rounding unit, 2⁻⁵³. The result of one operation, and the difference of two coordinates, is the true one times
//! 1 + δ with |δ| ≤ u. So if a value is the sum of terms, and no term goes through more than k operations until it is in the
//! sum, then each term comes with a factor of at most (1 + u)ᵏ or at least (1 − u)ᵏ, and the value is off by at most
//! k u (1 + k u) Σ, where Σ is the sum of the sizes of the terms, for k u ≤ 1/2 (N. J. Higham, "Accuracy and Stability of
//! Numerical Algorithms", lemma 3.1). Σ itself is computed by no more operations, and all that it sums is positive, so the
//! computed Σ is at least (1 − u)ᵏ Σ. The bound (k + 2) u Σ, computed with three roundings more, is therefore enough for any k
//! below a million. This is [`sign`], and what the two hot predicates write out.
//!
//! # What underflow does
//!
//! A product that underflows loses at most 2⁻¹⁰⁷⁵, which what follows multiplies. Coordinates are at most 2⁶⁷ (`space::order` scales
//! them), differences at most 2⁶⁸, and no filtered polynomial is of a degree above 6: so at most 5 more factors, and what all products
//! of a value lose is below 2⁻⁷⁰⁰ times its largest constant. [`UNDERFLOW`] is 2⁻⁴⁹⁸, and its weight the largest constant.

use crate::exact::number::Number;
use std::cmp::Ordering;

/// Half the distance from 1 to the next double: the relative error of one rounding.
pub const ROUNDING: f64 = f64::EPSILON / 2.0;

/// More than all that underflow can take away from a polynomial of degree up to 6 with small constants.
pub const UNDERFLOW: f64 = 1e-150;

/// The sign of `value`, if its error leaves no doubt.
///
/// The value is a sum of terms of at most `operations` operations each, sums and differences of coordinates included, whose
/// sizes sum to `size`, but for a factor of `weight`: the size of its constants.
#[inline]
#[must_use]
pub fn sign(value: f64, operations: u32, size: f64, weight: f64) -> Option<Ordering> {
    let bound = (f64::from(operations + 2) * ROUNDING * size + UNDERFLOW) * weight;
    // An overflow makes one of them infinite or not a number, and the sign unknown.
    (value.abs() > bound).then(|| sign_of(value))
}

/// The sign of a number that is not zero: one comparison, where `total_cmp` takes five instructions.
#[inline]
#[must_use]
pub fn sign_of(value: f64) -> Ordering {
    if value > 0.0 { Ordering::Greater } else { Ordering::Less }
}

/// A floating-point number with a bound on its distance from the true value, which every operation carries on.
#[derive(Debug, Clone, Copy)]
pub struct Approximate {
    /// The number.
    pub value: f64,
    /// The bound.
    pub error: f64,
}

/// Covers the roundings made in computing the bounds themselves, of up to a million operations.
pub const SLACK: f64 = 1.0 + 1e-9;

impl Approximate {
    /// The number 0.
    pub const ZERO: Self = Self { value: 0.0, error: 0.0 };

    /// A number that one rounding led to.
    #[must_use]
    pub fn rounded(value: f64) -> Self {
        Self { value, error: value.abs() * ROUNDING }
    }

    /// The sign, if the error bound leaves no doubt.
    #[inline]
    #[must_use]
    pub fn sign(&self) -> Option<Ordering> {
        // An overflow makes the error infinite or not a number, and the sign unknown.
        (self.value.abs() > self.error * SLACK).then(|| sign_of(self.value))
    }

    /// The quotient; of unknown error where the error of `other` is not far below its size.
    #[inline]
    #[must_use]
    pub fn over(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        let relative = other.error / other.value.abs();
        if relative.is_nan() || relative >= 0.25 {
            return Self { value, error: f64::INFINITY };
        }
        // |a / b − a′ / b′| ≤ (e + |a / b| f) / |b′| with |b′| ≥ 3/4 |b|.
        Self::after(value, 2.0 * (self.error / other.value.abs() + value.abs() * relative))
    }

    /// The number `value`, off by `error` and what underflow took away.
    #[inline]
    #[must_use]
    pub fn of(value: f64, error: f64) -> Self {
        Self { value, error: error + f64::MIN_POSITIVE }
    }

    #[inline]
    fn after(value: f64, inherited: f64) -> Self {
        Self::of(value, inherited + value.abs() * ROUNDING)
    }
}

impl Number for Approximate {
    fn integer(value: i64) -> Self {
        Self::rounded(value as f64)
    }
    #[inline]
    fn plus(&self, other: &Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }
    #[inline]
    fn minus(&self, other: &Self) -> Self {
        Self::after(self.value - other.value, self.error + other.error)
    }
    #[inline]
    fn times(&self, other: &Self) -> Self {
        let inherited = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Self::after(self.value * other.value, inherited)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quotient_is_off_by_no_more_than_it_says() {
        for (a, b) in [(100.0, 2.0), (-3.0, 7.0), (1e-5, -1e3), (5.0, 5.0)] {
            for (off, part) in [(10.0, 0.01), (0.1, 0.2), (0.0, 0.1), (3.0, 0.0)] {
                let [x, y] = [Approximate::of(a, off), Approximate::of(b, part * f64::abs(b))];
                let quotient = x.over(&y);
                assert!(quotient.error < 100.0 * (off + f64::abs(a)) / f64::abs(b));
                for (i, j) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                    let exact = (a + i * off) / (b * (1.0 + j * part));
                    assert!((exact - quotient.value).abs() <= quotient.error + 1e-12);
                }
            }
        }
        let unsure = Approximate::of(1.0, 0.0).over(&Approximate::of(1.0, 0.5));
        assert!(unsure.error.is_infinite());
    }
}
