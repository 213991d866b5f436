//! Divide and conquer: triangulate the halves of a cell, then zip them together.
//!
//! The merge is that of Guibas and Stolfi (see [`rings`](super::rings)); cutting cells alternately by vertical and
//! horizontal lines is R. A. Dwyer's, "A Faster Divide-and-Conquer Algorithm for Constructing Delaunay
//! Triangulations", Algorithmica 2 (1987). The cuts are those of the Z-order curve, so they depend on the
//! points alone, and the halves, which share nothing, can be triangulated at the same time.

use super::rings::{FreeSlots, HalfEdge, NONE, Rings};
use crate::error::Result;
use crate::exact::predicates::{Base, Sighting, is_left};
use crate::point::{Point, lexicographic};
use crate::progress::Progress;

/// Vertices below which a cell is one task, and one report of progress.
const TASK: usize = 1 << 13;
/// Slots for half-edges per vertex: an edge has two, and there are fewer than three edges a vertex.
pub const SLOTS: usize = 6;

/// How a cell is cut in two.
#[derive(Clone, Copy, PartialEq)]
enum Cut {
    /// By a vertical line: left before right, ties from below.
    Vertical,
    /// By a horizontal line: below before above, ties from the right.
    Horizontal,
}

/// A vertex of the hull and the half-edge from it to the next one counter-clockwise.
///
/// `edge` is `NONE` while the vertex is alone.
#[derive(Clone, Copy)]
pub struct HullVertex {
    vertex: u32,
    /// The half-edge to the next vertex of the hull.
    pub edge: u32,
}

/// The first and last vertex of a triangulation in each of the two orders of [`Cut`].
#[derive(Clone, Copy)]
pub struct Extremes {
    /// First in the order of a vertical cut: the leftmost vertex.
    pub left: HullVertex,
    right: HullVertex,
    bottom: HullVertex,
    top: HullVertex,
}

/// The vertices of all cells.
#[derive(Clone, Copy)]
pub struct Vertices<'a> {
    /// Distinct points along the Z-order curve.
    pub points: &'a [Point],
    /// Their codes.
    pub codes: &'a [u64],
}

/// Triangulate the cell of the vertices `first..last` into `slots`, of which number 0 is `SLOTS * first`.
pub fn triangulate(
    vertices: Vertices<'_>,
    (first, last): (usize, usize),
    slots: &mut [HalfEdge],
    progress: &Progress,
) -> Result<(Extremes, FreeSlots)> {
    let offset = (SLOTS * first) as u32;
    if last - first <= TASK {
        let free = FreeSlots::fresh(offset..(SLOTS * last) as u32);
        let mut cell = Cell { vertices, rings: Rings::new(slots, offset, free) };
        let extremes = cell.triangulate(first, last);
        progress.advance(last - first)?;
        return Ok((extremes, cell.rings.into_free()));
    }
    let (middle, cut) = vertices.split(first, last);
    let (low, high) = slots.split_at_mut(SLOTS * (middle - first));
    let (a, b) = rayon::join(
        || triangulate(vertices, (first, middle), low, progress),
        || triangulate(vertices, (middle, last), high, progress),
    );
    let ((a, free_a), (b, free_b)) = (a?, b?);
    progress.advance(0)?;
    let mut cell = Cell { vertices, rings: Rings::new(slots, offset, free_a.join(free_b)) };
    let extremes = cell.merge(a, b, cut);
    Ok((extremes, cell.rings.into_free()))
}

impl Vertices<'_> {
    /// Where to cut the cell `first..last`: at the leading bit in which its codes differ.
    fn split(self, first: usize, last: usize) -> (usize, Cut) {
        let codes = &self.codes[first..last];
        let differing = codes[0] ^ codes[codes.len() - 1];
        if differing == 0 {
            // Too close together for the code; these are sorted by x, then y.
            return (usize::midpoint(first, last), Cut::Vertical);
        }
        let bit = differing.ilog2();
        let middle = codes.partition_point(|code| code >> bit & 1 == 0);
        (first + middle, if bit % 2 == 1 { Cut::Vertical } else { Cut::Horizontal })
    }
}

/// Which way around a vertex: counter-clockwise or clockwise.
#[derive(Clone, Copy)]
enum Step {
    Next,
    Prev,
}

/// A half-edge from an end of the base to what may be the apex of the next triangle.
#[derive(Clone, Copy)]
struct Candidate {
    edge: u32,
    vertex: u32,
    sighting: Sighting,
}

/// A cell at work: its vertices and the graph on them.
struct Cell<'a> {
    vertices: Vertices<'a>,
    rings: Rings<'a>,
}

impl Cell<'_> {
    fn triangulate(&mut self, first: usize, last: usize) -> Extremes {
        match last - first {
            1 => Extremes::of_vertex(first as u32),
            2 => self.segment(first as u32, first as u32 + 1),
            3 => self.triangle(first as u32),
            _ => {
                let (middle, cut) = self.vertices.split(first, last);
                let low = self.triangulate(first, middle);
                let high = self.triangulate(middle, last);
                self.merge(low, high, cut)
            }
        }
    }

    #[inline]
    fn point(&self, vertex: u32) -> Point {
        self.vertices.points[vertex as usize]
    }

    fn segment(&mut self, a: u32, b: u32) -> Extremes {
        let e = self.rings.add(a, b, NONE, NONE);
        let a = HullVertex { vertex: a, edge: e };
        let b = HullVertex { vertex: b, edge: e ^ 1 };
        self.extremes(&[a, b])
    }

    /// The triangle on the vertices `first`, `first + 1`, `first + 2`, or the path if they are in line.
    fn triangle(&mut self, first: u32) -> Extremes {
        let mut corners = [first, first + 1, first + 2];
        let [a, b, c] = corners.map(|vertex| self.point(vertex));
        if is_left(a, c, b) {
            corners.swap(1, 2);
        } else if !is_left(a, b, c) {
            corners.sort_unstable_by(|&i, &j| lexicographic(&self.point(i), &self.point(j)));
            return self.path(corners);
        }
        let [a, b, c] = corners;
        // Rings of two need no angles.
        let ab = self.rings.add(a, b, NONE, NONE);
        let bc = self.rings.add(b, c, ab ^ 1, NONE);
        let ca = self.rings.add(c, a, bc ^ 1, ab);
        let corner = |vertex, edge| HullVertex { vertex, edge };
        self.extremes(&[corner(a, ab), corner(b, bc), corner(c, ca)])
    }

    fn path(&mut self, [a, b, c]: [u32; 3]) -> Extremes {
        let ab = self.rings.add(a, b, NONE, NONE);
        let bc = self.rings.add(b, c, ab ^ 1, NONE);
        let a = HullVertex { vertex: a, edge: ab };
        let c = HullVertex { vertex: c, edge: bc ^ 1 };
        self.extremes(&[a, c])
    }

    /// The extremes among `hull`, which holds them.
    fn extremes(&self, hull: &[HullVertex]) -> Extremes {
        let all = hull.iter().copied();
        let first = |cut| all.clone().reduce(|a, b| self.earlier(cut, a, b));
        let last = |cut| all.clone().reduce(|a, b| self.later(cut, a, b));
        let present = |vertex: Option<HullVertex>| vertex.expect("there is a vertex");
        Extremes {
            left: present(first(Cut::Vertical)),
            right: present(last(Cut::Vertical)),
            bottom: present(first(Cut::Horizontal)),
            top: present(last(Cut::Horizontal)),
        }
    }

    #[inline]
    fn precedes(&self, cut: Cut, a: HullVertex, b: HullVertex) -> bool {
        cut.precedes(self.point(a.vertex), self.point(b.vertex))
    }

    #[inline]
    fn earlier(&self, cut: Cut, a: HullVertex, b: HullVertex) -> HullVertex {
        if self.precedes(cut, b, a) { b } else { a }
    }

    #[inline]
    fn later(&self, cut: Cut, a: HullVertex, b: HullVertex) -> HullVertex {
        if self.precedes(cut, a, b) { b } else { a }
    }

    /// The extremes of two cells on the two sides of a cut; across the cut there is nothing to compare.
    #[inline]
    fn join(&self, low: Extremes, high: Extremes, cut: Cut) -> Extremes {
        match cut {
            Cut::Vertical => Extremes {
                left: low.left,
                right: high.right,
                bottom: self.earlier(Cut::Horizontal, low.bottom, high.bottom),
                top: self.later(Cut::Horizontal, low.top, high.top),
            },
            Cut::Horizontal => Extremes {
                left: self.earlier(Cut::Vertical, low.left, high.left),
                right: self.later(Cut::Vertical, low.right, high.right),
                bottom: low.bottom,
                top: high.top,
            },
        }
    }

    /// Join the triangulation `low` to `high`, which lies on the other side of the cut.
    fn merge(&mut self, low: Extremes, high: Extremes, cut: Cut) -> Extremes {
        let (inner_low, inner_high) = match cut {
            Cut::Vertical => (low.right, high.left),
            Cut::Horizontal => (low.top, high.bottom),
        };
        let lower = self.lower_tangent(inner_low, inner_high);
        let upper = self.zip(lower);
        let mut all = self.join(low, high, cut);
        // Only the four ends of the tangents have a new neighbor on the hull.
        all.update(self.rings.origin(lower ^ 1), lower ^ 1);
        all.update(self.rings.origin(upper), upper);
        all
    }

    /// Add the edge of the hull below the cut; return its half-edge from `high` to `low`.
    fn lower_tangent(&mut self, low: HullVertex, high: HullVertex) -> u32 {
        // On the low side half-edges run clockwise around the hull, on the high side counter-clockwise.
        let mut e = if low.edge == NONE { NONE } else { self.rings.prev(low.edge) };
        let mut f = high.edge;
        let (mut a, mut b) = (low.vertex, high.vertex);
        loop {
            if e != NONE && self.is_left_of(b, e) {
                e = self.rings.left_next(e);
                a = self.rings.origin(e);
            } else if f != NONE && self.is_right_of(a, f) {
                f = self.rings.right_prev(f);
                b = self.rings.origin(f);
            } else {
                break;
            }
        }
        self.rings.add(b, a, f, e)
    }

    /// Close the gap above `base`, the lower tangent; return the upper one, from `high` to `low`.
    ///
    /// The base rises, one triangle at a time, on the candidate whose circle with the base holds no other vertex.
    fn zip(&mut self, mut base: u32) -> u32 {
        let mut a = self.rings.destination(base);
        let mut b = self.rings.origin(base);
        loop {
            let ends = Base::new(self.point(a), self.point(b));
            let mut low = self.candidate(&ends, self.rings.next(base ^ 1));
            let low_is_above = ends.is_left(&low.sighting);
            if low_is_above {
                low = self.settle(&ends, low, b, Step::Next);
            }
            let mut high = self.candidate(&ends, self.rings.prev(base));
            let high_is_above = ends.is_left(&high.sighting);
            if high_is_above {
                high = self.settle(&ends, high, a, Step::Prev);
            }
            if !low_is_above && !high_is_above {
                return base;
            }
            if !low_is_above || high_is_above && ends.in_circle(&low.sighting, &high.sighting) {
                base = self.rings.add(high.vertex, a, high.edge ^ 1, base ^ 1);
                b = high.vertex;
            } else {
                base = self.rings.add(b, low.vertex, base, low.edge ^ 1);
                a = low.vertex;
            }
        }
    }

    /// The candidate that stays, going around from `candidate`: edges whose triangle on the base has a circle that holds the
    /// next vertex are removed. `last` is the other end of the base, where the ring comes around.
    // A call costs as much as the in-circle test that most calls make; callgrind counts 4 % fewer instructions in all.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn settle(
        &mut self,
        base: &Base,
        mut candidate: Candidate,
        last: u32,
        step: Step,
    ) -> Candidate {
        loop {
            let next = self.candidate(
                base,
                match step {
                    Step::Next => self.rings.next(candidate.edge),
                    Step::Prev => self.rings.prev(candidate.edge),
                },
            );
            if next.vertex == last || !base.in_circle(&candidate.sighting, &next.sighting) {
                return candidate;
            }
            self.rings.remove(candidate.edge);
            candidate = next;
        }
    }

    #[inline]
    fn candidate(&self, base: &Base, edge: u32) -> Candidate {
        let vertex = self.rings.destination(edge);
        Candidate { edge, vertex, sighting: base.sight(self.point(vertex)) }
    }

    #[inline]
    fn is_left_of(&self, vertex: u32, e: u32) -> bool {
        let (a, b) = (self.rings.origin(e), self.rings.destination(e));
        is_left(self.point(a), self.point(b), self.point(vertex))
    }

    #[inline]
    fn is_right_of(&self, vertex: u32, e: u32) -> bool {
        self.is_left_of(vertex, e ^ 1)
    }
}

impl Cut {
    #[inline]
    fn precedes(self, a: Point, b: Point) -> bool {
        match self {
            Self::Vertical => a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]),
            Self::Horizontal => a[1] < b[1] || (a[1] == b[1] && a[0] > b[0]),
        }
    }
}

impl Extremes {
    fn of(vertex: HullVertex) -> Self {
        Self { left: vertex, right: vertex, bottom: vertex, top: vertex }
    }

    fn of_vertex(vertex: u32) -> Self {
        Self::of(HullVertex { vertex, edge: NONE })
    }

    fn update(&mut self, vertex: u32, edge: u32) {
        for extreme in [&mut self.left, &mut self.right, &mut self.bottom, &mut self.top] {
            if extreme.vertex == vertex {
                extreme.edge = edge;
            }
        }
    }
}
