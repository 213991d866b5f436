//! Medians of a few values without branches, for which of two values is less is hard to foretell.

/// The median, of an even number the mean of the two in the middle; `None` of none.
#[must_use]
pub fn median(values: &mut [f64]) -> Option<f64> {
    let count = values.len();
    match count {
        0 => return None,
        1..=8 => return of_few::<4>(values),
        9..=16 => return of_few::<8>(values),
        _ => (),
    }
    let (low, &mut middle, _) = values.select_nth_unstable_by(count / 2, f64::total_cmp);
    if count % 2 == 1 {
        return Some(middle);
    }
    let below = low.iter().copied().max_by(f64::total_cmp)?;
    Some(f64::midpoint(below, middle))
}

fn of_few<const H: usize>(values: &[f64]) -> Option<f64>
where
    [f64; H]: Sorted,
{
    let mut halves = balanced::<H>();
    halves.as_flattened_mut()[..values.len()].copy_from_slice(values);
    middle(halves, values.len())
}

/// Infinities of both signs in turn: after any number of values in their places as many are below as above, or one more is above.
#[must_use]
pub const fn balanced<const H: usize>() -> [[f64; H]; 2] {
    let (mut half, mut k) = ([f64::NEG_INFINITY; H], 1);
    while k < H {
        half[k] = f64::INFINITY;
        k += 2;
    }
    [half; 2]
}

/// The median of the first `count` of some values, the others balanced.
///
/// Of two sorted halves, the lesser ones of first and last, second and last but one … are the lesser half of all.
#[inline]
pub fn middle<const H: usize>([low, high]: [[f64; H]; 2], count: usize) -> Option<f64>
where
    [f64; H]: Sorted,
{
    let (low, high) = (low.sorted(), high.sorted());
    let [mut below, mut above] = in_order(low[0], high[H - 1]);
    for k in 1..H {
        let [less, more] = in_order(low[k], high[H - 1 - k]);
        below = in_order(below, less)[1];
        above = in_order(above, more)[0];
    }
    let median = if count % 2 == 1 { below } else { f64::midpoint(below, above) };
    (count > 0).then_some(median)
}

/// Values that a fixed row of exchanges puts in order (D. Knuth, "The Art of Computer Programming" 3, 5.3.4).
pub trait Sorted {
    /// The values in order.
    fn sorted(self) -> Self;
}

impl Sorted for [f64; 4] {
    #[inline]
    fn sorted(self) -> Self {
        let [a, b, c, d] = self;
        let ([a, b], [c, d]) = (in_order(a, b), in_order(c, d));
        let ([a, c], [b, d]) = (in_order(a, c), in_order(b, d));
        let [b, c] = in_order(b, c);
        [a, b, c, d]
    }
}

impl Sorted for [f64; 8] {
    #[inline]
    fn sorted(self) -> Self {
        let [a, b, c, d, e, f, g, h] = self;
        let ([a, c], [b, d]) = (in_order(a, c), in_order(b, d));
        let ([e, g], [f, h]) = (in_order(e, g), in_order(f, h));
        let ([a, e], [b, f]) = (in_order(a, e), in_order(b, f));
        let ([c, g], [d, h]) = (in_order(c, g), in_order(d, h));
        let ([a, b], [c, d]) = (in_order(a, b), in_order(c, d));
        let ([e, f], [g, h]) = (in_order(e, f), in_order(g, h));
        let ([c, e], [d, f]) = (in_order(c, e), in_order(d, f));
        let ([b, e], [d, g]) = (in_order(b, e), in_order(d, g));
        let ([b, c], [d, e], [f, g]) = (in_order(b, c), in_order(d, e), in_order(f, g));
        [a, b, c, d, e, f, g, h]
    }
}

#[inline]
fn in_order(a: f64, b: f64) -> [f64; 2] {
    // As two choices: each is one instruction.
    [if b < a { b } else { a }, if b < a { a } else { b }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array;

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

    #[test]
    fn all_zeros_and_ones_are_sorted() {
        // A row of exchanges that sorts all of these sorts everything (Knuth, theorem Z).
        for bits in 0..256_u32 {
            let values: [f64; 8] = array::from_fn(|k| f64::from(bits >> k & 1));
            assert!(values.sorted().is_sorted(), "{bits}");
            let [few @ .., _, _, _, _] = values;
            assert!(few.sorted().is_sorted(), "{bits}");
        }
    }
}
