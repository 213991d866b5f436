//! Edges within groups of points, many at once.

use crate::arrays::{integer_rows, points};
use crate::call::Call;
use crate::errors::input_error;
use crustline_core::connect::{CONSTANTS, Hints, connect};
use crustline_core::{groups, methods};
use numpy::{PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// The edges of the method of a name within each group: `rows` holds those of the groups one after another, `ends` where each
/// group ends among them.
#[pyfunction]
#[pyo3(signature = (points, rows, ends, method, parameters, threads=None, progress=None))]
#[allow(clippy::too_many_arguments)] // They are the arguments of a Python function.
pub fn select_by_group<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    rows: PyReadonlyArray1<'py, i64>,
    ends: PyReadonlyArray1<'py, i64>,
    method: &str,
    parameters: Vec<f64>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let points = self::points(py, &points)?;
    let (rows, ends) = (rows.as_slice()?, ends.as_slice()?);
    let is_row = |&row: &i64| row >= 0 && (row as usize) < points.len();
    let last = ends.last().copied().unwrap_or(0);
    if !(rows.iter().all(is_row) && ends.is_sorted() && last == rows.len() as i64) {
        let message = "the rows and ends of the groups do not fit each other and the points";
        return Err(input_error(py, message.to_owned()));
    }
    let rows: Vec<u32> = rows.iter().map(|&row| row as u32).collect();
    let ends: Vec<usize> = ends.iter().map(|&end| end as usize).collect();
    let call = Call { size: points.len(), threads, callback: progress };
    let edges = call.run(py, |progress| {
        groups::select_by_group(points, &rows, &ends, progress, |delaunay, progress| match method {
            "connect" => connect(delaunay, &CONSTANTS, &Hints::default(), progress),
            _ => methods::select(delaunay, method, &parameters, progress),
        })
    })?;
    integer_rows(py, threads, &edges)
}
