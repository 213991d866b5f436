//! Coordinate differences as integers in a common unit: every double is an integer times a power of two.

use crate::point::{Point, sub};
use num_bigint::BigInt;

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
pub fn common_unit<const N: usize>(origin: Point, points: &[Point; N]) -> Option<i32> {
    let nonzero = |(mantissa, exponent): (i64, i32)| (mantissa != 0).then_some(exponent);
    points.iter().chain([&origin]).flatten().filter_map(|&x| nonzero(decompose(x))).min()
}

/// The most bits that [`small_differences`] have.
pub const MOST_BITS: u32 = 62;

/// The differences as integers in some common unit, and the bits of the largest.
///
/// `None` if a difference is not a double, or the largest has more than [`MOST_BITS`] bits.
#[must_use]
pub fn small_differences<const N: usize>(
    origin: Point,
    points: &[Point; N],
) -> Option<([[i64; 2]; N], u32)> {
    integral_differences(origin, points).or_else(|| scaled_differences(origin, points))
}

/// The differences in units of 1, if all coordinates are whole numbers, as pixels are.
#[inline]
pub fn integral_differences<const N: usize>(
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
    if bits > MOST_BITS || high > 1900 || (low < 200 && bits > 0) {
        return None;
    }
    let unit = if bits == 0 { 1.0 } else { f64::from_bits((2 * 1023 + 52 - low) << 52) };
    Some((differences.map(|d| d.map(|x| (x * unit) as i64)), bits))
}

/// The differences in units of two to the power `unit`, of any size.
pub fn big_differences<const N: usize>(
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
}
