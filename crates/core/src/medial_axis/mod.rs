//! The medial axis of samples and edges: the paper's anti-crust (§11, Figure 15).
//!
//! The Voronoi edges whose dual Delaunay edge is not selected. Its part inside the rings is told from the part outside by
//! a flood over the vertices, which flips where it crosses a ring.

mod circles;
mod far;
mod flips;
mod inside;
mod mesh;

use crate::adjacency::{Adjacency, vertices_of_rows};
use crate::delaunay::Delaunay;
use crate::edges::sort_by;
use crate::error::Result;
use crate::forest::Forest;
use crate::memory;
use crate::parts::{GRAIN, each, in_parts};
use crate::point::{Point, sub};
use crate::progress::{Progress, Stage};
use circles::Circles;
pub use far::{Edge, MedialAxis};
use flips::flipping;
use inside::inside;
use mesh::Mesh;
use std::cell::OnceCell;
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
    // The vertices for circles, for steps to the left and for edges.
    progress.enter(Stage::Axis, 3 * delaunay.points().len())?;
    let circles = Circles::new(delaunay, &first, progress)?;
    let mesh = Mesh::new(delaunay, curve, &first, &flips, progress);
    drop((first, flips));
    progress.advance(0)?;
    let inside = inside(&mesh, progress)?;
    let found = in_parts(inside.len(), GRAIN, progress, |vertices| {
        let mut found = Found { edges: Vec::with_capacity(2 * vertices.len()), ties: Vec::new() };
        vertices.for_each(|p| found.append(&mesh, p as u32, inside[p]));
        found
    })?;
    let rays = rays(&mesh);
    drop((mesh, inside));
    let are_finite = circles.are_finite;
    let axis = collect(delaunay, found, rays, circles, progress)?;
    Ok(if are_finite { axis } else { far::at_infinity(axis, place_of(delaunay)) })
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

/// What some successive vertices have.
struct Found {
    /// The edges of the axis, with triangles as their ends.
    edges: Vec<Edge>,
    /// Pairs of adjacent triangles on one circle.
    ties: Vec<[u32; 2]>,
}

impl Found {
    /// Append what belongs to the edges from `p` to later vertices.
    ///
    /// `is_inside` tells whether the place to the right of the first half-edge from `p` is inside.
    fn append(&mut self, mesh: &Mesh<'_>, p: u32, is_inside: bool) {
        let (star, own) = (mesh.delaunay.star(p), mesh.triangles_from(p));
        let marks = mesh.marks_at(p);
        for (k, &q) in star.neighbors.iter().enumerate().filter(|&(_, &q)| q > p) {
            let (Some(left), Some(right)) = (star.left(k), star.right(k)) else { continue };
            let is_tie = mesh.is_tie([p, q], [left, right]);
            if marks[k].is_chosen && !is_tie {
                continue;
            }
            let before = k.checked_sub(1).unwrap_or(own.len() - 1);
            let ends = [
                if left > p { own[k] } else { mesh.triangle(left, p) },
                if right > p { own[before] } else { mesh.triangle(right, q) },
            ];
            if is_tie {
                // An edge of length zero, and all that two triangles on one circle have between them.
                self.ties.push(ends);
            } else {
                let samples = [p, q].map(|vertex| mesh.delaunay.rows()[vertex as usize]);
                self.edges.push(Edge::new(samples, ends, is_inside != marks[k].is_odd));
            }
        }
    }
}

/// The axis of what was `found` and of `rays`, which start at triangles.
fn collect(
    delaunay: &Delaunay,
    found: Vec<Found>,
    mut rays: Vec<Ray>,
    mut circles: Circles,
    progress: &Progress,
) -> Result<MedialAxis> {
    let (mut edges, ties): (Vec<_>, Vec<_>) =
        found.into_iter().map(|found| (found.edges, found.ties)).unzip();
    if ties.iter().any(|ties| !ties.is_empty()) {
        let roots = one_for_each_circle(circles.radii.len(), &ties, progress)?;
        renumber(&mut edges, &mut rays, &roots);
    }
    let used = used(circles.radii.len(), &edges, &rays);
    progress.advance(0)?;
    // Without ties nearly always.
    if !used.iter().all(|&is_used| is_used) {
        renumber(&mut edges, &mut rays, &numbers(&used));
        circles.keep(&used);
    }
    let edges = sort_by(&edges, delaunay.input_len(), |edge: &Edge| edge.samples, progress)?;
    Ok(MedialAxis {
        vertices: circles.centers,
        radii: circles.radii,
        edges,
        ray_origins: rays.iter().map(|ray| ray.origin).collect(),
        ray_directions: rays.iter().map(|ray| outward(delaunay, ray.side)).collect(),
        ray_samples: rays.iter().map(|ray| ray.samples).collect(),
    })
}

/// For each of `count` triangles, the first of those on its circle that it is connected with.
fn one_for_each_circle(
    count: usize,
    ties: &[Vec<[u32; 2]>],
    progress: &Progress,
) -> Result<Vec<u32>> {
    let mut forest = Forest::new(count);
    for part in ties {
        for &[a, b] in part {
            forest.join(a, b);
        }
        progress.advance(0)?;
    }
    Ok(forest.into_roots())
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

/// The rays, sorted by their samples.
fn rays(mesh: &Mesh<'_>) -> Vec<Ray> {
    let delaunay = mesh.delaunay;
    let open = delaunay.hull().iter().filter(|&&p| !mesh.marks_at(p)[0].is_chosen);
    let mut rays: Vec<_> = open
        .map(|&p| (p, delaunay.star(p).neighbors[0]))
        .map(|(p, q)| Ray {
            samples: crate::edges::rows(delaunay, p, q),
            side: (p, q),
            origin: mesh.triangle_at_hull(p),
        })
        .collect();
    rays.sort_unstable_by_key(|ray| (ray.samples, ray.side));
    rays
}

/// Which of so many triangles' centers are vertices of the axis?
fn used(triangles: usize, edges: &[Vec<Edge>], rays: &[Ray]) -> Vec<bool> {
    let mut is_used = Vec::new();
    is_used.resize_with(triangles, || AtomicBool::new(false));
    let mark = |t: u32| is_used[t as usize].store(true, Relaxed);
    each(edges.iter().collect(), |_, part| part.iter().flat_map(|edge| edge.ends).for_each(mark));
    for ray in rays {
        mark(ray.origin);
    }
    is_used.into_iter().map(AtomicBool::into_inner).collect()
}

/// How many triangles that are `used` come before each.
fn numbers(used: &[bool]) -> Vec<u32> {
    let mut before = 0;
    let number = |&is_used: &bool| {
        before += u32::from(is_used);
        before - u32::from(is_used)
    };
    used.iter().map(number).collect()
}

/// Let the ends be those that `numbers` has for them.
fn renumber(edges: &mut [Vec<Edge>], rays: &mut [Ray], numbers: &[u32]) {
    each(edges.iter_mut().collect(), |_, part| {
        for edge in part {
            edge.ends = edge.ends.map(|t| numbers[t as usize]);
        }
    });
    for ray in rays {
        ray.origin = numbers[ray.origin as usize];
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
