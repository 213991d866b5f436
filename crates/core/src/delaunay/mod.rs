//! The Delaunay triangulation of distinct points, exact and the same on any number of threads.

mod divide;
mod hull;
mod leaf;
mod rings;
mod sanity;
mod settled;
mod slots;
mod stars;
mod triangles;
mod zip;

use crate::error::{Error, Result};
use crate::exact::predicates::is_left;
use crate::memory;
use crate::parts::copies;
use crate::point::Point;
use crate::progress::{Progress, Stage};
use crate::space::order::{Grid, Order, order};
use divide::{Vertices, triangulate};
use leaf::Leaf;
pub use rings::NONE;
use slots::{Memory, SLOTS, Slots};
pub use stars::{Star, Stars};
use std::ops::Range;
pub use triangles::{triangle_parts, vertices_of_part};

/// The most points that one triangulation can hold: half-edges are numbered in 32 bits.
pub const MOST_POINTS: usize = (u32::MAX as usize - 1) / SLOTS;

/// Neighbors up to which a star is searched faster in a row.
const SHORT: usize = 32;

/// Memory for each point at the peak, about.
const BYTES: usize = 128;

/// A Delaunay triangulation.
///
/// Its vertices are the distinct points, numbered along a space-filling curve; [`rows`](Self::rows) leads back to the
/// input. Where four or more points lie on an empty circle, which of its diagonals are in depends on the
/// coordinates alone, never on the order of the rows or the number of threads.
#[derive(Debug, Clone, Default)]
pub struct Delaunay {
    points: Vec<Point>,
    rows: Vec<u32>,
    duplicates: Vec<[u32; 2]>,
    scale: f64,
    input: usize,
    hull: Vec<u32>,
    stars: Stars,
}

/// An edge p → q of the triangulation, p < q, and the apexes of its triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// The vertex of smaller number.
    pub p: u32,
    /// The vertex of larger number.
    pub q: u32,
    /// The third corner of the triangle to the left of p → q, if there is one.
    pub left: Option<u32>,
    /// The third corner of the triangle to the right of p → q, if there is one.
    pub right: Option<u32>,
}

/// An [`Edge`] in 16 bytes, for loops that move many: p, q, and the apexes to the left and to the right, or [`NONE`].
#[derive(Debug, Clone, Copy, Default)]
pub struct Packed([u32; 4]);

impl From<Packed> for Edge {
    #[inline]
    fn from(Packed([p, q, left, right]): Packed) -> Self {
        let [left, right] = [left, right].map(|apex| (apex != NONE).then_some(apex));
        Self { p, q, left, right }
    }
}

impl Delaunay {
    /// Triangulate `points`, which must be finite.
    ///
    /// O(n log n), on the threads of the current rayon pool.
    ///
    /// # Errors
    /// More than `MOST_POINTS` points, coordinates too far apart in size, or a cancelled `progress`.
    pub fn new(points: &[Point], progress: &Progress) -> Result<Self> {
        debug_assert!(points.iter().flatten().all(|x| x.is_finite()));
        if points.len() > MOST_POINTS {
            return Err(Error::TooManyPoints { count: points.len(), limit: MOST_POINTS });
        }
        memory::check(points.len(), BYTES)?;
        let Order { points: vertices, rows, grid, duplicates, scale, memory } =
            order(points, progress)?;
        let neighbors = memory.into_flattened();
        let (stars, hull) = stars(&vertices, &grid, leaf::MOST, neighbors, progress)?;
        Ok(Self { points: vertices, rows, duplicates, scale, input: points.len(), hull, stars })
    }

    /// The distinct points, scaled by [`scale`](Self::scale).
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The point of `vertex`.
    #[inline]
    #[must_use]
    pub fn point(&self, vertex: u32) -> Point {
        self.points[vertex as usize]
    }

    /// The input row of each vertex: the first with its coordinates.
    #[must_use]
    pub fn rows(&self) -> &[u32] {
        &self.rows
    }

    /// Row, and the first row with the same coordinates; sorted.
    #[must_use]
    pub fn duplicates(&self) -> &[[u32; 2]] {
        &self.duplicates
    }

    /// The power of two that the input was multiplied by to give the vertices.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The number of input rows.
    #[must_use]
    pub fn input_len(&self) -> usize {
        self.input
    }

    /// The vertices of the hull, counter-clockwise from the leftmost; points in line are all listed, on both ways.
    #[must_use]
    pub fn hull(&self) -> &[u32] {
        &self.hull
    }

    /// The neighbors of each vertex.
    #[must_use]
    pub fn stars(&self) -> &Stars {
        &self.stars
    }

    /// The neighbors of `vertex`.
    #[inline]
    #[must_use]
    pub fn star(&self, vertex: u32) -> Star<'_> {
        self.stars.star(vertex)
    }

    /// The number of `q` in the star of `p`, if there is an edge between them: O(log) of the neighbors, which are sorted by direction.
    #[inline]
    #[must_use]
    pub fn position(&self, p: u32, q: u32) -> Option<usize> {
        let neighbors = self.star(p).neighbors;
        let place = self.stars.place_among_first(p, q);
        if place.is_some() {
            return place;
        }
        if neighbors.len() <= SHORT {
            return neighbors.iter().position(|&neighbor| neighbor == q);
        }
        let k = self.turned_before(p, neighbors, q);
        (neighbors.get(k) == Some(&q)).then_some(k)
    }

    /// How many of the `neighbors` of `p` come before the direction of `q`, counter-clockwise from the first.
    #[cold]
    fn turned_before(&self, p: u32, neighbors: &[u32], q: u32) -> usize {
        let at = |vertex| self.point(vertex);
        let (from, to, first) = (at(p), at(q), neighbors[0]);
        let is_beyond_half = |s: u32| s != first && !is_left(from, at(first), at(s));
        let is_far = is_beyond_half(q);
        neighbors.partition_point(|&s| {
            let is_same_half = is_beyond_half(s) == is_far;
            if is_same_half { is_left(from, at(s), to) } else { is_far }
        })
    }

    /// All edges, sorted by p.
    pub fn edges(&self) -> impl Iterator<Item = Edge> {
        (0..self.points.len() as u32).flat_map(|p| self.edges_from(p))
    }

    /// The edges from `p` to vertices of larger number.
    pub fn edges_from(&self, p: u32) -> impl Iterator<Item = Edge> {
        let star = self.star(p);
        let later = move |&k: &usize| star.neighbors[k] > p;
        (0..star.neighbors.len()).filter(later).map(move |k| Edge {
            p,
            q: star.neighbors[k],
            left: star.left(k),
            right: star.right(k),
        })
    }

    /// Write the edges from each of `vertices` to those of larger number to the front of `edges`; return how many these are.
    ///
    /// Without a branch on which way an edge leads, which no processor foresees.
    pub fn write_edges_from(&self, vertices: Range<usize>, edges: &mut Vec<Packed>) -> usize {
        let [start, end] = [vertices.start, vertices.end].map(|v| self.stars.offset(v as u32));
        if edges.len() < end - start {
            edges.resize(end - start, Packed::default());
        }
        let edges = edges.as_mut_slice();
        let mut count = 0;
        // Of all vertices in one line none is an apex.
        let flat = if self.stars.is_flat() { NONE } else { 0 };
        for p in vertices.start as u32..vertices.end as u32 {
            let Star { neighbors, on_hull, .. } = self.star(p);
            let (Some(&first), Some(&last)) = (neighbors.first(), neighbors.last()) else {
                continue;
            };
            let mut put = |q, left, right| {
                edges[count] = Packed([p, q, left | flat, right | flat]);
                count += usize::from(q > p);
            };
            let [mut right, after] = if on_hull { [NONE; 2] } else { [last, first] };
            for pair in neighbors.windows(2) {
                put(pair[0], pair[1], right);
                right = pair[0];
            }
            put(last, after, right);
        }
        count
    }
}

/// Triangulate the vertices `points`, sorted by their codes on `grid`; return their stars and the hull.
///
/// `neighbors` is memory for as many half-edges as there can be, with anything in it.
fn stars(
    points: &[Point],
    grid: &Grid,
    leaf: usize,
    neighbors: Vec<u32>,
    progress: &Progress,
) -> Result<(Stars, Vec<u32>)> {
    let count = points.len();
    progress.enter(Stage::Triangulate, count)?;
    if (1..=leaf).contains(&count) {
        return Leaf::with(points, grid, |leaf, extremes| {
            progress.advance(count)?;
            let (first, degrees) = leaf.origins(count);
            Stars::collect(leaf, first, degrees, extremes.left.edge, neighbors, progress)
        });
    }
    let mut memory = Memory::new(count);
    let mut first = copies(0, count);
    let mut offsets = copies(0, count + 1);
    let mut hull = NONE;
    if count > 0 {
        let mut graph = Slots::on(points, &mut memory, [&mut first, &mut offsets[1..]]);
        let vertices = Vertices { points, grid, leaf };
        hull = triangulate(vertices, &mut graph, progress)?.left.edge;
    }
    let made = Stars::collect(&memory, first, offsets, hull, neighbors, progress);
    memory.give_back();
    made
}

#[cfg(test)]
mod tests;
