//! The smooth interpolant of edges as a Python object: local feature sizes, and the measures of a certificate.

use crate::arrays::{integers, rows, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crate::edges::canonical;
use crate::threads::aside;
use crustline_core as core;
use crustline_core::certify::{Measures, measure};
use crustline_core::edges::Edges;
use crustline_core::methods::{Kind, beta_skeleton, is_beta_skeleton};
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

type Floats<'py> = Bound<'py, PyArray1<f64>>;

/// The local feature size of samples and edges, made once and read by many.
#[pyclass(frozen, module = "crustline._core")]
pub struct Interpolant {
    inner: core::interpolant::Interpolant,
    edges: Edges,
    delaunay: Py<Delaunay>,
}

#[pymethods]
impl Interpolant {
    #[new]
    #[pyo3(signature = (delaunay, edges, threads=None, progress=None))]
    fn new(
        py: Python<'_>,
        delaunay: Py<Delaunay>,
        edges: PyReadonlyArray2<'_, i64>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let triangulation = delaunay.get().core();
        let size = triangulation.input_len();
        let edges = canonical(py, threads, rows(py, &edges)?, size)?;
        let call = Call { size, threads, callback: progress };
        let inner = call.run(py, |progress| {
            core::interpolant::Interpolant::new(triangulation, &edges, progress)
        })?;
        Ok(Self { inner, edges, delaunay })
    }

    /// Was this made of `edges`, which are canonical?
    fn is_of(&self, py: Python<'_>, edges: PyReadonlyArray2<'_, i64>) -> PyResult<bool> {
        let edges = rows(py, &edges)?;
        let same = |(own, edge): (&[u32; 2], &[i64; 2])| own.map(i64::from) == *edge;
        Ok(edges.len() == self.edges.len() && self.edges.iter().zip(edges).all(same))
    }

    /// Are the edges the β-skeleton of circles of the points?
    #[pyo3(signature = (beta, threads=None, progress=None))]
    fn is_beta_skeleton(
        &self,
        py: Python<'_>,
        beta: f64,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<bool> {
        let delaunay = self.delaunay.get().core();
        let call = Call { size: delaunay.input_len(), threads, callback: progress };
        call.run(py, |progress| {
            if delaunay.duplicates().is_empty() {
                is_beta_skeleton(delaunay, beta, self.inner.curve(), progress)
            } else {
                Ok(beta_skeleton(delaunay, beta, Kind::Circle, progress)? == self.edges)
            }
        })
    }

    /// The local feature size at each row.
    fn sizes<'py>(&self, py: Python<'py>) -> PyResult<Floats<'py>> {
        let (delaunay, threads) = (self.delaunay.get().core(), self.delaunay.get().threads());
        Ok(values(py, aside(py, threads, || self.inner.at_rows(delaunay))?))
    }

    /// The sampling ratio of each edge, and the turn and the degree of each row.
    #[pyo3(signature = (threads=None, progress=None))]
    #[allow(clippy::type_complexity)] // The tuple is in the order of its documentation.
    fn measures<'py>(
        &self,
        py: Python<'py>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Floats<'py>, Floats<'py>, Bound<'py, PyArray1<i64>>)> {
        let delaunay = self.delaunay.get().core();
        let call = Call { size: delaunay.input_len(), threads, callback: progress };
        let Measures { ratios, turns, degrees } =
            call.run(py, |progress| measure(delaunay, &self.edges, &self.inner, progress))?;
        let degrees = integers(py, degrees.into_iter().map(i64::from));
        Ok((values(py, ratios), values(py, turns), degrees))
    }
}
