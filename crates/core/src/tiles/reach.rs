//! How far the partners of a point can be, in each direction, given its Voronoi cell.
//!
//! The border of the cell of p is at the distance R(θ) in the direction θ; a neighbor g bounds it by |g| / 2 cos(θ − θ_g). So 1 / R is
//! the largest of (2g / |g|²) · e(θ) over the neighbors: a support function, which costs two products a neighbor and direction, no
//! Voronoi vertex and no rounding worth mention. It is taken at the ends of sectors; in between a cosine is above the smaller end.

use crate::delaunay::Delaunay;
use crate::point::{Point, cross, dot, length, sub};
use crate::space::bounds::{Bounds, larger, smaller};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

/// More than all relative roundings below.
const SLACK: f64 = 1e-9;

/// Where a method's partners can be, given the cell of a point.
#[derive(Debug, Clone, Copy)]
pub enum Partners {
    /// A piece of the dual Voronoi edge is seen under this angle. The ends of that piece are in the directions θ and θ + angle, no
    /// farther than R there. It lies on a line at half the partner's distance; the foot of its perpendicular points to the partner, at
    /// less than 90° from both.
    SeenUnder(f64),
    /// Two disks of radius β d / 2 are centered in the cell, at the angle arccos 1 / β on either side of the partner's direction.
    ByDisks(f64),
}

/// Bounds on the distance of partners, by sectors of direction.
#[derive(Debug)]
pub struct Reach {
    partners: Partners,
    /// The direction at which each sector starts, and the first again.
    starts: Vec<Point>,
    /// The sectors between which the direction lies that is turned by the angle of the partners.
    turned: [usize; 2],
    sin: f64,
    cos: f64,
}

impl Reach {
    /// By `count` sectors.
    pub(super) fn new(partners: Partners, count: usize) -> Self {
        let width = TAU / count as f64;
        let direction = |k: usize| [(k as f64 * width).cos(), (k as f64 * width).sin()];
        let starts = (0..=count).map(|k| direction(k % count)).collect();
        let angle = match partners {
            Partners::SeenUnder(angle) => angle,
            Partners::ByDisks(beta) => (1.0 / beta).acos(),
        };
        let turn = rounded(angle / width);
        let turned = [turn.floor() as usize, turn.ceil() as usize];
        Self { partners, starts, turned, sin: angle.sin(), cos: angle.cos() }
    }

    /// The number of sectors.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// For each sector a lower bound on 1 / R of the cell of `p`: 0 where the cell may be unbounded.
    #[inline]
    pub(super) fn support(&self, delaunay: &Delaunay, p: u32, support: &mut [f64]) {
        support.fill(0.0);
        let site = delaunay.point(p);
        for &neighbor in delaunay.star(p).neighbors {
            let [x, y] = inverse(sub(delaunay.point(neighbor), site));
            let mut before = x;
            for (least, end) in support.iter_mut().zip(&self.starts[1..]) {
                let here = x * end[0] + y * end[1];
                *least = larger(*least, smaller(before, here));
                before = here;
            }
        }
    }

    /// The smaller support of the two sectors between which sector `s` lies when it is turned.
    fn turned(&self, support: &[f64], s: usize, backward: bool) -> f64 {
        let count = self.len();
        let at = |turn: usize| support[if backward { s + count - turn } else { s + turn } % count];
        at(self.turned[0]).min(at(self.turned[1]))
    }

    /// The bound that sector `s` gives: on partners there for disks, else on those up to 90° around the piece that starts there.
    #[inline]
    fn bound(&self, support: &[f64], s: usize) -> f64 {
        match self.partners {
            Partners::SeenUnder(_) => {
                2.0 * self.farthest_line(support[s], self.turned(support, s, false))
            }
            Partners::ByDisks(beta) => {
                let [left, right] = [false, true].map(|side| self.turned(support, s, side));
                2.0 * (1.0 + SLACK) / (beta * left.max(right))
            }
        }
    }

    /// The bound for each sector.
    pub(super) fn bounds(&self, support: &[f64], bounds: &mut [f64]) {
        bounds.fill(0.0);
        let (count, width) = (self.len(), TAU / self.len() as f64);
        // Counted from a full turn ahead.
        let (first, end) = match self.partners {
            Partners::SeenUnder(angle) => {
                let first = rounded((TAU + angle - FRAC_PI_2) / width).floor();
                (first as usize, rounded((TAU + FRAC_PI_2) / width + 1.0).ceil() as usize)
            }
            Partners::ByDisks(_) => (count, count + 1),
        };
        for s in 0..count {
            let bound = self.bound(support, s);
            for k in first..end {
                let sector = &mut bounds[(s + k) % count];
                *sector = larger(*sector, bound);
            }
        }
    }

    /// May a point in `bounds`, seen from p, be no farther than the bound of its sector?
    pub(super) fn may_hold(&self, reach: &[f64], bounds: &Bounds) -> bool {
        let distance = bounds.square_to([0.0; 2]).sqrt() * (1.0 - SLACK);
        let corners = bounds.corners();
        let size = SLACK * corners.iter().map(|c| c[0].abs() + c[1].abs()).fold(0.0, f64::max);
        let left_of = |start: Point| corners.iter().any(|&corner| cross(start, corner) >= -size);
        let right_of = |end: Point| corners.iter().any(|&corner| cross(corner, end) >= -size);
        let within = |k: usize| left_of(self.starts[k]) && right_of(self.starts[k + 1]);
        (0..self.len()).any(|k| reach[k] >= distance && within(k))
    }

    /// The greatest distance of a line through a point at most 1 / `a` away and one at most 1 / `b` away, with the angle between.
    ///
    /// Up to 90° the farthest line may be perpendicular to the shorter of the two.
    #[inline]
    fn farthest_line(&self, a: f64, b: f64) -> f64 {
        let (small, large) = (a.min(b), a.max(b));
        if large * self.cos > small {
            return (1.0 + SLACK) / large;
        }
        let square = dot([a, b], [a, b]) - 2.0 * a * b * self.cos;
        (1.0 + SLACK) * self.sin / square.max(0.0).sqrt()
    }
}

/// Are all partners of `p` nearer than `distance`, as a first look tells that is enough far from what is unseen?
///
/// For pieces seen under 90°: 1 / R² in a direction and in the one turned by 90° sum to at least 4 / d². With eight sectors all
/// products with directions are sums of two coordinates. False if in doubt, and for other partners.
#[inline]
pub(super) fn are_near(partners: Partners, delaunay: &Delaunay, p: u32, distance: f64) -> bool {
    if !matches!(partners, Partners::SeenUnder(FRAC_PI_2)) {
        return false;
    }
    let (site, mut support) = (delaunay.point(p), [0.0f64; 8]);
    for &neighbor in delaunay.star(p).neighbors {
        let [x, y] = inverse(sub(delaunay.point(neighbor), site));
        let (up, down) = (FRAC_1_SQRT_2 * (y + x), FRAC_1_SQRT_2 * (y - x));
        let ends = [x, up, y, down, -x, -up, -y, -down, x];
        for k in 0..8 {
            support[k] = larger(support[k], smaller(ends[k], ends[k + 1]));
        }
    }
    let square = |k: usize| support[k % 8] * support[k % 8];
    let least = (0..8).map(|k| square(k) + square(k + 2)).fold(f64::INFINITY, f64::min);
    least * distance * distance > 4.0
}

/// 2 g / |g|², rounded down in length: its product with a direction is at most 1 / R there.
#[inline]
fn inverse(g: Point) -> Point {
    const TWICE: f64 = 2.0 * (1.0 - SLACK);
    let square = dot(g, g);
    if square.is_normal() {
        return g.map(|x| x * (TWICE / square));
    }
    let far = length(g);
    g.map(|x| x / far * (TWICE / far))
}

/// A number that is whole but for rounding, made whole.
fn rounded(x: f64) -> f64 {
    if (x - x.round()).abs() < SLACK { x.round() } else { x }
}
