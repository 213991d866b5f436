//! Between typed arrays and the rows of the core: the one door, and the one place where errors become exceptions.

use crustline_core::edges::Edges;
use crustline_core::{Error, Point, Progress, Result};
use wasm_bindgen::prelude::*;

/// Run a call of the core; its error becomes an exception.
pub fn run<T>(work: impl FnOnce(&Progress) -> Result<T>) -> std::result::Result<T, JsError> {
    work(&Progress::default()).map_err(|error: Error| JsError::new(&error.to_string()))
}

/// Coordinates as points, all finite.
pub fn points(coordinates: &[f64]) -> std::result::Result<Vec<Point>, JsError> {
    let (points, rest) = coordinates.as_chunks::<2>();
    if !rest.is_empty() {
        let count = coordinates.len();
        let message = format!("points: {count} numbers are no pairs: pass x, y, x, y, …");
        return Err(JsError::new(&message));
    }
    if let Some(k) = coordinates.iter().position(|x| !x.is_finite()) {
        let (row, column, value) = (k / 2, k % 2, coordinates[k]);
        return Err(JsError::new(&format!(
            "points: row {row} has {value} in column {column}, which is not finite: remove or repair the row"
        )));
    }
    Ok(points.to_vec())
}

/// Pairs of rows as edges: i < j, sorted, unique, between `count` points.
pub fn edges(rows: &[u32], count: usize) -> std::result::Result<Edges, JsError> {
    let (pairs, rest) = rows.as_chunks::<2>();
    if !rest.is_empty() {
        let message = format!("edges: {} numbers are no pairs: pass i, j, i, j, …", rows.len());
        return Err(JsError::new(&message));
    }
    let fits = |&[i, j]: &[u32; 2]| i != j && (i.max(j) as usize) < count;
    if let Some(k) = pairs.iter().position(|pair| !fits(pair)) {
        let [i, j] = pairs[k];
        return Err(JsError::new(&format!(
            "edge {k}: ({i}, {j}) does not join two different rows of the {count} points"
        )));
    }
    let mut edges: Edges = pairs.iter().map(|&[i, j]| [i.min(j), i.max(j)]).collect();
    edges.sort_unstable();
    edges.dedup();
    Ok(edges)
}

/// Rows one after another.
pub fn flat<const N: usize, T>(rows: Vec<[T; N]>) -> Vec<T> {
    rows.into_flattened()
}
