//! The costs of a set of edges: of each edge, of each point that it passes, ends at, or leaves out.

use super::candidates::Candidates;
use super::constants::Constants;
use super::geometry::Spacing;
use super::roughness::Roughness;

/// The costs; a free end costs 1 unless told otherwise.
#[derive(Debug)]
pub struct Costs {
    /// Of each half-edge's edge.
    pub edges: Vec<f32>,
    /// Of a turn at each vertex: times the square root of the turn in half turns.
    pub turns: Vec<f32>,
    /// Of a change of step at each vertex: times the difference of the logarithms.
    pub steps: Vec<f32>,
    /// Of an end at each vertex.
    pub ends: Vec<f32>,
    /// Of each vertex alone.
    pub alone: Vec<f32>,
}

impl Costs {
    /// The costs, given how rough the curve is around each vertex.
    #[must_use]
    pub fn new(
        candidates: &Candidates,
        spacing: &Spacing<'_>,
        rough: &Roughness,
        constants: &Constants,
    ) -> Self {
        let vertices = candidates.vertices();
        let weights = candidates.by_vertex(|v| rough.step_weight(v, constants) as f32);
        let edges = candidates.map(0.0, |v, own| {
            for (own, e) in own.iter_mut().zip(candidates.from(v)) {
                let ends = [v, candidates.ends[e] as usize];
                let weight = (weights[v] * weights[ends[1]]).sqrt();
                *own = sight_cost(candidates, e, constants)
                    + weight * length_cost(candidates, spacing, ends, e, constants)
                    + rough.gaps.cost(candidates, spacing, ends, e, constants);
            }
        });
        Self {
            edges,
            turns: candidates
                .by_vertex(|v| (constants.turn * rough.turn_weight(v, constants)) as f32),
            steps: weights.into_iter().map(|weight| constants.step as f32 * weight).collect(),
            ends: vec![1.0; vertices],
            alone: candidates.by_vertex(|v| {
                (alone(spacing.crowding[v], constants) * rough.alone_weight(v, constants)) as f32
            }),
        }
    }

    /// What a path along two half-edges at `v` costs there, given its turn and their lengths.
    #[inline]
    #[must_use]
    pub fn pair(&self, v: usize, turn: f32, [a, b]: [f32; 2]) -> f32 {
        self.turns[v] * turn + self.steps[v] * (a - b).abs()
    }
}

/// What the edge of half-edge `e` from `v` costs at first, before anything is known of the curve.
#[must_use]
pub fn first_edge_cost(
    candidates: &Candidates,
    spacing: &Spacing<'_>,
    v: usize,
    e: usize,
    constants: &Constants,
) -> f32 {
    let ends = [v, candidates.ends[e] as usize];
    sight_cost(candidates, e, constants) + length_cost(candidates, spacing, ends, e, constants)
}

fn sight_cost(candidates: &Candidates, e: usize, constants: &Constants) -> f32 {
    constants.sight as f32 * (candidates.sights[e] - constants.sight_free as f32).max(0.0)
}

/// The cost of the length of the edge of half-edge `e` between two vertices.
fn length_cost(
    candidates: &Candidates,
    spacing: &Spacing<'_>,
    ends: [usize; 2],
    e: usize,
    constants: &Constants,
) -> f32 {
    let close = spacing.close;
    let lengths = [e, candidates.twins[e] as usize].map(|e| spacing.lengths[e]);
    let [a, b] = ends.map(|v| spacing.crowding[v]);
    let near = (lengths[0] - (a - close).max(0.0)) + (lengths[1] - (b - close).max(0.0));
    let long = (lengths[0] - a) + (lengths[1] - b);
    f32::midpoint(constants.near as f32 * near, constants.long as f32 * long.max(0.0))
}

fn alone(crowding: f32, constants: &Constants) -> f64 {
    let cost = constants.alone + constants.alone_slope * f64::from(crowding);
    cost.clamp(constants.alone_least * constants.alone, constants.alone_most * constants.alone)
}
