//! Tracing: edges in, curves out.

use crate::arrays::{integers, points, rows, values};
use crate::call::Call;
use crate::errors::input_error;
use crustline_core::edges::Edges;
use crustline_core::trace::Curves;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

type Indices<'py> = Bound<'py, PyArray1<i64>>;

/// Trace edges, canonical ones, into `(indices, offsets, closed, isolated)`.
#[pyfunction]
#[pyo3(signature = (points, edges))]
#[allow(clippy::type_complexity)] // The tuple is the ragged format, in the order of its documentation.
pub fn trace<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray2<'py, i64>,
) -> PyResult<(Indices<'py>, Indices<'py>, Bound<'py, PyArray1<bool>>, Indices<'py>)> {
    let points = self::points(py, &points)?;
    let edges = canonical(py, rows(py, &edges)?, points.len())?;
    let call = Call { size: points.len(), threads: None, callback: None };
    let Curves { indices, offsets, closed, isolated } =
        call.run(py, |progress| crustline_core::trace::trace(points, &edges, progress))?;
    Ok((
        integers(py, indices.into_iter().map(i64::from)),
        integers(py, offsets.into_iter().map(|offset| offset as i64)),
        values(py, closed),
        integers(py, isolated.into_iter().map(i64::from)),
    ))
}

/// The edges as canonical ones of the core: i < j, sorted, unique, within the points.
pub fn canonical(py: Python<'_>, edges: &[[i64; 2]], points: usize) -> PyResult<Edges> {
    let inside = |&row: &i64| row >= 0 && (row as usize) < points;
    if let Some(k) = edges.iter().position(|edge| edge[0] == edge[1] || !edge.iter().all(inside)) {
        let [i, j] = edges[k];
        let message =
            format!("edge {k}: ({i}, {j}) does not join two different rows of the {points} points");
        return Err(input_error(py, message));
    }
    let mut canonical: Edges =
        edges.iter().map(|&[i, j]| [i.min(j) as u32, i.max(j) as u32]).collect();
    if !canonical.is_sorted() {
        canonical.sort_unstable();
    }
    canonical.dedup();
    Ok(canonical)
}
