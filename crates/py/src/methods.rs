//! The methods: a triangulation in, edges out.

use crate::arrays::integer_rows;
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::methods;
use numpy::PyArray2;
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
    let core = delaunay.core();
    let call = Call { size: core.input_len(), threads, callback: progress };
    let edges = call.run(py, |progress| methods::select(core, method, &parameters, progress))?;
    integer_rows(py, threads, &edges)
}
