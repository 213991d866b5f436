//! The one-step crust.
//!
//! C. Gold and J. Snoeyink, "A One-Step Crust and Skeleton Extraction Algorithm", Algorithmica 30 (2001).

use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, select};
use crate::error::Result;
use crate::exact::angle::{Angle, mixed_sign};
use crate::exact::sign::{self, Form, Number};
use crate::point::Point;
use crate::progress::Progress;
use std::cmp::Ordering::{self, Greater, Less};

/// The edges with a disk that touches both ends and holds no point, nor a center of the edge's own triangles.
///
/// These are the edges whose opposite angles sum to at most 90°: a superset of the crust.
///
/// # Errors
/// A cancelled `progress`.
pub fn one_step_crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    select(delaunay, progress, || (), |(), edge| is_in(delaunay, edge))
}

/// Is `edge` in the one-step crust?
// A call costs a tenth of the test.
#[allow(clippy::inline_always)]
#[inline(always)]
pub(crate) fn is_in(delaunay: &Delaunay, edge: Edge) -> bool {
    let (p, q) = (delaunay.point(edge.p), delaunay.point(edge.q));
    match (edge.left, edge.right) {
        (Some(left), Some(right)) => {
            sum_is_at_most_90(p, q, delaunay.point(left), delaunay.point(right))
        }
        (Some(apex), None) | (None, Some(apex)) => {
            // On the hull the other disks reach to infinity, but all hold the midpoint: 90° is too much.
            let apex = delaunay.point(apex);
            let exact = || sign::exact_sign(&sign::Dot, apex, &[p, q]);
            Angle::at(apex, p, q).acuteness().unwrap_or_else(exact) == Greater
        }
        (None, None) => true,
    }
}

/// Do the angles at `left` and `right`, opposite to p q, sum to at most 90°?
///
/// In a Delaunay triangulation they sum to at most 180°, so this is cot · cot ≥ 1.
#[inline]
fn sum_is_at_most_90(p: Point, q: Point, left: Point, right: Point) -> bool {
    let (a, b) = (Angle::at(left, p, q), Angle::at(right, q, p));
    let difference = a.dot * b.dot - a.cross * b.cross;
    mixed_sign(difference, &a, &b).unwrap_or_else(|| exact_product(p, q, left, right)) != Less
}

// Apart, for the registers of the loop around it.
#[cold]
#[inline(never)]
fn exact_product(p: Point, q: Point, left: Point, right: Point) -> Ordering {
    sign::exact_sign(&CotangentProduct, p, &[q, left, right])
}

/// cot · cot − 1 of the angles at two points opposite to the edge from the origin to `q`, times two cross products.
struct CotangentProduct;

impl Form<3> for CotangentProduct {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 8
    }
    fn value<T: Number>(&self, [q, left, right]: &[[T; 2]; 3]) -> T {
        let dot = |apex| sign::dot(apex, &sign::difference(apex, q));
        let dots = dot(left).times(&dot(right));
        // The right apex turns the other way, so its cross product counts negatively.
        dots.plus(&sign::cross(q, left).times(&sign::cross(q, right)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        assert_bounded(&CotangentProduct);
    }
}
