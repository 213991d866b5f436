//! Rectangles parallel to the axes, around points.

use crate::point::{Point, sub};
use rayon::prelude::*;

/// Points that one task takes at a time.
const GRAIN: usize = 1 << 14;

/// The larger of two numbers; `b` if one of them is none. One instruction, where `f64::max` cares for what is not a number.
#[inline]
#[must_use]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers; `b` if one of them is none.
#[inline]
#[must_use]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// A rectangle parallel to the axes.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// The smallest x and y.
    pub low: Point,
    /// The largest x and y.
    pub high: Point,
}

impl Bounds {
    /// Around nothing.
    pub const EMPTY: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    /// Around the point `p` alone.
    #[must_use]
    pub fn at(p: Point) -> Self {
        Self { low: p, high: p }
    }

    /// The smallest one around `points`.
    #[must_use]
    pub fn of(points: &[Point]) -> Self {
        let around =
            |points: &[Point]| points.iter().fold(Self::EMPTY, |b, &p| b.join(Self::at(p)));
        if points.len() <= GRAIN {
            return around(points);
        }
        points.par_chunks(GRAIN).map(around).reduce(|| Self::EMPTY, Self::join)
    }

    /// The smallest one around both.
    #[inline]
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        let pick = |f: fn(f64, f64) -> f64, a: Point, b: Point| [f(a[0], b[0]), f(a[1], b[1])];
        Self {
            low: pick(f64::min, self.low, other.low),
            high: pick(f64::max, self.high, other.high),
        }
    }

    /// The largest absolute value of a coordinate.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.low.iter().chain(&self.high).fold(0.0, |most, x| most.max(x.abs()))
    }

    /// The longer side.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let [width, height] = sub(self.high, self.low);
        width.max(height)
    }

    /// The four corners.
    #[must_use]
    pub fn corners(&self) -> [Point; 4] {
        let ([x, y], [z, w]) = (self.low, self.high);
        [[x, y], [z, y], [z, w], [x, w]]
    }

    /// The same box, seen from `origin`.
    #[must_use]
    pub fn seen_from(&self, origin: Point) -> Self {
        Self { low: sub(self.low, origin), high: sub(self.high, origin) }
    }

    /// Each corner of this box, moved to the nearest place in `other`.
    #[must_use]
    pub fn clamped(&self, other: &Self) -> Self {
        let clamp =
            |p: Point| [0, 1].map(|axis| p[axis].max(other.low[axis]).min(other.high[axis]));
        Self { low: clamp(self.low), high: clamp(self.high) }
    }

    /// The same box in another unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { low: self.low.map(|x| x * factor), high: self.high.map(|x| x * factor) }
    }

    /// Do the two have a point in common?
    #[inline]
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    /// The squared distance to `p`.
    #[inline]
    #[must_use]
    pub fn square_to(&self, p: Point) -> f64 {
        self.least_square(&Self::at(p))
    }

    /// The least squared distance between a place in this box and a place in the other.
    #[inline]
    #[must_use]
    pub fn least_square(&self, other: &Self) -> f64 {
        let gap = |axis: usize| {
            let [below, above] =
                [self.low[axis] - other.high[axis], other.low[axis] - self.high[axis]];
            larger(larger(below, above), 0.0)
        };
        gap(0).powi(2) + gap(1).powi(2)
    }

    /// The largest squared distance between a place in this box and a place in the other.
    #[inline]
    #[must_use]
    pub fn most_square(&self, other: &Self) -> f64 {
        let span = |axis: usize| {
            (self.high[axis] - other.low[axis]).max(other.high[axis] - self.low[axis])
        };
        span(0).powi(2) + span(1).powi(2)
    }

    /// May the box meet the disk around `center`? False only if they are certainly apart.
    #[must_use]
    pub fn may_meet_disk(&self, center: Point, radius: f64) -> bool {
        let slack = 1e-12 * (center[0].abs() + center[1].abs() + radius);
        let reach = radius + slack;
        let is_apart = self.square_to(center) * (1.0 - 1e-9) > reach * reach;
        // An unknown (not a number) is not apart.
        !is_apart
    }
}
