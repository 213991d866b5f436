//! Points that have too few edges for what is known get them by the cheapest changes, by beliefs.
//!
//! A change is an alternating path (J. Edmonds, "Paths, Trees, and Flowers", 1965): an edge comes in, at its other end one
//! goes out, whose other end needs one in turn, until a point is met that is content. Dijkstra's search finds the cheapest
//! from each point, each vertex being met once; so it is the cheapest of most, not of all, such paths.

use super::constants::{DROPPED, MOST_MENDED};
use super::found::Found;
use super::selection::Selection;
use crate::error::{Error, Result};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

/// A cost that can be ordered; with the vertex and the number of the step that led there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cost(f32);

impl Eq for Cost {}

impl PartialOrd for Cost {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Cost {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Half-edges that come in or go out.
#[derive(Debug, Clone, Default)]
struct Step {
    /// The step before, if there is one.
    before: Option<usize>,
    /// The edge that comes in.
    comes: Option<usize>,
    /// The edge that goes out.
    goes: Option<usize>,
}

/// Give edges to points that have too few, the cheapest first.
///
/// # Errors
/// Some cannot get any.
pub fn mend(found: &Found<'_>, selection: &mut Selection) -> Result<()> {
    if !found.known.is_costly() {
        return Ok(());
    }
    loop {
        let lacking: Vec<usize> = (0..found.candidates.vertices())
            .filter(|&v| !found.known.fits(v, selection.degrees[v]))
            .collect();
        let Some(&first) = lacking.first() else { return Ok(()) };
        let mut changes: Vec<(f32, Vec<Step>)> =
            lacking.iter().filter_map(|&v| Search::new(found, selection, v).run()).collect();
        if changes.is_empty() {
            return Err(cannot(found, first, selection.degrees[first]));
        }
        changes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut touched = HashSet::new();
        for (_, steps) in changes {
            apply(found, selection, &steps, &mut touched);
        }
    }
}

fn cannot(found: &Found<'_>, v: usize, degree: u8) -> Error {
    let row = found.known.row(v);
    let message = match degree {
        0 if found.known.ends_at(v) => {
            format!(
                "ends: no edge is left for row {row}: allow more edges, or leave it out of ends"
            )
        }
        0 => format!(
            "every_point: no way to join row {row} was found, though there may be one: allow more edges, or keep= one there"
        ),
        _ => format!(
            "closed: no way to close the curve that ends at row {row} was found, though there may be one: allow more edges, or keep= one there"
        ),
    };
    Error::Argument { message }
}

/// Make a change, unless an earlier one touched one of its vertices.
fn apply(
    found: &Found<'_>,
    selection: &mut Selection,
    steps: &[Step],
    touched: &mut HashSet<usize>,
) {
    let candidates = &found.candidates;
    let edges = || steps.iter().flat_map(|step| [step.comes, step.goes]).flatten();
    if edges().flat_map(|e| candidates.both_ends(e)).any(|v| touched.contains(&v)) {
        return;
    }
    touched.extend(edges().flat_map(|e| candidates.both_ends(e)));
    for step in steps {
        for (e, is_in) in [(step.comes, true), (step.goes, false)] {
            if let Some(e) = e {
                selection.set(candidates, e, is_in);
            }
        }
    }
}

/// The search for the cheapest change that gives a vertex one more edge.
struct Search<'a> {
    found: &'a Found<'a>,
    selection: &'a Selection,
    steps: Vec<Step>,
    open: BinaryHeap<Reverse<(Cost, usize, usize)>>,
    settled: HashSet<usize>,
    /// The cheapest end so far: its cost and last step.
    best: Option<(f32, usize)>,
}

impl<'a> Search<'a> {
    fn new(found: &'a Found<'a>, selection: &'a Selection, start: usize) -> Self {
        Self {
            found,
            selection,
            steps: vec![Step::default()],
            open: BinaryHeap::from([Reverse((Cost(0.0), start, 0))]),
            settled: HashSet::new(),
            best: None,
        }
    }

    fn run(mut self) -> Option<(f32, Vec<Step>)> {
        while let Some(Reverse((Cost(cost), v, step))) = self.open.pop() {
            if self.best.is_some_and(|(best, _)| best <= cost) || self.settled.len() > MOST_MENDED {
                break;
            }
            if self.settled.insert(v) {
                self.expand(v, cost, step);
            }
        }
        let (cost, mut step) = self.best?;
        let mut path = vec![self.steps[step].clone()];
        while let Some(before) = self.steps[step].before {
            step = before;
            path.push(self.steps[step].clone());
        }
        Some((cost, path))
    }

    /// All steps from `v`, which needs one more edge than it has after the changes up to `step`.
    fn expand(&mut self, v: usize, cost: f32, step: usize) {
        let found = self.found;
        let degrees = self.changed_degrees(step);
        let degree = |u: usize| degrees.get(&u).copied().unwrap_or(self.selection.degrees[u]);
        let mut next = Vec::new();
        for e in found.candidates.from(v).filter(|&e| !self.selection.chosen[e]) {
            let end = found.candidates.ends[e] as usize;
            if degrees.contains_key(&end) {
                continue;
            }
            let comes = cost + found.beliefs[e].max(0.0);
            let more = degree(end) + 1;
            if more <= found.known.most(end) {
                next.push((comes, end, more, Some(e), None));
                continue;
            }
            for goes in self.selection.from(&found.candidates, end) {
                let far = found.candidates.ends[goes] as usize;
                if far != v && !degrees.contains_key(&far) && !found.candidates.is_kept(goes) {
                    let cost = comes + (-found.beliefs[goes]).max(0.0);
                    next.push((cost, far, degree(far) - 1, Some(e), Some(goes)));
                }
            }
        }
        // The point may be left out with its one edge, if it need not have any.
        if degree(v) == 1 && found.known.fits(v, 0) {
            let own = self.selection.from(&found.candidates, v);
            for goes in own.filter(|&e| !found.candidates.is_kept(e)) {
                let far = found.candidates.ends[goes] as usize;
                if !degrees.contains_key(&far) || far == v {
                    let cost = cost + (-found.beliefs[goes]).max(0.0) + DROPPED;
                    next.push((cost, far, degree(far) - 1, None, Some(goes)));
                }
            }
        }
        for (cost, at, degree, comes, goes) in next {
            self.reach(step, cost, at, degree, comes, goes);
        }
    }

    /// Note a step to a vertex that has so many edges then.
    fn reach(
        &mut self,
        before: usize,
        cost: f32,
        at: usize,
        degree: u8,
        comes: Option<usize>,
        goes: Option<usize>,
    ) {
        let number = self.steps.len();
        self.steps.push(Step { before: Some(before), comes, goes });
        if self.found.known.fits(at, degree) {
            if self.best.is_none_or(|(best, _)| cost < best) {
                self.best = Some((cost, number));
            }
        } else if !self.settled.contains(&at) {
            self.open.push(Reverse((Cost(cost), at, number)));
        }
    }

    /// The degrees, after a step and those before it, of all vertices that they touch.
    fn changed_degrees(&self, step: usize) -> HashMap<usize, u8> {
        let candidates = &self.found.candidates;
        let mut degrees = HashMap::new();
        let mut at = Some(step);
        while let Some(number) = at {
            let Step { before, comes, goes } = &self.steps[number];
            for (e, is_in) in [(comes, true), (goes, false)] {
                let Some(e) = *e else { continue };
                for half in [e, candidates.twins[e] as usize] {
                    let v = candidates.ends[half] as usize;
                    let degree = degrees.entry(v).or_insert(self.selection.degrees[v]);
                    *degree = if is_in { *degree + 1 } else { *degree - 1 };
                }
            }
            at = *before;
        }
        degrees
    }
}
