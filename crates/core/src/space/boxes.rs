//! A hierarchy of boxes around the vertices, to find those in a region.
//!
//! The vertices lie along a space-filling curve, so those of successive numbers lie close together,
//! and the tree needs no order of its own: a node is a range of vertices and their bounding box.

use crate::point::Point;
use crate::space::bounds::Bounds;
use std::ops::Range;

/// Vertices in a leaf.
const LEAF: usize = 8;
/// Nodes under a node.
const FAN: usize = 4;

/// The hierarchy.
#[derive(Debug)]
pub struct Boxes {
    vertices: u32,
    /// The leaves first, a single root last; empty without vertices.
    levels: Vec<Vec<Bounds>>,
}

impl Boxes {
    /// The boxes around `points`.
    #[must_use]
    pub fn new(points: &[Point]) -> Self {
        let mut levels: Vec<Vec<Bounds>> = vec![points.chunks(LEAF).map(Bounds::of).collect()];
        while let Some(below) = levels.last().filter(|level| level.len() > 1) {
            let join = |nodes: &[Bounds]| nodes.iter().fold(Bounds::EMPTY, |a, &b| a.join(b));
            levels.push(below.chunks(FAN).map(join).collect());
        }
        Self { vertices: points.len() as u32, levels }
    }

    /// Visit the vertices of all boxes that `enter` admits, until `visit` gives true; was there
    /// one?
    ///
    /// `enter` sees a box and the range of its vertices.
    pub fn any(
        &self,
        enter: &mut impl FnMut(&Bounds, Range<u32>) -> bool,
        visit: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        self.vertices > 0 && self.any_below(self.levels.len() - 1, 0, enter, visit)
    }

    fn any_below(
        &self,
        level: usize,
        node: usize,
        enter: &mut impl FnMut(&Bounds, Range<u32>) -> bool,
        visit: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        let range = self.range(level, node);
        if !enter(&self.levels[level][node], range.clone()) {
            return false;
        }
        if level == 0 {
            return range.into_iter().any(visit);
        }
        let end = (FAN * (node + 1)).min(self.levels[level - 1].len());
        (FAN * node..end).any(|below| self.any_below(level - 1, below, enter, visit))
    }

    fn range(&self, level: usize, node: usize) -> Range<u32> {
        let width = LEAF * FAN.pow(level as u32);
        let end = (width * (node + 1)).min(self.vertices as usize);
        (width * node) as u32..end as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_is_visited_once_and_lies_in_all_its_boxes() {
        for count in [0usize, 1, 8, 9, 33, 1000] {
            let points: Vec<Point> = (0..count).map(|k| [(k * 7 % 31) as f64, k as f64]).collect();
            let mut seen = Vec::new();
            let inside =
                |b: &Bounds, p: Point| (0..2).all(|a| b.low[a] <= p[a] && p[a] <= b.high[a]);
            let found = Boxes::new(&points).any(
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
