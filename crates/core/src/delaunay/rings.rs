//! Half-edges in rings around their origins: the edge algebra of Guibas and Stolfi, primal part only.
//!
//! Half-edges `e` and `e ^ 1` are the two directions of one edge. L. Guibas and J. Stolfi, "Primitives
//! for the Manipulation of General Subdivisions and the Computation of Voronoi Diagrams", ACM
//! Transactions on Graphics 4 (1985).

/// No half-edge, or no vertex.
pub const NONE: u32 = u32::MAX;

/// A half-edge: the vertex that it starts at, plus 1; the next one counter-clockwise around that; the next one clockwise.
///
/// All zero in a slot never used: such memory comes from the system as it is, page by page, to the thread that uses it.
pub type HalfEdge = [u32; 3];

const ORIGIN: usize = 0;
const NEXT: usize = 1;
const PREV: usize = 2;

/// The vertex that half-edge `e` starts at; `None` in a free slot.
#[inline]
pub fn origin(slots: &[HalfEdge], e: u32) -> Option<u32> {
    slots[e as usize][ORIGIN].checked_sub(1)
}

/// The vertex that half-edge `e` ends at.
#[inline]
pub fn destination(slots: &[HalfEdge], e: u32) -> u32 {
    slots[(e ^ 1) as usize][ORIGIN] - 1
}

/// The next half-edge counter-clockwise around the origin of `e`.
#[inline]
pub fn next(slots: &[HalfEdge], e: u32) -> u32 {
    slots[e as usize][NEXT]
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
        self.slot(e)[ORIGIN] - 1
    }

    /// The vertex that `e` ends at.
    #[inline]
    pub fn destination(&self, e: u32) -> u32 {
        self.slot(e ^ 1)[ORIGIN] - 1
    }

    /// The next half-edge counter-clockwise around the origin (Onext).
    #[inline]
    pub fn next(&self, e: u32) -> u32 {
        self.slot(e)[NEXT]
    }

    /// The next half-edge clockwise around the origin (Oprev).
    #[inline]
    pub fn prev(&self, e: u32) -> u32 {
        self.slot(e)[PREV]
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
        *self.slot_mut(e) = [a + 1, if before == NONE { e } else { before }, prev];
        *self.slot_mut(twin) = [b + 1, next, if after == NONE { twin } else { after }];
        self.slot_mut(prev)[NEXT] = e;
        self.slot_mut(next)[PREV] = twin;
        if before != NONE {
            self.slot_mut(before)[PREV] = e;
        }
        if after != NONE {
            self.slot_mut(after)[NEXT] = twin;
        }
        e
    }

    /// Take the edge of `e` out of both rings and free its slots.
    #[inline]
    pub fn remove(&mut self, e: u32) {
        for half in [e, e ^ 1] {
            let [_, next, prev] = *self.slot(half);
            self.slot_mut(prev)[NEXT] = next;
            self.slot_mut(next)[PREV] = prev;
            self.slot_mut(half)[ORIGIN] = 0;
        }
        let even = e & !1;
        let chain = std::mem::replace(&mut self.free.chain, even);
        self.slot_mut(even)[NEXT] = chain;
    }

    /// A planar graph on k vertices has at most 3k − 6 edges, so there is always a slot.
    #[inline]
    fn take_slot(&mut self) -> u32 {
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
