//! The second round's view: how much the curve found first turns and changes its step around each vertex, and how many
//! points as far from others as this one were left out.

use super::candidates::Candidates;
use super::constants::{Constants, ROUGHNESS_RINGS};
use super::gaps::Gaps;
use super::geometry::{Spacing, Turns};
use super::median::median;
use super::rings::ring_median;
use super::selection::Selection;
use rayon::prelude::*;

/// What the first round found around each vertex; empty before.
#[derive(Debug, Default)]
pub struct Roughness {
    /// The usual turn, in half turns.
    turns: Vec<f64>,
    /// The usual logarithm of the ratio of successive steps.
    steps: Vec<f64>,
    /// The share of the points as far out that are isolated.
    isolated: Vec<f32>,
    /// What gaps cost.
    pub gaps: Gaps,
    /// How much turn is believed anywhere.
    most_turn: f64,
}

impl Roughness {
    /// Around the curves of a selection.
    #[must_use]
    pub fn new(
        candidates: &Candidates,
        spacing: &Spacing<'_>,
        turns: &Turns,
        selection: &Selection,
        constants: &Constants,
    ) -> Self {
        let smooth = |value: &(dyn Fn([usize; 2]) -> f32 + Sync)| {
            let mut values = candidates.by_vertex(|v| {
                selection.pair(candidates, v).map_or(f64::NAN, |pair| f64::from(value(pair)))
            });
            for _ in 0..ROUGHNESS_RINGS {
                values = ring_median(candidates, &values, |_, _| true);
            }
            values
        };
        let turn = |pair: [usize; 2]| turns.of(pair).powi(2);
        let step = |pair: [usize; 2]| {
            let [a, b] = pair.map(|e| spacing.lengths[e]);
            (a - b).abs()
        };
        Self {
            most_turn: most_turn(candidates, selection, turn, constants),
            turns: smooth(&turn),
            steps: smooth(&step),
            isolated: isolated_share(spacing, selection, constants),
            gaps: Gaps::new(candidates, spacing, selection, constants),
        }
    }

    /// The usual turn around `v`, in half turns; 0 if nothing is known.
    #[must_use]
    pub fn turn(&self, v: usize) -> f64 {
        known(&self.turns, v)
    }

    /// How much turning weighs at `v`: less where the curve turns much anyway.
    #[must_use]
    pub fn turn_weight(&self, v: usize, constants: &Constants) -> f64 {
        let ratio = self.turn(v).min(self.most_turn) / constants.rough_turn;
        1.0 / (1.0 + ratio * ratio)
    }

    /// How much lengths weigh at `v`: nothing once steps are wilder than the limit, and in full below.
    #[must_use]
    pub fn step_weight(&self, v: usize, constants: &Constants) -> f64 {
        let ratio = known(&self.steps, v) / constants.rough_step;
        let cube = ratio * ratio * ratio;
        1.0 / (1.0 + cube * cube)
    }

    /// How much being alone weighs at `v`.
    #[must_use]
    pub fn alone_weight(&self, v: usize, constants: &Constants) -> f64 {
        let share = self.isolated.get(v).copied().unwrap_or_default();
        1.0 - constants.alone_share * f64::from(share)
    }
}

/// The most that a curve is believed to turn anywhere: some more than at most points of all.
///
/// Where the first round went astray, as in the tail of a profile, its turns are great, and would excuse themselves.
fn most_turn(
    candidates: &Candidates,
    selection: &Selection,
    turn: impl Fn([usize; 2]) -> f32,
    constants: &Constants,
) -> f64 {
    let mut turns: Vec<f64> = (0..candidates.vertices())
        .filter_map(|v| selection.pair(candidates, v).map(|pair| f64::from(turn(pair))))
        .collect();
    constants.rough_excess * median(&mut turns).unwrap_or_default() + constants.rough_least
}

fn known(values: &[f64], v: usize) -> f64 {
    values.get(v).copied().filter(|value| !value.is_nan()).unwrap_or_default()
}

/// For each vertex the share of isolated ones among those about as far from others, relative to the spacing around.
fn isolated_share(spacing: &Spacing<'_>, selection: &Selection, constants: &Constants) -> Vec<f32> {
    if !selection.degrees.contains(&0) {
        return Vec::new();
    }
    let all = spacing.crowding.iter().zip(0..).map(|(&crowding, v)| (-crowding, v));
    let mut all: Vec<(f32, u32)> = all.collect();
    all.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let is_isolated = |v: u32| selection.degrees[v as usize] == 0;
    let isolated: Vec<f32> = all.iter().filter(|own| is_isolated(own.1)).map(|own| own.0).collect();
    let alike = libm::log(constants.alone_alike) as f32;
    let mut shares = vec![0.0; all.len()];
    // Both are sorted: what is not as far out as one vertex is not as far out as the next.
    let (mut nearer, mut nearer_isolated) = (0, 0);
    for &(remote, v) in &all {
        let from = remote + alike;
        while all[nearer].0 < from {
            nearer += 1;
        }
        while isolated.get(nearer_isolated).is_some_and(|&own| own < from) {
            nearer_isolated += 1;
        }
        let beyond = [isolated.len() - nearer_isolated, all.len() - nearer];
        let [beyond_isolated, beyond] = beyond.map(|count| count as f32);
        shares[v as usize] = beyond_isolated / (beyond + 2.0);
    }
    shares
}
