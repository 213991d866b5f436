//! Half-edges in rings around their origins: the edge algebra of Guibas and Stolfi, primal part only.
//!
//! Half-edges `e` and `e ^ 1` are the two directions of one edge. L. Guibas and J. Stolfi, "Primitives
//! for the Manipulation of General Subdivisions and the Computation of Voronoi Diagrams", ACM
//! Transactions on Graphics 4 (1985).

/// No half-edge, or no vertex.
pub const NONE: u32 = u32::MAX;

/// A half-edge: where it starts, and its neighbors in the ring of half-edges that start there.
#[derive(Debug, Clone, Copy)]
pub struct HalfEdge {
    /// The vertex that it starts at; `NONE` in a free slot.
    pub origin: u32,
    /// The next one counter-clockwise around the origin; in a free slot, the next free slot.
    next: u32,
    /// The next one clockwise around the origin.
    prev: u32,
}

impl HalfEdge {
    /// A slot that holds no half-edge.
    pub const FREE: Self = Self { origin: NONE, next: NONE, prev: NONE };

    /// The next half-edge counter-clockwise around the origin.
    #[inline]
    pub fn next(self) -> u32 {
        self.next
    }
}

/// A planar graph on a range of vertices, in a slice of slots of its own.
///
/// Half-edges are numbered through all slices: the first slot of this one has the number `first`.
pub struct Rings<'a> {
    slots: &'a mut [HalfEdge],
    first: u32,
    free: FreeSlots,
}

/// The slots not in use: chains of those used before, and ranges of those never used.
#[derive(Debug, Default)]
pub struct FreeSlots {
    chains: Vec<u32>,
    fresh: Vec<std::ops::Range<u32>>,
}

impl FreeSlots {
    /// All of `range`, never used.
    pub fn fresh(range: std::ops::Range<u32>) -> Self {
        Self { chains: Vec::new(), fresh: vec![range] }
    }

    /// The free slots of two neighboring graphs.
    pub fn join(mut self, other: Self) -> Self {
        self.chains.extend(other.chains);
        self.fresh.extend(other.fresh);
        self
    }
}

impl<'a> Rings<'a> {
    /// A graph in `slots`, of which `free` are free.
    pub fn new(slots: &'a mut [HalfEdge], first: u32, free: FreeSlots) -> Self {
        Self { slots, first, free }
    }

    /// What is left of the slots.
    pub fn into_free(self) -> FreeSlots {
        self.free
    }

    #[inline]
    fn slot(&self, e: u32) -> &HalfEdge {
        &self.slots[(e - self.first) as usize]
    }

    #[inline]
    fn slot_mut(&mut self, e: u32) -> &mut HalfEdge {
        &mut self.slots[(e - self.first) as usize]
    }

    /// The vertex that `e` starts at.
    #[inline]
    pub fn origin(&self, e: u32) -> u32 {
        self.slot(e).origin
    }

    /// The vertex that `e` ends at.
    #[inline]
    pub fn destination(&self, e: u32) -> u32 {
        self.slot(e ^ 1).origin
    }

    /// The next half-edge counter-clockwise around the origin (Onext).
    #[inline]
    pub fn next(&self, e: u32) -> u32 {
        self.slot(e).next
    }

    /// The next half-edge clockwise around the origin (Oprev).
    #[inline]
    pub fn prev(&self, e: u32) -> u32 {
        self.slot(e).prev
    }

    /// The next half-edge around the face to the left (Lnext).
    #[inline]
    pub fn left_next(&self, e: u32) -> u32 {
        self.prev(e ^ 1)
    }

    /// The half-edge from the destination of `e` that bounds the same face to the right (Rprev, reversed).
    #[inline]
    pub fn right_prev(&self, e: u32) -> u32 {
        self.next(e ^ 1)
    }

    /// Add the edge from `a` to `b`, not yet in the rings of other edges; return the half-edge a → b.
    #[inline]
    pub fn add(&mut self, a: u32, b: u32) -> u32 {
        let e = self.take_slot();
        *self.slot_mut(e) = HalfEdge { origin: a, next: e, prev: e };
        *self.slot_mut(e ^ 1) = HalfEdge { origin: b, next: e ^ 1, prev: e ^ 1 };
        e
    }

    /// Put the lone half-edge `e` right before `at`, clockwise, in the ring of their origin.
    #[inline]
    pub fn insert_before(&mut self, e: u32, at: u32) {
        let before = self.prev(at);
        self.insert_between(before, e, at);
    }

    /// Put the lone half-edge `e` right after `at`, counter-clockwise, in the ring of their origin.
    #[inline]
    pub fn insert_after(&mut self, e: u32, at: u32) {
        let after = self.next(at);
        self.insert_between(at, e, after);
    }

    #[inline]
    fn insert_between(&mut self, before: u32, e: u32, after: u32) {
        self.slot_mut(before).next = e;
        self.slot_mut(after).prev = e;
        let slot = self.slot_mut(e);
        (slot.prev, slot.next) = (before, after);
    }

    /// Take the edge of `e` out of both rings and free its slots.
    #[inline]
    pub fn remove(&mut self, e: u32) {
        for half in [e, e ^ 1] {
            let HalfEdge { next, prev, .. } = *self.slot(half);
            self.slot_mut(prev).next = next;
            self.slot_mut(next).prev = prev;
            self.slot_mut(half).origin = NONE;
        }
        let even = e & !1;
        if self.free.chains.is_empty() {
            self.free.chains.push(NONE);
        }
        let head = self.free.chains.last_mut().expect("there is one now");
        self.slots[(even - self.first) as usize].next = std::mem::replace(head, even);
    }

    /// A planar graph on k vertices has at most 3k − 6 edges, so there is always a slot.
    #[inline]
    fn take_slot(&mut self) -> u32 {
        while let Some(head) = self.free.chains.last_mut() {
            let e = *head;
            if e != NONE {
                *head = self.slots[(e - self.first) as usize].next;
                return e;
            }
            self.free.chains.pop();
        }
        let range = self.free.fresh.last_mut().expect("a planar graph fits in its slots");
        let e = range.start;
        range.start += 2;
        if range.start == range.end {
            self.free.fresh.pop();
        }
        e
    }
}
