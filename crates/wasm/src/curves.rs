//! Curves as typed arrays.

use crustline_core::trace;
use wasm_bindgen::prelude::*;

/// Rings and polylines: runs of rows, one after another. A ring does not repeat its first row and runs counter-clockwise.
#[wasm_bindgen(getter_with_clone, inspectable)]
pub struct Curves {
    /// The rows along each curve.
    #[wasm_bindgen(readonly)]
    pub indices: Vec<u32>,
    /// Curve k is `indices.slice(offsets[k], offsets[k + 1])`.
    #[wasm_bindgen(readonly)]
    pub offsets: Vec<u32>,
    /// 1 if curve k is a ring.
    #[wasm_bindgen(readonly)]
    pub closed: Vec<u8>,
    /// The rows without an edge.
    #[wasm_bindgen(readonly)]
    pub isolated: Vec<u32>,
    /// The number of the ring that curve k is a hole in, its own number if it is in none, −1 if it is no ring.
    #[wasm_bindgen(readonly)]
    pub shells: Vec<i32>,
}

impl Curves {
    pub(crate) fn new(curves: trace::Curves, shells: Vec<Option<u32>>) -> Self {
        Self {
            indices: curves.indices,
            offsets: curves.offsets.into_iter().map(|offset| offset as u32).collect(),
            closed: curves.closed.into_iter().map(u8::from).collect(),
            isolated: curves.isolated,
            shells: shells.into_iter().map(|shell| shell.map_or(-1, |k| k as i32)).collect(),
        }
    }
}
