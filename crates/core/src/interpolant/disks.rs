//! The largest empty disk that touches the curve at a sample, on each side: its center is on the medial axis.
//!
//! A disk that touches at s with its center at s + ρ·n passes through x if 1/ρ = 2 n·(x − s)/|x − s|², so the largest empty
//! one has as its curvature the maximum of that over the curve; as x → s the fraction tends to the curve's own curvature.
//! A disk around a point of the Voronoi cell of s is empty, so only the neighbors of s in the triangulation count.

use super::bend::Bend;
use crate::delaunay::Delaunay;
use crate::point::{Point, dot, sub};

/// How far from a sample, as a part of the way to the next, its own circle of curvature is trusted.
const TRUST: f64 = 0.75;

/// A disk through a sample shrinks no more than this when it gives way to the curve beside the sample.
const DENT: f64 = 1.25;
/// Rounds of making a disk smaller.
const SHRINKS: usize = 8;
/// A disk is empty if its curvature is too small by no more than this part.
const EMPTY: f64 = 1e-6;

/// A disk that touches the curve at a sample.
#[derive(Debug, Clone, Copy)]
pub struct Disk {
    /// The center, in the scale of the triangulation.
    pub center: Point,
    /// The radius.
    pub radius: f64,
}

/// The largest empty disks of a vertex.
#[derive(Debug, Clone, Copy, Default)]
pub struct Disks {
    /// To the left and to the right of the curve.
    pub sides: [Option<Disk>; 2],
    /// The disk at the vertex of the curve, in the sense of differential geometry, with its side: an end of the axis.
    pub tip: Option<(usize, Disk)>,
}

/// The largest empty disks at vertex `v`.
///
/// `others` is memory to work in.
pub fn disks(
    delaunay: &Delaunay,
    bends: &[Option<Bend>],
    v: u32,
    others: &mut Vec<Other>,
) -> Disks {
    let Some(bend) = &bends[v as usize] else { return Disks::default() };
    let near = Near::new(delaunay, bends, v, bend);
    let mut disks = Disks::default();
    let far = far_curvatures(delaunay, bends, v, &near, others);
    for (side, (sign, far)) in [1.0, -1.0].into_iter().zip(far).enumerate() {
        let mut curvature = near.curvature(sign).max(far);
        if near.is_sparse {
            curvature = shrunk(delaunay, bends, v, &near, sign, curvature);
        }
        disks.sides[side] = disk(delaunay.point(v), bend.normal(), sign * curvature, curvature);
        if let Some(tip) = tip(delaunay.point(v), bend, sign, far) {
            disks.tip = Some((side, tip));
        }
    }
    disks
}

/// `curvature`, increased until the disk that touches at `v` is empty but for the stretch around `v`.
///
/// Only where samples were passed over: rounding has cut their cells at random, so not all that matters is a neighbor of `v`.
/// J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using nearest neighbors and the normal field", The Visual
/// Computer 28 (2012).
fn shrunk(
    delaunay: &Delaunay,
    bends: &[Option<Bend>],
    v: u32,
    near: &Near<'_>,
    sign: f64,
    mut curvature: f64,
) -> f64 {
    let s = delaunay.point(v);
    let normal = near.bend.normal().map(|x| sign * x);
    let mut start = v;
    for _ in 0..SHRINKS {
        let center = [0, 1].map(|k| s[k] + normal[k] / curvature);
        start = nearest(delaunay, start, center);
        let d = sub(delaunay.point(start), s);
        let through = 2.0 * dot(normal, d) / dot(d, d);
        if start == v || near.passes_over(bends, start, d) || through <= curvature * (1.0 + EMPTY) {
            break;
        }
        curvature = through;
    }
    curvature
}

/// The sample nearest to `place`, by steps to a nearer neighbor.
fn nearest(delaunay: &Delaunay, start: u32, place: Point) -> u32 {
    let square = |vertex: u32| {
        let d = sub(delaunay.point(vertex), place);
        dot(d, d)
    };
    let (mut best, mut least) = (start, square(start));
    loop {
        let mut next = best;
        for &neighbor in delaunay.star(best).neighbors {
            let square = square(neighbor);
            if square < least {
                (next, least) = (neighbor, square);
            }
        }
        if next == best {
            return best;
        }
        best = next;
    }
}

/// The disk that touches at `point`, if it is bounded; `signed` is its curvature, positive along the normal.
fn disk(point: Point, normal: Point, signed: f64, curvature: f64) -> Option<Disk> {
    let center = [0, 1].map(|k| point[k] + normal[k] / signed);
    let bounded = curvature > 0.0 && center.iter().all(|x| x.is_finite());
    bounded.then_some(Disk { center, radius: 1.0 / curvature })
}

/// The osculating disk where the curvature is largest: there the axis ends.
fn tip(point: Point, bend: &Bend, sign: f64, far: f64) -> Option<Disk> {
    let s = bend.vertex().filter(|_| sign * bend.second < 0.0)?;
    let curvature = (sign * bend.curvature_at(s)).min(bend.most);
    if curvature <= far {
        return None;
    }
    let place = bend.place(s);
    let normal = super::bend::turned(bend.normal(), bend.turn(s));
    disk([point[0] + place[0], point[1] + place[1]], normal, sign * curvature, curvature)
}

/// The stretch of curve around a sample that its own quadratic describes: five samples.
struct Near<'a> {
    bend: &'a Bend,
    samples: [Option<u32>; 4],
    ends: [f64; 2],
    /// Were samples in between passed over?
    is_sparse: bool,
}

impl<'a> Near<'a> {
    fn new(delaunay: &Delaunay, bends: &[Option<Bend>], v: u32, bend: &'a Bend) -> Self {
        let mut samples = [bend.adjacent[0], bend.adjacent[1], None, None];
        let mut ends = bend.reach;
        for k in 0..2 {
            let Some(next) = samples[k].and_then(|next| bends[next as usize].as_ref()) else {
                continue;
            };
            let beyond = usize::from(next.adjacent[1] != Some(v));
            samples[2 + k] = next.adjacent[beyond];
            ends[k] += next.reach[beyond];
        }
        let is_near = |q: u32| {
            dot(sub(delaunay.point(q), delaunay.point(v)), bend.tangent).abs()
                < ends[0].min(ends[1])
        };
        let star = delaunay.star(v).neighbors;
        let is_sparse = star.iter().any(|&q| is_near(q) && bends[q as usize].is_none());
        Self { bend, samples, ends: [-ends[0], ends[1]], is_sparse }
    }

    /// Is the sample `q`, at `d`, one of those within the stretch that the interpolant leaves out?
    fn passes_over(&self, bends: &[Option<Bend>], q: u32, d: Point) -> bool {
        let reach = self.ends[1].max(-self.ends[0]);
        dot(d, d) <= reach * reach && bends[q as usize].is_none()
    }

    /// The largest curvature of a disk that touches at the sample and meets the stretch, on the side of `sign`.
    fn curvature(&self, sign: f64) -> f64 {
        let Bend { curvature, slope, second, .. } = *self.bend;
        // 2 n·(x − s)/|x − s|² at arc length t, up to terms of third order.
        let touching = |t: f64| sign * (curvature + t * (slope / 3.0 + t * second / 6.0));
        let inner = if second == 0.0 { 0.0 } else { -slope / second };
        let inner = inner.clamp(self.ends[0], self.ends[1]);
        [0.0, inner, self.ends[0], self.ends[1]]
            .map(touching)
            .into_iter()
            .fold(0.0, f64::max)
            .min(self.bend.most)
    }
}

/// A neighbor of a sample that is not adjacent to it.
#[derive(Debug)]
pub struct Other {
    vertex: u32,
    /// From the sample.
    d: Point,
    /// To the left or to the right of the curve.
    side: usize,
    /// The curvature of the disk that touches at the sample and passes through it.
    through: f64,
}

/// On each side the largest curvature of a disk that touches at `v` and meets another part of the curve.
fn far_curvatures(
    delaunay: &Delaunay,
    bends: &[Option<Bend>],
    v: u32,
    near: &Near<'_>,
    others: &mut Vec<Other>,
) -> [f64; 2] {
    let (s, normal) = (delaunay.point(v), near.bend.normal());
    let mut largest: [f64; 2] = [0.0; 2];
    others.clear();
    for &vertex in delaunay.star(v).neighbors {
        if near.samples[..2].contains(&Some(vertex)) {
            continue;
        }
        let d = sub(delaunay.point(vertex), s);
        let height = dot(normal, d);
        let (side, through) = (usize::from(height < 0.0), 2.0 * height.abs() / dot(d, d));
        if through > 0.0 && !near.passes_over(bends, vertex, d) {
            largest[side] = largest[side].max(through);
            others.push(Other { vertex, d, side, through });
        }
    }
    for &Other { vertex, d, side, through } in &*others {
        // Most neighbors are far beyond reach of the disk.
        if DENT * through <= largest[side] || near.samples.contains(&Some(vertex)) {
            continue;
        }
        let Some(other) = &bends[vertex as usize] else { continue };
        let normal = if side == 0 { normal } else { normal.map(|x| -x) };
        if let Some(curvature) = touching_both(normal, d, through, other, largest[side]) {
            largest[side] = curvature;
        }
    }
    largest
}

/// The curvature of the disk that touches at the origin and touches the circle of curvature at `d` from outside the curve.
///
/// `through` is that of the disk through d itself; `None` if the second contact is not near d, or not above `least`.
fn touching_both(normal: Point, d: Point, through: f64, other: &Bend, least: f64) -> Option<f64> {
    let radius = 1.0 / through;
    let from = [radius * normal[0] - d[0], radius * normal[1] - d[1]];
    let side = dot(other.normal(), from).signum();
    let (facing, bend) = (other.normal().map(|x| side * x), side * other.curvature);
    // |ρ n − o| = |1/κ − ρ| with o = d + facing/κ, solved for ρ.
    let numerator = 1.0 - dot(normal, facing) - bend * dot(normal, d);
    let denominator = -dot(d, facing) - bend * dot(d, d) / 2.0;
    let within = least * denominator < numerator && numerator <= DENT * through * denominator;
    if !(within && denominator > 0.0) {
        return None;
    }
    let curvature = numerator / denominator;
    let radius = 1.0 / curvature;
    let from = [radius * normal[0] - d[0], radius * normal[1] - d[1]];
    // Where the second contact is along the circle of curvature, times the distance to its center over its radius. Beyond
    // the center the contact is on the far side; for samples on one circle, where ρ is 0/0, this alone tells.
    let (offset, scale) = (dot(other.tangent, from), 1.0 - bend * dot(facing, from));
    let within =
        -TRUST * other.reach[0] * scale <= offset && offset <= TRUST * other.reach[1] * scale;
    (scale > 0.0 && within).then_some(curvature)
}
