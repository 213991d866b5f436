//! The β-skeleton.
//!
//! D. G. Kirkpatrick and J. D. Radke, "A framework for computational morphology", Computational
//! Geometry (1985), and N. Amenta, M. Bern, D. Eppstein (1998), section 2, which reconstructs
//! curves with the union of two disks.

use super::gamma_graph::{gamma_of, has_angles};
use crate::adjacency::Adjacency;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, select};
use crate::error::{Error, Result};
use crate::exact::angle_bound::AngleBound;
use crate::exact::constant::{Constant, fraction};
use crate::exact::filter;
use crate::exact::sign::{self, Form, Number};
use crate::parts::{GRAIN, in_parts, short};
use crate::point::{Point, dot, sub};
use crate::progress::{Progress, Stage};
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;
use std::cmp::Ordering::{Equal, Greater};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Neighbors of either end of an edge that are looked at before the boxes; of very many, few.
const NEAR: usize = 32;

/// The family of forbidden regions for β > 1; for β ≤ 1 they are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The union of the two disks of radius β d / 2 that touch both points.
    Circle,
    /// The intersection of the two disks of radius β d / 2 that touch one point each and are
    /// centered on their line.
    Lune,
}

/// The edges whose forbidden region holds no point.
///
/// O(n log n) for β ≥ 1. For β < 1 the region is the intersection of the two disks of radius d / 2β
/// that touch both points, all pairs are candidates and up to all are edges: O(m log n) for m edges
/// as a rule.
///
/// # Errors
/// A `beta` that is not positive and finite, or a cancelled `progress`.
pub fn beta_skeleton(
    delaunay: &Delaunay,
    beta: f64,
    kind: Kind,
    progress: &Progress,
) -> Result<Edges> {
    if !(beta > 0.0 && beta.is_finite()) {
        let message = format!("beta must be a positive finite number, not {beta}");
        return Err(Error::Argument { message });
    }
    if kind == Kind::Lune && beta > 1.0 {
        return lunes(delaunay, beta, progress);
    }
    let bound = AngleBound::of_beta(beta);
    let sum = beta.partial_cmp(&1.0).unwrap_or(Equal);
    gamma_of(delaunay, [&bound; 2], sum, progress)
}

/// Are the edges of `curve` the β-skeleton of circles, for `beta` > 1?
///
/// At less than half the time that it takes to make that, or none where they are not.
///
/// # Errors
/// A `beta` of at most 1, or a cancelled `progress`.
pub fn is_beta_skeleton(
    delaunay: &Delaunay,
    beta: f64,
    curve: &Adjacency,
    progress: &Progress,
) -> Result<bool> {
    if !(beta > 1.0 && beta.is_finite()) {
        let message = format!("beta must be a finite number above 1, not {beta}");
        return Err(Error::Argument { message });
    }
    progress.enter(Stage::Select, delaunay.points().len())?;
    let bound = AngleBound::of_beta(beta);
    let differs = AtomicBool::new(false);
    let found = in_parts(delaunay.points().len(), GRAIN, progress, |vertices| {
        let mut found = 0;
        for few in short(vertices, progress).take_while(|_| !differs.load(Relaxed)) {
            for edge in few.flat_map(|p| delaunay.edges_from(p as u32)) {
                let is_chosen = curve.edge(edge.p, edge.q).is_some();
                if is_chosen != has_angles(delaunay, edge, &bound, &bound) {
                    differs.store(true, Relaxed);
                    break;
                }
                found += usize::from(is_chosen);
            }
        }
        found
    })?;
    // Others are not in the triangulation.
    Ok(!differs.into_inner() && found.iter().sum::<usize>() == curve.edges().len())
}

/// The edges with an empty lune, for `beta` > 1.
///
/// The lune holds the disk on p q as a diameter, its circle too but for p and q. So the edges are
/// in every Delaunay triangulation; but other points than the apexes may lie in the lune.
fn lunes(delaunay: &Delaunay, beta: f64, progress: &Progress) -> Result<Edges> {
    let (lune, boxes) = (Lune::new(beta), Boxes::new(delaunay.points(), |&p| Bounds::at(p)));
    select(delaunay, progress, || (), |(), edge| lune.is_empty(delaunay, &boxes, edge))
}

/// The intersection of two disks, each centered on the line p q and touching one of them.
struct Lune {
    beta: f64,
    disk: TouchingDisk,
}

impl Lune {
    fn new(beta: f64) -> Self {
        let [n, d] = fraction(beta);
        Self { beta, disk: TouchingDisk { n: Constant::new(&n), d: Constant::new(&d) } }
    }

    fn is_empty(&self, delaunay: &Delaunay, boxes: &Boxes, edge: Edge) -> bool {
        let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
        let holds = |r: u32| {
            let r = delaunay.point(r);
            self.disk_holds(p, q, r) && self.disk_holds(q, p, r)
        };
        let near = [edge.p, edge.q].map(|vertex| delaunay.star(vertex).neighbors);
        if near.into_iter().flat_map(|star| star.iter().take(NEAR)).any(|&r| holds(r)) {
            return false;
        }
        let [a, b] = [sub(q, p), sub(p, q)].map(|chord| chord.map(|x| x * self.beta / 2.0));
        let radius = a[0].hypot(a[1]);
        !boxes.any(
            &mut |bounds, _| {
                bounds.seen_from(p).may_meet_disk(a, radius)
                    && bounds.seen_from(q).may_meet_disk(b, radius)
            },
            &mut |r| holds(r),
        )
    }

    /// Is `r` in the disk that touches `p` and is centered β / 2 of the way to `q`?
    #[inline]
    fn disk_holds(&self, p: Point, q: Point, r: Point) -> bool {
        let (u, v) = (sub(r, p), sub(q, p));
        let size = (u[0].abs() + u[1].abs()) * (v[0].abs() + v[1].abs());
        let square = dot(u, u);
        let excess = self.beta * dot(u, v) - square;
        let sign = filter::sign(excess, 6, square + size, self.beta.max(1.0));
        sign.unwrap_or_else(|| sign::sign(&self.disk, p, &[q, r])) == Greater
    }
}

/// β q·r − r·r, times the denominator of β: positive inside the disk through the origin with center
/// β q / 2.
struct TouchingDisk {
    n: Constant,
    d: Constant,
}

impl Form<2> for TouchingDisk {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 2 + self.n.bits().max(self.d.bits())
    }
    fn value<T: Number>(&self, [q, r]: &[[T; 2]; 2]) -> T {
        let along = self.n.number::<T>().times(&sign::dot(q, r));
        along.minus(&self.d.number::<T>().times(&sign::dot(r, r)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        for beta in [1.0, 1.7, 1e-9, 12345.678] {
            assert_bounded(&Lune::new(beta).disk);
        }
    }

    #[test]
    fn a_point_in_a_touching_disk_is_told_where_that_changes() {
        for beta in [1.0, 1.7, 12345.678] {
            let lune = Lune::new(beta);
            at_brinks(&lune.disk, false, |p, [q, r], sign| {
                assert_eq!(lune.disk_holds(p, q, r), sign == Greater);
            });
        }
    }
}
