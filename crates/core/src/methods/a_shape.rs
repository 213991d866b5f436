//! The 𝒜-shape.
//!
//! M. Melkemi, "𝒜-shapes of a finite point set", Symposium on Computational Geometry (1997). With
//! the Voronoi vertices as extra points it is the crust.

use crate::cocircular::select_closed;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::progress::Progress;

/// The edges between the first `own` rows with a disk that touches both ends and holds no row
/// inside.
///
/// `delaunay` is a triangulation of the points and, after them, the extra points. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn a_shape(delaunay: &Delaunay, own: usize, progress: &Progress) -> Result<Edges> {
    let is_own = |vertex: u32| (delaunay.rows()[vertex as usize] as usize) < own;
    select_closed(delaunay, progress, |edge| is_own(edge.p) && is_own(edge.q))
}
