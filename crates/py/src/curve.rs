//! Edges of a triangulation as a Python object, with the neighbors along them: made once, read by many.

use crate::arrays::{all_pairs, rows};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crate::edges::canonical;
use crustline_core::Adjacency;
use crustline_core::edges::Edges;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use std::sync::Arc;

/// Edges, and the neighbors of each vertex along them.
#[pyclass(frozen, module = "crustline._core")]
pub struct Curve {
    pub edges: Edges,
    pub adjacency: Arc<Adjacency>,
}

#[pymethods]
impl Curve {
    #[new]
    #[pyo3(signature = (delaunay, edges, threads=None, progress=None))]
    fn new(
        py: Python<'_>,
        delaunay: &Delaunay,
        edges: PyReadonlyArray2<'_, i64>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let size = delaunay.core().input_len();
        let edges = canonical(py, threads, rows(py, &edges)?, size)?;
        let call = Call { size, threads, callback: progress };
        let adjacency = call.run(py, |_| Adjacency::new(delaunay.core(), &edges))?;
        Ok(Self { edges, adjacency: Arc::new(adjacency) })
    }

    /// Was this made of `edges`, which are canonical?
    fn is_of(&self, py: Python<'_>, edges: PyReadonlyArray2<'_, i64>) -> PyResult<bool> {
        let edges = rows(py, &edges)?;
        let same = |own: &[u32; 2], edge: &[i64; 2]| {
            i64::from(own[0]) == edge[0] && i64::from(own[1]) == edge[1]
        };
        Ok(edges.len() == self.edges.len() && all_pairs(&self.edges, edges, same))
    }
}
