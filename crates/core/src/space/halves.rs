//! An order in which items near each other follow each other, at any scale: by halves, and halves of these.
//!
//! A curve over a lattice, as in `order` and `tree`, leaves no cells for the rest where a few items are very far away.

use super::bounds::Bounds;
use super::boxes::FAN;
use crate::error::Result;
use crate::point::Point;
use crate::progress::Progress;

/// Items below which a half is no task of its own.
const GRAIN: usize = 1 << 12;

/// Items that tell which way the others extend.
const SAMPLE: usize = 64;

/// Put `items` into such an order, one in which the nodes of [`Boxes`](super::boxes::Boxes) are halves or rows of them. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn halve<T: Send>(
    items: &mut [T],
    place: impl Fn(&T) -> Point + Sync + Copy,
    progress: &Progress,
) -> Result<()> {
    if items.len() <= FAN {
        return Ok(());
    }
    let some = items.iter().step_by(items.len() / SAMPLE + 1);
    let around = some.fold(Bounds::EMPTY, |bounds, item| bounds.join(Bounds::at(place(item))));
    let [width, height] = [0, 1].map(|axis| around.high[axis] - around.low[axis]);
    let axis = usize::from(height > width);
    let middle = middle(items.len());
    items.select_nth_unstable_by(middle, |a, b| place(a)[axis].total_cmp(&place(b)[axis]));
    let (before, after) = items.split_at_mut(middle);
    if before.len() + after.len() <= GRAIN {
        halve(before, place, progress)?;
        return halve(after, place, progress);
    }
    progress.advance(0)?;
    let both = rayon::join(|| halve(before, place, progress), || halve(after, place, progress));
    both.0.and(both.1)
}

/// About the half of `count`, in whole nodes of the level below the root.
fn middle(count: usize) -> usize {
    let mut node = FAN;
    while node * FAN < count {
        node *= FAN;
    }
    (count / 2).div_ceil(node) * node
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_hold_whole_nodes_and_something_each() {
        for count in FAN + 1..5000 {
            assert!(middle(count).is_multiple_of(FAN) && (1..count).contains(&middle(count)));
        }
    }

    #[test]
    fn boxes_are_small_though_some_items_are_far_away() {
        let mut places: Vec<Point> =
            (0..4096).map(|k| [f64::from(k * 2741 % 4099), f64::from(k * 1031 % 4093)]).collect();
        places.extend([[1e300, 0.0], [-1e9, 1e200]]);
        halve(&mut places, |&p| p, &Progress::default()).expect("no one cancels");
        let extents = places.chunks(FAN).map(|row| Bounds::of(row).extent());
        assert!(extents.filter(|&extent| extent > 700.0).count() < 40);
    }
}
