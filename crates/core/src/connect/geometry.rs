//! What the costs are made of: lengths relative to the spacing, and turns.
//!
//! Ratios of lengths only, so that the scale does not matter; differences of coordinates only, so that the place does not.

use super::approximation::{half_turns, log};
use super::candidates::{Candidates, GRAIN, by_vertex, each};
use super::constants::{Constants, SPACING_RINGS};
use super::rings::ring_median;
use crate::delaunay::Delaunay;
use crate::parts::split;
use crate::point::{Point, length, sub};

/// The distances between candidates' ends.
#[derive(Debug, Default)]
pub struct Spacing<'a> {
    points: &'a [Point],
    /// For each vertex: the distance to its nearest neighbor; infinite if it is the only one.
    pub nearest: Vec<f64>,
    /// For each half-edge: the logarithm of its length over the distance from its vertex to the nearest other.
    pub lengths: Vec<f32>,
    /// For each vertex: the logarithm of the spacing around it over the distance to its nearest neighbor.
    pub crowding: Vec<f32>,
}

impl<'a> Spacing<'a> {
    /// Measure the candidates. Linear.
    #[must_use]
    pub fn new(delaunay: &'a Delaunay, candidates: &Candidates, constants: &Constants) -> Self {
        let vertices = candidates.vertices();
        let distance = |v: usize, end: u32| length(vector(delaunay, v, end));
        let nearest = by_vertex(vertices, |v| {
            let lengths = candidates.neighbors(v).iter().map(|&end| distance(v, end));
            lengths.fold(f64::INFINITY, f64::min)
        });
        let lengths = candidates.map(0.0, |v, own| {
            for (own, &end) in own.iter_mut().zip(candidates.neighbors(v)) {
                *own = log(distance(v, end) / nearest[v]) as f32;
            }
        });
        let reach = libm::log(constants.reach) as f32;
        let limits = by_vertex(vertices, |v| reach + second_least(&lengths[candidates.from(v)]));
        let mut spacing = nearest.clone();
        for _ in 0..SPACING_RINGS {
            spacing = ring_median(candidates, &spacing, |v, e| lengths[e] <= limits[v]);
        }
        let crowding = by_vertex(vertices, |v| {
            if nearest[v].is_finite() { log(spacing[v] / nearest[v]) as f32 } else { 0.0 }
        });
        Self { points: delaunay.points(), nearest, lengths, crowding }
    }

    /// The spacing around a vertex.
    #[must_use]
    pub fn around(&self, v: usize) -> f64 {
        self.nearest[v] * libm::exp(f64::from(self.crowding[v]))
    }

    /// The distance between two vertices.
    #[must_use]
    pub fn distance(&self, a: usize, b: usize) -> f64 {
        length(sub(self.points[b], self.points[a]))
    }
}

fn vector(delaunay: &Delaunay, v: usize, end: u32) -> Point {
    sub(delaunay.point(end), delaunay.point(v as u32))
}

fn second_least(values: &[f32]) -> f32 {
    let mut least = [f32::INFINITY; 2];
    for &value in values {
        if value < least[0] {
            least = [value, least[0]];
        } else {
            least[1] = least[1].min(value);
        }
    }
    least[1]
}

/// For each pair i < j of paired half-edges at a vertex, by j, then by i, vertex after vertex: how far one turns from the other.
#[derive(Debug, Default)]
pub struct Turns {
    /// The square roots of the turns in half turns; 0 is straight.
    roots: Vec<f32>,
    /// Where the pairs of each vertex start.
    starts: Vec<usize>,
}

impl Turns {
    /// Measure the pairs. Linear.
    #[must_use]
    pub fn new(delaunay: &Delaunay, candidates: &Candidates) -> Self {
        let vertices = candidates.vertices();
        let mut starts = vec![0; vertices + 1];
        for v in 0..vertices {
            let count = candidates.pairs(v);
            starts[v + 1] = starts[v] + count * count.saturating_sub(1) / 2;
        }
        let mut roots = vec![0.0; starts[vertices]];
        let grain = |k: usize| starts[((k + 1) * GRAIN).min(vertices)] - starts[k * GRAIN];
        let parts = split(&mut roots, (0..vertices.div_ceil(GRAIN)).map(grain));
        each(parts, |(k, part)| {
            let mut next = part.iter_mut();
            for v in k * GRAIN..((k + 1) * GRAIN).min(vertices) {
                let ends = &candidates.neighbors(v)[..candidates.pairs(v)];
                for (j, &b) in ends.iter().enumerate() {
                    let w = vector(delaunay, v, b);
                    // The ends first: an iterator zipped ahead of them would lose one of its own.
                    for (&a, root) in ends[..j].iter().zip(&mut next) {
                        *root = root_turn(vector(delaunay, v, a), w);
                    }
                }
            }
        });
        Self { roots, starts }
    }

    /// Those of all pairs at `v`.
    #[inline]
    #[must_use]
    pub fn at(&self, v: usize) -> &[f32] {
        &self.roots[self.starts[v]..self.starts[v + 1]]
    }

    /// That of the pair of half-edges number i and j at `v`.
    #[inline]
    #[must_use]
    pub fn of(&self, v: usize, [i, j]: [usize; 2]) -> f32 {
        let (i, j) = (i.min(j), i.max(j));
        self.at(v)[j * (j - 1) / 2 + i]
    }
}

/// The square root of the turn of a path that comes against `u` and leaves along `w`, in half turns.
fn root_turn(u: Point, w: Point) -> f32 {
    let opposite = [-w[0], -w[1]];
    half_turns(u, opposite).sqrt() as f32
}
