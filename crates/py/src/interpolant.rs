//! The smooth interpolant of edges as a Python object: local feature sizes, and the certificate.

use crate::arrays::{integer_rows, rows, values};
use crate::call::Call;
use crate::curve::Curve;
use crate::delaunay::Delaunay;
use crate::edges::narrow;
use crate::threads::aside;
use crustline_core as core;
use crustline_core::certificate::{Reason, Theorem, Theorems, certify};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use std::sync::Arc;

type Floats<'py> = Bound<'py, PyArray1<f64>>;
type Codes<'py> = Bound<'py, PyArray1<u8>>;
type Crust<'py> = Option<Bound<'py, PyArray2<i64>>>;
type Certified<'py> = (Option<&'static str>, bool, Floats<'py>, Codes<'py>, Codes<'py>, Crust<'py>);

/// The local feature size of samples and edges, made once and read by many.
#[pyclass(frozen, module = "crustline._core")]
pub struct Interpolant {
    inner: core::interpolant::Interpolant,
    curve: Py<Curve>,
    delaunay: Py<Delaunay>,
}

#[pymethods]
impl Interpolant {
    #[new]
    #[pyo3(signature = (delaunay, curve, threads=None, progress=None))]
    fn new(
        py: Python<'_>,
        delaunay: Py<Delaunay>,
        curve: Py<Curve>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let triangulation = delaunay.get().core();
        let size = triangulation.input_len();
        let adjacency = Arc::clone(&curve.get().adjacency);
        let call = Call { size, threads, callback: progress };
        let inner = call.run(py, |progress| {
            core::interpolant::Interpolant::new(triangulation, adjacency, progress)
        })?;
        Ok(Self { inner, curve, delaunay })
    }

    /// The local feature size at each row.
    fn sizes<'py>(&self, py: Python<'py>) -> PyResult<Floats<'py>> {
        let (delaunay, threads) = (self.delaunay.get().core(), self.delaunay.get().threads());
        Ok(values(py, aside(py, threads, || self.inner.at_rows(delaunay))?))
    }

    /// The method that a theorem about the edges names, if there is one; is it fulfilled everywhere; the sampling ratio of
    /// each edge; by number why each edge and each row is weak; and the crust, if it was needed and not known. `crust` is the crust,
    /// if it is known.
    #[pyo3(signature = (theorems, crust=None, threads=None, progress=None))]
    fn certificate<'py>(
        &self,
        py: Python<'py>,
        theorems: [f64; 4],
        crust: Option<PyReadonlyArray2<'py, i64>>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Certified<'py>> {
        let delaunay = self.delaunay.get().core();
        let [beta, of_skeleton, of_crust, margin] = theorems;
        let theorems = Theorems { beta, of_skeleton, of_crust, margin };
        let size = delaunay.input_len();
        let known = crust.as_ref().map(|edges| rows(py, edges)).transpose()?;
        let call = Call { size, threads, callback: progress };
        let edges = &self.curve.get().edges;
        let found = call.run(py, |progress| {
            let crust = || known.map_or_else(|| core::methods::crust(delaunay, progress), narrow);
            certify(delaunay, edges, &self.inner, &theorems, crust, progress)
        })?;
        let theorem = found.theorem.map(Theorem::method);
        let codes = [found.edges, found.points].map(|reasons| values(py, Reason::codes(reasons)));
        let [of_edges, of_points] = codes;
        let crust = found.crust.filter(|_| known.is_none());
        let crust = crust.map(|edges| integer_rows(py, threads, &edges)).transpose()?;
        Ok((theorem, found.guaranteed, values(py, found.ratios), of_edges, of_points, crust))
    }
}
