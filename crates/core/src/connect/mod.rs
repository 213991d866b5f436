//! The curve behind imperfect points: corners, ends, gaps, outliers and noise, where the crust has no theorem.
//!
//! The subgraph of the Delaunay triangulation with at most two edges a point that costs least, where a free end costs 1,
//! found by message passing. Two rounds: the second judges turns, steps and lone points by what the first found nearby.

mod candidates;
mod constants;
mod costs;
mod decode;
mod gaps;
mod geometry;
mod guard;
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
use messages::Factors;
use roughness::Roughness;
use selection::Selection;

/// The edges of the curves that the points suggest, at most two a point.
///
/// Rings of the crust that the theorem covers are among them as they are. The same for any order of the rows, any number of
/// threads, and after turns by 90°, reflections and exact translations. O(n log n).
///
/// # Errors
/// Too many points, or a cancelled `progress`.
pub fn connect(delaunay: &Delaunay, constants: &Constants, progress: &Progress) -> Result<Edges> {
    progress.enter(Stage::Select, delaunay.points().len())?;
    let mut candidates = Candidates::new(delaunay, progress)?;
    let mut spacing = Spacing::new(delaunay, &candidates, constants);
    progress.advance(0)?;
    let hope: Vec<bool> = first_edge_costs(&candidates, &spacing, constants)
        .into_iter()
        .map(|cost| cost <= HOPELESS)
        .collect();
    candidates.retain(&mut spacing.lengths, &hope);
    let turns = Turns::new(delaunay, &candidates);
    let mut sent = vec![0.0; candidates.ends.len()];
    let mut round = |rough: &Roughness| {
        let costs = Costs::new(&candidates, &spacing, rough, constants);
        let factors =
            Factors { candidates: &candidates, spacing: &spacing, turns: &turns, costs: &costs };
        factors.converge(&mut sent, progress)?;
        let selection = decode(&candidates, &factors.beliefs(&sent));
        Ok((costs, selection))
    };
    let (_, first) = round(&Roughness::default())?;
    let rough = Roughness::new(&candidates, &spacing, &turns, &first, constants);
    let (costs, mut selection) = round(&rough)?;
    let factors =
        Factors { candidates: &candidates, spacing: &spacing, turns: &turns, costs: &costs };
    prune::prune(&factors, constants, &mut selection);
    guard::guard(delaunay, edges(delaunay, &candidates, &selection), progress)
}

fn edges(delaunay: &Delaunay, candidates: &Candidates, selection: &Selection) -> Edges {
    let chosen = candidates.edges().filter(|&(_, e)| selection.chosen[e]);
    let edges = chosen.map(|(v, e)| rows(delaunay, v as u32, candidates.ends[e])).collect();
    sort(&[edges], delaunay.input_len())
}
