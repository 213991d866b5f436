//! Nesting: curves in, the shell of each ring out.

use crate::arrays::{integers, points};
use crate::call::Call;
use crate::errors::input_error;
use crustline_core::nesting::shells as nest;
use crustline_core::trace::Curves;
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// For each curve the number of the shell that it is, or is a hole in; −1 for a polyline.
#[pyfunction]
#[pyo3(signature = (points, indices, offsets, closed, threads=None, progress=None))]
pub fn shells<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    indices: PyReadonlyArray1<'py, i64>,
    offsets: PyReadonlyArray1<'py, i64>,
    closed: PyReadonlyArray1<'py, bool>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let points = self::points(py, &points)?;
    let curves = Curves {
        indices: indices.as_slice()?.iter().map(|&row| row as u32).collect(),
        offsets: offsets.as_slice()?.iter().map(|&offset| offset as usize).collect(),
        closed: closed.as_slice()?.to_vec(),
        isolated: Vec::new(),
    };
    let is_row = |&row: &i64| row >= 0 && (row as usize) < points.len();
    let ends = curves.offsets.len() == curves.closed.len() + 1
        && curves.offsets.is_sorted()
        && curves.offsets.last() == Some(&curves.indices.len());
    if !ends || !indices.as_slice()?.iter().all(is_row) {
        let message =
            "the curves' indices, offsets and closed do not fit each other and the points";
        return Err(input_error(py, message.to_owned()));
    }
    let call = Call { size: points.len(), threads, callback: progress };
    let shells = call.run(py, |progress| nest(points, &curves, progress))?;
    Ok(integers(py, shells.into_iter().map(|shell| shell.map_or(-1, i64::from))))
}
