//! The medial axis of samples and edges: the paper's anti-crust (§11, Figure 15).
//!
//! The Voronoi edges whose dual Delaunay edge is not selected. Its part inside the rings is told from the part outside by
//! a flood over the vertices, which flips where it crosses a ring.

mod far;

use crate::adjacency::{Adjacency, vertices_of_rows};
use crate::delaunay::{Delaunay, NONE};
use crate::edges::Edges;
use crate::error::Result;
use crate::exact::circumcenter::{Center, circumcenter};
use crate::exact::filter::ROUNDING;
use crate::exact::predicates::in_circle;
use crate::forest::Forest;
use crate::memory;
use crate::parts::{all, in_parts, map, split};
use crate::point::{Point, length, lexicographic, sub};
use crate::progress::{PACE, Progress, Stage};
use crate::trace::trace_edges;
pub use far::MedialAxis;
use rayon::prelude::*;
use std::cell::OnceCell;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The Voronoi edges whose dual is not in `edges`, which are canonical.
///
/// Voronoi edges of length zero, between triangles on exactly one circle, are left out and their ends are one vertex. Where
/// all points lie on one line, an edge that is not selected has two opposite rays from its midpoint as its dual.
/// Linear time but for the sort of the answer.
///
/// # Errors
/// A cancelled `progress`.
pub fn medial_axis(delaunay: &Delaunay, edges: &Edges, progress: &Progress) -> Result<MedialAxis> {
    memory::check(delaunay.points().len(), BYTES)?;
    let curve = Adjacency::new(delaunay, edges);
    let triangles = delaunay.triangles();
    if triangles.is_empty() {
        return Ok(of_line(delaunay, &curve));
    }
    let flips = flipping(delaunay, &curve, progress)?;
    let vertices = delaunay.points().len();
    // The triangles once; the vertices for ties, for steps to the left, for edges and in the order of the rows.
    progress.enter(Stage::Axis, triangles.len() + 4 * vertices)?;
    let wedges = delaunay.wedge_triangles();
    let circle = |t: usize| Circle::new(delaunay, &triangles[t]);
    let circles = map(triangles.len(), Circle::default(), progress, circle)?;
    drop(triangles);
    let mesh = Mesh { delaunay, circles: &circles, wedges: &wedges, curve: &curve, flips: &flips };
    let centers = one_for_each_circle(&mesh, progress)?;
    let inside = inside(&mesh, progress)?;
    let axis = collect(&mesh, &inside, &centers, progress)?;
    Ok(far::at_infinity(axis, place_of(delaunay)))
}

/// The points by row, in the scale of the input; a duplicate is no sample.
fn place_of(delaunay: &Delaunay) -> impl Fn(u32) -> Point {
    let vertex = OnceCell::new();
    move |row| {
        let vertex: &Vec<u32> = vertex.get_or_init(|| vertices_of_rows(delaunay));
        delaunay.point(vertex[row as usize]).map(|x| x / delaunay.scale())
    }
}

/// Memory for each vertex at the peak, about.
const BYTES: usize = 432;

/// The triangulation as stars, with curves in it.
struct Mesh<'a> {
    delaunay: &'a Delaunay,
    /// The circle through the corners of each triangle.
    circles: &'a [Circle],
    /// The triangle to the left of each half-edge.
    wedges: &'a [u32],
    curve: &'a Adjacency,
    /// For each edge of the curves: does it separate inside and outside?
    flips: &'a [bool],
}

impl Mesh<'_> {
    /// The triangles to the left of the half-edges from `p`.
    fn triangles_at(&self, p: u32) -> &[u32] {
        let (start, count) =
            (self.delaunay.stars().offset(p), self.delaunay.star(p).neighbors.len());
        &self.wedges[start..start + count]
    }

    /// The triangles to the left and to the right of half-edge `k` of the star of `p`.
    fn sides(&self, p: u32, k: usize) -> Option<[u32; 2]> {
        let triangles = self.triangles_at(p);
        let right = if k > 0 { k - 1 } else { triangles.len() - 1 };
        let sides = [triangles[k], triangles[right]];
        (!sides.contains(&NONE)).then_some(sides)
    }

    /// The pairs of triangles on both sides of edges from `p` to later vertices that are on one circle.
    fn ties(&self, p: u32) -> impl Iterator<Item = [u32; 2]> {
        let star = self.delaunay.star(p);
        let later = (0..star.neighbors.len()).filter(move |&k| star.neighbors[k] > p);
        later.filter_map(move |k| {
            let sides = self.sides(p, k)?;
            let [left, right] = sides.map(|t| &self.circles[t as usize]);
            if left.differs(right) {
                return None;
            }
            let corners = [star.neighbors[k], p, star.left(k)?, star.right(k)?];
            let [q, p, left, right] = corners.map(|v| self.delaunay.point(v));
            // The far apex is never inside; with the orientation turned around, this says that it is not outside.
            (!in_circle(q, p, left, right)).then_some(sides)
        })
    }

    /// How many of the first `count` half-edges from `p` separate inside and outside?
    fn flips_before(&self, p: u32, count: usize) -> usize {
        let first = &self.delaunay.star(p).neighbors[..count];
        let is_first =
            |&&(q, number): &&(u32, u32)| self.flips[number as usize] && first.contains(&q);
        self.curve.of(p).iter().filter(is_first).count()
    }
}

/// For each edge: does crossing it lead from the inside of a ring to its outside?
///
/// Open curves do not separate. Neither do rings with an edge that is not in the triangulation.
fn flipping(delaunay: &Delaunay, curve: &Adjacency, progress: &Progress) -> Result<Vec<bool>> {
    progress.enter(Stage::Trace, delaunay.points().len())?;
    let simple = |v: usize| match curve.of(v as u32) {
        [] => true,
        [(a, _), (b, _)] => {
            [a, b].iter().all(|end| delaunay.star(v as u32).neighbors.contains(end))
        }
        _ => false,
    };
    if all(delaunay.points().len(), progress, simple)? {
        return Ok(vec![true; curve.edges().len()]);
    }
    let traced = trace_edges(delaunay.points(), curve.edges(), progress)?;
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

/// For each vertex: is the place to the right of its first half-edge inside an odd number of rings?
///
/// Every vertex but the leftmost has a neighbor that comes before it from left to right, so steps to such neighbors lead
/// from each vertex to the leftmost, whose first half-edge has the outside to its right.
fn inside(mesh: &Mesh<'_>, progress: &Progress) -> Result<Vec<bool>> {
    let count = mesh.delaunay.points().len();
    let steps = map(count, (NONE, false), progress, |v| step_left(mesh, v as u32))?;
    let mut inside = vec![None; steps.len()];
    let mut path = Vec::new();
    for v in 0..steps.len() {
        if v % PACE == 0 {
            progress.advance(0)?;
        }
        let mut at = v;
        while inside[at].is_none() && steps[at].0 != NONE {
            path.push(at);
            at = steps[at].0 as usize;
        }
        let mut is_inside = inside[at].unwrap_or(false);
        inside[at] = Some(is_inside);
        while let Some(back) = path.pop() {
            is_inside ^= steps[back].1;
            inside[back] = Some(is_inside);
        }
    }
    Ok(inside.into_iter().map(|inside| inside == Some(true)).collect())
}

/// A neighbor of `v` before it from left to right, and whether only one of their first half-edges has the inside to its right.
///
/// Around a vertex the inside begins and ends at the edges that flip.
fn step_left(mesh: &Mesh<'_>, v: u32) -> (u32, bool) {
    let star = mesh.delaunay.star(v);
    let is_before =
        |q: u32| lexicographic(&mesh.delaunay.point(q), &mesh.delaunay.point(v)).is_lt();
    let Some(k) = star.neighbors.iter().position(|&q| is_before(q)) else { return (NONE, false) };
    let q = star.neighbors[k];
    // What is to the left of v → q is to the right of q → v.
    let flips =
        mesh.flips_before(v, k + 1) + mesh.flips_before(q, mesh.delaunay.star(q).position(v));
    (q, flips % 2 == 1)
}

/// For each triangle, the first of those on its circle that it is connected with.
fn one_for_each_circle(mesh: &Mesh<'_>, progress: &Progress) -> Result<Vec<u32>> {
    let ties = in_parts(mesh.delaunay.points().len(), GRAIN, progress, |vertices| {
        vertices.flat_map(|p| mesh.ties(p as u32)).collect::<Vec<_>>()
    })?;
    if ties.iter().all(Vec::is_empty) {
        return Ok((0..mesh.circles.len() as u32).collect());
    }
    let mut circles = Forest::new(mesh.circles.len());
    for part in ties {
        for [a, b] in part {
            circles.join(a, b);
        }
        progress.advance(0)?;
    }
    Ok(circles.into_roots())
}

/// An edge of the axis: its samples as rows, the triangles to their left and right, and whether it is inside.
type Found = ([u32; 2], [u32; 2], bool);

/// Vertices, or rows, that one task takes at a time.
const GRAIN: usize = 1 << 13;

/// The edges of the axis between each of `GRAIN` successive vertices and later rows, sorted by these.
///
/// Vertices are near each other in memory where they are in the plane; rows need not be.
#[derive(Default)]
struct Part {
    found: Vec<Found>,
    /// Where those of each vertex end.
    ends: Vec<u32>,
}

impl Part {
    fn new(mesh: &Mesh<'_>, first: usize, inside: &[bool], centers: &[u32]) -> Self {
        let mut part = Self::default();
        for (k, &inner) in inside.iter().enumerate() {
            let start = part.found.len();
            part.extend((first + k) as u32, mesh, inner, centers);
            part.found[start..].sort_unstable_by_key(|&(samples, _, _)| samples);
            part.ends.push(part.found.len() as u32);
        }
        part
    }

    /// `inner` tells whether the place to the right of the first half-edge from `p` is inside.
    fn extend(&mut self, p: u32, mesh: &Mesh<'_>, mut inner: bool, centers: &[u32]) {
        let rows = mesh.delaunay.rows();
        for (k, &q) in mesh.delaunay.star(p).neighbors.iter().enumerate() {
            if let Some(number) = mesh.curve.edge(p, q) {
                inner ^= mesh.flips[number as usize];
                continue;
            }
            let samples = [p, q].map(|vertex| rows[vertex as usize]);
            let Some(sides) = mesh.sides(p, k).filter(|_| samples[0] < samples[1]) else {
                continue;
            };
            let sides = sides.map(|t| centers[t as usize]);
            if sides[0] != sides[1] {
                self.found.push((samples, sides, inner));
            }
        }
    }

    /// The edges of its vertex number `k`.
    fn of(&self, k: usize) -> &[Found] {
        let start = if k > 0 { self.ends[k - 1] } else { 0 };
        &self.found[start as usize..self.ends[k] as usize]
    }
}

fn collect(
    mesh: &Mesh<'_>,
    inside: &[bool],
    centers: &[u32],
    progress: &Progress,
) -> Result<MedialAxis> {
    let parts = in_parts(inside.len(), GRAIN, progress, |vertices| {
        Part::new(mesh, vertices.start, &inside[vertices], centers)
    })?;
    let rays = rays(mesh);
    let origins: Vec<u32> =
        rays.iter().map(|&(_, p, _)| centers[mesh.triangles_at(p)[0] as usize]).collect();
    let (used, number) = numbers(mesh.circles.len(), &parts, &origins);
    let scale = mesh.delaunay.scale();
    let circle = |&t: &u32| &mesh.circles[t as usize];
    let vertices = used.par_iter().map(|t| circle(t).center.map(|x| x / scale)).collect();
    let radii = used.par_iter().map(|t| circle(t).radius / scale).collect();
    let found = by_rows(mesh.delaunay, &parts, progress)?;
    let axis = MedialAxis {
        vertices,
        radii,
        edges: column(&found, |&(_, sides, _)| sides.map(|t| number[t as usize])),
        samples: column(&found, |&(samples, _, _)| samples),
        inner: column(&found, |&(_, _, inner)| inner),
        ray_origins: origins.iter().map(|&t| number[t as usize]).collect(),
        ray_directions: rays.iter().map(|&(_, p, q)| outward(mesh.delaunay, (p, q))).collect(),
        ray_samples: rays.iter().map(|&(samples, _, _)| samples).collect(),
    };
    progress.advance(0)?;
    Ok(axis)
}

/// The edges of the hull that are not selected: rows, sorted, and vertices, counter-clockwise.
fn rays(mesh: &Mesh<'_>) -> Vec<([u32; 2], u32, u32)> {
    let delaunay = mesh.delaunay;
    let hull = delaunay.hull().iter().map(|&p| (p, delaunay.star(p).neighbors[0]));
    let mut rays: Vec<_> = hull
        .filter(|&(p, q)| mesh.curve.edge(p, q).is_none())
        .map(|(p, q)| (crate::edges::rows(delaunay, p, q), p, q))
        .collect();
    rays.sort_unstable();
    rays
}

/// The triangles whose centers are vertices of the axis, sorted, and for each triangle its number among them.
fn numbers(triangles: usize, parts: &[Part], origins: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let is_used: Vec<AtomicBool> =
        (0..triangles).into_par_iter().map(|_| AtomicBool::new(false)).collect();
    let mark = |t: u32| is_used[t as usize].store(true, Relaxed);
    let found = parts.par_iter().flat_map_iter(|part| &part.found);
    found.for_each(|&(_, sides, _)| sides.into_iter().for_each(mark));
    origins.iter().copied().for_each(mark);
    let (mut used, mut number) = (Vec::new(), Vec::with_capacity(triangles));
    for (t, is_used) in is_used.into_iter().enumerate() {
        number.push(used.len() as u32);
        if is_used.into_inner() {
            used.push(t as u32);
        }
    }
    (used, number)
}

/// All edges of the axis, sorted by their samples, those of `GRAIN` successive rows at a time.
fn by_rows(delaunay: &Delaunay, parts: &[Part], progress: &Progress) -> Result<Vec<Vec<Found>>> {
    let mut vertex = vertices_of_rows(delaunay);
    for &[row, _] in delaunay.duplicates() {
        vertex[row as usize] = NONE;
    }
    let of_rows = |vertices: &[u32]| {
        let mut found = Vec::with_capacity(3 * vertices.len());
        for v in vertices.iter().map(|&v| v as usize).filter(|&v| v != NONE as usize) {
            found.extend_from_slice(parts[v / GRAIN].of(v % GRAIN));
        }
        found
    };
    in_parts(vertex.len(), GRAIN, progress, |rows| of_rows(&vertex[rows]))
}

/// A field of all edges of the axis.
fn column<T: Copy + Default + Send>(
    found: &[Vec<Found>],
    field: impl Fn(&Found) -> T + Sync,
) -> Vec<T> {
    let mut column = vec![T::default(); found.iter().map(Vec::len).sum()];
    let targets = split(&mut column, found.iter().map(Vec::len));
    found.par_iter().zip(targets).for_each(|(part, target)| {
        part.iter().zip(target).for_each(|(found, value)| *value = field(found));
    });
    column
}

/// The circle through the corners of a triangle, in the scale of the triangulation.
#[derive(Debug, Clone, Copy, Default)]
struct Circle {
    center: Point,
    radius: f64,
    /// A bound on the distance from the center to the true one.
    error: f64,
}

/// Where a center is known to this part of its radius, floating point is good enough.
///
/// A flat triangle's center depends on the rounding of the samples themselves by more than this.
const ACCURACY: f64 = 1e-7;

impl Circle {
    fn new(delaunay: &Delaunay, triangle: &[u32; 3]) -> Self {
        let corners = triangle.map(|vertex| delaunay.point(vertex));
        let Center { at, error } = Center::estimate(corners, corners[0]);
        let is_known = error <= ACCURACY * length(at);
        let from = if is_known { at } else { circumcenter(corners) };
        let center = [corners[0][0] + from[0], corners[0][1] + from[1]];
        let rounding = ROUNDING * (center[0].abs() + center[1].abs());
        let error = if is_known { error + rounding } else { f64::INFINITY };
        Self { center, radius: length(from), error }
    }

    /// Are the centers certainly not the same?
    fn differs(&self, other: &Self) -> bool {
        let step = sub(self.center, other.center);
        step[0].abs().max(step[1].abs()) > 1.001 * (self.error + other.error)
    }
}

/// The unit normal to the right of p → q.
fn outward(delaunay: &Delaunay, (p, q): (u32, u32)) -> Point {
    let [x, y] = sub(delaunay.point(q), delaunay.point(p));
    let length = libm::hypot(x, y);
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
        axis.radii.push(libm::hypot(step[0], step[1]) / 2.0 / delaunay.scale());
        axis.ray_origins.extend([number; 2]);
        axis.ray_directions.extend([outward(delaunay, (p, q)), outward(delaunay, (q, p))]);
        axis.ray_samples.extend([samples; 2]);
    }
    axis
}
