//! Numbers of twice the precision of a double: the unevaluated sum of two, with a bound on the error.
//!
//! The operations are those of M. Joldes, J.-M. Muller, V. Popescu, "Tight and Rigorous Error Bounds for Basic Building Blocks of
//! Double-Word Arithmetic", ACM Transactions on Mathematical Software 44 (2017): sums are off by at most 3 u² (1 + 4 u) of their value,
//! products by 5 u² (J.-M. Muller, L. Rideau, "Formalization of Double-Word Arithmetic", 2022), u = 2⁻⁵³.

use crate::exact::filter::{Approximate, ROUNDING, SLACK, sign_of};
use crate::exact::number::Number;
use crate::point::Point;
use std::cmp::Ordering;

/// A number of about 106 bits, high + low, and a bound on its distance from the true value.
#[derive(Debug, Clone, Copy)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
    error: f64,
}

/// What one operation is off by, as a part of its value: more than 5 u².
const UNIT: f64 = 8.0 * ROUNDING * ROUNDING;

/// a + b, rounded, and what was rounded off (D. E. Knuth).
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// The same where |a| ≥ |b| (T. J. Dekker).
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Two doubles of half as many bits that sum to `x` (G. W. Veltkamp).
#[inline]
fn halves(x: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * x;
    let high = shifted - (shifted - x);
    (high, x - high)
}

/// a · b, rounded, and what was rounded off (T. J. Dekker).
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a, c), (b, d)) = (halves(a), halves(b));
    (product, ((a * b - product) + a * d + c * b) + c * d)
}

/// x² + y² as the nearest double and what that leaves, if two doubles hold all of it.
#[must_use]
pub fn squared_length(v: Point) -> Option<(f64, f64)> {
    if v.iter().any(|x| x.abs() < 1e-140 && *x != 0.0) {
        // The low part of a square may underflow.
        return None;
    }
    let [(x, x_rest), (y, y_rest)] = v.map(|x| two_product(x, x));
    let ((high, aside), (rest, lost)) = (two_sum(x, y), two_sum(x_rest, y_rest));
    let (rest, more) = two_sum(aside, rest);
    let (square, rest) = fast_two_sum(high, rest);
    // There is one zero.
    (lost == 0.0 && more == 0.0).then_some((square, rest + 0.0))
}

impl DoubleDouble {
    /// The differences of `points` and `origin`, divided by a power of two near the largest of them; and that power.
    #[must_use]
    pub fn differences<const N: usize>(
        origin: Point,
        points: &[Point; N],
    ) -> ([[Self; 2]; N], f64) {
        let differences = points.map(|p| [0, 1].map(|axis| two_sum(p[axis], -origin[axis])));
        let largest =
            differences.iter().flatten().fold(0.0, |most: f64, (high, _)| most.max(high.abs()));
        // The exponent alone; the leading bits of a subnormal number are all zero.
        let unit = f64::from_bits(largest.to_bits() & !((1 << 52) - 1)).max(f64::MIN_POSITIVE);
        let scaled = |(high, low): (f64, f64)| {
            let (a, b) = (high / unit, low / unit);
            let error = if a * unit == high && b * unit == low { 0.0 } else { f64::MIN_POSITIVE };
            Self { high: a, low: b, error }
        };
        (differences.map(|vector| vector.map(scaled)), unit)
    }

    /// The sign, if the error bound leaves no doubt.
    #[must_use]
    pub fn sign(&self) -> Option<Ordering> {
        (self.high.abs() > self.error * SLACK).then(|| sign_of(self.high))
    }

    /// The quotient as a double, if its error is below this part of it.
    #[must_use]
    pub fn over(&self, other: &Self, part: f64) -> Option<f64> {
        let Approximate { value, error } = self.rounded().over(&other.rounded());
        (error <= part * value.abs()).then_some(value)
    }

    fn rounded(&self) -> Approximate {
        Approximate { value: self.high, error: (self.error + self.low.abs()) * SLACK }
    }

    fn after((high, low): (f64, f64), inherited: f64) -> Self {
        // The smallest normal number covers underflow.
        Self { high, low, error: inherited + high.abs() * UNIT + f64::MIN_POSITIVE }
    }
}

impl Number for DoubleDouble {
    fn integer(value: i64) -> Self {
        let high = value as f64;
        let low = (i128::from(value) - high as i128) as f64;
        Self { high, low, error: 0.0 }
    }
    fn plus(&self, other: &Self) -> Self {
        let (high, low) = two_sum(self.high, other.high);
        let (more, less) = two_sum(self.low, other.low);
        let (high, low) = fast_two_sum(high, low + more);
        Self::after(fast_two_sum(high, low + less), self.error + other.error)
    }
    fn minus(&self, other: &Self) -> Self {
        self.plus(&Self { high: -other.high, low: -other.low, error: other.error })
    }
    fn times(&self, other: &Self) -> Self {
        let (high, low) = two_product(self.high, other.high);
        let aside = self.high * other.low + self.low * other.high;
        let inherited = (self.high.abs() + self.low.abs()) * other.error
            + (other.high.abs() + other.low.abs()) * self.error
            + self.error * other.error;
        Self::after(fast_two_sum(high, low + aside), inherited)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::integer::decompose;
    use crate::xorshift::Xorshift;
    use num_bigint::BigInt;
    use num_traits::Signed;

    /// `x` in units of 2⁻⁴⁰⁰.
    fn whole(x: f64) -> BigInt {
        let (mantissa, exponent) = decompose(x);
        BigInt::from(mantissa) << (exponent + 400)
    }

    fn total(x: &DoubleDouble) -> BigInt {
        whole(x.high) + whole(x.low)
    }

    #[test]
    fn sums_and_products_are_within_their_bounds() {
        let mut random = Xorshift(1);
        let mut random = || {
            let state = random.next();
            let bits = state & ((1 << 52) - 1) & (u64::MAX << (state % 50));
            f64::from_bits(((1000 + state % 46) << 52) | bits)
                * if state & 1 << 60 == 0 { 1.0 } else { -1.0 }
        };
        for _ in 0..100_000 {
            let mut number =
                || DoubleDouble::differences([random(), 0.0], &[[random(), 0.0]]).0[0][0];
            let (a, b) = (number(), number());
            let (x, y) = (total(&a), total(&b));
            let off = |found: DoubleDouble, exact: BigInt| {
                (total(&found) - exact).abs() <= whole(found.error)
            };
            assert!(off(a.plus(&b), &x + &y) && off(a.minus(&b), &x - &y));
            assert!(off(a.times(&b), (x * y) >> 400));
        }
    }

    #[test]
    fn squared_lengths_are_whole_or_none() {
        let mut held = 0;
        for k in 0..1000u32 {
            let steps = f64::EPSILON * f64::from(k * 7919 % 64);
            let v = [1.0 + steps, steps * f64::from(k % 3) + f64::from(k % 2) * 0.1];
            let exact: BigInt = v.iter().map(|&x| whole(x) * whole(x)).sum();
            if let Some((high, low)) = squared_length(v) {
                held += 1;
                assert_eq!((whole(high) + whole(low)) << 400, exact);
                assert_eq!(high + low, high);
            }
        }
        assert!((400..1000).contains(&held));
        assert_eq!(squared_length([3.0, 4.0]), Some((25.0, 0.0)));
        assert_eq!(squared_length([1.0, 1e-150]), None);
    }

    #[test]
    fn differences_that_no_double_holds_are_exact() {
        let ([[x, y]], unit) =
            DoubleDouble::differences([1.0, -3.0], &[[2f64.powi(-80), 2f64.powi(60)]]);
        assert_eq!((x.high * unit, x.low * unit, x.error), (-1.0, 2f64.powi(-80), 0.0));
        assert_eq!((y.high * unit, y.low * unit, y.error), (2f64.powi(60), 3.0, 0.0));
    }

    #[test]
    fn whole_numbers_are_exact() {
        for value in [0, -1, 1 << 53, (1 << 62) + 1, i64::MAX, i64::MIN] {
            let x = DoubleDouble::integer(value);
            assert_eq!(total(&x), BigInt::from(value) << 400);
        }
    }
}
