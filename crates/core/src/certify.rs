//! What a certificate rests on: how densely the smooth interpolant of edges is sampled, edge by edge.

use crate::adjacency::vertices_of_rows;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::interpolant::{Bend, Interpolant};
use crate::parts::{GRAIN, in_parts, map, short};
use crate::point::{Point, cross, dot, sub};
use crate::progress::{Progress, Stage};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// For each of `edges`, which are canonical: the distance from the curve Voronoi vertex to its samples over the local feature size there.
///
/// Infinite where an end is a branch. The curve Voronoi vertex is where the dual of the edge meets the interpolant (paper, §5): beside
/// the midpoint, by the height of the arc that has the mean curvature of the edge's ends. Linear time.
///
/// # Errors
/// A cancelled `progress`.
pub fn ratios(
    delaunay: &Delaunay,
    edges: &Edges,
    axis: &Interpolant,
    progress: &Progress,
) -> Result<Vec<f64>> {
    let count = delaunay.points().len();
    if !delaunay.duplicates().is_empty() {
        // Several edges may be between the same two vertices.
        progress.enter(Stage::Measure, edges.len())?;
        let vertex = vertices_of_rows(delaunay);
        let of_rows = |edge: &[u32; 2]| ratio(delaunay, axis, edge.map(|row| vertex[row as usize]));
        return map(edges.len(), 0.0, progress, |k| of_rows(&edges[k]));
    }
    progress.enter(Stage::Measure, count)?;
    let first = first_edges(edges, count);
    let mut ratios = Vec::new();
    ratios.resize_with(edges.len(), AtomicU64::default);
    in_parts(count, GRAIN, progress, |vertices| {
        for few in short(vertices, progress) {
            few.for_each(|v| write(delaunay, axis, v as u32, &first, &ratios));
        }
    })?;
    Ok(ratios.into_iter().map(|ratio| f64::from_bits(ratio.into_inner())).collect())
}

/// For each of `rows` rows the number of its first edge, if it comes first in any.
fn first_edges(edges: &Edges, rows: usize) -> Vec<u32> {
    let mut first = vec![0; rows];
    for (number, edge) in edges.iter().enumerate().rev() {
        first[edge[0] as usize] = number as u32;
    }
    first
}

/// Write the ratios of the edges from `v` to vertices of later rows; `first` are the first edges of rows.
///
/// Vertices are near each other in memory where they are in the plane, so all is made in their order; rows need not be.
fn write(delaunay: &Delaunay, axis: &Interpolant, v: u32, first: &[u32], ratios: &[AtomicU64]) {
    let row = |v: u32| delaunay.rows()[v as usize];
    let (own, ends) = (row(v), axis.curve().of(v));
    let mut number = first[own as usize] as usize;
    let mut put = |&(q, _): &(u32, u32)| {
        if row(q) > own {
            ratios[number].store(ratio(delaunay, axis, [v, q]).to_bits(), Relaxed);
            number += 1;
        }
    };
    // At a branch all are infinite, so there their order does not count.
    match ends {
        &[(a, _), (b, _)] if row(a) > row(b) => ends.iter().rev().for_each(&mut put),
        _ => ends.iter().for_each(&mut put),
    }
}

/// The ratio of the edge from p to q.
fn ratio(delaunay: &Delaunay, axis: &Interpolant, [p, q]: [u32; 2]) -> f64 {
    if p == q || [p, q].iter().any(|&v| axis.curve().of(v).len() > 2) {
        return f64::INFINITY;
    }
    let (place, distance) = curve_vertex(delaunay, axis.bends(), p, q);
    distance / axis.between(p, q, place)
}

/// The curve Voronoi vertex of edge p q and its distance from p.
fn curve_vertex(delaunay: &Delaunay, bends: &[Option<Bend>], p: u32, q: u32) -> (Point, f64) {
    let from = delaunay.point(p);
    let chord = sub(delaunay.point(q), from);
    let curvatures = [(p, q, 1.0), (q, p, -1.0)].map(|(v, next, sign)| {
        bends[v as usize].map(|bend| sign * bend.direction(next) * bend.curvature)
    });
    let known = curvatures.iter().flatten();
    let curvature = known.clone().sum::<f64>() / (known.count().max(1) as f64);
    // The height over the chord, as a part of it; a curve that turns left bulges to the right.
    let sine = (curvature * dot(chord, chord).sqrt() / 2.0).clamp(-1.0, 1.0);
    let height = sine / (1.0 + (1.0 - sine * sine).sqrt()) / 2.0;
    let offset = [chord[0] / 2.0 + height * chord[1], chord[1] / 2.0 - height * chord[0]];
    ([from[0] + offset[0], from[1] + offset[1]], dot(offset, offset).sqrt())
}

/// Does the polygon turn by more than `most` at a vertex between `a` and `b`?
#[must_use]
pub fn turns_more(delaunay: &Delaunay, a: u32, v: u32, b: u32, most: &Turn) -> bool {
    let at = delaunay.point(v);
    let (u, w) = (sub(at, delaunay.point(a)), sub(delaunay.point(b), at));
    most.is_less(cross(u, w).abs(), dot(u, w))
}

/// An angle that others are compared with.
pub struct Turn {
    angle: f64,
    sin_cos: (f64, f64),
}

impl Turn {
    /// Of so many radians.
    #[must_use]
    pub fn new(angle: f64) -> Self {
        Self { angle, sin_cos: (libm::sin(angle), libm::cos(angle)) }
    }

    /// Is it less than the angle, from 0 to π, with these sine and cosine, times some length?
    fn is_less(&self, sine: f64, cosine: f64) -> bool {
        /// Beyond all rounding.
        const DOUBT: f64 = 1e-12;
        let (sin, cos) = self.sin_cos;
        let beyond = sine * cos - cosine * sin;
        let is_sure = beyond.abs() > DOUBT * (sine + cosine.abs());
        if is_sure && (0.0..std::f64::consts::PI).contains(&self.angle) {
            return beyond > 0.0;
        }
        libm::atan2(sine, cosine) > self.angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_compared_as_by_their_arc_tangent() {
        let angles = [0.0, 1e-9, 0.5, 1.0, 2.5, std::f64::consts::PI, 4.0];
        for most in angles {
            let turn = Turn::new(most);
            for near in angles {
                for step in [-1e-3, -1e-13, -1e-16, 0.0, 1e-16, 1e-13, 1e-3] {
                    let (sine, cosine) = (near + step).min(std::f64::consts::PI).sin_cos();
                    let (sine, cosine) = (3.0 * sine.abs(), 3.0 * cosine);
                    assert_eq!(turn.is_less(sine, cosine), libm::atan2(sine, cosine) > most);
                }
            }
            assert_eq!(turn.is_less(0.0, 0.0), 0.0 > most);
        }
    }
}
