//! The relative neighborhood graph.
//!
//! G. T. Toussaint, "The relative neighbourhood graph of a finite planar set", Pattern Recognition
//! 12 (1980).

use super::beta_skeleton::{Kind, beta_skeleton};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::progress::Progress;

/// The edges with no point nearer to both ends than they are to each other: the lune β-skeleton of
/// β = 2.
///
/// O(n log n) on any data met in practice.
///
/// # Errors
/// A cancelled `progress`.
pub fn relative_neighborhood(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    beta_skeleton(delaunay, 2.0, Kind::Lune, progress)
}
