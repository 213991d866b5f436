//! The graph of any number of vertices, in memory that the halves of a cell share out among them.

use super::leaf::Leaf;
use super::rings::{Graph, Index, NONE, Rings};
use crate::point::Point;
use std::ops::Range;

/// Slots for half-edges per vertex: an edge has two, and there are fewer than three edges a vertex.
pub const SLOTS: usize = 6;

/// A half-edge: the vertex that it leads to, the next one counter-clockwise around its origin, the next one clockwise.
pub type HalfEdge = [u32; 3];

const DESTINATION: usize = 0;
const NEXT: usize = 1;
const PREV: usize = 2;

/// Half-edges numbered from 0.
impl Rings for [HalfEdge] {
    type Index = u32;

    #[inline]
    fn destination(&self, e: u32) -> u32 {
        self[e as usize][DESTINATION]
    }
    #[inline]
    fn next(&self, e: u32) -> u32 {
        self[e as usize][NEXT]
    }
    #[inline]
    fn prev(&self, e: u32) -> u32 {
        self[e as usize][PREV]
    }
}

/// A graph on a range of vertices.
///
/// Vertices and half-edges are numbered through all ranges: the vertices from `start`, the half-edges from `SLOTS * start`.
pub struct Slots<'a> {
    points: &'a [Point],
    start: usize,
    half_edges: &'a mut [HalfEdge],
    /// A half-edge from each vertex of the range, if it has one.
    first: &'a mut [u32],
    /// The number of half-edges from each vertex of the range.
    degrees: &'a mut [u32],
    free: FreeSlots,
}

/// The slots not in use: a chain of those used before, and a range of those never used.
pub struct FreeSlots {
    chain: u32,
    fresh: Range<u32>,
    /// What else there is, from joining neighbors.
    more: Vec<(u32, Range<u32>)>,
}

impl<'a> Slots<'a> {
    /// A graph without edges on the vertices from `start`, which are among `points`.
    pub fn new(
        points: &'a [Point],
        start: usize,
        half_edges: &'a mut [HalfEdge],
        [first, degrees]: [&'a mut [u32]; 2],
    ) -> Self {
        let begin = SLOTS * start;
        let fresh = begin as u32..(begin + half_edges.len()) as u32;
        let free = FreeSlots { chain: NONE, fresh, more: Vec::new() };
        Self { points, start, half_edges, first, degrees, free }
    }

    /// The vertices.
    pub fn range(&self) -> Range<usize> {
        self.start..self.start + self.first.len()
    }

    /// Graphs without edges on the vertices before `middle` and on those from there.
    pub fn halves(&mut self, middle: usize) -> [Slots<'_>; 2] {
        let count = middle - self.start;
        let (low, high) = self.half_edges.split_at_mut(SLOTS * count);
        let (low_first, high_first) = self.first.split_at_mut(count);
        let (low_degrees, high_degrees) = self.degrees.split_at_mut(count);
        [
            Slots::new(self.points, self.start, low, [low_first, low_degrees]),
            Slots::new(self.points, middle, high, [high_first, high_degrees]),
        ]
    }
}

impl Slots<'_> {
    /// Take the graph of `leaf`, which is on the same vertices, over.
    pub fn load(&mut self, leaf: &Leaf) {
        let (begin, start) = (self.free.fresh.start, self.start as u32);
        for e in 0..leaf.used() {
            let slot = begin + u32::from(e);
            if leaf.is_free(e) {
                if e % 2 == 0 {
                    self.push_free(slot);
                }
                continue;
            }
            let origin = leaf.origin(e) as usize;
            self.first[origin] = slot;
            self.degrees[origin] += 1;
            let [destination, next, prev] =
                [leaf.destination(e), leaf.next(e), leaf.prev(e)].map(u32::from);
            self.half_edges[e as usize] = [destination + start, next + begin, prev + begin];
        }
        self.free.fresh.start = begin + u32::from(leaf.used());
    }

    /// Have the free slots that both halves left.
    pub fn reclaim(&mut self, [low, high]: [FreeSlots; 2]) {
        self.free = low;
        self.free.more.push((high.chain, high.fresh));
        self.free.more.extend(high.more);
    }

    /// What is left of the slots.
    pub fn into_free(self) -> FreeSlots {
        self.free
    }

    #[inline]
    fn slot(&self, e: u32) -> &HalfEdge {
        &self.half_edges[e as usize - SLOTS * self.start]
    }

    #[inline]
    fn slot_mut(&mut self, e: u32) -> &mut HalfEdge {
        &mut self.half_edges[e as usize - SLOTS * self.start]
    }

    fn push_free(&mut self, e: u32) {
        let chain = std::mem::replace(&mut self.free.chain, e);
        self.slot_mut(e)[NEXT] = chain;
    }

    #[inline]
    fn free_slot(&mut self) -> u32 {
        loop {
            let e = self.free.chain;
            if e != NONE {
                self.free.chain = self.slot(e)[NEXT];
                return e;
            }
            if let Some(e) = self.free.fresh.next() {
                // A pair of half-edges.
                self.free.fresh.next();
                return e;
            }
            let more = self.free.more.pop();
            (self.free.chain, self.free.fresh) = more.expect("a planar graph fits in its slots");
        }
    }
}

impl Rings for Slots<'_> {
    type Index = u32;

    #[inline]
    fn destination(&self, e: u32) -> u32 {
        self.slot(e)[DESTINATION]
    }
    #[inline]
    fn next(&self, e: u32) -> u32 {
        self.slot(e)[NEXT]
    }
    #[inline]
    fn prev(&self, e: u32) -> u32 {
        self.slot(e)[PREV]
    }
}

impl Graph for Slots<'_> {
    #[inline]
    fn point(&self, vertex: u32) -> Point {
        self.points[vertex as usize]
    }

    #[inline]
    fn link(&mut self, e: u32, f: u32) {
        self.slot_mut(e)[NEXT] = f;
        self.slot_mut(f)[PREV] = e;
    }

    #[inline]
    fn take(&mut self, a: u32, b: u32) -> u32 {
        let e = self.free_slot();
        for (half, [from, to]) in [(e, [a, b]), (e.twin(), [b, a])] {
            self.slot_mut(half)[DESTINATION] = to;
            let from = from as usize - self.start;
            self.first[from] = half;
            self.degrees[from] += 1;
        }
        e
    }

    #[inline]
    fn give_back(&mut self, e: u32) {
        for half in [e, e.twin()] {
            let origin = self.origin(half) as usize - self.start;
            self.degrees[origin] -= 1;
            if self.first[origin] == half {
                self.first[origin] = self.next(half);
            }
        }
        self.push_free(e & !1);
    }
}
