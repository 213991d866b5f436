//! The search for the disk that shows an edge to be in the crust: the smallest first; each Voronoi vertex found inside rules out a part
//! of the pencil. The few Voronoi cells that the disk meets are visited; where they are many, all vertices are looked up by place.

use super::visit::{TooLong, Visit};
use crate::delaunay::{Delaunay, Edge};
use crate::error::Result;
use crate::exact::angle::Angle;
use crate::exact::filter::{self, UNDERFLOW};
use crate::exact::pencil::{Circle, Disk, Pencil, Vertex};
use crate::exact::sign::{self, Form, Number};
use crate::parts::in_parts;
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;
use crate::space::region::Region;
use crate::voronoi::VoronoiVertices;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// How the search for the disk of an edge of the one-step crust ended.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Verdict {
    /// The disk inside this circle holds no point and no Voronoi vertex.
    In(Circle),
    /// Every disk holds a point or one of these Voronoi vertices; the ends of the edge's dual may be among them.
    Out([Option<Vertex>; 2]),
}

impl Verdict {
    pub(super) fn is_in(&self) -> bool {
        matches!(self, Self::In(_))
    }
}

/// A verdict, if the search for it was not given up.
pub(crate) type Outcome = std::result::Result<Verdict, TooLong>;

/// Edges that are looked up at a time: what is known of their disks fits into the first cache.
const BATCH: usize = 256;

/// Look for a disk of an edge of the one-step crust.
#[inline]
pub(crate) fn find_disk(delaunay: &Delaunay, edge: Edge, visit: &mut Visit) -> Outcome {
    let own = own_triangle(delaunay, edge);
    if own.is_none() && smallest_disk_is_in_cells(delaunay, edge) {
        return Ok(Verdict::In(Circle::Smallest));
    }
    visit.begin()?;
    let mut search = Search::new(delaunay, edge, own);
    loop {
        let disk = search.pencil.disk(search.circle);
        let Some(vertex) = visit.find(delaunay, edge, &search.pencil, &disk)? else {
            return Ok(Verdict::In(search.circle));
        };
        if let Some(verdict) = search.exclude(delaunay, vertex) {
            return Ok(verdict);
        }
    }
}

/// Look for disks of the edges whose [`find_disk`] takes too long; what `make` makes of the verdicts, in parts. Their disks meet so many cells
/// that an index of all Voronoi vertices takes less time.
///
/// # Errors
/// Too little memory, or a cancelled `progress`.
#[cold]
pub(crate) fn find_late<T: Send>(
    delaunay: &Delaunay,
    late: &[Edge],
    progress: &Progress,
    make: impl Fn(Edge, &Verdict) -> Option<T> + Sync,
) -> Result<Vec<Vec<T>>> {
    let index = VoronoiVertices::new(delaunay, progress)?;
    in_parts(late.len(), BATCH, &progress.quiet(), |range| {
        let mut made = Vec::new();
        find_disks(delaunay, &late[range], &index, |edge, verdict| {
            made.extend(make(edge, verdict));
        });
        made
    })
}

/// Look for disks of `edges` by the `index`, and `tell` the verdict on each.
pub(super) fn find_disks(
    delaunay: &Delaunay,
    edges: &[Edge],
    index: &VoronoiVertices,
    mut tell: impl FnMut(Edge, &Verdict),
) {
    let search = |&edge| Search::new(delaunay, edge, own_triangle(delaunay, edge));
    let mut searches: Vec<Search> = edges.iter().map(search).collect();
    while !searches.is_empty() {
        let mut found = look_up(delaunay, &searches, index).into_iter();
        searches.retain_mut(|search| {
            let verdict = match found.next().flatten() {
                None => Some(Verdict::In(search.circle)),
                Some(triangle) => search.exclude(delaunay, search.vertex(delaunay, triangle)),
            };
            if let Some(verdict) = &verdict {
                tell(search.edge, verdict);
            }
            verdict.is_none()
        });
    }
}

/// For each search the triangle of a Voronoi vertex strictly inside its disk, if there is one.
fn look_up(
    delaunay: &Delaunay,
    searches: &[Search],
    index: &VoronoiVertices,
) -> Vec<Option<[u32; 3]>> {
    let disks: Vec<Disk> = searches.iter().map(|s| s.pencil.disk(s.circle)).collect();
    let region = |(search, disk): (&Search, &Disk)| {
        Region::new(search.pencil.p, disk.center, disk.radius, disk.error)
    };
    let regions: Vec<Region> = searches.iter().zip(&disks).map(region).collect();
    index.find(&regions, |k, triangle| {
        searches[k].pencil.holds(&disks[k], &searches[k].vertex(delaunay, triangle))
    })
}

/// The corners of the edge's own triangle whose center is inside the smallest disk, the ends of the edge first.
#[inline]
fn own_triangle(delaunay: &Delaunay, edge: Edge) -> Option<[Point; 3]> {
    let triangles = [(edge.p, edge.q, edge.left), (edge.q, edge.p, edge.right)];
    triangles.into_iter().find_map(|(p, q, apex)| {
        let corners = [p, q, apex?].map(|vertex| delaunay.point(vertex));
        is_above_45(corners).then_some(corners)
    })
}

/// Is the angle at the third corner about 45° or more? Then the triangle's center is inside the smallest disk of the other two.
#[inline]
fn is_above_45([p, q, apex]: [Point; 3]) -> bool {
    let angle = Angle::at(apex, p, q);
    angle.dot < angle.cross
}

/// What is left of the pencil of an edge.
struct Search {
    edge: Edge,
    pencil: Pencil,
    /// The smallest circle that is left.
    circle: Circle,
    /// The Voronoi vertices that bound the rest, once one was found that does: to the right and to the left.
    ends: Option<[Option<Vertex>; 2]>,
}

impl Search {
    /// All of it; the center of the `own` triangle is known to be in the smallest disk.
    fn new(delaunay: &Delaunay, edge: Edge, own: Option<[Point; 3]>) -> Self {
        let pencil = Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q));
        let through = |corners| Circle::Through(pencil.own(corners));
        Self { edge, pencil, circle: own.map_or(Circle::Smallest, through), ends: None }
    }

    /// The Voronoi vertex of a triangle.
    fn vertex(&self, delaunay: &Delaunay, triangle: [u32; 3]) -> Vertex {
        self.pencil.vertex(triangle.map(|corner| delaunay.point(corner)))
    }

    /// Leave out the disks that hold the vertex `found`, which is in that of the `circle`; the verdict, if nothing is left.
    fn exclude(&mut self, delaunay: &Delaunay, found: Vertex) -> Option<Verdict> {
        let ends = self.ends.get_or_insert_with(|| own_centers(delaunay, self.edge, &self.pencil));
        match self.pencil.side(&found) {
            Greater => ends[1] = Some(found),
            Less => ends[0] = Some(found),
            // Between p and q, inside all disks.
            Equal => return Some(Verdict::Out([Some(found), None])),
        }
        let [low, high] = *ends;
        match self.pencil.smallest_between(low, high) {
            Some(circle) => self.circle = circle,
            None => return Some(Verdict::Out([low, high])),
        }
        None
    }
}

/// The centers of the edge's own triangles. The angles at their apexes are acute, so each is on the side of its triangle.
fn own_centers(delaunay: &Delaunay, edge: Edge, pencil: &Pencil) -> [Option<Vertex>; 2] {
    let vertex = |corners: [u32; 3]| pencil.own(corners.map(|vertex| delaunay.point(vertex)));
    let high = edge.left.map(|apex| vertex([edge.p, edge.q, apex]));
    let low = edge.right.map(|apex| vertex([edge.q, edge.p, apex]));
    [low, high]
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
    let neighbors = delaunay.star(s).neighbors;
    for (k, &neighbor) in neighbors.iter().enumerate() {
        if neighbor == end {
            continue;
        }
        match has_room(site, other, delaunay.point(neighbor), |_| None) {
            Some(true) => {}
            Some(false) => return false,
            None => return have_room_exactly(delaunay, site, end, &neighbors[k..]),
        }
    }
    true
}

/// Do all `neighbors` of `site` but `end` leave room?
// Apart: in the loop above, the compiler turns coordinates into integers in advance, for tests that are hardly ever made.
#[cold]
#[inline(never)]
fn have_room_exactly(delaunay: &Delaunay, site: Point, end: u32, neighbors: &[u32]) -> bool {
    let other = delaunay.point(end);
    neighbors.iter().filter(|&&neighbor| neighbor != end).all(|&neighbor| {
        let neighbor = delaunay.point(neighbor);
        let exact = |is_ahead| Some(exact_room(site, other, neighbor, is_ahead));
        has_room(site, other, neighbor, exact) == Some(true)
    })
}

/// Is the half of the disk with diameter `s` `end` that is nearer to `s` nowhere nearer to `neighbor`? By `exact` where in doubt.
///
/// With d the diameter from s, and g the vector to the neighbor, in the direction of g the half disk reaches |d×g| / 2 beyond
/// the middle, d·g / 2, if g points forward, and |d| |g| / 2 if backward; the cell ends at |g|² / 2. Where the direction is in
/// doubt the backward form serves, for it asks for no less.
#[inline]
fn has_room(
    s: Point,
    end: Point,
    neighbor: Point,
    exact: impl Fn(bool) -> Option<Ordering>,
) -> Option<bool> {
    let (d, g) = (sub(end, s), sub(neighbor, s));
    let (length, far) = (dot(d, d), dot(g, g));
    if far > 4.001 * length + UNDERFLOW {
        // The disk is nowhere further from s than |d|, and the bisector is at |g| / 2.
        return Some(true);
    }
    let (along, aside) = (dot(d, g), cross(d, g));
    // |d| |g| is at most the sum of the latter two, so this is more than all terms of each sum below.
    let size = far + along.abs() + aside.abs();
    let is_ahead = filter::sign(along, 4, size, 1.0) == Some(Greater);
    let sign = if is_ahead {
        filter::sign(far - along - aside.abs(), 6, size, 1.0)
    } else {
        let room = far - along;
        filter::sign(room * room - length * far, 12, 2.0 * size * size, 1.0)
    };
    sign.or_else(|| exact(is_ahead)).map(|sign| sign != Less)
}

/// The sign of the room that is left to a neighbor that is ahead, or behind.
fn exact_room(s: Point, end: Point, neighbor: Point, is_ahead: bool) -> Ordering {
    if is_ahead {
        sign::exact_sign(&RoomAhead, s, &[end, neighbor])
    } else {
        sign::exact_sign(&RoomBehind, s, &[end, neighbor])
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::angle_bound::OppositeDot;
    use crate::exact::brink_tests::at_brinks;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        assert_bounded(&RoomAhead);
        assert_bounded(&RoomBehind);
    }

    /// Where it is in doubt whether the neighbor is ahead, there may be room that is not seen.
    #[test]
    fn no_room_is_seen_where_there_is_none() {
        let check = |s, [end, neighbor]: [Point; 2], _| {
            let at = [end, neighbor];
            let room = if sign::sign(&sign::Dot, s, &at) == Greater {
                sign::sign(&OppositeDot, s, &at) != Less && sign::sign(&RoomAhead, s, &at) != Less
            } else {
                sign::sign(&RoomBehind, s, &at) != Less
            };
            let exact = |is_ahead| Some(exact_room(s, end, neighbor, is_ahead));
            assert!(room || has_room(s, end, neighbor, exact) == Some(false));
        };
        at_brinks(&RoomAhead, false, check);
        at_brinks(&RoomBehind, false, check);
    }
}
