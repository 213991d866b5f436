//! The measures of a certificate: a triangulation and edges in, arrays out.

use crate::arrays::{integers, rows, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crate::trace::canonical;
use crustline_core::certify::{Measures, measure};
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

type Floats<'py> = Bound<'py, PyArray1<f64>>;

/// The ratio of each edge, and the turn and the degree of each row.
#[pyfunction]
pub fn certify<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    edges: PyReadonlyArray2<'py, i64>,
) -> PyResult<(Floats<'py>, Floats<'py>, Bound<'py, PyArray1<i64>>)> {
    let core = delaunay.core();
    let edges = canonical(py, rows(py, &edges)?, core.input_len())?;
    let call = Call { size: core.input_len(), threads: None, callback: None };
    let Measures { ratios, turns, degrees } =
        call.run(py, |progress| measure(core, &edges, progress))?;
    let degrees = integers(py, degrees.into_iter().map(i64::from));
    Ok((values(py, ratios), values(py, turns), degrees))
}
