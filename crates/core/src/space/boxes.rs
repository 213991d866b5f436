//! A hierarchy of boxes around items, to find those in a region, or near to a place.
//!
//! The packed tree of I. Kamel and C. Faloutsos, "On Packing R-trees" (1993): the items lie along a space-filling curve, so
//! those of successive numbers lie close together, and a node is a range of items and the box around them. Linear time.

use crate::space::bounds::Bounds;
use rayon::prelude::*;
use std::ops::Range;

/// Items in a leaf, and nodes under a node.
pub(super) const FAN: usize = 8;

/// The hierarchy.
#[derive(Debug, Default)]
pub struct Boxes {
    items: u32,
    /// The leaves first, a single root last; empty without items.
    levels: Vec<Vec<Bounds>>,
}

impl Boxes {
    /// The boxes around `items`, of which each is in the box that `around` gives.
    #[must_use]
    pub fn new<T: Sync>(items: &[T], around: impl Fn(&T) -> Bounds + Sync) -> Self {
        let leaf = |items: &[T]| items.iter().map(&around).fold(Bounds::EMPTY, Bounds::join);
        Self::over(items.par_chunks(FAN).map(leaf).collect(), items.len())
    }

    /// The boxes over `leaves`, each around the next few of a number of items.
    pub(super) fn over(leaves: Vec<Bounds>, items: usize) -> Self {
        let node = |nodes: &[Bounds]| nodes.iter().copied().fold(Bounds::EMPTY, Bounds::join);
        let mut levels = vec![leaves];
        while let Some(below) = levels.last().filter(|level| level.len() > 1) {
            levels.push(below.par_chunks(FAN).map(node).collect());
        }
        Self { items: items as u32, levels }
    }

    /// The number of levels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.levels.len()
    }

    /// The boxes of a level; level 0 are the leaves.
    #[inline]
    #[must_use]
    pub fn level(&self, level: usize) -> &[Bounds] {
        &self.levels[level]
    }

    /// What is right under a node: nodes of the level below, or the items of a leaf.
    #[inline]
    #[must_use]
    pub fn children(&self, level: usize, node: u32) -> Range<u32> {
        let below = if level == 0 { self.items } else { self.levels[level - 1].len() as u32 };
        let first = FAN as u32 * node;
        first..(first + FAN as u32).min(below)
    }

    /// Visit the items of all boxes that `enter` admits, until `visit` gives true; was there one?
    ///
    /// `enter` sees a box and the range of its items.
    pub fn any(
        &self,
        enter: &mut impl FnMut(&Bounds, Range<u32>) -> bool,
        visit: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        self.items > 0 && self.any_below(self.levels.len() - 1, 0, enter, visit)
    }

    fn any_below(
        &self,
        level: usize,
        node: u32,
        enter: &mut impl FnMut(&Bounds, Range<u32>) -> bool,
        visit: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        #[cfg(test)]
        crate::progress::work_tests::count(crate::progress::work_tests::BOX);
        if !enter(&self.levels[level][node as usize], self.range(level, node)) {
            return false;
        }
        let mut below = self.children(level, node);
        if level == 0 {
            return below.any(visit);
        }
        below.any(|child| self.any_below(level - 1, child, enter, visit))
    }

    /// The items under a node.
    fn range(&self, level: usize, node: u32) -> Range<u32> {
        let width = FAN.pow(level as u32 + 1);
        let end = (width * (node as usize + 1)).min(self.items as usize);
        (width * node as usize) as u32..end as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::Point;

    #[test]
    fn every_item_is_visited_once_and_lies_in_all_its_boxes() {
        for count in [0usize, 1, 8, 9, 33, 1000] {
            let points: Vec<Point> = (0..count).map(|k| [(k * 7 % 31) as f64, k as f64]).collect();
            let mut seen = Vec::new();
            let inside =
                |b: &Bounds, p: Point| (0..2).all(|a| b.low[a] <= p[a] && p[a] <= b.high[a]);
            let found = Boxes::new(&points, |&p| Bounds::at(p)).any(
                &mut |b, mut range| range.all(|k| inside(b, points[k as usize])),
                &mut |k| {
                    seen.push(k as usize);
                    false
                },
            );
            assert!(!found);
            assert_eq!(seen, (0..count).collect::<Vec<_>>());
        }
    }
}
