//! An NN-crust that asks for a larger angle between the two edges of a point.
//!
//! After H. B. Bjerkevik, "Tighter Bounds for Reconstruction from ε-samples", Symposium on
//! Computational Geometry (2022).

use super::neighborhood::{Neighborhood, mutual};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::{Error, Result};
use crate::exact::angle_bound::AngleBound;
use crate::progress::Progress;
use std::cmp::Ordering::Greater;

/// The edges whose ends ask for each other: each point for its nearest q, and for the nearest that it
/// sees from q under at least the angle of `cotangent`.
///
/// The second are sought in the closed Delaunay graph; equally near ones are all in. O(n log n).
///
/// # Errors
/// A `cotangent` that is not finite, or a cancelled `progress`.
pub fn compatible_crust(delaunay: &Delaunay, cotangent: f64, progress: &Progress) -> Result<Edges> {
    if !cotangent.is_finite() {
        let message = format!("the cotangent of the angle must be finite, not {cotangent}");
        return Err(Error::Argument { message });
    }
    let (neighborhood, least) =
        (Neighborhood::new(delaunay, progress)?, AngleBound::of_cotangent(cotangent));
    let is_compatible = |p: u32, q: u32, s: u32| {
        let [p, q, s] = [p, q, s].map(|vertex| delaunay.point(vertex));
        s != q && least.compare(q, s, p) != Greater
    };
    mutual(delaunay, progress, |p| neighborhood.asked_for(p, is_compatible))
}
