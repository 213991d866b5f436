//! The crust, from one triangulation.
//!
//! N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve Reconstruction", Graphical
//! Models and Image Processing 60 (1998), section 2, "Alternate Definition". The paper triangulates the points again,
//! together with their Voronoi vertices; here a disk is found, or shown not to exist, by visiting the few Voronoi cells
//! that the smallest candidate meets.

use super::one_step_crust;
use super::visit::{TooLong, Visit};
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, select, sort};
use crate::error::Result;
use crate::exact::angle::Angle;
use crate::exact::filter::{self, UNDERFLOW};
use crate::exact::pencil::{Circle, Pencil, Vertex};
use crate::exact::sign::{self, Form, Number};
use crate::parts::{GRAIN, in_parts};
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;
use crate::voronoi::VoronoiVertices;
use std::cmp::Ordering::{Equal, Greater, Less};
use std::sync::{Mutex, PoisonError};

/// The edges with a disk that touches both ends and holds, in its interior, no point and no Voronoi vertex.
///
/// Ties keep the edge. O(n log n) on any data met in practice: it costs one triangulation and little more.
///
/// # Errors
/// A cancelled `progress`.
pub fn crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let late = Mutex::new(Vec::new());
    let kept = select(delaunay, progress, Visit::limited, |visit, edge| {
        one_step_crust::is_in(delaunay, edge)
            && find_disk(delaunay, edge, visit).map_or_else(
                |TooLong| {
                    late.lock().unwrap_or_else(PoisonError::into_inner).push(edge);
                    false
                },
                |verdict| verdict.is_in(),
            )
    })?;
    let late = late.into_inner().unwrap_or_else(PoisonError::into_inner);
    if late.is_empty() { Ok(kept) } else { with_late(delaunay, kept, &late, progress) }
}

/// The edges `kept`, and those of the `late` ones that are in. Their disks meet so many cells that an index of all Voronoi vertices
/// takes less time.
#[cold]
fn with_late(
    delaunay: &Delaunay,
    kept: Edges,
    late: &[Edge],
    progress: &Progress,
) -> Result<Edges> {
    let index = VoronoiVertices::new(delaunay, progress)?;
    let mut parts = in_parts(late.len(), GRAIN, &progress.quiet(), |range| {
        let mut visit = Visit::with_index(&index);
        let mut is_in =
            |edge| find_disk(delaunay, edge, &mut visit).is_ok_and(|verdict| verdict.is_in());
        let found = late[range].iter().filter(|&&edge| is_in(edge));
        found.map(|edge| rows(delaunay, edge.p, edge.q)).collect()
    })?;
    parts.push(kept);
    Ok(sort(&parts, delaunay.input_len()))
}

/// How the search for the disk of an edge of the one-step crust ended.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Verdict {
    /// The disk inside this circle holds no point and no Voronoi vertex.
    In(Circle),
    /// Every disk holds a point or one of these Voronoi vertices; the ends of the edge's dual may be among them.
    Out([Option<Vertex>; 2]),
}

impl Verdict {
    fn is_in(&self) -> bool {
        matches!(self, Self::In(_))
    }
}

/// A verdict, if the search for it was not given up.
pub(crate) type Outcome = std::result::Result<Verdict, TooLong>;

/// Look for a disk, the smallest first; each Voronoi vertex found inside rules out a part of the pencil.
#[inline]
pub(crate) fn find_disk(delaunay: &Delaunay, edge: Edge, visit: &mut Visit<'_>) -> Outcome {
    let triangles = [(edge.p, edge.q, edge.left), (edge.q, edge.p, edge.right)];
    let own = triangles.into_iter().find_map(|(p, q, apex)| {
        let corners = [p, q, apex?].map(|vertex| delaunay.point(vertex));
        is_above_45(corners).then_some(corners)
    });
    if own.is_none() && smallest_disk_is_in_cells(delaunay, edge) {
        return Ok(Verdict::In(Circle::Smallest));
    }
    visit.begin()?;
    let pencil = Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q));
    let through = |corners| Circle::Through(pencil.own(corners));
    let circle = own.map_or(Circle::Smallest, through);
    match visit.find(delaunay, edge, &pencil, &pencil.disk(circle))? {
        None => Ok(Verdict::In(circle)),
        Some(vertex) => search(delaunay, edge, &pencil, vertex, visit),
    }
}

/// Is the angle at the third corner about 45° or more? Then the triangle's center is inside the smallest disk of the other two.
#[inline]
fn is_above_45([p, q, apex]: [Point; 3]) -> bool {
    let angle = Angle::at(apex, p, q);
    angle.dot < angle.cross
}

/// The search in full, for which one Voronoi vertex is known that is in the smallest disk, or in that of one of the edge's own.
fn search(
    delaunay: &Delaunay,
    edge: Edge,
    pencil: &Pencil,
    mut found: Vertex,
    visit: &mut Visit<'_>,
) -> Outcome {
    // The angles at the edge's own apexes are acute, so each center is on the side of its triangle.
    let vertex = |corners: [u32; 3]| pencil.own(corners.map(|vertex| delaunay.point(vertex)));
    let mut high = edge.left.map(|apex| vertex([edge.p, edge.q, apex]));
    let mut low = edge.right.map(|apex| vertex([edge.q, edge.p, apex]));
    loop {
        match pencil.side(&found) {
            Greater => high = Some(found),
            Less => low = Some(found),
            // Between p and q, inside all disks.
            Equal => return Ok(Verdict::Out([Some(found), None])),
        }
        let Some(circle) = pencil.smallest_between(low, high) else {
            return Ok(Verdict::Out([low, high]));
        };
        match visit.find(delaunay, edge, pencil, &pencil.disk(circle))? {
            None => return Ok(Verdict::In(circle)),
            Some(vertex) => found = vertex,
        }
    }
}

/// Does the disk with diameter p q lie in the Voronoi cells of p and q? Then no Voronoi vertex is inside.
///
/// A quick test that settles most edges of a curve, and the ties of a lattice.
#[inline]
fn smallest_disk_is_in_cells(delaunay: &Delaunay, edge: Edge) -> bool {
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
    let (d, g) = (sub(end, s), sub(neighbor, s));
    let (length, far) = (dot(d, d), dot(g, g));
    if far > 4.001 * length + UNDERFLOW {
        // The disk is nowhere further from s than |d|, and the bisector is at |g| / 2.
        return true;
    }
    let (along, aside) = (dot(d, g), cross(d, g));
    // |d| |g| is at most the sum of the latter two, so this is more than all terms of each sum below.
    let size = far + along.abs() + aside.abs();
    if filter::sign(along, 4, size, 1.0) == Some(Greater) {
        let sign = filter::sign(far - along - aside.abs(), 6, size, 1.0);
        let exact = || sign::exact_sign(&RoomAhead, s, &[end, neighbor]);
        return sign.unwrap_or_else(exact) != Less;
    }
    let room = far - along;
    let sign = filter::sign(room * room - length * far, 12, 2.0 * size * size, 1.0);
    sign.unwrap_or_else(|| sign::exact_sign(&RoomBehind, s, &[end, neighbor])) != Less
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
