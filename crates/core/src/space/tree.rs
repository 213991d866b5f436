//! Segments sorted along a Hilbert curve, with boxes around them, to find the nearest.

use crate::parts::{each, scatter, split};
use crate::point::{Point, dot, sub};
use crate::space::bounds::{Bounds, larger, smaller};
use crate::space::boxes::{Boxes, FAN};
use crate::space::segment::{Segment, push};
use rayon::prelude::*;
use std::ops::Range;
use wide::f64x4;

/// Places that start down the tree together.
const RUN: usize = 64;
/// They part where more boxes than these may matter to one of them.
const MANY: usize = 8;
/// Boxes are compared with squared distances this much larger, for their rounding.
const ROUNDING: f64 = 1.0 + 1e-12;
/// Segments that one task joins at a time.
const GRAIN: usize = 1 << 14;
/// Segments that are sorted at a time, about, and the most such buckets.
const BUCKET: usize = 1 << 9;
const MOST_BUCKETS: usize = 1 << 12;

/// The segments of a leaf, made ready for distances: of each the start, the vector along it, and one over its squared length.
///
/// A plain array, as zeros of it come without being written.
type Leaf = [[f64; FAN]; 5];

/// The leaf of a few segments; what is left of it is infinitely far away.
fn leaf<'a>(ends: impl Iterator<Item = &'a [Point; 2]>) -> Leaf {
    let mut leaf = [[f64::INFINITY; FAN], [f64::INFINITY; FAN], [0.0; FAN], [0.0; FAN], [0.0; FAN]];
    for (k, &[start, end]) in ends.enumerate() {
        let along = sub(end, start);
        let square = dot(along, along);
        let inverse = if square.is_normal() { 1.0 / square } else { 0.0 };
        let values = [start[0], start[1], along[0], along[1], inverse];
        leaf.iter_mut().zip(values).for_each(|(lanes, value)| lanes[k] = value);
    }
    leaf
}

/// The squared distances of the segments of a leaf from `p`.
#[inline]
fn squares(leaf: &Leaf, p: Point) -> [f64x4; 2] {
    let half = |first: usize| {
        let four = |lanes: &[f64; FAN]| {
            f64x4::new([lanes[first], lanes[first + 1], lanes[first + 2], lanes[first + 3]])
        };
        let [x, y, u, v, inverse] = leaf;
        let (x, y, u, v) = (four(x), four(y), four(u), four(v));
        let (x, y) = (f64x4::splat(p[0]) - x, f64x4::splat(p[1]) - y);
        let t = ((x * u + y * v) * four(inverse)).fast_max(f64x4::ZERO).fast_min(f64x4::ONE);
        let (x, y) = (x - t * u, y - t * v);
        x * x + y * y
    };
    [half(0), half(4)]
}

/// The squared distance of one of them: the same number.
#[inline]
fn square(leaf: &Leaf, k: usize, p: Point) -> f64 {
    let [x, y, u, v, inverse] = leaf;
    let (from, along) = ([p[0] - x[k], p[1] - y[k]], [u[k], v[k]]);
    let t = smaller(larger(dot(from, along) * inverse[k], 0.0), 1.0);
    let off = [from[0] - t * along[0], from[1] - t * along[1]];
    dot(off, off)
}

/// Segments, searchable.
#[derive(Debug, Default)]
pub struct Tree {
    leaves: Vec<Leaf>,
    boxes: Boxes,
}

impl Tree {
    /// A tree of the segments in `parts`, joined where they are in line. Queries are within `bounds`.
    #[must_use]
    pub fn new(parts: Vec<Vec<Segment>>, bounds: Bounds) -> Self {
        let order = order(&parts, bounds);
        let part = |order: &[Key]| leaves(joined(&parts, order).iter().map(|s| s.ends));
        let made: Vec<_> = order.par_chunks(GRAIN).map(part).collect();
        drop((parts, order));
        Self::of(made)
    }

    /// A tree of the segments between `ends`, perhaps points, as they are: distances are exact but for rounding.
    #[must_use]
    pub fn exact(ends: &[[Point; 2]]) -> Self {
        let bounds = Bounds::of(ends.as_flattened());
        let parts = [ends.iter().map(|&ends| Segment::new(ends, 0.0)).collect()];
        let order = order(&parts, bounds);
        let part = |order: &[Key]| leaves(order.iter().map(|&key| at(&parts, key).ends));
        Self::of(order.par_chunks(GRAIN).map(part).collect())
    }

    /// Of leaves in parts, with their boxes.
    fn of(parts: Vec<(Vec<Leaf>, Vec<Bounds>)>) -> Self {
        let lengths = || parts.iter().map(|(leaves, _)| leaves.len());
        let bounds: Vec<Bounds> = parts.iter().flat_map(|(_, bounds)| bounds).copied().collect();
        // Zeros come without being written, so that each task is the first to touch what it fills.
        let mut leaves = vec![[[0.0; FAN]; 5]; lengths().sum()];
        let targets = split(&mut leaves, lengths());
        each(targets.into_iter().zip(parts).collect(), |_, (target, (part, _))| {
            target.copy_from_slice(&part);
        });
        let items = FAN * leaves.len();
        Self { leaves, boxes: Boxes::over(bounds, items) }
    }

    /// The distance from each place to the nearest segment, infinite if there is none; places as for `nearest`.
    #[must_use]
    pub fn distances(&self, places: &[Point]) -> Vec<f64> {
        // Squares of distances beyond 1e154 are infinite: one segment is as near as another then.
        let far = |(&p, (segment, distance)): (&Point, (u32, f64))| match self.of_segment(segment) {
            Some(([[x, ..], [y, ..], ..], _)) if distance.is_infinite() => {
                libm::hypot(p[0] - x, p[1] - y)
            }
            _ => distance,
        };
        let parts = places.par_chunks(GRAIN);
        parts.flat_map_iter(|part| part.iter().zip(self.nearest(part)).map(far)).collect()
    }

    /// The distance from `p` to a segment, infinite if there is none.
    #[must_use]
    pub fn distance_to(&self, segment: u32, p: Point) -> f64 {
        self.of_segment(segment).map_or(f64::INFINITY, |(leaf, k)| square(leaf, k, p).sqrt())
    }

    /// The leaf of a segment, and its lane there.
    fn of_segment(&self, segment: u32) -> Option<(&Leaf, usize)> {
        let (leaf, k) = (segment as usize / FAN, segment as usize % FAN);
        self.leaves.get(leaf).map(|leaf| (leaf, k))
    }

    /// For each place the nearest segment and the distance, infinite if there is none.
    ///
    /// Places that follow each other should be near each other: a run of them goes down together, as long as few boxes matter
    /// to one of them, and starts with the answer of the one before it.
    #[must_use]
    pub fn nearest(&self, places: &[Point]) -> Vec<(u32, f64)> {
        let mut found = Vec::with_capacity(places.len());
        if self.leaves.is_empty() {
            found.resize(places.len(), (0, f64::INFINITY));
        } else {
            let mut search = Search { tree: self, near: vec![0], last: 0, found };
            for run in places.chunks(RUN) {
                search.guess(run[run.len() / 2]);
                search.run(run, self.boxes.height() - 1, 0..1);
            }
            found = search.found;
        }
        found
    }
}

/// Runs of searches.
struct Search<'a> {
    tree: &'a Tree,
    /// Boxes that may hold what is nearest: those of each run on the way down after those of the one that it is part of.
    near: Vec<u32>,
    /// The last answer: the first guess of the next.
    last: u32,
    found: Vec<(u32, f64)>,
}

impl Search<'_> {
    /// Take the nearest in the leaf of the nearest boxes for the last answer, if it is nearer to `p`.
    fn guess(&mut self, p: Point) {
        let (mut node, boxes) = (0, &self.tree.boxes);
        for level in (1..boxes.height()).rev() {
            let square = |&child: &u32| boxes.level(level - 1)[child as usize].square_to(p);
            let nearer = |a: &u32, b: &u32| square(a).total_cmp(&square(b));
            node = boxes.children(level, node).min_by(nearer).unwrap_or(0);
        }
        self.near.push(node);
        self.scan(p, self.near.len() - 1..self.near.len());
        self.near.pop();
    }

    /// Find what is nearest to each of `places`, which is in one of some boxes of a level.
    fn run(&mut self, places: &[Point], level: usize, boxes: Range<usize>) {
        let near = self.that_matter(places, level, boxes);
        if near.len() > MANY && places.len() > 1 {
            let (first, second) = places.split_at(places.len() / 2);
            self.run(first, level, near.clone());
            self.run(second, level, near.clone());
        } else if level == 0 {
            for &place in places {
                let found = self.scan(place, near.clone());
                self.found.push(found);
            }
        } else {
            for k in near.clone() {
                self.near.extend(self.tree.boxes.children(level, self.near[k]));
            }
            self.run(places, level - 1, near.end..self.near.len());
        }
        self.near.truncate(near.start);
    }

    /// Those of `boxes` that may hold what is nearest to one of `places`, appended.
    fn that_matter(&mut self, places: &[Point], level: usize, boxes: Range<usize>) -> Range<usize> {
        let (around, bounds) = (Bounds::of(places), self.tree.boxes.level(level));
        let most = self.most_square(&around) * ROUNDING;
        let start = self.near.len();
        self.near.resize(start + boxes.len(), 0);
        let mut end = start;
        // Without branches, as half of them would be mispredicted.
        for k in boxes {
            let number = self.near[k];
            self.near[end] = number;
            end += usize::from(bounds[number as usize].least_square(&around) <= most);
        }
        self.near.truncate(end);
        start..end
    }

    /// No place in a box is farther from the last answer, squared.
    fn most_square(&self, around: &Bounds) -> f64 {
        let middle = [0, 1].map(|k| f64::midpoint(around.low[k], around.high[k]));
        let reach = Bounds::at(middle).most_square(around).sqrt();
        (self.tree.distance_to(self.last, middle) + reach).powi(2)
    }

    /// The segment nearest to `p` among the last answer and those of some leaves, and its distance.
    fn scan(&mut self, p: Point, leaves: Range<usize>) -> (u32, f64) {
        let Some((leaf, k)) = self.tree.of_segment(self.last) else { return (0, f64::INFINITY) };
        let mut best = square(leaf, k, p);
        let boxes = self.tree.boxes.level(0);
        for k in leaves {
            let number = self.near[k];
            if boxes[number as usize].square_to(p) >= best {
                continue;
            }
            let [a, b] = squares(&self.tree.leaves[number as usize], p);
            let [c, d, e, f] = a.fast_min(b).to_array();
            let least = smaller(smaller(c, d), smaller(e, f));
            if least < best {
                best = least;
                let squares = [a.to_array(), b.to_array()];
                let lane = squares.as_flattened().iter().position(|&square| square == least);
                self.last = FAN as u32 * number + lane.unwrap_or(0) as u32;
            }
        }
        (self.last, best.sqrt())
    }
}

/// The leaves of segments, and their boxes.
fn leaves(ends: impl Iterator<Item = [Point; 2]>) -> (Vec<Leaf>, Vec<Bounds>) {
    let ends: Vec<[Point; 2]> = ends.collect();
    ends.chunks(FAN).map(|ends| (leaf(ends.iter()), Bounds::of(ends.as_flattened()))).unzip()
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
fn joined(parts: &[Vec<Segment>], order: &[Key]) -> Vec<Segment> {
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
    kept
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
                let squares =
                    segments.iter().map(|segment| square(&leaf([segment.ends].iter()), 0, place));
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
            let squares = ends.iter().map(|&ends| square(&leaf([ends].iter()), 0, p));
            squares.fold(f64::INFINITY, f64::min).sqrt()
        };
        let expected: Vec<f64> = places.iter().map(nearest).collect();
        assert_eq!(Tree::exact(&ends).distances(&places), expected);
        assert_eq!(Tree::exact(&[[[0.0; 2]; 2]]).distances(&[[0.0, 5e200]]), [5e200]);
    }

    #[test]
    fn chains_are_joined() {
        let tree = Tree::new(vec![chains(700)], UNIT);
        assert!(FAN * tree.leaves.len() < 4 * 700);
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
