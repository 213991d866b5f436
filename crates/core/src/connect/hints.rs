//! What the caller knows of the curves: edges that are in or out, ends, the longest edge, that no point is left out.

use super::candidates::Candidates;
use super::constants::{CLOSED, CLOSED_ALONE, FORCED};
use super::costs::Costs;
use super::geometry::Spacing;
use crate::adjacency::vertices_of_rows;
use crate::delaunay::Delaunay;
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
    /// Are all curves rings?
    pub closed: bool,
    /// How many curves there are.
    pub components: Option<usize>,
    /// May up to four edges meet at a point?
    pub junctions: bool,
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
        let told = self.every_point || self.closed || self.components.is_some();
        listed == [0; 4] && self.longest.is_none() && !told
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
    /// Are all curves rings?
    pub closed: bool,
    /// Is the number of curves known?
    counted: bool,
    /// The vertex of each row.
    vertices: Vec<u32>,
    /// The row of each vertex.
    rows: Vec<u32>,
}

impl Known {
    /// The hints about a triangulation.
    #[must_use]
    pub fn new(hints: &Hints, delaunay: &Delaunay) -> Self {
        if hints.is_none() {
            return Self::default();
        }
        let vertices = vertices_of_rows(delaunay);
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
            closed: hints.closed,
            counted: hints.components.is_some(),
            vertices,
            rows: delaunay.rows().to_vec(),
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

    /// The row of a vertex, for messages.
    #[must_use]
    pub fn row(&self, v: usize) -> u32 {
        self.rows[v]
    }

    /// Does a curve end at `v`?
    #[must_use]
    pub fn ends_at(&self, v: usize) -> bool {
        self.ends.binary_search(&(v as u32)).is_ok()
    }

    /// Do points have to be joined however much that costs?
    #[must_use]
    pub fn is_costly(&self) -> bool {
        self.every_point || self.closed || self.counted || !self.ends.is_empty()
    }

    /// How many edges `v` may have.
    #[must_use]
    pub fn most(&self, v: usize) -> u8 {
        if self.ends_at(v) { 1 } else { 2 }
    }

    /// May `v` have so many edges?
    #[must_use]
    pub fn fits(&self, v: usize, degree: u8) -> bool {
        match degree {
            0 => !self.every_point && !self.ends_at(v),
            1 => !self.closed,
            _ => degree <= self.most(v),
        }
    }

    /// Do edges, of rows, leave no vertex with too few?
    #[must_use]
    pub fn is_met(&self, delaunay: &Delaunay, edges: &Edges) -> bool {
        if self.vertices.is_empty() {
            return true;
        }
        let mut degrees = vec![0u8; delaunay.points().len()];
        for &row in edges.as_flattened() {
            degrees[self.vertices[row as usize] as usize] += 1;
        }
        (0..degrees.len()).all(|v| degrees[v] >= 2 || self.fits(v, degrees[v]))
    }

    /// Put prices on what is known that nothing else outweighs.
    pub fn price(&self, candidates: &Candidates, costs: &mut Costs) {
        if !candidates.kept.is_empty() {
            for (cost, _) in costs.edges.iter_mut().zip(&candidates.kept).filter(|each| *each.1) {
                *cost -= 4.0 * FORCED;
            }
        }
        if self.closed {
            costs.ends = candidates.by_vertex(|_| CLOSED);
            costs.alone = candidates.by_vertex(|v| costs.alone[v] * CLOSED_ALONE);
        }
        for &v in &self.ends {
            let v = v as usize;
            (costs.ends[v], costs.alone[v]) = (0.0, FORCED);
        }
        if self.every_point {
            costs.alone = candidates.by_vertex(|_| FORCED);
        }
    }
}
