//! What the costs are made of: lengths relative to the spacing, turns, and medians over rings of neighbors.
//!
//! Ratios of lengths only, so that the scale does not matter; differences of coordinates only, so that the place does not.

use super::candidates::{Candidates, GRAIN, angle, by_vertex, each};
use super::constants::SPACING_RINGS;
use crate::delaunay::Delaunay;
use crate::parts::split;
use crate::point::{Point, length, sub};

/// The measures of candidates.
#[derive(Debug, Default)]
pub struct Geometry {
    /// For each vertex: the distance to its nearest neighbor; infinite if it is the only one.
    pub nearest: Vec<f64>,
    /// For each half-edge: the logarithm of its length over the distance from its vertex to the nearest other.
    pub lengths: Vec<f32>,
    /// For each vertex: the logarithm of the spacing around it over the distance to its nearest neighbor.
    pub crowding: Vec<f32>,
    /// For each pair i < j of paired half-edges at a vertex, vertex after vertex: the square root of the turn from
    /// one to the other, in half turns; 0 is straight.
    pub turns: Vec<f32>,
    /// Where the pairs of each vertex start.
    pub starts: Vec<usize>,
}

impl Geometry {
    /// Measure the candidates. Linear.
    #[must_use]
    pub fn new(delaunay: &Delaunay, candidates: &Candidates) -> Self {
        let vertices = candidates.vertices();
        let vector = |v: usize, end: u32| sub(delaunay.point(end), delaunay.point(v as u32));
        let nearest = by_vertex(vertices, |v| {
            let lengths = candidates.neighbors(v).iter().map(|&end| length(vector(v, end)));
            lengths.fold(f64::INFINITY, f64::min)
        });
        let mut spacing = nearest.clone();
        for _ in 0..SPACING_RINGS {
            spacing = ring_median(candidates, &spacing);
        }
        let lengths = candidates.map(0.0, |v, own| {
            for (own, &end) in own.iter_mut().zip(candidates.neighbors(v)) {
                *own = libm::log(length(vector(v, end)) / nearest[v]) as f32;
            }
        });
        let crowding = by_vertex(vertices, |v| {
            if nearest[v].is_finite() { libm::log(spacing[v] / nearest[v]) as f32 } else { 0.0 }
        });
        let (starts, turns) = turns(candidates, vector);
        Self { nearest, lengths, crowding, turns, starts }
    }

    /// How far one of two paired half-edges at `v` turns from the other, as the square root of half turns.
    #[inline]
    #[must_use]
    pub fn turn(&self, candidates: &Candidates, v: usize, i: usize, j: usize) -> f32 {
        let (i, j, count) = (i.min(j), i.max(j), candidates.pairs(v));
        self.turns[self.starts[v] + i * (2 * count - i - 1) / 2 + j - i - 1]
    }
}

fn turns(
    candidates: &Candidates,
    vector: impl Fn(usize, u32) -> Point + Sync,
) -> (Vec<usize>, Vec<f32>) {
    let vertices = candidates.vertices();
    let mut starts = vec![0; vertices + 1];
    for v in 0..vertices {
        let count = candidates.pairs(v);
        starts[v + 1] = starts[v] + count * count.saturating_sub(1) / 2;
    }
    let mut turns = vec![0.0; starts[vertices]];
    let grain = |k: usize| starts[((k + 1) * GRAIN).min(vertices)] - starts[k * GRAIN];
    let parts = split(&mut turns, (0..vertices.div_ceil(GRAIN)).map(grain));
    each(parts, |(k, part)| {
        let mut next = part.iter_mut();
        for v in k * GRAIN..((k + 1) * GRAIN).min(vertices) {
            let ends = &candidates.neighbors(v)[..candidates.pairs(v)];
            for (i, &a) in ends.iter().enumerate() {
                let u = vector(v, a);
                for (&b, turn) in ends[i + 1..].iter().zip(&mut next) {
                    *turn = root_turn(u, vector(v, b));
                }
            }
        }
    });
    (starts, turns)
}

/// The square root of the turn of a path that comes against `u` and leaves along `w`, in half turns.
fn root_turn(u: Point, w: Point) -> f32 {
    let opposite = [-w[0], -w[1]];
    (angle(u, opposite) / std::f64::consts::PI).sqrt() as f32
}

/// For each vertex the median of the values at it and its neighbors; values that are not numbers do not count.
#[must_use]
pub fn ring_median<T: Value>(candidates: &Candidates, values: &[T]) -> Vec<T> {
    let mut medians = values.to_vec();
    each(medians.chunks_mut(GRAIN), |(k, part)| {
        let mut ring = Vec::new();
        for (i, own) in part.iter_mut().enumerate() {
            ring.clear();
            let neighbors = candidates.neighbors(k * GRAIN + i);
            ring.extend(neighbors.iter().map(|&end| values[end as usize]).chain([*own]));
            ring.retain(|value| !value.is_missing());
            *own = median(&mut ring).unwrap_or(*own);
        }
    });
    medians
}

/// A number of which medians are taken.
pub trait Value: Copy + PartialOrd + Send + Sync {
    /// Is there no number?
    fn is_missing(self) -> bool;
    /// The mean of two.
    fn middle(self, other: Self) -> Self;
}

impl Value for f32 {
    fn is_missing(self) -> bool {
        self.is_nan()
    }
    fn middle(self, other: Self) -> Self {
        Self::midpoint(self, other)
    }
}

impl Value for f64 {
    fn is_missing(self) -> bool {
        self.is_nan()
    }
    fn middle(self, other: Self) -> Self {
        Self::midpoint(self, other)
    }
}

/// The median, of an even number the mean of the two in the middle.
fn median<T: Value>(values: &mut [T]) -> Option<T> {
    let count = values.len();
    if count == 0 {
        return None;
    }
    let order = |a: &T, b: &T| a.partial_cmp(b).expect("missing values are out");
    let (low, &mut middle, _) = values.select_nth_unstable_by(count / 2, order);
    if count % 2 == 1 {
        return Some(middle);
    }
    let below = low.iter().copied().reduce(|a, b| if a > b { a } else { b });
    below.map(|below| below.middle(middle))
}
