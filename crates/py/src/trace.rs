//! Tracing: edges in, curves out.

use crate::arrays::{integers, points, rows, values};
use crate::call::Call;
use crate::edges::canonical;
use crustline_core::trace::Curves;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

type Indices<'py> = Bound<'py, PyArray1<i64>>;

/// Trace edges, canonical ones, into `(indices, offsets, closed, isolated)`.
#[pyfunction]
#[pyo3(signature = (points, edges, threads=None, progress=None))]
#[allow(clippy::type_complexity)] // The tuple is the ragged format, in the order of its documentation.
pub fn trace<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray2<'py, i64>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Indices<'py>, Indices<'py>, Bound<'py, PyArray1<bool>>, Indices<'py>)> {
    let points = self::points(py, &points)?;
    let edges = canonical(py, threads, rows(py, &edges)?, points.len())?;
    let call = Call { size: points.len(), threads, callback: progress };
    let Curves { indices, offsets, closed, isolated } =
        call.run(py, |progress| crustline_core::trace::trace(points, edges, progress))?;
    Ok((
        integers(py, indices.into_iter().map(i64::from)),
        integers(py, offsets.into_iter().map(|offset| offset as i64)),
        values(py, closed),
        integers(py, isolated.into_iter().map(i64::from)),
    ))
}
