//! The medial axis as typed arrays.

use crate::arrays::flat;
use crustline_core::medial_axis as core;
use wasm_bindgen::prelude::*;

/// The Voronoi edges whose dual is not selected.
#[wasm_bindgen(getter_with_clone, inspectable)]
pub struct MedialAxis {
    /// The Voronoi vertices: x, y, x, y, …
    #[wasm_bindgen(readonly)]
    pub vertices: Vec<f64>,
    /// The distance from each vertex to its nearest points.
    #[wasm_bindgen(readonly)]
    pub radii: Vec<f64>,
    /// Pairs of vertices, one after another.
    #[wasm_bindgen(readonly)]
    pub edges: Vec<u32>,
    /// The two rows that each edge separates.
    #[wasm_bindgen(readonly)]
    pub samples: Vec<u32>,
    /// 1 if the edge is inside an odd number of rings.
    #[wasm_bindgen(readonly)]
    pub inner: Vec<u8>,
    /// The vertex that each unbounded edge starts at.
    #[wasm_bindgen(readonly, js_name = rayOrigins)]
    pub ray_origins: Vec<u32>,
    /// Its unit direction: x, y, x, y, …
    #[wasm_bindgen(readonly, js_name = rayDirections)]
    pub ray_directions: Vec<f64>,
    /// The two rows that it separates.
    #[wasm_bindgen(readonly, js_name = raySamples)]
    pub ray_samples: Vec<u32>,
}

impl From<core::MedialAxis> for MedialAxis {
    fn from(axis: core::MedialAxis) -> Self {
        Self {
            vertices: flat(axis.vertices),
            radii: axis.radii,
            edges: axis.edges.iter().flat_map(|edge| edge.ends).collect(),
            samples: axis.edges.iter().flat_map(|edge| edge.samples).collect(),
            inner: axis.edges.iter().map(|edge| u8::from(edge.is_inner)).collect(),
            ray_origins: axis.ray_origins,
            ray_directions: flat(axis.ray_directions),
            ray_samples: flat(axis.ray_samples),
        }
    }
}
