//! Rectangles along the things in them: around a piece of a curve much thinner than a rectangle parallel to the axes.

use crate::exact::filter::ROUNDING;
use crate::point::{Point, length, sub, turned};
use crate::space::bounds::Bounds;

/// A rectangle of any direction.
#[derive(Debug, Clone, Copy)]
pub struct Oriented {
    /// A place in it, which the bounds count from.
    origin: Point,
    /// The direction of the first side, about of length one.
    along: Point,
    /// The rectangle in that frame.
    bounds: Bounds,
    /// Twice the largest of its coordinates.
    size: f64,
}

/// By how much rounding may move the corners of an [`Oriented`] rectangle, for each unit of how far they reach: each coordinate is a
/// difference of two sums of two products of differences.
pub const CORNERS: f64 = 12.0 * ROUNDING;

/// A place that is known but for a `doubt`: somewhere in the disk of this radius.
#[derive(Debug, Clone, Copy, Default)]
pub struct Place {
    /// The middle.
    pub at: Point,
    /// The radius, perhaps infinite.
    pub doubt: f64,
}

/// A part of a line, from its least coordinate to its largest.
pub type Span = [f64; 2];

/// All of a line.
const WHOLE: Span = [f64::NEG_INFINITY, f64::INFINITY];

/// An [`Oriented`] rectangle as it is seen from some point.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// The direction of the first side.
    pub along: Point,
    /// The rectangle in the frame whose origin is that point, turned to that direction.
    pub bounds: Bounds,
    /// At least the sum of the sizes of the coordinates of any place in it.
    pub reach: f64,
    /// Where that point is along the first side.
    at: f64,
}

impl Oriented {
    /// The one around `items`, along the line between the two that are farthest apart in x or in y; and the span along it of each.
    #[must_use]
    pub fn around<T>(items: &[T], place: impl Fn(&T) -> Place, spans: &mut [Span]) -> Self {
        let ends = ends(items.iter().map(|item| place(item).at));
        Self::between(ends, items.chunks(1), place, spans)
    }

    /// The one around the items of `parts`, along the boxes of these; and the span along it of each part.
    #[must_use]
    pub fn over<'a, T: 'a>(
        boxes: &[Self],
        parts: impl Iterator<Item = &'a [T]>,
        place: impl Fn(&T) -> Place,
        spans: &mut [Span],
    ) -> Self {
        Self::between(ends(boxes.iter().flat_map(Self::ends)), parts, place, spans)
    }

    /// The one around the items of `parts`, along the line between two places; and the span along it of each part.
    fn between<'a, T: 'a>(
        [first, last]: [Point; 2],
        parts: impl Iterator<Item = &'a [T]>,
        place: impl Fn(&T) -> Place,
        spans: &mut [Span],
    ) -> Self {
        let chord = sub(last, first);
        let far = length(chord);
        let along = if far.is_normal() { chord.map(|x| x / far) } else { [1.0, 0.0] };
        let mut frame = Self { origin: first, along, bounds: Bounds::EMPTY, size: 0.0 };
        // A disk extends as far in any frame.
        let mut sum = 0.0;
        for (span, items) in spans.iter_mut().zip(parts) {
            let mut part = Bounds::EMPTY;
            for item in items {
                let Place { at, doubt } = place(item);
                let [x, y] = turned(along, sub(at, first));
                sum += x + y + doubt;
                let around = Bounds { low: [x - doubt, y - doubt], high: [x + doubt, y + doubt] };
                part = part.join(around);
            }
            *span = [part.low[0], part.high[0]];
            frame.bounds = frame.bounds.join(part);
        }
        // What is infinite or unknown is so in the sum.
        if !f64::is_finite(sum) {
            spans.fill(WHOLE);
            let everywhere = Bounds { low: [WHOLE[0]; 2], high: [WHOLE[1]; 2] };
            return Self::parallel(everywhere);
        }
        frame.size = 2.0 * frame.bounds.largest();
        frame
    }

    /// About where it begins and ends.
    fn ends(&self) -> [Point; 2] {
        let long = self.bounds.high[0];
        [self.origin, [0, 1].map(|axis| self.origin[axis] + long * self.along[axis])]
    }

    /// One that is parallel to the axes.
    fn parallel(bounds: Bounds) -> Self {
        Self { origin: [0.0; 2], along: [1.0, 0.0], bounds, size: 2.0 * bounds.largest() }
    }

    /// The same seen from `p`.
    #[inline]
    #[must_use]
    pub fn seen_from(&self, p: Point) -> Seen {
        let from = sub(p, self.origin);
        let at = turned(self.along, from);
        // In any frame the two coordinates of a place are at most √2 times as large as in another.
        let reach = self.size + 1.5 * (from[0].abs() + from[1].abs());
        Seen { along: self.along, bounds: self.bounds.seen_from(at), reach, at: at[0] }
    }
}

impl Seen {
    /// What has the span `seen` from that point has one of the rectangle's own frame, no longer than this.
    #[inline]
    #[must_use]
    pub fn own(&self, seen: Span) -> Span {
        let doubt = 2.0 * CORNERS * self.reach;
        [seen[0] + self.at - doubt, seen[1] + self.at + doubt]
    }
}

/// The two that are farthest apart in x, or in y if they extend further that way; the same for none as for one at the origin.
fn ends(places: impl Iterator<Item = Point> + Clone) -> [Point; 2] {
    let around = places.clone().fold(Bounds::EMPTY, |all, p| all.join(Bounds::at(p)));
    let [width, height] = sub(around.high, around.low);
    let axis = usize::from(height > width);
    let less = |a: &Point, b: &Point| a[axis].total_cmp(&b[axis]);
    let ends = [places.clone().min_by(less), places.max_by(less)];
    ends.map(|end| end.filter(|p| p.iter().all(|x| x.is_finite())).unwrap_or_default())
}

impl Place {
    /// The square around it, seen from `p`.
    #[inline]
    #[must_use]
    pub fn seen_from(&self, p: Point) -> Seen {
        let [x, y] = sub(self.at, p);
        let doubt = self.doubt;
        Bounds { low: [x - doubt, y - doubt], high: [x + doubt, y + doubt] }.into()
    }
}

impl From<Bounds> for Seen {
    fn from(bounds: Bounds) -> Self {
        let reach = |axis: usize| bounds.low[axis].abs().max(bounds.high[axis].abs());
        Self { along: [1.0, 0.0], bounds, reach: reach(0) + reach(1), at: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_a_circle(angle: f64) -> Point {
        [3.0 + angle.cos(), angle.sin() - 2.0]
    }

    #[test]
    fn around_a_piece_of_a_circle_it_is_as_thin_as_that() {
        let piece: Vec<Point> = (0..=64).map(|k| on_a_circle(0.7 + 1e-3 * f64::from(k))).collect();
        let mut spans = vec![[0.0; 2]; piece.len()];
        let around = Oriented::around(&piece, |&at| Place { at, doubt: 0.0 }, &mut spans);
        let [length, width] = sub(around.bounds.high, around.bounds.low);
        assert!((0.06..0.07).contains(&length) && (0.0..6e-4).contains(&width));
        let p = [3.1, 0.4];
        let seen = around.seen_from(p);
        let Seen { along, bounds: Bounds { low, high }, reach, .. } = seen;
        let doubt = CORNERS * reach;
        assert!(doubt < 2e-14);
        for (point, span) in piece.into_iter().zip(spans) {
            let at = turned(along, sub(point, p));
            let is_in = |axis| low[axis] - doubt <= at[axis] && at[axis] <= high[axis] + doubt;
            assert!(is_in(0) && is_in(1));
            let [first, last] = seen.own([at[0]; 2]);
            assert!(first <= span[0] && span[1] <= last && last - first < 1e-13);
        }
    }

    #[test]
    fn around_nothing_one_place_or_something_infinite_it_is_no_less() {
        let of = |places: &[Place]| {
            let mut spans = vec![[0.0; 2]; places.len()];
            (Oriented::around(places, |&place| place, &mut spans).bounds, spans)
        };
        assert!(of(&[]).0.low[0] > of(&[]).0.high[0]);
        let one = Place { at: [4.0, 5.0], doubt: 0.0 };
        assert!(of(&[one; 3]).0.largest() < 1e-14);
        let everywhere = Place { at: [0.0; 2], doubt: f64::INFINITY };
        let (bounds, spans) = of(&[one, everywhere]);
        assert!(bounds.low[1] == f64::NEG_INFINITY && spans == [WHOLE; 2]);
    }
}
