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
            let range = candidates.from(v);
            ring.resize(ring.len().max(range.len() + 1), 0.0);
            // Without branches, as in all of this: which values count is hard to foretell.
            ring[0] = *own;
            let mut count = usize::from(!own.is_nan());
            for e in range {
                let value = values[candidates.ends[e] as usize];
                ring[count] = value;
                count += usize::from(counts(v, e) & !value.is_nan());
            }
            *own = median(&mut ring[..count]).unwrap_or(*own);
        }
    });
    medians
}

/// The median, of an even number the mean of the two in the middle; `None` of none.
#[must_use]
pub fn median(values: &mut [f64]) -> Option<f64> {
    let count = values.len();
    match count {
        0 => return None,
        1..=8 => return Some(middle(&sorted::<8>(values)[..count])),
        9..=16 => return Some(middle(&sorted::<16>(values)[..count])),
        _ => (),
    }
    let (low, &mut middle, _) = values.select_nth_unstable_by(count / 2, f64::total_cmp);
    if count % 2 == 1 {
        return Some(middle);
    }
    let below = low.iter().copied().max_by(f64::total_cmp)?;
    Some(f64::midpoint(below, middle))
}

/// A few values in order: neighbors are exchanged, those at even places and at odd ones in turn (N. Haberman, "Parallel
/// Neighbor Sort", 1972). Faster than to select, as no branch depends on the values.
fn sorted<const N: usize>(values: &[f64]) -> [f64; N] {
    let mut sorted = [f64::INFINITY; N];
    sorted[..values.len()].copy_from_slice(values);
    for round in 0..N {
        for k in (round % 2..N - 1).step_by(2) {
            let (a, b) = (sorted[k], sorted[k + 1]);
            sorted[k] = if b < a { b } else { a };
            sorted[k + 1] = if b < a { a } else { b };
        }
    }
    sorted
}

fn middle(sorted: &[f64]) -> f64 {
    let place = sorted.len() / 2;
    if sorted.len() % 2 == 1 {
        sorted[place]
    } else {
        f64::midpoint(sorted[place - 1], sorted[place])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_in_the_middle() {
        for count in 1..40_usize {
            let mut values: Vec<f64> = (0..count).map(|k| (k * 17 % 41) as f64).collect();
            let mut sorted = values.clone();
            sorted.sort_by(f64::total_cmp);
            let expected = f64::midpoint(sorted[(count - 1) / 2], sorted[count / 2]);
            assert_eq!(median(&mut values), Some(expected), "{count}");
        }
        assert_eq!(median(&mut []), None);
    }
}
