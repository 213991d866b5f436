//! The rule of Robinson, Colchester, Griffin and Hawkes.
//!
//! G. P. Robinson, A. C. F. Colchester, L. D. Griffin, D. J. Hawkes, "Integrated skeleton and
//! boundary shape representation for medical image interpretation", ECCV (1992): an edge belongs to
//! the boundary if its dual Voronoi edge is longer.

use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, select};
use crate::error::Result;
use crate::exact::angle_pair::AnglePair;
use crate::progress::Progress;

/// The Delaunay edges that are no longer than their dual Voronoi edges. O(n log n).
///
/// Edges of the hull are kept: their dual edges have no end.
///
/// # Errors
/// A cancelled `progress`.
pub fn rcgh(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let length = AnglePair::dual_length();
    let keep = |edge: Edge| {
        let (Some(left), Some(right)) = (edge.left, edge.right) else {
            return true;
        };
        let [p, q, left, right] = [edge.p, edge.q, left, right].map(|v| delaunay.point(v));
        length.admits(p, q, left, right)
    };
    select(delaunay, progress, || (), |(), edge| keep(edge))
}
