//! Medians over rings of neighbors: smoothing that a few wild values do not move.

use super::candidates::{Candidates, GRAIN};
use super::median::{Sorted, balanced, median, middle};

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
    candidates.each(medians.chunks_mut(GRAIN), |(k, part)| {
        for (i, own) in part.iter_mut().enumerate() {
            let v = k * GRAIN + i;
            let ring =
                candidates.from(v).map(|e| (values[candidates.ends[e] as usize], counts(v, e)));
            let median = match ring.len() {
                0..8 => of_few::<4>(*own, ring),
                8..16 => of_few::<8>(*own, ring),
                _ => of_many(*own, ring),
            };
            *own = median.unwrap_or(*own);
        }
    });
    medians
}

/// The median of a value and those others that count, fewer than twice `H`.
#[inline]
fn of_few<const H: usize>(own: f64, others: impl Iterator<Item = (f64, bool)>) -> Option<f64>
where
    [f64; H]: Sorted,
{
    let mut halves = const { balanced::<H>() };
    let places = halves.as_flattened_mut();
    places[0] = own;
    let mut count = usize::from(!own.is_nan());
    // Without branches: which values count is hard to foretell.
    for (value, counts) in others {
        places[count] = value;
        count += usize::from(counts & !value.is_nan());
    }
    if let Some(place) = places.get_mut(count) {
        *place = const { balanced::<H>() }[0][count % 2];
    }
    middle(halves, count)
}

/// The median of a value and those others that count.
fn of_many(own: f64, others: impl Iterator<Item = (f64, bool)>) -> Option<f64> {
    let others = others.filter(|&(_, counts)| counts).map(|(value, _)| value);
    let all = std::iter::once(own).chain(others);
    median(&mut all.filter(|value| !value.is_nan()).collect::<Vec<_>>())
}
