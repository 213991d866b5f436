//! The certificate as typed arrays.

use crate::arrays::run;
use crustline_core::Delaunay;
use crustline_core::certificate::{self as core, Reason, Theorem, Theorems};
use crustline_core::edges::Edges;
use crustline_core::interpolant::Interpolant;
use crustline_core::methods::crust;
use wasm_bindgen::prelude::*;

/// What is guaranteed of edges, where not, and why.
///
/// Reasons are 0 for none, 1 undersampled, 2 missing, 3 corner, 4 endpoint, 5 branch, 6 isolated, 7 unselected.
#[wasm_bindgen(getter_with_clone, inspectable)]
pub struct Certificate {
    /// "crust", "beta-skeleton" or "".
    #[wasm_bindgen(readonly)]
    pub theorem: String,
    /// The sampling ratio that it asks for.
    #[wasm_bindgen(readonly)]
    pub threshold: f64,
    /// Does it apply everywhere, as far as samples tell?
    #[wasm_bindgen(readonly)]
    pub guaranteed: bool,
    /// The sampling ratio of each edge.
    #[wasm_bindgen(readonly)]
    pub ratios: Vec<f64>,
    /// The reason of each edge.
    #[wasm_bindgen(readonly, js_name = edgeReasons)]
    pub edge_reasons: Vec<u8>,
    /// The reason of each row.
    #[wasm_bindgen(readonly, js_name = pointReasons)]
    pub point_reasons: Vec<u8>,
}

impl Certificate {
    pub(crate) fn new(
        delaunay: &Delaunay,
        edges: &Edges,
        smooth: &Interpolant,
        theorems: &[f64],
    ) -> Result<Self, JsError> {
        let &[beta, of_skeleton, of_crust, margin] = theorems else {
            let message =
                "theorems: pass beta, the ratios of its skeleton and the crust, and the margin";
            return Err(JsError::new(message));
        };
        let known = Theorems { beta, of_skeleton, of_crust, margin };
        let found = run(|progress| {
            core::certify(delaunay, edges, smooth, &known, || crust(delaunay, progress), progress)
        })?;
        let theorem = found.theorem.map_or("", Theorem::method);
        Ok(Self {
            theorem: theorem.to_owned(),
            threshold: found.threshold,
            guaranteed: found.guaranteed,
            ratios: found.ratios,
            edge_reasons: Reason::codes(found.edges),
            point_reasons: Reason::codes(found.points),
        })
    }
}
