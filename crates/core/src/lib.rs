//! Curve reconstruction from unordered points of the plane, exactly.
//!
//! The crust and the β-skeleton of N. Amenta, M. Bern and D. Eppstein, "The Crust and the β-Skeleton:
//! Combinatorial Curve Reconstruction", Graphical Models and Image Processing 60 (1998), and the graphs
//! that they are compared with, on a Delaunay triangulation of our own. No Python, no input or output,
//! no global state but the memory that a thread works in; parallel work runs on the current rayon pool and never changes an answer.

mod adjacency;
pub mod certificate;
pub mod certify;
mod cocircular;
pub mod connect;
mod delaunay;
pub mod edges;
mod error;
mod exact;
mod forbidden_region;
mod forest;
pub mod groups;
pub mod interpolant;
pub mod medial_axis;
pub mod memory;
pub mod methods;
pub mod nesting;
mod parts;
mod point;
mod progress;
pub mod ridge;
mod space;
pub mod tiles;
pub mod trace;
mod voronoi;
#[cfg(test)]
mod xorshift;

pub use adjacency::Adjacency;
pub use delaunay::Delaunay;
pub use error::{Error, Result};
// What the rest stands on, for those who measure it alone.
pub use exact::predicates;
pub use point::Point;
pub use progress::Progress;
pub use space::tree::Tree;
