//! An answer, how sure it is, and why it is not the crust.

use super::calibrate::{self, ABOUT};
use super::features::{FEATURES, Surroundings};
use super::found::Found;
use super::reasons::{Comparison, Reason};
use crate::adjacency::{Adjacency, vertices_of_rows};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::methods::crust;
use crate::progress::Progress;
use rayon::prelude::*;

/// What `connection` gives. Edges are canonical.
#[derive(Debug, Clone, Default)]
pub struct Connection {
    /// The edges.
    pub edges: Edges,
    /// What describes each of them; `None` for one that the theorem put there.
    pub features: Vec<Option<[f64; FEATURES]>>,
    /// How likely each is right.
    pub confidence: Vec<f64>,
    /// What describes the whole.
    pub description: [f64; ABOUT],
    /// How likely the whole is right.
    pub whole: f64,
    /// The edges of the crust that are not in, each with the reason.
    pub left_out: Vec<([u32; 2], Reason)>,
    /// The edges that are not in the crust, each with the reason.
    pub added: Vec<([u32; 2], Reason)>,
}

impl Connection {
    /// Judge the edges found.
    pub(super) fn new(
        delaunay: &Delaunay,
        found: &Found<'_>,
        edges: Edges,
        progress: &Progress,
    ) -> Result<Self> {
        let vertices = vertices_of_rows(delaunay);
        let ends = |edge: &[u32; 2]| edge.map(|row| vertices[row as usize]);
        let answer = Adjacency::new(delaunay, &edges)?;
        let around = Surroundings::new(delaunay, found, &answer, progress)?;
        progress.advance(0)?;
        let features: Vec<_> = edges.par_iter().map(|edge| around.of(ends(edge))).collect();
        progress.advance(0)?;
        let confidence: Vec<f64> =
            features.iter().map(|each| calibrate::edge(each.as_ref())).collect();
        let description = calibrate::describe(&confidence, around.isolated());
        let of_crust = crust(delaunay, progress)?;
        let crust = Adjacency::new(delaunay, &of_crust)?;
        let comparison = Comparison { delaunay, around: &around, answer: &answer, crust: &crust };
        progress.advance(0)?;
        let left_out = without(&of_crust, &edges, |edge| comparison.left_out(ends(edge)));
        let added = without(&edges, &of_crust, |edge| comparison.added(ends(edge)));
        let whole = calibrate::answer(&description);
        Ok(Self { edges, features, confidence, description, whole, left_out, added })
    }
}

/// The edges that are not among others, each with its reason.
fn without(
    edges: &Edges,
    others: &Edges,
    reason: impl Fn(&[u32; 2]) -> Reason,
) -> Vec<([u32; 2], Reason)> {
    let out = edges.iter().filter(|edge| others.binary_search(edge).is_err());
    out.map(|edge| (*edge, reason(edge))).collect()
}
