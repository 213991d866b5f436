//! How sure `connect` is, as typed arrays.

use crate::arrays::{flat, run};
use crustline_core::Delaunay;
use crustline_core::connect::{self as core, CONSTANTS, Hints};
use wasm_bindgen::prelude::*;

/// The edges of `connect`, how sure they are, and what of the crust they leave out.
#[wasm_bindgen(getter_with_clone, inspectable)]
pub struct Connection {
    /// The edges.
    #[wasm_bindgen(readonly)]
    pub edges: Vec<u32>,
    /// How likely each is right.
    #[wasm_bindgen(readonly)]
    pub confidence: Vec<f64>,
    /// How likely the whole is right.
    #[wasm_bindgen(readonly)]
    pub whole: f64,
    /// The edges of the crust that are left out.
    #[wasm_bindgen(readonly, js_name = leftOut)]
    pub left_out: Vec<u32>,
    /// Why, in a word each.
    #[wasm_bindgen(readonly, js_name = leftOutReasons)]
    pub left_out_reasons: Vec<String>,
    /// The edges that the crust has not.
    #[wasm_bindgen(readonly)]
    pub added: Vec<u32>,
    /// Why, in a word each.
    #[wasm_bindgen(readonly, js_name = addedReasons)]
    pub added_reasons: Vec<String>,
}

impl Connection {
    pub(crate) fn new(delaunay: &Delaunay) -> Result<Self, JsError> {
        let hints = Hints::default();
        let found = run(|progress| core::connection(delaunay, &CONSTANTS, &hints, progress))?;
        let (left_out, left_out_reasons) =
            found.left_out.into_iter().map(|(edge, why)| (edge, why.word().to_owned())).unzip();
        let (added, added_reasons) =
            found.added.into_iter().map(|(edge, why)| (edge, why.word().to_owned())).unzip();
        Ok(Self {
            edges: flat(found.edges),
            confidence: found.confidence,
            whole: found.whole,
            left_out: flat::<2, u32>(left_out),
            left_out_reasons,
            added: flat::<2, u32>(added),
            added_reasons,
        })
    }
}
