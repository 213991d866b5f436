//! Numbers that a polynomial can be evaluated in: integers of several widths here, floating point with error bounds elsewhere.

use ethnum::I256;
use num_bigint::BigInt;

/// The ring operations that a [`Form`] may use.
pub trait Number: Clone {
    /// The number `value`.
    fn integer(value: i64) -> Self;
    /// `self + other`.
    #[must_use]
    fn plus(&self, other: &Self) -> Self;
    /// `self - other`.
    #[must_use]
    fn minus(&self, other: &Self) -> Self;
    /// `self * other`.
    #[must_use]
    fn times(&self, other: &Self) -> Self;
}

/// The dot product of two vectors of numbers.
pub fn dot<T: Number>(a: &[T; 2], b: &[T; 2]) -> T {
    a[0].times(&b[0]).plus(&a[1].times(&b[1]))
}

/// The cross product of two vectors of numbers.
pub fn cross<T: Number>(a: &[T; 2], b: &[T; 2]) -> T {
    a[0].times(&b[1]).minus(&a[1].times(&b[0]))
}

/// The difference of two vectors of numbers.
pub fn difference<T: Number>(a: &[T; 2], b: &[T; 2]) -> [T; 2] {
    [a[0].minus(&b[0]), a[1].minus(&b[1])]
}

macro_rules! exact_number {
    ($($integer:ty),*) => {$(
        impl Number for $integer {
            fn integer(value: i64) -> Self {
                value.into()
            }
            fn plus(&self, other: &Self) -> Self {
                self + other
            }
            fn minus(&self, other: &Self) -> Self {
                self - other
            }
            fn times(&self, other: &Self) -> Self {
                self * other
            }
        }
    )*};
}

exact_number!(i64, i128, I256, BigInt);
