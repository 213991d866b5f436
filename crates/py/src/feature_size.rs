//! The smooth interpolant of edges as a Python object: local feature sizes, and the measures of a certificate.

use crate::arrays::{integers, rows, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crate::trace::canonical;
use crustline_core as core;
use crustline_core::certify::{Measures, measure};
use crustline_core::edges::Edges;
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

type Floats<'py> = Bound<'py, PyArray1<f64>>;

/// The local feature size of samples and edges, made once and read by many.
#[pyclass(frozen, module = "crustline._core")]
pub struct FeatureSize {
    inner: core::feature_size::FeatureSize,
    edges: Edges,
    delaunay: Py<Delaunay>,
}

#[pymethods]
impl FeatureSize {
    #[new]
    fn new(
        py: Python<'_>,
        delaunay: Py<Delaunay>,
        edges: PyReadonlyArray2<'_, i64>,
    ) -> PyResult<Self> {
        let triangulation = delaunay.get().core();
        let size = triangulation.input_len();
        let edges = canonical(py, rows(py, &edges)?, size)?;
        let call = Call { size, threads: None, callback: None };
        let inner = call.run(py, |progress| {
            core::feature_size::FeatureSize::new(triangulation, &edges, progress)
        })?;
        Ok(Self { inner, edges, delaunay })
    }

    /// The local feature size at each row.
    fn sizes<'py>(&self, py: Python<'py>) -> Floats<'py> {
        let delaunay = self.delaunay.get().core();
        values(py, py.detach(|| self.inner.at_rows(delaunay)))
    }

    /// The sampling ratio of each edge, and the turn and the degree of each row.
    fn measures<'py>(
        &self,
        py: Python<'py>,
    ) -> (Floats<'py>, Floats<'py>, Bound<'py, PyArray1<i64>>) {
        let delaunay = self.delaunay.get().core();
        let Measures { ratios, turns, degrees } =
            py.detach(|| measure(delaunay, &self.edges, &self.inner));
        let degrees = integers(py, degrees.into_iter().map(i64::from));
        (values(py, ratios), values(py, turns), degrees)
    }
}
