//! What of an edge tells how sure it is: how much it was wanted, by what it was rivaled, and how the points lie around.

use super::candidates::Candidates;
use super::dimension::{Steps, excess_dimension};
use super::found::Found;
use crate::adjacency::Adjacency;
use crate::cocircular::diagonals;
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::progress::Progress;

/// How many numbers describe an edge.
pub const FEATURES: usize = 21;
/// Beliefs beyond this, in ends, are as good as certain.
const SURE: f64 = 4.0;

/// A logarithm of the ratio of lengths beyond which other points are far.
const CLEAR: f64 = 1.5;
/// Below this logarithm they are about as near as the next along the curve.
const TIGHT: f64 = 0.3;
/// Below this they are as near, but for rounding: nothing but a lattice is that even.
const TIED: f64 = 1e-9;
/// Dimensions that exceed 1 by less than this are those of curves.
const DENSE: f64 = 0.1;

/// What is known around each vertex.
pub struct Surroundings<'a> {
    found: &'a Found<'a>,
    curves: &'a Adjacency,
    steps: Steps,
    dimension: Vec<f64>,
    /// The least belief in an edge that is not in.
    rivals: Vec<f64>,
    /// The distance to the nearest neighbor along no edge of the answer.
    beside: Vec<f64>,
    /// The number of points of the component.
    sizes: Vec<u32>,
    /// The mean of the dimension along the component: where curves run side by side here and there it is small, in a cloud
    /// it is not.
    throughout: Vec<f64>,
    /// The share of the points that are isolated.
    isolated: f64,
}

impl<'a> Surroundings<'a> {
    /// Around the vertices of curves.
    ///
    /// # Errors
    /// Too little memory for the diagonals of cocircular points, or a cancelled `progress`.
    pub fn new(
        delaunay: &Delaunay,
        found: &'a Found<'a>,
        curves: &'a Adjacency,
        progress: &Progress,
    ) -> Result<Self> {
        let candidates = &found.candidates;
        let steps = Steps::new(found, curves);
        progress.advance(0)?;
        let dimension = excess_dimension(delaunay, candidates, &steps);
        progress.advance(0)?;
        let rivals = candidates.by_vertex(|v| {
            let out = candidates.from(v).filter(|&e| !found.selection.chosen[e]);
            out.map(|e| f64::from(found.beliefs[e])).fold(SURE, f64::min).max(-SURE)
        });
        let beside = beside(delaunay, found, curves, progress)?;
        progress.advance(0)?;
        let alone = (0..candidates.vertices()).filter(|&v| curves.of(v as u32).is_empty()).count();
        let isolated = alone as f64 / candidates.vertices().max(1) as f64;
        let (sizes, throughout) = along_components(&dimension, curves);
        Ok(Self { found, curves, steps, dimension, rivals, beside, sizes, throughout, isolated })
    }

    /// What describes the edge between two vertices; `None` if no message was sent about it.
    #[must_use]
    pub fn of(&self, ends: [u32; 2]) -> Option<[f64; FEATURES]> {
        let Found { candidates, beliefs, rough, selection, .. } = self.found;
        let [a, b] = ends.map(|v| v as usize);
        let e = half_edge(candidates, a, b)?;
        if !selection.chosen[e] {
            return None;
        }
        let margin = margin(beliefs[e]);
        let rough = rough.turn(a).max(rough.turn(b));
        let dimension = self.dimension[a].max(self.dimension[b]);
        let rival = self.rivals[a].min(self.rivals[b]);
        let weakest = ends.map(|v| self.weakest(v, e)).into_iter().fold(SURE, f64::min);
        let length = self.found.spacing.distance(a, b);
        let step = self.steps.around[a].max(self.steps.around[b]);
        let longer = libm::log(length / step).clamp(0.0, 2.0);
        let turn = ends.map(|v| self.turn(v)).into_iter().fold(0.0, f64::max);
        let open = ends.iter().filter(|&&v| self.curves.of(v).len() == 1).count() as f64;
        let small = 4.0 / f64::from(self.sizes[a].max(4));
        let clearance = libm::log(self.beside[a].min(self.beside[b]) / length).clamp(-1.0, CLEAR);
        let tight = (TIGHT - clearance).max(0.0);
        let sight = f64::from(candidates.sights[e]);
        Some([
            1.0,
            margin,
            rough,
            dimension,
            rival,
            weakest,
            longer,
            turn,
            open,
            small,
            sight,
            self.isolated,
            margin * dimension,
            margin * rough,
            rival * dimension,
            margin * margin,
            clearance,
            tight,
            tight * (dimension - DENSE).max(0.0),
            f64::from(clearance.abs() < TIED),
            dimension * self.throughout[a],
        ])
    }

    /// The share of vertices that no curve touches.
    #[must_use]
    pub fn isolated(&self) -> f64 {
        self.isolated
    }

    /// The usual step around a vertex.
    #[must_use]
    pub fn step(&self, v: u32) -> f64 {
        self.steps.around[v as usize]
    }

    /// How far the curve turns at a vertex, in half turns.
    #[must_use]
    pub fn turn(&self, v: u32) -> f64 {
        let Found { candidates, turns, selection, .. } = self.found;
        let pair = selection.pair(candidates, v as usize);
        pair.map_or(0.0, |pair| f64::from(turns.of(pair).powi(2)))
    }

    /// The least margin of the other edges at a vertex.
    fn weakest(&self, v: u32, e: usize) -> f64 {
        let Found { candidates, beliefs, selection, .. } = self.found;
        let twin = candidates.twins[e] as usize;
        let others = selection.from(candidates, v as usize).filter(|&own| own != e && own != twin);
        others.map(|own| margin(beliefs[own])).fold(SURE, f64::min)
    }
}

/// The distance from each vertex to the nearest neighbor along no edge of `curves`, over all diagonals of cocircular points.
fn beside(
    delaunay: &Delaunay,
    found: &Found<'_>,
    curves: &Adjacency,
    progress: &Progress,
) -> Result<Vec<f64>> {
    let distance = |v: u32, end: u32| found.spacing.distance(v as usize, end as usize);
    let mut beside = found.candidates.by_vertex(|v| {
        let near = delaunay.star(v as u32).neighbors.iter();
        let beside = near.filter(|&&end| curves.edge(v as u32, end).is_none());
        beside.map(|&end| distance(v as u32, end)).fold(f64::INFINITY, f64::min)
    });
    let diagonals = diagonals(delaunay, progress)?;
    for edge in diagonals.iter().filter(|edge| curves.edge(edge.p, edge.q).is_none()) {
        for v in [edge.p, edge.q] {
            let own = &mut beside[v as usize];
            *own = own.min(distance(edge.p, edge.q));
        }
    }
    Ok(beside)
}

fn margin(belief: f32) -> f64 {
    (-f64::from(belief)).clamp(-1.0, SURE)
}

/// The half-edge from one vertex to another, if it is a candidate.
#[must_use]
pub fn half_edge(candidates: &Candidates, from: usize, to: usize) -> Option<usize> {
    candidates.from(from).find(|&e| candidates.ends[e] as usize == to)
}

/// For each vertex the number of those that curves join to it, and the mean of some values at them.
fn along_components(values: &[f64], curves: &Adjacency) -> (Vec<u32>, Vec<f64>) {
    let (mut sizes, mut means) = (vec![0; values.len()], vec![0.0; values.len()]);
    for v in 0..values.len() {
        if sizes[v] == 0 {
            sizes[v] = 1;
            let mut found = vec![v];
            let mut next = 0;
            while let Some(&at) = found.get(next) {
                next += 1;
                for &(end, _) in curves.of(at as u32) {
                    if sizes[end as usize] == 0 {
                        sizes[end as usize] = 1;
                        found.push(end as usize);
                    }
                }
            }
            // In order, so that the sum does not depend on where it starts.
            let mut own: Vec<f64> = found.iter().map(|&at| values[at]).collect();
            own.sort_unstable_by(f64::total_cmp);
            let mean = own.iter().sum::<f64>() / own.len() as f64;
            for &at in &found {
                (sizes[at], means[at]) = (found.len() as u32, mean);
            }
        }
    }
    (sizes, means)
}

/// What reasons ask for.
impl Surroundings<'_> {
    /// Is the edge between two vertices one to keep?
    #[must_use]
    pub fn is_kept(&self, ends: [u32; 2]) -> bool {
        self.found.known.keep.binary_search(&ends).is_ok()
    }

    /// Do hints forbid the edge between two vertices?
    #[must_use]
    pub fn is_forbidden(&self, [a, b]: [u32; 2]) -> bool {
        !self.found.known.allows(&self.found.spacing, a as usize, b)
    }

    /// The distance between two vertices.
    #[must_use]
    pub fn length(&self, [a, b]: [u32; 2]) -> f64 {
        self.found.spacing.distance(a as usize, b as usize)
    }

    /// How much the curve turns around a vertex, in half turns.
    #[must_use]
    pub fn roughness(&self, v: u32) -> f64 {
        self.found.rough.turn(v as usize)
    }
}
