//! Along a curve points grow in number like the radius, over an area like its square: the dimension tells clouds from curves.

use super::candidates::Candidates;
use super::found::Found;
use super::rings::ring_median;
use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::parts::split;
use crate::point::{length, sub};
use std::collections::HashSet;

/// Points that one task takes at a time.
const GRAIN: usize = 1 << 12;
/// The inner and outer radius, in steps of the curve.
const RADII: [f64; 2] = [3.0, 6.0];
/// Points beyond which a disk is not looked through: far more than a lattice has.
const MOST: usize = 1 << 10;

/// The steps of the curves found.
pub struct Steps {
    /// The usual step around each vertex; not a number where no curve is near.
    pub around: Vec<f64>,
}

impl Steps {
    /// Those of curves.
    #[must_use]
    pub fn new(found: &Found<'_>, curves: &Adjacency) -> Self {
        let mut around = found.candidates.by_vertex(|v| {
            let ends = curves.of(v as u32);
            let sum: f64 =
                ends.iter().map(|&(end, _)| found.spacing.distance(v, end as usize)).sum();
            sum / ends.len() as f64
        });
        for _ in 0..2 {
            around = ring_median(&found.candidates, &around, |_, _| true);
        }
        Self { around }
    }
}

/// For each vertex by how much the dimension of the points around it exceeds 1: 0 on a curve, 1 in a cloud.
#[must_use]
pub fn excess_dimension(delaunay: &Delaunay, candidates: &Candidates, steps: &Steps) -> Vec<f64> {
    let vertices = candidates.vertices();
    let mut raw = vec![0.0; vertices];
    let grains = (0..vertices).step_by(GRAIN).map(|first| GRAIN.min(vertices - first));
    candidates.each(split(&mut raw, grains), |(k, part)| {
        let mut seen = HashSet::new();
        for (i, own) in part.iter_mut().enumerate() {
            let v = k * GRAIN + i;
            let [few, many] = counts(delaunay, v as u32, steps.around[v], &mut seen);
            *own = (libm::log2(many as f64 / few as f64) - 1.0).max(0.0);
        }
    });
    let mut smooth = raw;
    for _ in 0..2 {
        smooth = ring_median(candidates, &smooth, |_, _| true);
    }
    candidates.by_vertex(|v| smooth[v])
}

/// How many points the disks around `v` hold, itself included; an unknown step tells nothing.
///
/// From a point in a disk around `v` some Delaunay edge leads nearer to `v`, so a walk within the disk meets all.
fn counts(delaunay: &Delaunay, v: u32, step: f64, seen: &mut HashSet<u32>) -> [usize; 2] {
    let [inner, outer] = RADII.map(|radius| radius * step);
    let center = delaunay.point(v);
    seen.clear();
    seen.insert(v);
    let mut found = vec![v];
    let (mut next, mut few) = (0, 1);
    while let Some(&at) = found.get(next) {
        next += 1;
        for &end in delaunay.star(at).neighbors {
            let distance = length(sub(delaunay.point(end), center));
            if distance <= outer && found.len() < MOST && seen.insert(end) {
                found.push(end);
                few += usize::from(distance <= inner);
            }
        }
    }
    [few, found.len()]
}
