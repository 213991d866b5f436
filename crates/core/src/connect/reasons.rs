//! Why the answer is not the crust, in a word for each edge that only one of the two has.

use super::features::Surroundings;
use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;

/// A word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The curve turns sharply at an end of the edge.
    Corner,
    /// The edge is much longer than the steps around it.
    Gap,
    /// A point beside the edge, or an end of it, is left out.
    Outlier,
    /// The curve ends there.
    End,
    /// The answer goes by a third point close by.
    Chord,
    /// The points scatter about their curve.
    Noise,
    /// More than two edges of the crust meet there.
    Branch,
    /// A cheaper edge was taken instead.
    Rival,
    /// It is an edge to keep or one that is forbidden.
    Hint,
}

impl Reason {
    /// The word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Corner => "corner",
            Self::Gap => "gap",
            Self::Outlier => "outlier",
            Self::End => "end",
            Self::Chord => "chord",
            Self::Noise => "noise",
            Self::Branch => "branch",
            Self::Rival => "rival",
            Self::Hint => "hint",
        }
    }
}

/// A turn of 45° is sharp, in half turns.
const SHARP: f64 = 0.25;
/// Where curves turn by this at most points, 18°, points scatter.
const ROUGH: f64 = 0.1;
/// An edge of so many usual steps crosses a gap.
const LONG: f64 = 2.5;

/// The answer beside the crust.
pub struct Comparison<'a> {
    /// The triangulation.
    pub delaunay: &'a Delaunay,
    /// What is known around the vertices of the answer.
    pub around: &'a Surroundings<'a>,
    /// The answer.
    pub answer: &'a Adjacency,
    /// The crust.
    pub crust: &'a Adjacency,
}

impl Comparison<'_> {
    /// Why the edge of the crust between two vertices is not in the answer.
    #[must_use]
    pub fn left_out(&self, ends: [u32; 2]) -> Reason {
        let degrees = ends.map(|v| self.answer.of(v).len());
        if self.around.is_forbidden(ends) {
            Reason::Hint
        } else if degrees.contains(&0) {
            Reason::Outlier
        } else if self.is_chord(ends) {
            Reason::Chord
        } else if self.is_long(ends) {
            Reason::Gap
        } else if ends.iter().any(|&v| self.crust.of(v).len() > 2) {
            Reason::Branch
        } else if degrees.contains(&1) {
            Reason::End
        } else if self.is_rough(ends) {
            Reason::Noise
        } else {
            Reason::Rival
        }
    }

    /// Why the edge of the answer between two vertices is not in the crust.
    #[must_use]
    pub fn added(&self, ends: [u32; 2]) -> Reason {
        if self.around.is_kept(ends) {
            Reason::Hint
        } else if self.is_beside_outlier(ends) {
            Reason::Outlier
        } else if self.is_long(ends) {
            Reason::Gap
        } else if ends.iter().any(|&v| self.around.turn(v) > SHARP) {
            Reason::Corner
        } else if self.is_rough(ends) {
            Reason::Noise
        } else if ends.iter().any(|&v| self.answer.of(v).len() == 1) {
            Reason::End
        } else {
            Reason::Rival
        }
    }

    /// Does the answer go from one end to the other by one point between?
    fn is_chord(&self, [a, b]: [u32; 2]) -> bool {
        self.answer.of(a).iter().any(|&(v, _)| self.answer.edge(v, b).is_some())
    }

    fn is_long(&self, [a, b]: [u32; 2]) -> bool {
        self.around.length([a, b]) > LONG * self.around.step(a).min(self.around.step(b))
    }

    fn is_rough(&self, ends: [u32; 2]) -> bool {
        ends.iter().any(|&v| self.around.roughness(v) > ROUGH)
    }

    /// Is a common neighbor left out?
    fn is_beside_outlier(&self, [a, b]: [u32; 2]) -> bool {
        let near = |v: u32| self.delaunay.star(v).neighbors;
        near(a).iter().any(|&v| self.answer.of(v).is_empty() && near(b).contains(&v))
    }
}
