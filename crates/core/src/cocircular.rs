//! The closed Delaunay graph: all pairs that some disk touches with no point inside.
//!
//! It is the triangulation and, where four or more points lie on one empty circle, all the
//! diagonals between them, not only those that the triangulation chose.

use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, select, sort};
use crate::error::Result;
use crate::exact::predicates::in_circle;
use crate::memory;
use crate::parts::{GRAIN, in_parts, sort_by};
use crate::progress::Progress;

/// The edges of the closed Delaunay graph that `keep` keeps, as rows.
///
/// # Errors
/// A cancelled `progress`.
pub fn select_closed(
    delaunay: &Delaunay,
    progress: &Progress,
    keep: impl Fn(Edge) -> bool + Sync,
) -> Result<Edges> {
    let edges = select(delaunay, progress, || (), |(), edge| keep(edge))?;
    let tied = diagonals(delaunay, progress)?;
    let mut parts = in_parts(tied.len(), GRAIN, &progress.quiet(), |range| {
        let kept = tied[range].iter().filter(|&&edge| keep(edge));
        kept.map(|edge| rows(delaunay, edge.p, edge.q)).collect::<Edges>()
    })?;
    if parts.iter().all(Vec::is_empty) {
        return Ok(edges);
    }
    parts.push(edges);
    let mut closed = sort(&parts, delaunay.input_len());
    closed.dedup();
    Ok(closed)
}

/// The diagonals between points on one empty circle, those of the triangulation among them, sorted
/// by p.
///
/// The apexes of such an edge are any two of the other points: all see it under the same angle, or
/// 180° less that. The time and space is quadratic in the number of points on one circle.
///
/// # Errors
/// Too little memory for them, or a cancelled `progress`.
pub fn diagonals(delaunay: &Delaunay, progress: &Progress) -> Result<Vec<Edge>> {
    let from = |p| delaunay.edges_from(p).filter_map(|edge| face(delaunay, edge));
    let rings = in_parts(delaunay.points().len(), GRAIN, &progress.quiet(), |vertices| {
        vertices.flat_map(|p| from(p as u32)).collect::<Vec<_>>()
    })?
    .concat();
    let count = rings.iter().map(|ring| ring.len() * (ring.len() - 3) / 2).sum();
    memory::check(count, BYTES)?;
    let mut edges = Vec::with_capacity(count);
    for (number, ring) in rings.iter().enumerate() {
        for i in 0..ring.len() - 2 {
            edges.extend(diagonals_from(ring, i));
            if i > 0 || number % GRAIN == 0 {
                progress.advance(0)?;
            }
        }
    }
    sort_by(&mut edges, progress, |a: &Edge, b| (a.p, a.q).cmp(&(b.p, b.q)))?;
    Ok(edges)
}

/// Memory for each diagonal at the peak: itself, and twice what is made of it.
const BYTES: usize = size_of::<Edge>() + 2 * size_of::<[u32; 2]>();

/// The points on the empty circle around the triangles of `edge`, counter-clockwise.
///
/// Only if there are four or more and `edge` is the first of their diagonals in the triangulation.
fn face(delaunay: &Delaunay, edge: Edge) -> Option<Vec<u32>> {
    if !is_tied(delaunay, edge) {
        return None;
    }
    let first = (edge.p, edge.q);
    let mut ring = Vec::with_capacity(4);
    // Half-edges with the face to their left as far as it is known.
    let mut open = vec![(edge.q, edge.p), (edge.p, edge.q)];
    while let Some((u, v)) = open.pop() {
        let across = between(delaunay, u, v);
        match across.right {
            Some(_) if (u.min(v), u.max(v)) < first && is_tied(delaunay, across) => return None,
            Some(apex) if is_tied(delaunay, across) => open.extend([(apex, v), (u, apex)]),
            _ => ring.push(u),
        }
    }
    Some(ring)
}

/// The points on the empty circle to the left of u → v, but these two: one, or more where there are ties.
#[must_use]
pub fn corners(delaunay: &Delaunay, u: u32, v: u32) -> Vec<u32> {
    let mut corners = Vec::with_capacity(1);
    let mut open = vec![between(delaunay, u, v)];
    while let Some(Edge { p: u, q: v, left, .. }) = open.pop() {
        let Some(apex) = left else { continue };
        corners.push(apex);
        let beyond = [(u, apex), (apex, v)].map(|(u, v)| between(delaunay, u, v));
        open.extend(beyond.into_iter().filter(|&edge| is_tied(delaunay, edge)));
    }
    corners
}

/// Do the apexes of `edge` lie on one circle with it?
#[must_use]
pub fn is_tied(delaunay: &Delaunay, edge: Edge) -> bool {
    let (Some(left), Some(right)) = (edge.left, edge.right) else {
        return false;
    };
    let [p, q, left, right] = [edge.p, edge.q, left, right].map(|vertex| delaunay.point(vertex));
    // The right apex is never inside the circle, and the clockwise order makes the test one for
    // outside.
    !in_circle(q, p, left, right)
}

/// The half-edge u → v and its apexes.
fn between(delaunay: &Delaunay, u: u32, v: u32) -> Edge {
    let star = delaunay.star(u);
    let k = delaunay.position(u, v).expect("u and v are two corners of a triangle");
    Edge { p: u, q: v, left: star.left(k), right: star.right(k) }
}

/// The diagonals from point `i` of a ring to later ones.
fn diagonals_from(ring: &[u32], i: usize) -> impl Iterator<Item = Edge> {
    let count = ring.len();
    // The first and the last point are neighbors on the circle.
    (i + 2..count.min(count - 1 + i)).map(move |j| {
        let (right, left) = (Some(ring[i + 1]), Some(ring[(j + 1) % count]));
        if ring[i] < ring[j] {
            Edge { p: ring[i], q: ring[j], left, right }
        } else {
            Edge { p: ring[j], q: ring[i], left: right, right: left }
        }
    })
}
