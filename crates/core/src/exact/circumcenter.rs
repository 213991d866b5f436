//! Voronoi vertices: the circumcenters of the triangles, estimated with an error bound and exact where asked.

use crate::exact::double_double::DoubleDouble;
use crate::exact::filter::ROUNDING;
use crate::exact::sign::{self, Form, Number};
use crate::point::{Point, cross, dot, length, sub};

/// A circumcenter relative to some origin, and a bound on the distance to the true one.
#[derive(Debug, Clone, Copy)]
pub struct Center {
    /// The estimate.
    pub at: Point,
    /// The bound; infinite if the triangle is too flat to tell.
    pub error: f64,
}

impl Center {
    /// The circumcenter of the triangle `a`, `b`, `c` relative to `origin`.
    ///
    /// All differences are taken before products, so a common offset of the points costs no accuracy.
    #[inline]
    #[must_use]
    pub fn estimate(triangle: [Point; 3], origin: Point) -> Self {
        Self::from_first(triangle, origin, 1e-7)
            .unwrap_or_else(|| Self::from_shortest(triangle, origin))
    }

    /// The same from an end of the shortest side, whose own differences are hardly rounded. Where two corners are an ulp apart, seen from
    /// the third they are one.
    #[cold]
    fn from_shortest([a, b, c]: [Point; 3], origin: Point) -> Self {
        let side = |p, q| length(sub(p, q));
        let is_opposite = side(b, c) < side(a, b).min(side(a, c));
        let triangle = if is_opposite { [b, c, a] } else { [a, b, c] };
        let unknown = Self { at: [0.0; 2], error: f64::INFINITY };
        Self::from_first(triangle, origin, 0.25).unwrap_or(unknown)
    }

    /// The same by the two sides at `a`, unless the sine of the angle between them is uncertain by more than the part `most`.
    #[inline]
    fn from_first([a, b, c]: [Point; 3], origin: Point, most: f64) -> Option<Self> {
        let (u, v) = (sub(b, a), sub(c, a));
        let (uu, vv) = (dot(u, u), dot(v, v));
        let twice = 2.0 * cross(u, v);
        let numerators = [uu * v[1] - vv * u[1], vv * u[0] - uu * v[0]];
        let sizes = uu * (v[0].abs() + v[1].abs()) + vv * (u[0].abs() + u[1].abs());
        let inverse = 1.0 / twice;
        let flatness =
            32.0 * ROUNDING * ((u[0] * v[1]).abs() + (u[1] * v[0]).abs()) * inverse.abs();
        if flatness.is_nan() || flatness >= most || twice.abs() <= 1e-200 {
            return None;
        }
        let offset = numerators.map(|x| x * inverse);
        let from_origin = sub(a, origin);
        let at = [from_origin[0] + offset[0], from_origin[1] + offset[1]];
        let size = |x: Point| x[0].abs() + x[1].abs();
        let error = 16.0 * ROUNDING * sizes * inverse.abs()
            + (2.0 * flatness + 8.0 * ROUNDING) * size(offset)
            + 8.0 * ROUNDING * size(from_origin);
        Some(Self { at, error })
    }
}

/// The circumcenter of the counter-clockwise triangle `a`, `b`, `c` relative to `a`, to about eleven digits.
///
/// Triangles too flat for floating point are solved more precisely; the result can be infinite.
#[must_use]
pub fn circumcenter([a, b, c]: [Point; 3]) -> Point {
    let Center { at, error } = Center::estimate([a, b, c], a);
    if error <= 1e-11 * (at[0].abs() + at[1].abs()) {
        return at;
    }
    let ([u, v], unit) = DoubleDouble::differences(a, &[b, c]);
    let center = HomogeneousCenter::new(&[DoubleDouble::integer(0); 2], &u, &v);
    [0, 1].map(|axis| {
        let quick = center.at[axis].over(&center.w, sign::ACCURACY).map(|x| x * unit);
        quick.unwrap_or_else(|| sign::quotient(&Numerator { axis }, &Denominator, a, &[b, c]))
    })
}

/// A coordinate of the circumcenter of the origin and two points, times twice the cross product.
struct Numerator {
    axis: usize,
}

impl Form<2> for Numerator {
    fn bound(&self, bits: u32) -> u32 {
        3 * bits + 3
    }
    fn value<T: Number>(&self, [b, c]: &[[T; 2]; 2]) -> T {
        let zero = [T::integer(0), T::integer(0)];
        let [x, y] = HomogeneousCenter::new(&zero, b, c).at;
        if self.axis == 0 { x } else { y }
    }
}

struct Denominator;

impl Form<2> for Denominator {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 2
    }
    fn value<T: Number>(&self, [b, c]: &[[T; 2]; 2]) -> T {
        T::integer(2).times(&sign::cross(b, c))
    }
}

/// A circumcenter in homogeneous coordinates (x, y, w): the center is (x / w, y / w), w > 0.
///
/// x and y have degree 3 in the coordinates, w has degree 2.
pub struct HomogeneousCenter<T> {
    /// Numerators of x and y.
    pub at: [T; 2],
    /// The common denominator, positive for a counter-clockwise triangle.
    pub w: T,
}

impl<T: Number> HomogeneousCenter<T> {
    /// The circumcenter of the counter-clockwise triangle `a`, `b`, `c`.
    pub fn new(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> Self {
        let (u, v) = (sign::difference(b, a), sign::difference(c, a));
        let (uu, vv) = (sign::dot(&u, &u), sign::dot(&v, &v));
        let w = T::integer(2).times(&sign::cross(&u, &v));
        let x = uu.times(&v[1]).minus(&vv.times(&u[1]));
        let y = vv.times(&u[0]).minus(&uu.times(&v[0]));
        Self { at: [a[0].times(&w).plus(&x), a[1].times(&w).plus(&y)], w }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::predicates::orientation;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        for axis in [0, 1] {
            assert_bounded(&Numerator { axis });
        }
        assert_bounded(&Denominator);
    }

    /// Near where a coordinate of the center changes its sign, or the triangle its turn.
    #[test]
    fn a_center_is_as_near_as_its_error_says() {
        let mut check = |a, [b, c]: [Point; 2], _| {
            if orientation(a, b, c).is_eq() {
                return;
            }
            let exact =
                [0, 1].map(|axis| sign::quotient(&Numerator { axis }, &Denominator, a, &[b, c]));
            for origin in [a, b, [1e3, -0.1]] {
                let center = Center::estimate([a, b, c], origin);
                let shift = sub(a, origin);
                let at = [exact[0] + shift[0], exact[1] + shift[1]];
                let slack = sign::ACCURACY * (length(exact) + length(shift));
                let off = length(sub(center.at, at));
                assert!(off.is_nan() || off <= center.error + slack, "{off} > {}", center.error);
            }
        };
        at_brinks(&Numerator { axis: 0 }, false, &mut check);
        at_brinks(&Denominator, false, check);
    }
}
