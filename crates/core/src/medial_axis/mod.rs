//! The medial axis of samples and edges: the paper's anti-crust (§11, Figure 15).
//!
//! The Voronoi edges whose dual Delaunay edge is not selected. Its part inside the rings is told from the part outside by
//! a flood over the vertices, which flips where it crosses a ring.

mod circles;
mod far;
mod flips;

use crate::adjacency::{Adjacency, vertices_of_rows};
use crate::delaunay::{Delaunay, NONE};
use crate::error::Result;
use crate::exact::predicates::in_circle;
use crate::forest::Forest;
use crate::memory;
use crate::parts::{each, in_parts, map, split};
use crate::point::{Point, sub};
use crate::progress::{PACE, Progress, Stage};
use crate::rows::OfVertices;
use circles::Circles;
pub use far::MedialAxis;
use flips::flipping;
use std::cell::OnceCell;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The Voronoi edges whose dual is not an edge of `curve`.
///
/// Voronoi edges of length zero, between triangles on exactly one circle, are left out and their ends are one vertex. Where
/// all points lie on one line, an edge that is not selected has two opposite rays from its midpoint as its dual.
/// Linear time but for the sort of the answer.
///
/// # Errors
/// A cancelled `progress`.
pub fn medial_axis(
    delaunay: &Delaunay,
    curve: &Adjacency,
    progress: &Progress,
) -> Result<MedialAxis> {
    memory::check(delaunay.points().len(), BYTES)?;
    let first = delaunay.first_triangles();
    if first.last() == Some(&0) {
        return Ok(of_line(delaunay, curve));
    }
    let flips = flipping(delaunay, curve, progress)?;
    // The vertices for circles, for ties, for steps to the left, for edges and twice in the order of the rows.
    progress.enter(Stage::Axis, 6 * delaunay.points().len())?;
    let circles = Circles::new(delaunay, &first, progress)?;
    let wedges = delaunay.wedge_triangles(&first, progress);
    drop(first);
    let marks = marks(delaunay, curve, &flips, progress);
    progress.advance(0)?;
    let mesh = Mesh { delaunay, wedges: &wedges, marks: &marks };
    let centers = one_for_each_circle(&mesh, &circles, progress)?;
    let inside = inside(&mesh, progress)?;
    let found = OfVertices::new(inside.len(), 2, progress, |p, found| {
        append(&mesh, p, inside[p as usize], &centers, found);
    })?;
    let rays = rays(&mesh, &centers);
    drop((centers, wedges, marks));
    let axis = collect(delaunay, found, rays, circles, progress)?;
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
    /// The triangle to the left of each half-edge.
    wedges: &'a [u32],
    /// What is known of each half-edge.
    marks: &'a [Mark],
}

/// A half-edge among those from its vertex.
#[derive(Debug, Clone, Copy, Default)]
struct Mark {
    /// Is it an edge of the curves?
    is_chosen: bool,
    /// Do an odd number of those before it, or it itself, separate inside and outside?
    is_odd: bool,
}

impl Mesh<'_> {
    /// The triangles to the left of the half-edges from `p`.
    fn triangles_at(&self, p: u32) -> &[u32] {
        &self.wedges[self.half_edges(p)]
    }

    /// The half-edges from `p`.
    fn marks_at(&self, p: u32) -> &[Mark] {
        &self.marks[self.half_edges(p)]
    }

    fn half_edges(&self, p: u32) -> Range<usize> {
        let start = self.delaunay.stars().offset(p);
        start..start + self.delaunay.star(p).neighbors.len()
    }

    /// The pairs of triangles on both sides of edges from `p` to later vertices that are on one circle.
    fn ties(&self, p: u32, circles: &Circles, ties: &mut Vec<[u32; 2]>) {
        let (star, triangles) = (self.delaunay.star(p), self.triangles_at(p));
        for (k, &q) in star.neighbors.iter().enumerate().filter(|&(_, &q)| q > p) {
            let Some(sides) = sides(triangles, k) else { continue };
            if circles.differ(sides[0], sides[1]) {
                continue;
            }
            let (Some(left), Some(right)) = (star.left(k), star.right(k)) else { continue };
            let [q, p, left, right] = [q, p, left, right].map(|v| self.delaunay.point(v));
            // The far apex is never inside; with the orientation turned around, this says that it is not outside.
            if !in_circle(q, p, left, right) {
                ties.push(sides);
            }
        }
    }
}

/// Of the triangles at a vertex those to the left and to the right of its half-edge `k`.
fn sides(triangles: &[u32], k: usize) -> Option<[u32; 2]> {
    let right = if k > 0 { k - 1 } else { triangles.len() - 1 };
    let sides = [triangles[k], triangles[right]];
    (!sides.contains(&NONE)).then_some(sides)
}

/// The marks of all half-edges; `flips` tells which edges of the curves separate inside and outside.
fn marks(delaunay: &Delaunay, curve: &Adjacency, flips: &[bool], progress: &Progress) -> Vec<Mark> {
    delaunay.stars().map(Mark::default(), progress, |p, marks| {
        let mut is_odd = false;
        for (mark, &q) in marks.iter_mut().zip(delaunay.star(p).neighbors) {
            let number = curve.edge(p, q);
            is_odd ^= number.is_some_and(|number| flips[number as usize]);
            *mark = Mark { is_chosen: number.is_some(), is_odd };
        }
    })
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
    let at = mesh.delaunay.point(v);
    let is_before = |q: u32| {
        let [x, y] = mesh.delaunay.point(q);
        x < at[0] || x == at[0] && y < at[1]
    };
    let Some(k) = star.neighbors.iter().position(|&q| is_before(q)) else { return (NONE, false) };
    let q = star.neighbors[k];
    let back = mesh.delaunay.position(q, v).expect("stars are symmetric");
    // What is to the left of v → q is to the right of q → v.
    let right = back.checked_sub(1).is_some_and(|before| mesh.marks_at(q)[before].is_odd);
    (q, mesh.marks_at(v)[k].is_odd != right)
}

/// For each triangle, the first of those on its circle that it is connected with.
fn one_for_each_circle(
    mesh: &Mesh<'_>,
    circles: &Circles,
    progress: &Progress,
) -> Result<Vec<u32>> {
    let ties = in_parts(mesh.delaunay.points().len(), GRAIN, progress, |vertices| {
        let mut ties = Vec::new();
        vertices.for_each(|p| mesh.ties(p as u32, circles, &mut ties));
        ties
    })?;
    if ties.iter().all(Vec::is_empty) {
        return Ok((0..circles.radii.len() as u32).collect());
    }
    let mut forest = Forest::new(circles.radii.len());
    for part in ties {
        for [a, b] in part {
            forest.join(a, b);
        }
        progress.advance(0)?;
    }
    Ok(forest.into_roots())
}

/// Vertices that one task takes at a time.
const GRAIN: usize = 1 << 13;

/// An edge of the axis: its samples as rows, the vertices to their left and right, and whether it is inside.
type Found = ([u32; 2], [u32; 2], bool);

/// Append the edges of the axis between `p` and later rows, sorted by these, with triangles as their vertices.
///
/// `inner` tells whether the place to the right of the first half-edge from `p` is inside.
fn append(mesh: &Mesh<'_>, p: u32, inner: bool, centers: &[u32], found: &mut Vec<Found>) {
    let (rows, triangles, start) = (mesh.delaunay.rows(), mesh.triangles_at(p), found.len());
    let half_edges = mesh.delaunay.star(p).neighbors.iter().zip(mesh.marks_at(p)).enumerate();
    for (k, (&q, mark)) in half_edges.filter(|(_, (_, mark))| !mark.is_chosen) {
        let samples = [p, q].map(|vertex| rows[vertex as usize]);
        if samples[0] > samples[1] {
            continue;
        }
        let Some(sides) = sides(triangles, k) else { continue };
        let sides = sides.map(|t| centers[t as usize]);
        if sides[0] != sides[1] {
            found.push((samples, sides, inner != mark.is_odd));
        }
    }
    found[start..].sort_unstable_by_key(|&(samples, _, _)| samples);
}

/// The axis of what was `found` and of `rays`.
fn collect(
    delaunay: &Delaunay,
    mut found: OfVertices<Found>,
    mut rays: Vec<Ray>,
    circles: Circles,
    progress: &Progress,
) -> Result<MedialAxis> {
    let used = used(circles.radii.len(), &found, &rays);
    progress.advance(0)?;
    renumber(&mut found, &mut rays, &used);
    let (vertices, radii) = circles.used(&used, delaunay.scale());
    let count = found.parts().iter().map(|part| part.len()).sum();
    let (mut edges, mut samples) = (vec![[0; 2]; count], vec![[0; 2]; count]);
    let mut inner = vec![false; count];
    found.by_rows(
        delaunay,
        progress,
        |counts| {
            let lengths = || counts.iter().copied();
            let ends = split(&mut edges, lengths()).into_iter().zip(split(&mut samples, lengths()));
            ends.zip(split(&mut inner, lengths())).collect()
        },
        |((edges, samples), inner), found| {
            found.iter().zip(edges).for_each(|(found, edge)| *edge = found.1);
            found.iter().zip(samples).for_each(|(found, pair)| *pair = found.0);
            found.iter().zip(inner).for_each(|(found, is_inner)| *is_inner = found.2);
        },
    )?;
    Ok(MedialAxis {
        vertices,
        radii,
        edges,
        samples,
        inner,
        ray_origins: rays.iter().map(|ray| ray.origin).collect(),
        ray_directions: rays.iter().map(|ray| outward(delaunay, ray.side)).collect(),
        ray_samples: rays.iter().map(|ray| ray.samples).collect(),
    })
}

/// An edge of the hull that is not selected.
struct Ray {
    /// Its ends as rows.
    samples: [u32; 2],
    /// Its ends as vertices, counter-clockwise.
    side: (u32, u32),
    /// The triangle at it.
    origin: u32,
}

/// The rays, sorted by their samples; their origins are one for each circle.
fn rays(mesh: &Mesh<'_>, centers: &[u32]) -> Vec<Ray> {
    let delaunay = mesh.delaunay;
    let open = delaunay.hull().iter().filter(|&&p| !mesh.marks_at(p)[0].is_chosen);
    let mut rays: Vec<_> = open
        .map(|&p| (p, delaunay.star(p).neighbors[0]))
        .map(|(p, q)| Ray {
            samples: crate::edges::rows(delaunay, p, q),
            side: (p, q),
            origin: centers[mesh.triangles_at(p)[0] as usize],
        })
        .collect();
    rays.sort_unstable_by_key(|ray| (ray.samples, ray.side));
    rays
}

/// Which triangles' centers are vertices of the axis?
fn used(triangles: usize, found: &OfVertices<Found>, rays: &[Ray]) -> Vec<bool> {
    let mut is_used = Vec::new();
    is_used.resize_with(triangles, || AtomicBool::new(false));
    let mark = |t: u32| is_used[t as usize].store(true, Relaxed);
    each(found.parts(), |_, part| {
        for &(_, [left, right], _) in part {
            mark(left);
            mark(right);
        }
    });
    for ray in rays {
        mark(ray.origin);
    }
    is_used.into_iter().map(AtomicBool::into_inner).collect()
}

/// Number the triangles that are `used`; without ties all are.
fn renumber(found: &mut OfVertices<Found>, rays: &mut [Ray], used: &[bool]) {
    if used.iter().all(|&is_used| is_used) {
        return;
    }
    let mut before = 0;
    let number = |&is_used: &bool| {
        before += u32::from(is_used);
        before - u32::from(is_used)
    };
    let number: Vec<u32> = used.iter().map(number).collect();
    each(found.parts_mut(), |_, part| {
        for (_, sides, _) in part {
            *sides = sides.map(|t| number[t as usize]);
        }
    });
    for ray in rays {
        ray.origin = number[ray.origin as usize];
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
