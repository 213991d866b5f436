//! Whole numbers of any size as coefficients of a [`Form`](crate::exact::sign::Form).
//!
//! A parameter such as β is a double, so a ratio of whole numbers: a form multiplied by the
//! denominator has whole coefficients, and its sign is exact in the parameter, too.

use crate::exact::integer::decompose;
use crate::exact::sign::Number;
use num_bigint::{BigInt, Sign};

/// A whole number, kept as digits of 32 bits, the leading one first.
#[derive(Debug, Clone)]
pub struct Constant {
    negative: bool,
    digits: Vec<u32>,
    bits: u32,
}

impl Constant {
    /// The number `value`.
    #[must_use]
    pub fn new(value: &BigInt) -> Self {
        Self {
            negative: value.sign() == Sign::Minus,
            digits: value.iter_u32_digits().rev().collect(),
            bits: value.bits() as u32,
        }
    }

    /// The number of bits of its absolute value.
    #[must_use]
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The number, in the number system `T`.
    #[must_use]
    pub fn number<T: Number>(&self) -> T {
        let base = T::integer(1 << 32);
        let shift = |sum: T, &digit: &u32| sum.times(&base).plus(&T::integer(digit.into()));
        let size = self.digits.iter().fold(T::integer(0), shift);
        if self.negative { T::integer(0).minus(&size) } else { size }
    }
}

/// The finite double `x` as a fraction: numerator and positive denominator.
#[must_use]
pub fn fraction(x: f64) -> [BigInt; 2] {
    let (mantissa, exponent) = decompose(x);
    let power = BigInt::from(1) << exponent.unsigned_abs();
    if exponent < 0 { [mantissa.into(), power] } else { [power * mantissa, 1.into()] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_is_the_number_that_it_was_made_of() {
        for value in [0i128, 1, -7, 1 << 32, -(1 << 90) + 12345, i128::MAX / 3] {
            let constant = Constant::new(&value.into());
            assert_eq!(constant.number::<i128>(), value);
            assert_eq!(constant.number::<BigInt>(), value.into());
            assert_eq!(constant.bits(), 128 - value.unsigned_abs().leading_zeros());
        }
    }

    #[test]
    fn a_fraction_is_the_double_exactly() {
        assert_eq!(fraction(-0.75), [BigInt::from(-3), BigInt::from(4)]);
        assert_eq!(fraction(12.0), [BigInt::from(12), BigInt::from(1)]);
        assert_eq!(fraction(0.0), [BigInt::from(0), BigInt::from(1)]);
    }
}
