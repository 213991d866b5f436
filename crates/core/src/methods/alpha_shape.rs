//! The α-shape.
//!
//! H. Edelsbrunner, D. G. Kirkpatrick, R. Seidel, "On the shape of a set of points in the plane",
//! IEEE Transactions on Information Theory 29 (1983).

use crate::cocircular::select_closed;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::Edges;
use crate::error::{Error, Result};
use crate::exact::angle_bound::OppositeDot;
use crate::exact::filter;
use crate::exact::sign::{self, Form, Number, exact_sign};
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;
use std::cmp::Ordering::{self, Greater, Less};

/// The edges with a disk of exactly this `radius` that touches both ends and holds no point inside.
///
/// `radius` is in the units of the input. O(n log n).
///
/// # Errors
/// A `radius` that is not positive and finite or too far from the coordinates in size, or a
/// cancelled `progress`.
pub fn alpha_shape(delaunay: &Delaunay, radius: f64, progress: &Progress) -> Result<Edges> {
    let scaled = radius * delaunay.scale();
    if !(radius > 0.0 && radius.is_finite()) {
        let message = format!("radius must be a positive finite number, not {radius}");
        return Err(Error::Argument { message });
    }
    if !scaled.is_finite() || scaled / delaunay.scale() != radius {
        let message = format!(
            "radius {radius:e} is too far from the coordinates in size to be scaled with them"
        );
        return Err(Error::Argument { message });
    }
    let radius = Radius(scaled);
    select_closed(delaunay, progress, |edge| radius.touches(delaunay, edge))
}

/// The radius, in the scale of the triangulation.
struct Radius(f64);

impl Radius {
    /// Does an empty disk of this radius touch both ends of `edge`?
    ///
    /// There are two disks of this radius through p and q. One holds more of the left side and less
    /// of the right, and an apex is outside of its larger part if it is outside of the circle
    /// through its triangle on that side.
    fn touches(&self, delaunay: &Delaunay, edge: Edge) -> bool {
        let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
        let outside = [edge.left, edge.right].map(|apex| {
            apex.map_or([true; 2], |vertex| self.is_outside(p, q, delaunay.point(vertex)))
        });
        let [[left_larger, left_smaller], [right_larger, right_smaller]] = outside;
        let is_empty = (left_larger && right_smaller) || (left_smaller && right_larger);
        is_empty && self.spans(p, q)
    }

    /// Is the distance of `p` and `q` at most twice the radius?
    fn spans(&self, p: Point, q: Point) -> bool {
        exact_sign(&Span, [0.0; 2], &[p, q, [self.0, 0.0]]) != Less
    }

    /// Is `r` outside of the larger, and of the smaller, part that p q cuts off a disk of this
    /// radius, on its own side?
    fn is_outside(&self, p: Point, q: Point, r: Point) -> [bool; 2] {
        let is_acute = sign::sign(&OppositeDot, p, &[q, r]) != Less;
        let circumradius = self.compare_circumradius(p, q, r);
        [is_acute && circumradius != Less, is_acute || circumradius != Greater]
    }

    /// The circumradius of `p`, `q`, `r`, compared with this radius.
    fn compare_circumradius(&self, p: Point, q: Point, r: Point) -> Ordering {
        let (a, b, c) = (sub(q, p), sub(r, p), sub(r, q));
        let sides = dot(a, a) * dot(b, b) * dot(c, c);
        let twice = 2.0 * self.0;
        let (height, size) =
            (twice * cross(a, b), twice * (a[0].abs() + a[1].abs()) * (b[0].abs() + b[1].abs()));
        let excess = sides - height * height;
        filter::sign(excess, 16, sides + size * size, 1.0)
            .unwrap_or_else(|| exact_sign(&Circumradius, [0.0; 2], &[p, q, r, [self.0, 0.0]]))
    }
}

/// The difference of the squares of 2ρ and of |p q|, ρ the last x.
struct Span;

impl Form<3> for Span {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 4
    }
    fn value<T: Number>(&self, [p, q, [radius, _]]: &[[T; 2]; 3]) -> T {
        let chord = sign::difference(q, p);
        T::integer(4).times(&radius.times(radius)).minus(&sign::dot(&chord, &chord))
    }
}

/// The difference of the squares of circumradius and ρ, the last x, times that of four times the
/// area.
struct Circumradius;

impl Form<4> for Circumradius {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 12
    }
    fn value<T: Number>(&self, [p, q, r, [radius, _]]: &[[T; 2]; 4]) -> T {
        let sides = [sign::difference(q, p), sign::difference(r, p), sign::difference(r, q)];
        let [a, b, c] = sides.each_ref().map(|side| sign::dot(side, side));
        let height = T::integer(2).times(radius).times(&sign::cross(&sides[0], &sides[1]));
        a.times(&b).times(&c).minus(&height.times(&height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        assert_bounded(&Span);
        assert_bounded(&Circumradius);
    }

    #[test]
    fn a_circumradius_is_compared_right_where_that_changes() {
        at_brinks(&Circumradius, true, |_, [p, q, r, [radius, _]], sign| {
            assert_eq!(Radius(radius.abs()).compare_circumradius(p, q, r), sign);
        });
    }
}
