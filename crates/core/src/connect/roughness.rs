//! The second round's view: how much the curve found first turns and changes its step around each vertex, and how many
//! points as far from others as this one were left out.

use super::candidates::{Candidates, by_vertex};
use super::constants::{Constants, ROUGHNESS_RINGS};
use super::geometry::{Geometry, ring_median};
use super::selection::Selection;

/// What the first round found around each vertex; empty before.
#[derive(Debug, Default)]
pub struct Roughness {
    /// The usual turn, in half turns.
    turns: Vec<f32>,
    /// The usual logarithm of the ratio of successive steps.
    steps: Vec<f32>,
    /// The share of the points as far out that are isolated.
    isolated: Vec<f32>,
}

impl Roughness {
    /// Around the curves of a selection.
    #[must_use]
    pub fn new(
        candidates: &Candidates,
        geometry: &Geometry,
        selection: &Selection,
        constants: &Constants,
    ) -> Self {
        let vertices = candidates.vertices();
        let smooth = |value: &(dyn Fn(usize, [usize; 2]) -> f32 + Sync)| {
            let mut values = by_vertex(vertices, |v| {
                selection.pair(candidates, v).map_or(f32::NAN, |pair| value(v, pair))
            });
            for _ in 0..ROUGHNESS_RINGS {
                values = ring_median(candidates, &values);
            }
            values
        };
        let turns = smooth(&|v, [i, j]| {
            let root = geometry.turn(candidates, v, i, j);
            root * root
        });
        let steps = smooth(&|v, [i, j]| {
            let first = candidates.from(v).start;
            (geometry.lengths[first + i] - geometry.lengths[first + j]).abs()
        });
        let isolated = isolated_share(geometry, selection, constants);
        Self { turns, steps, isolated }
    }

    /// The usual turn around `v`, in half turns; 0 if nothing is known.
    #[must_use]
    pub fn turn(&self, v: usize) -> f64 {
        known(&self.turns, v)
    }

    /// How much turning weighs at `v`.
    #[must_use]
    pub fn turn_weight(&self, v: usize, constants: &Constants) -> f64 {
        weight(self.turn(v), constants.rough_turn, constants.rough_turn_power)
    }

    /// How much lengths weigh at `v`.
    #[must_use]
    pub fn step_weight(&self, v: usize, constants: &Constants) -> f64 {
        weight(known(&self.steps, v), constants.rough_step, constants.rough_step_power)
    }

    /// How much being alone weighs at `v`.
    #[must_use]
    pub fn alone_weight(&self, v: usize, constants: &Constants) -> f64 {
        1.0 - constants.alone_share * known(&self.isolated, v)
    }
}

fn known(values: &[f32], v: usize) -> f64 {
    values.get(v).map_or(0.0, |&value| if value.is_nan() { 0.0 } else { f64::from(value) })
}

fn weight(value: f64, half: f64, power: f64) -> f64 {
    1.0 / (1.0 + libm::pow(value / half, power))
}

/// For each vertex the share of isolated ones among those about as far from others, relative to the spacing around.
fn isolated_share(geometry: &Geometry, selection: &Selection, constants: &Constants) -> Vec<f32> {
    let vertices = geometry.crowding.len();
    let remote = |v: usize| -geometry.crowding[v];
    let mut isolated: Vec<f32> =
        (0..vertices).filter(|&v| selection.degrees[v] == 0).map(remote).collect();
    if isolated.is_empty() {
        return vec![0.0; vertices];
    }
    let mut all: Vec<f32> = (0..vertices).map(remote).collect();
    isolated.sort_unstable_by(f32::total_cmp);
    all.sort_unstable_by(f32::total_cmp);
    let alike = libm::log(constants.alone_alike) as f32;
    by_vertex(vertices, |v| {
        let from = remote(v) + alike;
        let beyond = |sorted: &[f32]| (sorted.len() - sorted.partition_point(|&x| x < from)) as f32;
        beyond(&isolated) / (beyond(&all) + 2.0)
    })
}
