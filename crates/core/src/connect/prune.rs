//! Outliers that were joined to each other: small components are dropped where points are isolated.

use super::constants::{Constants, FEWEST, PRUNE_FROM, SMALL};
use super::messages::Factors;
use super::rings::median;
use super::selection::Selection;
use crate::error::{Error, Result};

/// Drop components that look like outliers in a row, if there are outliers at all.
pub fn prune(factors: &Factors<'_>, constants: &Constants, selection: &mut Selection) {
    let vertices = factors.candidates.vertices();
    let is_isolated = |&v: &usize| selection.degrees[v] == 0;
    let mut distances: Vec<f64> =
        (0..vertices).filter(is_isolated).map(|v| factors.spacing.nearest[v]).collect();
    if distances.len() < PRUNE_FROM {
        return;
    }
    let apart = median(&mut distances).unwrap_or_default();
    let components = components(factors, selection);
    let most = components.iter().map(Vec::len).max().unwrap_or_default() as f64;
    let limit = (most * constants.prune_size).max(SMALL as f64);
    for component in components.iter().filter(|component| (component.len() as f64) < limit) {
        if !is_kept(factors, component)
            && is_outlier(factors, selection, component, apart, constants)
        {
            drop_edges(factors, selection, component);
        }
    }
}

/// Drop the components of fewer vertices than this.
///
/// # Errors
/// One of them has an edge to keep.
pub fn drop_small(factors: &Factors<'_>, fewest: usize, selection: &mut Selection) -> Result<()> {
    if fewest <= 2 {
        return Ok(());
    }
    for component in components(factors, selection).iter().filter(|own| own.len() < fewest) {
        if is_kept(factors, component) {
            let message = format!(
                "keep and min_points={fewest} contradict each other: a curve with an edge to keep has {} points",
                component.len()
            );
            return Err(Error::Argument { message });
        }
        drop_edges(factors, selection, component);
    }
    Ok(())
}

/// The components that have edges, each as its vertices.
pub fn components(factors: &Factors<'_>, selection: &Selection) -> Vec<Vec<usize>> {
    let mut seen = vec![false; factors.candidates.vertices()];
    let mut components = Vec::new();
    for v in 0..seen.len() {
        if selection.degrees[v] > 0 && !seen[v] {
            components.push(component(factors, selection, v, &mut seen));
        }
    }
    components
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

/// Has a component an edge to keep?
pub fn is_kept(factors: &Factors<'_>, component: &[usize]) -> bool {
    let candidates = factors.candidates;
    component.iter().any(|&v| candidates.from(v).any(|e| candidates.is_kept(e)))
}

fn is_outlier(
    factors: &Factors<'_>,
    selection: &Selection,
    component: &[usize],
    apart: f64,
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
            steps.push(factors.spacing.distance(v, factors.candidates.ends[e] as usize));
        }
    }
    median(&mut steps).is_some_and(|step| step >= constants.prune_step * apart)
        && cost >= constants.prune_cost * constants.alone * component.len() as f64
}

fn vertex_cost(factors: &Factors<'_>, selection: &Selection, v: usize) -> f32 {
    let Factors { candidates, spacing, turns, costs } = factors;
    let Some(pair) = selection.pair(candidates, v) else { return costs.ends[v] };
    let lengths = pair.map(|k| spacing.lengths[candidates.from(v).start + k]);
    costs.pair(v, turns.of(v, pair), lengths)
}

/// Take all edges of a component out.
pub fn drop_edges(factors: &Factors<'_>, selection: &mut Selection, component: &[usize]) {
    for &v in component {
        for e in factors.candidates.from(v) {
            selection.set(factors.candidates, e, false);
        }
    }
}
