//! Medians over rings of neighbors: smoothing that a few wild values do not move.

use super::candidates::{Candidates, GRAIN, each};

/// For each vertex the median of the values at it and at those neighbors that count, as seen from it along a half-edge.
///
/// Values that are not numbers do not count; where none does the value stays.
#[must_use]
pub fn ring_median(
    candidates: &Candidates,
    values: &[f64],
    counts: impl Fn(usize, usize) -> bool + Sync,
) -> Vec<f64> {
    let mut medians = values.to_vec();
    each(medians.chunks_mut(GRAIN), |(k, part)| {
        let mut ring = Vec::new();
        for (i, own) in part.iter_mut().enumerate() {
            let v = k * GRAIN + i;
            ring.clear();
            ring.extend(Some(*own).filter(|value| !value.is_nan()));
            for e in candidates.from(v) {
                let value = values[candidates.ends[e] as usize];
                if counts(v, e) && !value.is_nan() {
                    ring.push(value);
                }
            }
            *own = median(&mut ring).unwrap_or(*own);
        }
    });
    medians
}

/// So many values are sorted faster by insertion than their median is selected.
const FEW: usize = 16;

/// Sort a few numbers.
fn sort(values: &mut [f64]) {
    for k in 1..values.len() {
        let own = values[k];
        let mut place = k;
        while place > 0 && values[place - 1] > own {
            values[place] = values[place - 1];
            place -= 1;
        }
        values[place] = own;
    }
}

/// The median, of an even number the mean of the two in the middle; `None` of none.
#[must_use]
pub fn median(values: &mut [f64]) -> Option<f64> {
    let count = values.len();
    if count == 0 {
        return None;
    }
    if count <= FEW {
        sort(values);
        let middle = count / 2;
        let is_odd = count % 2 == 1;
        return Some(if is_odd {
            values[middle]
        } else {
            f64::midpoint(values[middle - 1], values[middle])
        });
    }
    let (low, &mut middle, _) = values.select_nth_unstable_by(count / 2, f64::total_cmp);
    if count % 2 == 1 {
        return Some(middle);
    }
    let below = low.iter().copied().max_by(f64::total_cmp)?;
    Some(f64::midpoint(below, middle))
}
