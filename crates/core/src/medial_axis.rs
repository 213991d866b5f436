//! The medial axis of samples and edges: the paper's anti-crust (§11, Figure 15).
//!
//! The Voronoi edges whose dual Delaunay edge is not selected. Its part inside the rings is told from the part outside by
//! a flood over the triangles, which flips where it crosses a ring.

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::point::{Point, sub};
use crate::predicates::in_circle;
use crate::progress::Progress;
use crate::trace::trace;
use crate::voronoi::{Center, circumcenter};
use rayon::prelude::*;

/// The medial axis of samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MedialAxis {
    /// Voronoi vertices, in the scale of the input; triangles on one circle share one.
    pub vertices: Vec<Point>,
    /// The distance from each vertex to the samples nearest to it.
    pub radii: Vec<f64>,
    /// Pairs of vertices: to the left and to the right of the Delaunay edge in `samples`.
    pub edges: Vec<[u32; 2]>,
    /// The two rows that each edge separates, i < j, sorted.
    pub samples: Vec<[u32; 2]>,
    /// Is the edge inside an odd number of rings?
    pub inner: Vec<bool>,
    /// The vertex that each unbounded edge starts at.
    pub ray_origins: Vec<u32>,
    /// Its unit direction.
    pub ray_directions: Vec<Point>,
    /// The two rows that it separates, i < j, sorted.
    pub ray_samples: Vec<[u32; 2]>,
}

/// The Voronoi edges whose dual is not in `edges`, which are canonical.
///
/// Voronoi edges of length zero, between triangles on exactly one circle, are left out and their ends are one vertex. Where
/// all points lie on one line, an edge that is not selected has two opposite rays from its midpoint as its dual.
/// Linear time but for the sort of the answer.
///
/// # Errors
/// A cancelled `progress`.
pub fn medial_axis(delaunay: &Delaunay, edges: &Edges, progress: &Progress) -> Result<MedialAxis> {
    let curve = Adjacency::new(delaunay, edges);
    let triangles = delaunay.triangles();
    if triangles.is_empty() {
        return Ok(of_line(delaunay, &curve));
    }
    let twins = delaunay.twins();
    progress.advance(0)?;
    let mesh = Mesh { delaunay, triangles: &triangles, twins: &twins };
    let inside = inside(&mesh, &flipping(delaunay, &curve, progress)?, &curve);
    let centers = one_for_each_circle(&mesh);
    progress.advance(0)?;
    Ok(collect(&mesh, &curve, &inside, &centers))
}

/// The triangulation as half-edges.
struct Mesh<'a> {
    delaunay: &'a Delaunay,
    triangles: &'a [[u32; 3]],
    twins: &'a [Option<u32>],
}

impl Mesh<'_> {
    /// The ends of half-edge `e`.
    fn ends(&self, e: usize) -> (u32, u32) {
        let triangle = self.triangles[e / 3];
        (triangle[e % 3], triangle[(e + 1) % 3])
    }

    /// The corner opposite to half-edge `e`.
    fn apex(&self, e: usize) -> u32 {
        self.triangles[e / 3][(e + 2) % 3]
    }

    /// Are the triangles on both sides of half-edge `e` on one circle?
    fn is_tie(&self, e: usize, twin: usize) -> bool {
        let (p, q) = self.ends(e);
        let [p, q, a, b] = [p, q, self.apex(e), self.apex(twin)].map(|v| self.delaunay.point(v));
        // The far apex is never inside; with the orientation turned around, this says that it is not outside.
        !in_circle(q, p, a, b)
    }

    fn half_edges(&self) -> impl ParallelIterator<Item = (usize, Option<u32>)> {
        self.twins.par_iter().copied().enumerate()
    }
}

/// For each edge: does crossing it lead from the inside of a ring to its outside?
///
/// Open curves do not separate. Neither do rings with an edge that is not in the triangulation.
fn flipping(delaunay: &Delaunay, curve: &Adjacency, progress: &Progress) -> Result<Vec<bool>> {
    let vertices = (0..delaunay.points().len() as u32).into_par_iter();
    let simple = |v: u32| match curve.of(v) {
        [] => true,
        [(a, _), (b, _)] => [a, b].iter().all(|end| delaunay.star(v).neighbors.contains(end)),
        _ => false,
    };
    if vertices.all(simple) {
        return Ok(vec![true; curve.edges().len()]);
    }
    let traced = trace(delaunay.points(), curve.edges(), progress)?;
    let mut flips = vec![false; curve.edges().len()];
    for (ends, _) in traced.offsets.windows(2).zip(&traced.closed).filter(|&(_, &closed)| closed) {
        let ring = &traced.indices[ends[0]..ends[1]];
        let sides = || ring.iter().copied().zip(ring.iter().copied().cycle().skip(1));
        if sides().all(|(p, q)| delaunay.star(p).neighbors.contains(&q)) {
            let numbers = sides().filter_map(|(p, q)| curve.edge(p, q));
            numbers.for_each(|number| flips[number as usize] = true);
        }
    }
    Ok(flips)
}

/// For each triangle: is it inside an odd number of rings?
fn inside(mesh: &Mesh<'_>, flips: &[bool], curve: &Adjacency) -> Vec<bool> {
    let crosses = |e: usize| {
        let (p, q) = mesh.ends(e);
        curve.edge(p, q).is_some_and(|number| flips[number as usize])
    };
    let mut inside = vec![None; mesh.triangles.len()];
    let mut stack = Vec::new();
    if let Some(e) = mesh.twins.iter().position(Option::is_none) {
        inside[e / 3] = Some(crosses(e));
        stack.push(e / 3);
    }
    while let Some(t) = stack.pop() {
        for e in 3 * t..3 * t + 3 {
            let Some(twin) = mesh.twins[e] else { continue };
            let next = twin as usize / 3;
            if inside[next].is_none() {
                inside[next] = Some(inside[t] == Some(!crosses(e)));
                stack.push(next);
            }
        }
    }
    inside.into_iter().map(|inside| inside == Some(true)).collect()
}

/// For each triangle, the first of those on its circle that it is connected with.
fn one_for_each_circle(mesh: &Mesh<'_>) -> Vec<u32> {
    let later = |&(e, twin): &(usize, Option<u32>)| twin.is_some_and(|twin| e < twin as usize);
    let ties: Vec<[u32; 2]> = mesh
        .half_edges()
        .filter(later)
        .filter_map(|(e, twin)| Some((e, twin? as usize)))
        .filter(|&(e, twin)| mesh.is_tie(e, twin))
        .map(|(e, twin)| [e as u32 / 3, twin as u32 / 3])
        .collect();
    let mut first: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    for pair in ties {
        let [a, b] = pair.map(|t| root(&mut first, t));
        first[a.max(b) as usize] = a.min(b);
    }
    for t in 0..first.len() as u32 {
        first[t as usize] = root(&mut first, t);
    }
    first
}

/// The smallest triangle of a set, halving the path to it.
fn root(first: &mut [u32], mut t: u32) -> u32 {
    while first[t as usize] != t {
        first[t as usize] = first[first[t as usize] as usize];
        t = first[t as usize];
    }
    t
}

/// An edge of the axis: its samples as rows, the triangles to their left and right, and whether it is inside.
type Found = ([u32; 2], [u32; 2], bool);

fn collect(mesh: &Mesh<'_>, curve: &Adjacency, inside: &[bool], centers: &[u32]) -> MedialAxis {
    let open = |e: usize| {
        let (p, q) = mesh.ends(e);
        curve.edge(p, q).is_none()
    };
    let mut found: Vec<Found> = mesh
        .half_edges()
        .filter(|&(e, twin)| twin.is_some_and(|twin| e < twin as usize) && open(e))
        .filter_map(|(e, twin)| {
            let [left, right] = [e as u32, twin?].map(|e| centers[e as usize / 3]);
            let (samples, turned) = rows(mesh, e);
            let sides = if turned { [right, left] } else { [left, right] };
            (left != right).then_some((samples, sides, inside[e / 3]))
        })
        .collect();
    found.par_sort_unstable_by_key(|&(samples, _, _)| samples);
    let mut rays: Vec<([u32; 2], usize)> = (0..mesh.twins.len())
        .filter(|&e| mesh.twins[e].is_none() && open(e))
        .map(|e| (rows(mesh, e).0, e))
        .collect();
    rays.sort_unstable();
    assemble(mesh, &found, &rays, centers)
}

/// The rows at the ends of half-edge `e`, smaller first, and whether that turns it around.
fn rows(mesh: &Mesh<'_>, e: usize) -> ([u32; 2], bool) {
    let (p, q) = mesh.ends(e);
    let [i, j] = [p, q].map(|vertex| mesh.delaunay.rows()[vertex as usize]);
    ([i.min(j), i.max(j)], i > j)
}

fn assemble(
    mesh: &Mesh<'_>,
    found: &[Found],
    rays: &[([u32; 2], usize)],
    centers: &[u32],
) -> MedialAxis {
    let mut number = vec![u32::MAX; mesh.triangles.len()];
    for &t in found.iter().flat_map(|(_, sides, _)| sides) {
        number[t as usize] = 0;
    }
    for &(_, e) in rays {
        number[centers[e / 3] as usize] = 0;
    }
    let used: Vec<u32> = (0..number.len() as u32).filter(|&t| number[t as usize] == 0).collect();
    for (k, &t) in used.iter().enumerate() {
        number[t as usize] = k as u32;
    }
    let (vertices, radii) = used.par_iter().map(|&t| center(mesh, t)).unzip();
    MedialAxis {
        vertices,
        radii,
        edges: found.iter().map(|(_, sides, _)| sides.map(|t| number[t as usize])).collect(),
        samples: found.iter().map(|&(samples, _, _)| samples).collect(),
        inner: found.iter().map(|&(_, _, inner)| inner).collect(),
        ray_origins: rays.iter().map(|&(_, e)| number[centers[e / 3] as usize]).collect(),
        ray_directions: rays.iter().map(|&(_, e)| outward(mesh.delaunay, mesh.ends(e))).collect(),
        ray_samples: rays.iter().map(|&(samples, _)| samples).collect(),
    }
}

/// Where a vertex is known to this part of its radius, floating point is good enough.
///
/// A flat triangle's center depends on the rounding of the samples themselves by more than this.
const ACCURACY: f64 = 1e-7;

/// The circumcenter of triangle `t` and its radius, in the scale of the input.
fn center(mesh: &Mesh<'_>, t: u32) -> (Point, f64) {
    let corners = mesh.triangles[t as usize].map(|vertex| mesh.delaunay.point(vertex));
    let Center { at, error } = Center::estimate(corners, corners[0]);
    let from = if error <= ACCURACY * at[0].hypot(at[1]) { at } else { circumcenter(corners) };
    let scale = mesh.delaunay.scale();
    let at = [0, 1].map(|axis| (corners[0][axis] + from[axis]) / scale);
    (at, from[0].hypot(from[1]) / scale)
}

/// The unit normal to the right of p → q.
fn outward(delaunay: &Delaunay, (p, q): (u32, u32)) -> Point {
    let [x, y] = sub(delaunay.point(q), delaunay.point(p));
    let length = x.hypot(y);
    [y / length, -x / length]
}

/// The axis of points on one line: a line across each edge that is not selected.
fn of_line(delaunay: &Delaunay, curve: &Adjacency) -> MedialAxis {
    let mut axis = MedialAxis::default();
    let mut open: Vec<_> = delaunay
        .edges()
        .filter(|edge| curve.edge(edge.p, edge.q).is_none())
        .map(|edge| (crate::edges::rows(delaunay, edge.p, edge.q), edge.p, edge.q))
        .collect();
    open.sort_unstable();
    for (samples, p, q) in open {
        let ends = [p, q].map(|vertex| delaunay.point(vertex));
        let step = sub(ends[1], ends[0]);
        let number = axis.vertices.len() as u32;
        axis.vertices.push([0, 1].map(|k| (ends[0][k] + step[k] / 2.0) / delaunay.scale()));
        axis.radii.push(step[0].hypot(step[1]) / 2.0 / delaunay.scale());
        axis.ray_origins.extend([number; 2]);
        axis.ray_directions.extend([outward(delaunay, (p, q)), outward(delaunay, (q, p))]);
        axis.ray_samples.extend([samples; 2]);
    }
    axis
}
