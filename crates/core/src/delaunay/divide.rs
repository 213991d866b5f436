//! Divide and conquer: triangulate the halves of a cell, then zip them together.
//!
//! The merge is that of Guibas and Stolfi (see [`zip`](super::zip)); cutting cells alternately by vertical and
//! horizontal lines is R. A. Dwyer's, "A Faster Divide-and-Conquer Algorithm for Constructing Delaunay
//! Triangulations", Algorithmica 2 (1987). The cuts are those of the Z-order curve, so they depend on the
//! points alone, and the halves, which share nothing, can be triangulated at the same time.

use super::hull::{Cut, Extremes, HullVertex};
use super::leaf::Leaf;
use super::rings::{Index, NONE};
use super::slots::{SLOTS, Slots};
use super::zip::merge;
use crate::error::Result;
use crate::point::Point;
use crate::progress::Progress;
use crate::space::order::Grid;

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

/// Triangulate the vertices of `graph`, which has no edges yet.
pub fn triangulate(
    vertices: Vertices<'_>,
    graph: &mut Slots<'_>,
    progress: &Progress,
) -> Result<Extremes<u32>> {
    let range = graph.range();
    let points = &vertices.points[range.clone()];
    if range.len() <= vertices.leaf {
        let extremes = Leaf::with(points, vertices.grid, |leaf, extremes| {
            graph.load(leaf);
            extremes.map(|vertex| globally(vertex, range.start))
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

/// A vertex of the hull of a leaf whose first vertex is number `start`, in the numbers of the whole.
fn globally(HullVertex { vertex, edge }: HullVertex<u16>, start: usize) -> HullVertex<u32> {
    let edge = if edge == u16::NONE { NONE } else { (SLOTS * start) as u32 + u32::from(edge) };
    HullVertex { vertex: start as u32 + u32::from(vertex), edge }
}
