//! What the caller knows of the curves: edges that are in or out, ends, the longest edge, that no point is left out.

use super::candidates::{Candidates, by_vertex};
use super::constants::FORCED;
use super::costs::Costs;
use super::geometry::Spacing;
use crate::delaunay::{Delaunay, NONE};
use crate::edges::Edges;

/// Hints, by input rows; the default is none. Repeated points are named by their first row.
#[derive(Debug, Clone, Default)]
pub struct Hints {
    /// Edges that are in the answer, at most two a point.
    pub keep: Edges,
    /// Edges that are not.
    pub forbid: Edges,
    /// Points at which a curve ends.
    pub ends: Vec<u32>,
    /// How long an edge may be.
    pub longest: Option<Longest>,
    /// Is no point left out?
    pub every_point: bool,
    /// Curves of fewer points than this are left out.
    pub fewest: usize,
}

/// How long an edge may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Longest {
    /// In the unit of the input.
    Length(f64),
    /// In spacings: the greater of those around the two ends.
    Spacings(f64),
}

impl Hints {
    /// Is nothing known?
    #[must_use]
    pub fn is_none(&self) -> bool {
        let listed = [self.keep.len(), self.forbid.len(), self.ends.len(), self.fewest];
        listed == [0; 4] && self.longest.is_none() && !self.every_point
    }
}

/// Hints by vertex.
#[derive(Debug, Default)]
pub struct Known {
    /// Pairs of vertices to keep, both ways, sorted.
    pub keep: Vec<[u32; 2]>,
    forbid: Vec<[u32; 2]>,
    /// Vertices at which a curve ends, sorted.
    pub ends: Vec<u32>,
    longest: Option<Longest>,
    /// Is no point left out?
    pub every_point: bool,
    /// The vertex of each row.
    vertices: Vec<u32>,
}

impl Known {
    /// The hints about a triangulation.
    #[must_use]
    pub fn new(hints: &Hints, delaunay: &Delaunay) -> Self {
        if hints.is_none() {
            return Self::default();
        }
        let mut vertices = vec![NONE; delaunay.input_len()];
        for (v, &row) in delaunay.rows().iter().enumerate() {
            vertices[row as usize] = v as u32;
        }
        let vertex = |row: u32| vertices[row as usize];
        let both = |edges: &Edges| {
            let pairs = edges.iter().map(|edge| edge.map(vertex));
            let mut both: Vec<[u32; 2]> = pairs.flat_map(|[a, b]| [[a, b], [b, a]]).collect();
            both.sort_unstable();
            both
        };
        let mut ends: Vec<u32> = hints.ends.iter().map(|&row| vertex(row)).collect();
        ends.sort_unstable();
        let longest = match hints.longest {
            Some(Longest::Length(length)) => Some(Longest::Length(length * delaunay.scale())),
            other => other,
        };
        Self {
            keep: both(&hints.keep),
            forbid: both(&hints.forbid),
            ends,
            longest,
            every_point: hints.every_point,
            vertices,
        }
    }

    /// May the edge from `v` to `end` be in?
    #[must_use]
    pub fn allows(&self, spacing: &Spacing<'_>, v: usize, end: u32) -> bool {
        if self.forbid.binary_search(&[v as u32, end]).is_ok() {
            return false;
        }
        let length = || spacing.distance(v, end as usize);
        match self.longest {
            None => true,
            Some(Longest::Length(longest)) => length() <= longest,
            Some(Longest::Spacings(most)) => {
                let around = spacing.around(v).max(spacing.around(end as usize));
                length() <= most * around
            }
        }
    }

    /// May a ring of rows be in?
    #[must_use]
    pub fn admits(&self, spacing: &Spacing<'_>, ring: &[u32]) -> bool {
        if self.vertices.is_empty() {
            return true;
        }
        let ring: Vec<u32> = ring.iter().map(|&row| self.vertices[row as usize]).collect();
        let count = ring.len();
        (0..count).all(|k| {
            let [before, v, after] = [0, 1, 2].map(|step| ring[(k + step) % count]);
            let from = self.keep.partition_point(|pair| pair[0] < v);
            let kept = self.keep[from..].iter().take_while(|pair| pair[0] == v);
            self.allows(spacing, v as usize, after)
                && !self.ends_at(v as usize)
                && kept.into_iter().all(|&[_, end]| end == before || end == after)
        })
    }

    /// Does a curve end at `v`?
    #[must_use]
    pub fn ends_at(&self, v: usize) -> bool {
        self.ends.binary_search(&(v as u32)).is_ok()
    }

    /// Do points have to be joined however much that costs?
    #[must_use]
    pub fn is_costly(&self) -> bool {
        self.every_point || !self.ends.is_empty()
    }

    /// How many edges `v` may have.
    #[must_use]
    pub fn most(&self, v: usize) -> u8 {
        if self.ends_at(v) { 1 } else { 2 }
    }

    /// Must `v` have an edge?
    #[allow(dead_code)]
    #[must_use]
    pub fn joins(&self, v: usize) -> bool {
        self.every_point || self.ends_at(v)
    }

    /// Put prices on what is known that nothing else outweighs.
    pub fn price(&self, candidates: &Candidates, costs: &mut Costs) {
        if !candidates.kept.is_empty() {
            for (cost, _) in costs.edges.iter_mut().zip(&candidates.kept).filter(|each| *each.1) {
                *cost -= 4.0 * FORCED;
            }
        }
        for &v in &self.ends {
            let v = v as usize;
            (costs.ends[v], costs.alone[v]) = (0.0, FORCED);
        }
        if self.every_point {
            costs.alone = by_vertex(candidates.vertices(), |_| FORCED);
        }
    }
}
