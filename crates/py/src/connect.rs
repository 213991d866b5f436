//! Curves behind imperfect points.

use crate::arrays::{integer_rows, rows};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::connect::{self as core, CONSTANTS, Longest};
use crustline_core::edges::Edges;
use numpy::{PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// What is known of the curves, as `crustline.methods.hints.Hints` holds it.
#[derive(FromPyObject)]
pub struct Hints<'py> {
    keep: PyReadonlyArray2<'py, i64>,
    forbid: PyReadonlyArray2<'py, i64>,
    ends: PyReadonlyArray1<'py, i64>,
    longest: Option<f64>,
    in_spacings: bool,
    every_point: bool,
    fewest: usize,
}

impl Hints<'_> {
    fn core(&self, py: Python<'_>) -> PyResult<core::Hints> {
        let edges = |array| -> PyResult<Edges> {
            Ok(rows(py, array)?.iter().map(|edge| edge.map(|row: i64| row as u32)).collect())
        };
        let longest = if self.in_spacings { Longest::Spacings } else { Longest::Length };
        Ok(core::Hints {
            keep: edges(&self.keep)?,
            forbid: edges(&self.forbid)?,
            ends: self.ends.as_slice()?.iter().map(|&row| row as u32).collect(),
            longest: self.longest.map(longest),
            every_point: self.every_point,
            fewest: self.fewest,
        })
    }
}

/// The edges of `connect`.
#[pyfunction]
#[pyo3(signature = (delaunay, hints=None, threads=None, progress=None))]
pub fn connect<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    hints: Option<Hints<'py>>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let hints = hints.map_or_else(|| Ok(core::Hints::default()), |hints| hints.core(py))?;
    let triangulation = delaunay.core();
    let call = Call { size: triangulation.input_len(), threads, callback: progress };
    let edges =
        call.run(py, |progress| core::connect(triangulation, &CONSTANTS, &hints, progress))?;
    integer_rows(py, threads, &edges)
}
