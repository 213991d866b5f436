//! What the messages found in two rounds; all later steps look at it.

use super::candidates::Candidates;
use super::constants::{Constants, HOPELESS, SWEEPS};
use super::costs::{Costs, first_edge_cost};
use super::decode::decode;
use super::gaps::Gaps;
use super::geometry::{Spacing, Turns};
use super::hints::{Hints, Known};
use super::messages::Factors;
use super::roughness::Roughness;
use super::selection::Selection;
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::progress::Progress;

/// What the messages found, and what it rests on.
pub struct Found<'a> {
    /// What the caller knows.
    pub known: Known,
    /// The edges that were weighed.
    pub candidates: Candidates,
    /// Their lengths.
    pub spacing: Spacing<'a>,
    /// The turns between them.
    pub turns: Turns,
    /// What the first round found nearby.
    pub rough: Roughness,
    /// The costs of the second round.
    pub costs: Costs,
    /// What is believed in each edge, by half-edge.
    pub beliefs: Vec<f32>,
    /// The edges chosen.
    pub selection: Selection,
}

impl Found<'_> {
    /// What messages run on.
    #[must_use]
    pub fn factors(&self) -> Factors<'_> {
        let Self { candidates, spacing, turns, costs, .. } = self;
        Factors { candidates, spacing, turns, costs }
    }
}

/// Run two rounds of messages.
///
/// # Errors
/// Too many points, or a cancelled `progress`.
pub fn converge<'a>(
    delaunay: &'a Delaunay,
    constants: &Constants,
    hints: &Hints,
    progress: &Progress,
) -> Result<Found<'a>> {
    let known = Known::new(hints, delaunay);
    let mut candidates = Candidates::new(delaunay, &known.keep, progress)?;
    let mut spacing = Spacing::new(delaunay, &candidates, constants);
    progress.advance(0)?;
    let hope = hope(&candidates, &spacing, &known, constants);
    progress.advance(0)?;
    candidates.retain(&mut spacing.lengths, &hope)?;
    progress.advance(0)?;
    for &end in &known.ends {
        candidates.paired[end as usize] = 0;
    }
    let turns = Turns::new(delaunay, &candidates);
    progress.advance(0)?;
    let mut sent = vec![0.0; candidates.ends.len()];
    let mut round = |sweeps: usize, rough: &Roughness| {
        let mut costs = Costs::new(&candidates, &spacing, rough, constants);
        known.price(&candidates, &mut costs);
        progress.advance(0)?;
        let factors =
            Factors { candidates: &candidates, spacing: &spacing, turns: &turns, costs: &costs };
        factors.converge(sweeps, &mut sent, progress)?;
        let beliefs = factors.beliefs(&sent);
        progress.advance(0)?;
        let selection = decode(&candidates, &beliefs, |v| known.most(v));
        progress.advance(0)?;
        Ok((costs, beliefs, selection))
    };
    let (_, _, first) = round(SWEEPS[0], &Roughness::default())?;
    let mut rough = Roughness::new(&candidates, &spacing, &turns, &first, constants);
    drop(first);
    progress.advance(0)?;
    if known.closed {
        // A gap is no end where there are none.
        rough.gaps = Gaps::default();
    }
    let (costs, beliefs, selection) = round(SWEEPS[1], &rough)?;
    Ok(Found { known, candidates, spacing, turns, rough, costs, beliefs, selection })
}

/// Which half-edges are worth a look, and allowed.
fn hope(
    candidates: &Candidates,
    spacing: &Spacing<'_>,
    known: &Known,
    constants: &Constants,
) -> Vec<bool> {
    let most = if known.is_costly() { f32::INFINITY } else { HOPELESS };
    candidates.map(false, |v, own| {
        for ((own, e), &end) in own.iter_mut().zip(candidates.from(v)).zip(candidates.neighbors(v))
        {
            let cost = first_edge_cost(candidates, spacing, v, e, constants);
            let allowed = cost <= most && known.allows(spacing, v, end);
            *own = allowed || candidates.is_kept(e);
        }
    })
}
