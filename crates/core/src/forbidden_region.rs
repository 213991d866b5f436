//! The forbidden region of two points that each side of them bounds by an angle.
//!
//! For β ≥ 1 it is the union of two disks, for β < 1 the intersection, for γ a mixture; in each
//! case a point on one side is forbidden if it sees the two under more than the angle of that side.
//! N. Amenta, M. Bern, D. Eppstein (1998), Observation 16.

use crate::exact::angle_bound::{AngleBound, OppositeDot};
use crate::exact::predicates::orientation;
use crate::exact::sign;
use crate::point::{Point, cross, sub};
use crate::space::bounds::Bounds;
use std::cmp::Ordering::{Equal, Greater, Less};

/// The angles that bound the region on either side of p → q. The segment itself is always in the
/// region.
#[derive(Debug, Clone, Copy)]
pub struct ForbiddenRegion<'a> {
    /// The bound to the left.
    pub left: &'a AngleBound,
    /// The bound to the right.
    pub right: &'a AngleBound,
}

impl ForbiddenRegion<'_> {
    /// Does the region of `p` and `q` hold `r`?
    #[inline]
    #[must_use]
    pub fn holds(&self, p: Point, q: Point, r: Point) -> bool {
        match orientation(p, q, r) {
            Greater => !self.left.admits(p, q, r),
            Less => !self.right.admits(p, q, r),
            Equal => sign::sign(&OppositeDot, p, &[q, r]) == Less,
        }
    }

    /// Does `r` lie in the region of `p` and any point in `bounds`?
    ///
    /// The points whose region with `p` holds `r` are a wedge at r, beyond it as seen from p. Where
    /// the bounds sum to more than 180° the wedge is convex, so four corners stand for a box.
    #[must_use]
    pub fn blocks(&self, p: Point, r: Point, bounds: &Bounds) -> bool {
        bounds.corners().iter().all(|&corner| self.holds(p, corner, r))
    }

    /// May a box meet the region of `p` and `q`? False only if they are certainly apart.
    pub fn may_meet(&self, p: Point, q: Point) -> impl Fn(&Bounds) -> bool + use<> {
        let chord = sub(q, p);
        let bounds = [self.left.cotangent(), -self.right.cotangent()];
        let [(a, r), (b, s)] = bounds.map(|cotangent| disk(chord, cotangent));
        move |bounds| {
            let bounds = bounds.seen_from(p);
            let [left, right] = sides(chord, &bounds);
            (left && bounds.may_meet_disk(a, r)) || (right && bounds.may_meet_disk(b, s))
        }
    }
}

/// The disk through the ends of `chord` whose circle sees it, from the left, under the angle of
/// `cotangent`.
fn disk([dx, dy]: Point, cotangent: f64) -> (Point, f64) {
    let center = [dx - cotangent * dy, dy + cotangent * dx].map(|x| x / 2.0);
    (center, center[0].hypot(center[1]))
}

/// May the box reach to the left and to the right of the line along `chord`?
fn sides(chord: Point, bounds: &Bounds) -> [bool; 2] {
    let corners = bounds.corners();
    let reach = corners.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let slack = 1e-12 * (chord[0].abs() + chord[1].abs()) * reach;
    let heights = corners.map(|corner| cross(chord, corner));
    [heights.iter().any(|&h| h >= -slack), heights.iter().any(|&h| h <= slack)]
}
