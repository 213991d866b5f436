//! Rectangles along the things in them: around a piece of a curve much thinner than a rectangle parallel to the axes.

use crate::exact::filter::ROUNDING;
use crate::point::{Point, length, sub, turned};
use crate::space::bounds::Bounds;

/// A rectangle of any direction, and what rounding adds to it.
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

/// An [`Oriented`] rectangle as it is seen from some point.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// The direction of the first side.
    pub along: Point,
    /// The rectangle in the frame whose origin is that point, turned to that direction.
    pub bounds: Bounds,
    /// What its corners are off by at most.
    pub doubt: f64,
}

impl Oriented {
    /// The one around `boxes`, along the line between the two that are farthest apart in x or in y.
    #[must_use]
    pub fn around(boxes: impl Iterator<Item = Bounds> + Clone) -> Self {
        let whole = boxes.clone().fold(Bounds::EMPTY, Bounds::join);
        let [width, height] = sub(whole.high, whole.low);
        let axis = usize::from(height > width);
        let less = |a: &Bounds, b: &Bounds| a.low[axis].total_cmp(&b.low[axis]);
        let ends = [boxes.clone().min_by(less), boxes.clone().max_by(less)];
        let [Some(first), Some(last)] = ends else { return Self::parallel(whole) };
        let (origin, chord) = (first.low, sub(last.low, first.low));
        let far = length(chord);
        let along = if far.is_normal() { chord.map(|x| x / far) } else { [1.0, 0.0] };
        let corners = |b: Bounds| b.corners().map(|p| turned(along, sub(p, origin)));
        let bounds = boxes.fold(Bounds::EMPTY, |all, b| all.join(Bounds::of(&corners(b))));
        if !bounds.largest().is_finite() || !whole.largest().is_finite() {
            let everywhere = Bounds { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };
            return Self::parallel(everywhere);
        }
        Self { origin, along, bounds, size: 2.0 * bounds.largest() }
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
        // Each coordinate is a difference of two sums of two products of a difference.
        let size = self.size + from[0].abs() + from[1].abs();
        Seen { along: self.along, bounds, doubt: 8.0 * ROUNDING * size }
    }
}

impl From<Bounds> for Seen {
    fn from(bounds: Bounds) -> Self {
        Self { along: [1.0, 0.0], bounds, doubt: 0.0 }
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
        let Seen { along, bounds: Bounds { low, high }, doubt } = around.seen_from(p);
        assert!(doubt < 1e-14);
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
