//! The crust, from one triangulation.
//!
//! N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve Reconstruction", Graphical
//! Models and Image Processing 60 (1998), section 2, "Alternate Definition". The paper triangulates the points again,
//! together with their Voronoi vertices; here a disk is found, or shown not to exist, by visiting the few Voronoi cells
//! that the smallest candidate meets.

use super::one_step_crust;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, select};
use crate::error::Result;
use crate::pencil::{Circle, Disk, Pencil, Triangle};
use crate::point::{Point, dot, sub};
use crate::progress::Progress;
use std::cmp::Ordering::{Equal, Greater, Less};
use std::collections::HashSet;

/// The edges with a disk that touches both ends and holds, in its interior, no point and no Voronoi vertex.
///
/// Ties keep the edge. O(n log n) on any data met in practice: it costs one triangulation and little more.
///
/// # Errors
/// A cancelled `progress`.
pub fn crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    select(delaunay, progress, Visit::default, |visit, edge| {
        one_step_crust::is_in(delaunay, edge)
            && (smallest_disk_is_empty(delaunay, edge) || search(delaunay, edge, visit))
    })
}

/// Is the disk with diameter p q certainly empty? A quick test, for most of the edges of a curve.
///
/// If the whole disk is nearer to each end than to any other neighbor of that end, then it lies in the cells of p and q,
/// and no Voronoi vertex is inside. With s the end, d the chord from it and g the vector to a neighbor this reads
/// |d| |g| ≤ g·(g − d).
#[inline]
fn smallest_disk_is_empty(delaunay: &Delaunay, edge: Edge) -> bool {
    stays_in_cell(delaunay, edge.p, edge.q) && stays_in_cell(delaunay, edge.q, edge.p)
}

#[inline]
fn stays_in_cell(delaunay: &Delaunay, s: u32, end: u32) -> bool {
    /// More than all relative roundings below.
    const MARGIN: f64 = 1.0 + 1e-12;
    let point = delaunay.point(s);
    let chord = sub(delaunay.point(end), point);
    let length = dot(chord, chord) * MARGIN;
    delaunay.star(s).neighbors.iter().all(|&neighbor| {
        let g = sub(delaunay.point(neighbor), point);
        let room = dot(g, sub(g, chord));
        neighbor == end || (room > 0.0 && length * dot(g, g) < room * room)
    })
}

/// Look for a disk, the smallest first; each Voronoi vertex found inside rules out a part of the pencil.
fn search(delaunay: &Delaunay, edge: Edge, visit: &mut Visit) -> bool {
    let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
    let pencil = Pencil::new(p, q);
    // The angles at the edge's own apexes are acute, so each center is on the side of its triangle.
    let triangle = |corners: [u32; 3]| corners.map(|vertex| delaunay.point(vertex));
    let mut high = edge.left.map(|apex| triangle([edge.p, edge.q, apex]));
    let mut low = edge.right.map(|apex| triangle([edge.q, edge.p, apex]));
    while let Some(circle) = pencil.smallest_between(low, high) {
        let Some(triangle) = visit.find(delaunay, edge, &pencil, circle) else { return true };
        match pencil.side(triangle) {
            Greater => high = Some(triangle),
            Less => low = Some(triangle),
            // Between p and q, inside all disks.
            Equal => return false,
        }
    }
    false
}

/// A walk over the Voronoi cells that meet a disk, and its memory.
#[derive(Default)]
struct Visit {
    cells: Vec<u32>,
    many: HashSet<u32>,
    near: Vec<bool>,
}

/// Cells up to which a list is searched faster than a hash table.
const FEW: usize = 24;

impl Visit {
    /// A triangle whose circumcenter is strictly inside `circle`, if there is one.
    ///
    /// Visits the cells of p and q and crosses each Voronoi edge that may meet the disk. The disk is connected, so this
    /// reaches every cell that meets it, and with them every Voronoi vertex inside.
    fn find(&mut self, delaunay: &Delaunay, edge: Edge, pencil: &Pencil, circle: Circle) -> Option<Triangle> {
        let disk = pencil.disk(circle);
        self.cells.clear();
        self.many.clear();
        self.cells.extend([edge.p, edge.q]);
        let mut next = 0;
        while next < self.cells.len() {
            let found = self.search_cell(delaunay, self.cells[next], pencil, &disk);
            if found.is_some() {
                return found;
            }
            next += 1;
        }
        None
    }

    fn search_cell(&mut self, delaunay: &Delaunay, s: u32, pencil: &Pencil, disk: &Disk) -> Option<Triangle> {
        let star = delaunay.star(s);
        let site = delaunay.point(s);
        self.near.clear();
        self.near.extend(star.neighbors.iter().map(|&neighbor| {
            may_cross(disk, pencil.p, site, delaunay.point(neighbor))
        }));
        for k in 0..star.neighbors.len() {
            if !self.near[k] {
                continue;
            }
            self.add(star.neighbors[k]);
            let after = if k + 1 < star.neighbors.len() { k + 1 } else { 0 };
            // A Voronoi vertex is on two bisectors of its cell, so both must meet the disk.
            if let Some(next) = star.left(k).filter(|_| self.near[after]) {
                let triangle = [site, delaunay.point(star.neighbors[k]), delaunay.point(next)];
                if pencil.holds(disk, triangle) {
                    return Some(triangle);
                }
            }
        }
        None
    }

    fn add(&mut self, cell: u32) {
        let is_new = if self.cells.len() <= FEW {
            !self.cells.contains(&cell)
        } else {
            if self.many.is_empty() {
                self.many.extend(&self.cells);
            }
            self.many.insert(cell)
        };
        if is_new {
            self.cells.push(cell);
        }
    }
}

/// May the bisector of `site` and `neighbor` meet the disk? False only if all of it is certainly nearer to `site`.
#[inline]
fn may_cross(disk: &Disk, p: Point, site: Point, neighbor: Point) -> bool {
    let g = sub(neighbor, site);
    let length = dot(g, g).sqrt();
    let center = sub(disk.center, sub(site, p));
    let reach = (center[0].abs() + center[1].abs() + disk.radius + length) * 1e-14 + 2.0 * disk.error;
    // Written so that an unknown (not a number) counts as crossing.
    !(dot(center, g) + (disk.radius + reach) * length <= length * length / 2.0)
}
