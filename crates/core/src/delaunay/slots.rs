//! The graph of any number of vertices, in memory that the halves of a cell share out among them.

use super::hull::{Extremes, HullVertex};
use super::leaf::Leaf;
use super::rings::{Graph, Index, NONE, Rings};
use crate::parts::{copies, give_back};
use crate::point::Point;
use std::ops::Range;

/// Slots for half-edges per vertex: an edge has two, and there are fewer than three edges a vertex.
pub const SLOTS: usize = 6;

/// A half-edge: the vertex that it leads to, the next one counter-clockwise around its origin, the next one clockwise.
pub type HalfEdge = [u32; 3];

const DESTINATION: usize = 0;
const NEXT: usize = 1;
const PREV: usize = 2;

/// The slot of half-edge `e` of a leaf whose pairs are at `pairs`; `NONE` if it is not kept.
#[inline]
fn number(pairs: &[u32], e: u16) -> u32 {
    pairs[e as usize / 2] | u32::from(e & 1)
}

/// A half-edge from each of the `count` vertices of `leaf`, if it has one.
fn around(leaf: &Leaf, count: usize) -> Vec<u16> {
    let mut around = vec![u16::NONE; count];
    for e in (0..leaf.used()).filter(|&e| !leaf.is_free(e)) {
        around[leaf.origin(e) as usize] = e;
    }
    around
}

/// Memory for the graph of all vertices.
pub struct Memory {
    half_edges: Vec<HalfEdge>,
    /// Is it known of a vertex that no merge touches it? Then its neighbors are in the slots from its `first` on.
    is_settled: Vec<bool>,
}

impl Memory {
    /// For the graph of `count` vertices.
    pub fn new(count: usize) -> Self {
        let half_edges = vec![HalfEdge::default(); SLOTS * count];
        Self { half_edges, is_settled: copies(false, count) }
    }

    /// Give it back on another thread, if there is one.
    pub fn give_back(self) {
        give_back(self.half_edges);
    }
}

impl Rings for Memory {
    type Index = u32;

    #[inline]
    fn destination(&self, e: u32) -> u32 {
        self.half_edges[e as usize][DESTINATION]
    }
    #[inline]
    fn next(&self, e: u32) -> u32 {
        self.half_edges[e as usize][NEXT]
    }
    #[inline]
    fn prev(&self, e: u32) -> u32 {
        self.half_edges[e as usize][PREV]
    }
    #[inline]
    fn write_star(&self, vertex: usize, first: u32, star: &mut [u32]) {
        if self.is_settled[vertex] {
            let neighbors = self.half_edges[first as usize..].as_flattened();
            star.copy_from_slice(&neighbors[..star.len()]);
        } else {
            self.write_ring(first, star);
        }
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
    is_settled: &'a mut [bool],
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
    /// A graph without edges on all `points`.
    pub fn on(
        points: &'a [Point],
        memory: &'a mut Memory,
        of_vertices: [&'a mut [u32]; 2],
    ) -> Self {
        Self::new(points, 0, &mut memory.half_edges, of_vertices, &mut memory.is_settled)
    }

    /// A graph without edges on the vertices from `start`, which are among `points`.
    fn new(
        points: &'a [Point],
        start: usize,
        half_edges: &'a mut [HalfEdge],
        [first, degrees]: [&'a mut [u32]; 2],
        is_settled: &'a mut [bool],
    ) -> Self {
        let begin = SLOTS * start;
        let fresh = begin as u32..(begin + half_edges.len()) as u32;
        let free = FreeSlots { chain: NONE, fresh, more: Vec::new() };
        Self { points, start, half_edges, first, degrees, is_settled, free }
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
        let (low_settled, high_settled) = self.is_settled.split_at_mut(count);
        [
            Slots::new(self.points, self.start, low, [low_first, low_degrees], low_settled),
            Slots::new(self.points, middle, high, [high_first, high_degrees], high_settled),
        ]
    }
}

impl Slots<'_> {
    /// Take the graph of `leaf`, which is on the same vertices, over; return the extremes of its hull in the numbers of the whole.
    pub fn load(
        &mut self,
        leaf: &Leaf,
        extremes: Extremes<u16>,
        is_open: Option<Vec<bool>>,
    ) -> Extremes<u32> {
        let (start, begin) = (self.start as u32, self.free.fresh.start);
        let pairs = is_open.and_then(|is_open| self.load_open(leaf, &is_open));
        if pairs.is_none() {
            self.load_whole(leaf);
        }
        let slot = |e: u16| pairs.as_ref().map_or(begin + u32::from(e), |pairs| number(pairs, e));
        extremes.map(|HullVertex { vertex, edge }| HullVertex {
            vertex: start + u32::from(vertex),
            edge: if edge == u16::NONE { NONE } else { slot(edge) },
        })
    }

    /// Take all half-edges over, each at its number.
    fn load_whole(&mut self, leaf: &Leaf) {
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

    /// Write the stars of vertices that are not open, which are settled, and keep no half-edges between two of them; return where
    /// the pairs of the others are.
    ///
    /// None if the stars take more slots than those half-edges would: then the other edges of a planar graph might not fit.
    fn load_open(&mut self, leaf: &Leaf, is_open: &[bool]) -> Option<Vec<u32>> {
        let around = around(leaf, is_open.len());
        let begin = self.free.fresh.start;
        let first = begin + self.settle(leaf, &around, is_open);
        let mut pairs = vec![NONE; leaf.used() as usize / 2];
        let end = self.number_pairs(leaf, &around, is_open, first, &mut pairs);
        let dropped = (self.degrees.iter().sum::<u32>() - (end - first)) / 2;
        if first - begin > 2 * dropped {
            self.is_settled.fill(false);
            self.degrees.fill(0);
            return None;
        }
        self.free.fresh.start = end;
        self.keep(leaf, &pairs);
        Some(pairs)
    }

    /// Write the stars of the settled vertices to the first slots; return how many these are.
    fn settle(&mut self, leaf: &Leaf, around: &[u16], is_open: &[bool]) -> u32 {
        let (mut slot, start) = (0, self.start as u32);
        for (v, &first) in around.iter().enumerate().filter(|&(v, _)| !is_open[v]) {
            let mut degree = 0;
            let star = self.half_edges[slot..].as_flattened_mut();
            let mut e = first;
            for neighbor in star {
                *neighbor = start + u32::from(leaf.destination(e));
                degree += 1;
                e = leaf.next(e);
                if e == first {
                    break;
                }
            }
            self.is_settled[v] = true;
            self.first[v] = (SLOTS * self.start + slot) as u32;
            self.degrees[v] = degree;
            slot += degree.div_ceil(3) as usize;
        }
        slot.next_multiple_of(2) as u32
    }

    /// Give the pairs of half-edges with an open end slots from `first` on; return where these end.
    fn number_pairs(
        &mut self,
        leaf: &Leaf,
        around: &[u16],
        is_open: &[bool],
        first: u32,
        pairs: &mut [u32],
    ) -> u32 {
        let mut end = first;
        for (v, &start) in around.iter().enumerate().filter(|&(v, _)| is_open[v]) {
            let mut degree = 0;
            let mut e = start;
            loop {
                let pair = &mut pairs[e as usize / 2];
                if *pair == NONE {
                    *pair = end;
                    end += 2;
                }
                degree += 1;
                e = leaf.next(e);
                if e == start {
                    break;
                }
            }
            self.first[v] = number(pairs, start);
            self.degrees[v] = degree;
        }
        end
    }

    /// Write the half-edges of `leaf` that are kept to the slots of `pairs`.
    fn keep(&mut self, leaf: &Leaf, pairs: &[u32]) {
        let start = self.start as u32;
        for (k, _) in pairs.iter().enumerate().filter(|&(_, &pair)| pair != NONE) {
            for e in [2 * k as u16, 2 * k as u16 + 1] {
                let [next, prev] = [leaf.next(e), leaf.prev(e)].map(|other| number(pairs, other));
                let destination = start + u32::from(leaf.destination(e));
                *self.slot_mut(number(pairs, e)) = [destination, next, prev];
            }
        }
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
