//! The reasons of a certificate: at which points and edges the conditions of a theorem of the paper fail, and which.

use crate::adjacency::vertices_of_rows;
use crate::certify::{Turn, ratios, turns_more};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::interpolant::Interpolant;
use crate::methods::{Kind, beta_skeleton, is_beta_skeleton};
use crate::parts::{collect, map};
use crate::progress::Progress;
use rayon::prelude::*;

/// What a caller knows of the theorems.
#[derive(Debug, Clone, Copy)]
pub struct Theorems {
    /// The β that Theorem 20 is about.
    pub beta: f64,
    /// Samples denser than this have the β-skeleton as their curve.
    pub of_skeleton: f64,
    /// Samples denser than this have the crust as their curve.
    pub of_crust: f64,
    /// What an estimate is increased by, as a part of it, before it is compared.
    pub margin: f64,
}

/// The theorem whose edges these are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theorem {
    /// Theorems 14 and 15.
    Crust,
    /// Theorem 20.
    BetaSkeleton,
}

impl Theorem {
    /// The name of the method that it is about.
    #[must_use]
    pub fn method(self) -> &'static str {
        match self {
            Self::Crust => "crust",
            Self::BetaSkeleton => "beta-skeleton",
        }
    }
}

/// Why a point or an edge is weak; a later reason outweighs those before it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Reason {
    /// It is not.
    #[default]
    None,
    /// The samples are too sparse for the theorem.
    Undersampled,
    /// An edge of the crust is not there.
    Missing,
    /// The polygon turns by more than a sampled smooth curve can.
    Corner,
    /// A point with one edge.
    Endpoint,
    /// A point with more than two edges.
    Branch,
    /// A point without an edge.
    Isolated,
    /// An edge that the crust does not have.
    Unselected,
}

impl Reason {
    /// Their numbers, which grow with their weight.
    #[must_use]
    pub fn codes(reasons: Vec<Self>) -> Vec<u8> {
        reasons.into_iter().map(|reason| reason as u8).collect()
    }
}

/// What holds of edges, where it does not, and why.
#[derive(Debug, Clone)]
pub struct Certificate {
    /// The theorem that is about such edges, if there is one.
    pub theorem: Option<Theorem>,
    /// The sampling ratio that the theorem asks for, or, without one, that of the β-skeleton's.
    pub threshold: f64,
    /// Does the theorem apply everywhere, as far as samples tell?
    pub guaranteed: bool,
    /// The sampling ratio of each edge.
    pub ratios: Vec<f64>,
    /// For each edge why it is weak.
    pub edges: Vec<Reason>,
    /// For each row why it is weak.
    pub points: Vec<Reason>,
    /// The crust, where it was needed.
    pub crust: Option<Edges>,
}

/// Certify `edges`, which are canonical and have been made smooth; `crust` gives the crust, where it is needed.
///
/// # Errors
/// A cancelled `progress`, or an error of `crust`.
pub fn certify(
    delaunay: &Delaunay,
    edges: &Edges,
    smooth: &Interpolant,
    theorems: &Theorems,
    crust: impl FnOnce() -> Result<Edges>,
    progress: &Progress,
) -> Result<Certificate> {
    let ratios = ratios(delaunay, edges, smooth, progress)?;
    let (theorem, crust) = theorem(delaunay, edges, smooth, theorems, crust, progress)?;
    let threshold = match theorem {
        Some(Theorem::Crust) => theorems.of_crust,
        _ => theorems.of_skeleton,
    };
    // A sample angle is at least π less this (paper, Lemma 10).
    let most = Turn::new(4.0 * libm::asin(threshold / 2.0));
    let mut points = of_points(delaunay, smooth, &most, progress)?;
    // Where a theorem applies the edges differ from nothing.
    let other = crust.iter().filter(|_| theorem.is_none());
    for row in other.clone().flat_map(|crust| without(crust, edges)).flatten() {
        points[*row as usize] = points[*row as usize].max(Reason::Missing);
    }
    let is_sparse = |ratio: f64| ratio.is_nan() || (1.0 + theorems.margin) * ratio >= threshold;
    let of_edge = |(&edge, &ratio): (&[u32; 2], &f64)| reason(edge, &points, is_sparse(ratio));
    let mut of_edges: Vec<Reason> = edges.par_iter().zip(ratios.par_iter()).map(of_edge).collect();
    for edge in other.flat_map(|crust| without(edges, crust)) {
        let k = edges.binary_search(edge).unwrap_or_default();
        of_edges[k] = Reason::Unselected;
    }
    for (edge, _) in edges.iter().zip(&of_edges).filter(|(_, why)| **why == Reason::Undersampled) {
        for &row in edge {
            points[row as usize] = points[row as usize].max(Reason::Undersampled);
        }
    }
    let sound = points.iter().chain(&of_edges).all(|&reason| reason == Reason::None);
    let guaranteed = theorem.is_some() && !edges.is_empty() && sound;
    Ok(Certificate { theorem, threshold, guaranteed, ratios, edges: of_edges, points, crust })
}

/// The theorem about these edges, if there is one, and the crust, if it was looked at.
fn theorem(
    delaunay: &Delaunay,
    edges: &Edges,
    smooth: &Interpolant,
    theorems: &Theorems,
    crust: impl FnOnce() -> Result<Edges>,
    progress: &Progress,
) -> Result<(Option<Theorem>, Option<Edges>)> {
    let is_skeleton = if delaunay.duplicates().is_empty() {
        is_beta_skeleton(delaunay, theorems.beta, smooth.curve(), progress)?
    } else {
        beta_skeleton(delaunay, theorems.beta, Kind::Circle, progress)? == *edges
    };
    if is_skeleton {
        return Ok((Some(Theorem::BetaSkeleton), None));
    }
    let crust = crust()?;
    Ok(((crust == *edges).then_some(Theorem::Crust), Some(crust)))
}

/// For each row the reason that its edges are, and how the polygon turns between two.
fn of_points(
    delaunay: &Delaunay,
    smooth: &Interpolant,
    most: &Turn,
    progress: &Progress,
) -> Result<Vec<Reason>> {
    let of_vertex = |v: usize| match *smooth.curve().of(v as u32) {
        [] => Reason::Isolated,
        [_] => Reason::Endpoint,
        [(a, _), (b, _)] if turns_more(delaunay, a, v as u32, b, most) => Reason::Corner,
        [_, _] => Reason::None,
        _ => Reason::Branch,
    };
    let reasons = map(delaunay.points().len(), Reason::None, progress, of_vertex)?;
    Ok(collect(&vertices_of_rows(delaunay), |&v| reasons[v as usize]))
}

fn reason(edge: [u32; 2], points: &[Reason], is_sparse: bool) -> Reason {
    let is_breaking = |reason: &Reason| (Reason::Corner..=Reason::Branch).contains(reason);
    let ends = edge.map(|row| points[row as usize]).into_iter().filter(is_breaking);
    let own = if is_sparse { Reason::Undersampled } else { Reason::None };
    ends.fold(own, Reason::max)
}

/// The edges that are not among `others`; both are canonical.
fn without<'a>(edges: &'a Edges, others: &'a Edges) -> impl Iterator<Item = &'a [u32; 2]> {
    edges.iter().filter(|edge| others.binary_search(edge).is_err())
}
