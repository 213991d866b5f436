//! Segments in a tree of boxes, to find the nearest.
//!
//! The packed tree of I. Kamel and C. Faloutsos, "On Packing R-trees" (1993): segments sorted along a space-filling curve,
//! each box over `FAN` successive ones. Built in linear time after the sort; queries that come in order start from the last answer.

use crate::point::{Point, dot, sub};
use rayon::prelude::*;

/// Children of a node.
const FAN: usize = 8;
/// A box is not opened for a gain smaller than this part of the squared distance.
const GAIN: f64 = 1e-3;
/// A segment within this part of its own radius of the last one kept is left out.
const CROWDED: f64 = 1e-3;

/// A segment of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// The ends, perhaps the same.
    pub ends: [Point; 2],
    /// The lesser radius of the disks at the ends.
    pub radius: f64,
}

impl Segment {
    /// The squared distance from `p`.
    #[inline]
    fn square(&self, p: Point) -> f64 {
        let [a, b] = self.ends;
        let (along, from) = (sub(b, a), sub(p, a));
        let length = dot(along, along);
        let t = if length > 0.0 { (dot(from, along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let off = [from[0] - t * along[0], from[1] - t * along[1]];
        dot(off, off)
    }

    fn middle(&self) -> Point {
        let [a, b] = self.ends;
        [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]
    }

    fn crowds(&self, other: &Self) -> bool {
        let limit = (CROWDED * self.radius).powi(2);
        let near = |k: usize| {
            let step = sub(self.ends[k], other.ends[k]);
            dot(step, step) <= limit
        };
        near(0) && near(1)
    }
}

/// A box: least x and y, then largest.
pub type Bounds = [f64; 4];

const EMPTY: Bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

fn join(a: Bounds, b: Bounds) -> Bounds {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

#[inline]
fn square_to(bounds: &Bounds, p: Point) -> f64 {
    let gap = |low: f64, high: f64, x: f64| (low - x).max(x - high).max(0.0);
    let (x, y) = (gap(bounds[0], bounds[2], p[0]), gap(bounds[1], bounds[3], p[1]));
    x * x + y * y
}

/// Segments, searchable.
#[derive(Debug, Default)]
pub struct Tree {
    segments: Vec<Segment>,
    /// The boxes over segments, over those boxes, and so on up to one.
    levels: Vec<Vec<Bounds>>,
}

/// The memory of a run of queries.
#[derive(Debug, Default)]
pub struct Query {
    stack: Vec<(f64, u32, u32)>,
    last: usize,
}

impl Tree {
    /// A tree of `segments`; those that crowd others are left out. Queries are within `bounds`.
    pub fn new(segments: &[Segment], bounds: Bounds) -> Self {
        let segments = thinned(segments, &order(segments, bounds));
        let mut levels = Vec::new();
        let mut boxes: Vec<Bounds> = segments.par_chunks(FAN).map(bounds_of).collect();
        while boxes.len() > 1 {
            let above =
                boxes.par_chunks(FAN).map(|part| part.iter().copied().fold(EMPTY, join)).collect();
            levels.push(std::mem::replace(&mut boxes, above));
        }
        levels.push(boxes);
        Self { segments, levels }
    }

    /// The distance from `p` to a segment, infinite if there is none.
    pub fn distance_to(&self, segment: u32, p: Point) -> f64 {
        self.segments
            .get(segment as usize)
            .map_or(f64::INFINITY, |segment| segment.square(p).sqrt())
    }

    /// The segment nearest to `p` and its distance, infinite if there is none.
    pub fn nearest(&self, p: Point, query: &mut Query) -> (u32, f64) {
        let Some(guess) = self.segments.get(query.last) else { return (0, f64::INFINITY) };
        let mut best = guess.square(p);
        query.stack.clear();
        query.stack.push((0.0, self.levels.len() as u32 - 1, 0));
        while let Some((square, level, node)) = query.stack.pop() {
            if square >= best * (1.0 - GAIN) {
                continue;
            }
            if level == 0 {
                let first = FAN * node as usize;
                let end = (first + FAN).min(self.segments.len());
                for (k, segment) in self.segments[first..end].iter().enumerate() {
                    let square = segment.square(p);
                    if square < best {
                        (best, query.last) = (square, first + k);
                    }
                }
            } else {
                self.open(p, level, node, best, &mut query.stack);
            }
        }
        (query.last as u32, best.sqrt())
    }

    /// Push the children of a box that are near enough, the nearest last.
    fn open(&self, p: Point, level: u32, node: u32, best: f64, stack: &mut Vec<(f64, u32, u32)>) {
        let below = &self.levels[level as usize - 1];
        let first = FAN * node as usize;
        let children = &below[first..(first + FAN).min(below.len())];
        let start = stack.len();
        for (k, bounds) in children.iter().enumerate() {
            let square = square_to(bounds, p);
            if square < best * (1.0 - GAIN) {
                stack.push((square, level - 1, (first + k) as u32));
            }
        }
        if stack.len() > start + 1 {
            stack[start..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
}

fn bounds_of(segments: &[Segment]) -> Bounds {
    let ends = segments.iter().flat_map(|segment| segment.ends);
    ends.fold(EMPTY, |bounds, [x, y]| join(bounds, [x, y, x, y]))
}

/// The numbers of the segments along a Z-order curve.
///
/// Its cells cover twice the extent of the queries: some centers are so far away that they would leave no cells for the rest.
fn order(segments: &[Segment], [left, bottom, right, top]: Bounds) -> Vec<u32> {
    let extent = (right - left).max(top - bottom);
    let (x, y, cells) =
        (left - extent / 2.0, bottom - extent / 2.0, f64::from(u16::MAX) / (2.0 * extent));
    // The conversion saturates, so what is farther away is in the outermost cells.
    let code = |[px, py]: Point| {
        spread(((px - x) * cells) as u16) | spread(((py - y) * cells) as u16) << 1
    };
    let numbered = segments.par_iter().enumerate();
    let mut keys: Vec<u64> =
        numbered.map(|(k, segment)| code(segment.middle()) << 32 | k as u64).collect();
    keys.par_sort_unstable();
    keys.into_par_iter().map(|key| key as u32).collect()
}

/// The bits of `x`, two apart.
fn spread(x: u16) -> u64 {
    let x = u64::from(x);
    let x = (x | x << 8) & 0x00ff_00ff;
    let x = (x | x << 4) & 0x0f0f_0f0f;
    let x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

fn thinned(segments: &[Segment], order: &[u32]) -> Vec<Segment> {
    let mut kept: Vec<Segment> = Vec::new();
    for &k in order {
        let segment = segments[k as usize];
        if !kept.last().is_some_and(|last| segment.crowds(last)) {
            kept.push(segment);
        }
    }
    kept
}
