//! Gaps over which the crust goes on as evenly and as straight as the curves on both sides are bridged by it.
//!
//! Where samples thin out gradually, each point looks like an outlier to the denser ones; that the steps change little from
//! each to the next shows only along the curve, and the crust has the curve.

use super::constants::{BRIDGE_STEPS, BRIDGE_TURN, Constants};
use super::features::half_edge;
use super::found::Found;
use super::gaps::{rare_step, steps_around};
use super::selection::Selection;
use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;

/// Put in the paths of the crust from free ends to free ends, past isolated points only, that are smooth; and those to isolated
/// points at which the crust ends, if the steps grow towards them.
///
/// # Errors
/// Too little memory.
pub fn bridge(
    delaunay: &Delaunay,
    found: &Found<'_>,
    crust: &Edges,
    constants: &Constants,
    selection: &mut Selection,
) -> Result<()> {
    let ends: Vec<usize> =
        (0..selection.degrees.len()).filter(|&v| selection.degrees[v] == 1).collect();
    if ends.is_empty() {
        return Ok(());
    }
    let crust = Adjacency::new(delaunay, crust)?;
    let walk = Walk { found, crust: &crust, selection, step: constants.gap_free as f32 };
    // All against the same curves, so that their order does not matter; each is found from both ends, if at all.
    let bridges: Vec<usize> = ends.into_iter().filter_map(|v| walk.from(v)).flatten().collect();
    for e in bridges {
        selection.set(&found.candidates, e, true);
    }
    Ok(())
}

struct Walk<'a> {
    found: &'a Found<'a>,
    crust: &'a Adjacency,
    selection: &'a Selection,
    /// The logarithm of the ratio of successive steps from which a gap is one.
    step: f32,
}

impl Walk<'_> {
    /// The half-edges of the path from a free end to the next, or to an end of the crust, if there is one and it is smooth.
    fn from(&self, start: usize) -> Option<Vec<usize>> {
        let candidates = &self.found.candidates;
        if self.found.known.ends_at(start) {
            return None;
        }
        let own = self.selection.from(candidates, start).next()?;
        let (mut came, mut path) = (candidates.twins[own] as usize, Vec::new());
        loop {
            let v = candidates.ends[came] as usize;
            if self.is_last(v) && self.thins_out(start) {
                return Some(path);
            }
            let next = self.next(v, candidates.twins[came] as usize)?;
            if self.selection.chosen[next] {
                // Past the far end, along its own edge.
                return (!path.is_empty()).then_some(path);
            }
            let end = candidates.ends[next] as usize;
            let is_beside = v != start && self.selection.degrees[v] > 0;
            if is_beside
                || end == start
                || self.selection.degrees[end] > 1
                || self.found.known.ends_at(end)
            {
                return None;
            }
            path.push(next);
            came = next;
        }
    }

    /// Is `v` an isolated point at which a curve of the crust ends?
    fn is_last(&self, v: usize) -> bool {
        self.selection.degrees[v] == 0 && self.crust.of(v as u32).len() == 1
    }

    /// Are the last steps before the free end `v` each longer than the one before? By outliers even samples would go on too.
    fn thins_out(&self, v: usize) -> bool {
        let Found { candidates, spacing, .. } = self.found;
        let steps = steps_around(candidates, spacing, self.selection, v);
        steps.len() >= BRIDGE_STEPS && steps[..BRIDGE_STEPS].is_sorted_by(|a, b| a > b)
    }

    /// The half-edge along which the crust goes on at `v`, where it came by the other one, if it does so smoothly.
    fn next(&self, v: usize, back: usize) -> Option<usize> {
        let Found { candidates, spacing, turns, .. } = self.found;
        let of_crust = self.crust.of(v as u32);
        let before = candidates.ends[back];
        let is_on_crust = of_crust.len() == 2 && self.crust.edge(v as u32, before).is_some();
        let (after, _) = of_crust.iter().find(|&&(end, _)| end != before)?;
        let next = half_edge(candidates, v, *after as usize).filter(|_| is_on_crust)?;
        let [a, b] = [back, next].map(|e| spacing.lengths[e]);
        let is_even =
            (a - b).abs() <= self.step || self.is_usual(v, if a > b { back } else { next });
        let is_paired = [back, next].iter().all(|&e| candidates.is_paired(v, e));
        // The square root of the turn.
        (is_even && is_paired && turns.of([back, next]) <= BRIDGE_TURN.sqrt()).then_some(next)
    }

    /// Is the half-edge from `v` part of the curves, or leads it from end to end and is no longer than random samples as uneven
    /// as those on both sides have it?
    fn is_usual(&self, v: usize, e: usize) -> bool {
        let Found { candidates, spacing, .. } = self.found;
        let end = candidates.ends[e] as usize;
        if self.selection.chosen[e]
            || self.selection.degrees[v] != 1
            || self.selection.degrees[end] != 1
        {
            return self.selection.chosen[e];
        }
        let around = |v: usize| steps_around(candidates, spacing, self.selection, v);
        let mut steps = [around(v), around(end)].concat();
        steps.sort_unstable_by(f64::total_cmp);
        spacing.distance(v, end) <= rare_step(&steps)
    }
}
