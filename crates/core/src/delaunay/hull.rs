//! What a merge asks of the hull of a triangulation: where to start on each side of a cut.

use super::rings::{Graph, Index};
use crate::point::Point;

/// How a cell is cut in two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// By a vertical line: left before right, ties from below.
    Vertical,
    /// By a horizontal line: below before above, ties from the right.
    Horizontal,
}

impl Cut {
    /// Where, and how, to cut a cell of vertices in the order of their codes: at the leading bit in which these differ.
    #[inline]
    pub fn of<T>(vertices: &[T], code: impl Fn(&T) -> u64) -> (usize, Self) {
        let differing = code(&vertices[0]) ^ code(&vertices[vertices.len() - 1]);
        if differing == 0 {
            // Too close together for the code; these are sorted by x, then y.
            return (vertices.len() / 2, Self::Vertical);
        }
        let bit = differing.ilog2();
        let middle = vertices.partition_point(|vertex| code(vertex) >> bit & 1 == 0);
        (middle, if bit % 2 == 1 { Self::Vertical } else { Self::Horizontal })
    }

    #[inline]
    fn precedes(self, a: Point, b: Point) -> bool {
        match self {
            Self::Vertical => a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]),
            Self::Horizontal => a[1] < b[1] || (a[1] == b[1] && a[0] > b[0]),
        }
    }
}

/// A vertex of the hull and the half-edge from it to the next one counter-clockwise.
///
/// `edge` is `NONE` while the vertex is alone.
#[derive(Debug, Clone, Copy)]
pub struct HullVertex<I> {
    /// The vertex.
    pub vertex: I,
    /// The half-edge to the next vertex of the hull.
    pub edge: I,
}

/// The first and last vertex of a triangulation in each of the two orders of [`Cut`].
#[derive(Debug, Clone, Copy)]
pub struct Extremes<I> {
    /// First in the order of a vertical cut.
    pub left: HullVertex<I>,
    /// Last in the order of a vertical cut.
    pub right: HullVertex<I>,
    /// First in the order of a horizontal cut.
    pub bottom: HullVertex<I>,
    /// Last in the order of a horizontal cut.
    pub top: HullVertex<I>,
}

impl<I: Index> Extremes<I> {
    /// The extremes among `hull`, which holds them.
    #[inline]
    pub fn of<G: Graph<Index = I>>(hull: &[HullVertex<I>], graph: &G) -> Self {
        let start = hull[0];
        let mut all = Self { left: start, right: start, bottom: start, top: start };
        for &vertex in &hull[1..] {
            all.left = earlier(Cut::Vertical, all.left, vertex, graph);
            all.right = later(Cut::Vertical, all.right, vertex, graph);
            all.bottom = earlier(Cut::Horizontal, all.bottom, vertex, graph);
            all.top = later(Cut::Horizontal, all.top, vertex, graph);
        }
        all
    }

    /// The extremes of two cells on the two sides of a cut; across the cut there is nothing to compare.
    #[inline]
    pub fn join<G: Graph<Index = I>>(self, high: Self, cut: Cut, graph: &G) -> Self {
        match cut {
            Cut::Vertical => Self {
                left: self.left,
                right: high.right,
                bottom: earlier(Cut::Horizontal, self.bottom, high.bottom, graph),
                top: later(Cut::Horizontal, self.top, high.top, graph),
            },
            Cut::Horizontal => Self {
                left: earlier(Cut::Vertical, self.left, high.left, graph),
                right: later(Cut::Vertical, self.right, high.right, graph),
                bottom: self.bottom,
                top: high.top,
            },
        }
    }

    /// Let `edge` lead on from `vertex`, if that is an extreme.
    #[inline]
    pub fn update(&mut self, vertex: I, edge: I) {
        for extreme in [&mut self.left, &mut self.right, &mut self.bottom, &mut self.top] {
            if extreme.vertex == vertex {
                extreme.edge = edge;
            }
        }
    }

    /// The same in other numbers.
    pub fn map<J>(self, number: impl Fn(HullVertex<I>) -> HullVertex<J>) -> Extremes<J> {
        let Self { left, right, bottom, top } = self;
        let [left, right, bottom, top] = [left, right, bottom, top].map(number);
        Extremes { left, right, bottom, top }
    }
}

#[inline]
fn earlier<G: Graph>(
    cut: Cut,
    a: HullVertex<G::Index>,
    b: HullVertex<G::Index>,
    graph: &G,
) -> HullVertex<G::Index> {
    if cut.precedes(graph.point(b.vertex), graph.point(a.vertex)) { b } else { a }
}

#[inline]
fn later<G: Graph>(
    cut: Cut,
    a: HullVertex<G::Index>,
    b: HullVertex<G::Index>,
    graph: &G,
) -> HullVertex<G::Index> {
    if cut.precedes(graph.point(a.vertex), graph.point(b.vertex)) { b } else { a }
}
