//! Where the theorem holds, the crust is right: rings of it that are sampled densely enough are taken as they are.

use super::constants::{MARGIN, PROVEN};
use crate::certify::measure;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::interpolant::Interpolant;
use crate::point::{Point, dot, length, sub};
use crate::progress::Progress;
use crate::trace::{Curves, trace};
use std::collections::HashSet;

/// Put the rings of the crust that the theorem covers and that one may take into `edges`, which are canonical.
///
/// The sampling ratio costs more than the crust, so it is estimated only if a ring that could be covered is not in already.
///
/// # Errors
/// A cancelled `progress`.
pub fn guard(
    delaunay: &Delaunay,
    crust: &Edges,
    edges: Edges,
    may_take: impl Fn(&[u32]) -> bool,
    progress: &Progress,
) -> Result<Edges> {
    if *crust == edges {
        return Ok(edges);
    }
    let mut points = vec![[f64::NAN; 2]; delaunay.input_len()];
    for (v, &row) in delaunay.rows().iter().enumerate() {
        points[row as usize] = delaunay.points()[v];
    }
    let lost = without(crust, &edges);
    let curves = trace(&points, crust, progress)?;
    let rings: Vec<&[u32]> = rings(&curves)
        .filter(|ring| sides(ring).any(|side| lost.contains(&side)) && is_smooth(&points, ring))
        .filter(|ring| may_take(ring))
        .collect();
    if rings.is_empty() {
        return Ok(edges);
    }
    let interpolant = Interpolant::new(delaunay, crust, progress)?;
    let ratios = measure(delaunay, crust, &interpolant, progress)?.ratios;
    let is_proven = |side: [u32; 2]| {
        let number = crust.binary_search(&side).expect("rings of the crust are made of its edges");
        (1.0 + MARGIN) * ratios[number] < PROVEN
    };
    let proven: Vec<&[u32]> = rings.into_iter().filter(|ring| sides(ring).all(is_proven)).collect();
    Ok(replace(edges, &proven))
}

fn rings(curves: &Curves) -> impl Iterator<Item = &[u32]> {
    let ring = |k: usize| &curves.indices[curves.offsets[k]..curves.offsets[k + 1]];
    (0..curves.closed.len()).filter(|&k| curves.closed[k]).map(ring)
}

/// The edges of a ring, smaller row first.
fn sides(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)])
}

/// Does the ring turn nowhere by more than samples of a smooth curve that the theorem covers can (Lemma 10)?
fn is_smooth(points: &[Point], ring: &[u32]) -> bool {
    // 4 arcsin(r / 2), and some more for rounding.
    let least = libm::cos(4.0 * libm::asin(PROVEN / 2.0)) - 1e-9;
    let count = ring.len();
    let at = |k: usize| points[ring[k % count] as usize];
    (0..count).all(|k| {
        let (u, w) = (sub(at(k + 1), at(k)), sub(at(k + 2), at(k + 1)));
        dot(u, w) >= least * length(u) * length(w)
    })
}

/// Those of the sorted `edges` that are not among the sorted `others`.
fn without(edges: &Edges, others: &Edges) -> HashSet<[u32; 2]> {
    edges.iter().filter(|edge| others.binary_search(edge).is_err()).copied().collect()
}

/// Take the rings in, and out whatever else touches them.
fn replace(mut edges: Edges, rings: &[&[u32]]) -> Edges {
    let touched: HashSet<u32> = rings.iter().flat_map(|ring| ring.iter().copied()).collect();
    edges.retain(|edge| !edge.iter().any(|row| touched.contains(row)));
    edges.extend(rings.iter().flat_map(|ring| sides(ring)));
    edges.sort_unstable();
    edges
}
