//! The graphs on points: each takes a triangulation and gives edges, exactly by its definition.

mod crust;
mod one_step_crust;

pub use crust::crust;
pub use one_step_crust::one_step_crust;
