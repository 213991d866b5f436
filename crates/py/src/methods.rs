//! The methods: a triangulation in, edges out.

use crate::arrays::integer_rows;
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::edges::Edges;
use crustline_core::{Progress, Result, methods};
use numpy::PyArray2;
use pyo3::prelude::*;

type EdgeArray<'py> = Bound<'py, PyArray2<i64>>;

fn select<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
    method: impl FnOnce(&crustline_core::Delaunay, &Progress) -> Result<Edges> + Send,
) -> PyResult<EdgeArray<'py>> {
    let core = delaunay.core();
    let call = Call { size: core.input_len(), threads, callback: progress };
    integer_rows(py, &call.run(py, |progress| method(core, progress))?)
}

/// The crust.
#[pyfunction]
#[pyo3(signature = (delaunay, threads=None, progress=None))]
pub fn crust<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<EdgeArray<'py>> {
    select(py, delaunay, threads, progress, methods::crust)
}

/// The one-step crust.
#[pyfunction]
#[pyo3(signature = (delaunay, threads=None, progress=None))]
pub fn one_step_crust<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<EdgeArray<'py>> {
    select(py, delaunay, threads, progress, methods::one_step_crust)
}
