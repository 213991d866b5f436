//! Tracing: edges joined end to end into rings and polylines.

use crate::adjacency::Incidence;
use crate::edges::Edges;
use crate::error::Result;
use crate::exact::predicates::orientation;
use crate::point::{Point, lexicographic};
use crate::progress::{Progress, Stage};
use std::cmp::Ordering::{Equal, Greater, Less};
use std::collections::HashMap;

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
/// A loop based at one branch is a ring. Linear time but for the sort of the curves.
///
/// # Errors
/// A cancelled `progress`.
pub fn trace(points: &[Point], edges: &Edges, progress: &Progress) -> Result<Curves> {
    progress.enter(Stage::Trace, edges.len())?;
    let graph = Incidence::new(edges, points.len());
    let mut walk =
        Walk { graph: &graph, used: vec![false; edges.len()], curves: Curves::default() };
    walk.curves.offsets.push(0);
    let rows = 0..points.len() as u32;
    for row in rows.clone().filter(|&row| !matches!(graph.of(row).len(), 0 | 2)) {
        walk.from(row);
    }
    progress.advance(walk.curves.indices.len())?;
    for row in rows.clone().filter(|&row| graph.of(row).len() == 2) {
        walk.from(row);
    }
    progress.advance(0)?;
    let mut curves = walk.curves;
    for k in 0..curves.closed.len() {
        let closed = curves.closed[k];
        let indices = &mut curves.indices[curves.offsets[k]..curves.offsets[k + 1]];
        if closed { orient_ring(points, indices) } else { orient_polyline(indices) }
    }
    curves.isolated = isolated(points, &graph);
    Ok(curves.sorted())
}

/// The state of the tracing.
struct Walk<'a> {
    graph: &'a Incidence,
    used: Vec<bool>,
    curves: Curves,
}

impl Walk<'_> {
    /// Trace every curve that leaves `row` by an edge not used yet.
    fn from(&mut self, row: u32) {
        for &step in self.graph.of(row) {
            if !self.used[step.1 as usize] {
                self.follow(row, step);
            }
        }
    }

    fn follow(&mut self, start: u32, (mut row, mut edge): (u32, u32)) {
        self.curves.indices.push(start);
        self.used[edge as usize] = true;
        while row != start
            && let &[a, b] = self.graph.of(row)
        {
            self.curves.indices.push(row);
            (row, edge) = if a.1 == edge { b } else { a };
            self.used[edge as usize] = true;
        }
        let closed = row == start;
        if !closed {
            self.curves.indices.push(row);
        }
        self.curves.offsets.push(self.curves.indices.len());
        self.curves.closed.push(closed);
    }
}

/// The points without an edge: a repeated row counts as its point, so it is not isolated if that has edges.
fn isolated(points: &[Point], graph: &Incidence) -> Vec<u32> {
    // Adding 0.0 makes one of the two zeros.
    let key = |row: u32| points[row as usize].map(|x| (x + 0.0).to_bits());
    let (lone, joined): (Vec<u32>, Vec<u32>) =
        (0..points.len() as u32).partition(|&row| graph.of(row).is_empty());
    let mut first = HashMap::new();
    for &row in &lone {
        first.entry(key(row)).or_insert(row);
    }
    for row in joined.into_iter().filter(|_| !lone.is_empty()) {
        first.remove(&key(row));
    }
    let mut rows: Vec<u32> = first.into_values().collect();
    rows.sort_unstable();
    rows
}

fn orient_polyline(indices: &mut [u32]) {
    if indices.first() > indices.last() {
        indices.reverse();
    }
}

/// Start at the smallest row and run counter-clockwise.
///
/// The turn at the lexicographically smallest point tells the direction of a simple polygon. Where it does not turn there,
/// as on a ring in one line, the smaller neighbor of the first row comes second.
fn orient_ring(points: &[Point], indices: &mut [u32]) {
    let count = indices.len();
    let start = (0..count).min_by_key(|&k| indices[k]).unwrap_or(0);
    indices.rotate_left(start);
    let at = |k: usize| points[indices[k % count] as usize];
    let corner = (0..count).min_by(|&a, &b| lexicographic(&at(a), &at(b))).unwrap_or(0);
    let turn = orientation(at(corner + count - 1), at(corner), at(corner + 1));
    let backward = match turn {
        Greater => false,
        Less => true,
        Equal => indices[1] > indices[count - 1],
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

    /// The same curves, sorted by their rows.
    fn sorted(self) -> Self {
        let mut order: Vec<usize> = (0..self.closed.len()).collect();
        order.sort_unstable_by(|&a, &b| self.curve(a).cmp(self.curve(b)));
        let mut sorted =
            Self { offsets: vec![0], isolated: self.isolated.clone(), ..Self::default() };
        sorted.indices.reserve_exact(self.indices.len());
        for k in order {
            sorted.indices.extend_from_slice(self.curve(k));
            sorted.offsets.push(sorted.indices.len());
            sorted.closed.push(self.closed[k]);
        }
        sorted
    }
}
