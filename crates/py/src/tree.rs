//! Segments as a Python object, to find how far places are from the nearest.

use crate::arrays::{points, values};
use crate::call::Call;
use crustline_core as core;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Segments, or points, in a tree of boxes.
#[pyclass(frozen, module = "crustline._core")]
pub struct Tree(core::Tree);

#[pymethods]
impl Tree {
    /// The segments from `starts` to `ends`.
    #[new]
    fn new(
        py: Python<'_>,
        starts: PyReadonlyArray2<'_, f64>,
        ends: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        let (starts, ends) = (points(py, &starts)?, points(py, &ends)?);
        let call = Call { size: starts.len(), threads: None, callback: None };
        let pairs = starts.iter().zip(ends).map(|(&start, &end)| [start, end]).collect::<Vec<_>>();
        Ok(Self(call.run(py, |_| Ok(core::Tree::exact(&pairs)))?))
    }

    /// The distance from each place to the nearest segment; places that follow each other should be near.
    fn distances<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let places = points(py, &places)?;
        let call = Call { size: places.len(), threads: None, callback: None };
        Ok(values(py, call.run(py, |_| Ok(self.0.distances(places)))?))
    }
}
