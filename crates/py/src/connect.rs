//! Curves behind imperfect points.

use crate::arrays::integer_rows;
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::connect::{self as core, CONSTANTS};
use numpy::PyArray2;
use pyo3::prelude::*;

/// The edges of `connect`.
#[pyfunction]
#[pyo3(signature = (delaunay, threads=None, progress=None))]
pub fn connect<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let triangulation = delaunay.core();
    let call = Call { size: triangulation.input_len(), threads, callback: progress };
    let edges = call.run(py, |progress| core::connect(triangulation, &CONSTANTS, progress))?;
    integer_rows(py, &edges)
}
