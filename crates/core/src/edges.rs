//! Edges as pairs of input rows, in the one canonical order, and their parallel selection.

use crate::delaunay::{Delaunay, Edge, Packed};
use crate::error::Result;
use crate::memory;
use crate::parts::{GRAIN, in_parts, scatter, short, split, try_each};
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
    select_screened(delaunay, progress, |_| true, scratch, keep)
}

/// As [`select`], of the edges that pass `screen`, a quick test that many edges fail: it is made on a number of edges at a time,
/// without a branch on its outcome.
///
/// # Errors
/// A cancelled `progress`.
pub fn select_screened<S>(
    delaunay: &Delaunay,
    progress: &Progress,
    screen: impl Fn(Edge) -> bool + Sync,
    scratch: impl Fn() -> S + Sync,
    keep: impl Fn(&mut S, Edge) -> bool + Sync,
) -> Result<Edges> {
    let vertices = delaunay.points().len();
    progress.enter(Stage::Select, vertices)?;
    memory::check(vertices, BYTES)?;
    let parts = in_parts(vertices, GRAIN, progress, |vertices| {
        let (mut memory, mut edges) = (scratch(), Vec::new());
        let mut kept = Vec::with_capacity(vertices.len());
        for few in short(vertices, progress) {
            let count = delaunay.write_edges_from(few, &mut edges);
            let passed = pass(&mut edges[..count], &screen);
            let edges = passed.iter().map(|&edge| Edge::from(edge));
            let edges = edges.filter(|&edge| keep(&mut memory, edge));
            kept.extend(edges.map(|edge| rows(delaunay, edge.p, edge.q)));
        }
        kept
    })?;
    Ok(sort(&parts, delaunay.input_len()))
}

/// Move the edges that pass `screen` to the front; return them.
fn pass(edges: &mut [Packed], screen: impl Fn(Edge) -> bool) -> &[Packed] {
    let mut count = 0;
    for k in 0..edges.len() {
        let edge = edges[k];
        edges[count] = edge;
        count += usize::from(screen(edge.into()));
    }
    &edges[..count]
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

/// Rows whose edges one task sorts, in the first cache; of a great many rows, more.
const ROWS: usize = 1 << 12;
/// The most tasks.
const MOST_TASKS: usize = 1 << 12;

/// Put `parts` of edges on `rows` rows into one sorted list.
#[must_use]
#[allow(clippy::missing_panics_doc)] // There is no one to cancel.
pub fn sort(parts: &[Edges], rows: usize) -> Edges {
    sort_by(parts, rows, |&edge| edge, &Progress::default()).expect("no one cancels")
}

/// Put `parts` of items into one list, sorted by the `edge` of each, on `rows` rows.
///
/// Counting by the first row, in two passes, and then sorting the few edges of each: linear, where a comparison sort is not.
///
/// # Errors
/// A cancelled `progress`.
pub fn sort_by<T: Copy + Default + Send + Sync>(
    parts: &[Vec<T>],
    rows: usize,
    edge: impl Fn(&T) -> [u32; 2] + Sync + Send,
    progress: &Progress,
) -> Result<Vec<T>> {
    let (width, tasks) = tasks(rows);
    let shift = width.trailing_zeros();
    let bucket = |item: &T| edge(item)[0] as usize >> shift;
    let (mut items, counts) = scatter(parts, T::default(), tasks, bucket);
    try_each(split(&mut items, counts), |k, items| {
        sort_rows(items, k << shift, width, &edge);
        progress.advance(0)
    })?;
    Ok(items)
}

/// The rows that each task has, a power of two, and the number of tasks.
fn tasks(rows: usize) -> (usize, usize) {
    let width = rows.min(ROWS).max(rows / MOST_TASKS).next_power_of_two();
    (width, rows.div_ceil(width).max(1))
}

/// Sort the items whose edges are on the `width` rows from `first`.
fn sort_rows<T: Copy>(items: &mut [T], first: usize, width: usize, edge: impl Fn(&T) -> [u32; 2]) {
    let row = |item: &T| edge(item)[0] as usize - first;
    let mut ends = vec![0u32; width + 1];
    for item in &*items {
        ends[row(item) + 1] += 1;
    }
    for row in 0..width {
        ends[row + 1] += ends[row];
    }
    let unsorted = items.to_vec();
    for item in unsorted {
        let end = &mut ends[row(&item)];
        items[*end as usize] = item;
        *end += 1;
    }
    for same in items.chunk_by_mut(|a, b| row(a) == row(b)).filter(|same| same.len() > 1) {
        same.sort_unstable_by_key(&edge);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_of_any_number_of_rows_are_sorted() {
        for rows in [1usize, 2, 64, 100, ROWS - 1, ROWS, ROWS + 1, 5 * ROWS + 3] {
            let at = |k: usize| (k.wrapping_mul(2_654_435_761) >> 5) % rows;
            let edge = |k| [at(k).min(at(k + 1)) as u32, at(k).max(at(k + 1)) as u32];
            let parts: Vec<Edges> =
                (0..9).map(|p| (100 * p..107 * p).map(edge).collect()).collect();
            let mut expected = parts.concat();
            expected.sort_unstable();
            assert_eq!(sort(&parts, rows), expected);
        }
    }

    #[test]
    fn few_rows_are_one_task_though_their_number_is_a_power_of_two() {
        for rows in [0, 1, 2, 4, 64, 100, ROWS] {
            assert_eq!(tasks(rows).1, 1);
        }
        assert_eq!(tasks(ROWS + 1).1, 2);
    }
}
