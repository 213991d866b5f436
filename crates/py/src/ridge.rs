//! The ridge of noisy points.

use crate::arrays::{coordinates, integers, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::ridge as core;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

type Floats<'py> = Bound<'py, PyArray1<f64>>;
type Ridge<'py> = (
    Bound<'py, PyArray1<i64>>,
    Floats<'py>,
    Floats<'py>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<f64>>,
);

/// For each vertex its row, the noise, and the first window; for each point of the ridge its vertex, and where it is.
#[pyfunction]
#[pyo3(signature = (delaunay, noise, threads=None, progress=None))]
pub fn ridge<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    noise: Option<PyReadonlyArray1<'py, f64>>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Ridge<'py>> {
    let triangulation = delaunay.core();
    let scale = triangulation.scale();
    let rows = triangulation.rows();
    let given = match &noise {
        Some(noise) => {
            let all = noise.as_slice()?;
            Some(rows.iter().map(|&row| all[row as usize] * scale).collect::<Vec<f64>>())
        }
        None => None,
    };
    let call = Call { size: triangulation.input_len(), threads, callback: progress };
    let found = call.run(py, |progress| core::ridge(triangulation, given.as_deref(), progress))?;
    let unscaled = |value: f64| value / scale;
    // All arrays together can take longer than Ctrl-C may wait.
    let first_rows = integers(py, rows.iter().map(|&row| row.into()));
    py.check_signals()?;
    let noise = values(py, found.scales.iter().map(|each| unscaled(each.noise)).collect());
    let first = values(py, found.scales.iter().map(|each| unscaled(each.first)).collect());
    py.check_signals()?;
    Ok((
        first_rows,
        noise,
        first,
        integers(py, found.crests.iter().map(|crest| crest.vertex.into())),
        coordinates(py, found.crests.iter().map(|crest| crest.at.map(unscaled)).collect())?,
    ))
}
