//! The methods: points or a triangulation in, edges out.

use crate::arrays::{integer_rows, points};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core as core;
use crustline_core::methods;
use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

/// The edges of the method of a name, with its parameters in order.
#[pyfunction]
#[pyo3(signature = (delaunay, method, parameters, threads=None, progress=None))]
#[allow(clippy::needless_pass_by_value)] // What comes from Python is owned.
pub fn select<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    method: &str,
    parameters: Vec<f64>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let delaunay = delaunay.core();
    let call = Call { size: delaunay.input_len(), threads, callback: progress };
    let edges =
        call.run(py, |progress| methods::select(delaunay, method, &parameters, progress))?;
    integer_rows(py, threads, &edges)
}

/// The edges of the method of a name among points whose triangulation no one else asks for.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // What comes from Python is owned.
pub fn select_among<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    method: &str,
    parameters: Vec<f64>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let points = self::points(py, &points)?;
    let call = Call { size: points.len(), threads: None, callback: None };
    let edges = call.run(py, |progress| {
        let delaunay = core::Delaunay::new(points, progress)?;
        methods::select(&delaunay, method, &parameters, progress)
    })?;
    integer_rows(py, None, &edges)
}
