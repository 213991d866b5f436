//! The conservative crust.
//!
//! T. K. Dey, K. Mehlhorn and E. A. Ramos, "Curve Reconstruction: Connecting Dots with Good Reason",
//! Computational Geometry: Theory and Applications 15 (2000). What is not joined makes a medial axis,
//! and what is joined keeps its distance from it.

use crate::adjacency::Adjacency;
use crate::cocircular::is_tied;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, sort};
use crate::error::{Error, Result};
use crate::exact::circumcenter::HomogeneousCenter;
use crate::exact::constant::{Constant, fraction};
use crate::exact::sign::{self, Form, Number};
use crate::parts::{GRAIN, in_parts, map};
use crate::point::Point;
use crate::progress::{Progress, Stage};
use std::cmp::Ordering::{Greater, Less};

/// The largest set of Gabriel edges whose disks, `ratio` times the smallest that touches both ends,
/// meet no Voronoi vertex, and no Voronoi edge of two points that the set does not join.
///
/// There is one such set: an edge leaves it if its disk meets a Voronoi edge whose points are not
/// joined (any more), whatever the order. Touching keeps the edge. O(n log n) on samples of curves.
///
/// # Errors
/// A `ratio` that is not positive and finite, or a cancelled `progress`.
pub fn conservative_crust(delaunay: &Delaunay, ratio: f64, progress: &Progress) -> Result<Edges> {
    if !(ratio > 0.0 && ratio.is_finite()) {
        let message = format!("ratio must be a positive finite number, not {ratio}");
        return Err(Error::Argument { message });
    }
    progress.enter(Stage::Select, 2 * delaunay.points().len())?;
    let joined = candidates(delaunay, progress)?;
    let squares = fraction(ratio).map(|value| Constant::new(&(&value * &value)));
    let disks = Disks { delaunay, joined: &joined, squares };
    let own = joined.edges();
    let crossed = map(own.len(), None, progress, |k| disks.crossed(own[k][0], own[k][1]))?;
    let stays = largest(&crossed);
    progress.advance(0)?;
    let kept = joined.edges().iter().zip(stays).filter(|&(_, stays)| stays);
    let kept = kept.map(|(&[p, q], _)| rows(delaunay, p, q)).collect();
    progress.advance(0)?;
    Ok(sort(&[kept], delaunay.input_len()))
}

/// The Gabriel edges that are in every Delaunay triangulation.
fn candidates(delaunay: &Delaunay, progress: &Progress) -> Result<Adjacency> {
    let count = delaunay.points().len();
    let parts = in_parts(count, GRAIN, progress, |vertices| {
        let edges = vertices.flat_map(|p| delaunay.edges_from(p as u32));
        let candidates = edges.filter(|&edge| is_candidate(delaunay, edge));
        candidates.map(|edge| [edge.p, edge.q]).collect()
    })?;
    Ok(Adjacency::of_vertices(&parts, count))
}

/// Is `edge` in every Delaunay triangulation, with no point inside the smallest disk?
fn is_candidate(delaunay: &Delaunay, edge: Edge) -> bool {
    let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
    let is_outside = |apex| sign::sign(&sign::Dot, delaunay.point(apex), &[p, q]) != Less;
    [edge.left, edge.right].into_iter().flatten().all(is_outside) && !is_tied(delaunay, edge)
}

/// Which stay, if each that is `None` goes, and each goes when one that it crosses does.
fn largest(crossed: &[Option<Vec<u32>>]) -> Vec<bool> {
    let mut crossing: Vec<Vec<u32>> = vec![Vec::new(); crossed.len()];
    let mut stays = vec![true; crossed.len()];
    let mut gone = Vec::new();
    for (edge, crossed) in crossed.iter().enumerate() {
        match crossed {
            Some(crossed) => crossed.iter().for_each(|&k| crossing[k as usize].push(edge as u32)),
            None => gone.push(edge as u32),
        }
    }
    while let Some(edge) = gone.pop() {
        if std::mem::take(&mut stays[edge as usize]) {
            gone.append(&mut crossing[edge as usize]);
        }
    }
    stays
}

/// The disks about the middles of edges.
struct Disks<'a> {
    delaunay: &'a Delaunay,
    joined: &'a Adjacency,
    /// The squares of the numerator and the denominator of the ratio.
    squares: [Constant; 2],
}

impl Disks<'_> {
    /// The edges whose dual Voronoi edges the disk of p q meets; `None` if it meets what it must not.
    ///
    /// Visits the cells that meet the disk, starting from those of p and q. Where no Voronoi vertex is
    /// inside, the disk leads from cell to cell only through the insides of Voronoi edges.
    fn crossed(&self, p: u32, q: u32) -> Option<Vec<u32>> {
        // That with fewer neighbors first: most edges end at a center of their own triangles, which both cells have.
        let mut cells = vec![p, q];
        cells.sort_by_key(|&end| self.delaunay.star(end).neighbors.len());
        let (mut crossed, mut next) = (Vec::new(), 0);
        while let Some(&cell) = cells.get(next) {
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::CELL);
            let star = self.delaunay.star(cell);
            if star.wedges().any(|(a, b)| self.holds(p, q, [cell, a, b])) {
                return None;
            }
            for (k, &neighbor) in star.neighbors.iter().enumerate() {
                let edge = Edge { p: cell, q: neighbor, left: star.left(k), right: star.right(k) };
                let is_own = [p, q].contains(&cell) && [p, q].contains(&neighbor);
                if !is_own && !is_tied(self.delaunay, edge) && self.meets(p, q, edge) {
                    crossed.push(self.joined.edge(cell, neighbor)?);
                    if !cells.contains(&neighbor) {
                        cells.push(neighbor);
                    }
                }
            }
            next += 1;
        }
        Some(crossed)
    }

    /// Is the center of `triangle` strictly inside the disk of p q?
    fn holds(&self, p: u32, q: u32, triangle: [u32; 3]) -> bool {
        let [a, b, c] = triangle.map(|vertex| self.delaunay.point(vertex));
        let at = [self.delaunay.point(q), a, b, c];
        sign::sign(&Power { squares: &self.squares }, self.delaunay.point(p), &at) == Less
    }

    /// Does the dual of `edge`, whose ends are outside, meet the inside of the disk of p q?
    fn meets(&self, p: u32, q: u32, edge: Edge) -> bool {
        let at = |vertex| self.delaunay.point(vertex);
        let (origin, q, [a, b]) = (at(p), at(q), [edge.p, edge.q].map(at));
        let is_ahead = |[a, b]: [Point; 2], apex: Option<u32>| {
            apex.is_none_or(|apex| sign::sign(&Ahead, origin, &[q, a, b, at(apex)]) == Greater)
        };
        sign::sign(&Near { squares: &self.squares }, origin, &[q, a, b]) == Less
            && is_ahead([a, b], edge.left)
            && is_ahead([b, a], edge.right)
    }
}

/// Twice the vector from the middle of the origin and `q` to the center of a triangle, times the returned w.
fn from_middle<T: Number>(q: &[T; 2], [a, b, c]: [&[T; 2]; 3]) -> ([T; 2], T) {
    let center = HomogeneousCenter::new(a, b, c);
    let twice = |axis: usize| center.at[axis].plus(&center.at[axis]);
    ([0, 1].map(|axis| twice(axis).minus(&center.w.times(&q[axis]))), center.w)
}

/// Negative if the center of a counter-clockwise triangle is inside the disk.
struct Power<'a> {
    squares: &'a [Constant; 2],
}

impl Form<4> for Power<'_> {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 16 + self.squares.iter().map(Constant::bits).max().unwrap_or(0)
    }
    fn value<T: Number>(&self, [q, a, b, c]: &[[T; 2]; 4]) -> T {
        let (from, w) = from_middle(q, [a, b, c]);
        let [above, below] = self.squares.each_ref().map(Constant::number::<T>);
        let radius = above.times(&w.times(&w)).times(&sign::dot(q, q));
        below.times(&sign::dot(&from, &from)).minus(&radius)
    }
}

/// Negative if the bisector of two points passes through the inside of the disk.
struct Near<'a> {
    squares: &'a [Constant; 2],
}

impl Form<3> for Near<'_> {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 10 + self.squares.iter().map(Constant::bits).max().unwrap_or(0)
    }
    fn value<T: Number>(&self, [q, a, b]: &[[T; 2]; 3]) -> T {
        let across = sign::difference(b, a);
        let from = sign::difference(&sign::difference(q, a), b);
        let distance = sign::dot(&from, &across);
        let [above, below] = self.squares.each_ref().map(Constant::number::<T>);
        let radius = above.times(&sign::dot(q, q)).times(&sign::dot(&across, &across));
        below.times(&distance.times(&distance)).minus(&radius)
    }
}

/// Positive if the center of the triangle a, b, apex lies beyond the foot of the middle on the bisector of
/// a and b, as seen to the left of a → b.
struct Ahead;

impl Form<4> for Ahead {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 10
    }
    fn value<T: Number>(&self, [q, a, b, apex]: &[[T; 2]; 4]) -> T {
        let (from, _) = from_middle(q, [a, b, apex]);
        sign::cross(&sign::difference(b, a), &from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::sign::tests::assert_bounded;

    #[test]
    fn values_are_within_their_bounds() {
        for ratio in [0.5, 1.0, 1.3] {
            let squares = &fraction(ratio).map(|value| Constant::new(&(&value * &value)));
            assert_bounded(&Power { squares });
            assert_bounded(&Near { squares });
        }
        assert_bounded(&Ahead);
    }
}
