//! Edges as pairs of input rows, in the one canonical order, and their parallel selection.

use crate::delaunay::{Delaunay, Edge};
use crate::error::Result;
use crate::progress::{Progress, Stage};
use rayon::prelude::*;

/// Edges as input rows: i < j in each, sorted, unique.
pub type Edges = Vec<[u32; 2]>;

/// Vertices that one task takes at a time.
const GRAIN: usize = 1 << 12;

/// The edges of the triangulation that `keep` keeps, as rows.
///
/// `scratch` makes the working memory of one task.
///
/// # Errors
/// A cancelled `progress`.
pub fn select<S>(
    delaunay: &Delaunay,
    progress: &Progress,
    scratch: impl Fn() -> S + Sync,
    keep: impl Fn(&mut S, Edge) -> bool + Sync,
) -> Result<Edges> {
    let vertices = delaunay.points().len();
    progress.enter(Stage::Select, vertices)?;
    let part = |start: usize| {
        let end = (start + GRAIN).min(vertices);
        let mut memory = scratch();
        let mut kept = Vec::with_capacity(end - start);
        for p in start..end {
            let edges = delaunay.edges_from(p as u32).filter(|&edge| keep(&mut memory, edge));
            kept.extend(edges.map(|edge| rows(delaunay, edge.p, edge.q)));
        }
        progress.advance(end - start)?;
        Ok(kept)
    };
    let starts: Vec<usize> = (0..vertices).step_by(GRAIN).collect();
    let parts = starts.into_par_iter().map(part).collect::<Result<Vec<_>>>()?;
    Ok(sort(&parts, delaunay.input_len()))
}

/// All edges of the triangulation, as rows.
#[must_use]
pub fn all(delaunay: &Delaunay) -> Edges {
    let edges = delaunay.edges().map(|edge| rows(delaunay, edge.p, edge.q)).collect();
    sort(&[edges], delaunay.input_len())
}

/// The edge between two vertices as rows, smaller first.
#[must_use]
pub fn rows(delaunay: &Delaunay, p: u32, q: u32) -> [u32; 2] {
    let [i, j] = [p, q].map(|vertex| delaunay.rows()[vertex as usize]);
    [i.min(j), i.max(j)]
}

/// Put `parts` of edges on `rows` rows into one sorted list.
///
/// Counting by the first row and then sorting the few edges of each: linear, where a comparison sort is not.
#[must_use]
pub fn sort(parts: &[Edges], rows: usize) -> Edges {
    let mut ends = vec![0u32; rows + 1];
    for &[i, _] in parts.iter().flatten() {
        ends[i as usize + 1] += 1;
    }
    for i in 0..rows {
        ends[i + 1] += ends[i];
    }
    let mut sorted = vec![[0, 0]; ends[rows] as usize];
    for &[i, j] in parts.iter().flatten() {
        let end = &mut ends[i as usize];
        sorted[*end as usize] = [i, j];
        *end += 1;
    }
    for same in sorted.chunk_by_mut(|a, b| a[0] == b[0]).filter(|same| same.len() > 1) {
        same.sort_unstable();
    }
    sorted
}
