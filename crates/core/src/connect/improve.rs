//! What greedy decoding left over: ends that a change of a few edges joins for less.
//!
//! A change is an alternating path: an edge comes in at a point that has room, at its other end one goes out, whose other
//! end takes one in turn (S. Lin and B. Kernighan, "An Effective Heuristic Algorithm for the Traveling-Salesman Problem", 1973).
//! What it saves is counted in full, so an answer never becomes dearer.

use super::constants::{LEAST_GAIN, LONGEST_CHANGE, MOST_DISBELIEF, MOST_RISE, ROUNDS};
use super::found::Found;
use super::selection::Selection;
use rayon::prelude::*;
use std::collections::HashMap;

/// Half-edges that come in and go out, in turn, and what that costs.
#[derive(Debug, Clone, Default)]
struct Change {
    cost: f64,
    edges: Vec<usize>,
}

/// Make changes that save something, until there are none.
pub fn improve(found: &Found<'_>, selection: &mut Selection) {
    for _ in 0..ROUNDS {
        let starts: Vec<usize> = (0..selection.degrees.len())
            .filter(|&v| selection.degrees[v] < found.known.most(v))
            .filter(|&v| open_edges(found, selection, v).next().is_some())
            .collect();
        let changes: Vec<Change> =
            starts.par_iter().filter_map(|&v| Search::new(found, selection).run(v)).collect();
        if !apply(found, selection, changes) {
            break;
        }
    }
}

/// The half-edges at `v` that are not in and not disbelieved.
fn open_edges<'a>(
    found: &'a Found<'_>,
    selection: &'a Selection,
    v: usize,
) -> impl Iterator<Item = usize> + 'a {
    let open = |&e: &usize| !selection.chosen[e] && found.beliefs[e] < MOST_DISBELIEF;
    found.candidates.from(v).filter(open)
}

/// Make the changes, the greatest savings first, that meet none made before; was there any?
///
/// Of different ones that save the same at one point none is made: nothing tells them apart.
fn apply(found: &Found<'_>, selection: &mut Selection, mut changes: Vec<Change>) -> bool {
    let ends = |e: usize| {
        [e, found.candidates.twins[e] as usize].map(|e| found.candidates.ends[e] as usize)
    };
    changes.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut touched = vec![false; selection.degrees.len()];
    let mut is_any = false;
    for equal in changes.chunk_by(|a, b| a.cost == b.cost) {
        let mut wanted: HashMap<usize, u32> = HashMap::new();
        let mut distinct: Vec<(Vec<usize>, Vec<usize>)> = equal
            .iter()
            .map(|change| {
                let mut met: Vec<usize> = change.edges.iter().flat_map(|&e| ends(e)).collect();
                met.sort_unstable();
                met.dedup();
                let twins = &found.candidates.twins;
                let mut edges: Vec<usize> =
                    change.edges.iter().map(|&e| e.min(twins[e] as usize)).collect();
                edges.sort_unstable();
                (edges, met)
            })
            .filter(|(_, met)| !met.iter().any(|&v| touched[v]))
            .collect();
        distinct.sort_unstable();
        distinct.dedup();
        for &v in distinct.iter().flat_map(|(_, met)| met) {
            *wanted.entry(v).or_default() += 1;
            touched[v] = true;
        }
        for (edges, _) in distinct.iter().filter(|(_, met)| met.iter().all(|v| wanted[v] == 1)) {
            let now: Vec<bool> = edges.iter().map(|&e| selection.chosen[e]).collect();
            for (&e, is_in) in edges.iter().zip(now) {
                selection.set(&found.candidates, e, !is_in);
            }
            is_any = true;
        }
    }
    is_any
}

/// The search for the change from one point that saves most.
struct Search<'a> {
    found: &'a Found<'a>,
    selection: &'a Selection,
    path: Vec<usize>,
    visited: Vec<usize>,
    best: Change,
    /// Does another change save as much as the best?
    is_tied: bool,
}

impl<'a> Search<'a> {
    fn new(found: &'a Found<'a>, selection: &'a Selection) -> Self {
        let best = Change { cost: -LEAST_GAIN, edges: Vec::new() };
        Self { found, selection, path: Vec::new(), visited: Vec::new(), best, is_tied: false }
    }

    fn run(mut self, start: usize) -> Option<Change> {
        self.visited.push(start);
        self.extend(start, None, 0.0);
        (!self.best.edges.is_empty() && !self.is_tied).then_some(self.best)
    }

    /// Go on from `v`, which has lost the half-edge `lost`; that costs `cost` so far.
    fn extend(&mut self, v: usize, lost: Option<usize>, cost: f64) {
        let (found, selection) = (self.found, self.selection);
        let before = self.state(v, lost, None);
        for e in open_edges(found, selection, v) {
            let end = found.candidates.ends[e] as usize;
            if self.visited.contains(&end) {
                continue;
            }
            let comes = cost + edge_cost(found, e) + self.state(v, lost, Some(e)) - before;
            let twin = found.candidates.twins[e] as usize;
            self.path.push(e);
            self.visited.push(end);
            if selection.degrees[end] < found.known.most(end) {
                self.meet(comes + self.state(end, None, Some(twin)) - self.state(end, None, None));
            } else if self.path.len() < LONGEST_CHANGE {
                self.exchange(end, twin, comes);
            }
            self.visited.pop();
            self.path.pop();
        }
    }

    /// Take an edge out at `v`, where half-edge `new` comes in.
    fn exchange(&mut self, v: usize, new: usize, cost: f64) {
        let (found, selection) = (self.found, self.selection);
        let before = self.state(v, None, None);
        for old in selection.from(&found.candidates, v) {
            let far = found.candidates.ends[old] as usize;
            if self.visited.contains(&far) || found.candidates.is_kept(old) {
                continue;
            }
            let goes = cost - edge_cost(found, old) + self.state(v, Some(old), Some(new)) - before;
            let back = found.candidates.twins[old] as usize;
            let end = self.state(far, Some(back), None) - self.state(far, None, None);
            self.path.push(old);
            self.visited.push(far);
            self.meet(goes + end);
            if goes + end < MOST_RISE {
                self.extend(far, Some(back), goes + end);
            }
            self.visited.pop();
            self.path.pop();
        }
    }

    /// Note the change so far.
    fn meet(&mut self, cost: f64) {
        if cost < self.best.cost {
            self.best = Change { cost, edges: self.path.clone() };
            self.is_tied = false;
        } else if cost == self.best.cost {
            self.is_tied = true;
        }
    }

    /// What `v` costs with its edges, less one, and one more.
    fn state(&self, v: usize, lost: Option<usize>, new: Option<usize>) -> f64 {
        let Found { candidates, spacing, turns, costs, .. } = self.found;
        let own = self.selection.from(candidates, v).filter(|&e| Some(e) != lost).chain(new);
        let mut edges = own.map(|e| e - candidates.from(v).start);
        let cost = match [edges.next(), edges.next()] {
            [None, _] => costs.alone[v],
            [_, None] => costs.ends[v],
            [Some(a), Some(b)] if a.max(b) < candidates.pairs(v) => {
                let lengths = [a, b].map(|k| spacing.lengths[candidates.from(v).start + k]);
                costs.pair(v, turns.of(v, [a, b]), lengths)
            }
            _ => f32::INFINITY,
        };
        f64::from(cost)
    }
}

fn edge_cost(found: &Found<'_>, e: usize) -> f64 {
    f64::from(found.costs.edges[e])
}
