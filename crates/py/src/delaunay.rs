//! The triangulation as a Python object, and its parts as arrays.

use crate::arrays::{coordinates, integer_rows, integers, points, values};
use crate::call::Call;
use crate::threads::aside;
use crustline_core as core;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

/// A Delaunay triangulation, made once and read by many.
#[pyclass(frozen, module = "crustline._core")]
pub struct Delaunay {
    inner: core::Delaunay,
    threads: Option<usize>,
}

impl Delaunay {
    /// The triangulation of the core.
    pub fn core(&self) -> &core::Delaunay {
        &self.inner
    }

    /// How many threads to use for what is read from it.
    pub fn threads(&self) -> Option<usize> {
        self.threads
    }
}

#[pymethods]
impl Delaunay {
    #[new]
    #[pyo3(signature = (points, threads=None, progress=None))]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let rows = self::points(py, &points)?;
        let call = Call { size: rows.len(), threads, callback: progress };
        let inner = call.run(py, |progress| core::Delaunay::new(rows, progress))?;
        Ok(Self { inner, threads })
    }

    /// The triangles (t, 3), counter-clockwise, as rows.
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        integer_rows(py, self.threads, &aside(py, self.threads, || self.inner.row_triangles())?)
    }

    /// The twin of each half-edge (3t,), −1 on the hull.
    fn halfedges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let twins = aside(py, self.threads, || self.inner.twins())?;
        Ok(integers(py, twins.into_iter().map(|twin| twin.map_or(-1, i64::from))))
    }

    /// The hull (h,), counter-clockwise, as rows.
    fn hull<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let rows = self.inner.rows();
        integers(py, self.inner.hull().iter().map(|&v| rows[v as usize].into()))
    }

    /// The circumcenters (t, 2).
    fn circumcenters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        coordinates(py, aside(py, self.threads, || self.inner.circumcenters())?)
    }

    /// The circumradii (t,).
    fn circumradii<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(values(py, aside(py, self.threads, || self.inner.circumradii())?))
    }

    /// The edges (m, 2), i < j, sorted, as rows.
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        integer_rows(py, self.threads, &aside(py, self.threads, || core::edges::all(&self.inner))?)
    }

    /// The duplicates (d, 2): row, and the first row with the same coordinates.
    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        integer_rows(py, self.threads, self.inner.duplicates())
    }
}
