//! A hierarchy of rectangles along the items in them, to find those in a region that a curve of them meets in one short piece.
//!
//! As in `boxes`, a node is a range of items. Each knows the span of all right under it along its own first side: of the nodes under
//! one that is entered, only those beside that piece are looked at.

use super::boxes::FAN;
use super::oriented::{Oriented, Place, Span};
use super::region::Region;
use rayon::prelude::*;

/// The hierarchy.
#[derive(Debug)]
pub struct Strips {
    /// The leaves first, a single root last; empty without items.
    levels: Vec<Level>,
}

#[derive(Debug)]
struct Level {
    nodes: Vec<Oriented>,
    /// For each item of a leaf, or node of the level below, its span along the node that it is under.
    spans: Vec<Span>,
}

impl Strips {
    /// Those around `items`, of which each is at the place that `place` gives.
    #[must_use]
    pub fn new<T: Sync>(items: &[T], place: impl Fn(&T) -> Place + Sync) -> Self {
        let mut levels: Vec<Level> = Vec::new();
        let mut spans = vec![Span::default(); items.len()];
        let leaves = items.par_chunks(FAN).zip(spans.par_chunks_mut(FAN));
        let leaf = |(items, spans): (&[T], &mut [Span])| Oriented::around(items, &place, spans);
        let mut nodes: Vec<Oriented> = leaves.map(leaf).collect();
        while nodes.len() > 1 {
            let mut above = vec![Span::default(); nodes.len()];
            let width = FAN.pow(levels.len() as u32 + 1);
            let parts = items.par_chunks(FAN * width).zip(above.par_chunks_mut(FAN));
            let node = |(nodes, (items, spans)): (&[_], (&[T], &mut [Span]))| {
                Oriented::over(nodes, items.chunks(width), &place, spans)
            };
            let over = nodes.par_chunks(FAN).zip(parts).map(node).collect();
            levels.push(Level { nodes, spans });
            (nodes, spans) = (over, above);
        }
        levels.push(Level { nodes, spans });
        Self { levels }
    }

    /// Visit all pairs of one of `regions` and an item that may be in it, until `visit` gives true, for each region.
    ///
    /// Many regions at once: each look at a node waits for the one at the node above it, so there is time for the others.
    pub fn search(&self, regions: &[Region], visit: impl FnMut(u32, u32) -> bool) {
        let asked = (0..regions.len() as u32).collect();
        let is_done = vec![false; regions.len()];
        let mut search = Search { strips: self, regions, is_done, asked, met: Vec::new(), visit };
        let root = self.levels.len() - 1;
        if !self.levels[root].nodes.is_empty() {
            search.below(root, 0, 0);
        }
    }
}

/// A search for the items in many regions.
struct Search<'a, V> {
    strips: &'a Strips,
    regions: &'a [Region],
    is_done: Vec<bool>,
    /// The regions that may have something in common with a node; those of the node above it are before them.
    asked: Vec<u32>,
    /// Those that have, and where.
    met: Vec<(u32, Span)>,
    visit: V,
}

impl<V: FnMut(u32, u32) -> bool> Search<'_, V> {
    /// Search a node for the regions `asked`, from number `first` on.
    fn below(&mut self, level: usize, node: usize, first: usize) {
        let Level { nodes, spans } = &self.strips.levels[level];
        let (node_seen, first_met) = (&nodes[node], self.met.len());
        for &number in &self.asked[first..] {
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::BOX);
            let region = &self.regions[number as usize];
            let seen = node_seen.seen_from(region.p);
            if let Some(span) = region.span(&seen) {
                self.met.push((number, seen.own(span)));
            }
        }
        let last_met = self.met.len();
        let below = FAN * node..(FAN * node + FAN).min(spans.len());
        for child in below.take_while(|_| first_met < last_met) {
            let first = self.asked.len();
            for k in first_met..last_met {
                let (number, span) = self.met[k];
                if self.is_done[number as usize] || is_apart(spans[child], span) {
                    continue;
                }
                if level == 0 {
                    self.is_done[number as usize] = (self.visit)(number, child as u32);
                } else {
                    self.asked.push(number);
                }
            }
            if first < self.asked.len() {
                self.below(level - 1, child, first);
                self.asked.truncate(first);
            }
        }
        self.met.truncate(first_met);
    }
}

/// Have the two certainly nothing in common? What is unknown (not a number) has.
#[inline]
fn is_apart([low, high]: Span, [first, last]: Span) -> bool {
    low > last || high < first
}
