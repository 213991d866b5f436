//! T, X and Y: a point that a curve passes takes ends that go straight on to it, and chords that cut its corner go by it.

use super::constants::JUNCTION;
use super::features::half_edge;
use super::found::Found;
use super::selection::Selection;

/// The most edges at a point.
const MOST: u8 = 4;
/// One for each of the ends that may come to a point.
const ROUNDS: usize = MOST as usize;

/// A change that makes a junction: half-edges to it, and the chord that they replace.
#[derive(Debug, Clone, Copy)]
struct Change {
    cost: f32,
    /// The point whose change it is.
    at: usize,
    comes: [Option<usize>; 2],
    goes: Option<usize>,
}

/// Make junctions, the cheapest first, as long as they cost less than what they replace.
pub fn join(found: &Found<'_>, selection: &mut Selection) {
    // The later rounds for what waited, or what earlier ones made room for.
    for _ in 0..ROUNDS {
        let vertices = 0..found.candidates.vertices();
        let mut changes: Vec<Change> =
            vertices.flat_map(|v| changes_at(found, selection, v)).collect();
        changes.retain(|change| change.cost < 0.0);
        if changes.is_empty() {
            return;
        }
        changes.sort_by(|a, b| {
            a.cost.total_cmp(&b.cost).then(a.goes.cmp(&b.goes)).then(a.comes.cmp(&b.comes))
        });
        let mut touched = vec![false; found.candidates.vertices()];
        for change in changes {
            apply(found, selection, change, &mut touched);
        }
    }
}

/// Make a change, unless an earlier one touched one of its points: then its own point waits, and takes nothing worse.
fn apply(found: &Found<'_>, selection: &mut Selection, change: Change, touched: &mut [bool]) {
    let candidates = &found.candidates;
    let edges = || change.comes.into_iter().chain([change.goes]).flatten();
    if edges().flat_map(|e| candidates.both_ends(e)).any(|v| touched[v]) {
        touched[change.at] = true;
        return;
    }
    for v in edges().flat_map(|e| candidates.both_ends(e)) {
        touched[v] = true;
    }
    for e in change.comes.into_iter().flatten() {
        selection.set(candidates, e, true);
    }
    if let Some(e) = change.goes {
        selection.set(candidates, e, false);
    }
}

/// The changes that join an end `v` to a curve or to two other ends, or lead a chord beside `v` through it.
fn changes_at(found: &Found<'_>, selection: &Selection, v: usize) -> Vec<Change> {
    let mut changes = Vec::new();
    let degree = selection.degrees[v];
    if degree == 0 || degree > MOST - 2 || found.known.ends_at(v) {
        return changes;
    }
    if degree == 1 {
        changes.extend(meet(found, selection, v));
    }
    for e in found.candidates.from(v).filter(|&e| !selection.chosen[e]) {
        if degree == 1
            && let Some(cost) = straight_on(found, selection, v, e)
        {
            changes.push(Change { cost, at: v, comes: [Some(e), None], goes: None });
        }
        let x = found.candidates.ends[e] as usize;
        for chord in selection.from(&found.candidates, x) {
            let y = found.candidates.ends[chord] as usize;
            let Some(f) = half_edge(&found.candidates, v, y).filter(|_| x < y) else { continue };
            if !selection.chosen[f] && !found.candidates.is_kept(chord) {
                let cost = through(found, selection, v, [e, f], chord);
                changes.push(Change { cost, at: v, comes: [Some(e), Some(f)], goes: Some(chord) });
            }
        }
    }
    changes
}

/// What joining the end `v` along half-edge `e` to a point of a curve costs, less the end.
fn straight_on(found: &Found<'_>, selection: &Selection, v: usize, e: usize) -> Option<f32> {
    let end = found.candidates.ends[e] as usize;
    let own = selection.from(&found.candidates, v).next()?;
    let is_free = (2..MOST).contains(&selection.degrees[end]);
    if !is_free || found.known.ends_at(end) || is_next(found, selection, own, end) {
        return None;
    }
    let passed = pass(found, v, [own, e])?;
    let met = if selection.degrees[end] == 3 { across(found, selection, e) } else { JUNCTION };
    Some(found.costs.edges[e] + passed - found.costs.ends[v] + met)
}

/// What going on across the junction to which `e` leads costs, along the straightest of its arms.
fn across(found: &Found<'_>, selection: &Selection, e: usize) -> f32 {
    let back = found.candidates.twins[e] as usize;
    let end = found.candidates.ends[e] as usize;
    selection
        .from(&found.candidates, end)
        .filter_map(|arm| pass(found, end, [back, arm]))
        .fold(JUNCTION, f32::min)
}

/// Three ends that meet at `v`, one of them: the two cheapest others that go straight on to it.
fn meet(found: &Found<'_>, selection: &Selection, v: usize) -> Option<Change> {
    let Found { candidates, costs, .. } = found;
    let mut arms: Vec<(f32, usize)> = candidates
        .from(v)
        .filter(|&e| !selection.chosen[e])
        .filter_map(|e| {
            let end = candidates.ends[e] as usize;
            let is_end = selection.degrees[end] == 1 && !found.known.ends_at(end);
            let own = selection.from(candidates, end).next().filter(|_| is_end)?;
            if is_next(found, selection, own, v) {
                return None;
            }
            let passed = pass(found, end, [own, candidates.twins[e] as usize])?;
            Some((costs.edges[e] + passed - costs.ends[end], e))
        })
        .collect();
    arms.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let [(first, e), (second, f), ..] = arms[..] else { return None };
    let cost = first + second - costs.ends[v] + JUNCTION;
    Some(Change { cost, at: v, comes: [Some(e), Some(f)], goes: None })
}

/// What leading the chord from x to y through `v` costs, by the half-edges from there.
fn through(
    found: &Found<'_>,
    selection: &Selection,
    v: usize,
    ways: [usize; 2],
    chord: usize,
) -> f32 {
    let Found { candidates, costs, .. } = found;
    let twin = |e: usize| candidates.twins[e] as usize;
    let bends: f32 = [(ways[0], chord), (ways[1], twin(chord))]
        .into_iter()
        .map(|(way, chord)| bend(found, selection, twin(way), chord))
        .sum();
    let edges = costs.edges[ways[0]] + costs.edges[ways[1]] - costs.edges[chord];
    let end = if selection.degrees[v] == 1 { costs.ends[v] } else { 0.0 };
    edges + bends - end + JUNCTION
}

/// What it costs to go on along `new` instead of `old`, half-edges from one point.
fn bend(found: &Found<'_>, selection: &Selection, new: usize, old: usize) -> f32 {
    let candidates = &found.candidates;
    let v = candidates.ends[candidates.twins[old] as usize] as usize;
    if selection.degrees[v] != 2 {
        return 0.0;
    }
    let other = selection.from(candidates, v).find(|&e| e != old);
    let cost = |e: usize| other.and_then(|other| pass(found, v, [other, e]));
    match (cost(new), cost(old)) {
        (Some(new), Some(old)) => new - old,
        _ => f32::INFINITY,
    }
}

/// What a path along two half-edges at `v` costs there, if they form a pair.
fn pass(found: &Found<'_>, v: usize, edges: [usize; 2]) -> Option<f32> {
    let Found { candidates, turns, spacing, costs, .. } = found;
    let is_paired = edges.iter().all(|&e| candidates.is_paired(v, e));
    is_paired.then(|| costs.pair(v, turns.of(edges), edges.map(|e| spacing.lengths[e])))
}

/// Is `end` the point to which `own` leads, or the one after it?
fn is_next(found: &Found<'_>, selection: &Selection, own: usize, end: usize) -> bool {
    let candidates = &found.candidates;
    let at = candidates.ends[own] as usize;
    at == end || selection.from(candidates, at).any(|e| candidates.ends[e] as usize == end)
}
