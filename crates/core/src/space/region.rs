//! A disk as rectangles are asked about it.

use crate::exact::filter::{ROUNDING, UNDERFLOW};
use crate::point::{Point, turned};
use crate::space::bounds::{Bounds, larger, smaller};
use crate::space::oriented::{CORNERS, Seen, Span};

/// A disk whose circle goes through a point `p`.
#[derive(Debug, Clone, Copy)]
pub struct Region {
    /// That point.
    pub p: Point,
    /// The center relative to p.
    center: Point,
    /// At least the sum of the sizes of its coordinates.
    size: f64,
    /// How far it may be off.
    error: f64,
}

impl Region {
    /// The disk around a `center` relative to `p`, which is off by up to `error`, as is its radius.
    #[must_use]
    pub fn new(p: Point, center: Point, radius: f64, error: f64) -> Self {
        // The circle goes through p, so the coordinates of its center sum to at most √2 times the radius.
        let size = 1.5 * radius;
        Self { p, center, size, error: error + 8.0 * ROUNDING * size }
    }

    /// Where it may meet a rectangle: the span of that along its first side. None only if they are certainly apart.
    ///
    /// With c the center, a place v is outside where v·(v − 2 c) > 0: a sum of a term in each coordinate, of which the second is least
    /// nearest to the center. It is off by 2 |v| for each unit that c is off, so even for a large disk it is known to a small part of |v|.
    #[inline]
    #[must_use]
    pub fn span(&self, seen: &Seen) -> Option<Span> {
        let &Seen { along, bounds: Bounds { low, high }, reach, .. } = seen;
        let [x, y] = turned(along, self.center);
        let nearest = larger(low[1], smaller(high[1], y));
        let beside = nearest * (nearest - 2.0 * y);
        let of_place = (2.1 * CORNERS + 16.0 * ROUNDING) * (reach + 2.0 * self.size);
        let doubt = reach * (2.0 * self.error + of_place) + UNDERFLOW;
        // What is left to the first: where (v − x)² is no more than this, which rounds by less than what is added.
        let square = x * x * (1.0 + 8.0 * ROUNDING) + (2.0 * doubt - beside);
        if square < 0.0 {
            return None;
        }
        let half = square.sqrt();
        let rounding = 8.0 * ROUNDING * (x.abs() + half) + CORNERS * reach;
        // An unknown (not a number) leaves the whole side.
        let first = larger(x - half - rounding, low[0]);
        let last = smaller(x + half + rounding, high[0]);
        let is_apart = first > last;
        (!is_apart).then_some([first, last])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_a_disk_and_a_rectangle_have_in_common_is_in_the_span() {
        let at = |k: u32, prime: u32| f64::from(k * prime % 1009) / 504.5 - 1.0;
        let mut met = 0;
        for k in 0..2000 {
            let center = [at(k, 7), at(k, 11)];
            let radius = center[0].hypot(center[1]);
            let corner = [3.0 * at(k, 13), 3.0 * at(k, 17)];
            let bounds =
                Bounds { low: corner, high: [corner[0] + at(k, 3).abs(), corner[1] + 0.1] };
            let span = Region::new([0.0; 2], center, radius, 0.0).span(&bounds.into());
            for step in 0..=20 {
                for y in [bounds.low[1], bounds.high[1], center[1]] {
                    let part = f64::from(step) / 20.0;
                    let x = bounds.low[0] + part * (bounds.high[0] - bounds.low[0]);
                    let y = y.clamp(bounds.low[1], bounds.high[1]);
                    if (x - center[0]).hypot(y - center[1]) <= radius {
                        met += 1;
                        let [first, last] = span.expect("a span");
                        assert!(first <= x && x <= last);
                    }
                }
            }
            if let Some([first, last]) = span {
                // No more than what they have in common, but for rounding.
                let y = center[1].clamp(bounds.low[1], bounds.high[1]);
                for x in [first, last] {
                    assert!((x - center[0]).hypot(y - center[1]) <= radius + 1e-6);
                }
            }
        }
        assert!(met > 1000, "{met}");
    }

    #[test]
    fn what_is_not_known_may_be_met_anywhere() {
        let everywhere = Bounds { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };
        let whole = Some([f64::NEG_INFINITY, f64::INFINITY]);
        for radius in [1.0, f64::NAN, f64::INFINITY] {
            let region = Region::new([0.0; 2], [radius, 0.0], radius, f64::INFINITY);
            assert_eq!(region.span(&everywhere.into()), whole);
        }
        let unknown = Region::new([0.0; 2], [f64::NAN; 2], f64::NAN, f64::NAN);
        let far = Bounds { low: [5.0; 2], high: [7.0; 2] };
        assert_eq!(unknown.span(&far.into()), Some([5.0, 7.0]));
    }
}
