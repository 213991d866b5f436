//! The triangulation as stars: the neighbors of each vertex, counter-clockwise, one after another in memory.
//!
//! This is all that selection needs: a wedge, two successive neighbors of a vertex, is a triangle, and its
//! circumcenter a corner of the vertex's Voronoi cell.

use super::rings::{Rings, hull_edges};
use crate::error::Result;
use crate::parts::{each, short, split, try_each};
use crate::progress::{Progress, Stage};

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
    /// Collect the stars of a finished graph, and its hull.
    ///
    /// `first` holds a half-edge from each vertex, `offsets` a 0 and then the number of half-edges from each vertex. `hull` is a
    /// half-edge of the hull, the outside to its right, or `NONE` if there are no edges. `neighbors` is memory for all half-edges or more.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn collect<R: Rings<Index: Into<u32> + Sync> + Sync + ?Sized>(
        graph: &R,
        mut first: Vec<R::Index>,
        mut offsets: Vec<u32>,
        hull: R::Index,
        mut neighbors: Vec<u32>,
        progress: &Progress,
    ) -> Result<(Self, Vec<u32>)> {
        progress.enter(Stage::Stars, first.len())?;
        let mut end = 0;
        for offset in &mut offsets {
            end += *offset;
            *offset = end;
        }
        let hull = walk_hull(graph, hull, &mut first);
        let mut on_hull = vec![false; first.len()];
        for &vertex in &hull {
            on_hull[vertex as usize] = true;
        }
        neighbors.truncate(end as usize);
        neighbors.shrink_to_fit();
        if end > 0 {
            let parts = split(&mut neighbors, grains(&offsets));
            let parts = parts.into_iter().zip(first.chunks(GRAIN)).collect();
            try_each(parts, |k, (mut part, first)| {
                for (v, &e) in (k * GRAIN..).zip(first) {
                    let degree = (offsets[v + 1] - offsets[v]) as usize;
                    let (star, rest) = part.split_at_mut(degree);
                    graph.write_star(v, e, star);
                    part = rest;
                }
                progress.advance(first.len())
            })?;
        }
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

    /// The number of `q` in the star of `p`, if it is among the first of it.
    ///
    /// All of them are compared, so there is no branch on which it is.
    #[inline]
    #[must_use]
    pub fn place_among_first(&self, p: u32, q: u32) -> Option<usize> {
        /// Neighbors of most vertices at most.
        const FIRST: usize = 8;
        let (start, end) = (self.offset(p), self.offset(p + 1));
        let (run, _) = self.neighbors[start..].split_first_chunk::<FIRST>()?;
        let hits = (0..FIRST).fold(0, |hits, k| hits | u32::from(run[k] == q) << k);
        let place = hits.trailing_zeros() as usize;
        (place < FIRST.min(end - start)).then_some(place)
    }

    /// One value for each half-edge, those of one star after another: `write` gets a vertex and its part of them.
    ///
    /// Of no use, and not whole, if the call is cancelled.
    pub fn map<T: Copy + Send>(
        &self,
        empty: T,
        progress: &Progress,
        write: impl Fn(u32, &mut [T]) + Sync,
    ) -> Vec<T> {
        let mut values = vec![empty; self.half_edges()];
        let parts = split(&mut values, grains(&self.offsets));
        each(parts, |k, mut part| {
            let (first, end) = (k * GRAIN, ((k + 1) * GRAIN).min(self.on_hull.len()));
            for v in short(first..end, progress).flatten() {
                let (star, rest) = part.split_at_mut(self.star(v as u32).neighbors.len());
                write(v as u32, star);
                part = rest;
            }
        });
        values
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

/// The vertices of the hull, counter-clockwise; let each one's star start with the next.
fn walk_hull<R: Rings<Index: Into<u32>> + ?Sized>(
    graph: &R,
    start: R::Index,
    first: &mut [R::Index],
) -> Vec<u32> {
    let mut hull = Vec::new();
    for e in hull_edges(graph, start) {
        let vertex = graph.origin(e).into();
        hull.push(vertex);
        first[vertex as usize] = e;
    }
    hull
}

/// The lengths of the parts of all neighbors that belong to `GRAIN` successive vertices each.
fn grains(offsets: &[u32]) -> impl Iterator<Item = usize> {
    let last = offsets.len() - 1;
    let end = move |start: usize| offsets[(start + GRAIN).min(last)];
    (0..last).step_by(GRAIN).map(move |start| (end(start) - offsets[start]) as usize)
}
