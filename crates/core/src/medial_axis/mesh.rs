//! The triangulation with curves in it: what is known of each half-edge, by stars.

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::exact::predicates::in_circle;
use crate::progress::Progress;
use std::ops::Range;

/// The triangulation as stars, with curves in it.
pub struct Mesh<'a> {
    pub delaunay: &'a Delaunay,
    /// The triangle to the left of each half-edge from its smallest corner.
    own: Vec<u32>,
    /// What is known of each half-edge.
    marks: Vec<Mark>,
}

/// A half-edge among those from its vertex.
#[derive(Debug, Clone, Copy, Default)]
pub struct Mark {
    /// Is it an edge of the curves?
    pub is_chosen: bool,
    /// Do an odd number of those before it, or it itself, separate inside and outside?
    pub is_odd: bool,
}

impl<'a> Mesh<'a> {
    /// Of the triangulation with `first` as the first triangles of its vertices; `flips` tells which edges of the curves separate
    /// inside and outside. Of no use if the call is cancelled.
    pub fn new(
        delaunay: &'a Delaunay,
        curve: &Adjacency,
        first: &[u32],
        flips: &[bool],
        progress: &Progress,
    ) -> Self {
        let marks = delaunay.stars().map(Mark::default(), progress, |p, marks| {
            let mut is_odd = false;
            for (mark, &q) in marks.iter_mut().zip(delaunay.star(p).neighbors) {
                let number = curve.edge(p, q);
                is_odd ^= number.is_some_and(|number| flips[number as usize]);
                *mark = Mark { is_chosen: number.is_some(), is_odd };
            }
        });
        Self { delaunay, own: delaunay.own_triangles(first, progress), marks }
    }

    /// The half-edges from `p`.
    pub fn marks_at(&self, p: u32) -> &[Mark] {
        &self.marks[self.half_edges(p)]
    }

    /// The triangles to the left of the half-edges from `p`, where that is their smallest corner.
    pub fn triangles_from(&self, p: u32) -> &[u32] {
        &self.own[self.half_edges(p)]
    }

    fn half_edges(&self, p: u32) -> Range<usize> {
        let start = self.delaunay.stars().offset(p);
        start..start + self.delaunay.star(p).neighbors.len()
    }

    /// The triangle to the left of the half-edge from `p` to `q`, where `p` is its smallest corner.
    pub fn triangle(&self, p: u32, q: u32) -> u32 {
        let k = self.delaunay.position(p, q).expect("stars are symmetric");
        self.own[self.delaunay.stars().offset(p) + k]
    }

    /// The triangle at the edge of the hull that starts at `p`.
    pub fn triangle_at_hull(&self, p: u32) -> u32 {
        let neighbors = self.delaunay.star(p).neighbors;
        let (q, r) = (neighbors[0], neighbors[1]);
        let (smallest, next) = [(p, q), (q, r), (r, p)].into_iter().min().expect("three");
        self.triangle(smallest, next)
    }

    /// Are the triangles to the left and to the right of p → q on one circle?
    pub fn is_tie(&self, [p, q]: [u32; 2], [left, right]: [u32; 2]) -> bool {
        let [p, q, left, right] = [p, q, left, right].map(|v| self.delaunay.point(v));
        // The far apex is never inside; with the orientation turned around, this says that it is not outside.
        !in_circle(q, p, left, right)
    }
}
