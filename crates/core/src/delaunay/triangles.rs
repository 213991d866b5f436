//! The triangulation as a list of triangles, with twins, circumcenters and circumradii.

use super::Delaunay;
use super::rings::NONE;
use crate::exact::circumcenter::circumcenter;
use crate::parts::{GRAIN, each, split};
use crate::point::Point;
use crate::progress::Progress;
use rayon::prelude::*;
use std::ops::Range;

impl Delaunay {
    /// The triangles as vertices, counter-clockwise, each from its smallest vertex; sorted by that, then around it.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        self.map_triangles([0; 3], |triangle| triangle)
    }

    /// The triangles whose smallest corner is `p`.
    pub fn triangles_from(&self, p: u32) -> impl Iterator<Item = [u32; 3]> {
        let smallest = move |&(q, r): &(u32, u32)| p < q.min(r);
        self.star(p).wedges().filter(smallest).map(move |(q, r)| [p, q, r])
    }

    /// The triangles as input rows, in the order of [`triangles`](Self::triangles).
    #[must_use]
    pub fn row_triangles(&self) -> Vec<[u32; 3]> {
        let triangles = self.triangles();
        triangles.into_par_iter().map(|t| t.map(|vertex| self.rows[vertex as usize])).collect()
    }

    /// The twin of each half-edge: half-edge 3t + k runs from corner k of triangle t to the next. `None` on the hull.
    #[must_use]
    pub fn twins(&self) -> Vec<Option<u32>> {
        let wedges = self.wedge_triangles(&self.first_triangles(), &Progress::default());
        let twin = |p: u32, q: u32| {
            let k = self.place(q, p);
            let t = wedges[self.stars.offset(q) + k];
            (t != NONE).then(|| 3 * t + self.star(q).left(k).map_or(0, |r| corner(q, p, r)))
        };
        let triangles = self.triangles();
        let twins = triangles.par_iter().map(|&[a, b, c]| [twin(a, b), twin(b, c), twin(c, a)]);
        twins.collect::<Vec<_>>().into_flattened()
    }

    /// For each half-edge, in the order of the stars: the triangle to its left; `NONE` on the outside of the hull.
    ///
    /// `first` are the first triangles of vertices. Of no use if the call is cancelled.
    #[must_use]
    pub fn wedge_triangles(&self, first: &[u32], progress: &Progress) -> Vec<u32> {
        let own = self.own_triangles(first, progress);
        let of = |p: u32, q: u32| own[self.stars.offset(p) + self.place(p, q)];
        self.stars.map(NONE, progress, |p, triangles| {
            let star = self.star(p);
            for (k, triangle) in triangles.iter_mut().enumerate() {
                let (q, Some(r)) = (star.neighbors[k], star.left(k)) else { continue };
                *triangle = match corner(p, q, r) {
                    0 => own[self.stars.offset(p) + k],
                    1 => of(r, p),
                    _ => of(q, r),
                };
            }
        })
    }

    /// The same, but only where the half-edge is from the smallest corner of its triangle.
    #[must_use]
    pub fn own_triangles(&self, first: &[u32], progress: &Progress) -> Vec<u32> {
        self.stars.map(NONE, progress, |p, triangles| {
            let (star, mut next) = (self.star(p), first[p as usize]);
            for (k, triangle) in triangles.iter_mut().enumerate() {
                if star.left(k).is_some_and(|r| p < r.min(star.neighbors[k])) {
                    *triangle = next;
                    next += 1;
                }
            }
        })
    }

    /// The number of `q` in the star of `p`, which are joined.
    fn place(&self, p: u32, q: u32) -> usize {
        self.position(p, q).expect("stars are symmetric")
    }

    /// For each vertex the number of triangles whose smallest corner is smaller, and last the number of all.
    #[must_use]
    pub fn first_triangles(&self) -> Vec<u32> {
        let count = |p: u32| {
            let star = self.star(p);
            let Some(last) = star.neighbors.len().checked_sub(1) else { return 0 };
            let own = |q: u32, r: u32| u32::from(p < q.min(r));
            let between: u32 = star.neighbors.windows(2).map(|pair| own(pair[0], pair[1])).sum();
            between + star.left(last).map_or(0, |first| own(star.neighbors[last], first))
        };
        let vertices = (0..self.points.len() as u32).into_par_iter();
        let mut first: Vec<u32> = vertices.with_min_len(GRAIN).map(count).collect();
        let mut sum = 0;
        for first in &mut first {
            sum += std::mem::replace(first, sum);
        }
        first.push(sum);
        first
    }

    /// The circumcenters, in the scale of the input, in the order of [`triangles`](Self::triangles).
    ///
    /// Each is relative to its triangle's first corner before it is rounded to the coordinates.
    #[must_use]
    pub fn circumcenters(&self) -> Vec<Point> {
        self.map_triangles([0.0; 2], |triangle| {
            let corners = triangle.map(|vertex| self.point(vertex));
            let center = circumcenter(corners);
            [0, 1].map(|axis| (corners[0][axis] + center[axis]) / self.scale)
        })
    }

    /// The circumradii, in the scale of the input, in the order of [`triangles`](Self::triangles).
    #[must_use]
    pub fn circumradii(&self) -> Vec<f64> {
        self.map_triangles(0.0, |triangle| {
            let center = circumcenter(triangle.map(|vertex| self.point(vertex)));
            libm::hypot(center[0], center[1]) / self.scale
        })
    }

    /// The `value` of each triangle; until it is known there is `empty` in its place.
    fn map_triangles<T: Clone + Send>(
        &self,
        empty: T,
        value: impl Fn([u32; 3]) -> T + Sync + Send,
    ) -> Vec<T> {
        let first = self.first_triangles();
        let mut values = vec![empty; first.last().map_or(0, |&count| count as usize)];
        each(split(&mut values, triangle_parts(&first)), |k, part| {
            let triangles = vertices_of_part(&first, k).flat_map(|p| self.triangles_from(p));
            triangles.zip(part).for_each(|(triangle, slot)| *slot = value(triangle));
        });
        values
    }
}

/// How many triangles successive parts of the vertices have; `first` are the first triangles of vertices.
pub fn triangle_parts(first: &[u32]) -> impl Iterator<Item = usize> {
    let last = first.len() - 1;
    let parts = (0..last).step_by(GRAIN);
    parts.map(move |v| (first[(v + GRAIN).min(last)] - first[v]) as usize)
}

/// The vertices of part number `k`.
pub fn vertices_of_part(first: &[u32], k: usize) -> Range<u32> {
    (GRAIN * k) as u32..(GRAIN * (k + 1)).min(first.len() - 1) as u32
}

/// Which corner of its triangle `p` is, as the triangle starts from the smallest of `p`, `q`, `r`, counter-clockwise.
fn corner(p: u32, q: u32, r: u32) -> u32 {
    if p < q && p < r {
        0
    } else if r < q {
        1
    } else {
        2
    }
}
