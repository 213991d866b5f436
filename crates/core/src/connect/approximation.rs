//! Angles and logarithms to eight digits, by additions, products, a quotient and a table of coefficients: costs need no more,
//! and IEEE 754 makes every target round these alike.

use crate::point::{Point, cross, dot};
use std::f64::consts::{FRAC_1_PI, LN_2, SQRT_2};

/// The coefficients of (arctan x) / x in x², within 2·10⁻⁸ for |x| ≤ 1 (M. Abramowitz and I. Stegun, "Handbook of Mathematical
/// Functions", 4.4.49).
const ARCTAN: [f64; 9] = [
    1.0,
    -0.333_331_452_8,
    0.199_935_508_5,
    -0.142_088_994_4,
    0.106_562_639_3,
    -0.075_289_640_0,
    0.042_909_613_8,
    -0.016_165_736_7,
    0.002_866_225_7,
];
/// The coefficients of (artanh x) / x in x²: within 10⁻⁹ for |x| ≤ 0.18.
const ARTANH: [f64; 5] = [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0];

/// The angle between two vectors, in half turns; the same after turns by 90° and reflections, to the last bit.
#[inline]
#[must_use]
pub fn half_turns(u: Point, v: Point) -> f64 {
    let (sine, cosine) = (cross(u, v).abs(), dot(u, v));
    let acute = acute([cosine, sine]);
    let from_axis = if sine <= cosine.abs() { acute } else { 0.5 - acute };
    if cosine < 0.0 { 1.0 - from_axis } else { from_axis }
}

/// Half a turn, in the unit of directions.
pub const HALF_TURN: u32 = 1 << 31;

/// The direction of a vector, in 2⁻³² turns. It turns by 90° and is reflected with the vector, to the last bit; parallel vectors
/// whose coordinates are exact have the same.
#[inline]
#[must_use]
pub fn direction(v: Point) -> u32 {
    let acute = (acute(v) * f64::from(HALF_TURN)) as u32;
    let from_axis = if v[1].abs() <= v[0].abs() { acute } else { HALF_TURN / 2 - acute };
    let upper = if v[0] < 0.0 { HALF_TURN - from_axis } else { from_axis };
    if v[1] < 0.0 { upper.wrapping_neg() } else { upper }
}

/// The angle of a vector to the nearest axis, in half turns.
#[inline]
fn acute(v: Point) -> f64 {
    let [x, y] = v.map(f64::abs);
    let (least, most) = (x.min(y), x.max(y));
    if most == 0.0 {
        return 0.0;
    }
    let ratio = least / most;
    FRAC_1_PI * ratio * series(&ARCTAN, ratio * ratio)
}

/// The natural logarithm of a positive number.
#[inline]
#[must_use]
pub fn log(x: f64) -> f64 {
    if !x.is_normal() {
        return libm::log(x);
    }
    let bits = x.to_bits();
    let mantissa = f64::from_bits(bits & ((1 << 52) - 1) | (1023 << 52));
    let exponent = (bits >> 52) as f64 - 1023.0;
    // Around 1, so that the quotient is small, and 0 at 1.
    let (mantissa, exponent) =
        if mantissa > SQRT_2 { (mantissa / 2.0, exponent + 1.0) } else { (mantissa, exponent) };
    let ratio = (mantissa - 1.0) / (mantissa + 1.0);
    exponent * LN_2 + 2.0 * ratio * series(&ARTANH, ratio * ratio)
}

/// A polynomial, by Horner's rule.
#[inline]
fn series<const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, &own| sum * x + own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_close() {
        for k in 0..=1000 {
            let angle = std::f64::consts::PI * f64::from(k) / 1000.0;
            let found = half_turns([3.0, 0.0], [libm::cos(angle), libm::sin(angle)]);
            assert!((found - f64::from(k) / 1000.0).abs() < 2e-8, "{k}");
        }
    }

    #[test]
    fn directions_are_close_and_symmetric() {
        for k in 0..360 {
            let angle = std::f64::consts::PI * f64::from(k) / 180.0;
            let [x, y] = [libm::cos(angle), libm::sin(angle)];
            let found = direction([x, y]);
            let turns = f64::from(found) / 2.0 / f64::from(HALF_TURN);
            assert!((turns - f64::from(k) / 360.0).abs() < 1e-8, "{k}");
            assert_eq!(direction([-y, x]), found.wrapping_add(HALF_TURN / 2), "{k}");
            assert_eq!(direction([x, -y]), found.wrapping_neg(), "{k}");
            assert_eq!(direction([-x, -y]), found ^ HALF_TURN, "{k}");
            assert_eq!(
                direction([3.0 * x.round(), 3.0 * y.round()]),
                direction([x.round(), y.round()])
            );
        }
        assert_eq!(direction([3.0, 1.0]), direction([21.0, 7.0]));
    }

    #[test]
    fn logarithms_are_close() {
        for k in -2000..2000 {
            let x = libm::exp(f64::from(k) / 300.0);
            assert!((log(x) - f64::from(k) / 300.0).abs() < 1e-8, "{k}");
        }
        assert_eq!(log(1.0), 0.0);
        assert_eq!(log(f64::INFINITY), f64::INFINITY);
    }
}
