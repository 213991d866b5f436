//! Edges from Python: pairs of rows in any order, or in the canonical one.

use crate::arrays::{all_pairs, rows};
use crate::errors::{exception, input_error};
use crate::threads::aside;
use crustline_core::Result;
use crustline_core::edges::Edges;
use crustline_core::memory::check;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use rayon::prelude::*;

/// Memory for each edge as one of the core.
const BYTES: usize = size_of::<[u32; 2]>();

/// Are the edges i < j in each row, sorted, unique, and between `points` points?
#[pyfunction]
pub fn is_canonical(
    py: Python<'_>,
    edges: PyReadonlyArray2<'_, i64>,
    points: i64,
) -> PyResult<bool> {
    Ok(are_canonical(rows(py, &edges)?, points))
}

fn are_canonical(edges: &[[i64; 2]], points: i64) -> bool {
    let fits = |&[i, j]: &[i64; 2]| 0 <= i && i < j && j < points;
    let ascends = |[i, j]: &[i64; 2], [k, l]: &[i64; 2]| i < k || i == k && j < l;
    let later = edges.get(1..).unwrap_or_default();
    edges.first().is_none_or(fits)
        && all_pairs(edges, later, |edge, next| fits(next) & ascends(edge, next))
}

/// Canonical edges as those of the core, made by the thread that will take them: each has memory of its own.
pub fn narrow(edges: &[[i64; 2]]) -> Result<Edges> {
    check(edges.len(), BYTES)?;
    Ok(edges.par_iter().map(|edge| edge.map(|row| row as u32)).collect())
}

/// The edges as canonical ones of the core: i < j, sorted, unique, within the points.
pub fn canonical(
    py: Python<'_>,
    threads: Option<usize>,
    edges: &[[i64; 2]],
    points: usize,
) -> PyResult<Edges> {
    if are_canonical(edges, points as i64) {
        return aside(py, threads, || narrow(edges))?.map_err(|error| exception(py, &error));
    }
    let inside = |&row: &i64| row >= 0 && (row as usize) < points;
    if let Some(k) = edges.iter().position(|edge| edge[0] == edge[1] || !edge.iter().all(inside)) {
        let [i, j] = edges[k];
        let message =
            format!("edge {k}: ({i}, {j}) does not join two different rows of the {points} points");
        return Err(input_error(py, message));
    }
    let mut canonical: Edges =
        edges.iter().map(|&[i, j]| [i.min(j) as u32, i.max(j) as u32]).collect();
    #[allow(clippy::stable_sort_primitive)]
    // It merges runs, and nearly all edges of a tile are in order.
    canonical.sort();
    canonical.dedup();
    Ok(canonical)
}
