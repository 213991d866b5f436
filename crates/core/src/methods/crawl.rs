//! Crawling through neighbors.
//!
//! A. D. Parakkat and R. Muthuganapathy, "Crawl through Neighbors: A Simple Curve Reconstruction
//! Algorithm", Computer Graphics Forum 35 (2016).

use super::length::Ranked;
use super::neighborhood::Neighborhood;
use crate::delaunay::{Delaunay, NONE};
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::parts::{GRAIN, in_parts, sort_by};
use crate::progress::{Progress, Stage};

/// The curves that grow from short edges at both ends, to the nearest neighbor each time.
///
/// A curve starts as the shortest edge between two free points one of which is nearest to the other.
/// An end grows to its nearest neighbor in the closed Delaunay graph but the two points that it came
/// from, and stops if that one has two edges already; the end with the shorter step goes first. Of
/// equally long edges that with the lexicographically smaller end comes first, then that with the
/// smaller other end. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn crawl(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let count = delaunay.points().len();
    progress.enter(Stage::Select, 2 * count)?;
    let neighborhood = Neighborhood::new(delaunay, progress)?;
    let seeds = seeds(&neighborhood, progress)?;
    let mut curves = Curves { neighborhood, joined: vec![[NONE; 2]; count] };
    for seed in seeds {
        if [seed.p, seed.q].into_iter().all(|end| curves.degree(end) == 0) {
            curves.grow(seed, progress)?;
        }
    }
    Ok(sort(&[curves.edges()], delaunay.input_len()))
}

/// The edges from points to their nearest, the shortest first.
fn seeds(neighborhood: &Neighborhood, progress: &Progress) -> Result<Vec<Ranked>> {
    let delaunay = neighborhood.delaunay;
    let from = |p: u32| {
        let nearest = neighborhood.nearest(p, neighborhood.of(p));
        nearest.into_iter().map(move |q| Ranked::new(delaunay, p, q))
    };
    let parts = in_parts(delaunay.points().len(), GRAIN, progress, |vertices| {
        vertices.flat_map(|p| from(p as u32)).collect::<Vec<_>>()
    })?;
    let mut seeds = parts.concat();
    sort_by(&mut seeds, progress, |a, b| a.compare(b, delaunay))?;
    Ok(seeds)
}

/// Curves that grow.
struct Curves<'a> {
    neighborhood: Neighborhood<'a>,
    /// The up to two points that each is joined to.
    joined: Vec<[u32; 2]>,
}

impl Curves<'_> {
    fn degree(&self, vertex: u32) -> usize {
        self.joined[vertex as usize].iter().filter(|&&end| end != NONE).count()
    }

    fn join(&mut self, p: u32, q: u32) {
        for (from, to) in [(p, q), (q, p)] {
            let free = self.degree(from);
            self.joined[from as usize][free] = to;
        }
    }

    /// Grow a curve from `seed` until both ends stop.
    ///
    /// # Errors
    /// A cancelled `progress`.
    fn grow(&mut self, seed: Ranked, progress: &Progress) -> Result<()> {
        self.join(seed.p, seed.q);
        let mut ends = [seed.p, seed.q].map(|end| (end, self.step(end))).to_vec();
        loop {
            let steps = ends.iter().filter_map(|&(end, step)| Some((step?, end)));
            let open = steps.filter(|&(step, from)| self.degree(across(step, from)) < 2);
            let shorter = |(a, _): &(Ranked, u32), (b, _): &(Ranked, u32)| {
                a.compare(b, self.neighborhood.delaunay)
            };
            let Some((step, from)) = open.min_by(shorter) else { return Ok(()) };
            let to = across(step, from);
            let was_free = self.degree(to) == 0;
            self.join(from, to);
            // A ring is closed, or another curve, which has stopped, is reached: nothing grows here.
            ends.retain(|&(end, _)| end != from && end != to);
            // What is behind the other end of a seed has changed; any other end waits as it is.
            for (end, step) in ends.iter_mut().filter(|(end, _)| self.behind(*end) == from) {
                *step = self.step(*end);
            }
            if was_free {
                ends.push((to, self.step(to)));
            }
            progress.advance(1)?;
        }
    }

    /// The point that an end of one edge came from.
    fn behind(&self, end: u32) -> u32 {
        self.joined[end as usize][0]
    }

    /// The edge by which the end `from` grows, if its other end is free then.
    fn step(&self, from: u32) -> Option<Ranked> {
        let delaunay = self.neighborhood.delaunay;
        let behind = self.behind(from);
        let is_ahead = |&to: &u32| to != behind && !self.joined[behind as usize].contains(&to);
        let steps = self.neighborhood.of(from).filter(is_ahead);
        let steps = steps.map(|to| Ranked::new(delaunay, from, to));
        steps.min_by(|a, b| a.compare(b, delaunay))
    }

    fn edges(&self) -> Edges {
        let from = |(p, ends): (usize, &[u32; 2])| ends.map(|q| (p as u32, q));
        let pairs = self.joined.iter().enumerate().flat_map(from);
        let once = pairs.filter(|&(p, q)| q != NONE && p < q);
        once.map(|(p, q)| rows(self.neighborhood.delaunay, p, q)).collect()
    }
}

/// The end of an edge that is not `from`.
fn across(edge: Ranked, from: u32) -> u32 {
    if edge.p == from { edge.q } else { edge.p }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each end grows to its nearest neighbor but those behind, so a circle with uneven steps is walked around and closed.
    #[test]
    fn a_sampled_circle_is_one_ring() {
        let angle = |k: u32| (f64::from(k) + 0.3 * f64::from(k * k % 7) / 7.0) / 10.0;
        let points: Vec<_> = (0..62).map(|k| [angle(k).cos(), angle(k).sin()]).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        let edges = crawl(&delaunay, &Progress::default()).expect("no one cancels");
        let mut ring: Edges = (0..61).map(|k| [k, k + 1]).collect();
        ring.insert(1, [0, 61]);
        assert_eq!(edges, ring);
    }
}
