//! What a certificate rests on: how densely the smooth interpolant of edges is sampled, edge by edge.

use crate::adjacency::vertices_of_rows;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::interpolant::{Bend, Interpolant};
use crate::parts::{map, split};
use crate::point::{Point, cross, dot, sub};
use crate::progress::{Progress, Stage};
use crate::rows::OfVertices;

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
    progress.enter(Stage::Measure, 3 * count)?;
    let of_vertex = |v, ratios: &mut Vec<f64>| append(delaunay, axis, v, ratios);
    let own = OfVertices::new(count, 1, progress, of_vertex)?;
    let mut ratios = vec![0.0; edges.len()];
    own.by_rows(
        delaunay,
        progress,
        |counts| split(&mut ratios, counts.iter().copied()),
        |part, own| part.copy_from_slice(own),
    )?;
    Ok(ratios)
}

/// Append the ratios of the edges from `v` to vertices of later rows, in the order of these.
fn append(delaunay: &Delaunay, axis: &Interpolant, v: u32, ratios: &mut Vec<f64>) {
    let (row, start) = (|v: u32| delaunay.rows()[v as usize], ratios.len());
    let ends = axis.curve().of(v);
    for &(q, _) in ends.iter().filter(|&&(q, _)| row(q) > row(v)) {
        ratios.push(ratio(delaunay, axis, [v, q]));
    }
    // At a branch they are all infinite.
    if let &[(a, _), (b, _)] = ends
        && row(a) > row(b)
    {
        ratios[start..].reverse();
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
