//! A slice split into parts, so that tasks can write one each.

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
