//! Outliers that were joined to each other: small components are dropped where points are isolated.

use super::constants::{Constants, FEWEST, PRUNE_FROM};
use super::median::median;
use super::messages::Factors;
use super::selection::Selection;
use crate::error::{Error, Result};

/// Drop components that look like outliers in a row, if there are outliers at all.
///
/// # Errors
/// The call is cancelled.
pub fn prune(
    factors: &Factors<'_>,
    constants: &Constants,
    selection: &mut Selection,
) -> Result<()> {
    let vertices = factors.candidates.vertices();
    let is_isolated = |&v: &usize| selection.degrees[v] == 0;
    let mut distances: Vec<f64> =
        (0..vertices).filter(is_isolated).map(|v| factors.spacing.nearest[v]).collect();
    if distances.len() < PRUNE_FROM {
        return Ok(());
    }
    let apart = median(&mut distances).unwrap_or_default();
    let (mut few, mut many, mut points) = (Vec::new(), Vec::new(), 0);
    each_component(factors, selection, |own| {
        if !is_outlier(factors, selection, own, apart, constants) {
            points += own.len();
        } else if own.len() < FEWEST {
            few.extend_from_slice(own);
        } else {
            many.extend_from_slice(own);
        }
    })?;
    drop_edges(factors, selection, &few);
    // Where most points would go there is no curve for them to be out of: noise, a cloud.
    if few.len() + many.len() <= points {
        drop_edges(factors, selection, &many);
    }
    Ok(())
}

/// Drop the components of fewer vertices than this.
///
/// # Errors
/// One of them has an edge to keep.
pub fn drop_small(factors: &Factors<'_>, fewest: usize, selection: &mut Selection) -> Result<()> {
    if fewest <= 2 {
        return Ok(());
    }
    for component in components(factors, selection)?.iter().filter(|own| own.len() < fewest) {
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
///
/// # Errors
/// The call is cancelled.
pub fn components(factors: &Factors<'_>, selection: &Selection) -> Result<Vec<Vec<usize>>> {
    let mut components = Vec::new();
    each_component(factors, selection, |own| components.push(own.to_vec()))?;
    Ok(components)
}

/// Show the components that have edges, each as its vertices.
fn each_component(
    factors: &Factors<'_>,
    selection: &Selection,
    mut show: impl FnMut(&[usize]),
) -> Result<()> {
    let mut seen = vec![false; factors.candidates.vertices()];
    let mut found = Vec::new();
    for start in 0..seen.len() {
        factors.candidates.look(start)?;
        if selection.degrees[start] == 0 || seen[start] {
            continue;
        }
        seen[start] = true;
        found.clear();
        found.push(start);
        let mut next = 0;
        while let Some(&v) = found.get(next) {
            next += 1;
            factors.candidates.look(next)?;
            for e in selection.from(factors.candidates, v) {
                let end = factors.candidates.ends[e] as usize;
                if !seen[end] {
                    seen[end] = true;
                    found.push(end);
                }
            }
        }
        show(&found);
    }
    Ok(())
}

/// Has a component an edge to keep?
pub fn is_kept(factors: &Factors<'_>, component: &[usize]) -> bool {
    let candidates = factors.candidates;
    component.iter().any(|&v| candidates.from(v).any(|e| candidates.is_kept(e)))
}

/// Outliers in a row are as far apart as those alone, and neither their steps nor their directions go on from one to the next.
/// Medians, so that corners and single gaps do not tell.
fn is_outlier(
    factors: &Factors<'_>,
    selection: &Selection,
    component: &[usize],
    apart: f64,
    constants: &Constants,
) -> bool {
    if is_kept(factors, component) {
        return false;
    }
    if component.len() < FEWEST {
        return true;
    }
    let Factors { candidates, spacing, turns, .. } = factors;
    let [mut steps, mut changes, mut bends] = [const { Vec::new() }; 3];
    for &v in component {
        for e in selection.from(candidates, v) {
            steps.push(spacing.distance(v, candidates.ends[e] as usize));
        }
        if let Some(pair) = selection.pair(candidates, v) {
            let [a, b] = pair.map(|e| spacing.lengths[e]);
            changes.push(f64::from((a - b).abs()));
            bends.push(f64::from(turns.of(pair)));
        }
    }
    let [step, change, bend] =
        [steps, changes, bends].map(|mut own| median(&mut own).unwrap_or_default());
    // Few points go on like a curve by chance, many do not.
    let few = 2.0 / component.len() as f64;
    step * (constants.stray_base + change + bend) >= constants.stray * (1.0 - few) * apart
}

/// Take all edges of a component out.
pub fn drop_edges(factors: &Factors<'_>, selection: &mut Selection, component: &[usize]) {
    for &v in component {
        for e in factors.candidates.from(v) {
            selection.set(factors.candidates, e, false);
        }
    }
}
