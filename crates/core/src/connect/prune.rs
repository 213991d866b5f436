//! Outliers that were joined to each other: small components are dropped where points are isolated.

use super::constants::{Constants, FEWEST, PRUNE_COST, PRUNE_FROM, PRUNE_STEP, SMALL};
use super::messages::Factors;
use super::selection::Selection;

/// Drop components that look like outliers in a row, if there are outliers at all.
pub fn prune(
    factors: &Factors<'_>,
    nearest: &[f64],
    constants: &Constants,
    selection: &mut Selection,
) {
    let isolated: Vec<usize> = (0..nearest.len()).filter(|&v| selection.degrees[v] == 0).collect();
    if isolated.len() < PRUNE_FROM {
        return;
    }
    let mut distances: Vec<f64> = isolated.iter().map(|&v| nearest[v]).collect();
    let apart = median(&mut distances);
    let mut seen = vec![false; nearest.len()];
    for v in 0..nearest.len() {
        if selection.degrees[v] == 0 || seen[v] {
            continue;
        }
        let component = component(factors, selection, v, &mut seen);
        if component.len() < SMALL
            && is_outlier(factors, selection, &component, apart, nearest, constants)
        {
            drop_edges(factors, selection, &component);
        }
    }
}

fn component(
    factors: &Factors<'_>,
    selection: &Selection,
    start: usize,
    seen: &mut [bool],
) -> Vec<usize> {
    let mut found = vec![start];
    seen[start] = true;
    let mut next = 0;
    while let Some(&v) = found.get(next) {
        next += 1;
        for e in selection.from(factors.candidates, v) {
            let end = factors.candidates.ends[e] as usize;
            if !seen[end] {
                seen[end] = true;
                found.push(end);
            }
        }
    }
    found
}

fn is_outlier(
    factors: &Factors<'_>,
    selection: &Selection,
    component: &[usize],
    apart: f64,
    nearest: &[f64],
    constants: &Constants,
) -> bool {
    if component.len() < FEWEST {
        return true;
    }
    let mut steps = Vec::new();
    let mut cost = 0.0;
    for &v in component {
        cost += f64::from(vertex_cost(factors, selection, v));
        for e in selection.from(factors.candidates, v) {
            // Both ends of each edge are here.
            cost += f64::from(factors.costs.edges[e]) / 2.0;
            steps.push(nearest[v] * libm::exp(f64::from(factors.geometry.lengths[e])));
        }
    }
    median(&mut steps) >= PRUNE_STEP * apart
        && cost >= PRUNE_COST * constants.alone * component.len() as f64
}

fn vertex_cost(factors: &Factors<'_>, selection: &Selection, v: usize) -> f32 {
    let Factors { candidates, geometry, costs } = factors;
    let Some([i, j]) = selection.pair(candidates, v) else { return costs.ends[v] };
    let first = candidates.from(v).start;
    let step = (geometry.lengths[first + i] - geometry.lengths[first + j]).abs();
    costs.turns[v] * geometry.turn(candidates, v, i, j) + costs.steps[v] * step
}

fn drop_edges(factors: &Factors<'_>, selection: &mut Selection, component: &[usize]) {
    for &v in component {
        for e in factors.candidates.from(v) {
            selection.set(factors.candidates, e, false);
        }
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let count = values.len();
    f64::midpoint(values[(count - 1) / 2], values[count / 2])
}
