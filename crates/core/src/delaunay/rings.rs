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

/// The slots not in use: a chain of those used before, and a range of those never used.
#[derive(Debug)]
pub struct FreeSlots {
    chain: u32,
    fresh: std::ops::Range<u32>,
    /// What else there is, from joining neighbors.
    more: Vec<(u32, std::ops::Range<u32>)>,
}

impl FreeSlots {
    /// All of `range`, never used.
    pub fn fresh(range: std::ops::Range<u32>) -> Self {
        Self { chain: NONE, fresh: range, more: Vec::new() }
    }

    /// The free slots of two neighboring graphs.
    pub fn join(mut self, other: Self) -> Self {
        self.more.push((other.chain, other.fresh));
        self.more.extend(other.more);
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

    /// Add the edge from `a` to `b`, right before (clockwise) `before` in the ring of a, and right after `after` in the ring of b;
    /// `NONE` where the ring is empty. Return the half-edge a → b.
    #[inline]
    pub fn add(&mut self, a: u32, b: u32, before: u32, after: u32) -> u32 {
        let e = self.take_slot();
        let twin = e ^ 1;
        let prev = if before == NONE { e } else { self.prev(before) };
        let next = if after == NONE { twin } else { self.next(after) };
        *self.slot_mut(e) =
            HalfEdge { origin: a, next: if before == NONE { e } else { before }, prev };
        *self.slot_mut(twin) =
            HalfEdge { origin: b, next, prev: if after == NONE { twin } else { after } };
        self.slot_mut(prev).next = e;
        self.slot_mut(next).prev = twin;
        if before != NONE {
            self.slot_mut(before).prev = e;
        }
        if after != NONE {
            self.slot_mut(after).next = twin;
        }
        e
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
        let chain = std::mem::replace(&mut self.free.chain, even);
        self.slot_mut(even).next = chain;
    }

    /// A planar graph on k vertices has at most 3k − 6 edges, so there is always a slot.
    #[inline]
    fn take_slot(&mut self) -> u32 {
        loop {
            let e = self.free.chain;
            if e != NONE {
                self.free.chain = self.slot(e).next;
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
