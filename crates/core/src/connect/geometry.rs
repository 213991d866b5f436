//! What the costs are made of: lengths relative to the spacing, and turns.
//!
//! Ratios of lengths only, so that the scale does not matter; differences of coordinates only, so that the place does not.

use super::approximation::{HALF_TURN, direction, log};
use super::candidates::Candidates;
use super::constants::{Constants, SPACING_RINGS};
use super::rings::ring_median;
use crate::delaunay::Delaunay;
use crate::point::{Point, length, sub};
use wide::{f32x4, i32x4};

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
    /// That of the spacing over the least distance that sets the scale.
    pub close: f32,
}

impl<'a> Spacing<'a> {
    /// Measure the candidates. Linear.
    #[must_use]
    pub fn new(delaunay: &'a Delaunay, candidates: &Candidates, constants: &Constants) -> Self {
        let distance = |v: usize, end: u32| length(vector(delaunay, v, end));
        let nearest = candidates.by_vertex(|v| {
            let lengths = candidates.neighbors(v).iter().map(|&end| distance(v, end));
            lengths.fold(f64::INFINITY, f64::min)
        });
        let lengths = candidates.map(0.0, |v, own| {
            for (own, &end) in own.iter_mut().zip(candidates.neighbors(v)) {
                *own = log(distance(v, end) / nearest[v]) as f32;
            }
        });
        let reach = libm::log(constants.reach) as f32;
        let limits = candidates.by_vertex(|v| reach + second_least(&lengths[candidates.from(v)]));
        let mut spacing = nearest.clone();
        for _ in 0..SPACING_RINGS {
            spacing = ring_median(candidates, &spacing, |v, e| lengths[e] <= limits[v]);
        }
        let crowding = candidates.by_vertex(|v| {
            if nearest[v].is_finite() { log(spacing[v] / nearest[v]) as f32 } else { 0.0 }
        });
        let close = -libm::log(constants.close) as f32;
        Self { points: delaunay.points(), nearest, lengths, crowding, close }
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

/// How far one half-edge turns from another.
#[derive(Debug, Default)]
pub struct Turns {
    /// Where each half-edge leads, in 2⁻³² turns.
    pub directions: Vec<u32>,
}

impl Turns {
    /// Measure the candidates. Linear.
    #[must_use]
    pub fn new(delaunay: &Delaunay, candidates: &Candidates) -> Self {
        let directions = candidates.map(0, |v, own| {
            for (own, &end) in own.iter_mut().zip(candidates.neighbors(v)) {
                *own = direction(vector(delaunay, v, end));
            }
        });
        Self { directions }
    }

    /// That of a path along two half-edges of one vertex: the square root of the turn in half turns; 0 is straight.
    #[inline]
    #[must_use]
    pub fn of(&self, edges: [usize; 2]) -> f32 {
        let [a, b] = edges.map(|e| self.directions[e]);
        root_turn(a, b ^ HALF_TURN)
    }
}

/// A unit of directions, in half turns.
const UNIT: f32 = 1.0 / HALF_TURN as f32;

/// The square root of the turn from the opposite of one direction to another, in half turns.
#[inline]
#[must_use]
pub fn root_turn(direction: u32, opposite: u32) -> f32 {
    let turn = direction.wrapping_sub(opposite) as i32;
    ((turn as f32).abs() * UNIT).sqrt()
}

/// That of four directions, from the opposite of one.
#[inline]
#[must_use]
pub fn root_turns(directions: i32x4, direction: i32x4) -> f32x4 {
    let turns = directions - (direction ^ i32x4::splat(i32::MIN));
    (f32x4::from_i32x4(turns).abs() * f32x4::splat(UNIT)).sqrt()
}
