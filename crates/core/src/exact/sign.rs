//! Exact signs of polynomials, written once and evaluated in up to three number systems.
//!
//! A geometric question is the sign of a [`Form`]: a polynomial in the differences of coordinates.
//! [`sign`] evaluates it first in floating point with a running error bound, then, where the bound
//! cannot tell, in integers: every double is an integer times a power of two, so the differences are
//! integers in a common unit. Mostly the value fits in 64, 128 or 256 bits, where it costs little more
//! than in floating point; else the integers are `BigInt`.

use crate::point::{Point, sub};
use ethnum::I256;
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::cmp::Ordering;

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

/// A polynomial in the coordinates of `N` points relative to an origin.
///
/// It must be homogeneous: scaling all coordinates by a positive factor keeps its sign.
pub trait Form<const N: usize> {
    /// The binary logarithm of a bound on the value's size, given that each coordinate difference is
    /// smaller than two to the power `bits`.
    fn bound(&self, bits: u32) -> u32;
    /// The value, for the coordinate differences `at`.
    fn value<T: Number>(&self, at: &[[T; 2]; N]) -> T;
}

/// The dot product of two vectors.
pub struct Dot;

impl Form<2> for Dot {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 1
    }
    fn value<T: Number>(&self, [a, b]: &[[T; 2]; 2]) -> T {
        dot(a, b)
    }
}

/// The sign of `form` at `points`, relative to `origin`. Always right.
pub fn sign<const N: usize, F: Form<N>>(form: &F, origin: Point, points: &[Point; N]) -> Ordering {
    let approximate = form.value(&points.map(|point| sub(point, origin).map(Approximate::rounded)));
    approximate.sign().unwrap_or_else(|| exact_sign(form, origin, points))
}

/// The sign of `form` in integers.
pub fn exact_sign<const N: usize, F: Form<N>>(
    form: &F,
    origin: Point,
    points: &[Point; N],
) -> Ordering {
    match integral_differences(origin, points) {
        Some((at, bits)) if form.bound(bits) < 63 => form.value(&at).cmp(&0),
        _ => wide_sign(form, origin, points),
    }
}

/// The sign of `form` in the smallest integers that its value fits in.
#[cold]
#[inline(never)]
fn wide_sign<const N: usize, F: Form<N>>(form: &F, origin: Point, points: &[Point; N]) -> Ordering {
    let Some((at, bits)) = small_differences(origin, points) else {
        return big_sign(form, origin, points);
    };
    match form.bound(bits) {
        0..63 => form.value(&at).cmp(&0),
        63..127 => form.value(&at.map(|vector| vector.map(i128::from))).cmp(&0),
        127..255 => form.value(&at.map(|vector| vector.map(I256::from))).cmp(&I256::ZERO),
        _ => big_sign(form, origin, points),
    }
}

/// The sign of `form` in integers of any size.
fn big_sign<const N: usize, F: Form<N>>(form: &F, origin: Point, points: &[Point; N]) -> Ordering {
    match common_unit(origin, points) {
        None => Ordering::Equal,
        Some(unit) => form.value(&big_differences(origin, points, unit)).cmp(&BigInt::ZERO),
    }
}

/// The quotient of two forms, `numerator` one degree above `denominator`, rounded once or twice.
pub fn quotient<const N: usize>(
    numerator: &impl Form<N>,
    denominator: &impl Form<N>,
    origin: Point,
    points: &[Point; N],
) -> f64 {
    let Some(unit) = common_unit(origin, points) else { return f64::NAN };
    let at = big_differences(origin, points, unit);
    let (n, d) = (numerator.value(&at), denominator.value(&at));
    let shift = d.bits() as i32 - n.bits() as i32 + 64;
    let (n, d) = if shift >= 0 { (n << shift, d) } else { (n, d << -shift) };
    let leading = (n / d).to_f64().unwrap_or(f64::NAN);
    // In two steps, because either power of two alone may be out of range.
    let exponent = unit - shift;
    leading * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

/// A floating-point number with a bound on its distance from the true value.
#[derive(Debug, Clone, Copy)]
pub struct Approximate {
    value: f64,
    error: f64,
}

/// Half the distance from 1 to the next double: the relative error of one rounding.
pub const ROUNDING: f64 = f64::EPSILON / 2.0;
/// Covers the roundings made in computing the bounds themselves.
const SLACK: f64 = 1.0 + 1e-9;

impl Approximate {
    /// A number that one rounding led to.
    #[must_use]
    pub fn rounded(value: f64) -> Self {
        Self { value, error: value.abs() * ROUNDING }
    }

    /// The sign, if the error bound leaves no doubt.
    #[must_use]
    pub fn sign(&self) -> Option<Ordering> {
        // An overflow makes the error infinite or not a number, and the sign unknown.
        (self.value.abs() > self.error * SLACK).then(|| self.value.total_cmp(&0.0))
    }

    fn after(value: f64, inherited: f64) -> Self {
        // The smallest normal number covers underflow.
        Self { value, error: inherited + value.abs() * ROUNDING + f64::MIN_POSITIVE }
    }
}

impl Number for Approximate {
    fn integer(value: i64) -> Self {
        Self::rounded(value as f64)
    }
    fn plus(&self, other: &Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }
    fn minus(&self, other: &Self) -> Self {
        Self::after(self.value - other.value, self.error + other.error)
    }
    fn times(&self, other: &Self) -> Self {
        let inherited = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Self::after(self.value * other.value, inherited)
    }
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

/// The finite double `x` as an odd integer (or 0) and the power of two that it is multiplied by.
#[must_use]
pub fn decompose(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)).cast_signed();
    let mantissa = if biased == 0 { fraction } else { fraction | (1 << 52) };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    let odd = mantissa >> zeros;
    (if x < 0.0 { -odd } else { odd }, biased.max(1) - 1075 + zeros.cast_signed())
}

/// The largest power of two that all coordinates are multiples of, as its exponent.
fn common_unit<const N: usize>(origin: Point, points: &[Point; N]) -> Option<i32> {
    let nonzero = |(mantissa, exponent): (i64, i32)| (mantissa != 0).then_some(exponent);
    points.iter().chain([&origin]).flatten().filter_map(|&x| nonzero(decompose(x))).min()
}

/// The differences as integers in some common unit, and the bits of the largest.
///
/// `None` if a difference is not a double, or the largest has more than 62 bits.
#[must_use]
pub fn small_differences<const N: usize>(
    origin: Point,
    points: &[Point; N],
) -> Option<([[i64; 2]; N], u32)> {
    integral_differences(origin, points).or_else(|| scaled_differences(origin, points))
}

/// The differences in units of 1, if all coordinates are whole numbers, as pixels are.
#[inline]
fn integral_differences<const N: usize>(
    origin: Point,
    points: &[Point; N],
) -> Option<([[i64; 2]; N], u32)> {
    let whole = |x: f64| {
        let integer = x as i64;
        (integer as f64 == x && integer.unsigned_abs() < 1 << 53).then_some(integer)
    };
    let (x, y) = (whole(origin[0])?, whole(origin[1])?);
    let mut at = [[0; 2]; N];
    let mut union = 0;
    for (difference, point) in at.iter_mut().zip(points) {
        *difference = [whole(point[0])? - x, whole(point[1])? - y];
        union |= difference[0].unsigned_abs() | difference[1].unsigned_abs();
    }
    Some((at, u64::BITS - union.leading_zeros()))
}

/// The differences in their largest common unit.
fn scaled_differences<const N: usize>(
    origin: Point,
    points: &[Point; N],
) -> Option<([[i64; 2]; N], u32)> {
    let differences = points.map(|point| sub(point, origin));
    let (mut low, mut high) = (u64::MAX, 0);
    for (difference, point) in differences.iter().zip(points) {
        for axis in [0, 1] {
            let (d, a, b) = (difference[axis], point[axis], origin[axis]);
            // The rounding error of a − b, after Knuth.
            let virtual_b = a - d;
            if (a - (d + virtual_b)) + (virtual_b - b) != 0.0 {
                return None;
            }
            if d != 0.0 {
                let (exponent, fraction) = ((d.to_bits() >> 52) & 0x7ff, d.to_bits() | 1 << 52);
                high = high.max(exponent);
                low = low.min(exponent + u64::from(fraction.trailing_zeros()));
            }
        }
    }
    // The exponents are biased, and count from the mantissa's lowest bit: 52 below its leading one.
    let bits = (high + 53).saturating_sub(low) as u32;
    if bits > 62 || high > 1900 || (low < 200 && bits > 0) {
        return None;
    }
    let unit = if bits == 0 { 1.0 } else { f64::from_bits((2 * 1023 + 52 - low) << 52) };
    Some((differences.map(|d| d.map(|x| (x * unit) as i64)), bits))
}

/// The differences in units of two to the power `unit`, of any size.
fn big_differences<const N: usize>(
    origin: Point,
    points: &[Point; N],
    unit: i32,
) -> [[BigInt; 2]; N] {
    let integer = |x: f64| {
        let (mantissa, exponent) = decompose(x);
        let shift = if mantissa == 0 { 0 } else { exponent - unit };
        BigInt::from(mantissa) << shift
    };
    points.map(|point| [0, 1].map(|axis| integer(point[axis]) - integer(origin[axis])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decompose_gives_back_every_double() {
        for x in [0.0, 1.0, -1.5, 0.1, 1e300, -5e-324, f64::MAX, f64::MIN_POSITIVE, 3.0e-310] {
            let (mantissa, exponent) = decompose(x);
            let half = exponent / 2;
            let back = mantissa as f64 * 2f64.powi(half) * 2f64.powi(exponent - half);
            assert_eq!(back.to_bits(), x.to_bits());
        }
    }

    struct Turn;
    impl Form<2> for Turn {
        fn bound(&self, bits: u32) -> u32 {
            2 * bits + 1
        }
        fn value<T: Number>(&self, [a, b]: &[[T; 2]; 2]) -> T {
            cross(a, b)
        }
    }

    #[test]
    fn a_sign_is_right_a_hair_from_zero_and_at_the_ends_of_the_range() {
        for scale in [1.0, 2f64.powi(-900), 2f64.powi(900)] {
            let at = |x: f64, y: f64| [x * scale, y * scale];
            let up = at(1.0, 1.0_f64.next_up());
            assert_eq!(sign(&Turn, at(0.0, 0.0), &[at(3.0, 3.0), at(1.0, 1.0)]), Ordering::Equal);
            assert_eq!(sign(&Turn, at(0.0, 0.0), &[at(3.0, 3.0), up]), Ordering::Greater);
            assert_eq!(sign(&Turn, at(0.0, 0.0), &[up, at(3.0, 3.0)]), Ordering::Less);
        }
    }
}
