//! The triangulation as a list of triangles, with twins, circumcenters and circumradii.

use super::Delaunay;
use super::rings::NONE;
use crate::exact::circumcenter::circumcenter;
use crate::point::Point;
use rayon::prelude::*;

impl Delaunay {
    /// The triangles as vertices, counter-clockwise, each from its smallest vertex; sorted by that, then around it.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let from = |p: u32| {
            let smallest = move |&(q, r): &(u32, u32)| p < q && p < r;
            self.star(p).wedges().filter(smallest).map(move |(q, r)| [p, q, r])
        };
        (0..self.points.len() as u32).into_par_iter().flat_map_iter(from).collect()
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
        let wedges = self.wedge_triangles();
        let twin = |p: u32, q: u32| {
            let star = self.star(q);
            let k = star.position(p);
            let t = wedges[self.stars.offset(q) + k];
            (t != NONE).then(|| 3 * t + star.left(k).map_or(0, |r| corner(q, p, r)))
        };
        let triangles = self.triangles();
        let twins = triangles.par_iter().map(|&[a, b, c]| [twin(a, b), twin(b, c), twin(c, a)]);
        twins.collect::<Vec<_>>().into_flattened()
    }

    /// For each half-edge, in the order of the stars: the triangle to its left; `NONE` on the outside of the hull.
    #[must_use]
    pub fn wedge_triangles(&self) -> Vec<u32> {
        let first = self.first_triangles();
        self.stars.map(NONE, |p, triangles| {
            let mut own = first[p as usize];
            let star = self.star(p);
            for (k, triangle) in triangles.iter_mut().enumerate() {
                let (q, Some(r)) = (star.neighbors[k], star.left(k)) else { continue };
                *triangle = match corner(p, q, r) {
                    0 => {
                        own += 1;
                        own - 1
                    }
                    1 => self.triangle_of(&first, r, p),
                    _ => self.triangle_of(&first, q, r),
                };
            }
        })
    }

    /// For each vertex the number of triangles whose smallest corner is smaller.
    fn first_triangles(&self) -> Vec<u32> {
        let count = |p: u32| {
            let wedges = self.star(p).wedges();
            wedges.filter(|&(q, r)| corner(p, q, r) == 0).count() as u32
        };
        let mut first: Vec<u32> =
            (0..self.points.len() as u32).into_par_iter().map(count).collect();
        let mut sum = 0;
        for first in &mut first {
            sum += std::mem::replace(first, sum);
        }
        first
    }

    /// The triangle whose smallest corner is p, to the left of p → q.
    fn triangle_of(&self, first: &[u32], p: u32, q: u32) -> u32 {
        let before = self.star(p).wedges().take_while(|&(a, _)| a != q);
        first[p as usize] + before.filter(|&(a, b)| corner(p, a, b) == 0).count() as u32
    }

    /// The circumcenters, in the scale of the input, in the order of [`triangles`](Self::triangles).
    ///
    /// Each is relative to its triangle's first corner before it is rounded to the coordinates.
    #[must_use]
    pub fn circumcenters(&self) -> Vec<Point> {
        self.map_triangles(|[a, b, c]| {
            let center = circumcenter([a, b, c]);
            [0, 1].map(|axis| (a[axis] + center[axis]) / self.scale)
        })
    }

    /// The circumradii, in the scale of the input, in the order of [`triangles`](Self::triangles).
    #[must_use]
    pub fn circumradii(&self) -> Vec<f64> {
        self.map_triangles(|[a, b, c]| {
            let center = circumcenter([a, b, c]);
            libm::hypot(center[0], center[1]) / self.scale
        })
    }

    fn map_triangles<T: Send>(&self, map: impl Fn([Point; 3]) -> T + Sync) -> Vec<T> {
        let triangles = self.triangles();
        triangles.into_par_iter().map(|t| map(t.map(|vertex| self.point(vertex)))).collect()
    }
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
