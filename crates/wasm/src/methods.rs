//! The methods by name, with the parameters that users give.

use crate::arrays::{points, run};
use crustline_core::connect::{CONSTANTS, Hints, connect};
use crustline_core::edges::Edges;
use crustline_core::{Delaunay, Progress, Result, methods};
use wasm_bindgen::prelude::*;

/// The edges of the method called `name`, its parameters in the order of the library's functions; angles are in radians.
pub fn select(
    delaunay: &Delaunay,
    name: &str,
    given: &[f64],
    progress: &Progress,
) -> Result<Edges> {
    match (name, given) {
        ("connect", []) => connect(delaunay, &CONSTANTS, &Hints::default(), progress),
        // The core decides by a cotangent or a sine, which it takes as exact.
        ("compatible-crust", &[angle]) => {
            methods::select(delaunay, name, &[1.0 / libm::tan(angle)], progress)
        }
        ("crossing-angle-graph", &[angle]) => {
            let cotangent = libm::tan(std::f64::consts::FRAC_PI_2 - angle);
            methods::select(delaunay, name, &[cotangent], progress)
        }
        ("gathan", &[angle, ratio]) => {
            methods::select(delaunay, name, &[libm::sin(angle), ratio], progress)
        }
        _ => methods::select(delaunay, name, given, progress),
    }
}

/// The edges of the Delaunay triangulation of points and `extra` points that join two of the former.
///
/// # Errors
/// Coordinates that are not finite, or that span too many orders of magnitude.
#[wasm_bindgen(js_name = aShape)]
pub fn a_shape(coordinates: &[f64], extra: &[f64]) -> std::result::Result<Vec<u32>, JsError> {
    let mut all = points(coordinates)?;
    let own = all.len();
    all.extend(points(extra)?);
    let delaunay = run(|progress| Delaunay::new(&all, progress))?;
    Ok(run(|progress| methods::a_shape(&delaunay, own, progress))?.into_flattened())
}
