//! Gaps: edges much longer than the steps of the curve around them, where these are much alike.

use super::approximation::log;
use super::candidates::Candidates;
use super::constants::{Constants, GAP_FEWEST, GAP_RARE, GAP_SPREAD, GAP_SURE, GAP_WINDOW};
use super::geometry::Spacing;
use super::selection::Selection;

/// The usual steps along the curve found first.
#[derive(Debug, Clone, Copy, Default)]
struct Usual {
    /// The logarithm of the longest usual step over the distance to the nearest neighbor; infinite where nothing is known.
    step: f32,
    /// How far that is to be trusted, from 0 to 1.
    trust: f32,
}

/// What gaps cost around each vertex; nothing before the first round.
#[derive(Debug, Default)]
pub struct Gaps {
    usual: Vec<Usual>,
}

impl Gaps {
    /// Gaps by the steps of a selection.
    #[must_use]
    pub fn new(
        candidates: &Candidates,
        spacing: &Spacing<'_>,
        selection: &Selection,
        constants: &Constants,
    ) -> Self {
        let usual = candidates.by_vertex(|v| {
            if !may_begin(candidates, spacing, selection, v, constants) {
                return Usual::none();
            }
            let steps = steps_around(candidates, spacing, selection, v);
            usual_steps(steps, constants).map_or(Usual::none(), |(step, trust)| Usual {
                step: log(step / spacing.nearest[v]) as f32,
                trust,
            })
        });
        Self { usual }
    }

    /// What the edge of half-edge `e` between two vertices pays if it is a gap as seen from both.
    #[must_use]
    pub fn cost(
        &self,
        candidates: &Candidates,
        spacing: &Spacing<'_>,
        [v, end]: [usize; 2],
        e: usize,
        constants: &Constants,
    ) -> f32 {
        if self.usual.is_empty() {
            return 0.0;
        }
        let seen = |v: usize, e: usize| {
            let Usual { step, trust } = self.usual[v];
            trust * (spacing.lengths[e] - step - constants.gap_free as f32).max(0.0)
        };
        constants.gap as f32 * seen(v, e).min(seen(end, candidates.twins[e] as usize))
    }
}

impl Usual {
    fn none() -> Self {
        Self { step: f32::INFINITY, trust: 0.0 }
    }
}

/// May a gap begin at `v`: is one of its two steps much longer than the other?
fn may_begin(
    candidates: &Candidates,
    spacing: &Spacing<'_>,
    selection: &Selection,
    v: usize,
    constants: &Constants,
) -> bool {
    selection.pair(candidates, v).is_some_and(|pair| {
        let [a, b] = pair.map(|e| spacing.lengths[e]);
        (a - b).abs() > constants.gap_free as f32
    })
}

/// The steps along the curve on both sides of `v`.
pub fn steps_around(
    candidates: &Candidates,
    spacing: &Spacing<'_>,
    selection: &Selection,
    v: usize,
) -> Vec<f64> {
    let mut steps = Vec::with_capacity(2 * GAP_WINDOW);
    for first in selection.from(candidates, v) {
        let (mut at, mut e) = (v, first);
        for _ in 0..GAP_WINDOW {
            let end = candidates.ends[e] as usize;
            steps.push(spacing.distance(at, end));
            at = end;
            let Some(next) = selection.next(candidates, e) else { break };
            if at == v {
                break;
            }
            e = next;
        }
    }
    steps
}

/// The longest of the usual steps, those from the median on up to where the next is much longer, and how far to trust it:
/// less where there are few, and where the usual ones differ much themselves, as in random samples.
fn usual_steps(mut steps: Vec<f64>, constants: &Constants) -> Option<(f64, f32)> {
    if steps.len() < GAP_FEWEST {
        return None;
    }
    steps.sort_unstable_by(f64::total_cmp);
    let from = &steps[(steps.len() - 1) / 2..];
    let jump = from.windows(2).find(|pair| pair[1] >= constants.gap_jump * pair[0]);
    let longest = jump.map_or(from[from.len() - 1], |pair| pair[0]);
    let rare = rare_step(&steps[..steps.partition_point(|&step| step <= longest)]);
    let longest = longest.max(rare * libm::exp(-constants.gap_free));
    let spread = log(longest / steps[steps.len() / 4]) as f32 / GAP_SPREAD;
    let enough = (steps.len() as f32 / GAP_SURE).min(1.0);
    Some((longest, enough / (1.0 + spread * spread * spread * spread)))
}

/// The step that random samples as uneven as the sorted `usual` ones have seldom.
///
/// Where samples are left out at random, steps are distributed geometrically: the exponential beyond the least has about
/// their standard deviation.
pub fn rare_step(usual: &[f64]) -> f64 {
    let count = usual.len() as f64;
    let mean = usual.iter().sum::<f64>() / count;
    let variance = usual.iter().map(|step| (step - mean).powi(2)).sum::<f64>() / count;
    usual[0] + variance.sqrt() * (libm::log(count) + GAP_RARE)
}
