//! The NN-crust.
//!
//! T. K. Dey and P. Kumar, "A Simple Provable Algorithm for Curve Reconstruction", Symposium on
//! Discrete Algorithms (1999).

use super::neighborhood::{Neighborhood, collect};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::exact::sign;
use crate::progress::Progress;
use std::cmp::Ordering::Greater;

/// The edges from each point to its nearest, and the shortest at 90° or more to each of those.
///
/// The second are sought in the closed Delaunay graph; equally short ones are all in. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn nn_crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let neighborhood = Neighborhood::new(delaunay, progress)?;
    let is_behind = |p: u32, q: u32, s: u32| {
        let [p, q, s] = [p, q, s].map(|vertex| delaunay.point(vertex));
        sign::sign(&sign::Dot, p, &[q, s]) != Greater
    };
    collect(delaunay, progress, |p| neighborhood.asked_for(p, is_behind))
}
