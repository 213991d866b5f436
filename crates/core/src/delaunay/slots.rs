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

/// Slots that the star of a settled vertex of this degree takes.
fn slots_of_star(degree: u32) -> usize {
    degree.div_ceil(3) as usize
}

/// The slot of half-edge `e` of a leaf, the first of whose pairs are at `pairs`; `NONE` if it is not kept.
#[inline]
fn number(pairs: &[u32], e: u16) -> u32 {
    if e == u16::NONE { NONE } else { pairs[e as usize / 2] | u32::from(e & 1) }
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
    ///
    /// Vertices that are not open are settled: their stars are written down, and half-edges between two of them are not kept.
    pub fn load(
        &mut self,
        leaf: &Leaf,
        extremes: Extremes<u16>,
        is_open: &[bool],
    ) -> Extremes<u32> {
        let start = self.start as u32;
        let mut end = self.free.fresh.start;
        let mut pairs = vec![NONE; leaf.used() as usize / 2];
        let mut around = vec![u16::NONE; is_open.len()];
        self.degrees.fill(0);
        let mut dropped = 0;
        for e in (0..leaf.used()).step_by(2).filter(|&e| !leaf.is_free(e)) {
            let origins = [e, e.twin()].map(|half| leaf.origin(half) as usize);
            for (origin, half) in origins.into_iter().zip([e, e.twin()]) {
                around[origin] = half;
                self.degrees[origin] += 1;
            }
            if origins.into_iter().any(|origin| is_open[origin]) {
                pairs[e as usize / 2] = end;
                end += 2;
            } else {
                dropped += 1;
            }
        }
        let Some(place) = self.room(is_open, dropped) else {
            return self.load(leaf, extremes, &vec![true; is_open.len()]);
        };
        self.free.fresh = end..self.free.fresh.start + place as u32;
        self.settle(leaf, &around, is_open, place);
        self.keep(leaf, &around, is_open, &pairs);
        extremes.map(|HullVertex { vertex, edge }| HullVertex {
            vertex: start + u32::from(vertex),
            edge: number(&pairs, edge),
        })
    }

    /// Where to write stars of settled vertices from, if they take no more slots than the pairs of half-edges that are `dropped` for them:
    /// then all other edges of a planar graph still fit.
    fn room(&self, is_open: &[bool], dropped: usize) -> Option<usize> {
        let settled = self.degrees.iter().zip(is_open).filter(|&(_, &is_open)| !is_open);
        let slots: usize = settled.map(|(&degree, _)| slots_of_star(degree)).sum();
        let slots = slots.next_multiple_of(2);
        (slots <= 2 * dropped).then(|| self.half_edges.len() - slots)
    }

    /// Write the half-edges of `leaf` that are kept to the slots of `pairs`.
    fn keep(&mut self, leaf: &Leaf, around: &[u16], is_open: &[bool], pairs: &[u32]) {
        let start = self.start as u32;
        for (k, _) in pairs.iter().enumerate().filter(|&(_, &pair)| pair != NONE) {
            for e in [2 * k as u16, 2 * k as u16 + 1] {
                let [next, prev] = [leaf.next(e), leaf.prev(e)].map(|other| number(pairs, other));
                let destination = start + u32::from(leaf.destination(e));
                *self.slot_mut(number(pairs, e)) = [destination, next, prev];
            }
        }
        for (v, _) in is_open.iter().enumerate().filter(|&(_, &is_open)| is_open) {
            self.first[v] = number(pairs, around[v]);
        }
    }

    /// Write the stars of the settled vertices from slot number `place` of this range on.
    fn settle(&mut self, leaf: &Leaf, around: &[u16], is_open: &[bool], mut place: usize) {
        for (v, &e) in around.iter().enumerate().filter(|&(v, _)| !is_open[v]) {
            let slots = &mut self.half_edges[place..place + slots_of_star(self.degrees[v])];
            let star = &mut slots.as_flattened_mut()[..self.degrees[v] as usize];
            leaf.write_star(v, e, star);
            for neighbor in star {
                *neighbor += self.start as u32;
            }
            self.is_settled[v] = true;
            self.first[v] = (SLOTS * self.start + place) as u32;
            place += slots_of_star(self.degrees[v]);
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
