//! The Euclidean minimum spanning tree.
//!
//! J. B. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem",
//! Proceedings of the American Mathematical Society 7 (1956), on the Delaunay edges.

use super::length::ranked;
use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::forest::Forest;
use crate::parts::sort_by;
use crate::progress::{PACE, Progress, Stage};

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
    // Of a planar graph with three edges a point.
    progress.enter(Stage::Select, 4 * count)?;
    let mut candidates = ranked(delaunay, progress, |_| true)?;
    sort_by(&mut candidates, progress, |a, b| a.compare(b, delaunay))?;
    let mut forest = Forest::new(count);
    let mut tree = Edges::with_capacity(count);
    for part in candidates.chunks(PACE) {
        let joining = part.iter().filter(|edge| forest.join(edge.p, edge.q));
        tree.extend(joining.map(|edge| rows(delaunay, edge.p, edge.q)));
        progress.advance(part.len())?;
    }
    Ok(sort(&[tree], delaunay.input_len()))
}
