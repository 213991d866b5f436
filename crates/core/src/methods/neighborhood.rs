//! The closed Delaunay graph, seen from its points.

use super::length::compare_distances;
use crate::cocircular::diagonals;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::parts::{GRAIN, in_parts, map, sort_by};
use crate::progress::{Progress, Stage};
use std::cmp::Ordering::Equal;

/// The closed Delaunay graph, seen from its points.
pub(super) struct Neighborhood<'a> {
    /// The triangulation.
    pub delaunay: &'a Delaunay,
    /// Ends of the diagonals between cocircular points, both ways, sorted.
    tied: Vec<(u32, u32)>,
}

impl<'a> Neighborhood<'a> {
    /// The neighbors of all points.
    ///
    /// # Errors
    /// Too little memory for ties, or a cancelled `progress`.
    pub fn new(delaunay: &'a Delaunay, progress: &Progress) -> Result<Self> {
        let both = |edge: Edge| [(edge.p, edge.q), (edge.q, edge.p)];
        let diagonals = diagonals(delaunay, progress)?;
        let mut tied: Vec<_> = diagonals.into_iter().flat_map(both).collect();
        sort_by(&mut tied, progress, Ord::cmp)?;
        Ok(Self { delaunay, tied })
    }

    /// The neighbors of `p`; those that tie in the triangulation may come twice.
    pub fn of(&self, p: u32) -> impl Iterator<Item = u32> {
        let start = self.tied.partition_point(|&(from, _)| from < p);
        let tied = self.tied[start..].iter().take_while(move |&&(from, _)| from == p);
        let star = self.delaunay.star(p).neighbors.iter().copied();
        star.chain(tied.map(|&(_, to)| to))
    }

    /// All those at the least distance from `p`.
    pub fn nearest(&self, p: u32, among: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut nearest: Vec<u32> = Vec::new();
        let at = |vertex| self.delaunay.point(vertex);
        for s in among {
            let order =
                nearest.first().map_or(Equal, |&best| compare_distances(at(p), at(s), at(best)));
            if order.is_lt() {
                nearest.clear();
            }
            if order.is_le() && !nearest.contains(&s) {
                nearest.push(s);
            }
        }
        nearest
    }

    /// The neighbors that `p` asks for: the nearest and, for each of them, the nearest that `second` admits.
    ///
    /// `second` gets p, one that is nearest, and a neighbor. Equally near ones are all in.
    pub fn asked_for(&self, p: u32, second: impl Fn(u32, u32, u32) -> bool) -> Vec<u32> {
        let nearest = self.nearest(p, self.delaunay.star(p).neighbors.iter().copied());
        let mut asked_for = nearest.clone();
        for q in nearest {
            asked_for.extend(self.nearest(p, self.of(p).filter(|&s| second(p, q, s))));
        }
        asked_for
    }
}

/// The edges from each vertex to those that `ends` gives, as rows.
///
/// # Errors
/// A cancelled `progress`.
pub(super) fn collect<I: IntoIterator<Item = u32>>(
    delaunay: &Delaunay,
    progress: &Progress,
    ends: impl Fn(u32) -> I + Sync,
) -> Result<Edges> {
    let count = delaunay.points().len();
    progress.enter(Stage::Select, count)?;
    edges_to(delaunay, progress, ends)
}

/// The same within a stage.
fn edges_to<I: IntoIterator<Item = u32>>(
    delaunay: &Delaunay,
    progress: &Progress,
    ends: impl Fn(u32) -> I + Sync,
) -> Result<Edges> {
    let parts = in_parts(delaunay.points().len(), GRAIN, progress, |vertices| {
        let from = |p| ends(p).into_iter().map(move |q| rows(delaunay, p, q));
        vertices.flat_map(|p| from(p as u32)).collect()
    })?;
    let mut edges = sort(&parts, delaunay.input_len());
    progress.advance(0)?;
    edges.dedup();
    progress.advance(0)?;
    Ok(edges)
}

/// The edges whose two ends ask for each other, as rows.
///
/// # Errors
/// A cancelled `progress`.
pub(super) fn mutual(
    delaunay: &Delaunay,
    progress: &Progress,
    asked_for: impl Fn(u32) -> Vec<u32> + Sync + Send,
) -> Result<Edges> {
    let count = delaunay.points().len();
    progress.enter(Stage::Select, 2 * count)?;
    let asked = map(count, Vec::new(), progress, |p| asked_for(p as u32))?;
    edges_to(delaunay, progress, |p| {
        let asked = &asked;
        let is_mutual = move |&q: &u32| q > p && asked[q as usize].contains(&p);
        asked[p as usize].iter().copied().filter(is_mutual)
    })
}
