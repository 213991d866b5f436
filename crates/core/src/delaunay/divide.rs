//! Divide and conquer: triangulate the halves of a cell, then zip them together.
//!
//! The merge is that of Guibas and Stolfi (see [`zip`](super::zip)); cutting cells alternately by vertical and
//! horizontal lines is R. A. Dwyer's, "A Faster Divide-and-Conquer Algorithm for Constructing Delaunay
//! Triangulations", Algorithmica 2 (1987). The cuts are those of the Z-order curve, so they depend on the
//! points alone, and the halves, which share nothing, can be triangulated at the same time.

use super::hull::{Cut, Extremes};
use super::leaf::Leaf;
use super::settled::open_vertices;
use super::slots::Slots;
use super::zip::merge;
use crate::error::Result;
use crate::point::Point;
use crate::progress::Progress;
use crate::space::bounds::Bounds;
use crate::space::order::Grid;
use std::ops::Range;

/// The vertices of all cells.
#[derive(Clone, Copy)]
pub struct Vertices<'a> {
    /// Distinct points along the Z-order curve.
    pub points: &'a [Point],
    /// What gives their codes.
    pub grid: &'a Grid,
    /// The most vertices of a leaf, which is one task, and one report of progress.
    pub leaf: usize,
}

impl Vertices<'_> {
    /// Is no other vertex in the rectangle around those of `range`? It holds no others than these if no code is on both sides of an end.
    fn is_cell(&self, range: &Range<usize>) -> bool {
        let parts_codes = |at: usize| {
            let codes = [at - 1, at].map(|v| self.grid.code(self.points[v]));
            codes[0] != codes[1]
        };
        (range.start == 0 || parts_codes(range.start))
            && (range.end == self.points.len() || parts_codes(range.end))
    }
}

/// Triangulate the vertices of `graph`, which has no edges yet.
pub fn triangulate(
    vertices: Vertices<'_>,
    graph: &mut Slots<'_>,
    progress: &Progress,
) -> Result<Extremes<u32>> {
    let range = graph.range();
    let points = &vertices.points[range.clone()];
    if range.len() <= vertices.leaf {
        let bounds = if vertices.is_cell(&range) { Bounds::of(points) } else { Bounds::EMPTY };
        let extremes = Leaf::with(points, vertices.grid, |leaf, extremes| {
            let is_open = open_vertices(leaf, points.len(), extremes.left.edge, &bounds);
            graph.load(leaf, extremes, is_open)
        });
        progress.advance(range.len())?;
        return Ok(extremes);
    }
    let (middle, cut) = Cut::of(points, |&point| vertices.grid.code(point));
    let [mut low, mut high] = graph.halves(range.start + middle);
    let (a, b) = rayon::join(
        || triangulate(vertices, &mut low, progress),
        || triangulate(vertices, &mut high, progress),
    );
    let free = [low.into_free(), high.into_free()];
    graph.reclaim(free);
    progress.advance(0)?;
    Ok(merge(graph, a?, b?, cut))
}
