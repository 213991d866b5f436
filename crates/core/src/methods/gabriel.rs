//! The Gabriel graph.
//!
//! K. R. Gabriel and R. R. Sokal, "A New Statistical Approach to Geographic Variation Analysis",
//! Systematic Zoology 18 (1969).

use super::beta_skeleton::{Kind, beta_skeleton};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::progress::Progress;

/// The edges with no point inside the disk that has them as a diameter: the β-skeleton of β = 1.
///
/// O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn gabriel(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    beta_skeleton(delaunay, 1.0, Kind::Circle, progress)
}
