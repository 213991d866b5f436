//! Edges as pairs of input rows, in the one canonical order, and their parallel selection.

use crate::delaunay::{Delaunay, Edge};
use crate::error::Result;
use crate::memory;
use crate::parts::{GRAIN, each, in_parts, split};
use crate::progress::{Progress, Stage};

/// Memory for each vertex at the peak, if up to three edges each are kept and sorted.
const BYTES: usize = 64;

/// Edges as input rows: i < j in each, sorted, unique.
pub type Edges = Vec<[u32; 2]>;

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
    memory::check(vertices, BYTES)?;
    let parts = in_parts(vertices, GRAIN, progress, |vertices| {
        let mut memory = scratch();
        let mut kept = Vec::with_capacity(vertices.len());
        for p in vertices {
            let edges = delaunay.edges_from(p as u32).filter(|&edge| keep(&mut memory, edge));
            kept.extend(edges.map(|edge| rows(delaunay, edge.p, edge.q)));
        }
        kept
    })?;
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
/// Counting by the first row and then sorting the few edges of each: linear, where a comparison sort is not. A range of rows
/// is one task; reading all edges for each range costs less than writing all over memory.
#[must_use]
pub fn sort(parts: &[Edges], rows: usize) -> Edges {
    let count: usize = parts.iter().map(Vec::len).sum();
    let ranges = if count < FEW { 1 } else { RANGES };
    let width = rows / ranges + 1;
    let mut counts = vec![0; ranges];
    // Inner iteration, here and below: `for` over `flatten` takes twice the time.
    parts.iter().flatten().for_each(|edge| counts[edge[0] as usize / width] += 1);
    let mut sorted = vec![[0, 0]; count];
    each(split(&mut sorted, counts), |range, sorted| {
        sort_range(parts, range * width, width, sorted);
    });
    sorted
}

/// Edges below which one task sorts all.
const FEW: usize = 1 << 15;
/// Ranges of rows, so tasks, that more edges are sorted in.
const RANGES: usize = 2;

/// Put the edges whose first row is one of the `width` rows from `first` into `sorted`.
fn sort_range(parts: &[Edges], first: usize, width: usize, sorted: &mut [[u32; 2]]) {
    let within = |&[i, j]: &[u32; 2]| {
        let row = (i as usize).wrapping_sub(first);
        (row < width).then_some((row, [i, j]))
    };
    let mut ends = vec![0u32; width + 1];
    parts.iter().flatten().filter_map(within).for_each(|(row, _)| ends[row + 1] += 1);
    for row in 0..width {
        ends[row + 1] += ends[row];
    }
    parts.iter().flatten().filter_map(within).for_each(|(row, edge)| {
        let end = &mut ends[row];
        sorted[*end as usize] = edge;
        *end += 1;
    });
    for same in sorted.chunk_by_mut(|a, b| a[0] == b[0]).filter(|same| same.len() > 1) {
        same.sort_unstable();
    }
}
