//! A long row of items in parts: one task takes one part at a time, reports it, and looks whether to stop.

use crate::error::Result;
use crate::progress::Progress;
use rayon::prelude::*;
use std::ops::Range;

/// Items in a part, where there is no reason for another number.
pub const GRAIN: usize = 1 << 12;

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
    (0..count.div_ceil(grain)).into_par_iter().map(part).collect()
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
    let mut values = vec![empty; count];
    values.par_chunks_mut(GRAIN).enumerate().try_for_each(|(k, part)| {
        for (j, slot) in part.iter_mut().enumerate() {
            *slot = value(k * GRAIN + j);
        }
        progress.advance(part.len())
    })?;
    Ok(values)
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
