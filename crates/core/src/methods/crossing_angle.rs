//! The γ-graphs of fixed crossing angle.
//!
//! N. Amenta, M. Bern, D. Eppstein (1998), section 3, believe that such a family reconstructs
//! curves as the crust does: two disks that touch p and q, of any radii, whose circles cross at a
//! fixed angle.

use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, select};
use crate::error::{Error, Result};
use crate::exact::angle_bound::AngleBound;
use crate::exact::angle_pair::AnglePair;
use crate::progress::Progress;
use std::cmp::Ordering::Greater;

/// The edges touched by two disks without points inside whose circles cross at least at the angle
/// of `cotangent`.
///
/// The tangents of a circle through p and q turn with its center, so the two circles cross at the
/// angle under which p sees their centers: 180° less the angles opposite to the edge, for the two
/// that reach furthest. O(n log n).
///
/// # Errors
/// A `cotangent` that is not finite, or a cancelled `progress`.
pub fn crossing_angle_graph(
    delaunay: &Delaunay,
    cotangent: f64,
    progress: &Progress,
) -> Result<Edges> {
    let crossing = Crossing::new(cotangent)?;
    select(delaunay, progress, || (), |(), edge| crossing.holds(delaunay, edge))
}

/// The angle at which the circles have to cross.
#[derive(Debug)]
pub(crate) struct Crossing {
    sum: AnglePair,
    supplement: AngleBound,
}

impl Crossing {
    /// The angle of `cotangent`, if that is finite.
    pub(crate) fn new(cotangent: f64) -> Result<Self> {
        if !cotangent.is_finite() {
            let message = format!("the cotangent of the angle must be finite, not {cotangent}");
            return Err(Error::Argument { message });
        }
        let supplement = AngleBound::of_cotangent(-cotangent);
        Ok(Self { sum: AnglePair::sum(cotangent), supplement })
    }

    /// Do the circles of two empty disks that touch both ends of `edge` cross at this angle or more?
    pub(crate) fn holds(&self, delaunay: &Delaunay, edge: Edge) -> bool {
        let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
        match [edge.left, edge.right].map(|apex| apex.map(|vertex| delaunay.point(vertex))) {
            [Some(left), Some(right)] => self.sum.admits(p, q, left, right),
            // Outside of the hull the disks come near to a half-plane but are none: equality is not
            // reached.
            [Some(apex), None] | [None, Some(apex)] => {
                self.supplement.compare(p, q, apex) == Greater
            }
            [None, None] => true,
        }
    }
}
