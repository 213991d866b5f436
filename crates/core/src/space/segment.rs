//! Segments of the axis, as few as its shape needs.

use crate::point::{Point, cross, dot, length, sub};

/// Segments are joined if what they cover lies within this part of their radius of the joined one.
const FLAT: f64 = 5e-4;
/// Up to this length, as a part of the radius.
const LONG: f64 = 0.5;
/// Starts farther apart than this part of the radius belong to segments too far apart to be joined, or nearly so.
const FAR: f64 = 2.0 * LONG;
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

    /// The point halfway between the ends.
    #[must_use]
    pub fn middle(&self) -> Point {
        let [a, b] = self.ends;
        [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]
    }

    /// The one segment that stands for both, if they have an end in common and are in line.
    #[must_use]
    pub fn continued(&self, other: &Self) -> Option<Self> {
        let shared = self.ends.iter().position(|end| other.ends.contains(end))?;
        let common = self.ends[shared];
        let ends = [self.ends[1 - shared], other.ends[usize::from(other.ends[0] == common)]];
        let (to, on) = (sub(common, ends[0]), sub(ends[1], common));
        if dot(to, on) < 0.0 {
            return None;
        }
        self.replaced(other, ends)
    }

    /// The one segment that stands for both, if they are in line and leave no gap.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Option<Self> {
        // What is far apart is told first, as nearly all pairs are; then what is long: the gap takes three roots.
        let between = sub(other.ends[0], self.ends[0]);
        if dot(between, between) > (FAR * self.radius.min(other.radius)).powi(2) {
            return None;
        }
        let ends = self.span(other);
        if self.is_long(other, ends) {
            return None;
        }
        let gap = length(sub(ends[1], ends[0])) - self.ends_apart() - other.ends_apart();
        if gap > FLAT * self.radius.min(other.radius) {
            return None;
        }
        self.replaced(other, ends)
    }

    fn ends_apart(&self) -> f64 {
        length(sub(self.ends[1], self.ends[0]))
    }

    /// Is a segment between `ends` too long to stand for both?
    #[inline]
    fn is_long(&self, other: &Self, ends: [Point; 2]) -> bool {
        let along = sub(ends[1], ends[0]);
        dot(along, along) > (LONG * self.radius.min(other.radius)).powi(2)
    }

    /// The segment between `ends` in place of both, if it is short and near enough to stand for them.
    fn replaced(&self, other: &Self, ends: [Point; 2]) -> Option<Self> {
        if self.is_long(other, ends) {
            return None;
        }
        let radius = self.radius.min(other.radius);
        let along = sub(ends[1], ends[0]);
        let square = dot(along, along);
        let off = |end: &Point| cross(along, sub(*end, ends[0])).abs();
        let farthest = self.ends.iter().chain(&other.ends).map(off).fold(0.0, f64::max);
        let farthest = if square > 0.0 { farthest / square.sqrt() } else { 0.0 };
        let slack = farthest + self.slack.max(other.slack);
        (slack <= FLAT * radius).then_some(Self { ends, radius, slack })
    }

    /// The ends, of both segments, that are farthest apart along them.
    fn span(&self, other: &Self) -> [Point; 2] {
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
        [first.0, last.0]
    }
}

/// Append `next`, or `lengthen` one of the last segments by it.
pub fn push(
    segments: &mut Vec<Segment>,
    next: Segment,
    lengthen: impl Fn(&Segment, &Segment) -> Option<Segment>,
) {
    let open = segments.len().saturating_sub(OPEN);
    for last in segments[open..].iter_mut().rev() {
        if let Some(longer) = lengthen(last, &next) {
            *last = longer;
            return;
        }
    }
    segments.push(next);
}
