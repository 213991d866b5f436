//! The curve behind imperfect points: corners, ends, gaps, outliers and noise, where the crust has no theorem.
//!
//! The subgraph of the Delaunay triangulation with at most two edges a point that costs least, where a free end costs 1,
//! found by message passing. Two rounds: the second judges turns, steps and lone points by what the first found nearby.

mod candidates;
mod constants;
mod costs;
mod decode;
mod geometry;
mod guard;
mod messages;
mod prune;
mod roughness;
mod selection;

use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::progress::{Progress, Stage};
use candidates::Candidates;
pub use constants::{CONSTANTS, Constants};
use costs::Costs;
use decode::decode;
use geometry::Geometry;
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
    let candidates = Candidates::new(delaunay, progress)?;
    let geometry = Geometry::new(delaunay, &candidates);
    progress.advance(0)?;
    let mut sent = vec![0.0; candidates.ends.len()];
    let first =
        round(&candidates, &geometry, &Roughness::default(), constants, &mut sent, progress)?;
    let rough = Roughness::new(&candidates, &geometry, &first.1, constants);
    let (costs, mut selection) =
        round(&candidates, &geometry, &rough, constants, &mut sent, progress)?;
    let factors = Factors { candidates: &candidates, geometry: &geometry, costs: &costs };
    prune::prune(&factors, &geometry.nearest, constants, &mut selection);
    let edges = edges(delaunay, &candidates, &selection);
    guard::guard(delaunay, edges, progress)
}

/// One round of messages.
fn round(
    candidates: &Candidates,
    geometry: &Geometry,
    rough: &Roughness,
    constants: &Constants,
    sent: &mut Vec<f32>,
    progress: &Progress,
) -> Result<(Costs, Selection)> {
    let costs = Costs::new(candidates, geometry, rough, constants);
    let factors = Factors { candidates, geometry, costs: &costs };
    factors.converge(sent, progress)?;
    let selection = decode(candidates, &factors.beliefs(sent));
    Ok((costs, selection))
}

fn edges(delaunay: &Delaunay, candidates: &Candidates, selection: &Selection) -> Edges {
    let chosen = candidates.edges().filter(|&(_, e)| selection.chosen[e]);
    let edges = chosen.map(|(v, e)| rows(delaunay, v as u32, candidates.ends[e])).collect();
    sort(&[edges], delaunay.input_len())
}
