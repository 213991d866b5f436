//! Segments sorted along a Hilbert curve, with boxes around them, to find the nearest.

use crate::parts::{each, scatter, split};
use crate::point::{Point, dot, sub};
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;
use crate::space::segment::{Segment, push};
use rayon::prelude::*;

/// Places that go down the tree together.
const RUN: usize = 64;
/// The level down to which they do; there boxes are about as large as the runs.
const MIDDLE: usize = 2;
/// Where segments are joined, a box is not opened for a gain smaller than this part of the squared distance.
const GAIN: f64 = 1e-3;
/// Segments that one task joins at a time.
const GRAIN: usize = 1 << 14;
/// Segments that are sorted at a time, about, and the most such buckets.
const BUCKET: usize = 1 << 9;
const MOST_BUCKETS: usize = 1 << 12;

/// A segment, made ready for distances.
#[derive(Debug, Clone, Copy)]
struct Line {
    start: Point,
    along: Point,
    /// One over the square of the length; 0 if that vanishes.
    inverse: f64,
}

impl Line {
    fn new([start, end]: [Point; 2]) -> Self {
        let along = sub(end, start);
        let square = dot(along, along);
        Self { start, along, inverse: if square.is_normal() { 1.0 / square } else { 0.0 } }
    }

    /// The squared distance from `p`.
    #[inline]
    fn square(&self, p: Point) -> f64 {
        let (along, from) = (self.along, sub(p, self.start));
        let t = (dot(from, along) * self.inverse).clamp(0.0, 1.0);
        let off = [from[0] - t * along[0], from[1] - t * along[1]];
        dot(off, off)
    }
}

/// Segments, searchable.
#[derive(Debug, Default)]
pub struct Tree {
    lines: Vec<Line>,
    boxes: Boxes,
    gain: f64,
}

impl Tree {
    /// A tree of the segments in `parts`, joined where they are in line. Queries are within `bounds`.
    #[must_use]
    pub fn new(parts: Vec<Vec<Segment>>, bounds: Bounds) -> Self {
        let joined = joined(&parts, &order(&parts, bounds));
        drop(parts);
        // Zeros come without being written, so that each task is the first to touch what it fills.
        let mut ends = vec![[[0.0; 2]; 2]; joined.iter().map(Vec::len).sum()];
        let targets = split(&mut ends, joined.iter().map(Vec::len));
        each(targets.into_iter().zip(joined).collect(), |_, (target, part)| {
            target.iter_mut().zip(part).for_each(|(ends, segment)| *ends = segment.ends);
        });
        Self::of(&ends, GAIN)
    }

    /// A tree of the segments between `ends`, perhaps points, as they are: distances are exact but for rounding.
    #[must_use]
    pub fn exact(ends: &[[Point; 2]]) -> Self {
        let bounds = Bounds::of(ends.as_flattened());
        let parts = [ends.iter().map(|&ends| Segment::new(ends, 0.0)).collect()];
        let order = order(&parts, bounds);
        let ordered: Vec<[Point; 2]> = order.into_iter().map(|key| at(&parts, key).ends).collect();
        Self::of(&ordered, 0.0)
    }

    fn of(ends: &[[Point; 2]], gain: f64) -> Self {
        let boxes = Boxes::new(ends, |ends| Bounds::of(ends));
        Self { lines: ends.par_iter().map(|&ends| Line::new(ends)).collect(), boxes, gain }
    }

    /// The distance from each place to the nearest segment, infinite if there is none; places as for `nearest`.
    #[must_use]
    pub fn distances(&self, places: &[Point]) -> Vec<f64> {
        // Squares of distances beyond 1e154 are infinite: one segment is as near as another then.
        let far = |(&p, (segment, distance)): (&Point, (u32, f64))| match self
            .lines
            .get(segment as usize)
        {
            Some(line) if distance.is_infinite() => {
                libm::hypot(p[0] - line.start[0], p[1] - line.start[1])
            }
            _ => distance,
        };
        let parts = places.par_chunks(GRAIN);
        parts.flat_map_iter(|part| part.iter().zip(self.nearest(part)).map(far)).collect()
    }

    /// The distance from `p` to a segment, infinite if there is none.
    #[must_use]
    pub fn distance_to(&self, segment: u32, p: Point) -> f64 {
        self.lines.get(segment as usize).map_or(f64::INFINITY, |line| line.square(p).sqrt())
    }

    /// For each place the nearest segment and the distance, infinite if there is none.
    ///
    /// Places that follow each other should be near each other: a run of them goes down to boxes of about its size together,
    /// and each starts with the answer of the one before it.
    #[must_use]
    pub fn nearest(&self, places: &[Point]) -> Vec<(u32, f64)> {
        if self.lines.is_empty() {
            return vec![(0, f64::INFINITY); places.len()];
        }
        let mut found = Vec::with_capacity(places.len());
        let mut search = Search { tree: self, stack: Vec::new(), last: 0 };
        for run in places.chunks(RUN) {
            let (level, boxes) = self.boxes_near(run);
            found.extend(run.iter().map(|&place| search.nearest(place, level, &boxes)));
        }
        found
    }

    /// The boxes of a middle level that may hold the segment nearest to one of the places.
    fn boxes_near(&self, places: &[Point]) -> (usize, Vec<u32>) {
        let around = Bounds::of(places);
        let (mut level, mut near) = (self.boxes.height() - 1, vec![0]);
        while level > MIDDLE {
            let boxes = self.boxes.level(level - 1);
            let children = || near.iter().flat_map(|&node| self.boxes.children(level, node));
            let farthest = children().map(|k| boxes[k as usize].most_square(&around));
            let most = farthest.fold(f64::INFINITY, f64::min);
            near =
                children().filter(|&k| boxes[k as usize].least_square(&around) <= most).collect();
            level -= 1;
        }
        (level, near)
    }
}

/// A box on the way down, and its squared distance.
#[derive(Debug, Clone, Copy)]
struct Node {
    square: f64,
    level: u32,
    number: u32,
}

/// A run of searches.
struct Search<'a> {
    tree: &'a Tree,
    stack: Vec<Node>,
    /// The last answer: the first guess of the next.
    last: usize,
}

impl Search<'_> {
    /// The segment nearest to `p`, which is in one of the boxes of a level, and its distance.
    fn nearest(&mut self, p: Point, level: usize, boxes: &[u32]) -> (u32, f64) {
        let mut best = self.tree.lines[self.last].square(p);
        self.stack.clear();
        self.push(p, best, level, boxes.iter().copied());
        while let Some(node) = self.stack.pop() {
            if node.square >= best * (1.0 - self.tree.gain) {
                continue;
            }
            let level = node.level as usize;
            let children = self.tree.boxes.children(level, node.number);
            if level > 0 {
                self.push(p, best, level - 1, children);
                continue;
            }
            let (first, end) = (children.start as usize, children.end as usize);
            for (k, line) in self.tree.lines[first..end].iter().enumerate() {
                let square = line.square(p);
                if square < best {
                    (best, self.last) = (square, first + k);
                }
            }
        }
        (self.last as u32, best.sqrt())
    }

    /// Push boxes that are near enough, the nearest last.
    fn push(&mut self, p: Point, best: f64, level: usize, nodes: impl Iterator<Item = u32>) {
        let start = self.stack.len();
        let boxes = self.tree.boxes.level(level);
        let most = best * (1.0 - self.tree.gain);
        for number in nodes {
            let square = boxes[number as usize].square_to(p);
            if square < most {
                self.stack.push(Node { square, level: level as u32, number });
            }
        }
        if self.stack.len() > start + 1 {
            self.stack[start..].sort_unstable_by(|a, b| b.square.total_cmp(&a.square));
        }
    }
}

/// Where a segment is along the curve, its part, and its number there.
type Key = (u32, u32, u32);

/// The segment that a key stands for.
fn at(parts: &[Vec<Segment>], (_, part, number): Key) -> Segment {
    parts[part as usize][number as usize]
}

/// The segments along a Hilbert curve, which leaves no gaps as a Z-order curve does: its boxes overlap half as often.
///
/// Its cells cover twice the extent of the queries: some centers are so far away that they would leave no cells for the rest.
fn order(parts: &[Vec<Segment>], bounds: Bounds) -> Vec<Key> {
    let ([left, bottom], extent) = (bounds.low, bounds.extent());
    let (x, y, cells) =
        (left - extent / 2.0, bottom - extent / 2.0, f64::from(u16::MAX) / (2.0 * extent));
    // The conversion saturates, so what is farther away is in the outermost cells.
    let code = |[px, py]: Point| hilbert(((px - x) * cells) as u16, ((py - y) * cells) as u16);
    let keys = |(part, segments): (usize, &Vec<Segment>)| -> Vec<Key> {
        let key = |(k, segment): (usize, &Segment)| (code(segment.middle()), part as u32, k as u32);
        segments.iter().enumerate().map(key).collect()
    };
    let keys: Vec<Vec<Key>> = parts.par_iter().enumerate().map(keys).collect();
    let count: usize = parts.iter().map(Vec::len).sum();
    let buckets = (count / BUCKET).next_power_of_two().min(MOST_BUCKETS);
    let bucket = |key: &Key| ((u64::from(key.0) * buckets as u64) >> u32::BITS) as usize;
    let (mut keys, counts) = scatter(&keys, (0, 0, 0), buckets, bucket);
    // Stable: where codes are equal, segments stay in their order.
    each(split(&mut keys, counts), |_, bucket| bucket.par_sort_by_key(|key| key.0));
    keys
}

/// The place of cell (x, y) along the Hilbert curve.
fn hilbert(x: u16, y: u16) -> u32 {
    let (mut x, mut y, mut place) = (u32::from(x), u32::from(y), 0);
    for bit in (0..u16::BITS).rev() {
        let (right, top) = (x >> bit & 1, y >> bit & 1);
        place = place << 2 | ((3 * right) ^ top);
        // In the lower quarters the curve runs mirrored; masks, as half of all branches would be mispredicted.
        let lower = top.wrapping_sub(1);
        let turned = lower & 0u32.wrapping_sub(right);
        (x, y) = (x ^ turned, y ^ turned);
        let swap = (x ^ y) & lower;
        (x, y) = (x ^ swap, y ^ swap);
    }
    place
}

/// The segments in `order`, joined where the next is in line with one of the last.
fn joined(parts: &[Vec<Segment>], order: &[Key]) -> Vec<Vec<Segment>> {
    let part = |order: &[Key]| {
        let mut kept = Vec::with_capacity(order.len());
        let mut near = Vec::with_capacity(RUN);
        // Runs are read at once, so that the processor waits for many places of memory at a time.
        for run in order.chunks(RUN) {
            near.clear();
            near.extend(run.iter().map(|&key| at(parts, key)));
            for &next in &near {
                push(&mut kept, next, Segment::joined);
            }
        }
        kept.shrink_to_fit();
        kept
    };
    order.par_chunks(GRAIN).map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Bounds = Bounds { low: [0.0; 2], high: [1.0; 2] };

    /// Short chains of segments, at places and in directions that look random.
    fn chains(count: usize) -> Vec<Segment> {
        let random = |k: usize, prime: u64| (k as u64 * prime % 1_000_003) as f64 / 1_000_003.0;
        let chain = |k: usize| {
            let start = [random(k, 611_953), random(k, 379_721)];
            let (sin, cos) = (std::f64::consts::TAU * random(k, 104_729)).sin_cos();
            let at = move |j: usize| {
                let t = 0.002 * j as f64;
                [start[0] + t * cos, start[1] + t * sin + t * t]
            };
            (0..8).map(move |j| Segment::new([at(j), at(j + 1)], 0.05))
        };
        (1..=count).flat_map(chain).collect()
    }

    #[test]
    fn the_nearest_segment_is_as_near_as_any() {
        for count in [1, 3, 60, 700] {
            let segments = chains(count);
            let tree = Tree::new(segments.chunks(100).map(<[_]>::to_vec).collect(), UNIT);
            let places: Vec<Point> =
                (0..400).map(|k| [f64::from(k % 20) / 19.0, f64::from(k / 20) / 19.0]).collect();
            for (&place, (segment, distance)) in places.iter().zip(tree.nearest(&places)) {
                let squares = segments.iter().map(|segment| Line::new(segment.ends).square(place));
                let nearest = squares.fold(f64::INFINITY, f64::min).sqrt();
                assert!((distance - nearest).abs() <= 1e-3 * (nearest + 0.05));
                assert_eq!(distance, tree.distance_to(segment, place));
            }
        }
    }

    #[test]
    fn an_exact_tree_joins_nothing() {
        let ends: Vec<_> = chains(60).iter().map(|segment| segment.ends).collect();
        let places: Vec<Point> = (0..99).map(|k| [f64::from(k) / 99.0, 0.3]).collect();
        let nearest = |&p: &Point| {
            let squares = ends.iter().map(|&ends| Line::new(ends).square(p));
            squares.fold(f64::INFINITY, f64::min).sqrt()
        };
        let expected: Vec<f64> = places.iter().map(nearest).collect();
        assert_eq!(Tree::exact(&ends).distances(&places), expected);
        assert_eq!(Tree::exact(&[[[0.0; 2]; 2]]).distances(&[[0.0, 5e200]]), [5e200]);
    }

    #[test]
    fn chains_are_joined() {
        let tree = Tree::new(vec![chains(700)], UNIT);
        assert!(tree.lines.len() < 4 * 700);
    }

    #[test]
    fn no_segments_are_infinitely_far() {
        let tree = Tree::new(vec![], Bounds::EMPTY);
        assert_eq!(tree.nearest(&[[1.0, 2.0]]), [(0, f64::INFINITY)]);
        assert_eq!(tree.distance_to(0, [1.0, 2.0]), f64::INFINITY);
    }

    #[test]
    fn the_hilbert_curve_steps_to_a_cell_beside() {
        let mut cells: Vec<[u16; 2]> = (0..64).flat_map(|x| (0..64).map(move |y| [x, y])).collect();
        cells.sort_by_key(|&[x, y]| hilbert(x, y));
        for pair in cells.windows(2) {
            assert_eq!(pair[0][0].abs_diff(pair[1][0]) + pair[0][1].abs_diff(pair[1][1]), 1);
        }
    }
}
