//! The medial axis of samples: a triangulation and edges in, arrays out.

use crate::arrays::{coordinates, integer_rows, integers, values};
use crate::call::Call;
use crate::curve::Curve;
use crate::delaunay::Delaunay;
use crustline_core::medial_axis::{MedialAxis, medial_axis as axis};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The medial axis as a dictionary of arrays, by the names of the fields.
#[pyfunction]
#[pyo3(signature = (delaunay, curve, threads=None, progress=None))]
pub fn medial_axis<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    curve: &Curve,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let core = delaunay.core();
    let call = Call { size: core.input_len(), threads, callback: progress };
    let MedialAxis {
        vertices,
        radii,
        edges,
        samples,
        inner,
        ray_origins,
        ray_directions,
        ray_samples,
    } = call.run(py, |progress| axis(core, &curve.adjacency, progress))?;
    let fields = PyDict::new(py);
    fields.set_item("vertices", coordinates(py, vertices)?)?;
    fields.set_item("radii", values(py, radii))?;
    fields.set_item("edges", integer_rows(py, threads, &edges)?)?;
    fields.set_item("samples", integer_rows(py, threads, &samples)?)?;
    fields.set_item("inner", values(py, inner))?;
    fields.set_item("ray_origins", integers(py, ray_origins.into_iter().map(i64::from)))?;
    fields.set_item("ray_directions", coordinates(py, ray_directions)?)?;
    fields.set_item("ray_samples", integer_rows(py, threads, &ray_samples)?)?;
    Ok(fields)
}
