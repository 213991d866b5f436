//! The curve behind imperfect points: corners, ends, gaps, outliers and noise, where the crust has no theorem.
//!
//! The subgraph of the Delaunay triangulation with at most two edges a point that costs least, where a free end costs 1,
//! found by message passing. Two rounds: the second judges turns, steps and lone points by what the first found nearby.

mod approximation;
mod candidates;
mod constants;
mod costs;
mod decode;
mod gaps;
mod geometry;
mod guard;
mod hints;
mod messages;
mod prune;
mod rings;
mod roughness;
mod selection;

use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::progress::{Progress, Stage};
use candidates::Candidates;
use constants::HOPELESS;
pub use constants::{CONSTANTS, Constants};
use costs::{Costs, first_edge_costs};
use decode::decode;
use geometry::{Spacing, Turns};
use hints::Known;
pub use hints::{Hints, Longest};
use messages::Factors;
use roughness::Roughness;
use selection::Selection;

/// The edges of the curves that the points suggest, at most two a point, given what is known of them.
///
/// Rings of the crust that the theorem covers are among them as they are. The same for any order of the rows, any number of
/// threads, and after turns by 90°, reflections and exact translations. O(n log n).
///
/// # Errors
/// Too many points, or a cancelled `progress`.
pub fn connect(
    delaunay: &Delaunay,
    constants: &Constants,
    hints: &Hints,
    progress: &Progress,
) -> Result<Edges> {
    progress.enter(Stage::Select, delaunay.points().len())?;
    let known = Known::new(hints, delaunay);
    let mut candidates = Candidates::new(delaunay, &known.keep, progress)?;
    let mut spacing = Spacing::new(delaunay, &candidates, constants);
    progress.advance(0)?;
    let hope = hope(&candidates, &spacing, &known, constants);
    candidates.retain(&mut spacing.lengths, &hope);
    for &end in &known.ends {
        candidates.paired[end as usize] = 0;
    }
    let turns = Turns::new(delaunay, &candidates);
    let mut sent = vec![0.0; candidates.ends.len()];
    let mut round = |rough: &Roughness| {
        let mut costs = Costs::new(&candidates, &spacing, rough, constants);
        known.price(&candidates, &mut costs);
        let factors =
            Factors { candidates: &candidates, spacing: &spacing, turns: &turns, costs: &costs };
        factors.converge(&mut sent, progress)?;
        let selection = decode(&candidates, &factors.beliefs(&sent), |v| known.most(v));
        Ok((costs, selection))
    };
    let (_, first) = round(&Roughness::default())?;
    let rough = Roughness::new(&candidates, &spacing, &turns, &first, constants);
    let (costs, mut selection) = round(&rough)?;
    let factors =
        Factors { candidates: &candidates, spacing: &spacing, turns: &turns, costs: &costs };
    if !known.every_point {
        prune::prune(&factors, constants, &mut selection);
    }
    prune::drop_small(&factors, hints.fewest, &mut selection);
    let edges = edges(delaunay, &candidates, &selection);
    let may_take = |ring: &[u32]| known.admits(&spacing, ring);
    guard::guard(delaunay, edges, may_take, progress)
}

/// Which half-edges are worth a look, and allowed.
fn hope(
    candidates: &Candidates,
    spacing: &Spacing<'_>,
    known: &Known,
    constants: &Constants,
) -> Vec<bool> {
    let costs = first_edge_costs(candidates, spacing, constants);
    let most = if known.is_costly() { f32::INFINITY } else { HOPELESS };
    candidates.map(false, |v, own| {
        for ((own, e), &end) in own.iter_mut().zip(candidates.from(v)).zip(candidates.neighbors(v))
        {
            let allowed = costs[e] <= most && known.allows(spacing, v, end);
            *own = allowed || candidates.is_kept(e);
        }
    })
}

fn edges(delaunay: &Delaunay, candidates: &Candidates, selection: &Selection) -> Edges {
    let chosen = candidates.edges().filter(|&(_, e)| selection.chosen[e]);
    let edges = chosen.map(|(v, e)| rows(delaunay, v as u32, candidates.ends[e])).collect();
    sort(&[edges], delaunay.input_len())
}
