//! The graph of a cell small enough for memory of fixed size: 16-bit numbers, which cannot leave it, so nothing is checked.
//!
//! Most of the work of a triangulation is in small cells. Here a half-edge is eight bytes, and a cell of [`MOST`] vertices stays in
//! the second cache.

use super::hull::{Cut, Extremes, HullVertex};
use super::rings::{Graph, Index, Rings};
use super::zip::merge;
use crate::exact::predicates::is_left;
use crate::point::{Point, lexicographic};
use crate::space::order::Grid;
use std::cell::RefCell;

/// As many as 16-bit numbers are.
const SIZE: usize = 1 << 16;
/// The most vertices of a leaf: with six half-edges each their numbers have 16 bits, and are not `NONE`.
pub const MOST: usize = 1 << 13;
const NONE: u16 = u16::NONE;

/// A half-edge, eight bytes long: the vertex that it leads to, the next and the previous one around its origin.
type HalfEdge = [u16; 4];

const DESTINATION: usize = 0;
const NEXT: usize = 1;
const PREV: usize = 2;

/// The graph of one cell.
pub struct Leaf {
    half_edges: Box<[HalfEdge; SIZE]>,
    points: Box<[Point; SIZE]>,
    /// The number of half-edges that are, or were, in use.
    used: u16,
    /// The first of those that were: each leads to the next.
    free: u16,
}

thread_local! {
    /// The leaf of this thread, and the codes of its vertices; of its memory only what is used is ever touched.
    static LEAF: RefCell<(Leaf, Vec<u64>)> = RefCell::new((Leaf::new(), Vec::new()));
}

impl Leaf {
    /// Triangulate the vertices `points`, distinct and along the Z-order curve of `grid`; `finish` gets the graph and the
    /// extremes of its hull.
    pub fn with<T>(
        points: &[Point],
        grid: &Grid,
        finish: impl FnOnce(&Self, Extremes<u16>) -> T,
    ) -> T {
        LEAF.with_borrow_mut(|(leaf, codes)| {
            codes.clear();
            codes.extend(points.iter().map(|&point| grid.code(point)));
            leaf.points[..points.len()].copy_from_slice(points);
            (leaf.used, leaf.free) = (0, NONE);
            let extremes = leaf.triangulate(codes, 0);
            finish(leaf, extremes)
        })
    }

    fn new() -> Self {
        let half_edges = vec![HalfEdge::default(); SIZE].into_boxed_slice();
        let points = vec![Point::default(); SIZE].into_boxed_slice();
        Self {
            half_edges: half_edges.try_into().expect("the length is SIZE"),
            points: points.try_into().expect("the length is SIZE"),
            used: 0,
            free: NONE,
        }
    }

    /// The number of half-edges that are, or were, in use.
    pub fn used(&self) -> u16 {
        self.used
    }

    /// A half-edge from each of the `count` vertices, if it has one, and a 0 and then the number of half-edges from each.
    pub fn origins(&self, count: usize) -> (Vec<u16>, Vec<u32>) {
        let (mut first, mut degrees) = (vec![0; count], vec![0; count + 1]);
        for e in (0..self.used).filter(|&e| !self.is_free(e)) {
            let origin = self.origin(e) as usize;
            first[origin] = e;
            degrees[origin + 1] += 1;
        }
        (first, degrees)
    }

    /// Was `e` given back?
    #[inline]
    pub fn is_free(&self, e: u16) -> bool {
        self.destination(e) == NONE
    }

    /// Triangulate the vertices from `first` on with these `codes`.
    fn triangulate(&mut self, codes: &[u64], first: u16) -> Extremes<u16> {
        match codes.len() {
            1 => self.hull(&[HullVertex { vertex: first, edge: NONE }]),
            2 => self.segment([first, first + 1]),
            3 => self.triangle([first, first + 1, first + 2]),
            _ => {
                let (middle, cut) = Cut::of(codes, |&code| code);
                let low = self.triangulate(&codes[..middle], first);
                let high = self.triangulate(&codes[middle..], first + middle as u16);
                merge(self, low, high, cut)
            }
        }
    }

    fn hull(&self, hull: &[HullVertex<u16>]) -> Extremes<u16> {
        Extremes::of(hull, self)
    }

    fn segment(&mut self, [a, b]: [u16; 2]) -> Extremes<u16> {
        let edge = self.add_first([a, b], NONE, NONE);
        self.hull(&[HullVertex { vertex: a, edge }, HullVertex { vertex: b, edge: edge.twin() }])
    }

    /// The triangle of three vertices, or the path if they are in line.
    fn triangle(&mut self, mut corners: [u16; 3]) -> Extremes<u16> {
        let [a, b, c] = corners.map(|vertex| self.point(vertex));
        if is_left(a, c, b) {
            corners.swap(1, 2);
        } else if !is_left(a, b, c) {
            corners.sort_unstable_by(|&i, &j| lexicographic(&self.point(i), &self.point(j)));
            return self.path(corners);
        }
        let [a, b, c] = corners;
        // Rings of two need no angles.
        let ab = self.add_first([a, b], NONE, NONE);
        let bc = self.add_first([b, c], ab.twin(), NONE);
        let ca = self.add_first([c, a], bc.twin(), ab);
        let corner = |vertex, edge| HullVertex { vertex, edge };
        self.hull(&[corner(a, ab), corner(b, bc), corner(c, ca)])
    }

    fn path(&mut self, [a, b, c]: [u16; 3]) -> Extremes<u16> {
        let ab = self.add_first([a, b], NONE, NONE);
        let bc = self.add_first([b, c], ab.twin(), NONE);
        self.hull(&[HullVertex { vertex: a, edge: ab }, HullVertex { vertex: c, edge: bc.twin() }])
    }
}

impl Rings for Leaf {
    type Index = u16;

    #[inline]
    fn destination(&self, e: u16) -> u16 {
        self.half_edges[e as usize][DESTINATION]
    }
    #[inline]
    fn next(&self, e: u16) -> u16 {
        self.half_edges[e as usize][NEXT]
    }
    #[inline]
    fn prev(&self, e: u16) -> u16 {
        self.half_edges[e as usize][PREV]
    }
}

impl Graph for Leaf {
    #[inline]
    fn point(&self, vertex: u16) -> Point {
        self.points[vertex as usize]
    }

    #[inline]
    fn link(&mut self, e: u16, f: u16) {
        self.half_edges[e as usize][NEXT] = f;
        self.half_edges[f as usize][PREV] = e;
    }

    #[inline]
    fn take(&mut self, a: u16, b: u16) -> u16 {
        let mut e = self.free;
        if e == NONE {
            e = self.used;
            self.used += 2;
        } else {
            self.free = self.next(e);
        }
        self.half_edges[e as usize][DESTINATION] = b;
        self.half_edges[e.twin() as usize][DESTINATION] = a;
        e
    }

    #[inline]
    fn give_back(&mut self, e: u16) {
        let even = e & !1;
        self.half_edges[e as usize][DESTINATION] = NONE;
        self.half_edges[e.twin() as usize][DESTINATION] = NONE;
        self.half_edges[even as usize][NEXT] = self.free;
        self.free = even;
    }
}
