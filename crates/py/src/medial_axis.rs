//! The medial axis of samples: a triangulation and edges in, arrays out.

use crate::arrays::{coordinates, integer_rows, integer_rows_of, integers, values};
use crate::call::Call;
use crate::curve::Curve;
use crate::delaunay::Delaunay;
use crate::threads::aside;
use crustline_core::medial_axis::{MedialAxis, medial_axis as axis};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

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
    let MedialAxis { vertices, radii, edges, ray_origins, ray_directions, ray_samples } =
        call.run(py, |progress| axis(core, &curve.adjacency, progress))?;
    let fields = PyDict::new(py);
    // All of them together can take longer than Ctrl-C may wait.
    let set = |name: &str, array: Bound<'py, PyAny>| {
        py.check_signals()?;
        fields.set_item(name, array)
    };
    set("vertices", coordinates(py, vertices)?.into_any())?;
    set("radii", values(py, radii).into_any())?;
    set("edges", integer_rows_of(py, threads, &edges, |edge| edge.ends)?.into_any())?;
    set("samples", integer_rows_of(py, threads, &edges, |edge| edge.samples)?.into_any())?;
    let inner = aside(py, threads, || edges.par_iter().map(|edge| edge.is_inner).collect())?;
    set("inner", values::<bool>(py, inner).into_any())?;
    set("ray_origins", integers(py, ray_origins.into_iter().map(i64::from)).into_any())?;
    set("ray_directions", coordinates(py, ray_directions)?.into_any())?;
    set("ray_samples", integer_rows(py, threads, &ray_samples)?.into_any())?;
    Ok(fields)
}
