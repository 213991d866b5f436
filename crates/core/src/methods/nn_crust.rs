//! The NN-crust.
//!
//! T. K. Dey and P. Kumar, "A Simple Provable Algorithm for Curve Reconstruction", Symposium on
//! Discrete Algorithms (1999).

use crate::cocircular::diagonals;
use crate::delaunay::Delaunay;
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::exact::sign::{self, Form, Number};
use crate::point::{Point, dot, sub};
use crate::progress::{Progress, Stage};
use rayon::prelude::*;
use std::cmp::Ordering::{self, Equal, Greater};

/// The edges from each point to its nearest, and the shortest at 90° or more to each of those.
///
/// The second are sought in the closed Delaunay graph; equally short ones are all in. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn nn_crust(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    /// Vertices that one task takes at a time.
    const GRAIN: usize = 1 << 12;
    let count = delaunay.points().len();
    progress.enter(Stage::Select, count)?;
    let neighborhood = Neighborhood::new(delaunay);
    let part = |start: usize| {
        let end = (start + GRAIN).min(count);
        let mut edges = Edges::new();
        for p in start as u32..end as u32 {
            edges.extend(neighborhood.chosen(p).map(|q| rows(delaunay, p, q)));
        }
        progress.advance(end - start)?;
        Ok(edges)
    };
    let starts: Vec<usize> = (0..count).step_by(GRAIN).collect();
    let parts = starts.into_par_iter().map(part).collect::<Result<Vec<Edges>>>()?;
    let mut edges = sort(&parts, delaunay.input_len());
    edges.dedup();
    Ok(edges)
}

/// The closed Delaunay graph, seen from its points.
struct Neighborhood<'a> {
    delaunay: &'a Delaunay,
    /// Ends of the diagonals between cocircular points, both ways, sorted.
    tied: Vec<(u32, u32)>,
}

impl<'a> Neighborhood<'a> {
    fn new(delaunay: &'a Delaunay) -> Self {
        let both = |edge: crate::delaunay::Edge| [(edge.p, edge.q), (edge.q, edge.p)];
        let mut tied: Vec<_> = diagonals(delaunay).into_iter().flat_map(both).collect();
        tied.par_sort_unstable();
        Self { delaunay, tied }
    }

    fn tied(&self, p: u32) -> impl Iterator<Item = u32> {
        let start = self.tied.partition_point(|&(from, _)| from < p);
        self.tied[start..].iter().take_while(move |&&(from, _)| from == p).map(|&(_, to)| to)
    }

    /// The ends of the edges that `p` asks for.
    fn chosen(&self, p: u32) -> impl Iterator<Item = u32> + use<> {
        let star = self.delaunay.star(p).neighbors;
        let nearest = self.nearest(p, star.iter().copied());
        let mut chosen = nearest.clone();
        for q in nearest {
            let behind = |&s: &u32| self.is_behind(p, q, s);
            let all = star.iter().copied().chain(self.tied(p));
            chosen.extend(self.nearest(p, all.filter(behind)));
        }
        chosen.into_iter()
    }

    /// All those at the least distance from `p`.
    fn nearest(&self, p: u32, among: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut nearest: Vec<u32> = Vec::new();
        for s in among {
            let order = nearest.first().map_or(Equal, |&best| self.compare(p, s, best));
            if order.is_lt() {
                nearest.clear();
            }
            if order.is_le() {
                nearest.push(s);
            }
        }
        nearest
    }

    fn compare(&self, p: u32, a: u32, b: u32) -> Ordering {
        let [p, a, b] = [p, a, b].map(|vertex| self.delaunay.point(vertex));
        compare_distances(p, a, b)
    }

    /// Is the angle q p s at least 90°?
    fn is_behind(&self, p: u32, q: u32, s: u32) -> bool {
        let [p, q, s] = [p, q, s].map(|vertex| self.delaunay.point(vertex));
        sign::sign(&sign::Dot, p, &[q, s]) != Greater
    }
}

/// The distance from `p` to `a`, compared with that to `b`.
fn compare_distances(p: Point, a: Point, b: Point) -> Ordering {
    let (u, v) = (sub(a, p), sub(b, p));
    let (u, v) = (dot(u, u), dot(v, v));
    if (u - v).abs() > 8.0 * f64::EPSILON * (u + v) + f64::MIN_POSITIVE {
        return u.total_cmp(&v);
    }
    sign::sign(&Nearer, p, &[a, b])
}

/// The difference of the squared distances from the origin: negative if the first is nearer.
struct Nearer;

impl Form<2> for Nearer {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 2
    }
    fn value<T: Number>(&self, [a, b]: &[[T; 2]; 2]) -> T {
        sign::dot(a, a).minus(&sign::dot(b, b))
    }
}
