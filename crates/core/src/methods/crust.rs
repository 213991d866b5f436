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
use crate::exact::angle::Angle;
use crate::exact::filter::{self, UNDERFLOW};
use crate::exact::pencil::{Circle, Disk, Pencil, Vertex};
use crate::exact::sign::{self, Form, Number};
use crate::point::{Point, cross, dot, sub};
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
            && matches!(find_disk(delaunay, edge, visit), Verdict::In(_))
    })
}

/// How the search for the disk of an edge of the one-step crust ended.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Verdict {
    /// The disk inside this circle holds no point and no Voronoi vertex.
    In(Circle),
    /// Every disk holds a point or one of these Voronoi vertices; the ends of the edge's dual may be among them.
    Out([Option<Vertex>; 2]),
}

/// Look for a disk, the smallest first; each Voronoi vertex found inside rules out a part of the pencil.
#[inline]
pub(crate) fn find_disk(delaunay: &Delaunay, edge: Edge, visit: &mut Visit) -> Verdict {
    let triangles = [(edge.p, edge.q, edge.left), (edge.q, edge.p, edge.right)];
    let own = triangles.into_iter().find_map(|(p, q, apex)| {
        let corners = [p, q, apex?].map(|vertex| delaunay.point(vertex));
        is_above_45(corners).then_some(corners)
    });
    if let Some(corners) = own {
        let pencil = Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q));
        let circle = Circle::Through(pencil.vertex(corners));
        if is_in_cells(delaunay, edge, &pencil, &pencil.disk(circle)) {
            return Verdict::In(circle);
        }
        return search(delaunay, edge, None, visit);
    }
    if smallest_disk_is_in_cells(delaunay, edge) {
        return Verdict::In(Circle::Smallest);
    }
    let pencil = Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q));
    let found = visit.find(delaunay, edge, &pencil, Circle::Smallest);
    if found.is_none() {
        return Verdict::In(Circle::Smallest);
    }
    search(delaunay, edge, found, visit)
}

/// Is the angle at the third corner about 45° or more? Then the triangle's center is inside the smallest disk of the other two.
#[inline]
fn is_above_45([p, q, apex]: [Point; 3]) -> bool {
    let angle = Angle::at(apex, p, q);
    angle.dot < angle.cross
}

/// Does `disk` certainly lie in the Voronoi cells of p and q? Then no Voronoi vertex is inside.
fn is_in_cells(delaunay: &Delaunay, edge: Edge, pencil: &Pencil, disk: &Disk) -> bool {
    [[edge.p, edge.q], [edge.q, edge.p]].into_iter().all(|[s, end]| {
        let part = Part::new(disk, pencil, delaunay.point(s), Some(delaunay.point(end)));
        let mut others = delaunay.star(s).neighbors.iter().filter(|&&neighbor| neighbor != end);
        others.all(|&neighbor| !part.may_reach(delaunay.point(neighbor)))
    })
}

/// The search in full, from the Voronoi vertex `found` in the smallest disk, if that was tried.
fn search(
    delaunay: &Delaunay,
    edge: Edge,
    mut found: Option<Vertex>,
    visit: &mut Visit,
) -> Verdict {
    let pencil = Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q));
    // The angles at the edge's own apexes are acute, so each center is on the side of its triangle.
    let vertex = |corners: [u32; 3]| pencil.vertex(corners.map(|vertex| delaunay.point(vertex)));
    let mut high = edge.left.map(|apex| vertex([edge.p, edge.q, apex]));
    let mut low = edge.right.map(|apex| vertex([edge.q, edge.p, apex]));
    loop {
        match found.map(|vertex| pencil.side(&vertex)) {
            None => {}
            Some(Greater) => high = found,
            Some(Less) => low = found,
            // Between p and q, inside all disks.
            Some(Equal) => return Verdict::Out([found, None]),
        }
        let Some(circle) = pencil.smallest_between(low, high) else {
            return Verdict::Out([low, high]);
        };
        found = visit.find(delaunay, edge, &pencil, circle);
        if found.is_none() {
            return Verdict::In(circle);
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

/// A walk over the Voronoi cells that meet a disk, and its memory.
#[derive(Default)]
pub struct Visit {
    cells: Vec<u32>,
    many: HashSet<u32>,
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
            let part = Part::new(&disk, pencil, delaunay.point(cell), other);
            let found = self.search_cell(delaunay, next, pencil, &part);
            if found.is_some() {
                return found;
            }
            next += 1;
        }
        None
    }

    /// Look at the corners of cell number `number` of the visit; add the cells behind the sides that the disk crosses.
    ///
    /// A corner is on two bisectors, so both must meet the disk; and it is of three cells: those of earlier cells are known.
    fn search_cell(
        &mut self,
        delaunay: &Delaunay,
        number: usize,
        pencil: &Pencil,
        part: &Part<'_>,
    ) -> Option<Vertex> {
        let star = delaunay.star(self.cells[number]);
        let count = star.neighbors.len();
        let side = |k: usize| Side::new(part, star.neighbors[k], delaunay.point(star.neighbors[k]));
        let last = side(count.checked_sub(1)?);
        let (mut before, mut this) = (last, if count > 1 { side(0) } else { last });
        for k in 0..count {
            let after = if k + 1 < count { side(k + 1) } else { side(0) };
            if this.is_near {
                let is_corner = before.is_near && (k > 0 || !star.on_hull);
                if is_corner && !self.was_at(number, before.neighbor, this.neighbor) {
                    let vertex = pencil.vertex([part.site, before.point, this.point]);
                    if pencil.holds(part.disk, &vertex) {
                        return Some(vertex);
                    }
                }
                if part.may_cross(&this, [&before, &after]) {
                    self.add(this.neighbor);
                }
            }
            (before, this) = (this, after);
        }
        None
    }

    /// Was one of two cells visited before cell number `number`?
    fn was_at(&self, number: usize, one: u32, other: u32) -> bool {
        number <= FEW && self.cells[..number].iter().any(|&cell| cell == one || cell == other)
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
    site: Point,
    /// The center relative to the site.
    center: Point,
    /// More than the rounding errors of the distances below.
    doubt: f64,
    half: Option<Half>,
    /// The apex of the edge's own triangle whose center the circle goes through.
    apex: Option<Point>,
}

/// The bisector of a cell's site and a neighbor.
#[derive(Clone, Copy)]
struct Side {
    neighbor: u32,
    point: Point,
    /// Can a point of the part be nearer to the neighbor than to the site?
    is_near: bool,
}

impl Side {
    #[inline]
    fn new(part: &Part<'_>, neighbor: u32, point: Point) -> Self {
        Self { neighbor, point, is_near: part.may_reach(point) }
    }
}

/// The half of a disk that is nearer to one end of the edge.
struct Half {
    /// The vector to the other end.
    chord: Point,
    /// The disk's radius over the length of the chord.
    ratio: f64,
}

impl<'a> Part<'a> {
    /// The part of `disk` in the cell of `site`; `other` is the other end of the edge, if `site` is one.
    fn new(disk: &'a Disk, pencil: &Pencil, site: Point, other: Option<Point>) -> Self {
        let center = sub(disk.center, sub(site, pencil.p));
        let size = center[0].abs() + center[1].abs() + disk.radius;
        let half = other.map(|other| {
            let chord = sub(other, site);
            Half { chord, ratio: disk.radius / dot(chord, chord).sqrt() }
        });
        let apex = pencil.own_apex(disk);
        Self { disk, site, center, doubt: 1e-14 * size + 2.0 * disk.error, half, apex }
    }

    /// Can the disk cross the cell's `side`, given that it holds none of its ends? False only if it certainly does not.
    ///
    /// It meets the line of the side around the foot of its center, so if the foot is beyond an end, on the other side of the
    /// bisector `beside` it, all between that end and the disk's part of the line is outside of the cell.
    #[inline]
    fn may_cross(&self, side: &Side, beside: [&Side; 2]) -> bool {
        let g = sub(side.point, self.site);
        let far = dot(g, g);
        if far < UNDERFLOW {
            return true;
        }
        let step = (far / 2.0 - dot(self.center, g)) / far;
        let foot = [self.center[0] + step * g[0], self.center[1] + step * g[1]];
        let doubt = 4.0 * self.doubt + 1e-13 * (g[0].abs() + g[1].abs());
        beside.iter().all(|other| {
            let h = sub(other.point, self.site);
            let span = h[0].abs() + h[1].abs();
            let beyond = dot(foot, h) - dot(h, h) / 2.0 - (doubt + 1e-13 * span) * span;
            // An unknown (not a number) counts as crossing.
            beyond.is_nan() || beyond <= UNDERFLOW
        })
    }

    /// Can a point of this part be nearer to `neighbor` than to the site? False only if certainly none is.
    #[inline]
    fn may_reach(&self, neighbor: Point) -> bool {
        let g = sub(neighbor, self.site);
        let span = g[0].abs() + g[1].abs();
        let far = dot(g, g);
        let ahead = self.half.as_ref().filter(|half| half.faces(g, span));
        if ahead.is_some() && self.apex == Some(neighbor) {
            // The half disk ends on the bisector of p and q, there at that center, which is on this bisector, too.
            return false;
        }
        let width = match ahead {
            Some(half) => half.ratio * cross(half.chord, g).abs(),
            // Where the direction is in doubt the whole disk serves, for it reaches no less.
            None => self.disk.radius * far.sqrt(),
        };
        let reach = dot(self.center, g) + width + (self.doubt + 1e-14 * span) * span + UNDERFLOW;
        // An unknown (not a number) counts as reaching.
        reach.is_nan() || reach > far / 2.0
    }
}

impl Half {
    /// Does `g`, whose coordinates sum to `span`, certainly point to the other half?
    #[inline]
    fn faces(&self, g: Point, span: f64) -> bool {
        dot(self.chord, g) > 1e-14 * span * (self.chord[0].abs() + self.chord[1].abs())
    }
}
