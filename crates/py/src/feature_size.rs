//! The local feature size of samples: a triangulation and edges in, an array out.

use crate::arrays::{rows, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crate::trace::canonical;
use crustline_core::feature_size::feature_size as sizes;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// The estimated local feature size at each row.
#[pyfunction]
pub fn feature_size<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    edges: PyReadonlyArray2<'py, i64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let core = delaunay.core();
    let edges = canonical(py, rows(py, &edges)?, core.input_len())?;
    let call = Call { size: core.input_len(), threads: None, callback: None };
    Ok(values(py, call.run(py, |progress| sizes(core, &edges, progress))?))
}
