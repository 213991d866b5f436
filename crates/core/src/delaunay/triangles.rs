//! The triangulation as a list of triangles, with twins, circumcenters and circumradii.

use super::Delaunay;
use crate::point::Point;
use crate::voronoi::circumcenter;
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
        let triangles = self.triangles();
        let mut at = vec![None; self.stars.half_edges()];
        for (e, (p, q)) in half_edges(&triangles).enumerate() {
            at[self.position(p, q)] = Some(e as u32);
        }
        half_edges(&triangles).map(|(p, q)| at[self.position(q, p)]).collect()
    }

    /// Where the half-edge p → q stands among all stars.
    fn position(&self, p: u32, q: u32) -> usize {
        let k = self.star(p).neighbors.iter().position(|&neighbor| neighbor == q);
        self.stars.offset(p) + k.expect("a side of a triangle is in the star of its corner")
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
            center[0].hypot(center[1]) / self.scale
        })
    }

    fn map_triangles<T: Send>(&self, map: impl Fn([Point; 3]) -> T + Sync) -> Vec<T> {
        let triangles = self.triangles();
        triangles.into_par_iter().map(|t| map(t.map(|vertex| self.point(vertex)))).collect()
    }
}

/// The half-edges of `triangles`, three each.
fn half_edges(triangles: &[[u32; 3]]) -> impl Iterator<Item = (u32, u32)> {
    triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
}
