//! Segments of the axis, as few as its shape needs.

use crate::point::{Point, cross, dot, sub};

/// Segments are joined if what they cover lies within this part of their radius of the joined one.
const FLAT: f64 = 5e-4;
/// Up to this length, as a part of the radius.
const LONG: f64 = 0.5;
/// How many of the last segments another may lengthen: samples near each other belong to more than one stretch of the axis.
const OPEN: usize = 3;

/// A segment of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// The ends, perhaps the same.
    pub ends: [Point; 2],
    /// The least radius of the disks along it.
    radius: f64,
    /// How far what it stands for is from it at most.
    slack: f64,
}

impl Segment {
    /// The segment between the centers `ends` of disks no smaller than `radius`.
    #[must_use]
    pub fn new(ends: [Point; 2], radius: f64) -> Self {
        Self { ends, radius, slack: 0.0 }
    }

    /// The squared distance from `p`.
    #[inline]
    #[must_use]
    pub fn square(&self, p: Point) -> f64 {
        let [a, b] = self.ends;
        let (along, from) = (sub(b, a), sub(p, a));
        let length = dot(along, along);
        let t = if length > 0.0 { (dot(from, along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let off = [from[0] - t * along[0], from[1] - t * along[1]];
        dot(off, off)
    }

    /// The point halfway between the ends.
    #[must_use]
    pub fn middle(&self) -> Point {
        let [a, b] = self.ends;
        [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]
    }

    /// Do the two have an end in common?
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.ends.iter().any(|end| other.ends.contains(end))
    }

    /// The one segment that stands for both, if they are in line and leave no gap.
    fn joined(&self, other: &Self) -> Option<Self> {
        let radius = self.radius.min(other.radius);
        let tolerance = FLAT * radius;
        let (ends, gap) = self.span(other);
        let [p, q] = ends;
        let along = sub(q, p);
        let square = dot(along, along);
        if square > (LONG * radius).powi(2) || gap > tolerance {
            return None;
        }
        let off = |end: &Point| cross(along, sub(*end, p)).abs();
        let farthest = self.ends.iter().chain(&other.ends).map(off).fold(0.0, f64::max);
        let farthest = if square > 0.0 { farthest / square.sqrt() } else { 0.0 };
        let slack = farthest + self.slack.max(other.slack);
        (slack <= tolerance).then_some(Self { ends, radius, slack })
    }

    /// The ends, of both segments, that are farthest apart along them, and the length that neither covers.
    fn span(&self, other: &Self) -> ([Point; 2], f64) {
        let ([a, b], [c, d]) = (self.ends, other.ends);
        let (own, more) = (sub(b, a), sub(d, c));
        let sign = if dot(own, more) < 0.0 { -1.0 } else { 1.0 };
        let along = [own[0] + sign * more[0], own[1] + sign * more[1]];
        let along = if along == [0.0; 2] { sub(c, a) } else { along };
        let place = |end: &Point| dot(sub(*end, a), along);
        let (mut first, mut last) = ((a, 0.0), (a, 0.0));
        for end in [b, c, d] {
            let place = place(&end);
            if place < first.1 {
                first = (end, place);
            }
            if place > last.1 {
                last = (end, place);
            }
        }
        let length = |v: Point| dot(v, v).sqrt();
        ([first.0, last.0], length(sub(last.0, first.0)) - length(own) - length(more))
    }
}

/// Append `next`, or lengthen one of the last segments that `may_join` by it.
pub fn push(
    segments: &mut Vec<Segment>,
    next: Segment,
    may_join: impl Fn(&Segment, &Segment) -> bool,
) {
    let open = segments.len().saturating_sub(OPEN);
    for last in segments[open..].iter_mut().rev().filter(|last| may_join(last, &next)) {
        if let Some(joined) = last.joined(&next) {
            *last = joined;
            return;
        }
    }
    segments.push(next);
}
