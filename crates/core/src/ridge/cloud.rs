//! Points that are asked what lies around a place: moments under a Gaussian window.

use crate::error::Result;
use crate::parts::in_parts;
use crate::point::{Point, dot, sub};
use crate::progress::Progress;
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;

/// Window widths beyond which a point counts for nothing.
const CUT: f64 = 3.0;
/// Points that one task takes at a time.
const GRAIN: usize = 256;
/// How much farther an eye looks than it is asked to, as what is asked next is near; and how far it has looked too far.
const AHEAD: f64 = 1.5;
const TOO_FAR: f64 = 4.0;

/// Points, and boxes around them.
pub struct Cloud<'a> {
    points: &'a [Point],
    progress: &'a Progress,
    boxes: Boxes,
}

/// What a Gaussian window sees.
#[derive(Debug, Clone, Copy, Default)]
pub struct Moments {
    /// The sum of the weights.
    pub weight: f64,
    /// How many equal weights would vary as little: the square of the sum over the sum of the squares.
    pub count: f64,
    /// The mean, from the window's center.
    pub mean: Point,
    /// The variance along the direction in which it is largest, and across it.
    pub variances: [f64; 2],
    /// The direction in which the variance is largest, of length 1.
    pub tangent: Point,
}

impl<'a> Cloud<'a> {
    /// The cloud of `points`, of which those of successive numbers should be near each other.
    #[must_use]
    pub fn new(points: &'a [Point], progress: &'a Progress) -> Self {
        Self { points, progress, boxes: Boxes::new(points, |&p| Bounds::at(p)) }
    }

    /// One that has seen nothing yet.
    #[must_use]
    pub fn eye(&'a self) -> Eye<'a> {
        Eye {
            cloud: self,
            seen: Bounds::EMPTY,
            reach: 0.0,
            points: Vec::new(),
            numbers: Vec::new(),
        }
    }

    /// One value for each of `count` numbers, in parallel; those of successive numbers should look near each other.
    ///
    /// # Errors
    /// The call is cancelled.
    pub fn each<T: Send>(
        &self,
        count: usize,
        value: impl Fn(&mut Eye<'_>, usize) -> T + Sync + Send,
    ) -> Result<Vec<T>> {
        let parts = in_parts(count, GRAIN, self.progress, |numbers| {
            let mut eye = self.eye();
            numbers.map(|k| value(&mut eye, k)).collect::<Vec<T>>()
        })?;
        Ok(parts.into_iter().flatten().collect())
    }
}

/// One who looks at a cloud, at one place after another, and remembers a square of it.
///
/// What it finds, and in which order, does not depend on where it has looked before.
pub struct Eye<'a> {
    cloud: &'a Cloud<'a>,
    /// The square that is remembered, and half its side.
    seen: Bounds,
    reach: f64,
    /// The points in it and their numbers, ascending.
    points: Vec<Point>,
    numbers: Vec<u32>,
}

impl Eye<'_> {
    /// Visit all points at most `reach` from `place` in the order of their numbers, each with the vector to it and the squared distance.
    pub fn near(&mut self, place: Point, reach: f64, mut visit: impl FnMut(u32, Point, f64)) {
        self.look(place, reach);
        let square = reach * reach;
        for (&point, &number) in self.points.iter().zip(&self.numbers) {
            let offset = sub(point, place);
            let distance = dot(offset, offset);
            if distance <= square {
                visit(number, offset, distance);
            }
        }
    }

    /// See to it that the square of `reach` about `place` is remembered, and not far more.
    fn look(&mut self, place: Point, reach: f64) {
        let Bounds { low, high } = self.seen;
        let is_inside = |k: usize| low[k] <= place[k] - reach && place[k] + reach <= high[k];
        if is_inside(0) && is_inside(1) && self.reach <= TOO_FAR * reach {
            return;
        }
        self.reach = AHEAD * reach;
        let square = [-self.reach, self.reach].map(|reach| place.map(|x| x + reach));
        let square = Bounds { low: square[0], high: square[1] };
        self.points.clear();
        self.numbers.clear();
        let (points, numbers) = (&mut self.points, &mut self.numbers);
        self.cloud.boxes.any(&mut |bounds, _| bounds.meets(&square), &mut |k| {
            points.push(self.cloud.points[k as usize]);
            numbers.push(k);
            false
        });
        self.seen = square;
    }

    /// Visit all points in a Gaussian window of width `width` about `place`, each with the vector to it and its weight.
    pub fn window(&mut self, place: Point, width: f64, mut visit: impl FnMut(Point, f64)) {
        let factor = -0.5 / (width * width);
        self.near(place, CUT * width, |_, offset, square| {
            visit(offset, bell(factor * square));
        });
    }

    /// The moments under the Gaussian window of `width` about `place`.
    pub fn moments(&mut self, place: Point, width: f64) -> Moments {
        let (mut weight, mut squares, mut first, mut second) = (0.0, 0.0, [0.0; 2], [0.0; 3]);
        self.window(place, width, |[x, y], w| {
            weight += w;
            squares += w * w;
            first = [first[0] + w * x, first[1] + w * y];
            second = [second[0] + w * x * x, second[1] + w * x * y, second[2] + w * y * y];
        });
        if weight == 0.0 {
            return Moments::default();
        }
        let mean = first.map(|x| x / weight);
        let covariance = [
            second[0] / weight - mean[0] * mean[0],
            second[1] / weight - mean[0] * mean[1],
            second[2] / weight - mean[1] * mean[1],
        ];
        let (variances, tangent) = principal(covariance);
        Moments { weight, count: weight * weight / squares, mean, variances, tangent }
    }

    /// The variance about the parabola over the principal direction that fits best in a window; none in one of few points.
    pub fn bent(&mut self, place: Point, width: f64) -> Option<f64> {
        let Moments { count, mean, tangent: [tx, ty], .. } = self.moments(place, width);
        let (mut powers, mut against, mut square) = ([0.0; 5], [0.0; 3], 0.0);
        self.window(place, width, |[x, y], w| {
            let (x, y) = (x - mean[0], y - mean[1]);
            let (u, v) = ((x * tx + y * ty) / width, (y * tx - x * ty) / width);
            let mut term = w;
            for power in 0..5 {
                powers[power] += term;
                if power < 3 {
                    against[power] += term * v;
                }
                term *= u;
            }
            square += w * v * v;
        });
        let explained = parabola(powers, against)?;
        let free = count - 3.0;
        (free > 1.0)
            .then(|| (square - explained).max(0.0) / powers[0] * width * width * count / free)
    }

    /// The distance from `place` to the `count`-th nearest other point, sought within `guess`, and twice that, and so on.
    pub fn distance_to_nearest(&mut self, place: Point, count: usize, guess: f64) -> f64 {
        let mut squares = Vec::new();
        let mut reach = guess;
        for _ in 0..64 {
            squares.clear();
            self.near(place, reach, |_, _, square| squares.push(square));
            if squares.len() > count {
                let (_, nth, _) = squares.select_nth_unstable_by(count, f64::total_cmp);
                return nth.sqrt();
            }
            if squares.len() == self.cloud.points.len() {
                break;
            }
            reach *= 2.0;
        }
        squares.iter().fold(0.0, |most: f64, &square| most.max(square)).sqrt()
    }
}

/// e to the power `x` from −CUT² / 2 to 0, but for one in a million: the 32nd power of a Taylor polynomial.
///
/// The same on all machines, and a third of the time of one that is right everywhere.
#[inline]
fn bell(x: f64) -> f64 {
    let y = x / 32.0;
    let small = 1.0 + y * (1.0 + y / 2.0 * (1.0 + y / 3.0 * (1.0 + y / 4.0 * (1.0 + y / 5.0))));
    (0..5).fold(small, |power, _| power * power)
}

/// The variances along and across the principal direction, and that direction.
fn principal([xx, xy, yy]: [f64; 3]) -> ([f64; 2], Point) {
    let (half, mean) = ((xx - yy) / 2.0, f64::midpoint(xx, yy));
    let spread = half.hypot(xy);
    let tangent = if half > 0.0 { [spread + half, xy] } else { [xy, spread - half] };
    let length = tangent[0].hypot(tangent[1]);
    let tangent = if length > 0.0 { tangent.map(|x| x / length) } else { [1.0, 0.0] };
    ([mean + spread, (mean - spread).max(0.0)], tangent)
}

/// The sum of squares that the best parabola explains, from sums of powers of u, and of their products with v.
fn parabola([a, b, c, d, e]: [f64; 5], [x, y, z]: [f64; 3]) -> Option<f64> {
    let minors = [c * e - d * d, c * d - b * e, b * d - c * c];
    let determinant = a * minors[0] + b * minors[1] + c * minors[2];
    let inner = [a * e - c * c, b * c - a * d, a * c - b * b];
    let quadratic = minors[0] * x * x
        + inner[0] * y * y
        + inner[2] * z * z
        + 2.0 * (minors[1] * x * y + minors[2] * x * z + inner[1] * y * z);
    (determinant > 1e-9 * a * a * a).then(|| quadratic / determinant)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bell_is_the_exponential_but_for_one_in_a_million() {
        for k in 0..=4500 {
            let x = -f64::from(k) / 1000.0;
            assert!((bell(x) / libm::exp(x) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn an_eye_sees_the_same_wherever_it_has_looked_before() {
        let points: Vec<Point> =
            (0..500).map(|k| [f64::from(k * 37 % 101), f64::from(k * 53 % 97)]).collect();
        let progress = Progress::default();
        let cloud = Cloud::new(&points, &progress);
        let seen = |eye: &mut Eye<'_>, place, reach| {
            let mut found = Vec::new();
            eye.near(place, reach, |k, _, _| found.push(k));
            found
        };
        let mut eye = cloud.eye();
        for (k, &place) in points.iter().enumerate() {
            let reach = [0.0, 3.0, 30.0, 5.0, 200.0][k % 5];
            let distance = |p: &Point| sub(*p, place).map(|x| x * x).iter().sum::<f64>();
            let expected: Vec<u32> =
                (0..500).filter(|&k| distance(&points[k as usize]) <= reach * reach).collect();
            assert_eq!(seen(&mut eye, place, reach), expected);
            assert_eq!(seen(&mut cloud.eye(), place, reach), expected);
        }
    }
}
