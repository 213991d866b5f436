//! Lengths of edges, compared exactly.

use crate::delaunay::{Delaunay, Edge};
use crate::error::Result;
use crate::exact::double_double::squared_length;
use crate::exact::filter;
use crate::exact::sign::{self, Form, Number, exact_sign};
use crate::parts::{GRAIN, in_parts, short};
use crate::point::{Point, dot, lexicographic, sub};
use crate::progress::Progress;
use std::cmp::Ordering;

/// The distance from `p` to `a`, compared with that to `b`.
#[inline]
pub(super) fn compare_distances(p: Point, a: Point, b: Point) -> Ordering {
    let (u, v) = (sub(a, p), sub(b, p));
    let (u, v) = (dot(u, u), dot(v, v));
    filter::sign(u - v, 5, u + v, 1.0).unwrap_or_else(|| sign::sign(&Nearer, p, &[a, b]))
}

/// The difference of the squared distances from the origin: negative if the first is nearer.
struct Nearer;

impl Form<2> for Nearer {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 2
    }
    fn value<T: Number>(&self, [a, b]: &[[T; 2]; 2]) -> T {
        sign::dot(a, a).minus(&sign::dot(b, b))
    }
}

/// An edge with its place in the one order of all edges: by length, then by its ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ranked {
    /// The lexicographically smaller end.
    pub p: u32,
    /// The other end.
    pub q: u32,
    square: f64,
    /// What the true squared length has more; not a number if that is unknown.
    rest: f64,
}

impl Ranked {
    /// The edge between two vertices.
    pub fn new(delaunay: &Delaunay, mut p: u32, mut q: u32) -> Self {
        if lexicographic(&delaunay.point(p), &delaunay.point(q)).is_gt() {
            (p, q) = (q, p);
        }
        let (square, rest) = squared_distance(delaunay.point(p), delaunay.point(q));
        Self { p, q, square, rest }
    }

    /// The order by length, then by the smaller end, then by the other.
    pub fn compare(&self, other: &Self, delaunay: &Delaunay) -> Ordering {
        #[cfg(test)]
        crate::progress::work_tests::count(crate::progress::work_tests::COMPARISON);
        let ends = |edge: &Self| [delaunay.point(edge.p), delaunay.point(edge.q)];
        let (a, b) = (ends(self), ends(other));
        let by_ends = || lexicographic(&a[0], &b[0]).then_with(|| lexicographic(&a[1], &b[1]));
        self.compare_lengths(other, a, b).then_with(by_ends)
    }

    fn compare_lengths(&self, other: &Self, [p, q]: [Point; 2], [r, s]: [Point; 2]) -> Ordering {
        if !self.rest.is_nan() && !other.rest.is_nan() {
            // Rounded to the nearest double, equal lengths are equal.
            return self.square.total_cmp(&other.square).then(self.rest.total_cmp(&other.rest));
        }
        let difference = self.square - other.square;
        filter::sign(difference, 5, self.square + other.square, 1.0)
            .unwrap_or_else(|| compare_exactly([p, q], [r, s]))
    }
}

/// The lengths of two edges, where floating point is known not to tell.
///
/// Where both vectors are doubles, their squares fit in integers of 128 bits, wherever the edges are.
#[cold]
fn compare_exactly([p, q]: [Point; 2], [r, s]: [Point; 2]) -> Ordering {
    let is_exact =
        |p: Point, q: Point| [0, 1].iter().all(|&axis| exact_difference(p[axis], q[axis]).1);
    if is_exact(p, q) && is_exact(r, s) {
        exact_sign(&Nearer, [0.0; 2], &[sub(q, p), sub(s, r)])
    } else {
        exact_sign(&Longer, p, &[q, r, s])
    }
}

/// b − a, and whether no rounding was needed.
fn exact_difference(a: f64, b: f64) -> (f64, bool) {
    let difference = b - a;
    (difference, a + difference == b && b - difference == a)
}

/// The edges of the triangulation that `keep` keeps, ranked, in no order.
///
/// # Errors
/// A cancelled `progress`.
pub(super) fn ranked(
    delaunay: &Delaunay,
    progress: &Progress,
    keep: impl Fn(Edge) -> bool + Sync,
) -> Result<Vec<Ranked>> {
    let parts = in_parts(delaunay.points().len(), GRAIN, progress, |vertices| {
        let vertices = short(vertices, progress).flatten();
        let edges = vertices.flat_map(|p| delaunay.edges_from(p as u32));
        let kept = edges.filter(|&edge| keep(edge));
        kept.map(|edge| Ranked::new(delaunay, edge.p, edge.q)).collect::<Vec<_>>()
    })?;
    Ok(parts.concat())
}

/// The squared distance, and what rounding took from it, if two doubles hold both: lattices have many edges that are as long but for that.
fn squared_distance(p: Point, q: Point) -> (f64, f64) {
    let [(x, x_exact), (y, y_exact)] = [0, 1].map(|axis| exact_difference(p[axis], q[axis]));
    let known = if x_exact && y_exact { squared_length([x, y]) } else { None };
    known.unwrap_or_else(|| (dot([x, y], [x, y]), f64::NAN))
}

/// The squared length of the edge from the origin to the first point, less that between the others.
struct Longer;

impl Form<3> for Longer {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 4
    }
    fn value<T: Number>(&self, [q, r, s]: &[[T; 2]; 3]) -> T {
        let other = sign::difference(s, r);
        sign::dot(q, q).minus(&sign::dot(&other, &other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::sign::tests::assert_bounded;
    use crate::progress::Progress;

    #[test]
    fn values_are_within_their_bounds() {
        assert_bounded(&Nearer);
        assert_bounded(&Longer);
    }

    #[test]
    fn distances_are_compared_right_where_that_changes() {
        at_brinks(&Nearer, false, |p, [a, b], sign| assert_eq!(compare_distances(p, a, b), sign));
    }

    /// Of some lengths the square is known whole, of others, with coordinates next to none, it is not.
    #[test]
    fn lengths_are_compared_as_exactly_as_by_integers() {
        let mut points = vec![[-1.0, 0.0], [0.0, 0.0]];
        for k in 0..12u32 {
            let (turn, tiny) = (f64::from(k % 3), f64::from(k / 3) * 1e-150);
            points.push([1.0 + turn * f64::EPSILON, tiny]);
            points.push([tiny, 1.0 + turn * f64::EPSILON]);
        }
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        let count = delaunay.points().len() as u32;
        let pairs = (0..count).flat_map(|p| (0..p).map(move |q| (p, q)));
        let edges: Vec<Ranked> = pairs.map(|(p, q)| Ranked::new(&delaunay, p, q)).collect();
        assert!(edges.iter().any(|e| e.rest.is_nan()) && edges.iter().any(|e| !e.rest.is_nan()));
        let ends = |edge: &Ranked| [delaunay.point(edge.p), delaunay.point(edge.q)];
        for a in &edges {
            for b in &edges {
                let exact = compare_exactly(ends(a), ends(b));
                assert_eq!(a.compare_lengths(b, ends(a), ends(b)), exact);
            }
        }
    }
}
