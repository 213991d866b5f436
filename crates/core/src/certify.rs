//! What a certificate rests on: how densely the smooth interpolant of edges is sampled, edge by edge.

use crate::adjacency::{Adjacency, vertices_of_rows};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::interpolant::{Bend, Interpolant};
use crate::parts::map;
use crate::point::{Point, cross, dot, sub};
use crate::progress::{Progress, Stage};
use rayon::prelude::*;

/// The measures of edges and rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Measures {
    /// For each edge: the distance from the curve Voronoi vertex to its samples over the local feature size there.
    /// Infinite where an end is a branch.
    pub ratios: Vec<f64>,
    /// For each row: the angle by which the polygon turns there; 0 unless it has two edges.
    pub turns: Vec<f64>,
    /// For each row: how many edges it has. A repeated row has those of the first of its kind.
    pub degrees: Vec<u32>,
}

/// Measure `edges`, which are canonical.
///
/// The curve Voronoi vertex is where the dual of the edge meets the interpolant (paper, §5): beside the midpoint, by the
/// height of the arc that has the mean curvature of the edge's ends. Linear time.
///
/// # Errors
/// A cancelled `progress`.
pub fn measure(
    delaunay: &Delaunay,
    edges: &Edges,
    axis: &Interpolant,
    progress: &Progress,
) -> Result<Measures> {
    let curve = axis.curve();
    progress.enter(Stage::Measure, 2 * edges.len() + delaunay.points().len())?;
    let vertex = vertices_of_rows(delaunay);
    let rows = delaunay.rows();
    let in_order = |&[p, q]: &[u32; 2]| {
        let is_turned = rows[p as usize] > rows[q as usize];
        ratio(delaunay, axis, if is_turned { [q, p] } else { [p, q] })
    };
    // In the order of vertices, which are near each other in memory where they are in the plane; rows need not be.
    let turn = |v: usize| (turn(delaunay, curve, v as u32), curve.of(v as u32).len() as u32);
    let (turns, degrees) = {
        let turns = map(delaunay.points().len(), (0.0, 0), progress, turn)?;
        vertex.par_iter().map(|&v| turns[v as usize]).unzip()
    };
    let own = curve.edges();
    let ratios = map(own.len(), 0.0, progress, |k| in_order(&own[k]))?;
    let is_distinct = delaunay.duplicates().is_empty();
    let of_rows = |edge: &[u32; 2]| {
        let ends = edge.map(|row| vertex[row as usize]);
        if is_distinct || ends.map(|v| rows[v as usize]) == *edge {
            curve.edge(ends[0], ends[1]).map_or(f64::INFINITY, |number| ratios[number as usize])
        } else {
            ratio(delaunay, axis, ends)
        }
    };
    let ratios = map(edges.len(), 0.0, progress, |k| of_rows(&edges[k]))?;
    Ok(Measures { ratios, turns, degrees })
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

/// The angle by which the polygon turns at `v`.
fn turn(delaunay: &Delaunay, curve: &Adjacency, v: u32) -> f64 {
    let &[(a, _), (b, _)] = curve.of(v) else { return 0.0 };
    let at = delaunay.point(v);
    let (u, w) = (sub(at, delaunay.point(a)), sub(delaunay.point(b), at));
    libm::atan2(cross(u, w), dot(u, w)).abs()
}
