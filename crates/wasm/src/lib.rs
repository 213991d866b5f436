//! `crustline-core` for the browser: typed arrays in, typed arrays out.
//!
//! Points are x, y, x, y, …; edges i, j, i, j, …; indices are rows of the points. Errors are exceptions with the core's sentence.
//! Everything runs on the calling thread.

mod arrays;
mod certificate;
mod connection;
mod curves;
mod delaunay;
mod medial_axis;
mod methods;

pub use certificate::Certificate;
pub use connection::Connection;
pub use curves::Curves;
pub use delaunay::Delaunay;
pub use medial_axis::MedialAxis;
use wasm_bindgen::prelude::*;

/// The version of crustline.
#[wasm_bindgen]
#[must_use]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}
