//! The Euclidean minimum spanning tree.
//!
//! J. B. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem",
//! Proceedings of the American Mathematical Society 7 (1956), on the Delaunay edges.

use super::length::Ranked;
use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
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
