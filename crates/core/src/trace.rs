//! Tracing: edges joined end to end into rings and polylines.

use crate::adjacency::Incidence;
use crate::error::Result;
use crate::exact::predicates::orientation;
use crate::memory;
use crate::parts::{GRAIN, short, sort_by};
use crate::point::{Point, lexicographic};
use crate::progress::{Progress, Stage};
use std::cmp::Ordering::{Equal, Greater, Less};
use std::collections::HashMap;

/// Memory for each row and each edge at the peak, about.
const BYTES: usize = 40;

/// Curves as runs of rows, one after another.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Curves {
    /// The rows along each curve; a ring does not repeat its first.
    pub indices: Vec<u32>,
    /// Curve k is `indices[offsets[k]..offsets[k + 1]]`.
    pub offsets: Vec<usize>,
    /// Is curve k a ring?
    pub closed: Vec<bool>,
    /// The points without an edge, each as its first row, ascending.
    pub isolated: Vec<u32>,
}

/// Join `edges`, which are canonical, into curves; every edge is in exactly one.
///
/// Curves end at endpoints and branches, rows whose degree is not two. A ring starts at its smallest row and runs
/// counter-clockwise; a polyline starts at its end of smaller row; curves are sorted by their first row, then their second.
/// A loop based at one branch is a ring. Linear time but for the sort of the curves. Edges that are given away are freed early.
///
/// # Errors
/// A cancelled `progress`.
pub fn trace(
    points: &[Point],
    edges: impl AsRef<[[u32; 2]]>,
    progress: &Progress,
) -> Result<Curves> {
    Ok(trace_between(points, edges, |_| false, |row| row, progress)?.0)
}

/// The same, but for the isolated points.
///
/// # Errors
/// A cancelled `progress`.
pub fn trace_edges(
    points: &[Point],
    edges: impl AsRef<[[u32; 2]]>,
    progress: &Progress,
) -> Result<Curves> {
    let graph = graph(points, edges, progress)?;
    follow(points, &graph, |_| false, |row| row, progress)?.0.sorted(|row| row, progress)
}

/// The same for a part of all edges, which goes on at the rows that are `cut`, and whose rows have a `number` each in the whole.
///
/// Where curves start and in which order they come is settled by these numbers.
/// The curves without a cut row, whole; and the runs of rows from a stop to a stop, where curves end or may go on, with a cut
/// row at one end or both. They are not oriented; a run from a cut row to itself has it at both ends. A cut row is not isolated.
///
/// # Errors
/// A cancelled `progress`.
pub fn trace_between<N: Ord>(
    points: &[Point],
    edges: impl AsRef<[[u32; 2]]>,
    cut: impl Fn(u32) -> bool,
    number: impl Fn(u32) -> N + Copy + Sync,
    progress: &Progress,
) -> Result<(Curves, Vec<Vec<u32>>)> {
    let graph = graph(points, edges, progress)?;
    let (mut curves, runs) = follow(points, &graph, &cut, number, progress)?;
    curves.isolated = isolated(points, &graph, progress);
    curves.isolated.retain(|&row| !cut(row));
    curves.isolated.sort_unstable_by_key(|&row| number(row));
    drop(graph);
    Ok((curves.sorted(number, progress)?, runs))
}

fn graph(
    points: &[Point],
    edges: impl AsRef<[[u32; 2]]>,
    progress: &Progress,
) -> Result<Incidence> {
    let edges = edges.as_ref();
    progress.enter(Stage::Trace, edges.len())?;
    memory::check(points.len() + edges.len(), BYTES)?;
    Ok(Incidence::new(edges, points.len()))
}

/// The curves without a cut row, in the order in which they are met, and the runs.
fn follow<N: Ord>(
    points: &[Point],
    graph: &Incidence,
    cut: impl Fn(u32) -> bool,
    number: impl Fn(u32) -> N,
    progress: &Progress,
) -> Result<(Curves, Vec<Vec<u32>>)> {
    let mut walk = Walk { graph, cut, number, used: vec![false; graph.edges()], path: vec![] };
    let (mut curves, mut runs) = (Curves { offsets: vec![0], ..Curves::default() }, Vec::new());
    // From the stops first: what is left then are rings without one.
    for passes in [false, true] {
        for row in 0..points.len() as u32 {
            for &step in graph.of(row) {
                if walk.passes(row) == passes && !walk.used[step.1 as usize] {
                    walk.follow(row, step);
                    walk.finish(points, &mut curves, &mut runs);
                }
            }
        }
        progress.advance(curves.indices.len())?;
    }
    Ok((curves, runs))
}

/// The state of the tracing.
struct Walk<'a, C, F> {
    graph: &'a Incidence,
    cut: C,
    number: F,
    used: Vec<bool>,
    /// The rows from one stop to the next, both included.
    path: Vec<u32>,
}

impl<N: Ord, C: Fn(u32) -> bool, F: Fn(u32) -> N> Walk<'_, C, F> {
    /// Does a curve that comes to `row` go on there?
    fn passes(&self, row: u32) -> bool {
        self.graph.of(row).len() == 2 && !(self.cut)(row)
    }

    fn follow(&mut self, start: u32, (mut row, mut edge): (u32, u32)) {
        self.path.clear();
        self.path.extend([start, row]);
        self.used[edge as usize] = true;
        while row != start
            && self.passes(row)
            && let &[a, b] = self.graph.of(row)
        {
            (row, edge) = if a.1 == edge { b } else { a };
            self.path.push(row);
            self.used[edge as usize] = true;
        }
    }

    /// Put the path where it belongs.
    fn finish(&mut self, points: &[Point], curves: &mut Curves, runs: &mut Vec<Vec<u32>>) {
        let (first, last) = (self.path[0], self.path[self.path.len() - 1]);
        if (self.cut)(first) || (self.cut)(last) {
            return runs.push(self.path.clone());
        }
        let closed = first == last;
        if closed {
            self.path.pop();
            orient_ring(points, &mut self.path, &self.number);
        } else {
            orient_polyline(&mut self.path, &self.number);
        }
        curves.indices.extend_from_slice(&self.path);
        curves.offsets.push(curves.indices.len());
        curves.closed.push(closed);
    }
}

/// The points without an edge: a repeated row counts as its point, so it is not isolated if that has edges.
///
/// If the call is cancelled, not all of them.
fn isolated(points: &[Point], graph: &Incidence, progress: &Progress) -> Vec<u32> {
    // Adding 0.0 makes one of the two zeros.
    let key = |row: u32| points[row as usize].map(|x| (x + 0.0).to_bits());
    let is_lone = |row: &u32| graph.of(*row).is_empty();
    let rows = || short(0..points.len(), progress).flatten().map(|row| row as u32);
    let mut first = HashMap::new();
    for row in rows().filter(is_lone) {
        first.entry(key(row)).or_insert(row);
    }
    if first.is_empty() {
        return Vec::new();
    }
    for row in rows().filter(|row| !is_lone(row)) {
        first.remove(&key(row));
    }
    first.into_values().collect()
}

fn orient_polyline<N: Ord>(indices: &mut [u32], number: impl Fn(u32) -> N) {
    if number(indices[0]) > number(indices[indices.len() - 1]) {
        indices.reverse();
    }
}

/// Start at the smallest row and run counter-clockwise.
///
/// The turn at the lexicographically smallest point tells the direction of a simple polygon. Where it does not turn there,
/// as on a ring in one line, the smaller neighbor of the first row comes second.
fn orient_ring<N: Ord>(points: &[Point], indices: &mut [u32], number: impl Fn(u32) -> N) {
    let count = indices.len();
    let start = (0..count).min_by_key(|&k| number(indices[k])).unwrap_or(0);
    indices.rotate_left(start);
    let at = |k: usize| points[indices[k % count] as usize];
    let corner = (0..count).min_by(|&a, &b| lexicographic(&at(a), &at(b))).unwrap_or(0);
    let turn = orientation(at(corner + count - 1), at(corner), at(corner + 1));
    let backward = match turn {
        Greater => false,
        Less => true,
        Equal => number(indices[1]) > number(indices[count - 1]),
    };
    if backward {
        indices[1..].reverse();
    }
}

impl Curves {
    /// The rows along curve `k`.
    #[must_use]
    pub fn curve(&self, k: usize) -> &[u32] {
        &self.indices[self.offsets[k]..self.offsets[k + 1]]
    }

    /// The same curves, sorted by the numbers of their rows.
    fn sorted<N: Ord>(self, number: impl Fn(u32) -> N + Sync, progress: &Progress) -> Result<Self> {
        let mut order: Vec<usize> = (0..self.closed.len()).collect();
        let numbers = |k: usize| self.curve(k).iter().map(|&row| number(row));
        sort_by(&mut order, progress, |&a, &b| numbers(a).cmp(numbers(b)))?;
        let isolated = self.isolated.clone();
        let mut sorted = Self { offsets: vec![0], isolated, ..Self::default() };
        sorted.indices.reserve_exact(self.indices.len());
        for order in order.chunks(GRAIN) {
            for &k in order {
                sorted.indices.extend_from_slice(self.curve(k));
                sorted.offsets.push(sorted.indices.len());
                sorted.closed.push(self.closed[k]);
            }
            progress.advance(0)?;
        }
        Ok(sorted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::xorshift::Xorshift;

    #[test]
    fn every_edge_is_in_one_curve_and_every_point_without_one_is_isolated() {
        let mut state = Xorshift(5);
        let mut random = |limit: u64| (state.next() >> 20) % limit;
        for _ in 0..500 {
            let count = 2 + random(9) as u32;
            let points: Vec<Point> =
                (0..count).map(|k| [f64::from(k), random(20) as f64]).collect();
            let pairs = (0..count).flat_map(|p| (p + 1..count).map(move |q| [p, q]));
            let edges: Vec<[u32; 2]> = pairs.filter(|_| random(3) == 0).collect();
            let curves = trace(&points, &edges, &Progress::default()).expect("no one cancels");
            let mut walked = Vec::new();
            for (k, ends) in curves.offsets.windows(2).enumerate() {
                let mut rows = curves.indices[ends[0]..ends[1]].to_vec();
                rows.extend(curves.closed[k].then_some(rows[0]));
                walked.extend(rows.windows(2).map(|ab| [ab[0].min(ab[1]), ab[0].max(ab[1])]));
            }
            walked.sort_unstable();
            assert_eq!(walked, edges);
            let is_alone = |row: &u32| edges.iter().all(|edge| !edge.contains(row));
            assert_eq!(curves.isolated, (0..count).filter(is_alone).collect::<Vec<_>>());
        }
    }
}
