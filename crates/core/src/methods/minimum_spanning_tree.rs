//! The Euclidean minimum spanning tree.
//!
//! J. B. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem",
//! Proceedings of the American Mathematical Society 7 (1956), on the Delaunay edges.

use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::exact::sign::{self, Form, Number, exact_sign};
use crate::point::{Point, lexicographic};
use crate::progress::{Progress, Stage};
use rayon::prelude::*;
use std::cmp::Ordering;

/// The shortest tree that joins all points.
///
/// Of equally long edges, that with the lexicographically smaller end comes first, then that with
/// the smaller other end, so there is one tree. An edge pq of it has no point r with |pr|, |qr| <
/// |pq|, so it is in every Delaunay triangulation. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn minimum_spanning_tree(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let count = delaunay.points().len();
    progress.enter(Stage::Select, count)?;
    let mut candidates: Vec<Candidate> =
        delaunay.edges().map(|edge| Candidate::new(delaunay, edge)).collect();
    candidates.par_sort_unstable_by(|a, b| a.compare(b, delaunay));
    progress.advance(count / 2)?;
    let mut forest = Forest::new(count);
    candidates.retain(|candidate| forest.join(candidate.p, candidate.q));
    progress.advance(0)?;
    let tree = candidates.iter().map(|edge| rows(delaunay, edge.p, edge.q)).collect();
    Ok(sort(&[tree], delaunay.input_len()))
}

/// An edge that may be in the tree.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// The lexicographically smaller end.
    p: u32,
    q: u32,
    square: f64,
    /// Is `square` the squared length without any rounding?
    is_exact: bool,
}

impl Candidate {
    fn new(delaunay: &Delaunay, edge: Edge) -> Self {
        let (mut p, mut q) = (edge.p, edge.q);
        if lexicographic(&delaunay.point(p), &delaunay.point(q)).is_gt() {
            (p, q) = (q, p);
        }
        let (square, is_exact) = squared_distance(delaunay.point(p), delaunay.point(q));
        Self { p, q, square, is_exact }
    }

    /// The order by length, then by the ends.
    fn compare(&self, other: &Self, delaunay: &Delaunay) -> Ordering {
        let ends = |edge: &Self| [delaunay.point(edge.p), delaunay.point(edge.q)];
        let (a, b) = (ends(self), ends(other));
        let by_ends = || lexicographic(&a[0], &b[0]).then_with(|| lexicographic(&a[1], &b[1]));
        self.compare_lengths(other, a, b).then_with(by_ends)
    }

    fn compare_lengths(&self, other: &Self, [p, q]: [Point; 2], [r, s]: [Point; 2]) -> Ordering {
        let difference = self.square - other.square;
        let bound = 8.0 * f64::EPSILON * (self.square + other.square) + f64::MIN_POSITIVE;
        if difference.abs() > bound || (self.is_exact && other.is_exact) {
            return difference.total_cmp(&0.0);
        }
        exact_sign(&Longer, p, &[q, r, s])
    }
}

/// The squared distance, and whether no rounding was needed; lattices have many equally long edges.
fn squared_distance(p: Point, q: Point) -> (f64, bool) {
    let [(x, x_exact), (y, y_exact)] = [0, 1].map(|axis| {
        let difference = q[axis] - p[axis];
        let is_exact = p[axis] + difference == q[axis] && q[axis] - difference == p[axis];
        (difference * difference, is_exact && is_short(difference))
    });
    let square = x + y;
    (square, x_exact && y_exact && square - x == y && square - y == x)
}

/// Is the square of `x` a double, far from underflow: does `x` have at most 26 significant bits?
fn is_short(x: f64) -> bool {
    x == 0.0 || (x.abs() > 1e-150 && x.to_bits().trailing_zeros() >= 27)
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

/// Trees as disjoint sets of vertices.
struct Forest {
    parents: Vec<u32>,
}

impl Forest {
    fn new(vertices: usize) -> Self {
        Self { parents: (0..vertices as u32).collect() }
    }

    /// Join the trees of `p` and `q`; were they different ones?
    fn join(&mut self, p: u32, q: u32) -> bool {
        let (p, q) = (self.root(p), self.root(q));
        self.parents[p as usize] = q;
        p != q
    }

    fn root(&mut self, mut vertex: u32) -> u32 {
        while self.parents[vertex as usize] != vertex {
            let parent = self.parents[vertex as usize];
            self.parents[vertex as usize] = self.parents[parent as usize];
            vertex = self.parents[vertex as usize];
        }
        vertex
    }
}
