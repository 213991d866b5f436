//! Curves behind imperfect points.

use crate::arrays::{integer_rows, rows, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::connect::{self as core, CONSTANTS, Longest};
use crustline_core::edges::Edges;
use numpy::{PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What is known of the curves, as `crustline.methods.hints.Hints` holds it.
#[derive(FromPyObject)]
#[allow(clippy::struct_excessive_bools)] // They are the flags of a Python object.
pub struct Hints<'py> {
    keep: PyReadonlyArray2<'py, i64>,
    forbid: PyReadonlyArray2<'py, i64>,
    ends: PyReadonlyArray1<'py, i64>,
    longest: Option<f64>,
    in_spacings: bool,
    every_point: bool,
    fewest: usize,
    closed: bool,
    components: Option<usize>,
    junctions: bool,
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
            closed: self.closed,
            components: self.components,
            junctions: self.junctions,
        })
    }
}

fn known(py: Python<'_>, hints: Option<Hints<'_>>) -> PyResult<core::Hints> {
    hints.map_or_else(|| Ok(core::Hints::default()), |hints| hints.core(py))
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
    let hints = known(py, hints)?;
    let triangulation = delaunay.core();
    let call = Call { size: triangulation.input_len(), threads, callback: progress };
    let edges =
        call.run(py, |progress| core::connect(triangulation, &CONSTANTS, &hints, progress))?;
    integer_rows(py, threads, &edges)
}

/// The same edges with all that is known of them, by name.
#[pyfunction]
#[pyo3(signature = (delaunay, hints=None, threads=None, progress=None))]
pub fn connection<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    hints: Option<Hints<'py>>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let hints = known(py, hints)?;
    let triangulation = delaunay.core();
    let call = Call { size: triangulation.input_len(), threads, callback: progress };
    let made =
        call.run(py, |progress| core::connection(triangulation, &CONSTANTS, &hints, progress))?;
    let dict = PyDict::new(py);
    dict.set_item("edges", integer_rows(py, threads, &made.edges)?)?;
    dict.set_item("confidence", values(py, made.confidence))?;
    dict.set_item("whole", made.whole)?;
    dict.set_item("features", features(py, &made.features)?)?;
    dict.set_item("description", values(py, made.description.to_vec()))?;
    for (name, reasoned) in [("left_out", made.left_out), ("added", made.added)] {
        let (edges, reasons): (Edges, Vec<&str>) =
            reasoned.iter().map(|(edge, reason)| (*edge, reason.word())).unzip();
        dict.set_item(name, (integer_rows(py, threads, &edges)?, reasons))?;
    }
    Ok(dict)
}

/// A row for each edge, of NaN where nothing describes it.
fn features<'py, const N: usize>(
    py: Python<'py>,
    rows: &[Option<[f64; N]>],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = rows.iter().flat_map(|row| row.unwrap_or([f64::NAN; N])).collect();
    values(py, flat).reshape([rows.len(), N])
}
