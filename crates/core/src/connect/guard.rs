//! Where the theorem holds, the crust is right: rings of it that are sampled densely enough are taken as they are.

use super::constants::{MARGIN, PROVEN};
use crate::adjacency::{Adjacency, Incidence, vertices_of_rows};
use crate::certify::ratios;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::interpolant::Interpolant;
use crate::point::{dot, length, sub};
use crate::progress::Progress;
use std::collections::HashSet;
use std::sync::Arc;

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
    let mut rings = smooth_rings(delaunay, crust, &edges);
    rings.retain(|ring| may_take(ring));
    progress.advance(0)?;
    if rings.is_empty() {
        return Ok(edges);
    }
    let interpolant =
        Interpolant::new(delaunay, Arc::new(Adjacency::new(delaunay, crust)?), progress)?;
    let ratios = ratios(delaunay, crust, &interpolant, progress)?;
    let is_proven = |side: [u32; 2]| {
        let number = crust.binary_search(&side).expect("rings of the crust are made of its edges");
        (1.0 + MARGIN) * ratios[number] < PROVEN
    };
    rings.retain(|ring| sides(ring).all(is_proven));
    Ok(replace(edges, &rings))
}

/// The edges of a ring, smaller row first.
fn sides(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)])
}

/// The rings of the crust that are not in `edges` and turn nowhere by more than samples of a smooth curve that the theorem
/// covers can (Lemma 10). Linear.
fn smooth_rings(delaunay: &Delaunay, crust: &Edges, edges: &Edges) -> Vec<Vec<u32>> {
    let walk = Walk {
        delaunay,
        crust,
        graph: Incidence::new(crust, delaunay.input_len()),
        vertices: vertices_of_rows(delaunay),
        // 4 arcsin(r / 2), and some more for rounding.
        least: libm::cos(4.0 * libm::asin(PROVEN / 2.0)) - 1e-9,
    };
    let mut seen = vec![false; crust.len()];
    // Both are sorted.
    let mut others = edges.iter().peekable();
    let mut rings = Vec::new();
    for (number, edge) in crust.iter().enumerate() {
        while others.next_if(|&other| other < edge).is_some() {}
        if others.peek() != Some(&edge) && !seen[number] {
            rings.extend(walk.ring(number, &mut seen));
        }
    }
    rings
}

/// What walks along the crust need.
struct Walk<'a> {
    delaunay: &'a Delaunay,
    crust: &'a Edges,
    graph: Incidence,
    /// The vertex of each row.
    vertices: Vec<u32>,
    /// The least cosine of a turn.
    least: f64,
}

impl Walk<'_> {
    /// The rows of the ring that edge `number` is part of, if it is, that is smooth, and no walk was there before.
    fn ring(&self, number: usize, seen: &mut [bool]) -> Option<Vec<u32>> {
        let [start, first] = self.crust[number];
        let (mut ring, mut at, mut came) = (vec![start], first, number as u32);
        loop {
            if std::mem::replace(&mut seen[came as usize], true) {
                return None;
            }
            let before = ring[ring.len() - 1];
            let &[a, b] = self.graph.of(at) else { return None };
            let (next, edge) = if a.1 == came { b } else { a };
            if !self.is_smooth([before, at, next]) {
                return None;
            }
            if at == start {
                return Some(ring);
            }
            ring.push(at);
            (at, came) = (next, edge);
        }
    }

    /// Does a path by three rows turn by little enough?
    fn is_smooth(&self, rows: [u32; 3]) -> bool {
        let [a, b, c] = rows.map(|row| self.delaunay.point(self.vertices[row as usize]));
        let (u, w) = (sub(b, a), sub(c, b));
        dot(u, w) >= self.least * length(u) * length(w)
    }
}

/// Take the rings in, and out whatever else touches them.
fn replace(mut edges: Edges, rings: &[Vec<u32>]) -> Edges {
    let touched: HashSet<u32> = rings.iter().flat_map(|ring| ring.iter().copied()).collect();
    edges.retain(|edge| !edge.iter().any(|row| touched.contains(row)));
    edges.extend(rings.iter().flat_map(|ring| sides(ring)));
    edges.sort_unstable();
    edges
}
