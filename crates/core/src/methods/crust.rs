//! The crust, from one triangulation.
//!
//! N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve Reconstruction", Graphical
//! Models and Image Processing 60 (1998), section 2, "Alternate Definition". The paper triangulates the points again,
//! together with their Voronoi vertices; here a disk is found, or shown not to exist, by a [`search`](super::search).

use super::one_step_crust;
use super::search::{find_disk, find_late};
use super::visit::{TooLong, Visit};
use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, select_screened, sort};
use crate::error::Result;
use crate::progress::Progress;
use std::sync::{Mutex, PoisonError};

/// The edges with a disk that touches both ends and holds, in its interior, no point and no Voronoi vertex.
///
/// Ties keep the edge. O(n log n) on any data met in practice: it costs one triangulation and little more.
///
/// # Errors
/// A cancelled `progress`.
pub fn crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let late = Mutex::new(Vec::new());
    let screen = |edge| one_step_crust::is_in(delaunay, edge);
    let kept = select_screened(delaunay, progress, screen, Visit::default, |visit, edge| {
        find_disk(delaunay, edge, visit).map_or_else(
            |TooLong| {
                late.lock().unwrap_or_else(PoisonError::into_inner).push(edge);
                false
            },
            |verdict| verdict.is_in(),
        )
    })?;
    let late = late.into_inner().unwrap_or_else(PoisonError::into_inner);
    if late.is_empty() {
        return Ok(kept);
    }
    let mut parts = find_late(delaunay, &late, progress, |edge, verdict| {
        verdict.is_in().then(|| rows(delaunay, edge.p, edge.q))
    })?;
    parts.push(kept);
    Ok(sort(&parts, delaunay.input_len()))
}
