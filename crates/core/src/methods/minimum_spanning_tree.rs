//! The Euclidean minimum spanning tree.
//!
//! J. B. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem",
//! Proceedings of the American Mathematical Society 7 (1956), on the Delaunay edges.

use super::length::Ranked;
use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::forest::Forest;
use crate::progress::{Progress, Stage};
use rayon::prelude::*;

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
    let mut candidates: Vec<Ranked> =
        delaunay.edges().map(|edge| Ranked::new(delaunay, edge.p, edge.q)).collect();
    candidates.par_sort_unstable_by(|a, b| a.compare(b, delaunay));
    progress.advance(count / 2)?;
    let mut forest = Forest::new(count);
    candidates.retain(|candidate| forest.join(candidate.p, candidate.q));
    progress.advance(0)?;
    let tree = candidates.iter().map(|edge| rows(delaunay, edge.p, edge.q)).collect();
    Ok(sort(&[tree], delaunay.input_len()))
}
