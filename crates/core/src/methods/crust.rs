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
use crate::pencil::{Circle, Disk, Pencil, Vertex};
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;
use crate::sign::{self, Form, Number};
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

/// Does the disk with diameter p q lie in the Voronoi cells of p and q? Then no Voronoi vertex is inside.
///
/// A quick test that settles most edges of a curve, and the ties of a lattice.
#[inline]
fn smallest_disk_is_empty(delaunay: &Delaunay, edge: Edge) -> bool {
    half_stays_in_cell(delaunay, edge.p, edge.q) && half_stays_in_cell(delaunay, edge.q, edge.p)
}

/// Does the half of the disk with diameter `s` `end` that is nearer to `s` lie in the cell of `s`?
#[inline]
fn half_stays_in_cell(delaunay: &Delaunay, s: u32, end: u32) -> bool {
    let (site, other) = (delaunay.point(s), delaunay.point(end));
    delaunay
        .star(s)
        .neighbors
        .iter()
        .all(|&neighbor| neighbor == end || has_room(site, other, delaunay.point(neighbor)))
}

/// Is the half of the disk with diameter `s` `end` that is nearer to `s` nowhere nearer to `neighbor`?
///
/// With d the diameter from s, and g the vector to the neighbor, in the direction of g the half disk reaches |d×g| / 2 beyond
/// the middle, d·g / 2, if g points forward, and |d| |g| / 2 if backward; the cell ends at |g|² / 2. Where the direction is in
/// doubt the backward form serves, for it asks for no less.
#[inline]
fn has_room(s: Point, end: Point, neighbor: Point) -> bool {
    /// More than all relative roundings below.
    const DOUBT: f64 = 1e-14;
    let (d, g) = (sub(end, s), sub(neighbor, s));
    let (far, along, aside) = (dot(g, g), dot(d, g), cross(d, g));
    let size = far + along.abs() + aside.abs();
    if along > DOUBT * size {
        let room = far - along - aside.abs();
        return room > DOUBT * size
            || room > -DOUBT * size && sign::exact_sign(&RoomAhead, s, &[end, neighbor]) != Less;
    }
    let room = far - along;
    let excess = room * room - dot(d, d) * far;
    excess > DOUBT * size * size
        || excess > -DOUBT * size * size
            && sign::exact_sign(&RoomBehind, s, &[end, neighbor]) != Less
}

/// (|g|² − d·g)² − |d×g|², whose first root is positive.
struct RoomAhead;

impl Form<2> for RoomAhead {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 5
    }
    fn value<T: Number>(&self, [d, g]: &[[T; 2]; 2]) -> T {
        let room = sign::dot(g, &sign::difference(g, d));
        let aside = sign::cross(d, g);
        room.times(&room).minus(&aside.times(&aside))
    }
}

/// (|g|² − d·g)² − |d|² |g|², whose first root is positive.
struct RoomBehind;

impl Form<2> for RoomBehind {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 5
    }
    fn value<T: Number>(&self, [d, g]: &[[T; 2]; 2]) -> T {
        let room = sign::dot(g, &sign::difference(g, d));
        room.times(&room).minus(&sign::dot(d, d).times(&sign::dot(g, g)))
    }
}

/// Look for a disk, the smallest first; each Voronoi vertex found inside rules out a part of the pencil.
fn search(delaunay: &Delaunay, edge: Edge, visit: &mut Visit) -> bool {
    let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
    let pencil = Pencil::new(p, q);
    // The angles at the edge's own apexes are acute, so each center is on the side of its triangle.
    let vertex = |corners: [u32; 3]| pencil.vertex(corners.map(|vertex| delaunay.point(vertex)));
    let mut high = edge.left.map(|apex| vertex([edge.p, edge.q, apex]));
    let mut low = edge.right.map(|apex| vertex([edge.q, edge.p, apex]));
    while let Some(circle) = pencil.smallest_between(low, high) {
        let Some(found) = visit.find(delaunay, edge, &pencil, circle) else { return true };
        match pencil.side(&found) {
            Greater => high = Some(found),
            Less => low = Some(found),
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
    /// A Voronoi vertex strictly inside `circle`, if there is one.
    ///
    /// Visits the cells of p and q and crosses each Voronoi edge that may meet the disk. The disk is connected, so this
    /// reaches every cell that meets it, and with them every Voronoi vertex inside.
    fn find(
        &mut self,
        delaunay: &Delaunay,
        edge: Edge,
        pencil: &Pencil,
        circle: Circle,
    ) -> Option<Vertex> {
        let disk = pencil.disk(circle);
        self.cells.clear();
        self.many.clear();
        self.cells.extend([edge.p, edge.q]);
        let mut next = 0;
        while next < self.cells.len() {
            let cell = self.cells[next];
            let other = [edge.q, edge.p].get(next).map(|&end| delaunay.point(end));
            let part = Part { disk: &disk, origin: pencil.p, site: delaunay.point(cell), other };
            let found = self.search_cell(delaunay, cell, pencil, &part);
            if found.is_some() {
                return found;
            }
            next += 1;
        }
        None
    }

    fn search_cell(
        &mut self,
        delaunay: &Delaunay,
        cell: u32,
        pencil: &Pencil,
        part: &Part<'_>,
    ) -> Option<Vertex> {
        let star = delaunay.star(cell);
        let near = |&neighbor: &u32| part.may_reach(delaunay.point(neighbor));
        self.near.clear();
        self.near.extend(star.neighbors.iter().map(near));
        for k in (0..star.neighbors.len()).filter(|&k| self.near[k]) {
            let after = if k + 1 < star.neighbors.len() { k + 1 } else { 0 };
            // A Voronoi vertex is on two bisectors of its cell, so both must meet the disk.
            if let Some(next) = star.left(k).filter(|_| self.near[after]) {
                let [a, b] = [star.neighbors[k], next].map(|vertex| delaunay.point(vertex));
                let vertex = pencil.vertex([part.site, a, b]);
                if pencil.holds(part.disk, &vertex) {
                    return Some(vertex);
                }
            }
        }
        for k in 0..star.neighbors.len() {
            if self.near[k] {
                self.add(star.neighbors[k]);
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

/// The part of a disk that can be in the cell of `site`: all of it, or in the cells of p and q the nearer half.
struct Part<'a> {
    disk: &'a Disk,
    /// What the disk's center is relative to.
    origin: Point,
    site: Point,
    /// The other end of the edge, if `site` is one.
    other: Option<Point>,
}

impl Part<'_> {
    /// Can a point of this part be nearer to `neighbor` than to the site? False only if certainly none is.
    #[inline]
    fn may_reach(&self, neighbor: Point) -> bool {
        let g = sub(neighbor, self.site);
        let far = dot(g, g);
        let length = far.sqrt();
        let center = sub(self.disk.center, sub(self.site, self.origin));
        let size = center[0].abs() + center[1].abs() + self.disk.radius + length;
        let doubt = (1e-14 * size + 2.0 * self.disk.error) * length;
        let reach = dot(center, g) + self.disk.radius * self.width(g, length) + doubt;
        // An unknown (not a number) counts as reaching.
        reach.is_nan() || reach > far / 2.0
    }

    /// How far this part of a disk of radius 1 reaches from the center in the direction of `g`, times its length.
    #[inline]
    fn width(&self, g: Point, length: f64) -> f64 {
        let Some(other) = self.other else { return length };
        let d = sub(other, self.site);
        // Where the direction is in doubt the whole disk serves, for it reaches no less.
        if dot(d, g) <= 1e-14 * length * (d[0].abs() + d[1].abs()) {
            return length;
        }
        cross(d, g).abs() / dot(d, d).sqrt()
    }
}
