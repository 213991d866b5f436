//! Rectangles along the things in them: around a piece of a curve much thinner than a rectangle parallel to the axes.

use crate::exact::filter::ROUNDING;
use crate::point::{Point, dot, length, sub, turned};
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
/// difference of two sums of two products, of differences or their halves.
pub const CORNERS: f64 = 12.0 * ROUNDING;

/// An [`Oriented`] rectangle as it is seen from some point.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// The direction of the first side.
    pub along: Point,
    /// The rectangle in the frame whose origin is that point, turned to that direction.
    pub bounds: Bounds,
    /// At least the sum of the sizes of the coordinates of any place in it.
    pub reach: f64,
}

impl Oriented {
    /// The one around `boxes`, along the line between the two that are farthest apart in x or in y.
    #[must_use]
    pub fn around(boxes: impl Iterator<Item = Bounds> + Clone) -> Self {
        Self::between(ends(boxes.clone().map(|b| b.low)), boxes)
    }

    /// The one around `boxes`, which `parts` are around, along these.
    #[must_use]
    pub fn over(parts: &[Self], boxes: impl Iterator<Item = Bounds>) -> Self {
        Self::between(ends(parts.iter().flat_map(Self::ends)), boxes)
    }

    /// The one around `boxes`, along the line between two places.
    fn between([first, last]: [Point; 2], boxes: impl Iterator<Item = Bounds>) -> Self {
        let chord = sub(last, first);
        let far = length(chord);
        let along = if far.is_normal() { chord.map(|x| x / far) } else { [1.0, 0.0] };
        let mut frame = Self { origin: first, along, bounds: Bounds::EMPTY, size: 0.0 };
        let mut sum = 0.0;
        for bounds in boxes {
            let (middle, reach) = frame.framed(bounds);
            sum += middle[0] + middle[1] + reach[0] + reach[1];
            let (low, high) = (sub(middle, reach), [middle[0] + reach[0], middle[1] + reach[1]]);
            frame.bounds = frame.bounds.join(Bounds { low, high });
        }
        // What is infinite or unknown is so in the sum.
        if !f64::is_finite(sum) {
            let everywhere = Bounds { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };
            return Self::parallel(everywhere);
        }
        frame.size = 2.0 * frame.bounds.largest();
        frame
    }

    /// The middle of `bounds` in the frame of this one, and how far they reach from it.
    fn framed(&self, bounds: Bounds) -> (Point, Point) {
        let Bounds { low, high } = bounds.seen_from(self.origin);
        let middle = [0, 1].map(|axis| low[axis] / 2.0 + high[axis] / 2.0);
        let half = [0, 1].map(|axis| high[axis] / 2.0 - low[axis] / 2.0);
        let size = self.along.map(f64::abs);
        let reach = [dot(size, half), size[1] * half[0] + size[0] * half[1]];
        (turned(self.along, middle), reach)
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
        let bounds = self.bounds.seen_from(turned(self.along, from));
        // In any frame the two coordinates of a place are at most √2 times as large as in another.
        let reach = self.size + 1.5 * (from[0].abs() + from[1].abs());
        Seen { along: self.along, bounds, reach }
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

impl From<Bounds> for Seen {
    fn from(bounds: Bounds) -> Self {
        let reach = |axis: usize| bounds.low[axis].abs().max(bounds.high[axis].abs());
        Self { along: [1.0, 0.0], bounds, reach: reach(0) + reach(1) }
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
        let piece = (0..=64).map(|k| on_a_circle(0.7 + 1e-3 * f64::from(k)));
        let around = Oriented::around(piece.clone().map(Bounds::at));
        let [length, width] = sub(around.bounds.high, around.bounds.low);
        assert!((0.06..0.07).contains(&length) && (0.0..6e-4).contains(&width));
        let p = [3.1, 0.4];
        let Seen { along, bounds: Bounds { low, high }, reach } = around.seen_from(p);
        let doubt = CORNERS * reach;
        assert!(doubt < 2e-14);
        for point in piece {
            let at = turned(along, sub(point, p));
            let is_in = |axis| low[axis] - doubt <= at[axis] && at[axis] <= high[axis] + doubt;
            assert!(is_in(0) && is_in(1));
        }
    }

    #[test]
    fn around_nothing_one_place_or_something_infinite_it_is_no_less() {
        let of = |boxes: &[Bounds]| Oriented::around(boxes.iter().copied()).bounds;
        assert!(of(&[]).low[0] > of(&[]).high[0]);
        assert!(of(&[Bounds::at([4.0, 5.0]); 3]).largest() < 1e-14);
        let everywhere = Bounds { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };
        assert!(of(&[Bounds::at([4.0, 5.0]), everywhere]).low[1] == f64::NEG_INFINITY);
    }
}
