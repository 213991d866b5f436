//! Half-edges in rings around their origins: the edge algebra of Guibas and Stolfi, primal part only.
//!
//! L. Guibas and J. Stolfi, "Primitives
//! for the Manipulation of General Subdivisions and the Computation of Voronoi Diagrams", ACM
//! Transactions on Graphics 4 (1985).

use crate::point::Point;

/// No half-edge, or no vertex.
pub const NONE: u32 = u32::MAX;

/// The number of a vertex or of a half-edge; twins are an even number and the odd one that follows it.
pub trait Index: Copy + Eq {
    /// No vertex, no half-edge.
    const NONE: Self;
    /// The other direction of the same edge.
    #[must_use]
    fn twin(self) -> Self;
}

macro_rules! index {
    ($($integer:ty),*) => {$(
        impl Index for $integer {
            const NONE: Self = Self::MAX;
            #[inline]
            fn twin(self) -> Self {
                self ^ 1
            }
        }
    )*};
}

index!(u16, u32);

/// Half-edges that know where they lead and their neighbors in the ring of those with the same origin.
pub trait Rings {
    /// How vertices and half-edges are numbered.
    type Index: Index;

    /// The vertex that `e` ends at.
    fn destination(&self, e: Self::Index) -> Self::Index;
    /// The next half-edge counter-clockwise around the origin (Onext).
    fn next(&self, e: Self::Index) -> Self::Index;
    /// The next half-edge clockwise around the origin (Oprev).
    fn prev(&self, e: Self::Index) -> Self::Index;

    /// The vertex that `e` starts at.
    #[inline]
    fn origin(&self, e: Self::Index) -> Self::Index {
        self.destination(e.twin())
    }

    /// Write the neighbors of `vertex`, counter-clockwise from the one that `e` leads to, to `star`, which has room for just these.
    #[inline]
    fn write_star(&self, _vertex: usize, e: Self::Index, star: &mut [u32])
    where
        Self::Index: Into<u32>,
    {
        self.write_ring(e, star);
    }

    /// Write where the half-edges around an origin lead to, counter-clockwise from `e` on.
    #[inline]
    fn write_ring(&self, mut e: Self::Index, star: &mut [u32])
    where
        Self::Index: Into<u32>,
    {
        for neighbor in star {
            *neighbor = self.destination(e).into();
            e = self.next(e);
        }
    }
}

/// The half-edges of the hull from `start` on, counter-clockwise, the outside to their right; none if there is no `start`.
pub fn hull_edges<R: Rings + ?Sized>(graph: &R, start: R::Index) -> impl Iterator<Item = R::Index> {
    let first = (start != R::Index::NONE).then_some(start);
    std::iter::successors(first, move |e| {
        let next = graph.next(e.twin());
        (next != start).then_some(next)
    })
}

/// A planar graph of points at work.
pub trait Graph: Rings {
    /// The point of a vertex.
    fn point(&self, vertex: Self::Index) -> Point;
    /// Let `f` follow `e`, counter-clockwise.
    fn link(&mut self, e: Self::Index, f: Self::Index);
    /// Two half-edges not in use, from `a` to `b` and back, not linked yet; the first is returned.
    ///
    /// A planar graph on k vertices has at most 3k − 6 edges, so memory for 3k is never short of one.
    fn take(&mut self, a: Self::Index, b: Self::Index) -> Self::Index;
    /// Give `e` and its twin back.
    fn give_back(&mut self, e: Self::Index);

    /// The point that `e` ends at.
    #[inline]
    fn end(&self, e: Self::Index) -> Point {
        self.point(self.destination(e))
    }

    /// Put `e`, which is in no ring, right after `f` in its ring.
    #[inline]
    fn insert(&mut self, e: Self::Index, f: Self::Index) {
        let next = self.next(f);
        self.link(f, e);
        self.link(e, next);
    }

    /// Add the edge from `a` to `b`, right before (clockwise) `before` in the ring of a, and right after `after` in the ring
    /// of b. Return the half-edge a → b.
    #[inline]
    fn add(
        &mut self,
        [a, b]: [Self::Index; 2],
        before: Self::Index,
        after: Self::Index,
    ) -> Self::Index {
        let e = self.take(a, b);
        self.insert(e, self.prev(before));
        self.insert(e.twin(), after);
        e
    }

    /// As [`add`](Self::add), where `before` and `after` are `NONE` if the ring is empty.
    fn add_first(
        &mut self,
        [a, b]: [Self::Index; 2],
        before: Self::Index,
        after: Self::Index,
    ) -> Self::Index {
        let e = self.take(a, b);
        self.link(e, e);
        self.link(e.twin(), e.twin());
        if before != Self::Index::NONE {
            self.insert(e, self.prev(before));
        }
        if after != Self::Index::NONE {
            self.insert(e.twin(), after);
        }
        e
    }

    /// Take the edge of `e` out of both rings.
    #[inline]
    fn remove(&mut self, e: Self::Index) {
        for half in [e, e.twin()] {
            let (prev, next) = (self.prev(half), self.next(half));
            self.link(prev, next);
        }
        self.give_back(e);
    }
}
