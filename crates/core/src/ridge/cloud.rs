//! Points that are asked what lies around a place: moments under a Gaussian window.

use crate::point::{Point, dot, sub};
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;
use rayon::prelude::*;

/// Window widths beyond which a point counts for nothing.
const CUT: f64 = 3.0;
/// Points that one task takes at a time.
const GRAIN: usize = 256;

/// Points, and boxes around them.
pub struct Cloud<'a> {
    points: &'a [Point],
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
    pub fn new(points: &'a [Point]) -> Self {
        Self { points, boxes: Boxes::new(points, |&p| Bounds::at(p)) }
    }

    /// Visit all points at most `reach` from `place`, each with the vector to it and the squared distance.
    pub fn near(&self, place: Point, reach: f64, mut visit: impl FnMut(u32, Point, f64)) {
        let square = reach * reach;
        self.boxes.any(&mut |bounds, _| bounds.square_to(place) <= square, &mut |k| {
            let offset = sub(self.points[k as usize], place);
            let distance = dot(offset, offset);
            if distance <= square {
                visit(k, offset, distance);
            }
            false
        });
    }

    /// Visit all points in a Gaussian window of width `width` about `place`, each with the vector to it and its weight.
    pub fn window(&self, place: Point, width: f64, mut visit: impl FnMut(Point, f64)) {
        let factor = -0.5 / (width * width);
        self.near(place, CUT * width, |_, offset, square| {
            visit(offset, libm::exp(factor * square));
        });
    }

    /// The moments under the Gaussian window of `width` about `place`.
    #[must_use]
    pub fn moments(&self, place: Point, width: f64) -> Moments {
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
    #[must_use]
    pub fn bent(&self, place: Point, width: f64) -> Option<f64> {
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
    #[must_use]
    pub fn distance_to_nearest(&self, place: Point, count: usize, guess: f64) -> f64 {
        let mut squares = Vec::new();
        let mut reach = guess;
        for _ in 0..64 {
            squares.clear();
            self.near(place, reach, |_, _, square| squares.push(square));
            if squares.len() > count {
                let (_, nth, _) = squares.select_nth_unstable_by(count, f64::total_cmp);
                return nth.sqrt();
            }
            if squares.len() == self.points.len() {
                break;
            }
            reach *= 2.0;
        }
        squares.iter().fold(0.0, |most: f64, &square| most.max(square)).sqrt()
    }
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

/// One value for each of `count` numbers, in parallel.
pub fn each<T: Send>(count: usize, value: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..count).into_par_iter().with_min_len(GRAIN).map(value).collect()
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
