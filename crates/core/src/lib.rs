//! Curve reconstruction from unordered points of the plane, exactly.
//!
//! The crust and the β-skeleton of N. Amenta, M. Bern and D. Eppstein, "The Crust and the β-Skeleton:
//! Combinatorial Curve Reconstruction", Graphical Models and Image Processing 60 (1998), and the graphs
//! that they are compared with, on a Delaunay triangulation of our own. No Python, no input or output,
//! no global state; parallel work runs on the current rayon pool and never changes an answer.

pub mod adjacency;
pub mod certify;
pub mod cocircular;
pub mod connect;
pub mod delaunay;
pub mod edges;
pub mod error;
pub mod exact;
pub mod forbidden_region;
pub mod interpolant;
pub mod medial_axis;
pub mod methods;
pub mod parts;
pub mod point;
pub mod progress;
pub mod space;
pub mod trace;

pub use delaunay::Delaunay;
pub use error::{Error, Result};
pub use point::Point;
pub use progress::Progress;
