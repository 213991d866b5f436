//! A long row of items in parts: one task takes one part at a time, reports it, and looks whether to stop.
//!
//! A single part is worked on where the call is made: waking another thread takes longer than many a call.

use crate::error::Result;
use crate::progress::Progress;
use rayon::prelude::*;
use std::borrow::Borrow;
use std::cmp::Ordering;
use std::ops::Range;

/// Items in a part, where there is no reason for another number.
pub const GRAIN: usize = 1 << 12;

/// Items between two looks at whether to stop, within a part: some of them can take a millisecond each.
const FEW: usize = 64;

/// Tasks that all parts are shared out among, where each has to know what others do.
const TASKS: usize = 8;

/// The successive short ranges of `range`, until someone asks to stop.
pub fn short(range: Range<usize>, progress: &Progress) -> impl Iterator<Item = Range<usize>> {
    let Range { start, end } = range;
    let starts = (start..end).step_by(FEW).take_while(|_| progress.goes_on());
    starts.map(move |start| start..(start + FEW).min(end))
}

/// What `work` makes of each successive range of `grain` of the numbers below `count`.
///
/// # Errors
/// A cancelled `progress`.
pub fn in_parts<T: Send>(
    count: usize,
    grain: usize,
    progress: &Progress,
    work: impl Fn(Range<usize>) -> T + Sync,
) -> Result<Vec<T>> {
    let part = |k: usize| {
        let range = k * grain..(k * grain + grain).min(count);
        let length = range.len();
        let made = work(range);
        progress.advance(length)?;
        Ok(made)
    };
    match count.div_ceil(grain) {
        0 => Ok(Vec::new()),
        1 => Ok(vec![part(0)?]),
        parts => (0..parts).into_par_iter().map(part).collect(),
    }
}

/// The `value` of each number below `count`; until it is known there is `empty` in its place.
///
/// # Errors
/// A cancelled `progress`.
pub fn map<T: Clone + Send>(
    count: usize,
    empty: T,
    progress: &Progress,
    value: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>> {
    replace(vec![empty; count], progress, value)
}

/// The `value` of each number, in place of those of `values`.
///
/// # Errors
/// A cancelled `progress`.
pub fn replace<T: Send>(
    mut values: Vec<T>,
    progress: &Progress,
    value: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>> {
    try_each(values.chunks_mut(GRAIN).collect(), |k, part| {
        let first = k * GRAIN;
        for range in short(first..first + part.len(), progress) {
            for j in range {
                part[j - first] = value(j);
            }
        }
        progress.advance(part.len())
    })?;
    Ok(values)
}

/// Copies of a `value`, written in parallel; zeros alone come from the system without being written.
pub fn copies<T: Copy + Send + Sync>(value: T, count: usize) -> Vec<T> {
    let mut values = Vec::new();
    extend(&mut values, count, |_| value);
    values
}

/// Append the `value` of each number below `count`, in parallel also where the memory for it is new.
pub fn extend<T: Send>(
    values: &mut Vec<T>,
    count: usize,
    value: impl Fn(usize) -> T + Sync + Send,
) {
    if count <= GRAIN {
        values.extend((0..count).map(value));
    } else {
        values.par_extend((0..count).into_par_iter().with_min_len(GRAIN).map(value));
    }
}

/// Give memory back on another thread, if there is one: of a large array that takes milliseconds.
pub fn give_back<T: Send + 'static>(memory: Vec<T>) {
    if rayon::current_num_threads() > 1 {
        rayon::spawn(move || drop(memory));
    }
}

/// Do `work` on each of `parts`, with its number.
///
/// # Errors
/// The first error of `work`.
pub fn try_each<T: Send>(
    parts: Vec<T>,
    work: impl Fn(usize, T) -> Result<()> + Sync + Send,
) -> Result<()> {
    if parts.len() <= 1 {
        return parts.into_iter().try_for_each(|part| work(0, part));
    }
    parts.into_par_iter().enumerate().try_for_each(|(k, part)| work(k, part))
}

/// Do `work`, which cannot fail, on each of `parts`, with its number.
pub fn each<T: Send>(parts: Vec<T>, work: impl Fn(usize, T) + Sync + Send) {
    if parts.len() <= 1 {
        for part in parts {
            work(0, part);
        }
    } else {
        parts.into_par_iter().enumerate().for_each(|(k, part)| work(k, part));
    }
}

/// The `value` of each of `items`.
#[must_use]
pub fn collect<S: Sync, T: Send>(items: &[S], value: impl Fn(&S) -> T + Sync + Send) -> Vec<T> {
    if items.len() <= GRAIN {
        items.iter().map(value).collect()
    } else {
        items.par_iter().with_min_len(GRAIN).map(value).collect()
    }
}

/// Sort `items` in parallel; if the call is cancelled they may be left in any order.
///
/// # Errors
/// A cancelled `progress`.
pub fn sort_by<T: Send>(
    items: &mut [T],
    progress: &Progress,
    compare: impl Fn(&T, &T) -> Ordering + Sync,
) -> Result<()> {
    if items.len() <= GRAIN {
        items.sort_unstable_by(compare);
    } else {
        // Where all is equal, a sort is done soon.
        items.par_sort_unstable_by(|a, b| {
            if progress.goes_on() { compare(a, b) } else { Ordering::Equal }
        });
    }
    progress.advance(0)
}

/// Move the items of `parts` into `buckets`, those of each in their order; return all, and how many are in each bucket.
pub fn scatter<T: Copy + Send + Sync, P: Borrow<[T]> + Sync>(
    parts: &[P],
    empty: T,
    buckets: usize,
    bucket: impl Fn(&T) -> usize + Sync,
) -> (Vec<T>, Vec<usize>) {
    let mut all = vec![empty; parts.iter().map(|part| part.borrow().len()).sum()];
    let counts = scatter_to(&mut all, parts, buckets, bucket);
    (all, counts)
}

/// As [`scatter`], to memory for just these items.
pub fn scatter_to<T: Copy + Send + Sync, P: Borrow<[T]> + Sync>(
    all: &mut [T],
    parts: &[P],
    buckets: usize,
    bucket: impl Fn(&T) -> usize + Sync,
) -> Vec<usize> {
    if buckets == 1 {
        all.iter_mut().zip(items(parts)).for_each(|(place, item)| *place = *item);
        return vec![all.len()];
    }
    let groups: Vec<&[P]> = parts.chunks(parts.len().div_ceil(TASKS).max(1)).collect();
    let mut counts = vec![vec![0; buckets]; groups.len()];
    // Inner iteration, here and below: `for` over `flatten` takes twice the time.
    each(groups.iter().zip(&mut counts).collect(), |_, (group, counts)| {
        items(group).for_each(|item| counts[bucket(item)] += 1);
    });
    let within = |b: usize| counts.iter().map(move |counts| counts[b]);
    let mut places: Vec<_> = groups.iter().map(|_| Vec::with_capacity(buckets)).collect();
    for (k, place) in split(all, (0..buckets).flat_map(within)).into_iter().enumerate() {
        places[k % groups.len()].push(place.iter_mut());
    }
    each(groups.iter().zip(places).collect(), |_, (group, mut places)| {
        items(group).for_each(|item| {
            *places[bucket(item)].next().expect("as many as were counted") = *item;
        });
    });
    (0..buckets).map(|b| within(b).sum()).collect()
}

/// The items of all `parts`.
fn items<'a, T: 'a>(parts: &'a [impl Borrow<[T]>]) -> impl Iterator<Item = &'a T> {
    parts.iter().flat_map(Borrow::borrow)
}

/// Split `slice` into successive parts of these lengths, which sum to no more than its own.
#[must_use]
pub fn split<T>(slice: &mut [T], lengths: impl IntoIterator<Item = usize>) -> Vec<&mut [T]> {
    let mut rest = slice;
    let mut parts = Vec::new();
    for length in lengths {
        let (part, tail) = rest.split_at_mut(length);
        parts.push(part);
        rest = tail;
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_keep_their_order_in_each_bucket() {
        let items: Vec<u32> = (0..5000u32).map(|k| k.wrapping_mul(2_654_435_761) >> 7).collect();
        let bucket = |item: &u32| (item % 10) as usize;
        for length in [1, 7, 600, 5000] {
            let parts: Vec<Vec<u32>> = items.chunks(length).map(<[u32]>::to_vec).collect();
            let (all, counts) = scatter(&parts, 0, 10, bucket);
            let mut sorted = items.clone();
            sorted.sort_by_key(bucket);
            assert_eq!(all, sorted);
            let of = |b| items.iter().filter(|&item| bucket(item) == b).count();
            assert_eq!(counts, (0..10).map(of).collect::<Vec<_>>());
        }
        assert_eq!(scatter::<u32, Vec<u32>>(&[], 0, 4, bucket), (Vec::new(), vec![0; 4]));
    }
}
