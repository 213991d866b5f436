//! Exact signs of polynomials, written once and evaluated in up to six number systems.
//!
//! A geometric question is the sign of a [`Form`]: a polynomial in the differences of coordinates. [`sign()`] evaluates it first
//! in floating point with a running error bound, then, where the bound cannot tell, in integers, if its value is known to fit
//! in 64, 128 or 256 bits, where it costs little more than in floating point. Else twice the precision of doubles settles all
//! but ties; these cost integers of any size.

use crate::exact::double_double::DoubleDouble;
use crate::exact::filter::Approximate;
use crate::exact::integer::{
    MOST_BITS, big_differences, common_unit, integral_differences, small_differences,
};
pub use crate::exact::number::{Number, cross, difference, dot};
use crate::point::{Point, sub};
use ethnum::I256;
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::cmp::Ordering;

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

/// The sign of `form`, where floating point is known not to tell.
pub fn exact_sign<const N: usize, F: Form<N>>(
    form: &F,
    origin: Point,
    points: &[Point; N],
) -> Ordering {
    exact_sign_by(form, origin, points, || {
        form.value(&DoubleDouble::differences(origin, points).0).sign()
    })
}

/// The same, where `precise` knows a quicker way to settle all but some ties.
pub fn exact_sign_by<const N: usize, F: Form<N>>(
    form: &F,
    origin: Point,
    points: &[Point; N],
    precise: impl FnOnce() -> Option<Ordering>,
) -> Ordering {
    #[cfg(test)]
    crate::progress::work_tests::count(crate::progress::work_tests::BIT * form.bound(53) as usize);
    match integral_differences(origin, points) {
        Some((at, bits)) if form.bound(bits) < 63 => form.value(&at).cmp(&0),
        _ => wide_sign(form, origin, points, precise),
    }
}

/// The sign of `form` in the smallest integers that its value fits in, or in doubles of twice the precision.
#[cold]
#[inline(never)]
fn wide_sign<const N: usize, F: Form<N>>(
    form: &F,
    origin: Point,
    points: &[Point; N],
    precise: impl FnOnce() -> Option<Ordering>,
) -> Ordering {
    // Where most values would not fit, integers are kept for ties.
    if form.bound(MOST_BITS) < LIMIT {
        fixed_sign(form, origin, points).or_else(precise)
    } else {
        precise().or_else(|| fixed_sign(form, origin, points))
    }
    .unwrap_or_else(|| big_sign(form, origin, points))
}

/// The bits of integers of a fixed size, but for one of sign.
const LIMIT: u32 = 255;

/// The sign of `form` in the smallest integers of a fixed size that its value fits in, if it does.
fn fixed_sign<const N: usize, F: Form<N>>(
    form: &F,
    origin: Point,
    points: &[Point; N],
) -> Option<Ordering> {
    let (at, bits) = small_differences(origin, points)?;
    match form.bound(bits) {
        0..63 => Some(form.value(&at).cmp(&0)),
        63..127 => Some(form.value(&at.map(|vector| vector.map(i128::from))).cmp(&0)),
        127..LIMIT => Some(form.value(&at.map(|v| v.map(I256::from))).cmp(&I256::ZERO)),
        _ => None,
    }
}

/// The sign of `form` in integers of any size.
pub(super) fn big_sign<const N: usize, F: Form<N>>(
    form: &F,
    origin: Point,
    points: &[Point; N],
) -> Ordering {
    #[cfg(test)]
    crate::progress::work_tests::count(
        crate::progress::work_tests::BIG_BIT * form.bound(53) as usize,
    );
    match common_unit(origin, points) {
        None => Ordering::Equal,
        Some(unit) => form.value(&big_differences(origin, points, unit)).cmp(&BigInt::ZERO),
    }
}

/// What a [`quotient`] is off by at most, as a part of it.
pub const ACCURACY: f64 = 1e-15;

/// The quotient of two forms, `numerator` one degree above `denominator`, to fifteen digits.
pub fn quotient<const N: usize>(
    numerator: &impl Form<N>,
    denominator: &impl Form<N>,
    origin: Point,
    points: &[Point; N],
) -> f64 {
    #[cfg(test)]
    crate::progress::work_tests::count(
        crate::progress::work_tests::BIT * numerator.bound(53) as usize,
    );
    let (at, unit) = DoubleDouble::differences(origin, points);
    let (n, d) = (numerator.value(&at), denominator.value(&at));
    n.over(&d, ACCURACY)
        .map_or_else(|| big_quotient(numerator, denominator, origin, points), |x| x * unit)
}

/// The quotient in integers of any size, rounded once or twice.
#[cold]
fn big_quotient<const N: usize>(
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::xorshift::Xorshift;

    /// Does the bound of `form` hold, for coordinates of many sizes and for the largest there are? Its integers overflow if it does not.
    pub(crate) fn assert_bounded<const N: usize>(form: &impl Form<N>) {
        let mut state = Xorshift(7);
        let mut random = |limit: u64| (state.next() >> 20) % limit;
        for k in 0..4000 {
            let bits = 1 + k % 30;
            let most = (1i64 << bits) - 1;
            let mut coordinate = || match random(4) {
                0 => most,
                1 => -most,
                2 => 0,
                _ => random(2 * most as u64 + 1) as i64 - most,
            };
            let at: [[BigInt; 2]; N] =
                std::array::from_fn(|_| [0, 1].map(|_| BigInt::from(coordinate())));
            assert!(form.value(&at).bits() <= u64::from(form.bound(bits)));
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
    fn every_rung_gives_the_sign_of_integers_where_it_changes() {
        at_brinks(&Turn, false, |origin, points, expected| {
            assert_eq!(sign(&Turn, origin, &points), expected);
            assert_eq!(exact_sign(&Turn, origin, &points), expected);
        });
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
