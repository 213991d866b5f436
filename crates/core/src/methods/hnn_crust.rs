//! The HNN-crust.
//!
//! S. Ohrhallinger, S. A. Mitchell and M. Wimmer, "Curve Reconstruction with Many Fewer Samples",
//! Computer Graphics Forum 35 (2016). The second neighbor, their half neighbor, is the nearest of
//! the half-plane that the bisector of the point and its nearest bounds.

use super::length::compare_distances;
use super::neighborhood::{Neighborhood, mutual};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::progress::Progress;

/// The edges whose ends ask for each other: each point for its nearest and for its half neighbor.
///
/// The half neighbor is sought in the closed Delaunay graph, among the points that are no farther
/// from the point than from its nearest; equally near ones are all in. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn hnn_crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let neighborhood = Neighborhood::new(delaunay, progress)?;
    let is_in_half = |p: u32, q: u32, s: u32| {
        let [p, q, s] = [p, q, s].map(|vertex| delaunay.point(vertex));
        s != q && compare_distances(s, p, q).is_le()
    };
    mutual(delaunay, progress, |p| neighborhood.asked_for(p, is_in_half))
}
