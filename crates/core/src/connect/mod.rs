//! The curve behind imperfect points: corners, ends, gaps, outliers and noise, where the crust has no theorem.
//!
//! The subgraph of the Delaunay triangulation with at most two edges a point that costs least, where a free end costs 1,
//! found by message passing. Two rounds: the second judges turns, steps and lone points by what the first found nearby.

mod approximation;
mod bridge;
mod calibrate;
mod candidates;
mod connection;
mod constants;
mod costs;
mod count;
mod decode;
mod dimension;
mod features;
mod found;
mod gaps;
mod geometry;
mod guard;
mod hints;
mod junctions;
mod median;
mod mend;
mod messages;
mod pairs;
mod prune;
mod reasons;
mod rings;
mod roughness;
mod selection;

use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::methods::crust;
use crate::progress::{Progress, Stage};
use candidates::Candidates;
pub use connection::Connection;
pub use constants::{CONSTANTS, Constants};
use found::{Found, converge};
pub use hints::{Hints, Longest};
pub use reasons::Reason;
use selection::Selection;

/// The edges of the curves that the points suggest, at most two a point, given what is known of them.
///
/// Rings of the crust that the theorem covers are among them as they are. The same for any order of the rows, any number of
/// threads, and after turns by 90°, reflections and exact translations. O(n log n).
///
/// # Errors
/// Too many points, hints that contradict each other, or a cancelled `progress`.
pub fn connect(
    delaunay: &Delaunay,
    constants: &Constants,
    hints: &Hints,
    progress: &Progress,
) -> Result<Edges> {
    Ok(find(delaunay, constants, hints, progress)?.1)
}

/// The same edges, how sure each is, and why they are not those of the crust.
///
/// # Errors
/// As for `connect`.
pub fn connection(
    delaunay: &Delaunay,
    constants: &Constants,
    hints: &Hints,
    progress: &Progress,
) -> Result<Connection> {
    let (found, edges) = find(delaunay, constants, hints, progress)?;
    Connection::new(delaunay, &found, edges, progress)
}

fn find<'a>(
    delaunay: &'a Delaunay,
    constants: &Constants,
    hints: &Hints,
    progress: &Progress,
) -> Result<(Found<'a>, Edges)> {
    progress.enter(Stage::Select, delaunay.points().len())?;
    let mut found = converge(delaunay, constants, hints, progress)?;
    let mut selection = std::mem::take(&mut found.selection);
    let crust = crust(delaunay, progress)?;
    bridge::bridge(delaunay, &found, &crust, constants, &mut selection)?;
    progress.advance(0)?;
    if !found.known.every_point {
        prune::prune(&found.factors(), constants, &mut selection)?;
    }
    progress.advance(0)?;
    mend::mend(&found, &mut selection)?;
    if let Some(count) = hints.components {
        count::reach(&found, count, &mut selection)?;
    }
    prune::drop_small(&found.factors(), hints.fewest, &mut selection)?;
    if hints.junctions {
        junctions::join(&found, &mut selection);
    }
    progress.advance(0)?;
    found.selection = selection;
    let edges = edges(delaunay, &found.candidates, &found.selection);
    if hints.components.is_some() {
        return Ok((found, edges));
    }
    let may_take = |ring: &[u32]| found.known.admits(&found.spacing, ring);
    let guarded = guard::guard(delaunay, &crust, edges.clone(), may_take, progress)?;
    let edges = if found.known.is_met(delaunay, &guarded) { guarded } else { edges };
    Ok((found, edges))
}

fn edges(delaunay: &Delaunay, candidates: &Candidates, selection: &Selection) -> Edges {
    let chosen = candidates.edges().filter(|&(_, e)| selection.chosen[e]);
    let edges = chosen.map(|(v, e)| rows(delaunay, v as u32, candidates.ends[e])).collect();
    sort(&[edges], delaunay.input_len())
}
