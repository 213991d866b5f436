//! How far the partners of a point can be, in each direction, given its Voronoi cell.
//!
//! The border of the cell of p is at the distance R(θ) in the direction θ; a neighbor g bounds it by |g| / 2 cos(θ − θ_g). So 1 / R is
//! the largest of (2g / |g|²) · e(θ) over the neighbors: a support function, which costs two products a neighbor and direction, no
//! Voronoi vertex and no rounding worth mention. It is taken at the ends of sectors; in between a cosine is above the smaller end.

use crate::delaunay::Delaunay;
use crate::point::{Point, cross, dot, length, sub};
use crate::space::bounds::Bounds;
use std::f64::consts::{FRAC_PI_2, TAU};

/// More than all relative roundings below.
const SLACK: f64 = 1e-9;

/// Directions that divide the full turn into equal sectors.
#[derive(Debug)]
pub struct Sectors {
    /// The direction at which each sector starts, and the first again.
    starts: Vec<Point>,
}

impl Sectors {
    /// `count` sectors.
    pub(super) fn new(count: usize) -> Self {
        let width = TAU / count as f64;
        let direction = |k: usize| [(k as f64 * width).cos(), (k as f64 * width).sin()];
        Self { starts: (0..=count).map(|k| direction(k % count)).collect() }
    }

    /// The number of sectors.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// For each sector a lower bound on 1 / R of the cell of `p`: 0 where the cell may be unbounded.
    pub(super) fn support(&self, delaunay: &Delaunay, p: u32, support: &mut [f64]) {
        support.fill(0.0);
        let site = delaunay.point(p);
        for &neighbor in delaunay.star(p).neighbors {
            let g = sub(delaunay.point(neighbor), site);
            let far = length(g);
            let [x, y] = g.map(|x| x / far * (2.0 * (1.0 - SLACK) / far));
            let mut before = x;
            for (least, end) in support.iter_mut().zip(&self.starts[1..]) {
                let here = x * end[0] + y * end[1];
                *least = least.max(before.min(here));
                before = here;
            }
        }
    }

    /// May a point in `bounds`, seen from p, be no farther than the bound of its sector?
    pub(super) fn may_reach(&self, reach: &[f64], bounds: &Bounds) -> bool {
        let distance = bounds.square_to([0.0; 2]).sqrt() * (1.0 - SLACK);
        let corners = bounds.corners();
        let size = SLACK * corners.iter().map(|c| c[0].abs() + c[1].abs()).fold(0.0, f64::max);
        let left_of = |start: Point| corners.iter().any(|&corner| cross(start, corner) >= -size);
        let right_of = |end: Point| corners.iter().any(|&corner| cross(corner, end) >= -size);
        let within = |k: usize| left_of(self.starts[k]) && right_of(self.starts[k + 1]);
        (0..self.len()).any(|k| reach[k] >= distance && within(k))
    }

    /// Bounds on partners whose dual Voronoi edge is seen under at least `angle`.
    ///
    /// The ends of a piece seen under exactly `angle` are in the directions θ and θ + `angle`, no farther than R there. The piece
    /// lies on a line at half the partner's distance; the foot of its perpendicular points to the partner, at less than 90° from both.
    pub(super) fn reach_by_angle(&self, support: &[f64], angle: f64, reach: &mut [f64]) {
        reach.fill(0.0);
        let (count, width) = (self.len(), TAU / self.len() as f64);
        let turn = angle / width;
        let (near, far) = (rounded(turn).floor() as usize, rounded(turn).ceil() as usize);
        let first = rounded((angle - FRAC_PI_2) / width).floor() as isize;
        let last = rounded(1.0 + FRAC_PI_2 / width).ceil() as isize;
        for s in 0..count {
            let other = support[(s + near) % count].min(support[(s + far) % count]);
            let bound = 2.0 * farthest_line(support[s], other, angle);
            for k in s as isize + first..s as isize + last {
                let sector = k.rem_euclid(count as isize) as usize;
                reach[sector] = reach[sector].max(bound);
            }
        }
    }

    /// Bounds on partners whose two disks of radius β d / 2 are centered in the cell: at the angle ω = arccos 1 / β on either side.
    pub(super) fn reach_by_disks(&self, support: &[f64], beta: f64, reach: &mut [f64]) {
        let (count, width) = (self.len(), TAU / self.len() as f64);
        let turn = (1.0 / beta).acos() / width;
        let (near, far) = (rounded(turn).floor() as usize, rounded(turn).ceil() as usize);
        for (s, reach) in reach.iter_mut().enumerate() {
            let left = support[(s + near) % count].min(support[(s + far) % count]);
            let right = support[(s + count - near) % count].min(support[(s + count - far) % count]);
            *reach = 2.0 * (1.0 + SLACK) / (beta * left.max(right));
        }
    }
}

/// A number that is whole but for rounding, made whole.
fn rounded(x: f64) -> f64 {
    if (x - x.round()).abs() < SLACK { x.round() } else { x }
}

/// The greatest distance of a line through a point at most 1 / `a` away and one at most 1 / `b` away, `angle` apart.
///
/// Up to 90° the farthest line may be perpendicular to the shorter of the two.
fn farthest_line(a: f64, b: f64, angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let (small, large) = (a.min(b), a.max(b));
    if large * cos > small {
        return (1.0 + SLACK) / large;
    }
    let square = dot([a, b], [a, b]) - 2.0 * a * b * cos;
    (1.0 + SLACK) * sin / square.max(0.0).sqrt()
}
