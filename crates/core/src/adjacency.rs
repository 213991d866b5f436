//! Edges seen from their ends: the neighbors of each along the curve.

use crate::delaunay::Delaunay;
use crate::edges::{Edges, sort};
use crate::error::Result;
use crate::memory;
use crate::parts::GRAIN;
use rayon::prelude::*;

/// Memory for each edge, and for each point, while the neighbors along the edges are collected and sorted.
const OF_EDGE: usize = 64;
const OF_POINT: usize = 16;

/// Parts that edges are sorted from.
const PARTS: usize = 8;

/// The edges at each of some numbers, which stand for rows or for vertices.
#[derive(Debug, Clone, Default)]
pub struct Incidence {
    /// `ends[offsets[v]..offsets[v + 1]]` are the neighbors of v.
    offsets: Vec<u32>,
    /// Neighbor, and the number of the edge to it.
    ends: Vec<(u32, u32)>,
}

impl Incidence {
    /// Of `edges` between numbers below `count`. Linear time.
    #[must_use]
    pub fn new(edges: &[[u32; 2]], count: usize) -> Self {
        let mut offsets = vec![0u32; count + 2];
        for &v in edges.as_flattened() {
            offsets[v as usize + 2] += 1;
        }
        for v in 1..=count {
            offsets[v + 1] += offsets[v];
        }
        let mut ends = vec![(0, 0); 2 * edges.len()];
        for (number, &[p, q]) in edges.iter().enumerate() {
            for (from, to) in [(p, q), (q, p)] {
                let slot = &mut offsets[from as usize + 1];
                ends[*slot as usize] = (to, number as u32);
                *slot += 1;
            }
        }
        Self { offsets, ends }
    }

    /// The number of edges.
    #[must_use]
    pub fn edges(&self) -> usize {
        self.ends.len() / 2
    }

    /// The neighbors of `v`, each with the number of the edge to it.
    #[inline]
    #[must_use]
    pub fn of(&self, v: u32) -> &[(u32, u32)] {
        let v = v as usize;
        &self.ends[self.offsets[v] as usize..self.offsets[v + 1] as usize]
    }
}

/// The neighbors of every vertex of a triangulation along some edges.
#[derive(Debug, Clone, Default)]
pub struct Adjacency {
    /// The edges as vertices: p < q in each, sorted, unique.
    edges: Edges,
    incidence: Incidence,
}

impl Adjacency {
    /// The neighbors along `edges`, canonical ones between input rows. A repeated row stands for the first of its kind.
    ///
    /// # Errors
    /// Too little memory.
    pub fn new(delaunay: &Delaunay, edges: &Edges) -> Result<Self> {
        memory::check(OF_EDGE * edges.len() + OF_POINT * delaunay.input_len(), 1)?;
        let vertex = vertices_of_rows(delaunay);
        let of_rows = |edges: &[[u32; 2]]| {
            let mut mapped = Vec::with_capacity(edges.len());
            let ends = edges.iter().map(|edge| edge.map(|row| vertex[row as usize]));
            mapped.extend(ends.filter(|[p, q]| p != q).map(|[p, q]| [p.min(q), p.max(q)]));
            mapped
        };
        let length = edges.len().div_ceil(PARTS).max(GRAIN);
        let mapped: Vec<Edges> = edges.par_chunks(length).map(of_rows).collect();
        Ok(Self::of_vertices(&mapped, delaunay.points().len()))
    }

    /// The neighbors along edges p < q between `count` vertices, in any order.
    #[must_use]
    pub fn of_vertices(parts: &[Edges], count: usize) -> Self {
        let mut edges = sort(parts, count);
        edges.dedup();
        let incidence = Incidence::new(&edges, count);
        Self { edges, incidence }
    }

    /// The edges as vertices: p < q in each, sorted, unique.
    #[must_use]
    pub fn edges(&self) -> &Edges {
        &self.edges
    }

    /// The number of vertices.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.incidence.offsets.len().saturating_sub(2)
    }

    /// The neighbors of `vertex`, each with the number of the edge to it.
    #[inline]
    #[must_use]
    pub fn of(&self, vertex: u32) -> &[(u32, u32)] {
        self.incidence.of(vertex)
    }

    /// The number of the edge between `p` and `q`, if there is one.
    #[inline]
    #[must_use]
    pub fn edge(&self, p: u32, q: u32) -> Option<u32> {
        match *self.of(p) {
            // Without a branch on which way a search goes.
            [(a, of_a), (b, of_b)] => {
                if q == a {
                    Some(of_a)
                } else {
                    (q == b).then_some(of_b)
                }
            }
            // Edges are sorted, so at each vertex their other ends ascend.
            ref ends => ends.binary_search_by_key(&q, |&(end, _)| end).ok().map(|k| ends[k].1),
        }
    }
}

/// The vertex of each input row.
#[must_use]
pub fn vertices_of_rows(delaunay: &Delaunay) -> Vec<u32> {
    let mut vertex = vec![0; delaunay.input_len()];
    for (v, &row) in delaunay.rows().iter().enumerate() {
        vertex[row as usize] = v as u32;
    }
    for &[row, first] in delaunay.duplicates() {
        vertex[row as usize] = vertex[first as usize];
    }
    vertex
}
