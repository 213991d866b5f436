//! The triangulation as stars: the neighbors of each vertex, counter-clockwise, one after another in memory.
//!
//! This is all that selection needs: a wedge, two successive neighbors of a vertex, is a triangle, and its
//! circumcenter a corner of the vertex's Voronoi cell.

use super::divide::SLOTS;
use super::rings::{HalfEdge, NONE};
use crate::error::Result;
use crate::progress::{Progress, Stage};
use rayon::prelude::*;

/// Vertices that one task takes at a time.
const GRAIN: usize = 1 << 13;

/// The neighbors of every vertex.
#[derive(Debug, Clone, Default)]
pub struct Stars {
    /// `neighbors[offsets[v]..offsets[v + 1]]` is the star of v.
    offsets: Vec<u32>,
    neighbors: Vec<u32>,
    on_hull: Vec<bool>,
}

/// The neighbors of one vertex, counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub struct Star<'a> {
    /// The neighbors. On the hull the first is the next vertex of the hull, the last the one before.
    pub neighbors: &'a [u32],
    /// Is the vertex on the hull, so that no triangle spans the last and the first neighbor?
    pub on_hull: bool,
    /// Are all vertices in one line, so that there is no triangle at all?
    flat: bool,
}

impl<'a> Star<'a> {
    /// The neighbor after number `k`, if a triangle spans the two: the apex to the left of v → `neighbors[k]`.
    #[inline]
    #[must_use]
    pub fn left(&self, k: usize) -> Option<u32> {
        if self.flat {
            return None;
        }
        match self.neighbors.get(k + 1) {
            Some(&next) => Some(next),
            None if self.on_hull => None,
            None => Some(self.neighbors[0]),
        }
    }

    /// The neighbor before number `k`, if a triangle spans the two: the apex to the right of v → `neighbors[k]`.
    #[inline]
    #[must_use]
    pub fn right(&self, k: usize) -> Option<u32> {
        if self.flat {
            None
        } else if k > 0 {
            Some(self.neighbors[k - 1])
        } else if self.on_hull {
            None
        } else {
            self.neighbors.last().copied()
        }
    }

    /// The wedges: pairs of successive neighbors that a triangle spans.
    pub fn wedges(&self) -> impl Iterator<Item = (u32, u32)> + use<'a> {
        let star = *self;
        (0..star.neighbors.len()).filter_map(move |k| Some((star.neighbors[k], star.left(k)?)))
    }
}

impl Stars {
    /// Collect the stars, and the hull, of the finished graph of `vertices` vertices in `slots`.
    ///
    /// `hull` is a half-edge of the hull, the outside to its right, or `NONE` if there are no edges.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn collect(
        slots: &[HalfEdge],
        vertices: usize,
        hull: u32,
        progress: &Progress,
    ) -> Result<(Self, Vec<u32>)> {
        progress.enter(Stage::Stars, vertices)?;
        let mut first = first_half_edges(slots, vertices);
        let hull = walk_hull(slots, hull, &mut first);
        let mut on_hull = vec![false; vertices];
        for &vertex in &hull {
            on_hull[vertex as usize] = true;
        }
        let parts = first
            .par_chunks(GRAIN)
            .map(|first| {
                progress.advance(first.len())?;
                Ok(Part::collect(slots, first))
            })
            .collect::<Result<Vec<_>>>()?;
        let (offsets, neighbors) = Part::concatenate(parts, vertices);
        Ok((Self { offsets, neighbors, on_hull }, hull))
    }

    /// The star of `vertex`.
    #[inline]
    #[must_use]
    pub fn star(&self, vertex: u32) -> Star<'_> {
        let v = vertex as usize;
        let (start, end) = (self.offsets[v] as usize, self.offsets[v + 1] as usize);
        Star {
            neighbors: &self.neighbors[start..end],
            on_hull: self.on_hull[v],
            flat: self.is_flat(),
        }
    }

    /// Where the star of `vertex` starts in the row of all neighbors.
    #[must_use]
    pub fn offset(&self, vertex: u32) -> usize {
        self.offsets[vertex as usize] as usize
    }

    /// Are all vertices in one line? A path has one edge less than vertices, all other triangulations have more.
    #[inline]
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.neighbors.len() < 2 * self.on_hull.len()
    }

    /// The number of half-edges.
    #[must_use]
    pub fn half_edges(&self) -> usize {
        self.neighbors.len()
    }
}

/// A half-edge that starts at each vertex; `NONE` at a lone vertex.
fn first_half_edges(slots: &[HalfEdge], vertices: usize) -> Vec<u32> {
    let mut first = vec![NONE; vertices];
    for (e, slot) in slots.iter().enumerate().filter(|(_, slot)| slot.origin != NONE) {
        first[slot.origin as usize] = e as u32;
    }
    first
}

/// The vertices of the hull, counter-clockwise; let each one's star start with the next.
fn walk_hull(slots: &[HalfEdge], start: u32, first: &mut [u32]) -> Vec<u32> {
    let mut hull = Vec::new();
    let mut e = start;
    while e != NONE {
        let vertex = slots[e as usize].origin;
        hull.push(vertex);
        first[vertex as usize] = e;
        e = slots[(e ^ 1) as usize].next();
        if e == start {
            break;
        }
    }
    hull
}

/// The stars of some successive vertices.
struct Part {
    degrees: Vec<u32>,
    neighbors: Vec<u32>,
}

impl Part {
    fn collect(slots: &[HalfEdge], first: &[u32]) -> Self {
        let mut degrees = Vec::with_capacity(first.len());
        let mut neighbors = Vec::with_capacity(SLOTS * first.len());
        for &start in first {
            let before = neighbors.len();
            let mut e = start;
            while e != NONE {
                neighbors.push(slots[(e ^ 1) as usize].origin);
                e = slots[e as usize].next();
                if e == start {
                    break;
                }
            }
            degrees.push((neighbors.len() - before) as u32);
        }
        Self { degrees, neighbors }
    }

    fn concatenate(parts: Vec<Self>, vertices: usize) -> (Vec<u32>, Vec<u32>) {
        let mut offsets = Vec::with_capacity(vertices + 1);
        let mut neighbors = Vec::with_capacity(parts.iter().map(|p| p.neighbors.len()).sum());
        let mut end = 0;
        offsets.push(end);
        for part in parts {
            for degree in part.degrees {
                end += degree;
                offsets.push(end);
            }
            neighbors.extend(part.neighbors);
        }
        (offsets, neighbors)
    }
}
